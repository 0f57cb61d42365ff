// What is passed over, eight triangles at a time, may not be met; and most of what is far is.
#include "AnalyticSurfaces.h"
#include "RandomVectors.h"
#include "haptics/Contact/BallFacet.h"
#include "haptics/Contact/SeparatingPlanes.h"
#include "haptics/Surface/Facet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
struct Corners
{
  Vector A, B, C;

  double Distance(const Vector& x) const
  {
    double least = glm::length(x - NearestOnEdges(this->A, this->B, this->C, x));
    const Vector normal = glm::cross(this->B - this->A, this->C - this->A);
    const double height = std::abs(glm::dot(normal, x - this->A)) / glm::length(normal);
    const bool isOver = glm::dot(glm::cross(normal, this->B - this->A), x - this->A) >= 0.0 &&
      glm::dot(glm::cross(normal, this->C - this->B), x - this->B) >= 0.0 &&
      glm::dot(glm::cross(normal, this->A - this->C), x - this->C) >= 0.0;
    return isOver ? std::min(least, height) : least;
  }
};

/// Of all sizes, some of them needles or points.
std::vector<Corners> MakeTriangles(int count, double scale, std::mt19937& random)
{
  std::vector<Corners> all;
  for (int i = 0; i < count; ++i)
  {
    const double size = scale * std::pow(10.0, -(i % 4));
    Corners t;
    t.A = 1.5 * scale * ToVector(NormalVector(random));
    t.B = t.A + size * ToVector(NormalVector(random));
    t.C = t.A + size * ToVector(NormalVector(random));
    if (i % 17 == 0)
    {
      t.C = 0.7 * t.A + 0.3 * t.B;
    }
    if (i % 31 == 0)
    {
      t.B = t.A;
    }
    all.push_back(t);
  }
  return all;
}

void Fill(SeparatingPlanes& planes, const std::vector<Corners>& triangles)
{
  const auto size = static_cast<int>(triangles.size());
  for (int first = 0; first < size; first += SeparatingPlanes::Width)
  {
    SeparatingPlanes::Corners corners{};
    const int count = std::min(SeparatingPlanes::Width, size - first);
    for (int lane = 0; lane < count; ++lane)
    {
      const Corners& t = triangles[static_cast<std::size_t>(first + lane)];
      corners.Set(lane, ToVec3(t.A), ToVec3(t.B), ToVec3(t.C));
    }
    planes.Add(corners, count);
  }
}
}

TEST(SeparatingPlanes, PassOverNothingThatAMotionMayMeet)
{
  for (const double scale : { 1e-9, 1.0, 1e6 })
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const std::vector<Corners> triangles = MakeTriangles(203, scale, random);
    SeparatingPlanes planes(static_cast<int>(triangles.size()));
    Vector x = 0.3 * scale * ToVector(NormalVector(random));
    planes.Restart(x, scale);
    Fill(planes, triangles);
    long visited = 0;
    long met = 0;
    constexpr int Motions = 1500;
    for (int k = 0; k < Motions; ++k)
    {
      const double reach = scale * std::pow(10.0, -3.0 * share(random));
      const Vector way = 0.1 * reach * ToVector(NormalVector(random));
      std::set<int> found;
      planes.VisitNear(
        way, glm::length(way), reach, [] { return HUGE_VAL; },
        [&](int i)
        {
          found.insert(i);
          // What is looked at one by one is known better for the next motions.
          const Corners& t = triangles[static_cast<std::size_t>(i)];
          const Separation now = BallFacet(t.A, t.B, t.C).Separate(false, x);
          planes.Set(i, now.Normal, now.Distance);
        });
      std::set<int> within;
      planes.VisitWithin([reach] { return reach; }, [&](int i) { within.insert(i); });
      visited += static_cast<long>(found.size());
      for (int i = 0; i < static_cast<int>(triangles.size()); ++i)
      {
        const Corners& t = triangles[static_cast<std::size_t>(i)];
        double least = HUGE_VAL;
        for (int step = 0; step <= 4; ++step)
        {
          least = std::min(least, t.Distance(x + 0.25 * step * way));
        }
        met += least < reach ? 1 : 0;
        ASSERT_TRUE(least >= reach || found.count(i) == 1) << scale << " " << k << " " << i;
        ASSERT_TRUE(t.Distance(x) >= reach || within.count(i) == 1)
          << scale << " " << k << " " << i;
      }
      x += way;
      planes.Travel(x, glm::length(way));
      if (planes.Travelled() > 4.0F)
      {
        planes.Restart(x, scale);
        Fill(planes, triangles);
      }
    }
    EXPECT_GT(met, Motions);
    // Points have no plane, and are looked at each time; of others less than as many again as
    // count.
    const long points = static_cast<long>(triangles.size()) / 31 + 1;
    EXPECT_LT(visited, 2 * met + points * Motions) << scale;
  }
}
