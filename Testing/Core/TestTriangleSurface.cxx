// What a snapshot finds out about its triangles, and what it refuses.
#include "AnalyticSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <thread>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
std::string ErrorOf(TriangleMesh mesh, SurfaceOptions options = {})
{
  std::string error;
  EXPECT_FALSE(TriangleSurface::Build(std::move(mesh), options, error));
  return error;
}
}

TEST(TriangleSurface, ReportsAClosedOrientedBox)
{
  const auto surface = MakeSurface(Box(1, 2, 3, 2), Side::Automatic);
  const SurfaceReport& report = surface->Report();
  EXPECT_TRUE(report.Closed);
  EXPECT_TRUE(report.Oriented);
  EXPECT_EQ(report.Components, 1);
  EXPECT_EQ(report.BoundaryEdges, 0);
  EXPECT_EQ(report.InsideOutComponents, 0);
  EXPECT_EQ(surface->TouchedSide(), Side::Front);
}

TEST(TriangleSurface, EveryEdgeOfAClosedSurfaceHasItsNeighbour)
{
  const auto surface = MakeSurface(Icosphere(2, 1.0));
  const Neighbours& neighbours = surface->AdjacentTriangles();
  for (std::size_t i = 0; i < neighbours.size(); ++i)
  {
    for (const std::int32_t other : neighbours[i])
    {
      ASSERT_GE(other, 0);
      const auto& back = neighbours[other];
      EXPECT_EQ(std::count(back.begin(), back.end(), static_cast<std::int32_t>(i)), 1);
    }
  }
}

TEST(TriangleSurface, AnOpenSurfaceIsTouchedFromBothSides)
{
  const auto surface = MakeSurface(Square(1.0, 3), Side::Automatic);
  EXPECT_FALSE(surface->Report().Closed);
  EXPECT_EQ(surface->Report().BoundaryEdges, 12);
  EXPECT_EQ(surface->TouchedSide(), Side::Both);
}

TEST(TriangleSurface, AFlippedTriangleIsCountedAndBothSidesAreTouched)
{
  TriangleMesh mesh = Icosphere(1, 1.0);
  std::swap(mesh.Triangles[7][0], mesh.Triangles[7][1]);
  const auto surface = MakeSurface(mesh, Side::Automatic);
  EXPECT_EQ(surface->Report().FlippedEdges, 3);
  EXPECT_EQ(surface->TouchedSide(), Side::Both);
}

TEST(TriangleSurface, AnEdgeOfThreeTrianglesIsNotManifold)
{
  TriangleMesh mesh = Square(1.0, 1);
  mesh.Points.push_back({ 0, 0, 1 });
  mesh.Triangles.push_back({ 0, 3, 4 }); // a fin on the diagonal
  const auto surface = MakeSurface(mesh, Side::Automatic);
  EXPECT_EQ(surface->Report().NonManifoldEdges, 1);
  EXPECT_EQ(surface->TouchedSide(), Side::Both);
}

TEST(TriangleSurface, AnInsideOutShellIsTouchedFromBothSides)
{
  const auto surface = MakeSurface(InsideOut(Icosphere(2, 1.0)), Side::Automatic);
  EXPECT_EQ(surface->Report().InsideOutComponents, 1);
  EXPECT_EQ(surface->TouchedSide(), Side::Both);
}

TEST(TriangleSurface, AHollowIsNotInsideOut)
{
  const TriangleMesh ball = Joined(Icosphere(2, 1.0), InsideOut(Icosphere(2, 0.5)));
  const auto surface = MakeSurface(ball, Side::Automatic);
  EXPECT_EQ(surface->Report().Components, 2);
  EXPECT_EQ(surface->Report().InsideOutComponents, 0);
  EXPECT_EQ(surface->TouchedSide(), Side::Front);
}

TEST(TriangleSurface, KeepsItsDetailFarFromTheWorldsOrigin)
{
  const Vec3 far{ 5e5, 4e6, 100 };
  const auto surface = MakeSurface(Moved(Icosphere(1, 1e-3), far));
  EXPECT_NEAR(surface->Radius(), 1.7e-3, 0.1e-3); // half the diagonal of a cube of 2 mm
  EXPECT_NEAR(Length(surface->Origin() - far), 0.0, 1e-9);
}

