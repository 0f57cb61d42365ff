#ifndef Haptics_FalconLink_h
#define Haptics_FalconLink_h

#include "haptics/Devices/DeviceLink.h"
#include "haptics/Devices/Falcon/FalconPacket.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// What the device reported, and how the answer came.
struct FalconAnswer
{
  FalconReply Reply;
  std::uint64_t Releases = 0; ///< how often the transport had let go of all force by itself
  double Age = 0.0;           ///< of the encoders' counts when they came, at most [s]
};

/// What the servo asks for.
struct FalconDemand
{
  std::array<double, 3> Torques{}; ///< motor units of any size; what is sent is clamped
  ///@{
  /// Those that the servo knew of. A force that was asked for before the last one is not sent.
  std::uint64_t Halts = 0;
  std::uint64_t Releases = 0;
  ///@}
};

/// What goes wait-free between the servo thread and the thread that talks to one Falcon.
struct FalconLink : DeviceLink<FalconAnswer, FalconDemand>
{
  /// What lights while the device is ready, bits of FalconLed. From the GUI.
  std::atomic<std::uint8_t> Leds{ FalconLedGreen };

  ///@{
  /// Counts since the device was opened; any thread may read them.
  std::atomic<std::uint64_t> MissedReplies{ 0 };    ///< asked again, with zero torque
  std::atomic<std::uint64_t> MalformedPackets{ 0 }; ///< skipped
  ///@}
};
}

#endif
