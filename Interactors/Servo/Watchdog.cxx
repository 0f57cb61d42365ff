#include "haptics/Servo/Watchdog.h"

#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Servo/EmergencyStop.h"
#include "haptics/Servo/RealTimePriority.h"

#include <algorithm>
#include <chrono>

namespace haptics
{
Watchdog::Watchdog(DeviceChannel& channel, std::uint64_t limit)
  : Channel(channel)
  , Limit(limit)
  , Thread([this] { this->Run(); })
{
}

Watchdog::~Watchdog()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->End = true;
  }
  this->Ending.notify_one();
  this->Thread.join();
}

void Watchdog::Run()
{
  LeaveEndingSignalsToOtherThreads();
  RequestRealTimePriority(Urgency::AboveServo);
  // Four looks a limit: it bites after 1 to 1.25 limits.
  const auto look = std::min<std::chrono::nanoseconds>(
    std::chrono::nanoseconds(this->Limit / 4 + 1), std::chrono::milliseconds(50));
  const auto limit = std::chrono::nanoseconds(this->Limit);
  std::uint64_t seen = this->Fed.load(std::memory_order_acquire);
  auto since = std::chrono::steady_clock::now();
  bool isBiting = false;
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (!this->Ending.wait_for(lock, look, [this] { return this->End; }))
  {
    EmergencyStop::KeepSignals();
    const auto now = std::chrono::steady_clock::now();
    const std::uint64_t fed = this->Fed.load(std::memory_order_acquire);
    if (fed != seen)
    {
      seen = fed;
      since = now;
      isBiting = false;
    }
    else if (!isBiting && now - since >= limit)
    {
      isBiting = true;
      // Halted first: whoever learns of the bite may resume.
      this->Channel.Halt();
      this->Bitten.store(true, std::memory_order_release);
    }
  }
}
}
