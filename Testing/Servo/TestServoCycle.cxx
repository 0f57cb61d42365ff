#include "ServoTestTools.h"
#include "haptics/Material/SurfaceProperties.h"
#include "haptics/Servo/RecordingChannel.h"
#include "haptics/Servo/ServoCycle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using haptics::ServoCycle;
using haptics::ServoSettings;
using haptics::ServoState;
using haptics::TickRecord;
using haptics::UpdateStatus;
using haptics::Vec3;

namespace
{
// The god-object may stand off a plane by a millionth of the surface's size, times 500 N/m.
constexpr double ForceTolerance = 2e-3; // [N]
constexpr double Period = 0.001;        // [s]

/// Runs ticks in virtual time, until a fault.
int RunTicks(ServoCycle& cycle, int ticks, int first = 0)
{
  int done = 0;
  while (done < ticks && cycle.Tick((first + done) * Period))
  {
    ++done;
  }
  return done;
}

void ExpectNear(const Vec3& a, const Vec3& b, double tolerance)
{
  EXPECT_LT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), tolerance)
    << "(" << a[0] << ", " << a[1] << ", " << a[2] << ")";
}

/// A hand that presses 2 mm into a plane, for 100 ticks.
std::shared_ptr<ScriptedChannel> PressPlane(ServoCycle& cycle)
{
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  auto channel = MakePressingHand(0.002);
  cycle.Begin(channel, ServoState::Stepping);
  EXPECT_EQ(RunTicks(cycle, 100), 100);
  return channel;
}

TEST(ServoCycle, PushesBackFromAPlaneWithStiffnessTimesDepth)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 1.0 }, ForceTolerance);
  ASSERT_TRUE(cycle.UpdateLatest());
  const TickRecord& latest = cycle.GetLatest();
  EXPECT_EQ(latest.Status, UpdateStatus::Touching);
  EXPECT_EQ(latest.NumberOfConstraints, 1);
  EXPECT_EQ(latest.Generation, 1u);
  EXPECT_NEAR(latest.Penetration, 0.002, ForceTolerance / 500.0);
  EXPECT_EQ(latest.Force, channel->LastForce);
}

TEST(ServoCycle, PushesBackWhereTooManyTrianglesMeetWithPropertiesOrWithout)
{
  haptics::TriangleMesh fan;
  fan.Points.push_back({ 0, 0, 0 });
  const int count = 40000;
  for (int i = 0; i < count; ++i)
  {
    const double a = 2.0 * M_PI * i / count;
    fan.Points.push_back({ std::cos(a), std::sin(a), 0 });
    fan.Triangles.push_back({ 0, 1 + i, 1 + (i + 1) % count });
  }
  std::string error;
  const auto surface = haptics::TriangleSurface::Build(std::move(fan), {}, error);
  ASSERT_TRUE(surface) << error;
  haptics::PropertyValues rough;
  rough[haptics::Property::StaticFriction].Constant = 0.3;
  rough[haptics::Property::DynamicFriction].Constant = 0.2;
  const auto material = haptics::SurfaceProperties::Build(rough, *surface, error);
  ASSERT_TRUE(material) << error;
  for (const auto& properties : { decltype(material)(), material })
  {
    ServoCycle cycle(1024);
    cycle.GetExchange().Publish(std::make_unique<haptics::GodObject>(
      std::vector<haptics::TouchedSurface>{ { surface, nullptr, properties } }));
    const auto channel = MakePressingHand(0.002);
    cycle.Begin(channel, ServoState::Stepping);
    ASSERT_EQ(RunTicks(cycle, 150), 150);
    ASSERT_TRUE(cycle.UpdateLatest());
    EXPECT_EQ(cycle.GetLatest().Status, UpdateStatus::Overloaded);
    const double depth = cycle.GetLatest().Penetration;
    EXPECT_GT(depth, 0.0019);
    ExpectNear(channel->LastForce, { 0.0, 0.0, 500.0 * depth }, ForceTolerance);
  }
}

TEST(ServoCycle, AsksForNoForceInFreeSpace)
{
  ServoCycle cycle(1024);
  const auto channel = MakePressingHand(0.002);
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 100), 100);
  EXPECT_EQ(channel->LastForce, NoForce);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_EQ(cycle.GetLatest().Generation, 0u);
}