TEST(TriangleSurface, RoundsNoPointForItsFrame)
{
  double diagonal = 0.0;
  for (const double far : { 0.0, 1.0, 2.0, 1e3, 1e9 })
  {
    TriangleMesh mesh = Moved(Soup(20, 0.4, 5), { far, -far, 0.3 * far });
    // As thin as rounding: shifted by a rounding it may be a line.
    const double share = 0.37;
    Vec3& last = mesh.Points[mesh.Triangles[0][2]];
    const Vec3& a = mesh.Points[mesh.Triangles[0][0]];
    last = a + share * (mesh.Points[mesh.Triangles[0][1]] - a);
    const std::vector<Vec3> points = mesh.Points;
    const auto surface = MakeSurface(mesh, Side::Both);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vec3& local = surface->Points()[i];
      EXPECT_LE(Length(local), surface->Radius());
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(local[axis] + surface->Origin()[axis], points[i][axis]);
        EXPECT_EQ(points[i][axis] - local[axis], surface->Origin()[axis]);
      }
    }
    EXPECT_LT(surface->Radius(), 6.0);
    diagonal = far == 0.0 ? surface->Diagonal() : diagonal;
    EXPECT_NEAR(surface->Diagonal(), diagonal, 1e-6);
  }
}

TEST(TriangleSurface, NamesWhatIsWrongAndWhere)
{
  EXPECT_NE(ErrorOf({}).find("no triangle"), std::string::npos);

  TriangleMesh nan = Square(1.0);
  nan.Points[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(ErrorOf(nan).find("point 2"), std::string::npos);

  TriangleMesh infinite = Square(1.0);
  infinite.Points[3][0] = std::numeric_limits<double>::infinity();
  EXPECT_NE(ErrorOf(infinite).find("point 3"), std::string::npos);

  TriangleMesh outOfRange = Square(1.0);
  outOfRange.Triangles[1][0] = 99;
  EXPECT_NE(ErrorOf(outOfRange).find("99"), std::string::npos);

  TriangleMesh flat;
  flat.Points = { { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } };
  flat.Triangles = { { 0, 1, 2 } };
  EXPECT_NE(ErrorOf(flat).find("area"), std::string::npos);

  SurfaceOptions negative;
  negative.CrackWidth = -1.0;
  EXPECT_NE(ErrorOf(Square(1.0), negative).find("crack"), std::string::npos);
}

TEST(TriangleSurface, ThatNeverDeformsKeepsNothingForIt)
{
  // 128 with Embree 3, most of them its own; what a refit needs would be 16 more.
  const auto ball = MakeSurface(Icosphere(5, 1.0), Side::Front, EngineKind::Embree);
  EXPECT_LT(static_cast<double>(ball->MemoryBytes()) / ball->Triangles().size(), 140.0);
}

TEST(TriangleSurface, ReportsHowFarItsBuildIsAndStopsWhereThatIsAsked)
{
  const TriangleMesh mesh = Icosphere(6, 1.0); // 81,920 triangles
  const std::thread::id builder = std::this_thread::get_id();
  std::vector<double> fractions;
  std::string error;
  ASSERT_TRUE(TriangleSurface::Build(mesh, {}, error,
    [&](double fraction)
    {
      EXPECT_EQ(std::this_thread::get_id(), builder);
      fractions.push_back(fraction);
      return true;
    }));
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GE(fractions.front(), 0.0);
  EXPECT_LE(fractions.back(), 1.0);
  // By the triangles, by their neighbours, by Embree while it builds, and after it.
  EXPECT_GT(std::set<double>(fractions.begin(), fractions.end()).size(), 5u);

  for (const double stop : { 0.0, 0.3, 0.6, 0.8 })
  {
    EXPECT_FALSE(
      TriangleSurface::Build(mesh, {}, error, [stop](double fraction) { return fraction < stop; }))
      << stop;
    EXPECT_EQ(error, "") << stop;
  }
}
