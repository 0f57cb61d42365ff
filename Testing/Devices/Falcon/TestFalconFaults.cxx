#include "FalconBench.h"
#include "FalconEncoders.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

namespace
{
using FalconFaults = FalconBench;
using Force = std::array<double, 3>;

const Force Push{ 0.3, -0.2, 1.0 };
// Cranks so far apart, 178 degrees from 0 and 0, that they would pull the rods off.
const std::array<std::int16_t, 3> ImpossibleCounts{ 3914, -961, -961 };

bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// Faults that end a session: what the device does once it has pushed, what it gets, and what the
/// user reads.
struct Fault
{
  const char* Name;
  Act What;
  bool Listens; ///< whether zero force can still reach it
  const char* Message;
};

void PrintTo(const Fault& fault, std::ostream* os)
{
  *os << fault.Name;
}

class FalconFault
  : public FalconBench
  , public testing::WithParamInterface<Fault>
{
};

TEST_P(FalconFault, EndsWithoutForceAndIsReportedToTheUser)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  const auto channel = this->Device->GetChannel();
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  this->PlayFromHere(this->GetParam().What);
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, Push));
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), this->GetParam().Message))
    << this->Device->GetErrorMessage();
  EXPECT_EQ(this->Events.Errors, 1);
  if (this->GetParam().Listens)
  {
    EXPECT_TRUE(this->EndsWithoutForce());
  }
  haptics::DeviceSample sample;
  EXPECT_FALSE(channel->Read(1e9, sample)) << "the servo must notice";
  EXPECT_TRUE(this->Run([&] { return !this->Bus.IsClaimed(1); }));
}

