#ifndef Haptics_Watchdog_h
#define Haptics_Watchdog_h

#include "vtkHapticsServoModule.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

namespace haptics
{
class DeviceChannel;

/// @brief Takes the force from a device whose servo hangs.
///
/// The servo thread shows with Feed() that it lives. Where it has not for the time limit, a thread
/// of the watchdog's own halts the channel: no force is left in the hand although the servo cannot
/// write. It also keeps the process's signals, see EmergencyStop. The servo finds out with
/// TakeBite() once it goes on.
class VTKHAPTICSSERVO_EXPORT Watchdog
{
public:
  /// Watches from now on; `limit` [ns], > 0. Throws std::system_error where there is no thread.
  Watchdog(DeviceChannel& channel, std::uint64_t limit);
  /// Ends its thread; a channel that is halted stays so.
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  ///@{
  /// Servo thread, wait-free.
  void Feed() noexcept { this->Fed.store(this->NextFeed++, std::memory_order_release); }
  /// True once after each time that it has halted the channel.
  bool TakeBite() noexcept
  {
    return this->Bitten.load(std::memory_order_relaxed) &&
      this->Bitten.exchange(false, std::memory_order_acq_rel);
  }
  ///@}

private:
  void Run();

  DeviceChannel& Channel;
  const std::uint64_t Limit;
  std::atomic<std::uint64_t> Fed{ 0 };
  std::uint64_t NextFeed = 1;
  std::atomic<bool> Bitten{ false };
  std::mutex Mutex;
  std::condition_variable Ending;
  bool End = false;
  std::thread Thread;
};
}

#endif
