#ifndef Haptics_ViewHeight_h
#define Haptics_ViewHeight_h

#include "vtkCamera.h"
#include "vtkMath.h"

#include <cmath>

namespace haptics
{
/// The height of what a camera sees at a distance along its axis, in any unit in perspective, in
/// the world's in parallel projection, where it is the same at every distance.
inline double ViewHeight(vtkCamera* camera, double distance)
{
  return 2.0 *
    (camera->GetParallelProjection()
        ? camera->GetParallelScale()
        : distance * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle())));
}
}

#endif