// clang-format off
const Fault Faults[] = {
  { "Stall", { At::Serve, 0, Do::Stall }, true, "refused a USB transfer (stall) while exchanging" },
  { "StallOfAWrite", { At::Serve, 0, Do::StallWrite }, true, "refused a USB transfer (stall) while exchanging" },
  { "IoError", { At::Serve, 0, Do::IoError }, true, "(I/O error) while exchanging" },
  { "Overflow", { At::Serve, 0, Do::Overflow }, true, "(overflow) while exchanging" },
  { "SilenceForGood", { At::Serve, 0, Do::Silence, Always }, true, "did not answer 5 packets in a row" },
  { "RubbishForGood", { At::Serve, 0, Do::Garble, Always }, true, "did not answer 5 packets in a row" },
  { "JammedForGood", { At::Serve, 0, Do::Jam }, false, "did not answer 5 packets in a row" },
  { "LostOrigin", { At::Serve, 0, Do::ForgetHome }, true, "lost its origin" },
  { "Unplugged", { At::Serve, 0, Do::Unplug }, false, "was unplugged while exchanging" },
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(All, FalconFault, testing::ValuesIn(Faults),
  [](const testing::TestParamInfo<Fault>& info) { return std::string(info.param.Name); });

TEST_F(FalconFaults, WhatMessagesAdviseEndsTheFault)
{
  this->Bus.Plug(1, FalconModel());
  const auto plugAnew = [this]
  {
    this->Bus.Unplug(1);
    this->Bus.Plug(1, FalconModel());
  };
  const auto fail = [&](Do what, int times = 1)
  {
    this->Device->Close();
    plugAnew();
    ASSERT_TRUE(this->BecomesReady());
    ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
    this->PlayFromHere({ At::Serve, 0, what, times });
  };
  fail(Do::Stall);
  this->ExpectRemedy(
    "Unplug it and its power supply, connect both again, and open it again", plugAnew);
  fail(Do::IoError);
  this->ExpectRemedy("Check the cable, leave out hubs, and open it again", plugAnew);
  fail(Do::Overflow);
  this->ExpectRemedy("Unplug it, plug it in again, and open it again", plugAnew);
  this->Device->Close();
  this->Bus.Unplug(1);
  FalconModel slow;
  slow.LateBy = std::chrono::milliseconds(35);
  this->Bus.Plug(1, slow);
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  this->PlayFromHere({ At::Serve, 0, Do::Late, Always });
  this->ExpectRemedy("Leave out hubs, relieve the machine, then open it again", plugAnew);
  fail(Do::Silence, Always);
  this->ExpectRemedy("Check its power supply and its cable, then open it again", plugAnew);
  fail(Do::ForgetHome);
  this->ExpectRemedy("Check its power supply, then open and home it again", plugAnew);
  this->Bus.Unplug(1);
  this->ExpectRemedy(
    "Plug it in again and open it again", [this] { this->Bus.Plug(1, FalconModel()); });
  const auto turn = [&](const std::array<std::int16_t, 3>& encoders)
  { this->Bus.With(1, [&](FalconModel& model) { model.Encoders = encoders; }); };
  turn(ImpossibleCounts);
  this->ExpectRemedy("Close it, open it and home it again", [&] { turn(FalconModel().Encoders); });

  // As a machine that is too busy for the exchange: the servo's time runs ahead of it.
  const auto channel = this->Device->GetChannel();
  haptics::DeviceSample sample;
  double time = 1e9;
  for (int reads = 0; reads < 1000 && channel->Read(time, sample); ++reads)
  {
    time += 0.21;
  }
  this->ExpectRemedy("Relieve it, or let the program have real-time priority, then open", [] {});
}

/// Faults that a session survives.
class FalconHiccup
  : public FalconBench
  , public testing::WithParamInterface<Fault>
{
};

TEST_P(FalconHiccup, IsSurvived)
{
  FalconModel model;
  if (this->GetParam().Listens)
  {
    model.Script = { this->GetParam().What };
  }
  this->Bus.Plug(1, model);
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  if (!this->GetParam().Listens)
  {
    this->PlayFromHere(this->GetParam().What);
    const auto hasPaused = [](FalconModel& model)
    {
      const auto& commands = model.Commands;
      const auto pushes = [](const haptics::FalconCommand& c) { return c.Torques[2] != 0; };
      const auto first = std::find_if(commands.begin(), commands.end(), pushes);
      const auto pause = std::find_if_not(first, commands.end(), pushes);
      return pause != commands.end() &&
        std::find_if(pause, commands.end(), pushes) != commands.end();
    };
    const auto isCounted = [this] { return this->Device->GetNumberOfMissedReplies() > 0; };
    // A servo that came late may have made a pause before.
    EXPECT_TRUE(this->Run([&] { return isCounted() && this->Bus.With(1, hasPaused); }, Push))
      << "a packet after a lost reply asks for no force, later ones do again";
    EXPECT_TRUE(isCounted());
  }
  const vtkTypeInt64 enough = this->Device->GetNumberOfExchanges() + 150;
  ASSERT_TRUE(this->Run([&] { return this->Device->GetNumberOfExchanges() > enough; }, Push))
    << this->Device->GetStatusMessage();
  EXPECT_TRUE(this->Device->IsOpen()) << this->Device->GetErrorMessage();
  EXPECT_EQ(this->Events.Errors, 0);
}

// clang-format off
const Fault Hiccups[] = {
  { "SplitReplies", { At::Probe, 0, Do::Split, Always }, true, "" },
  { "SplitRepliesWhileServing", { At::Serve, 0, Do::Split, Always }, true, "" },
  { "RubbishBeforeReplies", { At::Serve, 0, Do::Chatter, 100 }, true, "" },
  { "ReadsWithoutStatus", { At::Serve, 0, Do::CutStatus, 100 }, true, "" },
  { "LateReplies", { At::Serve, 0, Do::Late, 100 }, true, "" },
  { "ADamagedReply", { At::Serve, 0, Do::Garble }, false, "" },
  { "ALostReply", { At::Serve, 0, Do::Silence }, false, "" },
  { "FourLostReplies", { At::Serve, 0, Do::Silence, 4 }, false, "" },
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(All, FalconHiccup, testing::ValuesIn(Hiccups),
  [](const testing::TestParamInfo<Fault>& info) { return std::string(info.param.Name); });

TEST_F(FalconFaults, GivesThePositionOfTheEncodersAndTheButtons)
{
  FalconModel model;
  const Force place{ 0.011, -0.017, 0.131 };
  model.Encoders = EncodersAt(place);
  model.Buttons = 9;
  this->Bus.Plug(1, model);
  ASSERT_TRUE(this->BecomesReady());
  haptics::DeviceSample sample;
  ASSERT_TRUE(this->Device->GetChannel()->Read(Now(), sample));
  EXPECT_EQ(sample.Buttons, 9u);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(sample.Position[i], place[i], 60e-6) << "half a count at each leg";
  }
}

TEST_F(FalconFaults, SendsTheTorquesOfTheForceByTheJacobian)
{
  const FalconModel model;
  this->Bus.Plug(1, model);
  this->Device->SetTorqueScale(-2000.0);
  ASSERT_TRUE(this->BecomesReady());
  using namespace haptics::FalconKinematics;
  Vector angles{};
  Vector place{};
  Matrix jacobian{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    angles[i] = AngleOfCount(model.Encoders[i]);
  }
  ASSERT_TRUE(Forward(angles, place));
  ASSERT_TRUE(Jacobian(place, angles, jacobian));
  const Vector torques = Torques(jacobian, Push);
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  const haptics::FalconCommand last = this->LastCommand();
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(last.Torques[i], -2000.0 * torques[i], 0.5 + 1e-9) << "rounded to a unit";
  }
}

