#include "../EventCounter.h"
#include "haptics/Devices/DeviceChannel.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{
constexpr double Rounding = 1e-12; // [m]
using Vector = std::array<double, 3>;

void AddPoint(vtkPolyData* path, double x, double y, double z)
{
  if (!path->GetPoints())
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    path->SetPoints(points);
  }
  path->GetPoints()->InsertNextPoint(x, y, z);
}

void AddTimes(vtkPolyData* path, const std::vector<double>& times)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Time");
  for (const double time : times)
  {
    array->InsertNextValue(time);
  }
  path->GetPointData()->AddArray(array);
}

Vector At(vtkSimulatedHapticDevice* device, double time)
{
  Vector position{ NAN, NAN, NAN };
  EXPECT_TRUE(device->GetPositionAt(time, position.data()));
  return position;
}

void ExpectNear(const Vector& a, const Vector& b, double tolerance)
{
  EXPECT_LT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), tolerance)
    << "(" << a[0] << ", " << a[1] << ", " << a[2] << ") and (" << b[0] << ", " << b[1] << ", "
    << b[2] << ")";
}

void ExpectFailsToOpen(vtkSimulatedHapticDevice* device, const std::string& named)
{
  EventCounter errors(device, vtkCommand::ErrorEvent);
  EXPECT_FALSE(device->Open());
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(device->GetState(), vtkHapticDevice::Closed);
  EXPECT_EQ(device->GetChannel(), nullptr);
  EXPECT_NE(std::string(device->GetErrorMessage()).find(named), std::string::npos)
    << device->GetErrorMessage();
}

TEST(SimulatedHapticDevice, ReportsEveryChangeOfState)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  EventCounter changes(device, vtkHapticDevice::StateChangedEvent);
  EXPECT_STREQ(device->GetStateAsString(), "Closed");
  EXPECT_TRUE(device->Open());
  EXPECT_STREQ(device->GetStateAsString(), "Ready");
  EXPECT_EQ(changes.Count, 2) << "Opening, then Ready";
  EXPECT_TRUE(device->Open()) << "opening an open device does nothing";
  EXPECT_EQ(changes.Count, 2);
  device->Close();
  device->Close();
  EXPECT_EQ(changes.Count, 3);
  EXPECT_STREQ(device->GetStateAsString(), "Closed");
}

TEST(SimulatedHapticDevice, IsWhereTheCodePutsIt)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetPosition(0.01, 0.02, 0.03);
  device->SetButtons(2);
  ASSERT_TRUE(device->Open());
  haptics::DeviceSample sample;
  ASSERT_TRUE(device->GetChannel()->Read(0.0, sample));
  EXPECT_EQ(sample.Position, (Vector{ 0.01, 0.02, 0.03 })) << "set before Open()";
  EXPECT_EQ(sample.Buttons, 2u);
  device->SetPosition(-0.01, 0.0, 0.0);
  device->SetButtons(1);
  ASSERT_TRUE(device->GetChannel()->Read(0.001, sample));
  EXPECT_EQ(sample.Position, (Vector{ -0.01, 0.0, 0.0 }));
  EXPECT_EQ(sample.Buttons, 1u);
}

TEST(SimulatedHapticDevice, RefusesAPositionThatIsNotFinite)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  EventCounter errors(device, vtkCommand::ErrorEvent);
  ASSERT_TRUE(device->Open());
  device->SetPosition(0.01, 0.02, 0.03);
  device->SetPosition(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(At(device, 0.0), (Vector{ 0.01, 0.02, 0.03 }));
}

TEST(SimulatedHapticDevice, KeepsThePositionAndForceOfTheLastTick)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetPosition(0.01, 0.02, 0.03);
  device->SetButtons(1);
  ASSERT_TRUE(device->Open());
  const auto channel = device->GetChannel();
  haptics::DeviceSample sample;
  ASSERT_TRUE(channel->Read(0.0, sample));
  channel->Write({ 1.0, 2.0, 3.0 });
  Vector position;
  Vector force;
  device->GetPosition(position.data());
  device->GetForce(force.data());
  EXPECT_EQ(position, (Vector{ 0.01, 0.02, 0.03 }));
  EXPECT_EQ(force, (Vector{ 1.0, 2.0, 3.0 }));
  EXPECT_EQ(device->GetButtons(), 1u);
}

TEST(SimulatedHapticDevice, LeavesItsChannelSafeAfterCloseAndDestruction)
{
  std::shared_ptr<haptics::DeviceChannel> channel;
  haptics::DeviceSample sample;
  {
    vtkNew<vtkSimulatedHapticDevice> device;
    ASSERT_TRUE(device->Open());
    channel = device->GetChannel();
    EXPECT_TRUE(channel->Read(0.0, sample));
    device->Close();
    EXPECT_FALSE(channel->Read(0.001, sample));
    channel->Write({ 0.0, 0.0, 0.0 });
    ASSERT_TRUE(device->Open());
    EXPECT_FALSE(channel->Read(0.002, sample)) << "an old channel stays closed";
    channel = device->GetChannel();
    EXPECT_TRUE(channel->Read(0.003, sample));
  }
  EXPECT_FALSE(channel->Read(0.004, sample));
}

