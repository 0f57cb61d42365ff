// Scenes S9, S10 and S11: where properties would make energy, and do not.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// What rounding and a servo that cannot look ahead may leave of a loop [J]: a thousandth of a loop
/// that makes energy.
constexpr double NoEnergy = 1e-9;

std::shared_ptr<const TriangleSurface> Table(int cells = 20)
{
  return MakeSurface(Square(0.05, cells));
}

/// 200 N/m on the left, 800 N/m on the right, over a ramp of `width` about x = 0.
PropertyValues SoftAndHard(const TriangleSurface& surface, double width)
{
  PropertyValues values;
  values[Property::Stiffness] = AtPoints(surface,
    [width](const Vec3& p) { return 500.0 + 300.0 * std::clamp(p[0] / (0.5 * width), -1.0, 1.0); });
  return values;
}

/// Presses `depth` at `from`, slides to `to`, lets go and comes back above the surface; 0.05 m/s.
void Loop(MaterialHand& hand, double from, double to, double depth)
{
  const double y = 0.0013;
  const int along = 1 + static_cast<int>(std::abs(to - from) / 5e-5);
  hand.MoveStraight({ from, y, -depth }, 100);
  hand.MoveStraight({ to, y, -depth }, along);
  hand.MoveStraight({ to, y, 0.001 }, 100);
  hand.MoveStraight({ from, y, 0.001 }, along);
}

MaterialHand HandAbove(TouchedSurface surface, double x)
{
  return MaterialHand(std::move(surface), { x, 0.0013, 0.001 });
}
}

// S9. A spring of the stiffness under the god-object makes (K2 - K1) d^2 / 2 = 7.5 mJ a loop.
TEST(SurfaceEnergy, S9_AVaryingStiffnessMakesNone)
{
  const auto table = Table();
  for (const double width : { 0.005, 0.02, 0.08 })
  {
    for (const double end : { 0.01, -0.01, 0.04 })
    {
      const double depth = 0.005;
      MaterialHand hand = HandAbove(Touchable(table, SoftAndHard(*table, width)), -end);
      // What the plain spring makes of the same loop: by its stiffnesses at the ends.
      Loop(hand, -end, end, depth);
      EXPECT_LE(hand.EnergyOut, NoEnergy) << width << " " << end;
      Loop(hand, -end, end, depth);
      EXPECT_LE(hand.EnergyOut, NoEnergy) << "the second loop";
    }
  }
}

TEST(SurfaceEnergy, S9_TheSpringWithoutATankWouldMakeSevenMillijoules)
{
  const auto table = Table();
  MaterialHand hand = HandAbove(Touchable(table, SoftAndHard(*table, 0.02)), -0.02);
  double energy = 0.0;
  Vec3 last{};
  Vec3 place = hand.Hip;
  const auto moveTo = [&](const Vec3& to)
  {
    const Vec3 from = place;
    for (int i = 1; i <= 100; ++i)
    {
      const Vec3 hip = from + (0.01 * i) * (to - from);
      const Contact& contact = hand.God.Update(hip);
      const Vec3 force = contact.Material.Stiffness * contact.Displacement;
      energy += 0.5 * Dot(force + last, hip - place);
      last = force;
      place = hip;
    }
  };
  moveTo({ -0.02, 0.0013, -0.005 });
  moveTo({ 0.02, 0.0013, -0.005 });
  moveTo({ 0.02, 0.0013, 0.001 });
  EXPECT_NEAR(energy, 7.5e-3, 0.2e-3);
}

// The way back over a hard place: what the fall has put by pays for the rise in full.
TEST(SurfaceEnergy, S9_ReachesAStiffnessAgainThatWasThereBefore)
{
  const auto table = Table();
  MaterialHand hand = HandAbove(Touchable(table, SoftAndHard(*table, 0.02)), 0.02);
  hand.MoveStraight({ 0.02, 0.0013, -0.004 }, 80);
  EXPECT_NEAR(hand.Last[2], 800.0 * 0.004, 1e-6);
  hand.MoveStraight({ -0.02, 0.0013, -0.004 }, 400);
  EXPECT_NEAR(hand.Last[2], 200.0 * 0.004, 1e-6);
  hand.MoveStraight({ 0.02, 0.0013, -0.004 }, 400);
  EXPECT_NEAR(hand.Last[2], 800.0 * 0.004, 1e-6);
  hand.MoveStraight({ 0.02, 0.0013, 0.001 }, 80);
  EXPECT_LE(hand.EnergyOut, NoEnergy);
}