TEST_F(FalconFaults, SendsNoMoreThanTheLargestForce)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  const auto settle = [&](const Force& force)
  {
    const auto count = [](FalconModel& model) { return model.Commands.size(); };
    const std::size_t enough = this->Bus.With(1, count) + 10;
    EXPECT_TRUE(this->Run([&] { return this->Bus.With(1, count) > enough; }, force));
    return this->LastCommand().Torques;
  };
  EXPECT_EQ(settle({ 0.0, 0.0, 1e9 }), settle({ 0.0, 0.0, this->Device->GetMaximumForce() }));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(settle({ 0.0, nan, 1.0 }), (std::array<std::int16_t, 3>{}));
}

TEST_F(FalconFaults, WithdrawsAForceThatTheServoDoesNotRenew)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  // No tick from here on, as of a servo that hangs.
  const auto end = FalconModel::Clock::now() + std::chrono::seconds(5);
  while (!this->EndsWithoutForce() && FalconModel::Clock::now() < end)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(this->EndsWithoutForce());
  EXPECT_GE(this->Device->GetNumberOfLateCommands(), 1);
  EXPECT_TRUE(this->Device->IsOpen());
}

TEST_F(FalconFaults, LetsGoAtOnceWhenAWatchdogHaltsIt)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  const auto channel = this->Device->GetChannel();
  channel->Halt();
  // Two packets come long before the 20 ms after which a force is withdrawn anyway.
  const vtkTypeInt64 before = this->Device->GetNumberOfExchanges();
  const auto end = FalconModel::Clock::now() + std::chrono::seconds(5);
  while (this->Device->GetNumberOfExchanges() < before + 2 && FalconModel::Clock::now() < end)
  {
    std::this_thread::yield();
  }
  EXPECT_TRUE(this->EndsWithoutForce()) << "no tick came since";
  const auto count = [&]
  { return this->Bus.With(1, [](FalconModel& model) { return model.Commands.size(); }); };
  std::size_t commands = count();
  ASSERT_TRUE(this->Run([&] { return count() > commands + 10; }, Push));
  EXPECT_TRUE(this->EndsWithoutForce()) << "ticks do not count before the servo resumes";
  channel->Resume();
  commands = count();
  EXPECT_TRUE(
    this->Run([&] { return count() > commands + 10 && !this->EndsWithoutForce(); }, Push));
}

TEST_F(FalconFaults, SetsThePaceOfTheServo)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  const auto channel = this->Device->GetChannel();
  ASSERT_TRUE(channel->SetsPace());
  haptics::DeviceSample sample;
  const auto start = FalconModel::Clock::now();
  constexpr int ticks = 100;
  for (int tick = 0; tick < ticks; ++tick)
  {
    ASSERT_TRUE(channel->WaitForSample(1000000000)) << tick;
    ASSERT_TRUE(channel->Read(tick * 1e-3, sample));
  }
  // The first may be waiting already, and one may come late and the next in time.
  EXPECT_GE(FalconModel::Clock::now() - start, std::chrono::milliseconds(ticks - 3));
  this->Bus.With(1,
    [](FalconModel& model) {
      model.Script = { { At::Serve, 0, Do::Silence, Always } };
    });
  while (channel->WaitForSample(30000000))
  {
  }
  SUCCEED() << "and stops waiting when nothing comes";
}

