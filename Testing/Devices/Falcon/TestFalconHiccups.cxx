// Replies that are lost, damaged or late while a servo presses: what the device got, packet by
// packet.
#include "FalconBench.h"
#include "FalconEncoders.h"
#include "ServoTestTools.h"
#include "WaitFor.h"

#include "haptics/Devices/Falcon/FalconKinematics.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using Torques = std::array<std::int16_t, 3>;

const std::array<double, 3> Push{ 0.3, -0.2, 1.0 };

int Largest(const Torques& torques)
{
  return std::max({ std::abs(torques[0]), std::abs(torques[1]), std::abs(torques[2]) });
}

struct Hiccup
{
  const char* Name;
  Do What;
  int Times;
  int LateBy;      ///< [ms]
  int LaterBy = 0; ///< [ms], each further reply
};

void PrintTo(const Hiccup& hiccup, std::ostream* os)
{
  *os << hiccup.Name;
}

std::string NameOf(const testing::TestParamInfo<Hiccup>& info)
{
  return info.param.Name;
}

class FalconHiccups : public FalconBench
{
protected:
  /// A servo presses 6 mm into a plane, with all of its force.
  ::testing::AssertionResult Press()
  {
    FalconModel model;
    model.Encoders = EncodersAt({ 0.0, 0.0, 0.131 });
    this->Bus.Plug(1, model);
    const auto ready = this->BecomesReady();
    if (!ready)
    {
      return ready;
    }
    this->Servo->SetDevice(this->Device);
    this->Servo->SetStallLimit(60.0);
    this->Servo->GetSafety()->LoosenWatchdogTime(1.0);
    this->Servo->GetSafety()->LoosenMissedTickShare(60.0);
    this->Servo->PublishGodObject(MakeGodObject(MakePlane(0.13, 0.1)));
    if (!this->Servo->Start() || !this->Wait([&] { return this->Servo->GetNumberOfTicks() > 50; }))
    {
      return testing::AssertionFailure() << "the servo does not run";
    }
    this->Bus.With(1,
      [](FalconModel& pressed) {
        pressed.Encoders = EncodersAt({ 0.0, 0.0, 0.124 });
      });
    return this->Wait([&] { return this->GetPush() > 3.0; })
      ? testing::AssertionSuccess()
      : testing::AssertionFailure() << "pushes with " << this->GetPush() << " N";
  }

  template <typename Condition>
  bool Wait(Condition condition)
  {
    return WaitFor(condition,
      [this]
      {
        this->Device->Update();
        this->Servo->Update();
      });
  }

  double GetPush()
  {
    double force[3];
    this->Servo->GetReadings()->GetForce(force);
    return force[2];
  }

  /// Plays a hiccup from the next packet on and returns that packet's number among all.
  std::size_t Play(const Hiccup& hiccup)
  {
    return this->Bus.With(1,
      [&](FalconModel& model)
      {
        model.LateBy = std::chrono::milliseconds(hiccup.LateBy);
        model.LaterBy = std::chrono::milliseconds(hiccup.LaterBy);
        model.Script = { { At::Serve, model.Served, hiccup.What, hiccup.Times } };
        return model.Commands.size();
      });
  }
  std::vector<haptics::FalconCommand> CommandsFrom(std::size_t first)
  {
    return this->Bus.With(1,
      [=](FalconModel& model)
      {
        return std::vector<haptics::FalconCommand>(
          model.Commands.begin() + static_cast<std::ptrdiff_t>(first), model.Commands.end());
      });
  }

  vtkNew<vtkHapticServo> Servo;
};

class FalconShortHiccup
  : public FalconHiccups
  , public testing::WithParamInterface<Hiccup>
{
};

TEST_P(FalconShortHiccup, LetsTheForceComeBackSoftly)
{
  ASSERT_TRUE(this->Press());
  const int full = Largest(this->LastCommand().Torques);
  ASSERT_GT(full, 100);
  const std::size_t first = this->Play(this->GetParam());
  const auto isBack = [&]
  {
    const std::vector<haptics::FalconCommand> commands = this->CommandsFrom(first);
    const auto zero = std::find_if(commands.begin(), commands.end(),
      [](const haptics::FalconCommand& command) { return Largest(command.Torques) == 0; });
    return std::any_of(zero, commands.end(),
      [&](const haptics::FalconCommand& command) { return Largest(command.Torques) > 0.8 * full; });
  };
  ASSERT_TRUE(this->Wait(isBack)) << this->Device->GetStatusMessage();
  const std::vector<haptics::FalconCommand> commands = this->CommandsFrom(first);
  int growth = 0;
  for (std::size_t i = 1; i < commands.size(); ++i)
  {
    growth = std::max(growth, Largest(commands[i].Torques) - Largest(commands[i - 1].Torques));
  }
  // A soft start takes 50 ticks to 4 N, or half as many that are late.
  EXPECT_LT(growth, full / 5) << "of " << full;
  EXPECT_EQ(Largest(commands[1].Torques), 0) << "the next packet after the hiccup";
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Ready);
  EXPECT_TRUE(this->Servo->IsRunning()) << this->Servo->GetStateAsString();
  EXPECT_EQ(this->Events.Errors, 0);
}

