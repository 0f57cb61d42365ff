#ifndef Haptics_DeviceRegistry_h
#define Haptics_DeviceRegistry_h

#include "vtkHapticsDevicesModule.h"

#include <string>
#include <vector>

class vtkHapticDevice;

namespace haptics
{
/// A kind of device that vtkHapticDevice::CreateByName() can make.
struct DeviceKind
{
  std::string Name;  ///< what the user types: lower case, no colon
  std::string Title; ///< what a chooser shows
  vtkHapticDevice* (*New)();
};

/// @brief Makes a kind of device known by its name, for as long as the object lives.
///
/// Each device's source file has one at namespace scope, so that there is no list of classes
/// anywhere. GUI thread.
class VTKHAPTICSDEVICES_EXPORT DeviceRegistration
{
public:
  DeviceRegistration(const char* name, const char* title, vtkHapticDevice* (*make)());
  ~DeviceRegistration();
  DeviceRegistration(const DeviceRegistration&) = delete;
  DeviceRegistration& operator=(const DeviceRegistration&) = delete;

  /// All that are known, by their title.
  static std::vector<DeviceKind> Kinds();

private:
  const std::string Name;
};
}

#endif
