#ifndef DeviceChannel_h
#define DeviceChannel_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstdint>

namespace haptics
{
/// What a device tells in one servo tick.
struct DeviceSample
{
  std::array<double, 3> Position{}; ///< HIP, device frame [m]
  std::uint32_t Buttons = 0;        ///< bit i is set while button i is held
};

/// @brief The servo thread's end of a device: plain, wait-free, no vtkObject.
///
/// A vtkHapticDevice makes one when it opens. The two calls come in this order, once a tick, from
/// the servo thread alone. Neither allocates, locks or logs.
class VTKHAPTICSDEVICES_EXPORT DeviceChannel
{
public:
  virtual ~DeviceChannel() = default;

  /// Reads the device at `time` [s] since the servo started, which only ever grows. False: the
  /// device is lost or closed; then the sample is meaningless and the servo asks for no force.
  virtual bool Read(double time, DeviceSample& sample) noexcept = 0;

  /// Asks for a force in the device frame [N], to be held until the next one.
  virtual void Write(const std::array<double, 3>& force) noexcept = 0;
};
}

#endif
