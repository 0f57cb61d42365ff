#include "ServoLoop.h"

#include "MonotonicClock.h"
#include "RealTimePriority.h"

#include <algorithm>
#include <future>
#include <system_error>
#include <utility>

namespace haptics
{
ServoLoop::ServoLoop(ServoCycle& cycle, ServoStatistics& statistics)
  : Cycle(cycle)
  , Statistics(statistics)
{
}

ServoLoop::~ServoLoop()
{
  this->Stop();
}

bool ServoLoop::Start(const ServoTiming& timing, std::string& error)
{
  this->StopRequested.store(false, std::memory_order_relaxed);
  std::promise<int> promise;
  std::future<int> priority = promise.get_future();
  try
  {
    this->Thread = std::thread(
      [this, timing, promise = std::move(promise)]() mutable
      {
        promise.set_value(timing.RealTimePriority ? RequestRealTimePriority() : 0);
        this->Run(timing);
      });
  }
  catch (const std::system_error& failure)
  {
    error = "The system gave no thread for the servo: " + std::string(failure.what());
    return false;
  }
  this->PriorityResult = priority.get();
  return true;
}

void ServoLoop::Stop()
{
  if (this->Thread.joinable())
  {
    this->StopRequested.store(true, std::memory_order_relaxed);
    this->Thread.join();
  }
}

void ServoLoop::Run(const ServoTiming& timing) noexcept
{
  const std::uint64_t start = MonotonicNow();
  std::uint64_t next = 0; // number of the deadline to wait for
  std::uint64_t last = start;
  while (true)
  {
    SleepUntil(start + next * timing.Period);
    const std::uint64_t now = MonotonicNow();
    const std::uint64_t period = now - last;
    last = now;
    if (this->StopRequested.load(std::memory_order_relaxed))
    {
      this->Cycle.End(ServoState::Stopped);
      return;
    }
    if (period > timing.StallLimit)
    {
      this->Cycle.End(ServoState::Stalled);
      return;
    }
    if (!this->Cycle.Tick(static_cast<double>(now - start) * 1e-9))
    {
      return;
    }

    const std::uint64_t end = MonotonicNow();
    this->Statistics.AddTick(period, end - now);
    const std::uint64_t upcoming = std::max(next + 1, (end - start) / timing.Period + 1);
    this->Statistics.AddMissed(upcoming - (next + 1));
    next = upcoming;
  }
}
}
