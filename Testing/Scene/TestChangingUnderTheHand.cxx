// Hands on surfaces that are exchanged, and hands that hit hard, with the safety at its defaults:
// all come to rest, and no closed way gives the hand any work.
#include "ServoTestTools.h"
#include "haptics/Servo/SafetySettings.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticServo.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkHapticReadings.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
using haptics::TickRecord;
using haptics::Vec3;
using Surface = std::shared_ptr<const haptics::TriangleSurface>;

constexpr double Size = 0.1; // [m]

/// Two half planes that meet along the y axis and fall by `slope` to both sides, each in strips.
///
///     slope < 0:  \ /   groove      0:  ---   plane      > 0:  / \   edge
Surface MakeRoof(double slope, int strips)
{
  haptics::TriangleMesh mesh;
  for (int i = 0; i <= strips; ++i)
  {
    const double y = Size * (2.0 * i / strips - 1.0);
    mesh.Points.push_back({ -Size, y, -slope * Size });
    mesh.Points.push_back({ 0.0, y, 0.0 });
    mesh.Points.push_back({ Size, y, -slope * Size });
  }
  for (int i = 0; i < strips; ++i)
  {
    const int a = 3 * i;
    mesh.Triangles.push_back({ a, a + 1, a + 4 });
    mesh.Triangles.push_back({ a, a + 4, a + 3 });
    mesh.Triangles.push_back({ a + 1, a + 2, a + 5 });
    mesh.Triangles.push_back({ a + 1, a + 5, a + 4 });
  }
  haptics::SurfaceOptions options;
  options.TouchedSide = haptics::Side::Front;
  options.Engine = haptics::EngineKind::BruteForce;
  std::string error;
  return haptics::TriangleSurface::Build(std::move(mesh), options, error);
}

/// What is exchanged while the hand is on a roof.
enum class Exchange
{
  Nothing,
  Elsewhere, ///< a plane at a distance, for one with other cells
  Here       ///< the roof, for one with other cells in the same place
};

/// A servo in virtual time on a roof.
struct RoofServo
{
  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticServo> Servo;
  std::vector<TickRecord> Ticks;

  explicit RoofServo(double slope)
    : Roofs{ MakeRoof(slope, 7), MakeRoof(slope, 8) }
    , Far{ MakePlane(-1.0, 0.05), MakePlane(-1.0, 0.06) }
  {
    this->Servo->SetDevice(this->Device);
  }

  void Publish(Exchange what)
  {
    this->Count += 1;
    std::vector<haptics::TouchedSurface> surfaces;
    surfaces.emplace_back(this->Roofs[what == Exchange::Here ? this->Count % 2 : 0]);
    surfaces.back().Identity = 1;
    surfaces.emplace_back(this->Far[what == Exchange::Elsewhere ? this->Count % 2 : 0]);
    surfaces.back().Identity = 2;
    this->Servo->PublishGodObject(std::make_unique<haptics::GodObject>(std::move(surfaces)));
  }

  /// Goes to a place in so many ticks, on a straight line, while surfaces are exchanged.
  void Lead(const Vec3& to, int ticks, Exchange what, int rate)
  {
    const Vec3 from{ this->At };
    for (int i = 1; i <= ticks; ++i, ++this->Tick)
    {
      if (what != Exchange::Nothing && this->Tick % (1000 / rate) == 0)
      {
        this->Publish(what);
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        this->At[axis] = from[axis] + (to[axis] - from[axis]) * i / ticks;
      }
      this->Device->SetPosition(this->At[0], this->At[1], this->At[2]);
      ASSERT_EQ(this->Servo->Step(1), 1);
      this->Servo->DrainRecords(this->Ticks);
    }
  }

  void Begin(const Vec3& at)
  {
    this->At = at;
    this->Publish(Exchange::Nothing);
    this->Device->SetPosition(at[0], at[1], at[2]);
    ASSERT_TRUE(this->Device->Open()) << this->Device->GetErrorMessage();
    ASSERT_EQ(this->Servo->Step(1), 1);
    this->Servo->DrainRecords(this->Ticks);
  }

  /// Of the device's height in the last ticks [m].
  double Deviation(std::size_t ticks) const
  {
    double mean = 0.0;
    double squares = 0.0;
    for (std::size_t i = this->Ticks.size() - ticks; i < this->Ticks.size(); ++i)
    {
      mean += this->Ticks[i].DevicePosition[2] / ticks;
    }
    for (std::size_t i = this->Ticks.size() - ticks; i < this->Ticks.size(); ++i)
    {
      squares += std::pow(this->Ticks[i].DevicePosition[2] - mean, 2) / ticks;
    }
    return std::sqrt(squares);
  }

