#ifndef Haptics_FalconLink_h
#define Haptics_FalconLink_h

#include "haptics/Devices/AnswerBell.h"
#include "haptics/Devices/ExchangeTimes.h"
#include "haptics/Devices/Falcon/FalconPacket.h"
#include "haptics/Devices/LatestValue.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// What the device told, and what the servo is to know of how it came.
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

/// @brief What goes wait-free between the servo thread and the thread that talks to one Falcon.
struct FalconLink
{
  /// To the servo: one at a time, newest wins.
  LatestValue<FalconAnswer> Answers;
  /// From the servo.
  LatestValue<FalconDemand> Demands;
  /// How often a watchdog let go of all force: what was asked for before does not count any more.
  std::atomic<std::uint64_t> Halts{ 0 };
  /// Posted with every answer, and at the end.
  AnswerBell Bell;
  /// True while the device is homed and answers.
  std::atomic<bool> Up{ false };
  /// True from when the device has been let go of: it gets nothing through this link any more.
  std::atomic<bool> Over{ false };
  /// What lights while the device is ready, bits of FalconLed. From the GUI.
  std::atomic<std::uint8_t> Leds{ FalconLedGreen };

  ///@{
  /// Counts since the device was opened; any thread may read them.
  std::atomic<std::uint64_t> Exchanges{ 0 };
  std::atomic<std::uint64_t> MissedReplies{ 0 };    ///< asked again, with zero torque
  std::atomic<std::uint64_t> MalformedPackets{ 0 }; ///< skipped
  std::atomic<std::uint64_t> LateCommands{ 0 };     ///< torques that were withdrawn as too old
  ExchangeTimes Times;                              ///< while ready
  ///@}
};
}

#endif
