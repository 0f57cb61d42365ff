// What was measured to go wrong in other libraries, with the figures to beat.
#include "AnalyticSurfaces.h"
#include "Oracle.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace haptics;
using namespace haptics::testing;

// An absolute cut-off of 0.158 mm^2 makes every triangle of these spheres vanish: 0 contacts.
TEST(WhereOthersFail, EveryTickTouchesASphereOfTinyTriangles)
{
  for (const int level : { 7, 8 }) // 327,680 and 1,310,720 triangles
  {
    const double radius = 0.05;
    GodObject god({ MakeSurface(Icosphere(level, radius)) });
    god.Update({ 1.02 * radius, 0, 0 });
    for (int tick = 0; tick < 4100; ++tick)
    {
      const double a = 1.5e-3 * tick;
      const Vec3 hip{ 0.96 * radius * std::cos(a), 0.96 * radius * std::sin(a),
        0.1 * radius * std::sin(3.0 * a) };
      ASSERT_EQ(god.Update(hip).Status, UpdateStatus::Touching) << "level " << level;
    }
  }
}

// Inside a sphere of R = 1 m, 20 mm deep, 1 mm a tick at 500 N/m, frictionless: proxies that stick
// on concave facets pull back with 0.40 / 8.4 / 76.7 N. The facets' own slope gives the oracle
// 0.050 / 0.025 / 0.013 N.
TEST(WhereOthersFail, NothingSticksInsideAFineSphere)
{
  const std::pair<int, double> cases[] = { { 6, 0.050 }, { 7, 0.025 }, { 8, 0.013 } };
  for (const auto& [level, slope] : cases)
  {
    const auto surface = MakeSurface(InsideOut(Icosphere(level, 1.0)));
    GodObject god({ surface });
    Oracle oracle(surface);
    const Vec3 u = Unit(Cross({ 0.3, 0.5, 0.81 }, { 0, 0, 1 }));
    const Vec3 v = Unit(Cross({ 0.3, 0.5, 0.81 }, u));
    god.Place(0.9 * u);
    oracle.Place(0.9 * u);
    double sum = 0.0;
    double oracleSum = 0.0;
    int ticks = 0;
    for (int tick = 0; tick < 2000; ++tick)
    {
      const double a = 1e-3 * tick / 1.02;
      const Vec3 outwards = std::cos(a) * u + std::sin(a) * v;
      const Vec3 hip = 1.02 * outwards;
      const auto tangential = [&](const Vec3& position)
      {
        const Vec3 force = 500.0 * (position - hip);
        return Length(force - Dot(force, outwards) * outwards);
      };
      const Contact& contact = god.Update(hip);
      const Vec3 right = oracle.Update(hip);
      ASSERT_NEAR(500.0 * contact.Penetration, 10.0, 0.5);
      if (tick >= 50)
      {
        sum += tangential(contact.Position);
        oracleSum += tangential(right);
        ++ticks;
      }
    }
    EXPECT_NEAR(sum / ticks, slope, 0.1 * slope) << "level " << level;
    EXPECT_LE(sum / ticks, oracleSum / ticks + 1e-3) << "level " << level;
  }
}

// One constraint a tick answers a tick late, and leaves 45 % of sliding ticks unmoved.
TEST(WhereOthersFail, EverySlidingTickMovesOnASphere)
{
  GodObject god({ MakeSurface(Icosphere(5, 0.05)) });
  god.Update({ 0.051, 0, 0 });
  Vec3 before = god.Update({ 0.048, 0, 0 }).Position;
  for (int tick = 1; tick < 5000; ++tick)
  {
    const double a = 1e-3 * tick;
    const Vec3 hip{ 0.048 * std::cos(a), 0.048 * std::sin(a), 0.01 * std::sin(0.37 * a) };
    const Vec3 now = god.Update(hip).Position;
    ASSERT_GT(Length(now - before), 1e-6) << "tick " << tick;
    before = now;
  }
}

// The proxy of another library in free space closes 5 % of the gap a tick: a pull where nothing is.
TEST(WhereOthersFail, FreeSpaceHasNoForceAtAnySpeed)
{
  GodObject god({ MakeSurface(Icosphere(4, 0.05)) });
  for (int tick = 0; tick < 5000; ++tick)
  {
    const double a = 0.37 * tick;
    const Contact& contact = god.Update({ 0.06 + 0.05 * std::sin(0.1 * a),
      0.09 * std::cos(a) * std::cos(a), 0.2 + 0.1 * std::sin(a) });
    ASSERT_EQ(contact.Displacement, (Vec3{ 0, 0, 0 }));
  }
}

// The sum of two vector fields at nearly parallel planes presses twice as hard (Fig. 3).
TEST(WhereOthersFail, TwoNearlyParallelPlanesPressOnce)
{
  for (const double degrees : { 0.0, 0.001, 0.01, 1.0, 10.0, 30.0, 60.0, 90.0, 120.0 })
  {
    const double angle = degrees * M_PI / 180.0;
    TriangleMesh tilted = Square(0.2);
    for (Vec3& p : tilted.Points)
    {
      p = { p[0] * std::cos(angle), p[1], p[0] * std::sin(angle) };
    }
    GodObject god({ MakeSurface(Square(0.2)), MakeSurface(tilted) });
    // Symmetric: under the crease along the bisector of the normals, 10 mm deep.
    const Vec3 bisector{ -std::sin(0.5 * angle), 0, std::cos(0.5 * angle) };
    god.Update(0.05 * bisector);
    const Contact& contact = god.Update(-0.01 * bisector);
    EXPECT_NEAR(contact.Penetration, 0.01, 1e-9) << degrees << " degrees";
  }
}

// "For objects with about 600 triangular facets the simulation runs at about 1 kHz", in 1995. Only
// collision detection grows with the object: the answer's work does not.
TEST(WhereOthersFail, TheWorkOfAnUpdateDoesNotGrowWithTheObject)
{
  // Counted in pieces of way, not in time: the casts that moved the god-object.
  double perTick[2];
  for (const int fine : { 0, 1 })
  {
    // The same facets are touched; the fine object has 80,000 more of them elsewhere.
    TriangleMesh mesh = Icosphere(2, 0.05); // 320 triangles
    if (fine)
    {
      mesh = Joined(mesh, Moved(Icosphere(6, 0.05), { 1, 0, 0 }));
    }
    GodObject god({ MakeSurface(mesh) });
    god.Update({ 0, 0, 0.06 });
    long pieces = 0;
    for (int tick = 0; tick < 2000; ++tick)
    {
      const double a = 1e-3 * tick;
      god.Update({ 0.045 * std::sin(a), 0.01 * std::sin(3 * a), 0.045 * std::cos(a) });
      int corners = 0;
      god.Way(corners);
      pieces += corners - 1;
    }
    perTick[fine] = pieces / 2000.0;
  }
  EXPECT_EQ(perTick[0], perTick[1]);
  EXPECT_GT(perTick[0], 0.5);
  EXPECT_LT(perTick[0], 4.0);
}
