#include "haptics/Servo/ServoStatistics.h"

#include <algorithm>
#include <numeric>

namespace haptics
{
namespace
{
constexpr double Nanosecond = 1e-9;

// One writer: see LogHistogram::Add().
template <typename T>
void Increase(std::atomic<T>& sum, T value)
{
  sum.store(sum.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
}

void Raise(std::atomic<std::uint64_t>& maximum, std::uint64_t value)
{
  if (value > maximum.load(std::memory_order_relaxed))
  {
    maximum.store(value, std::memory_order_relaxed);
  }
}
}

double Quantile(const LogHistogram::Counts& counts, double fraction)
{
  const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
  if (total == 0)
  {
    return 0.0;
  }
  const double wanted = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(total);
  std::uint64_t sum = 0;
  int bin = 0;
  do
  {
    sum += counts[static_cast<std::size_t>(bin)];
    ++bin;
  } while (bin < LogHistogram::NumberOfBins && (sum == 0 || static_cast<double>(sum) < wanted));
  return static_cast<double>(LogHistogram::LowerEdge(bin)) * Nanosecond;
}

void ServoStatistics::AddTick(std::uint64_t period, std::uint64_t work) noexcept
{
  if (this->Ticks.load(std::memory_order_relaxed) > 0)
  {
    const double seconds = static_cast<double>(period) * Nanosecond;
    Increase(this->PeriodCount, std::uint64_t{ 1 });
    Increase(this->PeriodSum, seconds);
    Increase(this->SquaredPeriodSum, seconds * seconds);
    Raise(this->LongestPeriod, period);
    this->Periods.Add(period);
  }
  Raise(this->LongestWork, work);
  this->TickTimes.Add(work);
  Increase(this->Ticks, std::uint64_t{ 1 });
}

void ServoStatistics::AddMissed(std::uint64_t count) noexcept
{
  Increase(this->Missed, count);
}

void ServoStatistics::Clear() noexcept
{
  for (std::atomic<std::uint64_t>* number :
    { &this->Ticks, &this->Missed, &this->PeriodCount, &this->LongestPeriod, &this->LongestWork })
  {
    number->store(0, std::memory_order_relaxed);
  }
  this->PeriodSum.store(0.0, std::memory_order_relaxed);
  this->SquaredPeriodSum.store(0.0, std::memory_order_relaxed);
  this->Periods.Clear();
  this->TickTimes.Clear();
}

ServoReport ServoStatistics::Report() const
{
  ServoReport report;
  report.Ticks = this->Ticks.load(std::memory_order_relaxed);
  report.MissedTicks = this->Missed.load(std::memory_order_relaxed);
  const std::uint64_t periods = this->PeriodCount.load(std::memory_order_relaxed);
  const double sum = this->PeriodSum.load(std::memory_order_relaxed);
  if (periods > 0 && sum > 0.0)
  {
    report.MeanPeriod = sum / static_cast<double>(periods);
    report.PeriodRatio = this->SquaredPeriodSum.load(std::memory_order_relaxed) / sum;
  }
  report.MaximumPeriod =
    static_cast<double>(this->LongestPeriod.load(std::memory_order_relaxed)) * Nanosecond;
  report.MaximumTickTime =
    static_cast<double>(this->LongestWork.load(std::memory_order_relaxed)) * Nanosecond;
  report.Periods = this->Periods.Copy();
  report.TickTimes = this->TickTimes.Copy();
  return report;
}
}
