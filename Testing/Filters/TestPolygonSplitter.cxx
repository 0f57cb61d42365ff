#include "haptics/Filters/PolygonSplitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <random>
#include <utility>

using haptics::HasArea;
using haptics::PolygonSplitter;
using haptics::Vec3;

namespace
{
Vec3 Cross(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 u{ b[0] - a[0], b[1] - a[1], b[2] - a[2] };
  const Vec3 v{ c[0] - a[0], c[1] - a[1], c[2] - a[2] };
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

/// Twice the area of a polygon in the plane z = 0.
double TwiceArea(const std::vector<Vec3>& polygon)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

/// A proper triangulation of a counter-clockwise polygon in the plane z = 0: no triangle faces
/// backwards, the areas add up (together: no overlap, nothing left out), and each edge of the
/// polygon belongs to one triangle.
void ExpectProper(const std::vector<Vec3>& polygon)
{
  PolygonSplitter splitter;
  ASSERT_EQ(splitter.Split(polygon), PolygonSplitter::Result::Split);
  const int count = static_cast<int>(polygon.size());
  ASSERT_EQ(splitter.Triangles().size(), polygon.size() - 2);
  double sum = 0.0;
  std::map<std::pair<int, int>, int> edges;
  for (const PolygonSplitter::LocalTriangle& t : splitter.Triangles())
  {
    const double area = Cross(polygon[t[0]], polygon[t[1]], polygon[t[2]])[2];
    EXPECT_GE(area, 0.0);
    sum += area;
    for (int i = 0; i < 3; ++i)
    {
      ++edges[{ t[i], t[(i + 1) % 3] }];
    }
  }
  const double expected = TwiceArea(polygon);
  EXPECT_NEAR(sum, expected, 1e-12 * std::abs(expected)) << "rounding of the sums";
  for (int i = 0; i < count; ++i)
  {
    EXPECT_EQ((edges[{ i, (i + 1) % count }]), 1) << "edge from corner " << i;
  }
}

std::vector<Vec3> Scaled(std::vector<Vec3> polygon, double x, double y)
{
  for (Vec3& corner : polygon)
  {
    corner = { x * corner[0], y * corner[1], 0.0 };
  }
  return polygon;
}

// (0,2)---(1,2)
//   |       |
//   |     (1,1)---(2,1)
//   |               |
// (0,0)-----------(2,0)
const std::vector<Vec3> LShape{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 },
  { 0, 2, 0 } };
}

TEST(PolygonSplitter, SplitsAConcavePolygon)
{
  ExpectProper(LShape);
}

TEST(PolygonSplitter, SplitsPolygonsOfAnySize)
{
  for (const double scale : { 1e-30, 1e-12, 1e6, 1e12 })
  {
    SCOPED_TRACE(scale);
    ExpectProper(Scaled(LShape, scale, scale));
  }
}

TEST(PolygonSplitter, SplitsPolygonsAMillionthAsThickAsLong)
{
  for (const double thickness : { 1e-3, 1e-6, 1e-9, 1e-12 })
  {
    SCOPED_TRACE(thickness);
    ExpectProper(Scaled(LShape, 1.0, thickness));
  }
}

TEST(PolygonSplitter, SplitsAConcaveQuadAlongItsInnerDiagonal)
{
  ExpectProper({ { 0, 0, 0 }, { 2, -1, 0 }, { 1, 0, 0 }, { 2, 1, 0 } });
}

TEST(PolygonSplitter, UsesCornersOnAStraightEdge)
{
  // The shortest diagonal, from (4,0) to (0,0), runs through corners: it must not be used.
  const std::vector<Vec3> polygon{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 }, { 4, 0, 0 },
    { 2, 9, 0 } };
  ExpectProper(polygon);
  PolygonSplitter splitter;
  splitter.Split(polygon);
  for (const PolygonSplitter::LocalTriangle& t : splitter.Triangles())
  {
    EXPECT_TRUE(HasArea(polygon[t[0]], polygon[t[1]], polygon[t[2]]));
  }
}

TEST(PolygonSplitter, KeepsAHoleThatABridgeJoinsToTheOutline)
{
  ExpectProper({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 },
    { 1, 3, 0 }, { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 } });
}

TEST(PolygonSplitter, SplitsRandomStarsProperly)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> radius(0.05, 1.0);
  for (int trial = 0; trial < 300; ++trial)
  {
    SCOPED_TRACE(trial);
    const int count = 4 + trial % 60;
    std::vector<Vec3> star;
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2.0 * 3.14159265358979 * i / count;
      const double r = radius(random);
      star.push_back({ r * std::cos(angle), r * std::sin(angle), 0.0 });
    }
    ExpectProper(star);
  }
}

TEST(PolygonSplitter, KeepsTheOrientationInEveryPlane)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool reversed : { false, true })
    {
      std::vector<Vec3> polygon = LShape;
      for (Vec3& corner : polygon)
      {
        std::rotate(corner.begin(), corner.begin() + axis, corner.end());
      }
      if (reversed)
      {
        std::reverse(polygon.begin(), polygon.end());
      }
      PolygonSplitter splitter;
      ASSERT_EQ(splitter.Split(polygon), PolygonSplitter::Result::Split);
      Vec3 sum{};
      for (const PolygonSplitter::LocalTriangle& t : splitter.Triangles())
      {
        const Vec3 normal = Cross(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        for (int i = 0; i < 3; ++i)
        {
          sum[i] += normal[i];
        }
      }
      EXPECT_DOUBLE_EQ(sum[(2 + 3 - axis) % 3], reversed ? -6.0 : 6.0);
    }
  }
}

