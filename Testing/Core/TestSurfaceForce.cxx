// The force of surfaces with properties against closed forms, and the energy it may not make.
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
constexpr double None = -1.0; // no stiffness of its own

std::shared_ptr<const TriangleSurface> Table(int cells = 10)
{
  return MakeSurface(Square(0.05, cells));
}

MaterialHand HandOver(const std::shared_ptr<const TriangleSurface>& surface, PropertyValues values)
{
  return MaterialHand(Touchable(surface, std::move(values)), { 0, 0.0013, 0.002 });
}

/// What rounding may leave of a balance [J]; the loops are of millijoules.
constexpr double NoEnergy = 1e-12;
}

TEST(SurfaceForce, IsTheSurfacesStiffnessOrTheServosWhereItHasNone)
{
  MaterialHand own = HandOver(Table(), Everywhere(320.0, 0, 0, 0, 0));
  EXPECT_NEAR(own.MoveStraight({ 0, 0.0013, -0.004 }, 60)[2], 320.0 * 0.004, 1e-9);
  MaterialHand plain = HandOver(Table(), Everywhere(None, 0, 0, 0, 0));
  EXPECT_NEAR(plain.MoveStraight({ 0, 0.0013, -0.004 }, 60)[2], 500.0 * 0.004, 1e-9);
}

TEST(SurfaceForce, InterpolatesOverTrianglesWhatIsGivenAtPoints)
{
  const auto table = Table();
  PropertyValues values;
  values[Property::Stiffness] =
    AtPoints(*table, [](const Vec3& p) { return 400.0 + 4000.0 * p[0] + 2000.0 * p[1]; });
  for (const double x : { -0.0411, -0.0203, 0.0, 0.0107, 0.0332 })
  {
    MaterialHand hand(Touchable(table, values), { x, 0.0177, 0.001 });
    const double wanted = 400.0 + 4000.0 * x + 2000.0 * 0.0177;
    EXPECT_NEAR(hand.MoveStraight({ x, 0.0177, -0.003 }, 40)[2], 0.003 * wanted, 1e-6) << x;
  }
}

TEST(SurfaceForce, IsConstantOverATriangleWhatIsGivenAtTriangles)
{
  const auto table = MakeSurface(Square(0.05, 1)); // two triangles
  PropertyValues values;
  values[Property::Stiffness].IsPerTriangle = true;
  values[Property::Stiffness].Values = { 200.0f, 600.0f };
  const Triangle first = table->Triangles()[0];
  Vec3 middle{};
  for (const std::int32_t corner : first)
  {
    middle = middle + (1.0 / 3.0) * table->Points()[corner];
  }
  for (const double side : { 1.0, -1.0 })
  {
    const Vec3 over = side * middle; // the other triangle is this one turned about the origin
    MaterialHand hand(Touchable(table, values), over + Vec3{ 0, 0, 0.001 });
    EXPECT_NEAR(hand.MoveStraight(over + Vec3{ 0, 0, -0.002 }, 30)[2],
      0.002 * (side > 0.0 ? 200.0 : 600.0), 1e-9);
  }
}

TEST(SurfaceForce, NeverAsksForMoreStiffnessThanTheLimit)
{
  MaterialHand hand = HandOver(Table(), Everywhere(2000.0, 0, 0, 0, 0));
  hand.Limits.Stiffness = 700.0;
  EXPECT_NEAR(hand.MoveStraight({ 0, 0.0013, -0.004 }, 60)[2], 700.0 * 0.004, 1e-9);
  EXPECT_TRUE(hand.Force.IsLimited());
}

// Steady motion at 50 mm/s, in and along: after 5 time constants of the filter, B v against it.
TEST(SurfaceForce, DampsAlongNormalAndTangent)
{
  MaterialHand hand = HandOver(Table(), Everywhere(500.0, 2.0, 0, 0, 0));
  hand.Move({ -0.02, 0.0013, -0.001 });
  for (int tick = 1; tick <= 60; ++tick)
  {
    hand.Move({ -0.02 + 5e-5 * tick, 0.0013, -0.001 - 5e-5 * tick });
  }
  EXPECT_NEAR(hand.Last[0], -2.0 * 0.05, 1e-4);
  EXPECT_NEAR(hand.Last[2], 500.0 * 0.004 + 2.0 * 0.05, 1e-4);
}

