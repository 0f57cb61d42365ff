#include "vtkHapticSafety.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkHapticSafety);

/// What one limit may be. `Strictest` is the end of both ranges that is on the safe side.
struct vtkHapticSafety::Limit
{
  double vtkHapticSafety::*Member;
  const char* Name;
  const char* Unit;
  double Strictest;
  double Default;
  double Loosest;
};

namespace
{
bool IsBetween(double value, double a, double b)
{
  return a <= b ? value >= a && value <= b : value >= b && value <= a;
}
}

// clang-format off
#define HAPTIC_LIMITS(apply)                          \
  apply(SlewLimit,       " N/s", 1.0,   1000.0, 1e5)  \
  apply(SoftStartTime,   " s",   10.0,  0.1,    0.0)  \
  apply(StiffnessMargin, "",     0.05,  0.9,    100.0)\
  apply(WatchdogTime,    " s",   0.005, 0.025,  1.0)  \
  apply(MissedTickShare, "",     0.01,  0.5,    60.0)
// clang-format on

#define HAPTIC_SETTERS(name, unit, strictest, standard, loosest)                                   \
  void vtkHapticSafety::Set##name(double value)                                                    \
  {                                                                                                \
    this->Change(                                                                                  \
      { &vtkHapticSafety::name, #name, unit, strictest, standard, loosest }, value, false);        \
  }                                                                                                \
  void vtkHapticSafety::Loosen##name(double value)                                                 \
  {                                                                                                \
    this->Change(                                                                                  \
      { &vtkHapticSafety::name, #name, unit, strictest, standard, loosest }, value, true);         \
  }
HAPTIC_LIMITS(HAPTIC_SETTERS)
#undef HAPTIC_SETTERS

vtkHapticSafety::vtkHapticSafety()
{
  this->Reset();
}

vtkHapticSafety::~vtkHapticSafety() = default;

void vtkHapticSafety::Reset()
{
#define HAPTIC_DEFAULT(name, unit, strictest, standard, loosest) this->name = standard;
  HAPTIC_LIMITS(HAPTIC_DEFAULT)
#undef HAPTIC_DEFAULT
  this->ContactDamping = 0.0;
  this->PassivityControl = false;
  this->Modified();
}

bool vtkHapticSafety::IsLoosened()
{
  bool isLoosened = false;
#define HAPTIC_LOOSENED(name, unit, strictest, standard, loosest)                                  \
  isLoosened = isLoosened || !IsBetween(this->name, strictest, standard);
  HAPTIC_LIMITS(HAPTIC_LOOSENED)
#undef HAPTIC_LOOSENED
  return isLoosened;
}

void vtkHapticSafety::Change(const Limit& limit, double value, bool mayLoosen)
{
  if (!IsBetween(value, limit.Strictest, limit.Loosest))
  {
    vtkErrorMacro(<< limit.Name << " must be between " << limit.Strictest << " and "
                  << limit.Loosest << limit.Unit << ", but is " << value << "; it stays "
                  << this->*limit.Member << ".");
    return;
  }
  if (!mayLoosen && !IsBetween(value, limit.Strictest, limit.Default))
  {
    vtkErrorMacro(<< limit.Name << " of " << value << limit.Unit
                  << " is less safe than the default " << limit.Default << "; it stays "
                  << this->*limit.Member << ". Call Loosen" << limit.Name
                  << "() if that is meant.");
    return;
  }
  if (this->*limit.Member != value)
  {
    this->*limit.Member = value;
    this->Modified();
  }
}

void vtkHapticSafety::SetContactDamping(double damping)
{
  constexpr double Largest = 20.0;
  if (!IsBetween(damping, 0.0, Largest))
  {
    vtkErrorMacro("ContactDamping must be between 0 and "
      << Largest << " N s/m, but is " << damping << "; it stays " << this->ContactDamping << ".");
    return;
  }
  if (this->ContactDamping != damping)
  {
    this->ContactDamping = damping;
    this->Modified();
  }
}

void vtkHapticSafety::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
#define HAPTIC_PRINT(name, unit, strictest, standard, loosest)                                     \
  os << indent << #name << ": " << this->name << unit                                              \
     << (IsBetween(this->name, strictest, standard) ? "" : " (loosened)") << "\n";
  HAPTIC_LIMITS(HAPTIC_PRINT)
#undef HAPTIC_PRINT
  os << indent << "ContactDamping: " << this->ContactDamping << " N s/m\n";
  os << indent << "PassivityControl: " << (this->PassivityControl ? "on" : "off") << "\n";
}
