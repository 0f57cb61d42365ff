// What every device that a thread drives has to keep, whatever its hardware: the force that it got
// last, read at the hardware's end.
#include "DefaultSignals.h"
#include "DriverBench.h"
#include "ServoTestTools.h"
#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/EndingSignals.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
constexpr int NeverPressed = 97;
constexpr int CameBack = 98;
const Vec Above{ 0.0, 0.0, 0.02 };
const Vec Within{ 0.0, 0.0, -0.003 };

struct Kind
{
  const char* Name;
  std::unique_ptr<DriverBench> (*Make)();
};
void PrintTo(const Kind& kind, std::ostream* os)
{
  *os << kind.Name;
}

void SetUpServo(vtkHapticServo* servo, vtkHapticDevice* device)
{
  servo->SetDevice(device);
  servo->SetStallLimit(60.0);
  servo->GetSafety()->LoosenWatchdogTime(1.0);
  servo->GetSafety()->LoosenMissedTickShare(60.0);
  servo->PublishGodObject(MakeGodObject(MakePlane(0.0, 0.1)));
}

class DriverSafety : public testing::TestWithParam<Kind>
{
protected:
  /// A device over a bench that answers, open.
  void Open()
  {
    this->Bench = GetParam().Make();
    this->Bench->Begin();
    this->Bench->MoveTo(Above);
    this->Device = this->Bench->MakeDevice();
    ASSERT_TRUE(WaitUntilOpen(this->Device)) << this->Device->GetErrorMessage();
  }
  /// A servo that presses 3 mm into a plane. Hardware that a busy machine leaves silent for 0.2 s
  /// is lost, as it has to be: then once more.
  void Press()
  {
    bool isPressing = false;
    for (int attempt = 0; attempt < 5 && !isPressing; ++attempt)
    {
      this->Open();
      SetUpServo(this->Servo, this->Device);
      ASSERT_TRUE(this->Servo->Start());
      const auto wait = [this](const auto& condition)
      { return WaitFor([&] { return condition() || !this->Servo->IsRunning(); }); };
      ASSERT_TRUE(wait([this] { return this->Servo->GetNumberOfTicks() > 20; }));
      this->Bench->MoveTo(Within);
      ASSERT_TRUE(wait(
        [&]
        {
          isPressing = this->Bench->GetForce()[2] > 0.2;
          return isPressing;
        }))
        << this->Device->GetErrorMessage();
    }
    ASSERT_TRUE(isPressing) << this->Device->GetErrorMessage();
  }
  bool BecomesZero() const
  {
    return WaitFor([this] { return this->Bench->GetForce() == Vec{}; });
  }
  /// What a servo would do in a tick.
  void Exchange(const Vec& force)
  {
    haptics::DeviceSample sample;
    this->Channel->WaitForSample(50000000);
    this->Time += 0.001;
    EXPECT_TRUE(this->Channel->Read(this->Time, sample));
    this->Channel->Write(force);
  }
  void Take()
  {
    this->Open();
    this->Channel = this->Device->GetChannel();
    this->Channel->Restart();
  }

  std::unique_ptr<DriverBench> Bench;
  vtkSmartPointer<vtkDriverHapticDevice> Device;
  vtkNew<vtkHapticServo> Servo;
  std::shared_ptr<haptics::DeviceChannel> Channel;
  double Time = 0.0;
};

TEST_P(DriverSafety, TheForceGoesWhereTheServoAsksAndThePositionComesBack)
{
  this->Press();
  const Vec force = this->Bench->GetForce();
  EXPECT_NEAR(force[0], 0.0, 1e-6);
  EXPECT_NEAR(force[1], 0.0, 1e-6);
  EXPECT_GT(force[2], 0.2);
  double position[3];
  EXPECT_TRUE(WaitFor(
    [&]
    {
      this->Device->GetPosition(position);
      return std::abs(position[2] - Within[2]) < 1e-6;
    }));
  EXPECT_TRUE(WaitFor([this] { return this->Device->GetNumberOfExchanges() > 20; }));
  this->Servo->Stop();
  EXPECT_TRUE(this->BecomesZero()) << "after the run";
}

TEST_P(DriverSafety, EachAxisIsItsOwn)
{
  this->Take();
  const Vec place{ 0.01, 0.02, 0.03 };
  this->Bench->MoveTo(place);
  const Vec asked{ 0.3, -0.5, 0.7 };
  EXPECT_TRUE(WaitFor(
    [&]
    {
      this->Exchange(asked);
      const Vec got = this->Bench->GetForce();
      double position[3];
      this->Device->GetPosition(position);
      return std::abs(got[0] - asked[0]) + std::abs(got[1] - asked[1]) +
        std::abs(got[2] - asked[2]) + std::abs(position[0] - place[0]) +
        std::abs(position[1] - place[1]) + std::abs(position[2] - place[2]) <
        1e-6;
    }));
}

