#ifndef FalconLink_h
#define FalconLink_h

#include "FalconPacket.h"
#include "LatestValue.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// What the device answered last.
struct FalconAnswer
{
  FalconReply Reply;
  double Duration = 0.0; ///< of the exchange [s]
};

/// @brief What goes wait-free between the servo thread and the thread that talks to one Falcon.
struct FalconLink
{
  /// To the servo: one at a time, newest wins.
  LatestValue<FalconAnswer> Answers;
  /// From the servo: torques in motor units, of any size; what is sent is clamped.
  LatestValue<std::array<double, 3>> Torques;
  /// True while the device is homed and answers.
  std::atomic<bool> Up{ false };
  /// What lights while the device is ready, bits of FalconLed. From the GUI.
  std::atomic<std::uint8_t> Leds{ FalconLedGreen };

  ///@{
  /// Counts since the device was opened; any thread may read them.
  std::atomic<std::uint64_t> Exchanges{ 0 };
  std::atomic<std::uint64_t> MissedReplies{ 0 };    ///< asked again, with zero torque
  std::atomic<std::uint64_t> MalformedPackets{ 0 }; ///< skipped
  std::atomic<std::uint64_t> LateCommands{ 0 };     ///< torques that were withdrawn as too old
  ///@}
};
}

#endif
