#ifndef Haptics_WorkspaceFit_h
#define Haptics_WorkspaceFit_h

#include <string>

class vtkCamera;
class vtkMatrix4x4;

namespace haptics
{
/// The smallest similarity that maps the device's workspace [m] over the world bounds. The device's
/// x, y, z go along the camera's right, up and backwards, or the world's axes without a camera.
/// False with an `error` where either box is empty or not finite.
bool FitWorkspace(const double workspace[6], const double world[6], vtkCamera* camera,
  vtkMatrix4x4* deviceToWorld, std::string& error);
}

#endif