// On its way down the spring holds more than it will: the hand gets back what it put in at most,
// however soon and far it goes, and deeper too.
TEST(SurfaceEnergy, AnExchangeThatSoftensFallsEvenlyAndMakesNone)
{
  const auto table = Table();
  PropertyValues values;
  values[Property::Damping].Constant = 1e-6; // no plain spring, and none of its own
  MaterialHand hand(Touchable(table, values), { 0.01, 0.0013, 0.001 }, 800.0);
  const Vec3 pressed{ 0.01, 0.0013, -0.004 };
  for (const int ticks : { 1, 3, 10, 40, 99, 150 })
  {
    for (const double depth : { 0.004, 0.002, 0.007 })
    {
      hand.PlainStiffness = 800.0;
      hand.MoveStraight({ 0.01, 0.0013, 0.001 }, 10);
      hand.MoveStraight(pressed, 50);
      ASSERT_NEAR(hand.Last[2], 800.0 * 0.004, 1e-5);
      hand.PlainStiffness = 200.0;
      hand.Force.NoticeExchange(0.1, 0.002, 0.0);
      hand.MoveStraight({ 0.01, 0.0013, -depth }, ticks);
      EXPECT_LE(hand.Last[2], 800.0 * depth + 1e-5) << ticks << " " << depth;
      EXPECT_GE(hand.Last[2], 200.0 * depth - 1e-5) << ticks << " " << depth;
      hand.MoveStraight({ 0.01, 0.0013, 0.0 }, ticks); // no tick goes through the surface
      hand.MoveStraight({ 0.01, 0.0013, 0.001 }, 1);
      EXPECT_EQ(hand.Last[2], 0.0) << "nothing is left outside";
      EXPECT_LE(hand.EnergyOut, 10.0 * NoEnergy) << ticks << " " << depth;
    }
  }
  hand.PlainStiffness = 800.0;
  hand.MoveStraight(pressed, 50);
  hand.PlainStiffness = 200.0;
  hand.Force.NoticeExchange(0.1, 0.002, 0.0);
  for (int tick = 1; tick <= 100; ++tick)
  {
    const double before = hand.Last[2];
    EXPECT_NEAR(before - hand.Move(pressed)[2], tick == 1 ? 0.0 : 600.0 * 0.004 / 100.0, 1e-5);
  }
  EXPECT_NEAR(hand.Move(pressed)[2], 200.0 * 0.004, 1e-5);
}

// Friction pays: a rubbing hand meets the hard place soon.
TEST(SurfaceEnergy, S9_FrictionPaysForARise)
{
  const auto table = Table();
  PropertyValues values = SoftAndHard(*table, 0.02);
  values[Property::StaticFriction].Constant = 0.5;
  values[Property::DynamicFriction].Constant = 0.4;
  MaterialHand hand = HandAbove(Touchable(table, values), -0.02);
  hand.MoveStraight({ -0.02, 0.0013, -0.003 }, 80);
  hand.MoveStraight({ 0.03, 0.0013, -0.003 }, 800);
  EXPECT_NEAR(hand.Last[2], 800.0 * 0.003, 1e-3);
  Loop(hand, -0.02, 0.03, 0.003);
  EXPECT_LE(hand.EnergyOut, NoEnergy);
}

// S10. The force rises to mu_s N, then drops to mu_d N; back and forth it only loses.
TEST(SurfaceEnergy, S10_FrictionOnlyTakes)
{
  const auto table = Table();
  const double depth = 0.004;
  const double push = 500.0 * depth;
  MaterialHand hand = HandAbove(Touchable(table, Rough(0.6, 0.35)), 0.0);
  hand.MoveStraight({ 0, 0.0013, -depth }, 100);
  double before = hand.EnergyOut;
  for (int loop = 0; loop < 3; ++loop)
  {
    double most = 0.0;
    double after = 0.0;
    for (int way = 1; way >= -1; way -= 2)
    {
      const Vec3 from = hand.Hip;
      const Vec3 to{ way * 0.01, 0.0013, -depth };
      for (int i = 1; i <= 4000; ++i)
      {
        hand.Move(from + (i / 4000.0) * (to - from));
        most = std::max(most, std::abs(hand.Last[0]));
      }
      after = std::abs(hand.Last[0]);
    }
    EXPECT_NEAR(most - after, (0.6 - 0.35) * push, 0.01 * push);
    EXPECT_LT(hand.EnergyOut, before) << "loop " << loop;
    before = hand.EnergyOut;
  }
  hand.MoveStraight({ 0, 0.0013, 0.001 }, 100);
  EXPECT_LT(hand.EnergyOut, 0.0);
}

