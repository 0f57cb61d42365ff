#ifndef Haptics_DevicePhase_h
#define Haptics_DevicePhase_h

namespace haptics
{
/// Where the thread of a device is on its way.
enum class DevicePhase
{
  Opening,
  LoadingFirmware,
  Homing, ///< waits for somebody to calibrate it
  Ready,
  Faulted
};
}

#endif
