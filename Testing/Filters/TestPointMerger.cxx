#include "haptics/Filters/PointMerger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using haptics::PointMerger;

TEST(PointMerger, GivesEqualPointsOneIndex)
{
  PointMerger merger(4, 0.0);
  EXPECT_EQ(merger.Insert({ 1, 2, 3 }), 0);
  EXPECT_EQ(merger.Insert({ 3, 2, 1 }), 1);
  EXPECT_EQ(merger.Insert({ 1, 2, 3 }), 0);
  EXPECT_EQ(merger.Points().size(), 2u);
}

TEST(PointMerger, KeepsPointsApartThatDifferInTheLastBit)
{
  PointMerger merger(2, 0.0);
  EXPECT_EQ(merger.Insert({ 1, 0, 0 }), 0);
  EXPECT_EQ(merger.Insert({ std::nextafter(1.0, 2.0), 0, 0 }), 1);
}

TEST(PointMerger, TakesNegativeZeroForZero)
{
  PointMerger merger(2, 0.0);
  EXPECT_EQ(merger.Insert({ 0.0, 0, 0 }), 0);
  EXPECT_EQ(merger.Insert({ -0.0, 0, 0 }), 0);
}

TEST(PointMerger, GrowsBeyondTheExpectedNumberOfPoints)
{
  PointMerger merger(0, 0.0);
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int i = 0; i < 10000; ++i)
    {
      ASSERT_EQ(merger.Insert({ double(i % 100), double(i / 100), 0.5 }), i);
    }
  }
}

TEST(PointMerger, MergesAcrossTheBordersOfItsCells)
{
  PointMerger merger(3, 0.1);
  EXPECT_EQ(merger.Insert({ 0.099, 0, 0 }), 0);
  EXPECT_EQ(merger.Insert({ 0.101, -0.001, 0.001 }), 0);
  EXPECT_EQ(merger.Insert({ 0.25, 0, 0 }), 1);
}

TEST(PointMerger, AgreesWithALookAtAllPointsWithinATolerance)
{
  const double tolerance = 0.05;
  PointMerger merger(0, tolerance);
  std::vector<haptics::Vec3> kept;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  for (int i = 0; i < 3000; ++i)
  {
    const haptics::Vec3 point{ coordinate(random), coordinate(random), coordinate(random) };
    int nearest = -1;
    double limit = tolerance;
    for (std::size_t k = 0; k < kept.size(); ++k)
    {
      const double distance =
        std::hypot(kept[k][0] - point[0], kept[k][1] - point[1], kept[k][2] - point[2]);
      if (distance < limit)
      {
        limit = distance;
        nearest = static_cast<int>(k);
      }
    }
    if (nearest < 0)
    {
      nearest = static_cast<int>(kept.size());
      kept.push_back(point);
    }
    ASSERT_EQ(merger.Insert(point), nearest) << "point " << i;
  }
  EXPECT_LT(kept.size(), 3000u);
}