// The documented delay: a velocity that grows evenly is 5 ms late.
TEST(SurfaceForce, KnowsTheVelocityFiveMillisecondsLate)
{
  MaterialHand hand = HandOver(Table(), Everywhere(0.0, 2.0, 0, 0, 0));
  hand.Move({ 0, 0.0013, -0.002 });
  const double acceleration = 1.0; // [m/s^2]
  double x = 0.0;
  for (int tick = 1; tick <= 100; ++tick)
  {
    // The velocity over a tick, which is that of its middle.
    x += 0.001 * acceleration * 0.001 * (tick - 0.5);
    hand.Move({ x, 0.0013, -0.002 });
  }
  EXPECT_NEAR(-hand.Last[0] / 2.0, acceleration * (0.0995 - 0.005), 1e-6);
}

TEST(SurfaceForce, NeverPullsByDampingAndNeverDampsMoreThanTheLimit)
{
  MaterialHand hand = HandOver(Table(), Everywhere(100.0, 50.0, 0, 0, 0));
  hand.Limits.Damping = 1.5;
  hand.MoveStraight({ 0, 0.0013, -0.010 }, 30);
  for (int tick = 0; tick < 80; ++tick)
  {
    const Vec3 force = hand.Move({ 3e-4 * tick, 0.0013, -0.010 + 1.2e-4 * tick });
    ASSERT_GE(force[2], -1e-15) << "out at 0.12 m/s, tick " << tick;
    ASSERT_LE(std::abs(force[0]), 1.5 * 0.3 + 1e-9) << "along at 0.3 m/s";
  }
}

// What the module documents of the filter: as |B| in Colgate's condition it is counted in full, and
// costs the device less than that. b > T/2 / (1 - cos) Re{(1 - e^-jwT) H} for all w below Nyquist.
TEST(SurfaceForce, FilteredDampingTakesLessOfTheStableStiffnessThanIsCounted)
{
  const double a = 1.0 / 6.0; // T / (T + 5 ms)
  double worst = 0.0;
  for (double w = 0.001; w <= M_PI; w += 0.001)
  {
    // Re of -e^-jw a / (1 - (1-a) e^-jw), per unit of B.
    const double re = 1.0 - (1.0 - a) * std::cos(w);
    const double im = (1.0 - a) * std::sin(w);
    const double real = (std::cos(w) * re - std::sin(w) * im) / (re * re + im * im);
    worst = std::max(worst, -a * real);
  }
  EXPECT_LT(worst, 0.12);
  EXPECT_GT(worst, 0.05);
}

TEST(SurfaceForce, FollowsAForceProfileIncludingTheClickOfAButton)
{
  std::string error;
  // 0 N, up to 1.5 N at 3 mm, click: down to 0.6 N at 4 mm, bottom: 3 N at 6 mm.
  std::vector<double> forces;
  const auto button = [](double d)
  {
    return d < 0.003 ? 500.0 * d
      : d < 0.004    ? 1.5 - 900.0 * (d - 0.003)
                     : 0.6 + 1200.0 * (d - 0.004);
  };
  for (int i = 0; i <= 120; ++i)
  {
    forces.push_back(button(5e-5 * i));
  }
  PropertyValues values;
  values.Profile = ForceProfile::Build(forces, 0.006, error);
  ASSERT_NE(values.Profile, nullptr) << error;
  EXPECT_NEAR(values.Profile->SteepestSlope(), 1200.0, 1e-6);
  MaterialHand hand = HandOver(Table(), values);
  hand.MoveStraight({ 0, 0.0013, 0.0 }, 10);
  for (int i = 1; i <= 240; ++i)
  {
    const double depth = 2.5e-5 * i;
    ASSERT_NEAR(hand.Move({ 0, 0.0013, -depth })[2], button(depth), 1e-9) << depth;
  }
  EXPECT_NEAR(-hand.EnergyOut, values.Profile->Energy(0.006), 1e-6);
  hand.MoveStraight({ 0, 0.0013, 0.001 }, 70);
  EXPECT_NEAR(hand.EnergyOut, 0.0, 1e-6) << "a click is no motor";

  MaterialHand limited = HandOver(Table(), values);
  limited.Limits.Stiffness = 600.0;
  EXPECT_NEAR(limited.MoveStraight({ 0, 0.0013, -0.003 }, 30)[2], 0.75, 1e-9)
    << "all of it is scaled, so that its steepest slope is stable";
}

