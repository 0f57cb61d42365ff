// Engines leave nothing out, and all lead to the same contact.
#include "AnalyticSurfaces.h"
#include "ExactEngine.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
std::vector<std::int32_t> InBall(const TriangleSurface& surface, const Vec3& centre, double radius)
{
  std::vector<std::int32_t> indices(surface.Triangles().size());
  TriangleList found{ indices.data(), static_cast<std::int32_t>(indices.size()) };
  surface.Engine().FindInBall(centre, radius, found);
  EXPECT_FALSE(found.Overflow);
  indices.resize(found.Count);
  std::sort(indices.begin(), indices.end());
  EXPECT_TRUE(std::adjacent_find(indices.begin(), indices.end()) == indices.end());
  return indices;
}

std::vector<std::int32_t> OnSegment(
  const TriangleSurface& surface, const Vec3& from, const Vec3& to)
{
  std::vector<std::int32_t> indices(surface.Triangles().size());
  TriangleList found{ indices.data(), static_cast<std::int32_t>(indices.size()) };
  surface.Engine().FindOnSegment(from, to, found);
  indices.resize(found.Count);
  std::sort(indices.begin(), indices.end());
  return indices;
}

/// Whether the segment crosses one triangle of the surface.
bool Crosses(
  const TriangleSurface& surface, std::int32_t triangle, const Vec3& from, const Vec3& to)
{
  TriangleMesh mesh;
  for (const std::int32_t corner : surface.Triangles()[triangle])
  {
    mesh.Points.push_back(surface.Points()[corner]);
  }
  mesh.Triangles = { { 0, 1, 2 } };
  const auto alone = MakeSurface(mesh, Side::Both);
  return ExactQueries(alone).Crosses(from - alone->Origin(), to - alone->Origin());
}

class Engines : public ::testing::TestWithParam<EngineKind>
{
};
}

TEST_P(Engines, LeaveOutNoTriangleThatMeetsABall)
{
  const auto surface = MakeSurface(Soup(300, 0.2, 11), Side::Both, GetParam());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vec3 centre{ place(random), place(random), place(random) };
    const double radius = 0.1 * (1.0 + place(random));
    const auto found = InBall(*surface, centre, radius);
    for (std::int32_t i = 0; i < 300; ++i)
    {
      const auto& t = surface->Triangles()[i];
      for (const std::int32_t corner : t)
      {
        // Cheap and sure: a corner in the ball means that the triangle meets it.
        if (Length(surface->Points()[corner] - centre) < radius)
        {
          EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << "triangle " << i;
        }
      }
    }
  }
}

TEST_P(Engines, LeaveOutNoTriangleThatASegmentMeetsInAnEdgeOrCorner)
{
  // Segments aimed exactly at corners and middles of edges: where watertight ray tests fail.
  const auto surface = MakeSurface(Icosphere(3, 0.05), Side::Both, GetParam());
  std::mt19937 random(3);
  std::uniform_int_distribution<std::int32_t> pick(0, 1279);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const std::int32_t i = pick(random);
    const auto& [a, b, c] = surface->Triangles()[i];
    const Vec3 corner = surface->Points()[a];
    const Vec3 target = trial % 2 ? corner : 0.5 * (corner + surface->Points()[b]);
    const Vec3 from{ place(random), place(random), place(random) };
    const auto found = OnSegment(*surface, from, from + 2.0 * (target - from));
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << "triangle " << i;
  }
}

TEST_P(Engines, FindASegmentAlongAnAxis)
{
  const auto surface = MakeSurface(Box(1, 1, 1, 8), Side::Front, GetParam());
  const Vec3 from{ 0.3, 0.3, 1.2 };
  const Vec3 to{ 0.3, 0.3, 0.9 };
  const auto found = OnSegment(*surface, from, to);
  EXPECT_TRUE(std::any_of(
    found.begin(), found.end(), [&](std::int32_t i) { return Crosses(*surface, i, from, to); }));
}