TEST_P(DriverSafety, WithoutAServoThereIsNoForce)
{
  this->Open();
  this->Bench->MoveTo(Within);
  EXPECT_TRUE(WaitFor([this] { return this->Device->GetNumberOfExchanges() > 50; }));
  EXPECT_EQ(this->Bench->GetForce(), Vec{});
}

TEST_P(DriverSafety, ClosedWhileItPushesItLeavesNoForce)
{
  this->Press();
  this->Device->Close();
  EXPECT_TRUE(this->BecomesZero());
  this->Device = nullptr; // waits for its thread
  EXPECT_EQ(this->Bench->GetForce(), Vec{});
}

TEST_P(DriverSafety, OpenedAgainItPushesAgain)
{
  this->Press();
  this->Device->Close();
  EXPECT_TRUE(this->BecomesZero());
  this->Servo->Stop();
  this->Bench->MoveTo(Above);
  ASSERT_TRUE(WaitUntilOpen(this->Device)) << this->Device->GetErrorMessage();
  ASSERT_TRUE(this->Servo->Start());
  ASSERT_TRUE(WaitFor([this] { return this->Servo->GetNumberOfTicks() > 20; }));
  this->Bench->MoveTo(Within);
  EXPECT_TRUE(WaitFor([this] { return this->Bench->GetForce()[2] > 0.2; }));
}

TEST_P(DriverSafety, AServoThatFallsSilentLosesItsForceAfterTwentyMilliseconds)
{
  this->Take();
  ASSERT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, 0.0, 1.0 });
      return this->Bench->GetForce()[2] > 0.9;
    }));
  EXPECT_TRUE(this->BecomesZero());
  // It takes the force away first.
  EXPECT_TRUE(WaitFor([this] { return this->Device->GetNumberOfLateCommands() >= 1; }));
  EXPECT_TRUE(WaitFor(
    [this]
    {
      haptics::DeviceSample sample;
      return this->Channel->Read(this->Time, sample) && sample.Releases >= 1;
    }))
    << "so that the next force grows softly";
}

TEST_P(DriverSafety, AForceAboveTheLimitKeepsItsDirection)
{
  this->Take();
  const double limit = this->Device->GetMaximumForce();
  EXPECT_LE(limit, 2.0);
  EXPECT_TRUE(WaitFor(
    [&]
    {
      this->Exchange({ 30.0, 0.0, 40.0 });
      const Vec got = this->Bench->GetForce();
      EXPECT_LE(Magnitude(got), limit * (1.0 + 1e-9));
      return std::abs(got[0] - 0.6 * limit) + std::abs(got[2] - 0.8 * limit) < 1e-6;
    }));
}

TEST_P(DriverSafety, AForceThatIsNoNumberIsNone)
{
  this->Take();
  ASSERT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, 0.0, 1.0 });
      return this->Bench->GetForce()[2] > 0.9;
    }));
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, std::numeric_limits<double>::quiet_NaN(), 1.0 });
      return this->Bench->GetForce() == Vec{};
    }));
}

TEST_P(DriverSafety, WhatTheWatchdogHaltsStaysWithoutForceUntilTheServoGoesOn)
{
  this->Take();
  ASSERT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, 0.0, 1.0 });
      return this->Bench->GetForce()[2] > 0.9;
    }));
  this->Channel->Halt();
  EXPECT_TRUE(this->BecomesZero());
  for (int i = 0; i < 20; ++i)
  {
    this->Exchange({ 0.0, 0.0, 1.0 });
    EXPECT_EQ(this->Bench->GetForce(), Vec{});
  }
  this->Channel->Resume();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, 0.0, 1.0 });
      return this->Bench->GetForce()[2] > 0.9;
    }));
}

TEST_P(DriverSafety, ADeviceThatAnswersTooLateGetsNoForce)
{
  this->Take();
  this->Bench->SetDelay(40);
  ASSERT_TRUE(WaitFor(
    [this]
    {
      haptics::DeviceSample sample;
      this->Channel->WaitForSample(100000000);
      this->Time += 0.001;
      return this->Channel->Read(this->Time, sample) && sample.Releases > 2;
    }));
  for (int i = 0; i < 5; ++i)
  {
    this->Exchange({ 0.0, 0.0, 1.0 });
    EXPECT_EQ(this->Bench->GetForce(), Vec{});
  }
  this->Bench->SetDelay(0);
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange({ 0.0, 0.0, 1.0 });
      return this->Bench->GetForce()[2] > 0.9;
    }))
    << "once it answers in time";
}

