// What varies over a surface gives a force while sliding over it, and makes no energy; and it does
// against the surface, which may move.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"

#include "haptics/Surface/SurfaceMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001; // [s]
constexpr double Depth = 0.004;
/// What the discrete ticks of a loop may leave [J]: a thousandth of the millijoules it is about.
constexpr double NoEnergy = 5e-6;

std::shared_ptr<const TriangleSurface> Table(int cells = 20)
{
  return MakeSurface(Square(0.05, cells));
}

Vec3 Direction(double angle)
{
  return { std::cos(angle), std::sin(angle), 0.0 };
}

/// A value for each triangle, by its middle.
template <class Function>
PropertyField AtTriangles(const TriangleSurface& surface, const Function& value)
{
  PropertyField field;
  field.IsPerTriangle = true;
  for (const Triangle& t : surface.Triangles())
  {
    const auto& points = surface.Points();
    field.Values.push_back(
      static_cast<float>(value((1.0 / 3.0) * (points[t[0]] + points[t[1]] + points[t[2]]))));
  }
  return field;
}

/// Presses at `from`, and calls `check` at each tick of a stroke to `to` with the force there.
void Stroke(MaterialHand& hand, const Vec3& from, const Vec3& to, double speed,
  const std::function<void(const Vec3& place, const Vec3& force)>& check)
{
  hand.MoveStraight(from + Vec3{ 0, 0, 0.001 }, 50);
  hand.MoveStraight(from + Vec3{ 0, 0, -Depth }, 100);
  const int ticks = 1 + static_cast<int>(Length(to - from) / (speed * Tick));
  for (int i = 1; i <= ticks; ++i)
  {
    const Vec3 place = from + (static_cast<double>(i) / ticks) * (to - from);
    const Vec3 force = hand.Move(place + Vec3{ 0, 0, -Depth });
    check(place, force);
  }
  hand.MoveStraight(to + Vec3{ 0, 0, 0.001 }, 100);
}

/// What lies along a stroke in one direction, and the other way.
struct Strokes
{
  double Worst = 0.0;   ///< |force / expected - 1| along the normal
  double Lateral = 0.0; ///< largest difference from the potential's slope [N]
  double Energy = 0.0;  ///< out of all of them [J]
};

template <class Expected, class Slope>
Strokes StrokeEverywhere(const std::shared_ptr<const TriangleSurface>& table,
  const PropertyValues& values, double speed, const Expected& expected, const Slope& slope)
{
  Strokes found;
  for (int i = 0; i < 16; ++i)
  {
    const Vec3 along = Direction(2.0 * M_PI * (i + 0.3) / 16);
    MaterialHand hand(Touchable(table, values), { 0, 0, 0.001 });
    Stroke(hand, -0.04 * along, 0.04 * along, speed,
      [&](const Vec3& place, const Vec3& force)
      {
        found.Worst = std::max(found.Worst, std::abs(force[2] / expected(place) - 1.0));
        const Vec3 lateral = slope(place);
        found.Lateral =
          std::max(found.Lateral, std::hypot(force[0] - lateral[0], force[1] - lateral[1]));
      });
    found.Energy = std::max(found.Energy, hand.EnergyOut);
  }
  return found;
}
}

// The stiffness of numerics: 200 to 800 N/m over the table, 4 mm deep.
TEST(VaryingMaterial, ForceFollowsAStiffnessArrayAlongStrokesInEveryDirection)
{
  const auto table = Table();
  for (const double turn : { 0.0, 0.7, 2.0 })
  {
    const Vec3 uphill = Direction(turn);
    const auto stiffness = [&](const Vec3& p) { return 500.0 + 6000.0 * Dot(uphill, p); };
    PropertyValues values;
    values[Property::Stiffness] = AtPoints(*table, stiffness);
    for (const double speed : { 0.02, 0.1, 0.4 })
    {
      const Strokes found = StrokeEverywhere(
        table, values, speed, [&](const Vec3& p) { return Depth * stiffness(p); },
        [&](const Vec3&) { return (-0.5 * Depth * Depth * 6000.0) * uphill; });
      EXPECT_LT(found.Worst, 0.05) << turn << " at " << speed << " m/s";
      EXPECT_LT(found.Worst, 0.01) << "in fact";
      EXPECT_LT(found.Lateral, 0.003) << "of 0.048 N";
      EXPECT_LE(found.Energy, NoEnergy);
    }
  }
}

