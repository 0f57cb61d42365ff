#ifndef Haptics_ForceLink_h
#define Haptics_ForceLink_h

#include "haptics/Devices/DeviceLink.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// What a device reports in one exchange.
struct DriverSample
{
  std::array<double, 3> Position{}; ///< HIP, device frame [m]
  std::uint32_t Buttons = 0;        ///< bit i is set while button i is held
  /// Of the grip, device frame: quaternion w, x, y, z. Unit; as it is at rest where the device does
  /// not measure it.
  std::array<double, 4> Orientation{ { 1.0, 0.0, 0.0, 0.0 } };
};

/// What the servo gets of an exchange.
struct LinkAnswer
{
  DriverSample Sample;
  std::uint64_t Releases = 0; ///< how often the driver had let go of all force by itself
  double Age = 0.0;           ///< of the sample when it came, at most [s]
};

/// What the servo asks for.
struct LinkDemand
{
  std::array<double, 3> Force{}; ///< device frame [N]
  ///@{
  /// Those that the servo knew of. A force that was asked for before the last one is not sent.
  std::uint64_t Halts = 0;
  std::uint64_t Releases = 0;
  ///@}
};

/// What goes wait-free between the servo thread and the thread that talks to one device.
struct ForceLink : DeviceLink<LinkAnswer, LinkDemand>
{
  LatestValue<DriverSample> Shown;          ///< to the GUI
  std::atomic<std::uint64_t> Releases{ 0 }; ///< forces that the driver let go of by itself
};
}

#endif