TEST_F(FalconFaults, EndsWithoutForceWhenClosedWhileItPushes)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  this->Device->Close();
  ASSERT_TRUE(this->Run([&] { return !this->Bus.IsClaimed(1); }));
  EXPECT_TRUE(this->EndsWithoutForce());
  EXPECT_FALSE(this->Bus.IsDriverDetached()) << "the kernel's driver gets its device back";
  EXPECT_EQ(this->Events.Errors, 0);
  EXPECT_TRUE(this->BecomesReady()) << "and opens again";
}

TEST_F(FalconFaults, EndsWithoutForceWhenTheObjectIsDestroyedWhileItPushes)
{
  this->Bus.Plug(1, FalconModel());
  auto* device = vtkFalconHapticDevice::New();
  device->Open();
  ASSERT_TRUE(this->Run(
    [&]
    {
      device->Update();
      return device->IsOpen();
    }))
    << device->GetStatusMessage();
  const auto channel = device->GetChannel();
  haptics::DeviceSample sample;
  ASSERT_TRUE(this->Run(
    [&]
    {
      if (channel->Read(0.0, sample))
      {
        channel->Write(Push);
      }
      return this->GotForce();
    }));
  device->Delete();
  EXPECT_TRUE(this->EndsWithoutForce());
  EXPECT_FALSE(channel->Read(0.1, sample)) << "a channel may outlive its device";
  channel->Write(Push);
  EXPECT_TRUE(this->EndsWithoutForce());
}

TEST_F(FalconFaults, IsOpenedAgainByHandAfterItWasPulledOutAndPluggedIn)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  this->Bus.Unplug(1);
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, Push));
  const int arrivals = this->Events.Arrivals;
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->Run([&] { return this->Events.Arrivals > arrivals; })) << "is reported";
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Faulted) << "but nothing moves by itself";
  EXPECT_TRUE(this->BecomesReady());
}

TEST_F(FalconFaults, IsOpenedByItselfOnArrivalWhereAskedTo)
{
  this->Device->OpenOnArrivalOn();
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Ready)) << this->Device->GetStatusMessage();
  const auto first = this->Device->GetChannel();
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  this->Bus.Unplug(1);
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, Push));
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Ready)) << this->Device->GetStatusMessage();
  EXPECT_NE(this->Device->GetChannel(), first);
  first->Write(Push);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(this->GotForce()) << "the servo of the last session must not push in this one";
  EXPECT_STREQ(this->Device->GetErrorMessage(), "");
}

// The farewell to a device that takes no byte lasts: the servo notices long before it is reported.
TEST_F(FalconFaults, IsOpenedByItselfAfterItWasJammed)
{
  FalconModel model;
  model.Script = { { At::Serve, 50, Do::Jam } };
  this->Bus.Plug(1, model);
  this->Device->OpenOnArrivalOn();
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, Push));
  this->Bus.Unplug(1);
  this->Bus.Plug(1, FalconModel());
  EXPECT_TRUE(this->RunUntil(vtkHapticDevice::Ready)) << this->Device->GetStatusMessage();
}

TEST_F(FalconFaults, ReportsAPoseThatItsArmsCannotTakeAndOpensAgain)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  const auto turn = [&](const std::array<std::int16_t, 3>& encoders)
  { this->Bus.With(1, [&](FalconModel& model) { model.Encoders = encoders; }); };
  turn(ImpossibleCounts);
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, Push));
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), "a pose that its arms cannot take"));
  ASSERT_TRUE(this->Run([&] { return !this->Bus.IsClaimed(1); }));
  EXPECT_TRUE(this->EndsWithoutForce());
  EXPECT_EQ(this->Events.Errors, 1);
  turn(FalconModel().Encoders);
  EXPECT_TRUE(this->BecomesReady());
}

TEST_F(FalconFaults, ReportsThatTheMachineIsTooBusyWhereNoNewPositionComes)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  const auto channel = this->Device->GetChannel();
  haptics::DeviceSample sample;
  double time = 1e9; // the servo's, which runs a thousand times faster than the exchange's
  int reads = 0;
  while (channel->Read(time, sample) && ++reads < 1000)
  {
    channel->Write(Push);
    time += 0.21;
  }
  this->Device->Update();
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Faulted);
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), "the machine is too busy"));
  ASSERT_TRUE(this->Run([&] { return !this->Bus.IsClaimed(1); }));
  EXPECT_TRUE(this->EndsWithoutForce());
}

