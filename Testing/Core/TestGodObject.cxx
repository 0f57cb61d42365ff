// Where the god-object has to be, against closed forms. In the drawings o is the god-object and
// x the haptic interface point (HIP). Lengths are metres.
#include "AnalyticSurfaces.h"
#include "ProfileSurfaces.h"
#include "RandomVectors.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Tick/SurfaceForce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// The god-object keeps 1024 roundings off the surface: at these sizes under this.
constexpr double Tight = 1e-12;

void ExpectAt(const Contact& contact, const Vec3& position, double tolerance = Tight)
{
  EXPECT_NEAR(contact.Position[0], position[0], tolerance);
  EXPECT_NEAR(contact.Position[1], position[1], tolerance);
  EXPECT_NEAR(contact.Position[2], position[2], tolerance);
}
}

TEST(GodObject, IsAtTheHipInFreeSpace)
{
  GodObject god({ MakeSurface(Square(0.1)) });
  const Contact& contact = god.Update({ 0.01, 0.02, 0.03 });
  EXPECT_EQ(contact.Status, UpdateStatus::Free);
  EXPECT_EQ(contact.Position, (Vec3{ 0.01, 0.02, 0.03 }));
  EXPECT_EQ(contact.Displacement, (Vec3{ 0, 0, 0 }));
}

