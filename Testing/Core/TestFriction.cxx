// Friction against Coulomb's law, and that it changes no guarantee of the update.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "HipPath.h"
#include "MaterialTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// How far the pull is from the push, as a coefficient of friction, on a level plane.
double PullOverPush(const Contact& contact)
{
  const Vec3& d = contact.Displacement;
  return std::hypot(d[0], d[1]) / d[2];
}

std::shared_ptr<const TriangleSurface> Table()
{
  return MakeSurface(Square(0.1, 13));
}
}

//      o------->       the HIP draws away, 1 um a tick, 5 mm deep
//     /
TEST(Friction, BreaksAwayAtTheStaticAndSlidesAtTheDynamicCoefficient)
{
  for (const auto& [hold, slide] : { std::pair{ 0.5, 0.3 }, { 1.2, 0.2 }, { 0.05, 0.05 } })
  {
    GodObject god({ Touchable(Table(), Rough(hold, slide)) });
    god.Update({ 0.0213, 0.0037, 0.001 });
    const Vec3 start = god.Update({ 0.0213, 0.0037, -0.005 }).Position;
    double breakaway = 0.0;
    int slides = 0;
    for (int tick = 1; slides < 20000; ++tick)
    {
      const double way = 1e-6 * tick;
      const Contact& contact = god.Update({ 0.0213 - 0.8 * way, 0.0037 + 0.6 * way, -0.005 });
      if (contact.Position == start)
      {
        breakaway = PullOverPush(contact);
        ASSERT_LE(breakaway, 1.01 * hold) << "it never breaks away";
        continue;
      }
      ++slides;
      ASSERT_NEAR(PullOverPush(contact), slide, 0.01 * slide) << "slide " << slides;
    }
    EXPECT_NEAR(breakaway, hold, 0.01 * hold);
  }
}

TEST(Friction, DoesNotMoveABitWhileStuck)
{
  GodObject god({ Touchable(Table(), Rough(0.5, 0.3)) });
  god.Update({ 0.0213, 0.0037, 0.001 });
  const Vec3 start = god.Update({ 0.0213, 0.0037, -0.005 }).Position;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> tremble(-1.0, 1.0);
  for (int tick = 0; tick < 100000; ++tick)
  {
    // Within the cone at every depth: 1.4 · 1.1 mm is less than 0.5 · 4 mm.
    const Contact& contact = god.Update({ 0.0213 + 0.0011 * tremble(random),
      0.0037 + 0.0011 * tremble(random), -0.005 + 0.001 * tremble(random) });
    ASSERT_EQ(contact.Position, start) << "tick " << tick;
    ASSERT_EQ(contact.NumberOfConstraints, 1);
  }
}

// Encoders report a slow hand's way in steps of 55 um, with ticks between in which nothing moves.
TEST(Friction, SlidesWithoutStutteringUnderTheStepsOfAnEncoder)
{
  GodObject god({ Touchable(Table(), Rough(0.5, 0.3)) });
  god.Update({ -0.05, 0.003, 0.001 });
  const auto encoded = [](double x) { return 55e-6 * std::round(x / 55e-6); };
  double most = 0.0;
  for (int tick = 0; tick < 8000; ++tick)
  {
    const Vec3 hip{ encoded(-0.05 + 1e-5 * tick), 0.003, encoded(-0.005 + 2e-5 * (tick % 7)) };
    const Contact& contact = god.Update(hip);
    if (tick > 1000)
    {
      most = std::max(most, PullOverPush(contact));
    }
  }
  EXPECT_LT(most, 0.31) << "static friction would show as 0.5";
  EXPECT_GT(most, 0.29);
}

TEST(Friction, SticksAgainWhenThePullIsGone)
{
  GodObject god({ Touchable(Table(), Rough(0.5, 0.3)) });
  god.Update({ 0.0, 0.003, 0.001 });
  god.Update({ 0.0, 0.003, -0.005 });
  Vec3 slid{};
  for (int tick = 0; tick < 100; ++tick)
  {
    slid = god.Update({ 1e-4 * tick, 0.003, -0.005 }).Position; // to 9.9 mm, sliding
  }
  EXPECT_NEAR(slid[0], 0.0099 - 0.0015, 1e-9);
  // Back over it and 0.5 of the depth to the other side: nothing moves before that.
  for (double x = 0.0099; x > slid[0] - 0.0024; x -= 1e-4)
  {
    ASSERT_EQ(god.Update({ x, 0.003, -0.005 }).Position, slid) << x;
  }
  EXPECT_LT(god.Update({ slid[0] - 0.0026, 0.003, -0.005 }).Position[0], slid[0]);
}