// One that is behind stays behind: the least of many lags counts, whatever else the machine does.
TEST_P(FalconShortHiccup, GivesNoOlderPositionsAfterwards)
{
  FalconModel model;
  model.CountsPackets = true;
  this->Bus.Plug(1, model);
  ASSERT_TRUE(this->BecomesReady());
  this->Play(this->GetParam());
  ASSERT_TRUE(this->Run([&] { return this->Device->GetNumberOfMissedReplies() > 0; }));
  const vtkTypeInt64 after = this->Device->GetNumberOfExchanges() + 20;
  ASSERT_TRUE(this->Run([&] { return this->Device->GetNumberOfExchanges() > after; }))
    << this->Device->GetStatusMessage();
  int least = FalconModel::CountTo;
  const auto channel = this->Device->GetChannel();
  for (int i = 0; i < 200; ++i)
  {
    const int served = this->Bus.With(1, [](FalconModel& now) { return now.Served; });
    haptics::DeviceSample sample;
    haptics::FalconKinematics::Vector angles{};
    ASSERT_TRUE(channel->Read(Now(), sample));
    ASSERT_TRUE(haptics::FalconKinematics::Inverse(sample.Position, angles));
    const int reported =
      haptics::FalconKinematics::CountOfAngle(angles[0]) - FalconModel::FirstCount;
    // Another packet may have come between the two.
    const int lag = (served - reported + FalconModel::CountTo + 100) % FalconModel::CountTo - 100;
    least = std::min(least, std::max(0, lag));
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  EXPECT_EQ(least, 0) << "packets";
}

// clang-format off
const Hiccup ShortHiccups[] = {
  { "ADamagedReply", Do::Garble, 1, 0 },
  { "ALostReply", Do::Silence, 1, 0 },
  { "ThreeLostReplies", Do::Silence, 3, 0 },
  { "AReply25msLate", Do::Late, 1, 25 },
  { "AReply50msLate", Do::Late, 1, 50 },
  { "TwoReplies25msLate", Do::Late, 2, 25 },
  { "AReply80msLateAfterOneOf25ms", Do::Late, 2, 25, 55 }, // nothing comes between them for long
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(All, FalconShortHiccup, testing::ValuesIn(ShortHiccups), NameOf);

class FalconLateForGood
  : public FalconHiccups
  , public testing::WithParamInterface<Hiccup>
{
};

TEST_P(FalconLateForGood, EndsWithoutForceAndSaysWhy)
{
  ASSERT_TRUE(this->Press());
  const std::size_t first = this->Play(this->GetParam());
  ASSERT_TRUE(this->Wait([&] { return this->Device->GetState() == vtkHapticDevice::Faulted; }));
  const std::string problem = this->Device->GetErrorMessage();
  EXPECT_TRUE(problem.find("ms late") != std::string::npos ||
    problem.find("did not answer") != std::string::npos)
    << problem;
  const std::vector<haptics::FalconCommand> commands = this->CommandsFrom(first);
  for (std::size_t i = 1; i < commands.size(); ++i)
  {
    EXPECT_EQ(Largest(commands[i].Torques), 0) << "packet " << i;
  }
  EXPECT_TRUE(this->Wait([&] { return !this->Servo->IsRunning(); }));
}

// clang-format off
const Hiccup Latenesses[] = {
  { "By25ms", Do::Late, Always, 25 },
  { "By35ms", Do::Late, Always, 35 },
  { "By60ms", Do::Late, Always, 60 },
  { "By90ms", Do::Late, Always, 90 },
  { "By200ms", Do::Late, Always, 200 },
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(All, FalconLateForGood, testing::ValuesIn(Latenesses), NameOf);

TEST_F(FalconHiccups, SoftenSurfacesWhereRepliesAreLateButNotTooLate)
{
  ASSERT_TRUE(this->Press());
  const double damping = this->Device->GetDamping();
  ASSERT_GT(damping, 0.0);
  EXPECT_LE(this->Servo->GetReadings()->GetStiffness(), 0.9 * damping / 0.0025 + 1e-9)
    << "1 kHz and the latency that the device states";
  this->Play({ "", Do::Late, Always, 8 });
  EXPECT_TRUE(this->Wait(
    [&]
    {
      const double stiffness = this->Servo->GetReadings()->GetStiffness();
      return stiffness > 0.0 && stiffness <= 0.9 * damping / (0.0005 + 0.016);
    }))
    << this->Servo->GetReadings()->GetStiffness();
}

TEST_F(FalconHiccups, SendNoForceOfAServoThatDoesNotKnowOfThem)
{
  this->Bus.Plug(1, FalconModel());
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run([&] { return this->GotForce(); }, Push));
  const auto channel = this->Device->GetChannel();
  haptics::DeviceSample before;
  ASSERT_TRUE(channel->Read(Now(), before));
  // The servo falls silent, so that its force is withdrawn.
  const auto count = [&] { return this->CommandsFrom(0).size(); };
  ASSERT_TRUE(this->Wait([&] { return this->EndsWithoutForce(); }));
  for (std::size_t enough = count() + 10; count() < enough;)
  {
    channel->Write(Push); // made for the position before
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    ASSERT_TRUE(this->EndsWithoutForce());
  }
  haptics::DeviceSample after;
  ASSERT_TRUE(
    this->Wait([&] { return channel->Read(Now(), after) && after.Releases != before.Releases; }));
  ASSERT_TRUE(this->Run([&] { return !this->EndsWithoutForce(); }, Push));
}
}
