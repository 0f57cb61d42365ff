#include "ServoTestTools.h"
#include "haptics/Servo/ServoLoop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>

using haptics::ServoCycle;
using haptics::ServoLoop;
using haptics::ServoReport;
using haptics::ServoState;
using haptics::ServoStatistics;
using haptics::ServoTiming;
using haptics::TickRecord;

// No test here asserts how fast or regular this machine is: only what must hold on any.
namespace
{
/// A servo of plain parts, on a plane at z = 0.
struct Servo
{
  ServoCycle Cycle{ 65536 };
  ServoStatistics Statistics;
  ServoLoop Loop{ this->Cycle, this->Statistics };

  Servo() { this->Cycle.GetExchange().Publish(MakeGodObject(MakePlane())); }

  void Start(std::shared_ptr<haptics::DeviceChannel> channel, const ServoTiming& timing)
  {
    this->Cycle.Begin(std::move(channel), ServoState::Running);
    std::string error;
    ASSERT_TRUE(this->Loop.Start(timing, error)) << error;
  }

  /// Waits until it has ticked so often, or has ended.
  void WaitForTicks(std::uint64_t ticks)
  {
    while (this->Statistics.Report().Ticks < ticks && this->Cycle.GetState() == ServoState::Running)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
};

ServoTiming PatientTiming()
{
  ServoTiming timing;
  // A busy machine is no fault in a test.
  timing.StallLimit = 60000000000;
  timing.WatchdogTime = 60000000000;
  timing.MissedShare = 60.0;
  return timing;
}

/// Ticks come in order, none before its deadline and no two in the same period.
void ExpectOnTheGrid(const std::vector<TickRecord>& records, const ServoTiming& timing)
{
  const double period = static_cast<double>(timing.Period) * 1e-9;
  const double rounding = 1e-9;
  double lastSlot = -1.0;
  for (const TickRecord& record : records)
  {
    ASSERT_GE(record.Time, static_cast<double>(record.Tick) * period - rounding);
    const double slot = std::floor((record.Time + rounding) / period);
    ASSERT_GT(slot, lastSlot) << "tick " << record.Tick << " is part of a burst";
    lastSlot = slot;
  }
}

TEST(ServoLoop, TicksOnTheGridAndTouchesThePlane)
{
  Servo servo;
  const auto channel = MakePressingHand(0.002);
  const ServoTiming timing = PatientTiming();
  servo.Start(channel, timing);
  servo.WaitForTicks(300);
  servo.Loop.Stop();

  EXPECT_EQ(servo.Cycle.GetState(), ServoState::Stopped);
  EXPECT_EQ(channel->LastForce, NoForce);
  std::vector<TickRecord> records;
  servo.Cycle.Drain(records);
  ASSERT_GE(records.size(), 300u);
  ExpectOnTheGrid(records, timing);
  EXPECT_NEAR(records.back().Force[2], 1.0, 2e-3) << "500 N/m, 2 mm deep";
}

TEST(ServoLoop, HasStatisticsThatAgreeWithItsRecords)
{
  Servo servo;
  const ServoTiming timing = PatientTiming();
  servo.Start(MakePressingHand(0.002), timing);
  servo.WaitForTicks(1000);
  servo.Loop.Stop();

  std::vector<TickRecord> records;
  servo.Cycle.Drain(records);
  const ServoReport report = servo.Statistics.Report();
  ASSERT_EQ(report.Ticks, records.size());
  const auto total = [](const haptics::LogHistogram::Counts& counts)
  { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{ 0 }); };
  EXPECT_EQ(total(report.Periods), report.Ticks - 1);
  EXPECT_EQ(total(report.TickTimes), report.Ticks);

  double sum = 0.0;
  double squares = 0.0;
  double longest = 0.0;
  for (std::size_t i = 1; i < records.size(); ++i)
  {
    const double period = records[i].Time - records[i - 1].Time;
    sum += period;
    squares += period * period;
    longest = std::max(longest, period);
  }
  const double rounding = 1e-9; // relative: sums of a thousand periods, and of nanoseconds
  EXPECT_NEAR(report.MeanPeriod, sum / static_cast<double>(records.size() - 1), rounding);
  EXPECT_NEAR(report.PeriodRatio, squares / sum, rounding);
  EXPECT_NEAR(report.MaximumPeriod, longest, rounding);
  EXPECT_GE(report.PeriodRatio, report.MeanPeriod) << "by Cauchy and Schwarz";
  EXPECT_GE(haptics::Quantile(report.Periods, 1.0), report.MaximumPeriod);

