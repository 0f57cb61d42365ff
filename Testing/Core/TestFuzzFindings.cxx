// What fuzzing found, each a test of its own: see Testing/Fuzz.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "RandomVectors.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
std::shared_ptr<const TriangleSurface> OneTriangle(
  const Vec3& a, const Vec3& b, const Vec3& c, Side side)
{
  TriangleMesh mesh;
  mesh.Points = { a, b, c };
  mesh.Triangles = { { 0, 1, 2 } };
  return MakeSurface(mesh, side, EngineKind::Embree);
}

/// Whether the god-object, on the way of its last update over one surface, met a triangle from a
/// side that can be touched. Exact.
bool HasCrossed(const GodObject& god, const ExactQueries& exact)
{
  int corners = 0;
  const Vec3* const way = god.Way(corners);
  for (int i = 0; i + 1 < corners; ++i)
  {
    if (exact.Crosses(way[i], way[i + 1]))
    {
      return true;
    }
  }
  return false;
}

/// Moves over the HIPs and checks every piece of the way with exact arithmetic.
void ExpectNoCrossing(
  const std::shared_ptr<const TriangleSurface>& surface, const std::vector<Vec3>& hips)
{
  const ExactQueries exact(surface);
  GodObject god({ surface });
  for (std::size_t tick = 0; tick < hips.size(); ++tick)
  {
    const Contact& contact = god.Update(hips[tick]);
    EXPECT_NE(contact.Status, UpdateStatus::Overloaded);
    EXPECT_FALSE(HasCrossed(god, exact)) << "tick " << tick;
  }
}
}

// Where a way from far out passes the surface is lost in rounding.
TEST(FuzzFindings, AWayFromFarOutMissesNoTriangle)
{
  for (const double far : { 1e7, 1e10, 1e18, 1e54 })
  {
    ExpectNoCrossing(
      OneTriangle({ 1.25, 1.25, 1.75 }, { -2, -2, -2 }, { -1.75, -1.75, -0.75 }, Side::Front),
      { { -far, 0, 0 }, { -2, -2, -2 } });
    ExpectNoCrossing(OneTriangle({ 0, -0.25, 0 }, { -2, 0, -0.25 }, { -0.25, -2, -2 }, Side::Both),
      { { -2, -far, 1.75 }, { -0.25, 0, -0.25 } });
    ExpectNoCrossing(
      MakeSurface(Icosphere(2, 1.0)), { { 0.3 * far, far, -far }, { 0.1, 0.2, 0.3 } });
  }
}

TEST(FuzzFindings, AWayToFarOutMissesNoTriangle)
{
  for (const double far : { 1e7, 1e10, 1e18, 1e54 })
  {
    ExpectNoCrossing(MakeSurface(InsideOut(Icosphere(2, 1.0)), Side::Front, EngineKind::Embree),
      { { 0.1, 0.2, 0.3 }, { 0.9, 0.2, 0.3 }, { -far, 0, 0 }, { far, far, 0.5 * far } });
  }
}

TEST(FuzzFindings, AHugeCrackWidthCountsAsTheSizeOfTheSurface)
{
  for (const EngineKind engine : { EngineKind::BruteForce, EngineKind::Embree })
  {
    SurfaceOptions options;
    options.Engine = engine;
    options.CrackWidth = 1e44;
    std::string error;
    const auto surface = TriangleSurface::Build(Square(1.0), options, error);
    ASSERT_TRUE(surface) << error;
    EXPECT_LE(surface->Clearance(), surface->Radius());
    ExpectNoCrossing(surface, { { 0.2, 0.1, 3.0 }, { 0.2, 0.1, -3.0 }, { 0.2, 0.1, 3.0 } });
  }
}

