#include "../Devices/EventCounter.h"
#include "ScriptedDevice.h"
#include "ServoTestTools.h"
#include "haptics/Servo/ServoStatistics.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkHapticReadings.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <thread>

using haptics::TickRecord;

namespace
{
/// The simulated device, stroking 2 mm below a plane at z = 0 for 1 s or more.
class HapticServo : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Device->SetMotionToStroke();
    this->Device->SetStrokeBounds(-0.02, 0.02, -0.02, 0.02, 0.0, 0.0);
    this->Device->SetPressDepth(0.002);
    this->Device->SetStrokeClearance(0.002);
    this->Device->SetSpeed(0.1);
    ASSERT_TRUE(this->Device->Open()) << this->Device->GetErrorMessage();
    this->Servo->SetDevice(this->Device);
    // A busy machine is no fault in a test.
    this->Servo->SetStallLimit(60.0);
    this->Servo->GetSafety()->LoosenMissedTickShare(60.0);
    this->Servo->GetSafety()->LoosenWatchdogTime(1.0);
    this->Servo->PublishGodObject(MakeGodObject(MakePlane()));
  }

  /// Updates until that many ticks are done or the servo has ended.
  void WaitForTicks(int ticks)
  {
    while (this->Servo->GetNumberOfTicks() < ticks && this->Servo->IsRunning())
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      this->Servo->Update();
    }
    this->Servo->Update();
  }

  double DeviceForce()
  {
    double force[3];
    this->Device->GetForce(force);
    return std::hypot(force[0], force[1], force[2]);
  }

  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticServo> Servo;
};

TEST_F(HapticServo, StrokesAPlaneInVirtualTime)
{
  EXPECT_EQ(this->Servo->Step(1000), 1000);
  EXPECT_STREQ(this->Servo->GetStateAsString(), "Stepping");
  double force[3];
  double hip[3];
  double god[3];
  this->Servo->GetReadings()->GetForce(force);
  this->Servo->GetReadings()->GetHapticInterfacePoint(hip);
  this->Servo->GetReadings()->GetGodObject(god);
  EXPECT_NEAR(force[2], 1.0, 2e-3) << "500 N/m, 2 mm deep, standing off by a millionth of the size";
  EXPECT_NEAR(hip[2], -0.002, 1e-12);
  EXPECT_NEAR(god[2], 0.0, 4e-6);
  EXPECT_EQ(this->Servo->GetReadings()->GetNumberOfConstraints(), 1);
  EXPECT_NEAR(this->Servo->GetReadings()->GetPenetration(), 0.002, 4e-6);
  EXPECT_NEAR(this->Servo->GetReadings()->GetTime(), 0.999, 1e-12);
  EXPECT_NEAR(this->DeviceForce(), 1.0, 2e-3) << "the device was asked for the same";
}

TEST_F(HapticServo, GivesTheSameTicksInEveryRunInVirtualTime)
{
  std::vector<TickRecord> runs[2];
  for (std::vector<TickRecord>& run : runs)
  {
    ASSERT_EQ(this->Servo->Step(700), 700);
    ASSERT_EQ(this->Servo->Step(800), 800);
    this->Servo->DrainRecords(run);
    this->Servo->Stop();
  }
  ASSERT_EQ(runs[0].size(), 1500u);
  ASSERT_EQ(runs[1].size(), 1500u);
  for (std::size_t i = 0; i < runs[0].size(); ++i)
  {
    ASSERT_EQ(runs[0][i].Time, runs[1][i].Time);
    ASSERT_EQ(runs[0][i].Hip, runs[1][i].Hip);
    ASSERT_EQ(runs[0][i].Position, runs[1][i].Position);
    ASSERT_EQ(runs[0][i].Force, runs[1][i].Force);
  }
}

TEST_F(HapticServo, HasExactPeriodsInVirtualTime)
{
  this->Servo->SetRate(500.0);
  ASSERT_EQ(this->Servo->Step(100), 100);
  EXPECT_EQ(this->Servo->GetNumberOfTicks(), 100);
  EXPECT_EQ(this->Servo->GetReadings()->GetNumberOfMissedTicks(), 0);
  EXPECT_NEAR(this->Servo->GetReadings()->GetMeasuredRate(), 500.0, 1e-6);
  EXPECT_NEAR(this->Servo->GetReadings()->GetPeriodRatio(), 0.002, 1e-12);
  EXPECT_NEAR(this->Servo->GetReadings()->GetMaximumPeriod(), 0.002, 1e-12);
  EXPECT_NEAR(this->Servo->GetReadings()->GetTime(), 99 * 0.002, 1e-12);
}

