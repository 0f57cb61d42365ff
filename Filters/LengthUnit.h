#ifndef Haptics_LengthUnit_h
#define Haptics_LengthUnit_h

#include "vtkHapticsFiltersModule.h"

#include <string>

class vtkObject;

namespace haptics
{
/// What the unit of a length is called, "mm" for 0.001 [m]; of one without a name its metres. Empty
/// for 0, a unit that nobody knows.
VTKHAPTICSFILTERS_EXPORT std::string LengthUnitName(double metres);

/// Sets a length [m] that 0 says nothing about, from 1e-100 to 1e100. Anything else is an error and
/// leaves the setting as it is. Whether it has changed.
VTKHAPTICSFILTERS_EXPORT bool SetLength(
  vtkObject* object, const char* name, double& setting, double value);
}

#endif