TEST_P(Engines, StopAtAFullList)
{
  const auto surface = MakeSurface(Icosphere(3, 1.0), Side::Front, GetParam());
  std::array<std::int32_t, 8> few;
  TriangleList found{ few.data(), 8 };
  surface->Engine().FindInBall({ 0, 0, 0 }, 2.0, found);
  EXPECT_TRUE(found.Overflow);
  EXPECT_EQ(found.Count, 8);
}

namespace
{
/// Thin as needles, long, and at every angle.
TriangleMesh Needles(int count, double width, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  TriangleMesh mesh;
  for (std::int32_t i = 0; i < count; ++i)
  {
    const Vec3 from{ place(random), place(random), place(random) };
    const Vec3 to{ place(random), place(random), place(random) };
    const Vec3 aside{ place(random), place(random), place(random) };
    mesh.Points.insert(mesh.Points.end(), { from, to, to + width * aside });
    mesh.Triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  return mesh;
}

/// Asks for triangles by balls and segments that meet them in a corner, on an edge or inside, at
/// every size, along axes too, and expects each to be found, once.
void ExpectNothingLeftOut(const TriangleSurface& surface, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto last = static_cast<std::int32_t>(surface.Triangles().size()) - 1;
  std::uniform_int_distribution<std::int32_t> pick(0, last);
  for (int trial = 0; trial < 3000; ++trial)
  {
    const std::int32_t i = pick(random);
    const auto& [a, b, c] = surface.Triangles()[i];
    const double time = trial % 3 == 0 ? 1.0 : share(random); // where points move
    const Vec3 from = surface.PointAt(a, time);
    double u = share(random);
    double v = (1.0 - u) * share(random);
    if (trial % 5 < 2)
    {
      v = 0.0;
      u = trial % 5 == 0 ? 0.0 : u;
    }
    const Vec3 met =
      from + u * (surface.PointAt(b, time) - from) + v * (surface.PointAt(c, time) - from);
    const double size = surface.Radius() * std::exp2(-30.0 * share(random));
    Vec3 aside = size * Vec3{ place(random), place(random), place(random) };
    if (trial % 4 == 0)
    {
      aside = { 0, 0, 0 };
      aside[trial / 4 % 3] = size;
    }
    // Rounding of the point on the triangle, and no more: for surfaces of radius 1.
    const double rounding = 1e-15 * surface.Radius();
    const auto inBall = InBall(surface, met + aside, (Length(aside) + rounding) * (1.0 + 1e-14));
    ASSERT_TRUE(std::binary_search(inBall.begin(), inBall.end(), i))
      << "trial " << trial << ", triangle " << i << ", ball of " << Length(aside);
    const double beyond = trial % 7 == 0 ? 0.0 : share(random);
    const auto onSegment = OnSegment(surface, met - aside, met + beyond * aside);
    ASSERT_TRUE(std::binary_search(onSegment.begin(), onSegment.end(), i))
      << "trial " << trial << ", triangle " << i << ", segment of " << Length(aside);
    ASSERT_TRUE(std::adjacent_find(onSegment.begin(), onSegment.end()) == onSegment.end());
  }
}

TriangleMesh Twice(TriangleMesh mesh)
{
  const auto triangles = mesh.Triangles;
  mesh.Triangles.insert(mesh.Triangles.end(), triangles.begin(), triangles.end());
  return mesh;
}

TriangleMesh OfSizes()
{
  // One large triangle, and details of every size down to a millionth of it.
  TriangleMesh mesh = Square(1.0);
  for (int i = 1; i <= 20; ++i)
  {
    mesh = Joined(mesh, Moved(Scaled(Icosphere(1, 1.0), std::ldexp(1.0, -i)), { 0, 0, 0.5 }));
  }
  return mesh;
}
}

TEST_P(Engines, LeaveNothingOut)
{
  const std::pair<const char*, TriangleMesh> meshes[] = { { "star", Star(4, 1.0, 0.5, 1) },
    { "needles", Needles(500, 1e-9, 2) }, { "flat", Square(1.0, 16) },
    { "twice the same", Twice(Twice(Icosphere(2, 1.0))) }, { "one triangle", Needles(1, 1.0, 3) },
    { "of all sizes", OfSizes() }, { "far away", Moved(Icosphere(3, 1.0), { 1e6, -3e5, 7e5 }) },
    { "tiny", Scaled(Soup(300, 0.2, 4), 1e-30) }, { "huge", Scaled(Soup(300, 0.2, 5), 1e30) } };
  unsigned seed = 0;
  for (const auto& [name, mesh] : meshes)
  {
    SCOPED_TRACE(name);
    ExpectNothingLeftOut(*MakeSurface(mesh, Side::Both, GetParam()), ++seed);
  }
}

std::string NameOf(EngineKind kind)
{
  return kind == EngineKind::BruteForce ? "BruteForce"
    : kind == EngineKind::Embree        ? "Embree"
                                        : "Exact";
}

INSTANTIATE_TEST_SUITE_P(Each, Engines,
  ::testing::Values(EngineKind::BruteForce, EngineKind::Embree, EngineKind::Exact),
  [](const auto& info) { return NameOf(info.param); });

TEST(Engines, LeaveNothingOutWherePointsMove)
{
  const TriangleMesh mesh = Star(3, 1.0, 0.3, 1);
  for (const EngineKind kind : { EngineKind::BruteForce, EngineKind::Embree })
  {
    SCOPED_TRACE(NameOf(kind));
    SurfaceDeformer deformer(MakeSurface(mesh, Side::Both, kind));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    for (unsigned step = 0; step < 6; ++step)
    {
      std::vector<Vec3> points = mesh.Points;
      for (Vec3& p : points)
      {
        p = p + 0.1 * step * Vec3{ place(random), place(random), place(random) };
      }
      std::string error;
      const auto surface = deformer.Deform(std::move(points), 0.01, error);
      ASSERT_TRUE(surface) << error;
      SCOPED_TRACE(step);
      ExpectNothingLeftOut(*surface, step);
    }
  }
}

TEST(Engines, GiveTheSameContact)
{
  const std::pair<TriangleMesh, double> scenes[] = { { Star(3, 0.04, 0.4, 3), 0.06 },
    { Scaled(Soup(400, 0.4, 7), 0.04), 0.06 }, { Torus(0.025, 0.008, 32, 16), 0.04 },
    { Box(0.03, 0.03, 0.0005, 8), 0.04 }, { InsideOut(Icosphere(4, 0.05)), 0.06 },
    { Groove(10, 0.05), 0.05 } };
  unsigned seed = 0;
  for (const auto& [mesh, reach] : scenes)
  {
    ++seed;
    GodObject first({ MakeSurface(mesh, Side::Automatic, EngineKind::BruteForce) });
    GodObject second({ MakeSurface(mesh, Side::Automatic, EngineKind::Embree) });
    GodObject third({ MakeSurface(mesh, Side::Automatic, EngineKind::Exact) });
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Vec3 hip{ reach, reach, reach };
    int touches = 0;
    for (int tick = 0; tick < 5000; ++tick)
    {
      hip = 0.99 * (hip + 0.03 * reach * Vec3{ normal(random), normal(random), normal(random) });
      const Contact& a = first.Update(hip);
      touches += a.Status == UpdateStatus::Touching;
      for (GodObject* const other : { &second, &third })
      {
        const Contact& b = other->Update(hip);
        // The same triangles in another order, around another centre: rounding may differ.
        ASSERT_LT(Length(a.Position - b.Position), 1e-9 * reach)
          << "scene " << seed << ", tick " << tick << ", "
          << NameOf(other->Surfaces()[0].Surface->Engine().Kind());
        ASSERT_EQ(a.Status, b.Status);
      }
    }
    EXPECT_GT(touches, 100) << "scene " << seed;
  }
}

namespace
{
// Before any test makes a surface.
const bool IsExactEnabled = (EnableExactEngine(), true);
}