TEST_F(HapticServo, StrokesAPlaneInRealTime)
{
  EventCounter changes(this->Servo, vtkHapticServo::StateChangedEvent);
  ASSERT_TRUE(this->Servo->Start()) << this->Servo->GetErrorMessage();
  EXPECT_TRUE(this->Servo->IsRunning());
  EXPECT_EQ(this->Servo->GetState(), vtkHapticServo::Running);
  EXPECT_STRNE(this->Servo->GetPriorityNote(), "");
  this->WaitForTicks(1000);
  this->Servo->Stop();

  EXPECT_EQ(changes.Count, 2) << "Running, then Stopped";
  EXPECT_EQ(this->Servo->GetState(), vtkHapticServo::Stopped);
  EXPECT_EQ(this->DeviceForce(), 0.0);
  std::vector<TickRecord> records;
  this->Servo->DrainRecords(records);
  const auto ticks = static_cast<std::size_t>(this->Servo->GetNumberOfTicks());
  ASSERT_GE(ticks, 1000u);
  EXPECT_EQ(
    records.size() + static_cast<std::size_t>(this->Servo->GetReadings()->GetNumberOfLostRecords()),
    ticks);
  std::size_t touching = 0;
  for (const TickRecord& record : records)
  {
    touching += record.NumberOfConstraints > 0;
    ASSERT_LE(record.Force[2], 1.0 + 2e-3);
  }
  EXPECT_GT(touching, records.size() / 2);
  EXPECT_GE(this->Servo->GetReadings()->GetPeriodRatio(),
    this->Servo->GetReadings()->GetMeanPeriod() * (1.0 - 1e-12));
  EXPECT_LE(this->Servo->GetReadings()->GetTickTimeQuantile(0.5),
    this->Servo->GetReadings()->GetTickTimeQuantile(0.999));
}

TEST_F(HapticServo, CountsTheSameInItsHistograms)
{
  ASSERT_EQ(this->Servo->Step(200), 200);
  vtkTypeInt64 periods = 0;
  vtkTypeInt64 tickTimes = 0;
  for (int bin = 0; bin < vtkHapticReadings::GetNumberOfHistogramBins(); ++bin)
  {
    ASSERT_LT(
      vtkHapticReadings::GetHistogramEdge(bin), vtkHapticReadings::GetHistogramEdge(bin + 1));
    periods += this->Servo->GetReadings()->GetPeriodCount(bin);
    tickTimes += this->Servo->GetReadings()->GetTickTimeCount(bin);
  }
  EXPECT_EQ(periods, 199);
  EXPECT_EQ(tickTimes, 200);
  EXPECT_EQ(this->Servo->GetReadings()->GetPeriodCount(-1), 0);
  EXPECT_EQ(
    this->Servo->GetReadings()->GetPeriodCount(vtkHapticReadings::GetNumberOfHistogramBins()), 0);
}

TEST_F(HapticServo, ReportsThatTheDeviceWasClosedWhileItRan)
{
  EventCounter errors(this->Servo, vtkCommand::ErrorEvent);
  ASSERT_TRUE(this->Servo->Start()) << this->Servo->GetErrorMessage();
  this->WaitForTicks(150);
  this->Device->Close();
  this->WaitForTicks(1000000);
  EXPECT_EQ(this->Servo->GetState(), vtkHapticServo::DeviceLost);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(std::string(this->Servo->GetErrorMessage()).find("device"), std::string::npos);
  double force[3] = { 1.0, 1.0, 1.0 };
  this->Servo->GetReadings()->GetForce(force);
  EXPECT_EQ(std::hypot(force[0], force[1], force[2]), 0.0);
  EXPECT_EQ(this->DeviceForce(), 0.0);

  ASSERT_TRUE(this->Device->Open());
  EXPECT_TRUE(this->Servo->Start()) << "a fault is over with the next start";
  EXPECT_STREQ(this->Servo->GetErrorMessage(), "");
}

TEST_F(HapticServo, StopsStepsAtAClosedDevice)
{
  EventCounter errors(this->Servo, vtkCommand::ErrorEvent);
  ASSERT_EQ(this->Servo->Step(200), 200);
  this->Device->Close();
  EXPECT_EQ(this->Servo->Step(10), 0);
  EXPECT_EQ(this->Servo->GetState(), vtkHapticServo::DeviceLost);
  EXPECT_EQ(this->Servo->Step(10), 0) << "and the device is still closed";
  EXPECT_EQ(errors.Count, 2);
}

