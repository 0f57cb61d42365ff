#include "ServoTestTools.h"
#include "WaitFor.h"
#include "haptics/Servo/ServoLoop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

using haptics::ServoCycle;
using haptics::ServoLoop;
using haptics::ServoSettings;
using haptics::ServoState;
using haptics::ServoStatistics;
using haptics::ServoTiming;
using haptics::TickRecord;

// Each test provokes a fault and reads what the device was last asked for.
namespace
{
using Milliseconds = std::chrono::milliseconds;

/// A device that can be halted, and can hang in Read().
class HaltableChannel : public ScriptedChannel
{
public:
  std::atomic<bool> Halted{ false };
  std::atomic<bool> Hang{ false };
  std::atomic<int> Halts{ 0 };
  std::atomic<double> OnHand{ 0.0 }; ///< [N], on the hand now

  bool Read(double time, haptics::DeviceSample& sample) noexcept override
  {
    while (this->Hang)
    {
      std::this_thread::sleep_for(Milliseconds(1));
    }
    return this->Hand(time, sample);
  }
  void Write(const std::array<double, 3>& force) noexcept override
  {
    this->OnHand = this->Halted ? 0.0 : std::hypot(force[0], force[1], force[2]);
    ScriptedChannel::Write(force);
  }
  void Halt() noexcept override
  {
    this->Halted = true;
    this->OnHand = 0.0;
    this->Halts.fetch_add(1);
  }
  void Resume() noexcept override { this->Halted = false; }
};

struct Servo
{
  ServoCycle Cycle{ 65536 };
  ServoStatistics Statistics;
  ServoLoop Loop{ this->Cycle, this->Statistics };
  std::shared_ptr<HaltableChannel> Channel = std::make_shared<HaltableChannel>();
  ServoTiming Timing;

  Servo()
  {
    this->Cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
    this->Channel->Hand = MakePressingHand(0.002)->Hand;
    this->Timing.StallLimit = 60000000000;
    this->Timing.WatchdogTime = 60000000000;
    this->Timing.MissedShare = 60.0;
  }
  void Start()
  {
    this->Cycle.Begin(this->Channel, ServoState::Running);
    std::string error;
    ASSERT_TRUE(this->Loop.Start(this->Timing, error)) << error;
  }
};

TEST(ServoFaults, AHangingTickLeavesNoForceInTheHandAndComesBackSoftly)
{
  Servo servo;
  servo.Timing.WatchdogTime = 100000000;
  servo.Start();
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->OnHand > 0.9; }));
  const int haltsBefore = servo.Channel->Halts; // a busy machine may have had some
  servo.Channel->Hang = true;
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->Halts > haltsBefore; }));
  EXPECT_EQ(servo.Channel->OnHand, 0.0) << "while the servo still hangs";
  std::vector<TickRecord> records;
  servo.Cycle.Drain(records);
  servo.Channel->Hang = false;
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->OnHand > 0.9; })) << "it goes on";
  servo.Loop.Stop();
  EXPECT_EQ(servo.Channel->OnHand, 0.0);
  EXPECT_GE(servo.Loop.GetNumberOfHalts(), 1u);
  records.clear();
  servo.Cycle.Drain(records);
  ASSERT_GE(records.size(), 20u);
  // The first tick is the one that hung: the halted device took no force from it.
  EXPECT_TRUE(records[1].Limits & haptics::SoftStarted);
  EXPECT_LT(records[1].Force[2], 0.1) << "3.3 N in 0.1 s, at most two periods of it in a tick";
}

TEST(ServoFaults, TooManyMissedDeadlinesEndTheRunWithoutForce)
{
  Servo servo;
  servo.Timing.MissedShare = 0.5;
  const auto press = servo.Channel->Hand;
  std::atomic<bool> slow{ false };
  servo.Channel->Hand = [&slow, press](double time, haptics::DeviceSample& sample)
  {
    if (slow)
    {
      std::this_thread::sleep_for(Milliseconds(10));
    }
    return press(time, sample);
  };
  servo.Start();
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->OnHand > 0.9; }));
  slow = true;
  ASSERT_TRUE(WaitFor([&] { return servo.Cycle.GetState() != ServoState::Running; }));
  EXPECT_EQ(servo.Cycle.GetState(), ServoState::Overrun);
  EXPECT_EQ(servo.Channel->OnHand, 0.0);
  EXPECT_EQ(servo.Channel->LastForce, NoForce);
  servo.Loop.Stop();
}

TEST(ServoFaults, PausingTakesTheForceAwayAndTheServoGoesOn)
{
  Servo servo;
  servo.Start();
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->OnHand > 0.9; }));
  ServoSettings settings;
  settings.Safety.Paused = true;
  servo.Cycle.Configure(settings);
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->OnHand == 0.0; }));
  const int writes = servo.Channel->Writes;
  ASSERT_TRUE(WaitFor([&] { return servo.Channel->Writes > writes + 20; }));
  EXPECT_EQ(servo.Channel->OnHand, 0.0);
  settings.Safety.Paused = false;
  servo.Cycle.Configure(settings);
  EXPECT_TRUE(WaitFor([&] { return servo.Channel->OnHand > 0.9; }));
}