TEST(ServoCycle, GivesTheSameForceWhateverTheWorldsUnitAndAxes)
{
  // The device's z axis is the world's x axis, in kilometres of terrain or nanometres of tissue.
  for (const double scale : { 1e-6, 1.0, 3e4 })
  {
    ServoCycle cycle(1024);
    haptics::TriangleMesh mesh;
    mesh.Points = { { 0, -scale, -scale }, { 0, scale, -scale }, { 0, scale, scale },
      { 0, -scale, scale } };
    mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
    haptics::SurfaceOptions options;
    options.TouchedSide = haptics::Side::Front;
    std::string error;
    const auto plane = haptics::TriangleSurface::Build(mesh, options, error);
    ASSERT_TRUE(plane) << error;
    cycle.GetExchange().Publish(MakeGodObject(plane));
    ServoSettings settings;
    const double s = scale;
    const double matrix[16] = { 0, 0, s, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 0, 1 };
    ASSERT_TRUE(settings.DeviceToWorld.SetMatrix(matrix, error)) << error;
    cycle.Configure(settings);
    const auto channel = MakePressingHand(0.002);
    cycle.Begin(channel, ServoState::Stepping);
    ASSERT_EQ(RunTicks(cycle, 100), 100);
    ExpectNear(channel->LastForce, { 0.0, 0.0, 1.0 }, ForceTolerance);
    ASSERT_TRUE(cycle.UpdateLatest());
    ExpectNear(cycle.GetLatest().WorldForce, { 1.0, 0.0, 0.0 }, ForceTolerance);
    EXPECT_NEAR(cycle.GetLatest().Penetration / scale, 0.002, ForceTolerance / 500.0);
  }
}

TEST(ServoCycle, ShortensAForceOverTheLimit)
{
  ServoCycle cycle(1024);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  ServoSettings settings;
  settings.Force.MaximumForce = 0.25;
  cycle.Configure(settings);
  const auto channel = MakePressingHand(0.002);
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 200), 200); // it starts softly
  ExpectNear(channel->LastForce, { 0.0, 0.0, 0.25 }, 1e-12);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_TRUE(cycle.GetLatest().Limits & haptics::ForceClamped);
}

TEST(ServoCycle, TakesALowerStiffnessAtTheNextTickAndAHigherOneSlowly)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  ServoSettings settings;
  settings.Force.Stiffness = 250.0;
  cycle.Configure(settings);
  ASSERT_EQ(RunTicks(cycle, 1, 100), 1);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 0.5 }, ForceTolerance);
  settings.Force.Stiffness = 1000.0;
  cycle.Configure(settings);
  ASSERT_EQ(RunTicks(cycle, 1, 101), 1);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 0.52 }, ForceTolerance);
  ASSERT_EQ(RunTicks(cycle, 100, 102), 100);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 2.0 }, 2.0 * ForceTolerance);
}

TEST(ServoCycle, AsksForNoForceFromTheTickOnInWhichTheDeviceIsLost)
{
  ServoCycle cycle(1024);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  auto channel = MakePressingHand(0.002);
  const auto press = channel->Hand;
  channel->Hand = [press](double time, haptics::DeviceSample& sample)
  { return press(time, sample) && time < 0.0995; };
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 200), 100);
  EXPECT_EQ(channel->LastForce, NoForce);
  EXPECT_EQ(channel->Writes, 101);
  EXPECT_EQ(cycle.GetState(), ServoState::DeviceLost);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_EQ(cycle.GetLatest().Force, NoForce);
  EXPECT_EQ(cycle.GetLatest().WorldForce, NoForce);
}

TEST(ServoCycle, AsksForNoForceAtAPositionThatIsNotFinite)
{
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      ServoCycle cycle(1024);
      cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
      auto channel = MakePressingHand(0.002);
      const auto press = channel->Hand;
      channel->Hand = [=](double time, haptics::DeviceSample& sample)
      {
        press(time, sample);
        if (time > 0.0995)
        {
          sample.Position[axis] = bad;
        }
        return true;
      };
      cycle.Begin(channel, ServoState::Stepping);
      ASSERT_EQ(RunTicks(cycle, 200), 100);
      EXPECT_EQ(channel->LastForce, NoForce);
      EXPECT_EQ(cycle.GetState(), ServoState::InvalidPosition);
    }
  }
}

TEST(ServoCycle, AsksForNoForceWhereTheDisplacementIsNotFiniteInTheDeviceFrame)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  ServoSettings settings;
  settings.DeviceToWorld.Scale = 1e-310; // [world unit/m]: a displacement of 1 is over 1e308 m
  settings.DeviceToWorld.Translation = { 0.0, 0.0, -1.0 };
  cycle.Configure(settings);
  EXPECT_EQ(RunTicks(cycle, 1, 100), 0);
  EXPECT_EQ(channel->LastForce, NoForce);
  EXPECT_EQ(cycle.GetState(), ServoState::InvalidForce);
}

TEST(ServoCycle, AsksForNoForceAtAnAbsurdlyFarPositionButGoesOn)
{
  ServoCycle cycle(1024);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  auto channel = MakePressingHand(0.002);
  const auto press = channel->Hand;
  channel->Hand = [press](double time, haptics::DeviceSample& sample)
  {
    press(time, sample);
    if (std::abs(time - 0.1) < 0.0005)
    {
      sample.Position[2] = -1e300;
    }
    return true;
  };
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 101), 101);
  EXPECT_EQ(channel->LastForce, NoForce);
  ASSERT_EQ(RunTicks(cycle, 10, 101), 10);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 1.0 }, ForceTolerance);
}