  /// What the hand has got since a tick, of forces that change evenly over a tick [J].
  double WorkSince(std::size_t first) const
  {
    double work = 0.0;
    for (std::size_t i = std::max<std::size_t>(first, 1); i < this->Ticks.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        work += 0.5 * (this->Ticks[i].Force[axis] + this->Ticks[i - 1].Force[axis]) *
          (this->Ticks[i].DevicePosition[axis] - this->Ticks[i - 1].DevicePosition[axis]);
      }
    }
    return work;
  }

private:
  Surface Roofs[2];
  Surface Far[2];
  int Count = 0;
  int Tick = 0;
  Vec3 At{};
};

/// A surface is met in the middle of a step, where a force does not change evenly: what the account
/// may err by at most, going in and out [J]. `step`: of a tick [m].
double AccountError(double stiffness, double step)
{
  return 2.0 * stiffness * step * step / 8.0;
}

constexpr double Slopes[] = { 0.0, 1.0, -1.0 };

/// A hand of that stiffness presses and stays; its deviation in the last quarter of a second [m].
double DeviationAtRest(int preset, double slope, double stiffness, Exchange what, int rate)
{
  RoofServo scene(slope);
  scene.Device->SetPreset(preset);
  scene.Device->SetHandStiffness(stiffness);
  scene.Device->SetHandDamping(0.5);
  scene.Begin({ 0.0003, 0.0002, 0.004 });
  scene.Lead({ 0.0003, 0.0002, -0.01 }, 100, what, rate);
  scene.Lead({ 0.0003, 0.0002, -0.01 }, 1400, what, rate);
  EXPECT_GT(scene.Servo->GetReadings()->GetNumberOfConstraints(), 0);
  EXPECT_GT(std::hypot(scene.Ticks.back().Force[0], scene.Ticks.back().Force[2]), 0.1);
  return scene.Deviation(250);
}

class EveryPreset : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(UnderTheHand, EveryPreset,
  testing::Range<int>(vtkSimulatedHapticDevice::Touch, vtkSimulatedHapticDevice::Falcon + 1));

TEST_P(EveryPreset, RestsOnPlaneEdgeAndGrooveWhateverIsExchangedAndHowOften)
{
  for (const double slope : Slopes)
  {
    for (const double stiffness : { 60.0, 300.0 })
    {
      const auto expectRest = [&](Exchange what, int rate)
      {
        EXPECT_LT(DeviationAtRest(this->GetParam(), slope, stiffness, what, rate), 1e-9)
          << "slope " << slope << ", hand " << stiffness << " N/m, exchange "
          << static_cast<int>(what) << ", " << rate << " a second";
      };
      expectRest(Exchange::Nothing, 1);
      for (const int rate : { 1, 8, 30, 100 })
      {
        expectRest(Exchange::Elsewhere, rate);
        expectRest(Exchange::Here, rate);
      }
    }
  }
}

// Tick for tick, but for rounding.
TEST(ChangingUnderTheHand, AnExchangeElsewhereChangesNoForce)
{
  for (const double slope : Slopes)
  {
    std::vector<TickRecord> still;
    for (const int rate : { 0, 1, 8, 30, 100 })
    {
      RoofServo scene(slope);
      scene.Device->SetMotionToManual();
      scene.Begin({ 0.001, 0.0, 0.002 });
      const Exchange what = rate > 0 ? Exchange::Elsewhere : Exchange::Nothing;
      for (int loop = 0; loop < 5; ++loop)
      {
        scene.Lead({ 0.002, 0.001, -0.005 }, 100, what, rate);
        scene.Lead({ -0.003, 0.002, -0.004 }, 100, what, rate);
        scene.Lead({ 0.001, 0.0, 0.002 }, 100, what, rate);
      }
      still = rate == 0 ? scene.Ticks : still;
      ASSERT_EQ(still.size(), scene.Ticks.size());
      for (std::size_t i = 0; i < still.size(); ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          ASSERT_NEAR(scene.Ticks[i].Force[axis], still[i].Force[axis], 1e-9)
            << "slope " << slope << ", " << rate << " a second, tick " << i;
        }
      }
    }
  }
}

