#include "haptics/Servo/LogHistogram.h"
#include "haptics/Servo/ServoStatistics.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

using haptics::LogHistogram;
using haptics::ServoReport;
using haptics::ServoStatistics;

namespace
{
std::uint64_t Total(const LogHistogram::Counts& counts)
{
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 });
}

TEST(LogHistogram, PutsEveryDurationBetweenTheEdgesOfItsBin)
{
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i)
  {
    const std::uint64_t duration = random() >> (24 + random() % 40); // below 2^40, all sizes
    const int bin = LogHistogram::Bin(duration);
    ASSERT_GE(duration, LogHistogram::LowerEdge(bin));
    ASSERT_LT(duration, LogHistogram::LowerEdge(bin + 1));
  }
}

TEST(LogHistogram, HasEdgesThatIncreaseByAtMostOnePartIn32)
{
  for (int bin = 0; bin < LogHistogram::NumberOfBins; ++bin)
  {
    const std::uint64_t low = LogHistogram::LowerEdge(bin);
    const std::uint64_t high = LogHistogram::LowerEdge(bin + 1);
    ASSERT_GT(high, low);
    ASSERT_LE(high - low, std::max<std::uint64_t>(1, low / 32));
    ASSERT_EQ(LogHistogram::Bin(low), bin);
    ASSERT_EQ(LogHistogram::Bin(high - 1), bin);
  }
}

TEST(LogHistogram, CountsWhatIsTooLongInItsLastBin)
{
  const int last = LogHistogram::NumberOfBins - 1;
  EXPECT_EQ(LogHistogram::Bin(LogHistogram::LowerEdge(last + 1)), last);
  EXPECT_EQ(LogHistogram::Bin(~std::uint64_t{ 0 }), last);
}

TEST(ServoStatistics, AreZeroBeforeTheFirstTick)
{
  const ServoReport report = ServoStatistics().Report();
  EXPECT_EQ(report.Ticks, 0u);
  EXPECT_EQ(report.Rate(), 0.0);
  EXPECT_EQ(report.PeriodRatio, 0.0);
  EXPECT_EQ(haptics::Quantile(report.Periods, 0.5), 0.0);
}

TEST(ServoStatistics, GiveTheMomentsOfThePeriods)
{
  ServoStatistics statistics;
  statistics.AddTick(0, 10); // the first has no period
  for (const std::uint64_t period : { 1000000, 1000000, 4000000 })
  {
    statistics.AddTick(period, 10);
  }
  statistics.AddMissed(3);
  const ServoReport report = statistics.Report();
  EXPECT_EQ(report.Ticks, 4u);
  EXPECT_EQ(report.MissedTicks, 3u);
  EXPECT_EQ(Total(report.Periods), 3u);
  EXPECT_EQ(Total(report.TickTimes), 4u);
  const double rounding = 1e-15;
  EXPECT_NEAR(report.MeanPeriod, 2e-3, rounding);
  EXPECT_NEAR(report.PeriodRatio, (1.0 + 1.0 + 16.0) / 6.0 * 1e-3, rounding);
  EXPECT_NEAR(report.MaximumPeriod, 4e-3, rounding);
  EXPECT_NEAR(report.Rate(), 500.0, 1e-9);
}

TEST(ServoStatistics, GiveQuantilesWithinABinAndNeverTooShort)
{
  ServoStatistics statistics;
  for (int i = 1; i <= 1000; ++i)
  {
    statistics.AddTick(1000000, static_cast<std::uint64_t>(i) * 1000); // 1 to 1000 us
  }
  const ServoReport report = statistics.Report();
  for (const double fraction : { 0.001, 0.5, 0.99, 0.999, 1.0 })
  {
    const double exact = fraction * 1e-3;
    const double quantile = haptics::Quantile(report.TickTimes, fraction);
    EXPECT_GE(quantile, exact * 0.9999999);
    EXPECT_LE(quantile, exact * 1.0325) << "a bin is 1/32 wide";
  }
  EXPECT_NEAR(report.MaximumTickTime, 1e-3, 1e-15);
}

TEST(ServoStatistics, StartAnewAfterClear)
{
  ServoStatistics statistics;
  statistics.AddTick(0, 10);
  statistics.AddTick(1000000, 10);
  statistics.AddMissed(1);
  statistics.Clear();
  const ServoReport report = statistics.Report();
  EXPECT_EQ(
    report.Ticks + report.MissedTicks + Total(report.Periods) + Total(report.TickTimes), 0u);
  EXPECT_EQ(report.MeanPeriod, 0.0);
  EXPECT_EQ(report.MaximumPeriod, 0.0);
}
}