// A hand that lies deeper in a hill than friction can hold: the cone is that of the facet under the
// god-object, all around.
TEST(Friction, SlidesAtTheDynamicCoefficientOverAFineSphere)
{
  const double radius = 0.05;
  GodObject god({ Touchable(MakeSurface(Icosphere(6, radius)), Rough(0.5, 0.3)) });
  god.Update({ 0.051, 0, 0 });
  double sum = 0.0;
  int ticks = 0;
  for (int tick = 0; tick < 4000; ++tick)
  {
    const double a = 2e-3 * tick; // 0.1 mm a tick
    const double r = radius - std::min(0.002, 1e-5 * tick);
    const Contact& contact = god.Update({ r * std::cos(a), r * std::sin(a), 0.1 * r });
    if (tick > 1000)
    {
      // Against the sphere's own normal at the god-object.
      const Vec3 up = Unit(contact.Position);
      const double push = Dot(contact.Displacement, up);
      const double pull = Length(contact.Displacement - push * up);
      // Facets of 1 mm on a radius of 50 mm turn by 1 to 2 degrees.
      ASSERT_NEAR(pull / push, 0.3, 0.06) << "tick " << tick;
      sum += pull / push;
      ++ticks;
    }
  }
  EXPECT_NEAR(sum / ticks, 0.3, 0.01);
}

TEST(Friction, LetsGoOfAnOpenEdgeAndFallsToTheHip)
{
  GodObject god({ Touchable(MakeSurface(Square(0.01, 3)), Rough(0.5, 0.3)) });
  god.Update({ 0, 0, 0.001 });
  god.Update({ 0, 0, -0.002 });
  for (int tick = 0; tick < 200; ++tick)
  {
    god.Update({ 1e-4 * tick, 0, -0.002 });
  }
  EXPECT_EQ(god.Current().Status, UpdateStatus::Free);
  EXPECT_EQ(god.Current().Displacement, (Vec3{ 0, 0, 0 }));
}

// Two hands on one surface: what one does is nothing to the other.
TEST(Friction, IsTheGodObjectsAndNotTheSurfaces)
{
  const TouchedSurface table = Touchable(Table(), Rough(0.5, 0.3));
  GodObject moving({ table });
  GodObject resting({ table });
  for (GodObject* god : { &moving, &resting })
  {
    god->Update({ 0, 0.003, 0.001 });
    god->Update({ 0, 0.003, -0.005 });
  }
  const Vec3 rest = resting.Current().Position;
  for (int tick = 0; tick < 100; ++tick)
  {
    moving.Update({ 1e-4 * tick, 0.003, -0.005 });
    resting.Update({ 0.002, 0.003, -0.005 });
  }
  EXPECT_GT(moving.Current().Position[0], 0.005);
  EXPECT_EQ(resting.Current().Position, rest);
}

TEST(Friction, StaysStuckWhereOnlyPropertiesChange)
{
  const auto surface = Table();
  GodObject before({ Touchable(surface, Rough(0.5, 0.3)) });
  before.Update({ 0, 0.003, 0.001 });
  before.Update({ 0, 0.003, -0.005 });
  const Vec3 stuck = before.Update({ 0.002, 0.003, -0.005 }).Position;
  GodObject after({ Touchable(surface, Rough(0.6, 0.3)) });
  after.Continue(before);
  EXPECT_EQ(after.Update({ 0.0024, 0.003, -0.005 }).Position, stuck);
}