// A hand that is led, as by a machine, over a closed way: in, along and out.
TEST(ChangingUnderTheHand, AClosedWayGivesTheHandNoWorkWhateverIsExchanged)
{
  for (const double slope : Slopes)
  {
    for (const Exchange what : { Exchange::Nothing, Exchange::Elsewhere, Exchange::Here })
    {
      for (const int rate : { 1, 10, 100 })
      {
        for (const int ticks : { 20, 80, 400 })
        {
          RoofServo scene(slope);
          scene.Device->SetMaximumForce(20.0);
          scene.Begin({ 0.001, 0.0, 0.003 });
          scene.Lead({ 0.001, 0.0, 0.003 }, 150, what, rate);
          for (int loop = 0; loop < 4; ++loop)
          {
            const std::size_t first = scene.Ticks.size();
            scene.Lead({ 0.002, 0.001, -0.005 }, ticks, what, rate);
            scene.Lead({ -0.003, 0.002, -0.004 }, ticks, what, rate);
            scene.Lead({ 0.001, 0.0, 0.003 }, ticks, what, rate);
            EXPECT_LE(scene.WorkSince(first), AccountError(500.0, 0.008 / ticks))
              << "slope " << slope << ", exchange " << static_cast<int>(what) << ", " << rate
              << " a second, " << ticks << " ticks a side";
          }
        }
      }
    }
  }
}

/// A body that falls on the plane in the hand, and what it does in the sixth second [m].
double DeviationAfterBlow(vtkSimulatedHapticDevice* device, RoofServo& scene, double height)
{
  device->SetHandDamping(0.2);
  scene.Servo->SetStiffness(1e5);
  scene.Begin({ 0.01, 0.02, height });
  scene.Lead({ 0.01, 0.02, height }, 150, Exchange::Nothing, 1);
  scene.Lead({ 0.01, 0.02, -0.02 }, 1, Exchange::Nothing, 1);
  scene.Lead({ 0.01, 0.02, -0.02 }, 6000, Exchange::Nothing, 1);
  return scene.Deviation(1000);
}

TEST(ChangingUnderTheHand, StrongDevicesComeToRestAfterABlowAtTheStiffnessLimit)
{
  struct Strong
  {
    double Damping, HandStiffness, Force;
  };
  for (const Strong& strong : { Strong{ 0.7, 100.0, 20.0 }, { 0.7, 300.0, 20.0 },
         { 1.5, 300.0, 20.0 }, { 2.0, 300.0, 20.0 }, { 2.0, 1000.0, 40.0 } })
  {
    for (const double height : { 0.005, 0.02, 0.1 })
    {
      RoofServo scene(0.0);
      scene.Device->BodyOn();
      scene.Device->SetMass(0.045);
      scene.Device->SetDamping(strong.Damping);
      scene.Device->SetMaximumForce(strong.Force);
      scene.Device->SetMaximumStiffness(1e5);
      scene.Device->SetHandStiffness(strong.HandStiffness);
      EXPECT_LT(DeviationAfterBlow(scene.Device, scene, height), 1e-6)
        << "b " << strong.Damping << " N s/m, hand " << strong.HandStiffness << " N/m, "
        << strong.Force << " N, from " << height << " m";
      const TickRecord& last = scene.Ticks.back();
      EXPECT_NEAR(last.Force[2], last.Stiffness * last.Penetration, 1e-6) << "all of its force";
    }
  }
}

TEST_P(EveryPreset, ComesToRestAfterABlowAtTheStiffnessLimit)
{
  RoofServo scene(0.0);
  scene.Device->SetPreset(this->GetParam());
  scene.Device->SetHandStiffness(100.0);
  EXPECT_LT(DeviationAfterBlow(scene.Device, scene, 0.1), 1e-9);
}

// Hits a spring harder than the slew limit lets its force grow, out and in again: what it gives
// back is never more than what it took.
TEST(ChangingUnderTheHand, ALimitedForceGivesBackNoMoreThanItTook)
{
  for (const int in : { 3, 5, 10, 20 })
  {
    for (const int out : { 3, 5, 10, 20, 100 })
    {
      RoofServo scene(0.0);
      scene.Device->SetMaximumForce(40.0);
      scene.Device->SetMaximumStiffness(1e5);
      scene.Device->SetDamping(2.0);
      scene.Servo->SetStiffness(3000.0);
      scene.Begin({ 0.0, 0.0, 0.002 });
      scene.Lead({ 0.0, 0.0, 0.002 }, 150, Exchange::Nothing, 1);
      bool wasLimited = false;
      for (int loop = 0; loop < 5; ++loop)
      {
        const std::size_t first = scene.Ticks.size();
        scene.Lead({ 0.0, 0.0, -0.01 }, in, Exchange::Nothing, 1);
        scene.Lead({ 0.0, 0.0, 0.002 }, out, Exchange::Nothing, 1);
        EXPECT_LE(scene.WorkSince(first), AccountError(3000.0, 0.012 / std::min(in, out)))
          << in << " ticks in, " << out << " out";
        for (std::size_t i = first; i < scene.Ticks.size(); ++i)
        {
          wasLimited = wasLimited || (scene.Ticks[i].Limits & haptics::ForceSlewed) != 0;
        }
      }
      EXPECT_TRUE(wasLimited) << in << " ticks in: 12, 7, 4 and 2 N a tick";
    }
  }
}
}