TEST(PolygonSplitter, SplitsANonPlanarQuadAlongItsShorterDiagonal)
{
  PolygonSplitter splitter;
  const std::vector<Vec3> quad{ { 0, 0, 0 }, { 1, 0, 1 }, { 1, 1, 0 }, { 0, 1, 0 } };
  ASSERT_EQ(splitter.Split(quad), PolygonSplitter::Result::Split);
  for (const PolygonSplitter::LocalTriangle& t : splitter.Triangles())
  {
    EXPECT_TRUE(std::count(t.begin(), t.end(), 0) == 1 && std::count(t.begin(), t.end(), 2) == 1)
      << "the diagonal from corner 0 to corner 2";
  }
}

TEST(PolygonSplitter, ReportsAPolygonThatCrossesItself)
{
  PolygonSplitter splitter;
  EXPECT_EQ(splitter.Split({ { 0, 0, 0 }, { 2, 2, 0 }, { 2, 0, 0 }, { 0, 2, 0 } }),
    PolygonSplitter::Result::Folded);
  EXPECT_EQ(splitter.Triangles().size(), 2u) << "a fan, so that its edges stay covered";
}

TEST(HasArea, IsDecidedExactly)
{
  EXPECT_FALSE(HasArea({ 0, 0, 0 }, { 1, 2, 3 }, { 2, 4, 6 }));
  EXPECT_FALSE(HasArea({ 1, 1, 1 }, { 1, 1, 1 }, { 2, 0, 0 }));
  // The rounded cross product of these is zero in two components and all noise in the third.
  const double third = 1.0 / 3.0;
  EXPECT_FALSE(HasArea({ 0, 0, 0 }, { third, 0.1, 0 }, { 2 * third, 0.2, 0 }));
  EXPECT_TRUE(HasArea({ 0, 0, 0 }, { third, 0.1, 0 }, { 2 * third, std::nextafter(0.2, 1.0), 0 }));
  EXPECT_TRUE(HasArea({ 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1e-140, 0 }));
}

namespace
{
constexpr double TwoPi = 6.283185307179586;

/// A star of many lobes with a rough edge.
std::vector<Vec3> RoughStar(int count)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> roughness(0.0, 0.01);
  std::vector<Vec3> star;
  for (int i = 0; i < count; ++i)
  {
    const double angle = TwoPi * i / count;
    const double r = 1.0 + 0.3 * std::sin(37.0 * angle) + roughness(random);
    star.push_back({ r * std::cos(angle), r * std::sin(angle), 0.0 });
  }
  return star;
}

/// Teeth on a bar, whose gaps all lie on one line.
std::vector<Vec3> Comb(int count)
{
  std::vector<Vec3> comb{ { 0.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 } };
  for (int i = count - 1; i >= 0; --i)
  {
    comb.push_back({ static_cast<double>(i) / count, i % 2 ? 1.0 : 0.01, 0.0 });
  }
  return comb;
}

/// A band of 20 turns.
std::vector<Vec3> Spiral(int count)
{
  std::vector<Vec3> band;
  const int half = count / 2;
  for (int i = 0; i < half; ++i)
  {
    const double angle = 20.0 * TwoPi * i / half;
    band.push_back({ (angle + 1.0) * std::cos(angle), (angle + 1.0) * std::sin(angle), 0.0 });
  }
  for (int i = half - 1; i > 0; --i)
  {
    const double angle = 20.0 * TwoPi * i / half;
    band.push_back({ angle * std::cos(angle), angle * std::sin(angle), 0.0 });
  }
  return band;
}

/// A shallow arc and its chord: nearly all corners are alike.
std::vector<Vec3> Arc(int count)
{
  std::vector<Vec3> arc;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 0.1 * i / count;
    arc.push_back({ std::sin(angle), 1.0 - std::cos(angle), 0.0 });
  }
  std::reverse(arc.begin(), arc.end());
  arc.push_back({ 0.0, -1.0, 0.0 }); // all of the arc is reflex
  return arc;
}
}

TEST(PolygonSplitter, SplitsPolygonsOfManyCornersProperly)
{
  for (const auto& make : { RoughStar, Comb, Spiral, Arc })
  {
    for (const int count : { 50, 1000, 5000 })
    {
      SCOPED_TRACE(count);
      const std::vector<Vec3> polygon = make(count);
      ExpectProper(
        TwiceArea(polygon) > 0.0 ? polygon : std::vector<Vec3>(polygon.rbegin(), polygon.rend()));
      ExpectProper(Scaled(
        TwiceArea(polygon) > 0.0 ? polygon : std::vector<Vec3>(polygon.rbegin(), polygon.rend()),
        1e6, 1e-6));
    }
  }
}

TEST(PolygonSplitter, AHundredThousandCornersTakeNoQuadraticTime)
{
  for (const auto& make : { RoughStar, Comb, Spiral })
  {
    PolygonSplitter splitter;
    const auto seconds = [&](int count)
    {
      const std::vector<Vec3> polygon = make(count);
      const std::clock_t start = std::clock(); // of the processor: the machine may be busy
      EXPECT_EQ(splitter.Split(polygon), PolygonSplitter::Result::Split);
      return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    };
    const double small = seconds(10000);
    const double large = seconds(100000);
    EXPECT_LT(large, 60.0 * small + 1.0) << "square time is 100 times as much";
  }
}

TEST(PolygonSplitter, StopsSoonAfterItIsAsked)
{
  const std::vector<Vec3> polygon = RoughStar(50000);
  for (const int last : { 1, 50, 300 })
  {
    int calls = 0;
    PolygonSplitter splitter;
    EXPECT_EQ(
      splitter.Split(polygon, [&] { return ++calls < last; }), PolygonSplitter::Result::Stopped);
    EXPECT_EQ(calls, last);
    EXPECT_TRUE(splitter.Triangles().empty());
    ExpectProper(LShape); // it can be used again
  }
}