//      x            o
//  ---------  ->  --------- , in the same tick
//                   x
TEST(GodObject, StaysOnAPlaneInTheTickOfContact)
{
  GodObject god({ MakeSurface(Square(0.1)) });
  god.Update({ 0, 0, 0.001 });
  const Contact& contact = god.Update({ 0, 0, -0.002 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_EQ(contact.NumberOfConstraints, 1);
  EXPECT_NEAR(contact.Constraints[0].Normal[2], 1.0, 1e-15);
  EXPECT_NEAR(contact.Penetration, 0.002, Tight);
  ExpectAt(contact, { 0, 0, 0 });
}

TEST(GodObject, SlidesToTheFootPointOnAPlane)
{
  GodObject god({ MakeSurface(Square(0.1, 7)) });
  god.Update({ 0.03, 0, 0.01 });
  for (int tick = 0; tick < 1000; ++tick)
  {
    const Vec3 hip{ 0.03 * std::cos(0.01 * tick), 0.03 * std::sin(0.01 * tick), -0.005 };
    ExpectAt(god.Update(hip), { hip[0], hip[1], 0 });
  }
}

TEST(GodObject, LetsGoWithoutAnInwardPull)
{
  GodObject god({ MakeSurface(Square(0.1)) });
  god.Update({ 0, 0, 0.001 });
  god.Update({ 0, 0, -0.005 });
  const Contact& contact = god.Update({ 0, 0, 0.010 });
  EXPECT_EQ(contact.Status, UpdateStatus::Free);
  EXPECT_EQ(contact.Displacement, (Vec3{ 0, 0, 0 }));
}

TEST(GodObject, MovesInEveryTickOfASlowSlide)
{
  GodObject god({ MakeSurface(Square(0.1, 5)) });
  god.Update({ -0.01, 0, 0.001 });
  double before = god.Update({ -0.01, 0, -0.002 }).Position[0];
  for (int tick = 1; tick < 2000; ++tick)
  {
    const double now = god.Update({ -0.01 + 1e-5 * tick, 0, -0.002 }).Position[0];
    ASSERT_NEAR(now - before, 1e-5, 1e-12) << "tick " << tick;
    before = now;
  }
}

TEST(GodObject, RestsToTheLastDigitUnderAHandThatRests)
{
  GodObject god({ MakeSurface(Star(4, 1.0, 0.3, 5)) });
  std::mt19937 random(3);
  int held = 0;
  for (int place = 0; place < 400; ++place)
  {
    const Vec3 way = NormalVector(random);
    const double length = std::hypot(way[0], way[1], way[2]);
    const auto at = [&](double radius) -> Vec3 {
      return { radius / length * way[0], radius / length * way[1], radius / length * way[2] };
    };
    god.Place(at(2.0));
    for (int tick = 0; tick < 30; ++tick)
    {
      god.Update(at(0.6));
    }
    held += god.Current().NumberOfConstraints == 3;
    const Vec3 rest = god.Current().Position;
    for (int tick = 0; tick < 10; ++tick)
    {
      ASSERT_EQ(god.Update(at(0.6)).Position, rest) << "place " << place << ", tick " << tick;
    }
  }
  EXPECT_GT(held, 100); // in corners, where planes are put together
}

//   o             (Fig. 5)
//  ----.
//   x  |   ->  o at the side, within one tick
TEST(GodObject, CrossesAConvexEdgeWithinOneTick)
{
  GodObject god({ MakeSurface(Box(0.02, 0.02, 0.02, 2)) });
  god.Update({ 0.019, 0, 0.021 });
  god.Update({ 0.0195, 0, 0.0195 });
  // Around the edge: over the +x face, 1 mm inside it.
  god.Update({ 0.0205, 0, 0.0195 });
  const Contact& contact = god.Update({ 0.019, 0, 0.015 });
  ExpectAt(contact, { 0.02, 0, 0.015 });
}

//      o                 o
//   .-'x'-.    ->     .-'-.x   within one tick, or with one pass a tick within two
TEST(GodObject, TakesTwoTicksOverAConvexEdgeWithOnePassATick)
{
  const double slope = std::tan(M_PI / 12.0);
  const double depth = 0.002;
  const auto at = [&](double x, double below) -> Vec3
  {
    return { x + std::copysign(below * std::sin(M_PI / 12.0), -x), 0.001,
      -slope * std::abs(x) - below * std::cos(M_PI / 12.0) };
  };
  for (const int passes : { -3, 1, 2, 16, 1000 }) // clamped to 1 to 16
  {
    SCOPED_TRACE(passes);
    GodObject god({ MakeSurface(Ridge(150, 0.02)) });
    god.SetPassLimit(passes);
    god.Update(at(-0.005, -depth));
    god.Update(at(-0.005, depth));
    const Vec3 there = at(0.005, 0.0);
    const double farther = god.Update(at(0.005, depth)).Position[2] - there[2];
    const bool isThere = farther < 1e-9;
    EXPECT_EQ(isThere, passes > 1) << farther;
    EXPECT_NEAR(god.Update(at(0.005, depth)).Position[2], there[2], 1e-9);
  }
}

TEST(GodObject, StaysAtTheEntryFaceOfAPlateAtAnyDepth)
{
  for (const double thickness : { 5e-3, 1e-3, 1e-4, 1e-6 })
  {
    GodObject god({ MakeSurface(Box(0.05, 0.05, 0.5 * thickness, 4)) });
    god.Update({ 0.001, 0.002, 0.01 });
    for (double depth = 0.0; depth < 0.05; depth += 0.005)
    {
      ExpectAt(god.Update({ 0.001, 0.002, -depth }), { 0.001, 0.002, 0.5 * thickness });
    }
  }
}

TEST(GodObject, RestsOnTheCreaseOfAGroove)
{
  for (const double degrees : { 150.0, 120.0, 90.0, 60.0, 30.0, 10.0, 1.0, 0.2 })
  {
    GodObject god({ MakeSurface(Groove(degrees, 0.05)) });
    god.Update({ 0, 0, 0.04 });
    for (int tick = 0; tick < 200; ++tick)
    {
      // Pressed into the groove and moved along it.
      const double y = 1e-4 * tick;
      const Contact& contact = god.Update({ 1e-5, y, -0.01 });
      if (tick > 0)
      {
        // The clearance is 1024 roundings, seen under half the angle of the groove.
        ExpectAt(contact, { 0, y, 0 }, 1e-13 / std::sin(degrees * M_PI / 360.0));
        ASSERT_EQ(contact.NumberOfConstraints, 2) << degrees << " degrees";
      }
    }
  }
}

//  \        x: beyond one wall but under the other: pressed onto the left wall, the god-object
//   \  |       must not pass the right one on its way (Fig. 6)
//    \ |
TEST(GodObject, CrossesNoWallOfAnAcuteGroove)
{
  for (const double degrees : { 60.0, 30.0, 10.0, 1.0, 0.2 })
  {
    GodObject god({ MakeSurface(Groove(degrees, 0.05), Side::Front) });
    const double half = 0.5 * degrees * M_PI / 180.0;
    god.Update({ 0, 0, 0.04 });
    for (int tick = 0; tick <= 400; ++tick)
    {
      // Through the left wall and down past the crease.
      const Contact& contact = god.Update({ -0.02, 0, 0.04 - 2e-4 * tick });
      const Vec3& p = contact.Position;
      // Inside the wedge: |x| cos(half) <= z sin(half).
      ASSERT_LE(std::abs(p[0]) * std::cos(half), p[2] * std::sin(half) + 1e-12)
        << degrees << " degrees, tick " << tick;
    }
  }
}

TEST(GodObject, LeavesTheCreaseOfAnObtuseValleyWhenOneWallPulls)
{
  // Walls rise by phi from the horizontal. At depth d the HIP's nearest allowed point is on the
  // crease while x <= d tan(phi), then on the wall. Equality constraints would stick: 39 mm.
  const double phi = 15.0 * M_PI / 180.0;
  GodObject god({ MakeSurface(Groove(150.0, 0.2)) });
  god.Update({ 0, 0, 0.01 });
  const double depth = 0.02;
  for (int tick = 0; tick < 2000; ++tick)
  {
    const double x = 5e-5 * tick;
    const Contact& contact = god.Update({ x, 0, -depth });
    Vec3 expected{ 0, 0, 0 };
    if (x > depth * std::tan(phi))
    {
      const double along = x * std::cos(phi) - depth * std::sin(phi);
      expected = { along * std::cos(phi), 0, along * std::sin(phi) };
    }
    ASSERT_LT(Length(contact.Position - expected), 1e-6) << "tick " << tick;
  }
}

TEST(GodObject, RestsInTheCornerOfThreePlanes)
{
  GodObject god({ MakeSurface(InsideCorner(0.1)) });
  god.Update({ 0.01, 0.01, 0.01 });
  const Contact& contact = god.Update({ -0.003, -0.004, -0.005 });
  ExpectAt(contact, { 0, 0, 0 });
  EXPECT_EQ(contact.NumberOfConstraints, 3);
  EXPECT_NEAR(contact.Penetration, std::sqrt(50e-6), Tight);
}

TEST(GodObject, StopsAtTheFirstOfNestedSheets)
{
  TriangleMesh sheets;
  for (int i = 0; i < 10; ++i)
  {
    sheets = Joined(sheets, Moved(Square(0.05, 3), { 0, 0, -1e-4 * i }));
  }
  for (const Side side : { Side::Front, Side::Both })
  {
    GodObject god({ MakeSurface(sheets, side) });
    god.Update({ 0.003, 0.001, 0.01 });
    for (int tick = 0; tick < 200; ++tick)
    {
      const Vec3 hip{ 0.003 + 1e-5 * tick, 0.001, -1e-4 * tick };
      ExpectAt(god.Update(hip), { hip[0], hip[1], 0 });
    }
  }
}

TEST(GodObject, StopsAtTheFirstOfSheetsThatAreMoreThanAWayMayMeet)
{
  TriangleMesh sheets = Square(0.05);
  double thickness = 1e-6;
  for (int doubling = 0; doubling < 16; ++doubling, thickness *= 2.0)
  {
    sheets = Joined(sheets, Moved(sheets, { 0, 0, -thickness }));
  }
  GodObject god({ MakeSurface(std::move(sheets)) });
  for (int tick = 0; tick < 20; ++tick)
  {
    god.Update({ 0.003, 0.001 + 1e-6 * tick, 2e-5 }); // it learns how fine they are
  }
  for (const double depth : { 1e-3, 0.06, 0.01, 0.06, 1e-5 })
  {
    const Contact& contact = god.Update({ 0.003, 0.001, -depth });
    EXPECT_EQ(contact.Status, UpdateStatus::Touching) << depth;
    ExpectAt(contact, { 0.003, 0.001, 0 });
    god.Update({ 0.003, 0.001, 2e-5 });
  }
}

TEST(GodObject, StaysOutsideTwoCoincidentSheets)
{
  const TriangleMesh twice = Joined(Square(0.05, 2), InsideOut(Square(0.05, 2)));
  for (const double from : { 0.01, -0.01 })
  {
    GodObject god({ MakeSurface(twice, Side::Automatic) });
    god.Update({ 0.003, 0.001, from });
    ExpectAt(god.Update({ 0.003, 0.001, -from }), { 0.003, 0.001, 0 });
  }
}

TEST(GodObject, FollowsTheFacetsOfASphere)
{
  // 20,480 triangles, R 30 mm: facets lie up to 94 um inside the sphere.
  GodObject god({ MakeSurface(Icosphere(5, 0.03)) });
  god.Update({ 0.031, 0, 0 });
  for (int tick = 0; tick < 3000; ++tick)
  {
    const double a = 1e-3 * tick;
    const Vec3 direction{ std::cos(a) * std::cos(0.3 * a), std::sin(a),
      std::cos(a) * std::sin(0.3 * a) };
    const Contact& contact = god.Update(0.027 * Unit(direction));
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    EXPECT_NEAR(Length(contact.Position), 0.03, 1.0e-4);
  }
}

TEST(GodObject, OneSidedSurfacesLetGoFromBehind)
{
  GodObject god({ MakeSurface(Square(0.1), Side::Front) });
  god.Update({ 0, 0, -0.01 });
  const Contact& contact = god.Update({ 0, 0, 0.01 });
  EXPECT_EQ(contact.Status, UpdateStatus::Free);
}

TEST(GodObject, TwoSidedSurfacesHoldFromBehind)
{
  GodObject god({ MakeSurface(Square(0.1), Side::Both) });
  god.Update({ 0, 0, -0.01 });
  const Contact& contact = god.Update({ 0.001, 0, 0.01 });
  ExpectAt(contact, { 0.001, 0, 0 });
  EXPECT_NEAR(contact.Constraints[0].Normal[2], -1.0, 1e-15);
}

TEST(GodObject, GoesAroundTheRimOfATwoSidedSheet)
{
  GodObject god({ MakeSurface(Square(0.02, 2), Side::Both) });
  god.Update({ 0.03, 0, 0.005 });
  god.Update({ 0.03, 0, -0.005 });
  god.Update({ 0.01, 0, -0.005 });
  ExpectAt(god.Update({ 0.01, 0, 0.003 }), { 0.01, 0, 0 });
}

// Coming around a sharp edge, the god-object passes behind the next facet's plane: no contact.
TEST(GodObject, IsTheSameFromOutsideWithOneSideAndWithBoth)
{
  const std::pair<TriangleMesh, double> scenes[] = { { Box(0.03, 0.03, 0.03, 8), 0.03 },
    { Star(3, 0.04, 0.4, 3), 0.04 }, { Icosphere(2, 0.03), 0.03 }, { Groove(60, 0.05), 0.03 } };
  int scene = 0;
  for (const auto& [mesh, reach] : scenes)
  {
    ++scene;
    GodObject front({ MakeSurface(mesh, Side::Front) });
    GodObject both({ MakeSurface(mesh, Side::Both) });
    for (GodObject* god : { &front, &both })
    {
      god->Update({ 0.01 * reach, 0.02 * reach, 3.0 * reach });
    }
    for (int tick = 0; tick < 4000; ++tick)
    {
      const double a = 2e-3 * tick;
      const Vec3 hip = 0.8 * reach *
        Vec3{ std::sin(a) * std::cos(0.37 * a), std::sin(1.3 * a + 0.1), std::cos(a) };
      const Vec3 position = front.Update(hip).Position;
      ASSERT_LT(Length(both.Update(hip).Position - position), 1e-9)
        << "scene " << scene << ", tick " << tick;
    }
  }
}

TEST(GodObject, TouchesSeveralSurfacesAtOnce)
{
  // A floor and a wall as surfaces of their own: the force does not add up to twice (Fig. 3).
  const TriangleMesh floor = Square(0.1, 3);
  TriangleMesh tilted = Square(0.1, 3);
  const double angle = 1.0 * M_PI / 180.0;
  for (Vec3& p : tilted.Points)
  {
    p = { p[0] * std::cos(angle), p[1], p[0] * std::sin(angle) };
  }
  GodObject god({ MakeSurface(floor), MakeSurface(tilted) });
  god.Update({ 0, 0, 0.01 });
  const Contact& contact = god.Update({ 0, 0, -0.004 });
  EXPECT_NEAR(contact.Penetration, 0.004, Tight);
  const Contact& onTilted = god.Update({ 0.05, 0, -0.004 });
  ASSERT_EQ(onTilted.NumberOfConstraints, 1);
  EXPECT_EQ(onTilted.Constraints[0].Surface, 1);
}

TEST(GodObject, GivesTheSameContactAtEveryScaleAndPlace)
{
  const TriangleMesh mesh = Star(2, 1.0, 0.3, 5);
  const auto path = [](int tick)
  {
    const double a = 0.01 * tick;
    return 0.6 * Unit({ std::cos(a), std::sin(1.3 * a), std::sin(0.7 * a) });
  };
  const auto run = [&](double scale, const Vec3& by)
  {
    GodObject god({ MakeSurface(Moved(Scaled(mesh, scale), by)) });
    god.Update(by + (2.0 * scale) * path(0));
    std::vector<Vec3> displacements;
    for (int tick = 0; tick < 2000; ++tick)
    {
      displacements.push_back((1.0 / scale) * god.Update(by + scale * path(tick)).Displacement);
    }
    return displacements;
  };
  const auto reference = run(1.0, { 0, 0, 0 });
  for (const auto& [scale, by] :
    { std::pair<double, Vec3>{ 1e-6, { 0, 0, 0 } }, { 1e6, { 0, 0, 0 } },
      { 1e3, { 1e4, -1e4, 3e3 } }, { 1.0, { 1e6, 1e6, -1e6 } }, { 1e-3, { 1e3, 0, 0 } } })
  {
    const auto displacements = run(scale, by);
    for (std::size_t i = 0; i < reference.size(); ++i)
    {
      ASSERT_LT(Length(displacements[i] - reference[i]), 1e-6 * Length(reference[i]))
        << "scale " << scale << ", tick " << i;
    }
  }
}

TEST(GodObject, IsHeldByTheSmallestTriangles)
{
  // 5 cm, 327,680 triangles of 0.1 mm^2: with an absolute cut-off none of them exists.
  GodObject god({ MakeSurface(Icosphere(7, 0.05)) });
  god.Update({ 0.051, 0, 0 });
  for (int tick = 0; tick < 2000; ++tick)
  {
    const double a = 2e-3 * tick;
    const Contact& contact = god.Update({ 0.047 * std::cos(a), 0.047 * std::sin(a), 0 });
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_NEAR(contact.Penetration, 0.003, 1e-4);
  }
}

TEST(GodObject, RefusesAHipThatIsNoPlace)
{
  GodObject god({ MakeSurface(Square(0.1)) });
  god.Update({ 0, 0, 0.01 });
  const Vec3 before = god.Update({ 0, 0, -0.01 }).Position;
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200 })
  {
    const Contact& contact = god.Update({ 0, bad, 0 });
    EXPECT_EQ(contact.Status, UpdateStatus::InvalidHip);
    EXPECT_EQ(contact.Displacement, (Vec3{ 0, 0, 0 }));
    EXPECT_EQ(contact.Position, before);
  }
  EXPECT_EQ(god.Update({ 0, 0, -0.01 }).Status, UpdateStatus::Touching);
}