namespace
{
/// A prism of twelve sides of 5 mm along y: normals turn by +-15 degrees over each.
TriangleMesh Prism(double& height)
{
  const int sides = 12;
  const double radius = 0.0025 / std::sin(M_PI / sides);
  height = 0.0025 / std::tan(M_PI / sides);
  TriangleMesh mesh;
  for (int i = 0; i < sides; ++i)
  {
    const double a = 2.0 * M_PI * (i + 0.5) / sides;
    mesh.Points.push_back({ radius * std::sin(a), -0.02, radius * std::cos(a) });
    mesh.Points.push_back({ radius * std::sin(a), 0.02, radius * std::cos(a) });
  }
  for (int i = 0; i < sides; ++i)
  {
    const int a = 2 * i;
    const int b = 2 * ((i + 1) % sides);
    mesh.Triangles.push_back({ a, b, a + 1 });
    mesh.Triangles.push_back({ b, b + 1, a + 1 });
  }
  return mesh;
}
}

TEST(SurfaceEnergy, ShadingTurnsTheForceToTheInterpolatedNormal)
{
  double height;
  const auto prism = MakeSurface(Prism(height));
  PropertyValues values;
  values.Shading = true;
  values.FeatureAngle = 35.0;
  const auto properties = MakeProperties(values, *prism);
  // The top side is flat from x = -2.5 to 2.5 mm. Between its ends the normal turns evenly.
  for (const double x : { -0.002, -0.001, 0.0, 0.0013, 0.0024 })
  {
    GodObject god({ { prism, nullptr, properties } });
    god.Update({ x, 0.0, height + 0.001 });
    const Contact& contact = god.Update({ x, 0.0, height - 0.002 });
    ASSERT_TRUE(contact.Material.IsShaded);
    EXPECT_NEAR(Length(contact.Shaded), contact.Penetration, 1e-12) << "only turned";
    const double tangent = std::tan(M_PI / 12) * x / 0.0025;
    EXPECT_NEAR(contact.Shaded[0] / contact.Shaded[2], tangent, 1e-6) << x;
    EXPECT_NEAR(contact.Shaded[1], 0.0, 1e-9);
  }
  // Sharp edges stay: with a smaller feature angle nothing is turned.
  values.FeatureAngle = 25.0;
  GodObject sharp({ Touchable(prism, values) });
  sharp.Update({ 0.002, 0.0, height + 0.001 });
  const Contact& contact = sharp.Update({ 0.002, 0.0, height - 0.002 });
  EXPECT_NEAR(contact.Shaded[0], 0.0, 1e-9);
}

TEST(SurfaceEnergy, ShadingRunsOnAcrossEdges)
{
  double height;
  const auto prism = MakeSurface(Prism(height));
  PropertyValues values;
  values.Shading = true;
  values.FeatureAngle = 35.0;
  GodObject god({ Touchable(prism, values) });
  const double radius = 0.98 * height;
  double worst = 0.0;
  double worstPlain = 0.0;
  Vec3 before{};
  Vec3 plainBefore{};
  for (int tick = 0; tick <= 4000; ++tick)
  {
    const double a = 2.0 * M_PI * tick / 2000.0;
    const Vec3 outwards{ std::sin(a), 0.0, std::cos(a) };
    god.Update((tick == 0 ? 1.5 * height : radius) * outwards);
    const Vec3 direction = tick ? Unit(god.Current().Shaded) : Vec3{};
    const Vec3 plain = tick ? Unit(god.Current().Displacement) : Vec3{};
    if (tick > 10)
    {
      worst = std::max(worst, std::acos(std::min(1.0, Dot(direction, before))));
      worstPlain = std::max(worstPlain, std::acos(std::min(1.0, Dot(plain, plainBefore))));
    }
    before = direction;
    plainBefore = plain;
  }
  // Facets turn by 30 degrees at an edge; the shaded force by what the god-object's step over the
  // edge makes of it.
  EXPECT_LT(worst * 180.0 / M_PI, 2.0);
  EXPECT_GT(worstPlain * 180.0 / M_PI, 25.0);
}

