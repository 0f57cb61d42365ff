#include "haptics/Filters/LengthUnit.h"

#include "vtkObject.h"
#include "vtkSetGet.h"

#include <cmath>
#include <sstream>

namespace haptics
{
std::string LengthUnitName(double metres)
{
  static const struct
  {
    double Metres;
    const char* Name;
  } units[] = { { 1.0, "m" }, { 1e-3, "mm" }, { 1e-2, "cm" }, { 1e-6, "um" }, { 1e-9, "nm" },
    { 1e3, "km" }, { 0.0254, "in" }, { 0.3048, "ft" } };
  if (metres == 0.0)
  {
    return {};
  }
  for (const auto& unit : units)
  {
    if (std::abs(metres - unit.Metres) < 1e-9 * unit.Metres)
    {
      return unit.Name;
    }
  }
  std::ostringstream name;
  name << metres << " m";
  return name.str();
}

bool SetLength(vtkObject* object, const char* name, double& setting, double value)
{
  constexpr double least = 1e-100;
  constexpr double most = 1e100;
  if (value != 0.0 && !(value >= least && value <= most)) // NaN is not either
  {
    vtkErrorWithObjectMacro(object, << name << " has to be a length from " << least << " to "
                                    << most << " m, or 0 where it is not known, but is " << value
                                    << "; it stays " << setting << ".");
    return false;
  }
  if (setting == value)
  {
    return false;
  }
  setting = value;
  object->Modified();
  return true;
}
}