  // Every deadline of the run had its tick or was counted as missed.
  const double period = static_cast<double>(timing.Period) * 1e-9;
  const double deadlines = std::floor(records.back().Time / period);
  EXPECT_GE(static_cast<double>(report.Ticks + report.MissedTicks) + 0.5, deadlines);
}

TEST(ServoLoop, CountsDeadlinesMissedInASlowTickAndDoesNotCatchUpInABurst)
{
  Servo servo;
  auto channel = MakePressingHand(0.002);
  const auto press = channel->Hand;
  int ticks = 0;
  channel->Hand = [&ticks, press](double time, haptics::DeviceSample& sample)
  {
    if (++ticks == 50)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    return press(time, sample);
  };
  const ServoTiming timing = PatientTiming();
  servo.Start(channel, timing);
  servo.WaitForTicks(150);
  servo.Loop.Stop();
  std::vector<TickRecord> records;
  servo.Cycle.Drain(records);
  ExpectOnTheGrid(records, timing);
  EXPECT_GE(servo.Statistics.Report().MissedTicks, 29u) << "30 ms of a 1 ms grid";
  EXPECT_GE(servo.Statistics.Report().MaximumPeriod, 0.030);
  EXPECT_GE(servo.Statistics.Report().MaximumTickTime, 0.030);
}

TEST(ServoLoop, AsksForNoForceAfterAStall)
{
  Servo servo;
  auto channel = MakePressingHand(0.002);
  const auto press = channel->Hand;
  int ticks = 0;
  channel->Hand = [&ticks, press](double time, haptics::DeviceSample& sample)
  {
    if (++ticks == 200)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(600));
    }
    return press(time, sample);
  };
  ServoTiming timing = PatientTiming();
  timing.StallLimit = 400000000;
  servo.Start(channel, timing);
  servo.WaitForTicks(100000);
  servo.Loop.Stop();
  EXPECT_EQ(servo.Cycle.GetState(), ServoState::Stalled);
  EXPECT_EQ(channel->LastForce, NoForce);
}

TEST(ServoLoop, EndsByItselfWithoutForceWhenTheDeviceIsLost)
{
  Servo servo;
  auto channel = MakePressingHand(0.002);
  const auto press = channel->Hand;
  std::atomic<bool> plugged{ true };
  channel->Hand = [&plugged, press](double time, haptics::DeviceSample& sample)
  { return press(time, sample) && plugged; };
  servo.Start(channel, PatientTiming());
  servo.WaitForTicks(100);
  plugged = false;
  servo.WaitForTicks(1000000);
  EXPECT_EQ(servo.Cycle.GetState(), ServoState::DeviceLost);
  servo.Loop.Stop();
  EXPECT_EQ(servo.Cycle.GetState(), ServoState::DeviceLost) << "stopping does not hide the cause";
  EXPECT_EQ(channel->LastForce, NoForce);
}

TEST(ServoLoop, AsksForNoForceWhenItIsDestroyed)
{
  const auto channel = MakePressingHand(0.002);
  {
    Servo servo;
    servo.Start(channel, PatientTiming());
    servo.WaitForTicks(150);
  }
  EXPECT_EQ(channel->LastForce, NoForce);
}

TEST(ServoLoop, CanBeStartedAgainAndAgain)
{
  Servo servo;
  for (int i = 0; i < 20; ++i)
  {
    servo.Statistics.Clear();
    servo.Start(MakePressingHand(0.002), PatientTiming());
    servo.WaitForTicks(3);
    EXPECT_GE(servo.Statistics.Report().Ticks, 3u);
    servo.Loop.Stop();
    servo.Loop.Stop();
  }
}

TEST(ServoLoop, TakesSurfacesAndSettingsAndGivesItsStateWhileItRuns)
{
  Servo servo;
  ServoTiming timing = PatientTiming();
  timing.Period = 100000;
  const auto channel = MakePressingHand(0.002);
  servo.Start(channel, timing);
  servo.WaitForTicks(1000);
  const auto plane = MakePlane();
  std::vector<TickRecord> records;
  std::uint64_t older = 0;
  std::uint64_t lastTick = 0;
  std::uint64_t published = 1;
  haptics::ServoSettings settings;
  for (int i = 0; i < 500; ++i)
  {
    published = servo.Cycle.GetExchange().Publish(MakeGodObject(plane));
    settings.Force.Stiffness = i % 2 == 0 ? 400.0 : 500.0;
    servo.Cycle.Configure(settings);
    servo.Cycle.UpdateLatest();
    older += servo.Cycle.GetLatest().Tick < lastTick;
    lastTick = servo.Cycle.GetLatest().Tick;
    servo.Cycle.Drain(records);
    servo.Statistics.Report();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  servo.WaitForTicks(servo.Statistics.Report().Ticks + 500); // a softened stiffness comes back
  servo.Loop.Stop();
  servo.Cycle.Drain(records);
  EXPECT_EQ(older, 0u);
  EXPECT_EQ(records.back().Generation, published);
  EXPECT_NEAR(records.back().Force[2], 1.0, 2e-3) << "still on the plane after every change";
  for (std::size_t i = 1; i < records.size(); ++i)
  {
    ASSERT_LE(records[i - 1].Generation, records[i].Generation);
    ASSERT_LT(records[i - 1].Tick, records[i].Tick);
  }
}
}
