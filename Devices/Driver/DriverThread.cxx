#include "haptics/Devices/Driver/DriverThread.h"

#include "haptics/Devices/Driver/ForceExchange.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/RealTimeThread.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace haptics
{
namespace
{
using std::chrono::milliseconds;

constexpr milliseconds ReconnectPeriod{ 500 };
constexpr std::chrono::seconds LongestFarewell{ 2 };
}

/// What the thread works with; shared, so that one that hangs in a vendor's library can be given
/// up.
class DriverThread::Session final : public DriverContext
{
public:
  Session(std::unique_ptr<DeviceDriver> driver, double forceLimit, bool reconnects)
    : Driver(std::move(driver))
    , ForceLimit(forceLimit)
    , Reconnects(reconnects)
  {
  }

  void Report(DevicePhase phase, const std::string& text) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Status.Phase = phase;
    this->Status.Text = text;
  }
  void SetLimits(const DriverLimits& limits) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Status.Limits = limits;
    this->Status.Limits.MaximumForce = std::min(limits.MaximumForce, this->ForceLimit);
  }
  void CheckStop() const override
  {
    if (this->IsStopping.load(std::memory_order_relaxed))
    {
      throw DriverStopped();
    }
  }

  DriverStatus GetStatus() const
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Status;
  }
  void RequestStop()
  {
    this->IsStopping.store(true, std::memory_order_relaxed);
    this->Changed.notify_all();
  }
  /// False where the thread has not ended within the time.
  bool WaitForEnd(std::chrono::nanoseconds timeout)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    return this->Changed.wait_for(lock, timeout, [this] { return this->HasEnded; });
  }

  void Run()
  {
    LeaveEndingSignalsToOtherThreads();
    const bool isRealTime = RequestDriverPriority();
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Status.IsRealTime = isRealTime;
    }
    try
    {
      do
      {
        this->RunOnce();
      } while (this->Reconnects && this->Rest());
    }
    catch (const DriverStopped&)
    {
      // Asked for: there is nothing to report.
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->HasEnded = true;
    this->Changed.notify_all();
  }

private:
  /// Lets go of the device however its session ends.
  class SessionEnd
  {
  public:
    SessionEnd(DeviceDriver& driver, ForceLink& link)
      : Driver(driver)
      , Link(link)
    {
    }
    ~SessionEnd()
    {
      this->Link.Up.store(false, std::memory_order_release);
      this->Driver.Close();
      this->Link.Over.store(true, std::memory_order_release);
      this->Link.Bell.Ring();
    }
    SessionEnd(const SessionEnd&) = delete;
    SessionEnd& operator=(const SessionEnd&) = delete;

  private:
    DeviceDriver& Driver;
    ForceLink& Link;
  };

  void RunOnce()
  {
    try
    {
      const auto link = std::make_shared<ForceLink>();
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        this->Status.Link = link;
      }
      std::optional<ForceExchange> exchange; // outlives the driver's use of it
      const SessionEnd sessionEnd(*this->Driver, *link);
      this->Driver->Open(*this);
      this->CheckStop();
      exchange.emplace(link, this->GetStatus().Limits.MaximumForce);
      this->Driver->Serve(*exchange, *this,
        [&]
        {
          link->Up.store(true, std::memory_order_release);
          this->Report(DevicePhase::Ready, this->GetStatus().Limits.Name + " is ready.");
        });
    }
    catch (const DeviceFault& fault)
    {
      this->Report(DevicePhase::Faulted, fault.what());
    }
  }

  /// Always true; throws DriverStopped where there is no next time.
  bool Rest()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Changed.wait_for(lock, ReconnectPeriod, [this] { return this->IsStopping.load(); });
    this->CheckStop();
    return true;
  }

  const std::unique_ptr<DeviceDriver> Driver;
  const double ForceLimit;
  const bool Reconnects;
  std::atomic<bool> IsStopping{ false };
  mutable std::mutex Mutex;
  std::condition_variable Changed;
  DriverStatus Status;
  bool HasEnded = false;
};

DriverThread::DriverThread(std::unique_ptr<DeviceDriver> driver, double forceLimit, bool reconnects)
  : Work(std::make_shared<Session>(std::move(driver), forceLimit, reconnects))
  , Thread([work = this->Work] { work->Run(); })
{
}

DriverThread::~DriverThread()
{
  if (!this->Owner.IsHere())
  {
    GiveUp(this->Thread);
    new std::shared_ptr<Session>(this->Work); // its mutex may be locked for ever
    return;
  }
  this->RequestStop();
  if (this->Work->WaitForEnd(LongestFarewell))
  {
    this->Thread.join();
  }
  else
  {
    this->Thread.detach();
  }
}

void DriverThread::RequestStop()
{
  this->Work->RequestStop();
}

DriverStatus DriverThread::GetStatus() const
{
  return this->Work->GetStatus();
}
}