TEST_F(HapticServo, LimitsStiffnessAndForceToTheDevices)
{
  this->Servo->SetStiffness(5000.0);
  EXPECT_NEAR(this->Servo->GetEffectiveStiffness(), 0.9 * 1000.0, 1e-9) << "2b/T, a tenth below";
  this->Device->SetDamping(0.0); // unknown
  EXPECT_EQ(this->Servo->Step(0), 0);
  EXPECT_EQ(this->Servo->GetEffectiveStiffness(), 1000.0);
  EXPECT_EQ(this->Servo->GetStiffnessLimit(), 1000.0) << "whatever is asked for";
  EXPECT_EQ(this->Servo->GetEffectiveMaximumForce(), 3.3);
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  EXPECT_NEAR(this->DeviceForce(), 2.0, 4e-3) << "1000 N/m, 2 mm deep";
  this->Servo->SetMaximumForce(0.5);
  ASSERT_EQ(this->Servo->Step(1), 1);
  EXPECT_NEAR(this->DeviceForce(), 0.5, 1e-12);
}

TEST_F(HapticServo, RefusesSettingsOutOfRangeAndKeepsTheOldOnes)
{
  EventCounter errors(this->Servo, vtkCommand::ErrorEvent);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  this->Servo->SetStiffness(-1.0);
  this->Servo->SetStiffness(nan);
  this->Servo->SetMaximumForce(-1.0);
  this->Servo->SetMaximumForce(nan);
  EXPECT_FALSE(this->Servo->SetWorkspaceTransform(nullptr));
  vtkNew<vtkMatrix4x4> mirror;
  mirror->SetElement(0, 0, -1.0);
  EXPECT_FALSE(this->Servo->SetWorkspaceTransform(mirror));
  EXPECT_EQ(this->Servo->PublishGodObject(nullptr), 0u);
  this->Servo->SetRate(nan);
  this->Servo->SetStallLimit(nan);
  EXPECT_EQ(errors.Count, 9);
  EXPECT_EQ(this->Servo->GetStiffness(), 500.0);
  EXPECT_EQ(this->Servo->GetRate(), 1000.0);
  EXPECT_EQ(this->Servo->GetStallLimit(), 60.0);
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  EXPECT_NEAR(this->DeviceForce(), 1.0, 2e-3);
}

TEST_F(HapticServo, ClampsItsRateAndItsStallLimit)
{
  this->Servo->SetRate(0.0);
  EXPECT_EQ(this->Servo->GetRate(), 50.0);
  this->Servo->SetRate(1e9);
  EXPECT_EQ(this->Servo->GetRate(), 10000.0);
  this->Servo->SetStallLimit(0.0);
  EXPECT_EQ(this->Servo->GetStallLimit(), 0.05);
  this->Servo->SetStallLimit(1e9);
  EXPECT_EQ(this->Servo->GetStallLimit(), 60.0);
}

TEST_F(HapticServo, MovesTheHandThroughTheWorkspaceTransform)
{
  vtkNew<vtkMatrix4x4> matrix;
  const double elements[16] = { 1000, 0, 0, 5, 0, 1000, 0, 6, 0, 0, 1000, 0, 0, 0, 0, 1 };
  matrix->DeepCopy(elements);
  ASSERT_TRUE(this->Servo->SetWorkspaceTransform(matrix));
  this->Servo->PublishGodObject(MakeGodObject(MakePlane(0.0, 100.0))); // millimetres
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  double device[3];
  double hip[3];
  this->Servo->GetReadings()->GetDevicePosition(device);
  this->Servo->GetReadings()->GetHapticInterfacePoint(hip);
  EXPECT_NEAR(hip[0], 1000.0 * device[0] + 5.0, 1e-9);
  EXPECT_NEAR(hip[1], 1000.0 * device[1] + 6.0, 1e-9);
  EXPECT_NEAR(hip[2], -2.0, 1e-9);
  EXPECT_NEAR(this->DeviceForce(), 1.0, 2e-3) << "the device has metres, whatever the world's unit";
  vtkNew<vtkMatrix4x4> back;
  this->Servo->GetWorkspaceTransform(back);
  EXPECT_NEAR(back->GetElement(1, 3), 6.0, 1e-12);
  EXPECT_NEAR(back->GetElement(2, 2), 1000.0, 1e-9);
}

TEST_F(HapticServo, StaysOnItsSideSoftlyWhenTheWorkspaceTransformHasChanged)
{
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  vtkNew<vtkMatrix4x4> matrix;
  ASSERT_TRUE(this->Servo->SetWorkspaceTransform(matrix)); // the identity, as it was
  ASSERT_EQ(this->Servo->Step(1), 1);
  EXPECT_NEAR(this->DeviceForce(), 1.0, 2e-3);
  matrix->SetElement(2, 3, -0.01);
  ASSERT_TRUE(this->Servo->SetWorkspaceTransform(matrix));
  ASSERT_EQ(this->Servo->Step(1), 1);
  EXPECT_NEAR(this->DeviceForce(), 1.0 + 3.3 * 0.001 / 0.1, 2e-3) << "12 mm below the plane";
  ASSERT_EQ(this->Servo->Step(100), 100);
  EXPECT_NEAR(this->DeviceForce(), 3.3, 1e-9);
}

