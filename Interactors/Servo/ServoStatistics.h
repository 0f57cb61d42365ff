#ifndef Haptics_ServoStatistics_h
#define Haptics_ServoStatistics_h

#include "haptics/Servo/LogHistogram.h"
#include "vtkHapticsServoModule.h"

#include <atomic>
#include <cstdint>

namespace haptics
{
/// @brief How regular a servo was, at one moment. All times in seconds.
///
/// A period T is the time from the start of a tick to the start of the next. What a period does to
/// stability is not its mean: a spring K in a device of damping b stays passive for
/// K <= 2 b E[T] / E[T^2], so PeriodRatio is the "T" to design with, and MaximumPeriod the worst.
struct VTKHAPTICSSERVO_EXPORT ServoReport
{
  std::uint64_t Ticks = 0;
  std::uint64_t MissedTicks = 0; ///< deadlines that passed without a tick
  double MeanPeriod = 0.0;       ///< E[T]; 0 before the second tick, as the next two
  double PeriodRatio = 0.0;      ///< E[T^2] / E[T]
  double MaximumPeriod = 0.0;    ///< T_max
  double MaximumTickTime = 0.0;  ///< the longest work of one tick

  LogHistogram::Counts Periods{};   ///< in the bins of LogHistogram
  LogHistogram::Counts TickTimes{}; ///< in the bins of LogHistogram

  /// Ticks a second: 1 / E[T]; 0 before the second tick.
  double Rate() const { return this->MeanPeriod > 0.0 ? 1.0 / this->MeanPeriod : 0.0; }
};

/// The duration [s] that a share of `fraction` (0 to 1) of the counts does not exceed, rounded up
/// to its bin's end, at most 3.2 % more; 0 where nothing was counted. Any thread.
VTKHAPTICSSERVO_EXPORT double Quantile(const LogHistogram::Counts& counts, double fraction);

/// @brief Gathers the regularity of a servo, wait-free, while any thread looks on.
///
/// Each number in a report is exact; in one taken while the servo runs they may be a tick apart.
class VTKHAPTICSSERVO_EXPORT ServoStatistics
{
public:
  /// Counts a tick: how long after the start of the one before it started, and how long it worked
  /// [ns]. The first tick has no period: give 0. Servo thread.
  void AddTick(std::uint64_t period, std::uint64_t work) noexcept;
  /// Counts deadlines that passed without a tick. Servo thread.
  void AddMissed(std::uint64_t count) noexcept;
  /// Starts anew. GUI thread, while no servo runs.
  void Clear() noexcept;
  /// Any thread.
  ServoReport Report() const;

private:
  std::atomic<std::uint64_t> Ticks{ 0 };
  std::atomic<std::uint64_t> Missed{ 0 };
  std::atomic<std::uint64_t> PeriodCount{ 0 };
  std::atomic<double> PeriodSum{ 0.0 };          // [s]
  std::atomic<double> SquaredPeriodSum{ 0.0 };   // [s^2]
  std::atomic<std::uint64_t> LongestPeriod{ 0 }; // [ns]
  std::atomic<std::uint64_t> LongestWork{ 0 };   // [ns]
  LogHistogram Periods;
  LogHistogram TickTimes;
};
}

#endif
