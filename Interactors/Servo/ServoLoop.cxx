#include "haptics/Servo/ServoLoop.h"

#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/MonotonicClock.h"
#include "haptics/Servo/EmergencyStop.h"
#include "haptics/Servo/OverrunBudget.h"
#include "haptics/Servo/RealTimePriority.h"
#include "haptics/Servo/SleepUntil.h"
#include "haptics/Servo/Watchdog.h"

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
  EmergencyStop::Install();
  this->Owner = std::make_unique<const ProcessOwner>();
  std::promise<int> promise;
  std::future<int> priority = promise.get_future();
  try
  {
    // A servo that is in time feeds it once a period.
    this->Guardian =
      std::make_unique<Watchdog>(this->Cycle.GetChannel(), timing.Period + timing.WatchdogTime);
    this->Thread = std::thread(
      [this, timing, promise = std::move(promise)]() mutable
      {
        LeaveEndingSignalsToOtherThreads();
        promise.set_value(timing.RealTimePriority ? RequestRealTimePriority(Urgency::Servo) : 0);
        this->Run(timing);
      });
  }
  catch (const std::system_error& failure)
  {
    this->Guardian.reset();
    error = "The system gave no thread for the servo: " + std::string(failure.what());
    return false;
  }
  this->PriorityResult = priority.get();
  return true;
}

void ServoLoop::Stop()
{
  if (this->IsParents())
  {
    GiveUp(this->Thread);
    (void)this->Guardian.release(); // it has a thread too
    this->Cycle.End(ServoState::Stopped);
    return;
  }
  if (this->Thread.joinable())
  {
    this->StopRequested.store(true, std::memory_order_relaxed);
    this->Thread.join();
    this->Guardian.reset();
  }
}

std::uint64_t ServoLoop::GetNumberOfHalts() const
{
  return this->Halts.load(std::memory_order_relaxed);
}

void ServoLoop::Run(const ServoTiming& timing) noexcept
{
  const EmergencyStop emergency(this->Cycle);
  OverrunBudget budget(timing.MissedShare, timing.Period);
  this->Halts.store(0, std::memory_order_relaxed);
  std::uint64_t start = MonotonicNow();
  std::uint64_t next = 0; // number of the deadline to wait for
  std::uint64_t last = start;
  while (true)
  {
    this->Wait(timing, start + next * timing.Period);
    const std::uint64_t now = MonotonicNow();
    const std::uint64_t period = now - last;
    last = now;
    if (this->StopRequested.load(std::memory_order_relaxed))
    {
      this->Cycle.End(ServoState::Stopped);
      return;
    }
    if (emergency.IsRequested())
    {
      this->Cycle.End(ServoState::Interrupted);
      return;
    }
    if (EmergencyStop::IsSuspended())
    {
      // The process stops: no force, and no time passes for what comes after.
      this->Cycle.Suspend();
      emergency.Hold();
      this->Cycle.Resume();
      const std::uint64_t passed = MonotonicNow() - now;
      start += passed;
      last += passed;
      this->Guardian->Feed();
      continue;
    }
    if (period > timing.StallLimit)
    {
      this->Cycle.End(ServoState::Stalled);
      return;
    }
    if (this->Guardian->TakeBite())
    {
      this->Halts.store(this->Halts.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      this->Cycle.Resume();
    }
    if (!this->Cycle.Tick(static_cast<double>(now - start) * 1e-9))
    {
      return;
    }
    this->Guardian->Feed();

    const std::uint64_t end = MonotonicNow();
    this->Statistics.AddTick(period, end - now);
    // A device that sets the pace may be early, but not put by ticks for times when it is silent.
    const std::uint64_t passed = (end - start) / timing.Period;
    const std::uint64_t upcoming = std::clamp(next + 1, passed + 1, passed + 2);
    const std::uint64_t missed = upcoming - std::min(upcoming, next + 1);
    this->Statistics.AddMissed(missed);
    if (!budget.Add(upcoming - next, missed))
    {
      this->Cycle.End(ServoState::Overrun);
      return;
    }
    next = upcoming;
  }
}

void ServoLoop::Wait(const ServoTiming& timing, std::uint64_t deadline) noexcept
{
  DeviceChannel& channel = this->Cycle.GetChannel();
  if (channel.SetsPace())
  {
    // A device that stays silent is read all the same: that shows whether it is lost.
    channel.WaitForSample(DevicePatience * timing.Period);
  }
  else
  {
    SleepUntil(deadline);
  }
}
}
