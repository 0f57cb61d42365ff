#ifndef Haptics_TouchedPlace_h
#define Haptics_TouchedPlace_h

#include "haptics/Filters/TraceRecorder.h"
#include "vtkType.h"

#include <string>

class vtkPolyData;

namespace haptics
{
/// What a tick touched, for its trace. Valid until the scene's surfaces change.
struct TouchedPlace
{
  TracePlace Traced;
  vtkPolyData* Prepared = nullptr;   ///< the surface's triangles with their arrays; null for none
  vtkIdType Triangle = -1;           ///< in these
  const std::string* Name = nullptr; ///< of the surface; null for none
};
}

#endif