// Near a huge surface the numbers of the scene are coarser than a small one is large: a way that
// ends short of the small one must not be rounded to beyond it.
TEST(FuzzFindings, ASmallSurfaceNearAHugeOneIsNotPassedByRounding)
{
  const auto huge = OneTriangle({ 0, 0, 1e34 }, { 8e34, 0, 1e34 }, { 0, -8e34, 2e34 }, Side::Front);
  for (const Side side : { Side::Front, Side::Both })
  {
    TriangleMesh mesh;
    mesh.Points = { { 0, 0.75, -1.5 }, { 2, -1.5, 1.75 }, { 0, 2, -0.25 }, { 1.75, -1.5, -1.5 } };
    mesh.Triangles = { { 3, 1, 2 }, { 3, 2, 1 }, { 2, 0, 1 }, { 0, 2, 1 } };
    const auto small = MakeSurface(mesh, side, EngineKind::BruteForce);
    const ExactQueries exact(small);
    const Vec3 offset = small->Origin() - huge->Origin();
    GodObject god({ huge, small });
    god.Update({ -0.43, -2.3e69, -0.77 });
    for (int tick = 0; tick < 10; ++tick)
    {
      god.Update({ 1.0, -2.0, -0.75 });
      int corners = 0;
      const Vec3* const way = god.Way(corners);
      for (int i = 0; i + 1 < corners; ++i)
      {
        ASSERT_FALSE(exact.Crosses(way[i] - offset, way[i + 1] - offset)) << "piece " << i;
      }
    }
  }
}

// A triangle of 5 by 3e-16: its distances are known to no better than its length, and the way to
// one of its corners goes through it.
TEST(FuzzFindings, AWayThroughATriangleAsThinAsRoundingIsHeld)
{
  TriangleMesh mesh;
  mesh.Points = { { -2, -2, -2 }, { -1.25, -1.25, -1.25 },
    { 1.5000000000000002, 1.5000000000000002, 1.5 }, { -1.25, 1.5000000000000002, -1.75 },
    { -1.75, -1.75, -1.75 }, { -1.75, -1.75, -0.5 } };
  mesh.Triangles = { { 4, 4, 3 }, { 0, 1, 2 }, { 5, 1, 4 } };
  for (const EngineKind engine : { EngineKind::Embree, EngineKind::BruteForce })
  {
    ExpectNoCrossing(
      MakeSurface(mesh, Side::Both, engine), { { -0.12, -0.31, -0.24 }, { -2, -2, -2 } });
  }
}