TEST_P(DriverSafety, TheStiffnessStaysBelowWhatItsAssumedDampingAllows)
{
  this->Press();
  EXPECT_GT(this->Device->GetDamping(), 0.0);
  EXPECT_LE(this->Servo->GetStiffness(), this->Device->GetMaximumStiffness());
  // 0.9 b / (T / 2 + latency), and less where the ticks come unevenly, as on a busy machine.
  const auto ticks = this->Servo->GetNumberOfTicks() + 200;
  double strongest = 0.0;
  EXPECT_TRUE(WaitFor(
    [&]
    {
      strongest = std::max(strongest, this->Bench->GetForce()[2]);
      return this->Servo->GetNumberOfTicks() > ticks;
    }));
  EXPECT_GT(strongest, 0.0);
  EXPECT_LT(strongest, 361.0 * 0.003);
}

TEST_P(DriverSafety, ItSaysThatNobodyHasTriedItOnHardware)
{
  this->Bench = GetParam().Make();
  std::ostringstream text;
  this->Bench->MakeDevice()->Print(text);
  EXPECT_NE(text.str().find("TriedOnHardware: no"), std::string::npos);
}

/// For both processes.
struct Stage
{
  std::atomic<bool> Ready{ false };
  std::atomic<bool> Pressed{ false };
};

/// Presses in a child, which then runs `end`; how it ended: by NeverPressed where the machine is
/// too busy to press. The hardware is without force then.
template <typename Function>
int TryToEndWhilePressing(const Kind& kind, Function end)
{
  void* memory =
    mmap(nullptr, sizeof(Stage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  EXPECT_NE(memory, MAP_FAILED);
  auto* stage = new (memory) Stage;
  const auto bench = kind.Make();
  const pid_t child = fork();
  if (child == 0)
  {
    // Static: nothing is ever destroyed.
    static auto* const owner = new vtkSmartPointer<vtkDriverHapticDevice>(bench->MakeDevice());
    vtkDriverHapticDevice* const device = *owner;
    static auto* const servo = vtkHapticServo::New();
    if (!WaitUntilOpen(device))
    {
      _exit(NeverPressed);
    }
    SetUpServo(servo, device);
    if (!servo->Start() || !WaitFor([] { return servo->GetNumberOfTicks() > 20; }))
    {
      _exit(NeverPressed);
    }
    stage->Ready = true;
    if (!WaitFor([stage] { return stage->Pressed.load(); }))
    {
      _exit(NeverPressed);
    }
    end();
    _exit(CameBack);
  }
  bench->MoveTo(Above);
  bench->Begin();
  bool isPressed = WaitFor([stage] { return stage->Ready.load(); });
  bench->MoveTo(Within);
  isPressed = isPressed && WaitFor([&bench] { return bench->GetForce()[2] > 0.2; });
  stage->Pressed = isPressed; // where not, the child gives up
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WaitFor([&bench] { return bench->GetForce() == Vec{}; }))
    << "the last force that the device got: " << bench->GetForce()[2] << " N";
  munmap(memory, sizeof(Stage));
  return status;
}

/// The same, and once more where the machine was too busy for a device to stay open.
template <typename Function>
int EndWhilePressing(const Kind& kind, Function end)
{
  int status = 0;
  for (int attempt = 0; attempt < 5; ++attempt)
  {
    status = TryToEndWhilePressing(kind, end);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != NeverPressed)
    {
      break;
    }
  }
  return status;
}

TEST_P(DriverSafety, TheLastForceBeforeASignalEndsTheProcessIsZero)
{
  for (const int signal : { SIGTERM, SIGINT, SIGPIPE })
  {
    const int status = EndWhilePressing(GetParam(), [signal] { raise(signal); });
    ASSERT_TRUE(WIFSIGNALED(status)) << status;
    EXPECT_EQ(WTERMSIG(status), signal);
  }
}

TEST_P(DriverSafety, TheLastForceBeforeTheProcessExitsIsZero)
{
  const int status = EndWhilePressing(GetParam(), [] { std::exit(3); });
  ASSERT_TRUE(WIFEXITED(status)) << status;
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_P(DriverSafety, TheLastForceBeforeAnExceptionThatNobodyCatchesIsZero)
{
  const int status = EndWhilePressing(GetParam(),
    []
    {
      std::thread thrower([] { throw std::runtime_error("nobody's"); });
      thrower.join();
    });
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
}

const Kind Kinds[] = {
#ifdef HAPTICS_TEST_HAPLY
  { "Haply", MakeHaplyBench },
#endif
#ifdef HAPTICS_TEST_OPENHAPTICS
  { "OpenHaptics", MakeOpenHapticsBench },
#endif
#ifdef HAPTICS_TEST_FORCEDIMENSION
  { "ForceDimension", MakeForceDimensionBench },
#endif
};
INSTANTIATE_TEST_SUITE_P(Devices, DriverSafety, testing::ValuesIn(Kinds),
  [](const testing::TestParamInfo<Kind>& info) { return info.param.Name; });
}
