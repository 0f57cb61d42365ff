#ifndef Haptics_ServoLoop_h
#define Haptics_ServoLoop_h

#include "haptics/Devices/ProcessOwner.h"
#include "haptics/Servo/ServoCycle.h"
#include "haptics/Servo/ServoStatistics.h"
#include "vtkHapticsServoModule.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace haptics
{
class Watchdog;

/// How a servo thread keeps time.
struct ServoTiming
{
  std::uint64_t Period = 1000000;        ///< [ns], > 0
  std::uint64_t WatchdogTime = 25000000; ///< [ns] that a tick may be due: then no force
  std::uint64_t StallLimit = 500000000;  ///< [ns], > Period: a longer gap between ticks is a fault
  double MissedShare = 0.5;              ///< of deadlines that may be missed, see OverrunBudget
  bool RealTimePriority = true;          ///< ask the system for it
};

/// @brief Runs a ServoCycle on its own thread, at absolute deadlines.
///
///     deadlines  |----|----|----|----|----|----|
///     ticks      x    x     x==========x  x    x
///                             ^^^^ passed: counted as missed, never made up for in a burst
///
/// The deadlines are a grid from the start on, so that delays do not add up. What a late tick
/// costs:
///
/// | late by            | what happens                                                         |
/// |--------------------|----------------------------------------------------------------------|
/// | a few periods      | deadlines are counted as missed; the stiffness limit falls           |
/// | WatchdogTime       | the device is halted: no force at once; then it grows softly         |
/// | MissedShare, ~1 s  | the run ends: ServoState::Overrun                                    |
/// | StallLimit         | the run ends: ServoState::Stalled                                    |
///
/// A device that sets the pace (DeviceChannel::SetsPace) is waited for instead of the clock; the
/// deadlines then are what its ticks are counted against, and one of them may be early by a period.
/// GUI thread.
class VTKHAPTICSSERVO_EXPORT ServoLoop
{
public:
  /// Both must outlive the loop.
  ServoLoop(ServoCycle& cycle, ServoStatistics& statistics);
  /// Stops.
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// Starts the thread on a cycle that has begun. False, with the cause in `error`, where the
  /// system gives no thread. Stop() first.
  bool Start(const ServoTiming& timing, std::string& error);
  /// Asks for zero force, ends the thread and waits for that: about a period, and until the device
  /// has got the zero, see ServoCycle::End(). Does nothing where there is no thread. In a child of
  /// fork() the thread is the parent's, and goes on there.
  void Stop();
  /// Whether a thread was started by a process of which this one is a child by fork().
  bool IsParents() const { return this->Thread.joinable() && !this->Owner->IsHere(); }
  /// 0 where the thread of the last start got real-time priority, else the errno that says why
  /// not; meaningful where it was asked for.
  int GetPriorityResult() const { return this->PriorityResult; }
  /// How often the watchdog has halted the device in this run. Any thread.
  std::uint64_t GetNumberOfHalts() const;

private:
  // Periods that a device which sets the pace may stay silent before it is asked all the same.
  static constexpr std::uint64_t DevicePatience = 4;

  void Run(const ServoTiming& timing) noexcept;
  void Wait(const ServoTiming& timing, std::uint64_t deadline) noexcept;

  ServoCycle& Cycle;
  ServoStatistics& Statistics;
  std::unique_ptr<Watchdog> Guardian;
  std::thread Thread;
  std::unique_ptr<const ProcessOwner> Owner; ///< of Thread
  std::atomic<std::uint64_t> Halts{ 0 };
  std::atomic<bool> StopRequested{ false };
  int PriorityResult = 0;
};
}

#endif