// What does not vary evenly: the gradient changes at every edge.
TEST(VaryingMaterial, ForceFollowsABumpyStiffness)
{
  const auto table = Table(100); // straight lines of 1 mm are within 2 % of this
  const auto stiffness = [](const Vec3& p)
  { return 500.0 + 250.0 * std::sin(p[0] * 300.0) * std::cos(p[1] * 200.0); };
  PropertyValues values;
  values[Property::Stiffness] = AtPoints(*table, stiffness);
  const Strokes found = StrokeEverywhere(
    table, values, 0.1, [&](const Vec3& p) { return Depth * stiffness(p); },
    [](const Vec3&) { return Vec3{}; });
  EXPECT_LT(found.Worst, 0.05);
  EXPECT_LE(found.Energy, NoEnergy);
}

TEST(VaryingMaterial, ForceFollowsATextureOverAForceProfile)
{
  const auto table = Table();
  std::vector<double> forces;
  for (int i = 0; i <= 100; ++i)
  {
    forces.push_back(60000.0 * std::pow(1e-4 * i, 2)); // 0.96 N at 4 mm
  }
  std::string error;
  PropertyValues values;
  values.Profile = ForceProfile::Build(forces, 0.01, error);
  ASSERT_TRUE(values.Profile) << error;
  const auto share = [](const Vec3& p) { return 1.0 + 5.0 * p[0] - 4.0 * p[1]; };
  values[Property::Texture] = AtPoints(*table, [&](const Vec3& p) { return share(p) - 1.0; });
  const double energy = values.Profile->Energy(Depth);
  const Strokes found = StrokeEverywhere(
    table, values, 0.1, [&](const Vec3& p) { return values.Profile->Force(Depth) * share(p); },
    [&](const Vec3&) {
      return -energy * Vec3{ 5.0, -4.0, 0.0 };
    });
  EXPECT_LT(found.Worst, 0.02);
  EXPECT_LT(found.Lateral, 0.002);
  EXPECT_LE(found.Energy, NoEnergy);
}

// A surface whose points are partly without a stiffness of their own goes over into the servo's.
TEST(VaryingMaterial, ForceFollowsFromAnOwnStiffnessToTheServos)
{
  const auto table = MakeSurface(Square(0.05, 1));
  PropertyValues values;
  values[Property::Stiffness] =
    AtPoints(*table, [](const Vec3& p) { return p[0] < 0.0 ? 200.0 : std::nan(""); });
  const Strokes found = StrokeEverywhere(
    table, values, 0.1, [](const Vec3& p) { return Depth * (350.0 + 3000.0 * p[0]); },
    [](const Vec3&) {
      return Vec3{ -0.5 * Depth * Depth * 3000.0, 0.0, 0.0 };
    });
  EXPECT_LT(found.Worst, 0.01);
  EXPECT_LT(found.Lateral, 0.002);
  EXPECT_LE(found.Energy, NoEnergy);
}

TEST(VaryingMaterial, ForceFollowsAnImage)
{
  const auto table = Table(1);
  auto image = std::make_shared<TextureImage>();
  image->Width = 2;
  image->Height = 2;
  image->Values = { -0.3f, 0.3f, -0.1f, 0.5f };
  for (const Vec3& p : table->Points())
  {
    // All of the table lies between the middles of the four pixels.
    image->Coordinates.push_back(
      { static_cast<float>(0.5 + 4.0 * p[0]), static_cast<float>(0.5 + 4.0 * p[1]) });
  }
  PropertyValues values;
  values.Image = image;
  const auto texture = [](const Vec3& p) { return 0.1 + 0.6 * 8.0 * p[0] + 0.2 * 8.0 * p[1]; };
  const Strokes found = StrokeEverywhere(
    table, values, 0.1, [&](const Vec3& p) { return Depth * 500.0 * (1.0 + texture(p)); },
    [](const Vec3&) {
      return -0.5 * Depth * Depth * 500.0 * Vec3{ 4.8, 1.6, 0.0 };
    });
  EXPECT_LT(found.Worst, 0.01);
  EXPECT_LT(found.Lateral, 0.002);
}