TEST_F(FalconFaults, HasTheMessageOfAStateWhenItReportsTheState)
{
  std::vector<std::string> messages; // at each change of state
  int changes = 0;
  vtkNew<vtkCallbackCommand> noter;
  noter->SetClientData(&messages);
  noter->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      static_cast<std::vector<std::string>*>(client)->emplace_back(
        static_cast<vtkFalconHapticDevice*>(caller)->GetStatusMessage());
    });
  this->Device->AddObserver(vtkHapticDevice::StateChangedEvent, noter);
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&changes);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* client, void*) { ++*static_cast<int*>(client); });
  this->Device->AddObserver(vtkFalconHapticDevice::StatusMessageChangedEvent, counter);

  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  EXPECT_EQ(messages.back(), "The Falcon is ready.");
  int before = changes;
  this->Bus.With(1, [](FalconModel& model) { model.Encoders = ImpossibleCounts; });
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  EXPECT_TRUE(Contains(messages.back(), "a pose")) << messages.back();
  EXPECT_EQ(changes, before + 1);
  before = changes;
  this->Device->Open();
  EXPECT_EQ(messages.back(), "") << "the fault is over";
  EXPECT_EQ(changes, before + 1);
  ASSERT_TRUE(this->Run([&] { return *this->Device->GetStatusMessage() != '\0'; }));
  before = changes;
  this->Device->Close();
  EXPECT_EQ(messages.back(), "");
  EXPECT_EQ(changes, before + 1);
}

TEST_F(FalconFaults, RefusesTorqueScalesOutOfRange)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : { 0.0, 99.0, -20001.0, nan })
  {
    this->Device->SetTorqueScale(scale);
    EXPECT_EQ(this->Device->GetTorqueScale(), -3500.0);
  }
  EXPECT_EQ(this->Events.Errors, 4);
}

TEST_F(FalconFaults, PrintsAllThatItKnows)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  std::ostringstream text;
  this->Device->Print(text);
  for (const char* const part : { "State: Ready", "StatusMessage: The Falcon is ready.",
         "TorqueScale: -3500 1/(N m)", "NumberOfExchanges: ", "RealTimePriority: " })
  {
    EXPECT_TRUE(Contains(text.str(), part)) << part;
  }
}

// The rate is the device's: 1 kHz whatever the servo's thread does.
TEST_F(FalconFaults, ExchangesAThousandPacketsASecondWithAServoThread)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  std::atomic<bool> stop{ false };
  std::atomic<int> lost{ 0 };
  const auto channel = this->Device->GetChannel();
  std::thread servo(
    [&]
    {
      const auto start = FalconModel::Clock::now();
      for (int tick = 0; !stop; ++tick)
      {
        haptics::DeviceSample sample;
        if (!channel->Read(tick * 1e-3, sample))
        {
          ++lost;
          return;
        }
        channel->Write(Push);
        std::this_thread::sleep_until(start + std::chrono::milliseconds(tick + 1));
      }
    });
  const vtkTypeInt64 before = this->Device->GetNumberOfExchanges();
  const auto start = FalconModel::Clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  this->Device->Update();
  const vtkTypeInt64 exchanges = this->Device->GetNumberOfExchanges() - before;
  const double duration = std::chrono::duration<double>(FalconModel::Clock::now() - start).count();
  stop = true;
  servo.join();
  EXPECT_EQ(lost, 0);
  this->RecordProperty("exchanges_per_second", static_cast<int>(exchanges / duration));
  this->RecordProperty(
    "p99_exchange_us", static_cast<int>(1e6 * this->Device->GetExchangeTime(0.99)));
  EXPECT_GT(this->Device->GetExchangeTime(0.5), 0.0);
  EXPECT_LE(this->Device->GetExchangeTime(0.5), 1e-3) << "the bus in the test takes microseconds";
  EXPECT_LE(this->Device->GetExchangeTime(0.5), this->Device->GetExchangeTime(0.99));
  EXPECT_LT(exchanges / duration, 1020.0) << "never faster than 1 kHz";
  EXPECT_GT(exchanges / duration, 200.0) << "on however busy a machine";
  EXPECT_EQ(this->Device->GetNumberOfMissedReplies(), 0);
}
}