TEST_F(HapticServo, StartsAnewAtTheHipWhenAsked)
{
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  this->Servo->PlaceGodObject();
  ASSERT_EQ(this->Servo->Step(1), 1);
  EXPECT_EQ(this->DeviceForce(), 0.0);
}

TEST_F(HapticServo, HasAWatchdogThatWaitsForTheNextTickToBeDue)
{
  this->Servo->SetRate(50.0); // a period of 20 ms
  this->Servo->GetSafety()->SetWatchdogTime(0.005);
  ASSERT_TRUE(this->Servo->Start());
  this->WaitForTicks(20);
  this->Servo->Stop();
  EXPECT_LT(this->Servo->GetReadings()->GetNumberOfHalts(), 10)
    << "not between every two ticks; on a busy "
       "machine after some";
}

TEST_F(HapticServo, DoesNotStartWithoutAnOpenDevice)
{
  vtkNew<vtkHapticServo> servo;
  EventCounter errors(servo, vtkCommand::ErrorEvent);
  EXPECT_FALSE(servo->Start());
  EXPECT_NE(std::string(servo->GetErrorMessage()).find("SetDevice"), std::string::npos);
  this->Device->Close();
  servo->SetDevice(this->Device);
  EXPECT_FALSE(servo->Start());
  EXPECT_NE(std::string(servo->GetErrorMessage()).find("Open"), std::string::npos);
  EXPECT_EQ(servo->Step(1), 0);
  EXPECT_EQ(errors.Count, 3);
  EXPECT_EQ(servo->GetState(), vtkHapticServo::Stopped);
}

TEST_F(HapticServo, DoesNotStepWhileItRuns)
{
  EventCounter errors(this->Servo, vtkCommand::ErrorEvent);
  ASSERT_TRUE(this->Servo->Start());
  EXPECT_EQ(this->Servo->Step(1), 0);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_TRUE(this->Servo->IsRunning());
}

TEST_F(HapticServo, AsksForNoForceWhenItsDeviceIsReplacedOrItIsDestroyed)
{
  {
    vtkNew<vtkHapticServo> servo;
    servo->SetDevice(this->Device);
    servo->PublishGodObject(MakeGodObject(MakePlane()));
    ASSERT_EQ(servo->Step(1000), 1000);
    EXPECT_GT(this->DeviceForce(), 0.5);
  }
  EXPECT_EQ(this->DeviceForce(), 0.0);
  ASSERT_EQ(this->Servo->Step(1000), 1000);
  EXPECT_GT(this->DeviceForce(), 0.5);
  this->Servo->SetDevice(nullptr);
  EXPECT_EQ(this->DeviceForce(), 0.0);
}

TEST_F(HapticServo, LeavesADeviceThatItGaveUpAlone)
{
  vtkNew<ScriptedDevice> device;
  ASSERT_TRUE(device->Open());
  EventCounter errors(this->Servo, vtkCommand::ErrorEvent);
  this->Servo->SetDevice(device);
  this->Servo->GetSafety()->SetWatchdogTime(0.025);
  ASSERT_TRUE(this->Servo->Start());
  this->WaitForTicks(20);
  device->Hand->Height = std::nan("");
  this->WaitForTicks(1000000);
  ASSERT_EQ(this->Servo->GetState(), vtkHapticServo::InvalidPosition);

  device->Hand->Height = 0.01;
  vtkNew<vtkHapticServo> next;
  next->SetDevice(device);
  next->SetStallLimit(60.0);
  next->GetSafety()->LoosenMissedTickShare(60.0);
  next->GetSafety()->LoosenWatchdogTime(1.0);
  ASSERT_TRUE(next->Start()) << next->GetErrorMessage();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_FALSE(device->Hand->IsHalted()) << "by the watchdog of the servo before";
}

TEST_F(HapticServo, UpdateReturnsWhetherThereIsAnythingNew)
{
  EXPECT_FALSE(this->Servo->Update());
  ASSERT_TRUE(this->Servo->Start());
  while (this->Servo->GetNumberOfTicks() == 0)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(this->Servo->Update());
  this->Servo->Stop();
  EXPECT_FALSE(this->Servo->Update());
}

TEST_F(HapticServo, PrintsWhatItDoes)
{
  this->Servo->Step(10);
  std::ostringstream text;
  this->Servo->Print(text);
  for (const char* expected : { "Rate: 1000 Hz", "State: Stepping", "NumberOfTicks: 10\n" })
  {
    EXPECT_NE(text.str().find(expected), std::string::npos) << expected;
  }
}
}