// Friction takes what a rise costs, or the resistance does where it is too little.
TEST(VaryingMaterial, ForceFollowsWhereThereIsFriction)
{
  const auto table = Table();
  const auto stiffness = [](const Vec3& p) { return 500.0 + 6000.0 * p[0]; };
  for (const double friction : { 0.02, 0.1, 0.5 })
  {
    PropertyValues values = Rough(friction, 0.8 * friction);
    values[Property::Stiffness] = AtPoints(*table, stiffness);
    MaterialHand hand(Touchable(table, values), { 0, 0, 0.001 });
    for (const double way : { 1.0, -1.0 })
    {
      Stroke(hand, { -0.04 * way, 0.0013, 0 }, { 0.04 * way, 0.0013, 0 }, 0.1,
        [&](const Vec3&, const Vec3& force)
        {
          // What is under the god-object, which friction holds back.
          const double own = stiffness(hand.God.Current().Position);
          EXPECT_NEAR(force[2] / Depth, own, 0.05 * own) << friction << ", " << way;
        });
    }
    EXPECT_LT(hand.EnergyOut, 0.0);
  }
}

// 200 to 800 N/m from one cell to the next. The hand pays for 4.8 mJ within the stated width, and
// as the spring pushes 0.8 N at first, over some times that.
TEST(VaryingMaterial, AJumpBetweenCellsIsSpreadOverAWidthAndPaid)
{
  const auto table = Table();
  PropertyValues values;
  values[Property::Stiffness] =
    AtTriangles(*table, [](const Vec3& p) { return p[0] < 0.0 ? 200.0 : 800.0; });
  for (const double depth : { 0.001, 0.004 })
  {
    MaterialHand hand(Touchable(table, values), { -0.03, 0.0013, 0.001 });
    hand.MoveStraight({ -0.03, 0.0013, -depth }, 100);
    double reached = HUGE_VAL;
    double last = 200.0 * depth;
    double steepest = 0.0;
    for (int i = 1; i <= 1200; ++i)
    {
      const double x = -0.03 + 5e-5 * i;
      const Vec3 force = hand.Move({ x, 0.0013, -depth });
      EXPECT_LE(std::abs(force[0]), 1.05 * force[2]) << "the resistance stays below the push";
      if (x < -1e-4)
      {
        ASSERT_NEAR(force[2], 200.0 * depth, 1e-6);
      }
      steepest = std::max(steepest, std::abs(force[2] - last));
      last = force[2];
      reached = force[2] > 0.95 * 800.0 * depth ? std::min(reached, x) : reached;
    }
    EXPECT_LT(reached, 8.0 * SurfaceForce::JumpWidth) << depth;
    EXPECT_LT(steepest, 0.1 * 600.0 * depth) << "no tick takes more than a tenth of it";
    EXPECT_NEAR(last, 800.0 * depth, 0.01 * last);
    hand.MoveStraight({ 0.03, 0.0013, 0.001 }, 100);
    EXPECT_LE(hand.EnergyOut, NoEnergy);
  }
}

