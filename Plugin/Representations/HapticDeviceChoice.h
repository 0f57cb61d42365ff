#ifndef Haptics_HapticDeviceChoice_h
#define Haptics_HapticDeviceChoice_h

#include "vtkHapticDevice.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

class vtkHapticScene;
class vtkMatrix4x4;

namespace haptics
{
/// @brief A device by the name that a user gives it, and the path of its hand if it has one.
///
/// GUI thread.
class DeviceChoice
{
public:
  /// `name`: of vtkHapticDevice::CreateByName(), or a file. A file that ends in .vtp holds the path
  /// of a hand in the world frame: its points, or its point array HapticInterfacePoint [world unit]
  /// if it has one, at the times of its point array Time [s] if it has one; any other file is a
  /// recording of vtkHapticServo. Where it is none of them, Device() is null and `error` says why.
  static DeviceChoice Make(const std::string& name, std::string& error);

  vtkHapticDevice* Device() const { return this->Chosen; }
  /// Where the hand goes, world frame; null for a device that somebody moves.
  vtkPolyData* WorldPath() const { return this->Path; }
  /// Whether the path is made by MakeStroke().
  bool Strokes() const { return this->MakesStroke; }

  /// For the simulated device, which has no path of its own: one over the surfaces of a scene, as
  /// they are seen along the z axis of the device. False where the scene has none to touch.
  bool MakeStroke(vtkHapticScene* scene);

  /// Gives the device its path for a workspace transform, device to world. Closes the device, as
  /// it reads paths when it opens. Takes the hand of a mouse to the front of what it reaches.
  /// Nothing for a device that somebody moves.
  void FollowPath(vtkMatrix4x4* deviceToWorld);

private:
  bool ReadPath(const std::string& file, std::string& error);

  vtkSmartPointer<vtkHapticDevice> Chosen;
  vtkSmartPointer<vtkPolyData> Path;
  bool MakesStroke = false;
};
}

#endif
