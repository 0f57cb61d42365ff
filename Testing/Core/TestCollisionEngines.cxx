// Engines leave nothing out, and all lead to the same contact.
#include "AnalyticSurfaces.h"
#include "ExactEngine.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <algorithm>
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

std::string NameOf(EngineKind kind)
{
  return kind == EngineKind::BruteForce ? "BruteForce"
    : kind == EngineKind::Embree        ? "Embree"
                                        : "Exact";
}

INSTANTIATE_TEST_SUITE_P(Each, Engines,
  ::testing::Values(EngineKind::BruteForce, EngineKind::Embree, EngineKind::Exact),
  [](const auto& info) { return NameOf(info.param); });

TEST(Engines, LeadToTheSameContact)
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