TEST(SimulatedHapticDevice, FollowsThePointsOfALineCellInTheCellsOrder)
{
  vtkNew<vtkPolyData> path;
  AddPoint(path, 0.0, 0.0, 0.0);
  AddPoint(path, 9.0, 9.0, 9.0); // not in the line
  AddPoint(path, 0.1, 0.0, 0.0);
  vtkNew<vtkCellArray> lines;
  const vtkIdType ids[2] = { 2, 0 };
  lines->InsertNextCell(2, ids);
  path->SetLines(lines);

  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToPolyline();
  device->SetPath(path);
  device->SetSpeed(0.05);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_NEAR(device->GetDuration(), 2.0, Rounding);
  ExpectNear(At(device, 0.0), { 0.1, 0.0, 0.0 }, Rounding);
  ExpectNear(At(device, 1.0), { 0.05, 0.0, 0.0 }, Rounding);
  haptics::DeviceSample sample;
  ASSERT_TRUE(device->GetChannel()->Read(1.0, sample));
  EXPECT_EQ(sample.Position, At(device, 1.0));
}

TEST(SimulatedHapticDevice, FollowsTheTimeArrayInsteadOfTheSpeed)
{
  vtkNew<vtkPolyData> path;
  AddPoint(path, 0.0, 0.0, 0.0);
  AddPoint(path, 0.1, 0.0, 0.0);
  AddTimes(path, { 5.0, 15.0 });
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToPolyline();
  device->SetPath(path);
  device->LoopOn();
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  ExpectNear(At(device, 5.0), { 0.05, 0.0, 0.0 }, Rounding);
  ExpectNear(At(device, 15.0), { 0.05, 0.0, 0.0 }, Rounding);
  ExpectNear(At(device, 20.0), { 0.0, 0.0, 0.0 }, Rounding);
}

TEST(SimulatedHapticDevice, FollowsASmoothCurveThroughThePoints)
{
  // A quarter of a circle of 0.1 m in steps of 15 degrees.
  vtkNew<vtkPolyData> path;
  const double pi = std::acos(-1.0);
  for (int i = 0; i <= 6; ++i)
  {
    AddPoint(path, 0.1 * std::cos(i * pi / 12), 0.1 * std::sin(i * pi / 12), 0.0);
  }
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToSpline();
  device->SetPath(path);
  device->SetSpeed(0.1);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  // A straight chord sags by 0.86 mm. The inner spans must do far better; the first and last lack
  // a neighbour to bend by.
  EXPECT_NEAR(device->GetDuration(), 0.5 * pi, 0.01);
  double worst = 0.0;
  for (double t = 0.27; t < 1.3; t += 0.001)
  {
    const Vector p = At(device, t);
    worst = std::max(worst, std::abs(std::hypot(p[0], p[1]) - 0.1));
  }
  EXPECT_LT(worst, 1e-4);
  ExpectNear(At(device, 0.0), { 0.1, 0.0, 0.0 }, Rounding);
  ExpectNear(At(device, 9.0), { 0.0, 0.1, 0.0 }, Rounding);
}

TEST(SimulatedHapticDevice, PassesASplinesPointsAtTheirTimes)
{
  vtkNew<vtkPolyData> path;
  AddPoint(path, 0.0, 0.0, 0.0);
  AddPoint(path, 0.1, 0.1, 0.0);
  AddPoint(path, 0.2, 0.0, 0.0);
  AddTimes(path, { 0.0, 1.0, 4.0 });
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToSpline();
  device->SetPath(path);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  ExpectNear(At(device, 0.0), { 0.0, 0.0, 0.0 }, Rounding);
  ExpectNear(At(device, 1.0), { 0.1, 0.1, 0.0 }, Rounding);
  ExpectNear(At(device, 4.0), { 0.2, 0.0, 0.0 }, Rounding);
}

TEST(SimulatedHapticDevice, StrokesOverTheBoundsAtItsDepth)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToStroke();
  device->SetStrokeBounds(-0.02, 0.02, -0.01, 0.01, -0.03, 0.0);
  device->SetPressDepth(0.004);
  device->SetSpeed(0.05);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_GT(At(device, 0.0)[2], 0.0);
  int pressed = 0;
  const int samples = 1000;
  for (int i = 0; i < samples; ++i)
  {
    const Vector p = At(device, device->GetDuration() * i / samples);
    EXPECT_GE(p[2], -0.004 - Rounding);
    pressed += std::abs(p[2] + 0.004) < Rounding;
  }
  EXPECT_GT(pressed, samples * 3 / 4);
}