TEST(Friction, StaysStuckWhereAnotherSurfaceComesOrGoes)
{
  const TouchedSurface table = Touchable(Table(), Rough(0.5, 0.3));
  const TouchedSurface ball(MakeSurface(Moved(Icosphere(2, 0.01), { 0.3, 0.2, 0.1 })));
  const std::vector<std::vector<TouchedSurface>> scenes = { { table }, { table, ball },
    { ball, table }, { table } };
  auto god = std::make_unique<GodObject>(scenes.front());
  god->Update({ 0, 0.003, 0.001 });
  god->Update({ 0, 0.003, -0.005 });
  const Vec3 stuck = god->Update({ 0.002, 0.003, -0.005 }).Position;
  for (const auto& scene : scenes)
  {
    auto next = std::make_unique<GodObject>(scene);
    next->Continue(*god);
    EXPECT_LT(Length(next->Update({ 0.002, 0.003, -0.005 }).Position - stuck), 1e-15)
      << scene.size() << " surfaces";
    god = std::move(next);
  }
}

//      o             a belt runs under a resting hand: it takes the god-object along as far as
//  ----------->      friction holds it
//      x
TEST(Friction, HoldsOnToASurfaceThatMoves)
{
  const auto motion = std::make_shared<SurfaceMotion>(RigidPose());
  TouchedSurface belt = Touchable(Table(), Rough(0.5, 0.3));
  belt.Motion = motion;
  GodObject god({ belt });
  const Vec3 hip{ 0.0013, 0.0007, -0.004 };
  god.Update({ hip[0], hip[1], 0.001 });
  god.Update(hip);
  ASSERT_TRUE(motion->MoveTo({ { 0.03, 0, 0 } }, 0.6)); // 50 um a tick
  for (int tick = 1; tick <= 600; ++tick)
  {
    const Vec3 place = god.LocalPosition(0);
    god.Advance(0.001);
    const Contact& contact = god.Update(hip);
    if (tick < 40) // 2 mm are the static cone's
    {
      ASSERT_NEAR(contact.Displacement[0], 5e-5 * tick, 1e-9);
      ASSERT_LT(Length(god.LocalPosition(0) - place), 1e-12) << "stuck to the belt";
    }
    else if (tick > 41)
    {
      ASSERT_NEAR(PullOverPush(contact), 0.3, 0.003) << "tick " << tick;
    }
  }
}

// The guarantees: no leak, never farther from the HIP, whatever the friction.
TEST(Friction, KeepsTheGuaranteesOnRandomFieldsAndWays)
{
  struct Case
  {
    TriangleMesh Mesh;
    Side TouchedSide;
    double Reach;
  };
  const Case cases[] = { { Star(3, 0.04, 0.4, 3), Side::Front, 0.04 },
    { Star(3, 0.04, 0.4, 3), Side::Both, 0.04 }, { Groove(5.0, 0.03), Side::Front, 0.03 },
    { Box(0.03, 0.03, 0.0005, 4), Side::Front, 0.03 },
    { InsideOut(Icosphere(3, 0.03)), Side::Front, 0.03 } };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> to2(0.0, 2.0);
  long stuck = 0;
  long slid = 0;
  for (const Case& c : cases)
  {
    const auto surface = MakeSurface(c.Mesh, c.TouchedSide);
    const ExactQueries exact(surface);
    PropertyValues values;
    values[Property::StaticFriction] = AtPoints(*surface, [&](const Vec3&) { return to2(random); });
    values[Property::DynamicFriction] = values[Property::StaticFriction];
    for (float& value : values[Property::DynamicFriction].Values)
    {
      value *= 0.6f;
    }
    for (const HipPath::Kind kind : { HipPath::Smooth, HipPath::Jitter, HipPath::Jump })
    {
      GodObject god({ Touchable(surface, values) });
      HipPath path(kind, c.Reach, 11);
      god.Update(path.Next());
      for (int tick = 0; tick < 1500; ++tick)
      {
        const Vec3 before = god.Current().Position;
        const Vec3 hip = path.Next();
        const Contact& contact = god.Update(hip);
        ASSERT_LE(contact.Penetration, Length(before - hip) * (1.0 + 1e-12) + 1e-15)
          << HipPath::NameOf(kind) << ", tick " << tick;
        if (contact.Status == UpdateStatus::Touching)
        {
          (contact.Position == before ? stuck : slid) += 1;
        }
        int corners = 0;
        const Vec3* const way = god.Way(corners);
        for (int i = 0; i + 1 < corners; ++i)
        {
          ASSERT_FALSE(exact.Crosses(way[i], way[i + 1]))
            << HipPath::NameOf(kind) << ", tick " << tick;
        }
      }
    }
  }
  EXPECT_GT(stuck, 1000);
  EXPECT_GT(slid, 1000);
}
