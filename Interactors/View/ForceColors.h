#ifndef Haptics_ForceColors_h
#define Haptics_ForceColors_h

#include "vtkColorTransferFunction.h"

namespace haptics
{
/// Makes a function that of the colours of forces, from 0 to the strongest [N] and beyond: pale
/// gold over orange to crimson. The same everywhere, so that arrow, bar, trail and legend agree.
inline void SetForceColors(vtkColorTransferFunction* colors, double strongest)
{
  colors->RemoveAllPoints();
  colors->AddRGBPoint(0.0, 1.0, 0.93, 0.60);
  colors->AddRGBPoint(0.45 * strongest, 1.0, 0.60, 0.18);
  colors->AddRGBPoint(strongest, 0.72, 0.05, 0.15);
}
}

#endif