// A ball that is put so near to a facet grows away from that, on the side that it is on, be that a
// fraction of a rounding.
TEST(FuzzFindings, ABallThatStartsWithinRoundingOfAFacetGrowsOnItsSide)
{
  struct
  {
    TriangleMesh Mesh;
    Side TouchedSide;
  } scenes[] = {
    { { { { 2, 2, 1.75 }, { 2, 1.75, -2 }, { -2, -2, -1.25 } }, { { 1, 2, 0 } } }, Side::Both },
    { { { { 2, 2, 1.75 }, { 2, 1.75, -2 }, { -2, -2, -1.25 } }, { { 1, 2, 0 } } }, Side::Front },
    { { { { -0.25, -2, -2 }, { -2, 0.5, -2 }, { -2, -0.25, -1.75 } }, { { 1, 2, 0 }, { 1, 0, 2 } },
        { Side::Both, Side::Front } },
      Side::Both },
    { Square(1.0, 3), Side::Both },
    { Icosphere(1, 1.0), Side::Both },
    { Icosphere(1, 1.0), Side::Front },
    { Star(2, 1.0, 0.4, 7), Side::Both },
    { Soup(60, 0.4, 3), Side::Both },
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::uniform_int_distribution<int> ulps(-3, 3);
  int grown = 0;
  for (const auto& scene : scenes)
  {
    const auto surface = MakeSurface(scene.Mesh, scene.TouchedSide);
    const ExactQueries exact(surface);
    const Vec3 middle = surface->Origin();
    const auto count = static_cast<std::uint32_t>(surface->Triangles().size());
    for (int trial = 0; trial < 400; ++trial)
    {
      const Triangle& corners = surface->Triangles()[random() % count];
      // Of three trials one is at an edge, and one at a corner.
      const double v = trial % 3 < 2 ? share(random) : 0.0;
      const double w = trial % 3 < 1 ? share(random) * (1.0 - v) : 0.0;
      const Vec3& a = surface->Points()[corners[0]];
      Vec3 hip = middle + a + v * (surface->Points()[corners[1]] - a) +
        w * (surface->Points()[corners[2]] - a);
      for (double& x : hip)
      {
        x += ulps(random) * 0x1p-53;
      }
      GodObject god({ surface }, Tip::Ball);
      god.SetTipRadius(0.25);
      const Vec3 pull = (trial % 2 ? 0.01 : 4.0) * NormalVector(random);
      for (int tick = 0; tick < 8; ++tick)
      {
        god.Update(tick < 4 ? hip : hip + pull);
        ASSERT_FALSE(HasCrossed(god, exact)) << "trial " << trial << ", tick " << tick;
      }
      grown += god.BallRadius() > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(grown, 7 * 300);
}

// Two sheets back to back, as thin as rounding and inside out, with a rim: what says at an edge
// whether a ball is outside says that it is not.
TEST(FuzzFindings, ABallsCentreCrossesNoFrontOfASliver)
{
  std::mt19937 random(11);
  int touched = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    TriangleMesh mesh;
    mesh.Points = { { -1, -1, 1.5 }, { -0.5, -0.25, -1.75 }, { -0.5, -0.5, -0.5 },
      { -0.5, -0.5, -0.5 } };
    mesh.Points[3][trial % 3] += (trial % 2 ? 1.0 : -1.0) * (1 + trial % 5) * 0x1p-54;
    mesh.Triangles = { { 3, 0, 2 }, { 3, 1, 0 }, { 0, 1, 2 } };
    if (trial % 4 == 3)
    {
      mesh.Triangles.push_back({ 3, 2, 1 });
    }
    const auto surface = MakeSurface(mesh, Side::Front);
    const ExactQueries exact(surface);
    GodObject god({ surface }, Tip::Ball);
    god.SetTipRadius(trial % 7 < 3 ? 1.5 : 0.2);
    const Vec3 from = NormalVector(random);
    // Through the corner, and through other places of the sheets.
    const double share = trial % 2 ? 0.0 : 0.4;
    const Vec3 through = mesh.Points[2] + share * (mesh.Points[0] - mesh.Points[2]) +
      0.5 * share * (mesh.Points[1] - mesh.Points[2]);
    const Vec3 to = from + 2.0 * (through - from);
    for (int tick = 0; tick <= 24; ++tick)
    {
      const double part = trial % 5 ? tick / 24.0 : std::min(tick, 1);
      touched += god.Update(from + part * (to - from)).IsTouching() ? 1 : 0;
      ASSERT_FALSE(HasCrossed(god, exact)) << "trial " << trial << ", tick " << tick;
    }
  }
  EXPECT_GT(touched, 300);
}

// Where points are a rounding apart the middle between them is rounded, to a corner: no point may
// be farther out than the radius all the same, or nothing is looked for where it is.
TEST(FuzzFindings, ATriangleAsSmallAsARoundingIsNotMissedFromFarOut)
{
  constexpr double u = 0x1p-52;
  ExpectNoCrossing(OneTriangle({ -2, -2, -2 }, { -2 + u, -2 - 2 * u, -2 - 2 * u },
                     { -2 - 2 * u, -2 - 2 * u, -2 - 2 * u }, Side::Front),
    { { -2, 1 - 0.5 * u, 1 }, { -3.28, 2.27, -0.12 }, { -2 - 2 * u, -2 - 2 * u, -2 - 2 * u } });

  std::mt19937 random(34);
  std::uniform_int_distribution<int> ulps(-4, 4);
  int touched = 0;
  for (int trial = 0; trial < 400; ++trial)
  {
    const double size = std::ldexp(1.0, trial % 7 - 3);
    const auto near = [&]
    {
      Vec3 x = { size, -size, size };
      for (double& value : x)
      {
        value += ulps(random) * u * size;
      }
      return x;
    };
    const Vec3 corners[3] = { near(), near(), near() };
    TriangleMesh mesh;
    mesh.Points = { corners[0], corners[1], corners[2] };
    mesh.Triangles = { { 0, 1, 2 } };
    std::string error;
    SurfaceOptions options;
    options.TouchedSide = trial % 2 ? Side::Front : Side::Both;
    const auto surface = TriangleSurface::Build(std::move(mesh), options, error);
    if (!surface)
    {
      continue; // no area
    }
    for (const Vec3& p : surface->Points())
    {
      EXPECT_LE(Length(p), surface->Radius());
    }
    const ExactQueries exact(surface);
    GodObject god({ surface });
    for (int tick = 0; tick < 12; ++tick)
    {
      const Vec3 hip = tick % 3 == 2 ? corners[tick / 3 % 3]
                                     : corners[0] + (tick % 2 ? 2.0 : 0.01) * NormalVector(random);
      touched += god.Update(hip).IsTouching() ? 1 : 0;
      ASSERT_FALSE(HasCrossed(god, exact)) << "trial " << trial << ", tick " << tick;
    }
  }
  EXPECT_GT(touched, 100);
}
