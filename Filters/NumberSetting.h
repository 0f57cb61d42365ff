#ifndef Haptics_NumberSetting_h
#define Haptics_NumberSetting_h

#include "vtkObject.h"
#include "vtkSetGet.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
/// What vtkSetClampMacro does for a double, but NaN, which is within no bounds, is an error and
/// leaves the setting as it is.
inline void SetNumber(
  vtkObject* object, const char* name, double& setting, double value, double least, double most)
{
  if (std::isnan(value))
  {
    vtkErrorWithObjectMacro(object, << name << " has to be a number from " << least << " to "
                                    << most << ", but is " << value << "; it stays " << setting
                                    << ".");
    return;
  }
  value = std::clamp(value, least, most);
  if (setting != value)
  {
    setting = value;
    object->Modified();
  }
}
}

#endif