TEST(SurfaceForce, RefusesProfilesThatNoServoCanHold)
{
  std::string error;
  EXPECT_EQ(ForceProfile::Build({ 0.5, 1.0 }, 0.01, error), nullptr);
  EXPECT_NE(error.find("0.5"), std::string::npos) << error;
  EXPECT_EQ(ForceProfile::Build({ 0.0 }, 0.01, error), nullptr);
  EXPECT_EQ(ForceProfile::Build({ 0.0, -1.0 }, 0.01, error), nullptr);
  EXPECT_EQ(ForceProfile::Build({ 0.0, std::nan("") }, 0.01, error), nullptr);
  EXPECT_EQ(ForceProfile::Build({ 0.0, 1.0 }, 0.0, error), nullptr);
  EXPECT_NE(error, "");
}

// A hand that slides frictionless over bumps of +-20 %: the force follows them within their bounds.
TEST(SurfaceForce, TextureModulatesTheForceWithinItsBounds)
{
  const auto table = Table(50); // 2 mm
  PropertyValues values;
  values[Property::Texture] =
    AtPoints(*table, [](const Vec3& p) { return 0.2 * std::cos(p[0] * M_PI / 0.002); });
  MaterialHand hand(Touchable(table, values), { 0.0, 0.001, 0.001 });
  hand.MoveStraight({ 0.0, 0.001, -0.004 }, 50);
  EXPECT_NEAR(hand.Last[2], 500.0 * 0.004 * 1.2, 1e-5) << "on a crest";
  double least = 10.0;
  double most = 0.0;
  for (int tick = 1; tick <= 400; ++tick)
  {
    const double force = hand.Move({ 1e-4 * tick, 0.001, -0.004 })[2];
    least = std::min(least, force);
    most = std::max(most, force);
  }
  EXPECT_NEAR(least, 2.0 * 0.8, 1e-3);
  EXPECT_NEAR(most, 2.0 * 1.2, 1e-3) << "what the falls have put by pays for the rises";
  hand.MoveStraight({ 0.04, 0.001, 0.001 }, 50);
  EXPECT_LE(hand.EnergyOut, NoEnergy);
}

TEST(SurfaceForce, TakesTextureFromAnImageThatRepeats)
{
  const auto table = Table(1);
  auto image = std::make_shared<TextureImage>();
  image->Width = 2;
  image->Height = 1;
  image->Values = { -0.3f, 0.3f };
  for (const Vec3& p : table->Points())
  {
    // Two pixels every 20 mm.
    image->Coordinates.push_back({ static_cast<float>(p[0] / 0.02), 0.0f });
  }
  PropertyValues values;
  values.Image = image;
  const std::pair<double, double> cases[] = { { 0.005, -0.3 }, { 0.015, 0.3 }, { 0.010, 0.0 },
    { 0.020, 0.0 }, { -0.005, 0.3 }, { 0.0075, -0.15 } };
  for (const auto& [x, texture] : cases)
  {
    MaterialHand hand(Touchable(table, values), { x, 0.001, 0.001 });
    EXPECT_NEAR(hand.MoveStraight({ x, 0.001, -0.002 }, 20)[2], 1.0 * (1.0 + texture), 1e-5) << x;
  }
}

TEST(SurfaceForce, RefusesPropertiesThatAreNone)
{
  const auto table = Table(2); // 9 points, 8 triangles
  const auto refused = [&](const PropertyValues& values)
  {
    std::string error;
    EXPECT_EQ(SurfaceProperties::Build(values, *table, error), nullptr);
    return error;
  };
  PropertyValues values;
  values[Property::Damping].Values.assign(9, 1.0f);
  values[Property::Damping].Values[4] = NAN;
  EXPECT_NE(refused(values).find("damping of number 4 of the points"), std::string::npos);
  values[Property::Damping].Values[4] = -0.5f;
  EXPECT_NE(refused(values).find("-0.5"), std::string::npos);
  values[Property::Damping].Values.pop_back();
  EXPECT_NE(refused(values).find("8 values of damping for 9 points"), std::string::npos);
  EXPECT_NE(refused(Rough(0.2, 0.3)).find("above the static one"), std::string::npos);
  EXPECT_NE(refused(Everywhere(None, 0, 0, 0, 0.6)).find("texture"), std::string::npos);
  EXPECT_NE(refused(Everywhere(HUGE_VAL, 0, 0, 0, 0)).find("stiffness"), std::string::npos);
  PropertyValues angle;
  angle.FeatureAngle = 181.0;
  EXPECT_NE(refused(angle).find("feature angle"), std::string::npos);
  PropertyValues image;
  auto wrong = std::make_shared<TextureImage>();
  wrong->Width = 3;
  wrong->Height = 1;
  wrong->Values = { 0.0f };
  image.Image = wrong;
  EXPECT_NE(refused(image).find("3 x 1"), std::string::npos);
}
