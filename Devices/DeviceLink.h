#ifndef Haptics_DeviceLink_h
#define Haptics_DeviceLink_h

#include "haptics/Devices/AnswerBell.h"
#include "haptics/Devices/ExchangeTimes.h"
#include "haptics/Devices/LatestValue.h"

#include <atomic>
#include <cstdint>

namespace haptics
{
/// Counts since a device was opened; any thread may read them.
struct LinkCounts
{
  std::atomic<std::uint64_t> Exchanges{ 0 };
  std::atomic<std::uint64_t> LateCommands{ 0 }; ///< forces that were withdrawn as too old
  ExchangeTimes Times;                          ///< while ready
};

/// @brief What goes wait-free between the servo thread and the thread that talks to one device.
///
/// An Answer has `Releases`, how often that thread had let go of all force by itself, and `Age`, of
/// the sample when it came, at most [s]. A Demand has what is asked for, then the `Halts` and
/// `Releases` that the servo knew of: a force that was asked for before the last one is not sent.
template <class Answer, class Demand>
struct DeviceLink : LinkCounts
{
  LatestValue<Answer> Answers; ///< to the servo: one at a time, newest wins
  LatestValue<Demand> Demands; ///< from the servo
  /// How often a watchdog let go of all force: what was asked for before does not count any more.
  std::atomic<std::uint64_t> Halts{ 0 };
  AnswerBell Bell;               ///< rings with every answer, and at the end
  std::atomic<bool> Up{ false }; ///< the device is ready, answers and takes forces
  /// The device has been let go of: it gets nothing through this link any more.
  std::atomic<bool> Over{ false };
};
}

#endif