TEST(ServoCycle, AsksForNoForceAtItsEnd)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  ASSERT_NE(channel->LastForce, NoForce);
  cycle.End(ServoState::Stopped);
  EXPECT_EQ(channel->LastForce, NoForce);
  EXPECT_EQ(cycle.GetState(), ServoState::Stopped);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_EQ(cycle.GetLatest().Force, NoForce);
}

/// A device that gets forces later than they are written.
class SettlingChannel : public ScriptedChannel
{
public:
  std::vector<Vec3> Settled; ///< what was written last each time that somebody waited
  void Settle(std::uint64_t) noexcept override { this->Settled.push_back(this->LastForce); }
};

TEST(ServoCycle, WaitsAtItsEndUntilTheDeviceHasTheZero)
{
  for (const bool isLost : { false, true })
  {
    ServoCycle cycle(1024);
    cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
    const auto device = std::make_shared<SettlingChannel>();
    const auto press = MakePressingHand(0.002)->Hand;
    device->Hand = [&](double time, haptics::DeviceSample& sample)
    { return press(time, sample) && !(isLost && time > 99.5 * Period); };
    cycle.Begin(std::make_shared<haptics::RecordingChannel>(device), ServoState::Stepping);
    ASSERT_EQ(RunTicks(cycle, 100), 100);
    EXPECT_TRUE(device->Settled.empty()) << "not while it runs";
    if (isLost)
    {
      EXPECT_FALSE(cycle.Tick(100 * Period));
    }
    else
    {
      cycle.End(ServoState::Interrupted);
    }
    EXPECT_EQ(device->Settled, std::vector<Vec3>{ NoForce });
  }
}

TEST(ServoCycle, StaysOnTheSurfaceWhenTheSurfacesArePublishedAgain)
{
  ServoCycle cycle(1024);
  EXPECT_EQ(cycle.GetExchange().Publish(MakeGodObject(MakePlane())), 1u);
  const auto channel = MakePressingHand(0.002);
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 100), 100);
  EXPECT_EQ(cycle.GetExchange().Publish(MakeGodObject(MakePlane())), 2u);
  ASSERT_EQ(RunTicks(cycle, 1, 100), 1);
  ExpectNear(channel->LastForce, { 0.0, 0.0, 1.0 }, ForceTolerance);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_EQ(cycle.GetLatest().Generation, 2u);
}

TEST(ServoCycle, StartsAnewAtTheHipWhenAsked)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  ServoSettings settings;
  settings.Placements = 1;
  cycle.Configure(settings);
  ASSERT_EQ(RunTicks(cycle, 1, 100), 1);
  EXPECT_EQ(channel->LastForce, NoForce) << "below a plane that is touched from above";
}

TEST(ServoCycle, StartsEveryRunAtTheHip)
{
  ServoCycle cycle(1024);
  const auto channel = PressPlane(cycle);
  cycle.End(ServoState::Stopped);
  cycle.Begin(channel, ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 1, 100), 1);
  EXPECT_EQ(channel->LastForce, NoForce) << "the hand went below while nothing held";
}

TEST(ServoCycle, RecordsEveryTickOnceAndInOrder)
{
  ServoCycle cycle(1024);
  cycle.Begin(MakePressingHand(0.002), ServoState::Stepping);
  std::vector<TickRecord> records;
  ASSERT_EQ(RunTicks(cycle, 60), 60);
  EXPECT_EQ(cycle.Drain(records), 60u);
  ASSERT_EQ(RunTicks(cycle, 40, 60), 40);
  EXPECT_EQ(cycle.Drain(records), 40u);
  ASSERT_EQ(records.size(), 100u);
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    EXPECT_EQ(records[i].Tick, i);
    EXPECT_EQ(records[i].Time, static_cast<double>(i) * Period);
  }
  EXPECT_EQ(cycle.GetNumberOfLostRecords(), 0u);
}

TEST(ServoCycle, CountsTheRecordsThatNobodyDrainedInTime)
{
  ServoCycle cycle(64);
  cycle.Begin(MakePressingHand(0.002), ServoState::Stepping);
  ASSERT_EQ(RunTicks(cycle, 100), 100);
  std::vector<TickRecord> records;
  EXPECT_EQ(cycle.Drain(records), 64u);
  EXPECT_EQ(records.back().Tick, 63u);
  EXPECT_EQ(cycle.GetNumberOfLostRecords(), 36u);
  ASSERT_TRUE(cycle.UpdateLatest());
  EXPECT_EQ(cycle.GetLatest().Tick, 99u) << "the latest state is never lost";
}
}
