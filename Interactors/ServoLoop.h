#ifndef ServoLoop_h
#define ServoLoop_h

#include "ServoCycle.h"
#include "ServoStatistics.h"
#include "vtkHapticsInteractorsModule.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace haptics
{
/// How a servo thread keeps time.
struct ServoTiming
{
  std::uint64_t Period = 1000000;       ///< [ns], > 0
  std::uint64_t StallLimit = 500000000; ///< [ns], > Period: a longer gap between ticks is a fault
  bool RealTimePriority = true;         ///< ask the system for it
};

/// @brief Runs a ServoCycle on its own thread, at absolute deadlines.
///
///     deadlines  |----|----|----|----|----|----|
///     ticks      x    x     x==========x  x    x
///                             ^^^^ passed: counted as missed, never made up for in a burst
///
/// The deadlines are a grid from the start on, so that delays do not add up. GUI thread.
class VTKHAPTICSINTERACTORS_EXPORT ServoLoop
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
  /// Asks for zero force, ends the thread and waits for that: about a period. Does nothing where
  /// there is none.
  void Stop();
  /// 0 where the thread of the last start got real-time priority, else the errno that tells why
  /// not; meaningful where it was asked for.
  int GetPriorityResult() const { return this->PriorityResult; }

private:
  void Run(const ServoTiming& timing) noexcept;

  ServoCycle& Cycle;
  ServoStatistics& Statistics;
  std::thread Thread;
  std::atomic<bool> StopRequested{ false };
  int PriorityResult = 0;
};
}

#endif