TEST(SimulatedHapticDevice, StaysClosedWithAPathItCannotFollow)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToPolyline();
  ExpectFailsToOpen(device, "SetPath");

  vtkNew<vtkPolyData> path;
  device->SetPath(path);
  ExpectFailsToOpen(device, "points");

  AddPoint(path, 0.0, 0.0, 0.0);
  AddPoint(path, 0.1, std::numeric_limits<double>::quiet_NaN(), 0.0);
  ExpectFailsToOpen(device, "Point 1");

  path->GetPoints()->SetPoint(1, 0.1, 0.0, 0.0);
  AddTimes(path, { 1.0, 1.0 });
  ExpectFailsToOpen(device, "Time 1");

  path->GetPointData()->RemoveArray("Time");
  AddTimes(path, { 1.0 });
  ExpectFailsToOpen(device, "1 values for 2 points");

  path->GetPointData()->RemoveArray("Time");
  vtkNew<vtkCellArray> lines;
  const vtkIdType ids[2] = { 0, 1 };
  lines->InsertNextCell(2, ids);
  lines->InsertNextCell(2, ids);
  path->SetLines(lines);
  ExpectFailsToOpen(device, "2 line cells");

  path->SetLines(nullptr);
  EXPECT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_STREQ(device->GetErrorMessage(), "") << "a success forgets the old error";
}

TEST(SimulatedHapticDevice, StaysClosedWithASettingThatIsNoNumber)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMass(nan);
  ExpectFailsToOpen(device, "Mass is not a number");
  device->SetMass(0.1);
  device->SetMaximumForce(nan);
  ExpectFailsToOpen(device, "MaximumForce is not a number");
  device->SetMaximumForce(3.0);
  EXPECT_TRUE(device->Open()) << device->GetErrorMessage();
}

TEST(SimulatedHapticDevice, LetsGoOfItsBodyWhenAWatchdogHaltsIt)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->BodyOn();
  device->SetHandStiffness(0.0);
  device->SetHandDamping(0.0);
  ASSERT_TRUE(device->Open());
  const auto channel = device->GetChannel();
  haptics::DeviceSample sample;
  ASSERT_TRUE(channel->Read(0.0, sample));
  channel->Write({ 0.0, 0.0, 1.0 });
  ASSERT_TRUE(channel->Read(0.001, sample));
  EXPECT_GT(sample.Position[2], 0.0) << "1 N moves it";
  channel->Write({ 0.0, 0.0, 1.0 });
  channel->Halt(); // the servo slept for half a second, and resumes before its next tick
  channel->Resume();
  ASSERT_TRUE(channel->Read(0.5, sample));
  // 1 N over 1 ms gives 45 g 22 mm/s at most, which 0.35 N s/m stop within 2.9 mm.
  EXPECT_LT(sample.Position[2], 0.0029);
}

TEST(SimulatedHapticDevice, StaysClosedWithASplineThroughOnePoint)
{
  vtkNew<vtkPolyData> path;
  AddPoint(path, 0.0, 0.0, 0.0);
  AddPoint(path, 0.0, 0.0, 0.0);
  vtkNew<vtkSimulatedHapticDevice> device;
  device->SetMotionToSpline();
  device->SetPath(path);
  ExpectFailsToOpen(device, "two different points");
}

TEST(SimulatedHapticDevice, HasTheDampingThatItsStiffnessNeedsUntilOneIsSet)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  EXPECT_EQ(device->GetDamping(), 0.5) << "1000 N/m at 1 kHz";
  device->SetMaximumStiffness(2000.0);
  EXPECT_EQ(device->GetDamping(), 1.0);
  device->SetDamping(0.35);
  device->SetMaximumStiffness(3000.0);
  EXPECT_EQ(device->GetDamping(), 0.35);
  device->SetPreset(vtkSimulatedHapticDevice::Omni);
  EXPECT_DOUBLE_EQ(device->GetDamping(), 0.35) << "that of 700 N/m";
  device->SetMaximumStiffness(-1.0);
  EXPECT_EQ(device->GetMaximumStiffness(), 0.0);
  EXPECT_EQ(device->GetDamping(), 0.0) << "not known";
}

TEST(SimulatedHapticDevice, PrintsItsStateAndLimitsWithUnits)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  std::ostringstream text;
  device->Print(text);
  for (const char* expected : { "State: Closed", "MaximumForce: 3.3 N", "Motion: Manual" })
  {
    EXPECT_NE(text.str().find(expected), std::string::npos) << expected;
  }
}
}
