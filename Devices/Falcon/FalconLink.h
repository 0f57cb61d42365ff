#ifndef Haptics_FalconLink_h
#define Haptics_FalconLink_h

#include "haptics/Devices/Falcon/FalconPacket.h"
#include "haptics/Devices/LatestValue.h"

#include <semaphore.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace haptics
{
/// @brief Wakes one thread that sleeps; ringing never waits.
class AnswerBell
{
public:
  AnswerBell() { sem_init(&this->Semaphore, 0, 0); }
  ~AnswerBell() { sem_destroy(&this->Semaphore); }
  AnswerBell(const AnswerBell&) = delete;
  AnswerBell& operator=(const AnswerBell&) = delete;

  void Ring() noexcept { sem_post(&this->Semaphore); }
  /// False where it did not ring until the monotonic clock shows `deadline`. Takes one ring.
  bool WaitUntil(const timespec& deadline) noexcept
  {
    int result = 0;
    do
    {
      result = sem_clockwait(&this->Semaphore, CLOCK_MONOTONIC, &deadline);
    } while (result != 0 && errno == EINTR);
    return result == 0;
  }

private:
  sem_t Semaphore;
};

/// @brief How long exchanges took: counts in bins of 20 us, longer ones in the last bin.
class ExchangeTimes
{
public:
  static constexpr double BinWidth = 20e-6; ///< [s]

  /// One thread.
  void Add(double duration) noexcept
  {
    const double bin = duration / BinWidth;
    const std::size_t last = this->Bins.size() - 1;
    std::atomic<std::uint32_t>& count =
      this->Bins[bin < static_cast<double>(last) ? static_cast<std::size_t>(bin) : last];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  /// The time [s], up to a bin, within which this share of them was over; 0 before the first. Any
  /// thread.
  double Within(double share) const noexcept
  {
    std::uint64_t total = 0;
    for (const auto& bin : this->Bins)
    {
      total += bin.load(std::memory_order_relaxed);
    }
    std::uint64_t passed = 0;
    std::size_t bins = 0;
    while (
      bins < this->Bins.size() && static_cast<double>(passed) < share * static_cast<double>(total))
    {
      passed += this->Bins[bins++].load(std::memory_order_relaxed);
    }
    return static_cast<double>(bins) * BinWidth;
  }

private:
  std::array<std::atomic<std::uint32_t>, 1000> Bins{};
};

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