// S11. From the middle of a facet on the shaded force helps the hand: 0.5 mJ a loop at 15 degrees.
TEST(SurfaceEnergy, S11_ForceShadingMakesNoneBeyondItsBudget)
{
  double height;
  const auto prism = MakeSurface(Prism(height));
  PropertyValues values;
  values.Shading = true;
  values.FeatureAngle = 35.0;
  for (const double from : { -0.0024, 0.0, 0.001 })
  {
    const double depth = 0.004;
    MaterialHand hand(Touchable(prism, values), { from, 0.0013, height + 0.001 });
    double naive = 0.0;
    for (int loop = 0; loop < 4; ++loop)
    {
      hand.MoveStraight({ from, 0.0013, height - depth }, 100);
      for (int i = 1; i <= 200; ++i)
      {
        const Vec3 to{ from + (0.0024 - from) * i / 200.0, 0.0013, height - depth };
        const double step = to[0] - hand.Hip[0];
        hand.Move(to);
        naive += 500.0 * hand.God.Current().Shaded[0] * step;
      }
      hand.MoveStraight({ 0.0024, 0.0013, height + 0.001 }, 100);
      hand.MoveStraight({ from, 0.0013, height + 0.001 }, 100);
      EXPECT_LE(hand.EnergyOut, 1e-6) << "from " << from << ", loop " << loop;
    }
    std::printf("S11 from %g: %.3g J out of the servo in 4 loops, %.3g J by shading alone\n", from,
      hand.EnergyOut, naive);
    if (from > -0.001)
    {
      EXPECT_GT(naive, 4e-4) << "the scene has to tempt";
    }
  }
}

// Everything at once, on ways and fields that nobody chose.
TEST(SurfaceEnergy, RandomFieldsOnRandomWaysMakeNone)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  double worst = -HUGE_VAL;
  for (int field = 0; field < 12; ++field)
  {
    const auto surface = MakeSurface(field % 3 == 0 ? Square(0.05, 10)
        : field % 3 == 1                            ? Icosphere(3, 0.03)
                                                    : Star(3, 0.04, 0.1, 3));
    PropertyValues values;
    values[Property::Stiffness] =
      AtPoints(*surface, [&](const Vec3&) { return 100.0 + 800.0 * unit(random); });
    values[Property::Damping] = AtPoints(*surface, [&](const Vec3&) { return unit(random); });
    values[Property::StaticFriction] =
      AtPoints(*surface, [&](const Vec3&) { return field < 6 ? unit(random) : 0.0; });
    values[Property::DynamicFriction] = values[Property::StaticFriction];
    for (float& value : values[Property::DynamicFriction].Values)
    {
      value *= 0.7f;
    }
    values[Property::Texture] =
      AtPoints(*surface, [&](const Vec3&) { return 0.5 * (2.0 * unit(random) - 1.0); });
    values.Shading = field % 2 == 0;
    values.FeatureAngle = 60.0;
    const double size = field % 3 == 1 ? 0.03 : 0.036; // of the round ones
    const Vec3 start{ 0.0, 0.0, field % 3 == 0 ? 0.01 : 1.2 * size };
    MaterialHand hand(Touchable(surface, values), start);
    hand.Limits.MaximumForce = 3.3;
    for (int loop = 0; loop < 10; ++loop)
    {
      Vec3 velocity{ normal(random), normal(random), -3.0 };
      Vec3 place = start;
      for (int tick = 0; tick < 1000; ++tick)
      {
        velocity = 0.98 * velocity + 0.2 * Vec3{ normal(random), normal(random), normal(random) };
        const Vec3 home = field % 3 == 0 ? Vec3{ 0.3 * place[0], 0.3 * place[1], place[2] + 0.003 }
                                         : (1.0 - 0.93 * size / Length(place)) * place;
        velocity = velocity - 10.0 * home;
        place = place + 3e-5 * velocity;
        hand.Move(place);
      }
      hand.MoveStraight(1.5 * Length(start) / Length(place) * place, 200);
      hand.MoveStraight(start, 400);
      // The device's own 1 N s/m has the force's being held to pay: K T / 2 is 0.7 at the most.
      worst = std::max(worst, hand.HeldEnergyOut - hand.DeviceLoss);
      EXPECT_LE(hand.HeldEnergyOut, hand.DeviceLoss) << "field " << field << ", loop " << loop;
    }
    std::printf("field %d: %.3g J out by trapezoids, %.3g J held, %.3g J lost in the device\n",
      field, hand.EnergyOut, hand.HeldEnergyOut, hand.DeviceLoss);
  }
}