TEST(GodObject, StopsAtTheFirstSurfaceOfAJumpAcrossTheWorld)
{
  GodObject god({ MakeSurface(Joined(Square(0.1, 9), Moved(Square(0.1, 9), { 0, 0, -0.05 }))) });
  god.Update({ 0.01, 0.02, 1e6 });
  const Contact& contact = god.Update({ 0.01, 0.02, -1e6 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  // It is stopped as far off as the way from a million metres away can be trusted, ...
  ExpectAt(contact, { 0.01, 0.02, 0 }, 1e-7);
  // ... and comes down to the surface from there.
  ExpectAt(god.Update({ 0.01, 0.02, -1e-3 }), { 0.01, 0.02, 0 });
}

TEST(GodObject, StartingInsideIsFreeToLeave)
{
  GodObject god({ MakeSurface(Icosphere(3, 0.05)) });
  EXPECT_EQ(god.Update({ 0, 0, 0.01 }).Status, UpdateStatus::Free);
  EXPECT_EQ(god.Update({ 0, 0, 0.06 }).Status, UpdateStatus::Free);
  EXPECT_EQ(god.Update({ 0, 0, 0.04 }).Status, UpdateStatus::Touching);
}

TEST(GodObject, ContinuesWhereAnotherStands)
{
  const auto surface = MakeSurface(Square(0.1));
  GodObject first({ surface });
  first.Update({ 0, 0, 0.01 });
  first.Update({ 0, 0, -0.01 });
  GodObject second({ MakeSurface(Moved(Square(0.1), { 5, 0, 0 })), surface });
  second.Continue(first);
  const Contact& contact = second.Update({ 0.001, 0, -0.01 });
  ExpectAt(contact, { 0.001, 0, 0 }, 1e-11);
}

// A recording that is played gives the same again, whatever was touched before it.
TEST(GodObject, PlacedItMovesTheSameToTheLastDigitWhateverWasBefore)
{
  const auto surface = MakeSurface(Icosphere(3, 0.05));
  const auto stroke = [](double turn, int tick)
  {
    const double angle = 0.002 * tick + turn;
    return 0.048 * Unit({ std::cos(angle), std::sin(angle), 0.3 * std::sin(7.0 * angle) });
  };
  const auto positions = [&](GodObject& god)
  {
    std::vector<Vec3> all;
    god.Place({ 0.06, 0, 0 });
    for (int tick = 0; tick < 3000; ++tick)
    {
      all.push_back(god.Update(stroke(0.0, tick)).Position);
    }
    return all;
  };
  GodObject unused({ surface });
  const std::vector<Vec3> expected = positions(unused);
  GodObject used({ surface });
  for (int tick = 0; tick < 5000; ++tick)
  {
    used.Update(stroke(2.0, tick));
  }
  EXPECT_EQ(positions(used), expected);
  EXPECT_EQ(positions(used), expected);
}

// The same where corners and edges hold, and over facets as thin as the crack width, whose planes
// are turned to where they are met from.
TEST(GodObject, PlacedAmongCornersAndThinFacetsItMovesTheSameWhateverWasBefore)
{
  std::mt19937 random(41);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int touched = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    TriangleMesh mesh;
    SurfaceOptions options;
    options.TouchedSide = trial % 2 ? Side::Front : Side::Both;
    const int kind = trial % 3;
    if (kind == 0)
    {
      mesh = trial % 4 ? Star(2, 0.7, 0.6, static_cast<unsigned>(trial)) : Soup(60, 0.4, 3);
    }
    else
    {
      // Half to one clearance wide, which is a quarter of the crack width: one, or one with
      // another.
      options.CrackWidth = 0.012;
      const double width = 0.00225 + 0.00075 * uniform(random);
      mesh.Points = { { -0.5, 0, 0 }, { 0.5, 0, 0 }, { 0.4 * uniform(random), width, 0 },
        { 0.4 * uniform(random), 0.5 * width, -1.0 } };
      mesh.Triangles = { { 0, 1, 2 } };
      if (kind == 2)
      {
        mesh.Triangles.push_back({ 1, 0, 3 });
      }
    }
    std::string error;
    const auto surface = TriangleSurface::Build(std::move(mesh), options, error);
    ASSERT_TRUE(surface) << error;
    // Pressed from above, with small slides; left; and passed by.
    const double depth = kind == 0 ? 0.4 : 0.01;
    const double around = kind == 0 ? 0.3 : 0.001;
    const Vec3 foot = { 0.4 * uniform(random), kind == 0 ? 0.0 : 0.0015, 0.0 };
    const Vec3 start = { foot[0], foot[1] - 0.05, 0.9 };
    const Vec3 past = { foot[0], foot[1] + 0.05 * uniform(random), -0.09 };
    const auto press = [&](GodObject& god, int ticks)
    {
      for (int tick = 0; tick < ticks; ++tick)
      {
        god.Update({ foot[0] + around * std::sin(1.3 * tick), foot[1] + 0.1 * around * (tick % 3),
          -depth + 1e-3 * depth * (tick % 5) });
      }
    };
    const auto positions = [&](GodObject& god)
    {
      std::vector<Vec3> all;
      god.Place(start);
      for (int tick = 0; tick < 12; ++tick)
      {
        all.push_back(god.Update(past).Position);
      }
      press(god, 4);
      all.push_back(god.Current().Position);
      touched += god.Current().IsTouching() ? 1 : 0;
      return all;
    };
    GodObject unused({ surface });
    const std::vector<Vec3> expected = positions(unused);
    GodObject used({ surface });
    used.Place({ foot[0], foot[1], 0.9 });
    press(used, 40);
    ASSERT_EQ(positions(used), expected) << "trial " << trial;
  }
  EXPECT_GT(touched, 50);
}

TEST(GodObject, IsFreeWithoutSurfaces)
{
  GodObject god({});
  god.Update({ 0, 0, 0 });
  EXPECT_EQ(god.Update({ 1, 2, 3 }).Status, UpdateStatus::Free);
}

TEST(GodObject, IsHeldByTheTipOfAConeOfThousandsOfTriangles)
{
  for (const int count : { 100, 5000, 20000 }) // all meet in the tip
  {
    TriangleMesh cone;
    cone.Points.push_back({ 0, 0, 0.05 });
    for (int i = 0; i < count; ++i)
    {
      const double a = 2.0 * M_PI * i / count;
      cone.Points.push_back({ 0.02 * std::cos(a), 0.02 * std::sin(a), 0 });
      cone.Triangles.push_back({ 0, 1 + i, 1 + (i + 1) % count });
    }
    GodObject god({ MakeSurface(cone) });
    god.Update({ 1e-5, 2e-5, 0.06 });
    const Contact& contact = god.Update({ 1e-5, 2e-5, 0.04 });
    EXPECT_EQ(contact.Status, UpdateStatus::Touching) << count;
    EXPECT_GT(contact.Position[2], 0.04);
    for (int tick = 0; tick < 200; ++tick)
    {
      const double a = 0.05 * tick;
      const Contact& around = god.Update({ 2e-3 * std::cos(a), 2e-3 * std::sin(a), 0.043 });
      ASSERT_EQ(around.Status, UpdateStatus::Touching) << count << " triangles, tick " << tick;
    }
    EXPECT_EQ(god.Update({ 0, 0, 0.06 }).Status, UpdateStatus::Free);
  }
}

TEST(GodObject, IsHeldNotLetThroughWhereTooManyTrianglesMeet)
{
  TriangleMesh fan;
  fan.Points.push_back({ 0, 0, 0 });
  const int count = 50000;
  for (int i = 0; i < count; ++i)
  {
    const double a = 2.0 * M_PI * i / count;
    fan.Points.push_back({ std::cos(a), std::sin(a), 0 });
    fan.Triangles.push_back({ 0, 1 + i, 1 + (i + 1) % count });
  }
  GodObject god({ MakeSurface(fan, Side::Both) });
  god.Update({ 1e-9, 1e-9, 0.1 });
  const Contact& contact = god.Update({ 1e-9, 1e-9, -0.1 });
  EXPECT_EQ(contact.Status, UpdateStatus::Overloaded);
  EXPECT_GE(contact.Position[2], 0.0);
}

TEST(SurfaceForce, IsASpringLimitedToWhatTheDeviceCan)
{
  MaterialLimits limits;
  limits.MaximumForce = 3.0;
  const auto force = [&limits](const Vec3& displacement)
  {
    Contact contact;
    contact.Status = UpdateStatus::Touching;
    contact.Displacement = displacement;
    return SurfaceForce().Update(contact, 0.001, 400.0, limits);
  };
  EXPECT_EQ(force({ 0, 0, 0.005 }), (Vec3{ 0, 0, 2.0 }));
  const Vec3 limited = force({ 0.03, 0, 0.04 });
  EXPECT_NEAR(limited[0], 1.8, 1e-15);
  EXPECT_NEAR(limited[2], 2.4, 1e-15);
  EXPECT_EQ(force({ 0, std::numeric_limits<double>::quiet_NaN(), 0 }), (Vec3{ 0, 0, 0 }));
}