namespace
{
/// The energy of closed loops: press at `from`, slide to `to`, lift, come back above or below.
double EnergyOfLoops(MaterialHand& hand, const Vec3& from, const Vec3& to, int loops)
{
  const Vec3 above{ 0, 0, 0.001 };
  const Vec3 below{ 0, 0, -Depth };
  hand.MoveStraight(from + above, 100);
  const double before = hand.EnergyOut;
  for (int i = 0; i < loops; ++i)
  {
    hand.MoveStraight(from + below, 100);
    hand.MoveStraight(to + below, 400);
    if (i % 2 == 0)
    {
      hand.MoveStraight(to + above, 100);
      hand.MoveStraight(from + above, 400);
    }
    else
    {
      hand.MoveStraight(from + below, 300);
      hand.MoveStraight(from + above, 100);
    }
  }
  return hand.EnergyOut - before;
}
}

TEST(VaryingMaterial, LoopsOverEveryPropertyMakeNoEnergy)
{
  const auto table = Table(25);
  std::string error;
  const auto profile = ForceProfile::Build({ 0.0, 1.0, 0.6, 2.0 }, 0.006, error);
  for (int property = 0; property < NumberOfProperties; ++property)
  {
    for (const bool isPerTriangle : { false, true })
    {
      for (const bool hasProfile : { false, true })
      {
        for (const bool isShaded : { false, true })
        {
          std::mt19937 random(7 + property);
          std::uniform_real_distribution<double> unit(0.0, 1.0);
          const double scale[] = { 900.0, 2.0, 0.8, 0.5, 0.5 };
          const auto value = [&](const Vec3&) { return scale[property] * unit(random); };
          PropertyValues values;
          values[Property::StaticFriction].Constant = property == 3 ? 0.5 : 0.0;
          values[static_cast<Property>(property)] =
            isPerTriangle ? AtTriangles(*table, value) : AtPoints(*table, value);
          values.Profile = hasProfile ? profile : nullptr;
          values.Shading = isShaded;
          MaterialHand hand(Touchable(table, values), { 0, 0, 0.001 });
          for (int way = 0; way < 4; ++way)
          {
            const Vec3 along = Direction(way * 0.9 + 0.2);
            EXPECT_LE(EnergyOfLoops(hand, -0.03 * along, 0.035 * along, 4), NoEnergy)
              << "property " << property << (isPerTriangle ? " of triangles" : " of points")
              << (hasProfile ? ", profile" : "") << (isShaded ? ", shaded" : "") << ", way " << way;
          }
        }
      }
    }
  }
}

// Rubbing a rough patch for long, and then going round from soft to hard elsewhere.
TEST(VaryingMaterial, WhatWasRubbedBeforeIsForgotten)
{
  const auto table = Table(40);
  PropertyValues values;
  values[Property::StaticFriction] =
    AtTriangles(*table, [](const Vec3& p) { return p[0] < -0.02 ? 0.8 : 0.0; });
  values[Property::DynamicFriction] = values[Property::StaticFriction];
  values[Property::Stiffness] =
    AtTriangles(*table, [](const Vec3& p) { return p[0] > 0.02 ? 900.0 : 150.0; });
  std::vector<Vec3> forces[2];
  for (const int rubbing : { 0, 1 })
  {
    MaterialHand hand(Touchable(table, values), { -0.045, 0, 0.001 });
    hand.MoveStraight({ -0.045, 0, -Depth }, 100);
    for (int tick = 0; tick < rubbing * 20000; ++tick)
    {
      hand.Move({ -0.035 + 0.01 * std::sin(tick * 0.02), 0.01 * std::sin(tick * 0.013), -Depth });
      // The friction holds the god-object back by 0.8 of the depth.
      const double squaredDepth = 1.01 * (1.0 + 0.8 * 0.8) * Depth * Depth;
      ASSERT_LE(hand.Force.GetTank(), 0.5 * 750.0 * squaredDepth) << "what one rise needs";
    }
    // As the f_tank of the cases: to the loop's start without letting go.
    hand.MoveStraight({ 0.01, 0, -0.0002 }, 400);
    const double before = hand.EnergyOut;
    for (int loop = 0; loop < 3; ++loop)
    {
      for (const Vec3& corner : { Vec3{ 0.01, 0, -0.0035 }, Vec3{ 0.03, 0, -0.0035 },
             Vec3{ 0.03, 0, -0.0002 }, Vec3{ 0.01, 0, -0.0002 } })
      {
        const Vec3 from = hand.Hip;
        for (int i = 1; i <= 150; ++i)
        {
          forces[rubbing].push_back(hand.Move(from + (i / 150.0) * (corner - from)));
        }
      }
      EXPECT_LE(hand.EnergyOut - before, 1e-6) << "loop " << loop << ", rubbed " << rubbing;
    }
  }
  ASSERT_EQ(forces[0].size(), forces[1].size());
  for (std::size_t i = 0; i < forces[0].size(); ++i)
  {
    ASSERT_LT(Length(forces[0][i] - forces[1][i]), 0.01) << "tick " << i;
  }
}

