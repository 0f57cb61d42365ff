// What fuzzing found, each a test of its own: see Testing/Fuzz.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

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
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    for (int i = 0; i + 1 < corners; ++i)
    {
      EXPECT_FALSE(exact.Crosses(way[i], way[i + 1])) << "tick " << tick << ", piece " << i;
    }
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

// Beside a huge surface the numbers of the scene are coarser than a small one is large: a way that
// ends short of the small one must not be rounded to beyond it.
TEST(FuzzFindings, ASmallSurfaceBesideAHugeOneIsNotPassedByRounding)
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