TEST(ServoFaults, ANewSurfaceUnderThePressingHandPushesSoftly)
{
  // The plane falls 5 mm below the hand, then another comes up 2 mm above it, touched from both
  // sides: whatever the change does to the force, it grows no faster than a soft start.
  ServoCycle cycle(1024);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  const auto channel = MakePressingHand(0.002);
  ServoSettings settings;
  settings.Force.Stiffness = 1000.0;
  cycle.Configure(settings);
  cycle.Begin(channel, ServoState::Stepping);
  int tick = 0;
  for (; tick < 200; ++tick)
  {
    ASSERT_TRUE(cycle.Tick(0.001 * tick));
  }
  ASSERT_NEAR(channel->LastForce[2], 2.0, 0.01);
  // The god-object stays 2 mm above the hand; the new plane holds it there from the next tick on.
  settings.Force.Stiffness = 500.0;
  cycle.Configure(settings);
  ASSERT_TRUE(cycle.Tick(0.001 * tick++));
  const double before = channel->LastForce[2];
  cycle.GetExchange().Publish(MakeGodObject(MakePlane(-0.0001)));
  settings.Force.Stiffness = 1000.0;
  cycle.Configure(settings);
  ASSERT_TRUE(cycle.Tick(0.001 * tick++));
  EXPECT_LE(channel->LastForce[2], before + 3.3 * 0.001 / 0.1 + 1e-9);
}

TEST(ServoFaults, AnEngageWithinReachOfASurfaceStartsSoftly)
{
  ServoCycle cycle(1024);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  const auto channel = std::make_shared<ScriptedChannel>();
  channel->Hand = [](double time, haptics::DeviceSample& sample)
  {
    sample.Position = { 0.0, 0.0, time < 0.0005 ? 0.001 : -0.02 }; // down 21 mm in a tick
    return true;
  };
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_TRUE(cycle.Tick(0.0));
  double last = 0.0;
  for (int tick = 1; tick < 100; ++tick)
  {
    ASSERT_TRUE(cycle.Tick(0.001 * tick));
    ASSERT_NEAR(channel->LastForce[2] - last, 0.033, 1e-9) << "3.3 N in 0.1 s";
    last = channel->LastForce[2];
  }
}

/// A device that gives samples when the test says so.
class PacingChannel : public ScriptedChannel
{
public:
  std::atomic<int> Taken{ 0 }; ///< samples that the servo waited for and got
  bool IsSilent = false;       ///< whether the last wait was in vain; servo thread

  bool SetsPace() const noexcept override { return true; }
  bool WaitForSample(std::uint64_t timeout) noexcept override
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    const bool came = this->Came.wait_for(
      lock, std::chrono::nanoseconds(timeout), [this] { return this->Samples > 0; });
    this->Samples -= came;
    this->Taken += came;
    this->IsSilent = !came;
    return came;
  }
  void GiveSample()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      ++this->Samples;
    }
    this->Came.notify_one();
  }

private:
  std::mutex Mutex;
  std::condition_variable Came;
  int Samples = 0;
};

TEST(ServoFaults, ADeviceThatSetsThePaceIsTickedOnceASample)
{
  Servo servo;
  const auto device = std::make_shared<PacingChannel>();
  std::atomic<bool> plugged{ true };
  device->Hand = [&plugged](double, haptics::DeviceSample& sample)
  {
    sample.Position = { 0.0, 0.0, 0.001 };
    return plugged.load();
  };
  servo.Timing.Period = 1000000000; // by the clock there would be one tick a second
  servo.Cycle.Begin(device, ServoState::Running);
  std::string error;
  ASSERT_TRUE(servo.Loop.Start(servo.Timing, error)) << error;
  for (int i = 1; i <= 200; ++i)
  {
    device->GiveSample();
    ASSERT_TRUE(WaitFor([&] { return device->Writes == i; }));
  }
  EXPECT_TRUE(WaitFor([&] { return servo.Statistics.Report().Ticks >= 200u; }));
  EXPECT_EQ(device->Writes, 200);
  plugged = false;
  device->GiveSample(); // the servo waits for one, and Stop() for the servo
  servo.Loop.Stop();
}

TEST(ServoFaults, ADeviceThatWasFastDoesNotHideThatItIsSilentNow)
{
  constexpr int samples = 300;       // 1.5 s of deadlines in far less time
  std::vector<std::uint64_t> missed; // before each tick after the last sample; servo thread
  std::atomic<int> silences{ 0 };
  Servo servo;
  const auto device = std::make_shared<PacingChannel>();
  device->Hand = [&](double, haptics::DeviceSample&)
  {
    // A machine so busy that the test is silent between its samples does not count.
    if (device->Taken == samples && device->IsSilent)
    {
      missed.push_back(servo.Statistics.Report().MissedTicks);
      ++silences;
    }
    return true;
  };
  servo.Timing.Period = 5000000;
  servo.Cycle.Begin(device, ServoState::Running);
  std::string error;
  ASSERT_TRUE(servo.Loop.Start(servo.Timing, error)) << error;
  for (int i = 1; i <= samples; ++i)
  {
    device->GiveSample();
    while (device->Taken < i)
    {
      std::this_thread::yield();
    }
  }
  // Asked every fourth period from here on: three deadlines pass without a tick each time.
  ASSERT_TRUE(WaitFor([&] { return silences >= 5; }));
  servo.Loop.Stop();
  EXPECT_GE(missed[4], missed[0] + 4 * 3 - 1)
    << "the one before them may have been early by a period";
}

TEST(ServoFaults, ASilentDeviceThatSetsThePaceIsAskedAllTheSame)
{
  Servo servo;
  const auto device = std::make_shared<PacingChannel>();
  std::atomic<int> reads{ 0 };
  device->Hand = [&reads](double, haptics::DeviceSample&) { return ++reads < 3; };
  servo.Cycle.Begin(device, ServoState::Running);
  std::string error;
  ASSERT_TRUE(servo.Loop.Start(servo.Timing, error)) << error;
  ASSERT_TRUE(WaitFor([&] { return servo.Cycle.GetState() != ServoState::Running; }));
  EXPECT_EQ(servo.Cycle.GetState(), ServoState::DeviceLost);
  EXPECT_EQ(device->LastForce, NoForce);
  servo.Loop.Stop();
}
}