namespace
{
/// A hand and a table that may move, both as asked for.
struct MovingBench
{
  std::shared_ptr<SurfaceMotion> Motion = std::make_shared<SurfaceMotion>(RigidPose());
  MaterialHand Hand;

  explicit MovingBench(PropertyValues values)
    : Hand(Make(std::move(values), this->Motion), { 0, 0.0013, 0.002 })
  {
  }
  static TouchedSurface Make(PropertyValues values, std::shared_ptr<SurfaceMotion> motion)
  {
    const auto table = MakeSurface(Square(0.2, 4));
    TouchedSurface touched = Touchable(table, std::move(values));
    touched.Motion = std::move(motion);
    return touched;
  }
  Vec3 Move(const Vec3& hip, const Vec3& table)
  {
    RigidPose pose;
    pose.Translation = table;
    this->Motion->MoveTo(pose, 0.0);
    this->Hand.God.Advance(Tick);
    return this->Hand.Move(hip);
  }
};
}

TEST(VaryingMaterial, DampingIsAgainstTheSurfaceThatMoves)
{
  for (const bool isUpwards : { false, true })
  {
    const Vec3 step = isUpwards ? Vec3{ 0, 0, 2e-4 } : Vec3{ 2e-4, 0, 0 };
    const auto force = [&](double ofHand, double ofTable)
    {
      MovingBench bench(Everywhere(500.0, 2.0, 0, 0, 0));
      for (int i = 1; i <= 40; ++i)
      {
        bench.Move({ 0, 0.0013, 0.002 - 1e-4 * i }, {});
      }
      Vec3 last{};
      for (int i = 1; i <= 400; ++i)
      {
        last = bench.Move(Vec3{ 0, 0.0013, -0.002 } + (ofHand * i) * step, (ofTable * i) * step);
      }
      return last;
    };
    const Vec3 together = force(1.0, 1.0);
    EXPECT_NEAR(together[0], 0.0, 1e-6) << "a hand that goes with the table rests on it";
    EXPECT_NEAR(together[2], 1.0, 1e-4);
    if (!isUpwards)
    {
      EXPECT_NEAR(force(0.0, 1.0)[0], 2.0 * 0.2, 1e-3) << "the table drags a hand at rest";
      EXPECT_NEAR(force(1.0, 0.0)[0], -2.0 * 0.2, 1e-3);
    }
  }
}

// The first touch, and all after it: only the motion of one against the other counts.
TEST(VaryingMaterial, AMovingSurfaceIsMetAsInTheStillFrame)
{
  PropertyValues values = Everywhere(500.0, 2.0, 0, 0, 0);
  values.Shading = true;
  MovingBench still(values);
  MovingBench moving(values);
  int touching = 0;
  for (int i = 1; i <= 100; ++i)
  {
    const double way = 1.1e-4 * i; // at 0.11 m/s; the hand starts 2 mm above
    const Vec3 first = still.Move({ 0, 0.0013, 0.002 - way }, {});
    const Vec3 second = moving.Move({ 0, 0.0013, 0.002 }, { 0, 0, way });
    touching += Length(first) > 0.0 ? 1 : 0;
    ASSERT_LT(Length(first - second), 1e-9) << "tick " << i;
  }
  EXPECT_GT(touching, 50);
}
