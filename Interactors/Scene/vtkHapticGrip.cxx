#include "vtkHapticGrip.h"

#include "haptics/Scene/CarriedSurface.h"
#include "haptics/Scene/GrippingHand.h"
#include "haptics/Scene/SurfaceSet.h"
#include "vtkActor.h"
#include "vtkObjectFactory.h"

#include <utility>

vtkStandardNewMacro(vtkHapticGrip);

namespace
{
constexpr const char* NoActor =
  " was added as geometry: there is no actor that a hand could carry. Add it as a vtkActor.";
}

vtkHapticGrip::vtkHapticGrip()
  : Object(std::make_unique<haptics::CarriedSurface>())
{
}

vtkHapticGrip::~vtkHapticGrip() = default;

bool vtkHapticGrip::Fail(const std::string& message)
{
  this->ErrorMessage = message;
  vtkErrorMacro(<< message);
  return false;
}

void vtkHapticGrip::SetHand(haptics::GrippingHand* hand)
{
  this->Hand = hand;
  if (!hand)
  {
    this->Object = std::make_unique<haptics::CarriedSurface>();
  }
}

int vtkHapticGrip::GetSurface()
{
  return this->Object->Surface();
}

bool vtkHapticGrip::Take()
{
  if (!this->Hand || this->Hand->TouchedSurface() < 0)
  {
    return this->Fail("A grip needs a contact, and nothing is touched. Touch a surface first.");
  }
  return this->TakeSurface(this->Hand->TouchedSurface());
}

bool vtkHapticGrip::TakeSurface(int id)
{
  this->ErrorMessage.clear();
  if (!this->Hand)
  {
    return this->Fail("There is no surface " + std::to_string(id) +
      " to grip: this grip belongs to no scene. Use what vtkHapticScene::GetGrip() returns.");
  }
  this->Hand->PullSurfaces(); // it may have been hidden meanwhile
  haptics::SurfaceSet& surfaces = this->Hand->Surfaces();
  const haptics::HapticSurface* surface = surfaces.Find(id);
  const std::string name = surfaces.Title(id);
  if (surface && this->Object->Surface() == id)
  {
    return true;
  }
  if (!surface)
  {
    return this->Fail(surfaces.AssemblyOf(id)
        ? name + " is a whole assembly. Grip one of its parts, which have ids of their own."
        : "There is no surface " + std::to_string(id) + " to grip.");
  }
  if (!surfaces.ActorOf(id))
  {
    return this->Fail(name + NoActor);
  }
  if (!surface->TouchableSurface())
  {
    return this->Fail(name + " cannot be touched, and so cannot be gripped. Show it first.");
  }
  if (!this->Hand->IsThere())
  {
    return this->Fail(
      "There is no hand to grip with. Engage() or Step() first, with the clutch off.");
  }
  this->LetGo();
  this->Object->Take(id, *this->Hand->LatestTick(), surfaces);
  this->Hand->HasTaken(id);
  this->Hand->PullSurfaces();
  this->Modified();
  return this->Object->Surface() == id;
}

void vtkHapticGrip::LetGo()
{
  if (this->Object->IsNothing())
  {
    return;
  }
  this->Carry();
  this->Hand->HasLetGo(this->Object->Surface());
  this->Object->LetGo(this->Hand->Surfaces());
  this->Hand->PullSurfaces(); // what moves the actor from now on is not the hand
  this->Modified();
}

int vtkHapticGrip::ReleaseMissing()
{
  haptics::SurfaceSet& surfaces = this->Hand->Surfaces();
  if (!this->Object->IsLost(surfaces))
  {
    return haptics::CarriedSurface::Nothing;
  }
  const int lost = this->Object->Surface();
  this->Object->LetGo(surfaces);
  return lost;
}

void vtkHapticGrip::OnPublished(std::uint64_t generation)
{
  this->Object->OnPublished(generation);
}

void vtkHapticGrip::OnTick(const haptics::TickRecord& tick)
{
  this->Object->OnTick(tick, this->Hand->Surfaces());
}

bool vtkHapticGrip::Carry()
{
  const haptics::TickRecord* const latest = this->Hand->LatestTick();
  if (this->Object->IsNothing() || !latest)
  {
    return false;
  }
  haptics::SurfaceSet& surfaces = this->Hand->Surfaces();
  surfaces.PullAssemblies(); // the surface of a part only stands for its actor
  vtkActor* actor = surfaces.ActorOf(this->Object->Surface());
  return actor && this->Object->Carry(*latest, actor, surfaces);
}

void vtkHapticGrip::OnButtons(unsigned int buttons)
{
  const bool isThere = this->Hand->IsThere();
  const bool isHeld = isThere && this->Button >= 0 && (buttons >> this->Button & 1U) != 0;
  const bool wasHeld = std::exchange(this->IsButtonHeld, isHeld);
  if (!isThere || (wasHeld && !isHeld))
  {
    this->LetGo();
  }
  const int id = this->Hand->TouchedSurface();
  if (!isHeld || wasHeld || id < 0)
  {
    return;
  }
  if (this->Hand->Surfaces().ActorOf(id))
  {
    this->TakeSurface(id);
  }
  // Once: the button may be for more than this.
  else if (this->WarnedOf.insert(id).second)
  {
    vtkWarningMacro(<< this->Hand->Surfaces().Title(id) << NoActor);
  }
}

void vtkHapticGrip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Surface: " << this->GetSurface() << "\n";
  os << indent << "Button: " << this->Button << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
