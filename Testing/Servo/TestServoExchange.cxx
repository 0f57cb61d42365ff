#include "ServoTestTools.h"
#include "haptics/Servo/GodObjectExchange.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>

using haptics::GodObjectExchange;

namespace
{
TEST(GodObjectExchange, StartsWithFreeSpaceAsGenerationZero)
{
  GodObjectExchange exchange;
  EXPECT_EQ(exchange.Take().Generation, 0u);
  EXPECT_TRUE(exchange.Take().Object->Surfaces().empty());
}

TEST(GodObjectExchange, GivesTheNewestAndDropsTheOnesNeverTaken)
{
  GodObjectExchange exchange;
  const std::weak_ptr<const haptics::TriangleSurface> dropped = [&]
  {
    auto plane = MakePlane();
    exchange.Publish(MakeGodObject(plane));
    return plane;
  }();
  const auto newest = MakePlane();
  exchange.Publish(MakeGodObject(newest));
  EXPECT_TRUE(dropped.expired());
  EXPECT_EQ(exchange.Take().Generation, 2u);
  EXPECT_EQ(exchange.Take().Object->Surfaces().front().Surface, newest);
}

TEST(GodObjectExchange, KeepsARetiredSurfaceUntilItIsCollected)
{
  GodObjectExchange exchange;
  const std::weak_ptr<const haptics::TriangleSurface> retired = [&]
  {
    auto plane = MakePlane();
    exchange.Publish(MakeGodObject(plane));
    return plane;
  }();
  exchange.Take();
  exchange.Publish(MakeGodObject(MakePlane()));
  exchange.Take();
  EXPECT_FALSE(retired.expired()) << "the servo thread must not delete";
  exchange.Collect();
  EXPECT_TRUE(retired.expired());
}

TEST(GodObjectExchange, WaitsUntilWhatDeformsHasArrived)
{
  const auto plane = MakePlane();
  haptics::SurfaceDeformer deformer(plane);
  std::vector<haptics::Vec3> points;
  for (const haptics::Vec3& p : plane->Points())
  {
    const haptics::Vec3& o = plane->Origin();
    points.push_back({ p[0] + o[0], p[1] + o[1], p[2] + o[2] + 0.001 });
  }
  std::string error;
  const auto rising = deformer.Deform(points, 0.003, error);
  ASSERT_TRUE(rising) << error;
  GodObjectExchange exchange;
  exchange.Publish(MakeGodObject(plane));
  exchange.Take().Object->Update({ 0.0, 0.0, 0.1 });
  exchange.Publish(MakeGodObject(rising));
  EXPECT_TRUE(exchange.Take().IsSeamless) << "it starts where the one before is";
  exchange.Publish(MakeGodObject(MakePlane()));
  for (int tick = 0; tick < 3; ++tick)
  {
    EXPECT_EQ(exchange.Take().Generation, 2u) << "tick " << tick;
    exchange.Take().Object->Advance(0.001);
  }
  EXPECT_EQ(exchange.Take().Generation, 3u);
  EXPECT_FALSE(exchange.Take().IsSeamless) << "another plane";
}

// A source that gives 60 shapes a second, up to 3 ms early or late: each is taken before the next
// is there, though ticks of a millisecond do not divide the time between two.
TEST(GodObjectExchange, FollowsADeformingSourceWithoutLeavingAShapeOut)
{
  const auto plane = MakePlane();
  haptics::SurfaceDeformer deformer(plane);
  GodObjectExchange exchange;
  exchange.Publish(MakeGodObject(plane));
  exchange.Take().Object->Update({ 0.0, 0.0, 0.1 });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.003, 0.003);
  std::uint64_t published = 1;
  double due = 0.0;
  double last = 0.0;
  for (int tick = 0; tick < 10000; ++tick)
  {
    const double time = 0.001 * tick;
    if (time >= due)
    {
      ASSERT_EQ(exchange.Take().Generation, published) << "at " << time << " s";
      std::vector<haptics::Vec3> points = plane->Points();
      for (haptics::Vec3& p : points)
      {
        p[2] += 0.001 * std::sin(6.0 * time);
      }
      std::string error;
      const auto next = deformer.Deform(points, std::min(time - last, 0.1), error);
      ASSERT_TRUE(next) << error;
      published = exchange.Publish(MakeGodObject(next));
      last = time;
      due = (std::floor(60.0 * time + 0.5) + 1.0) / 60.0 + jitter(random);
    }
    haptics::NumberedGodObject& god = exchange.Take();
    god.Object->Advance(0.001, exchange.HasNext());
    god.Object->Update({ 0.0, 0.0, 0.1 });
  }
  EXPECT_NEAR(static_cast<double>(published), 601.0, 2.0);
}

TEST(GodObjectExchange, DeletesAllThatItHoldsAtItsEnd)
{
  std::vector<std::weak_ptr<const haptics::TriangleSurface>> published;
  {
    GodObjectExchange exchange;
    for (int i = 0; i < 3; ++i) // one retired, one current, one incoming
    {
      const auto plane = MakePlane();
      published.push_back(plane);
      exchange.Publish(MakeGodObject(plane));
      if (i < 2)
      {
        exchange.Take();
      }
    }
  }
  for (const auto& surface : published)
  {
    EXPECT_TRUE(surface.expired());
  }
}

TEST(GodObjectExchange, NeverGoesBackAndReachesTheLastBetweenTwoThreads)
{
  constexpr std::uint64_t last = 5000;
  GodObjectExchange exchange;
  const auto plane = MakePlane();
  std::atomic<std::uint64_t> older{ 0 };
  std::thread servo(
    [&]
    {
      std::uint64_t seen = 0;
      while (seen < last)
      {
        haptics::NumberedGodObject& god = exchange.Take();
        god.Object->Update({ 0.0, 0.0, -0.001 });
        older += god.Generation < seen;
        seen = god.Generation;
      }
    });
  for (std::uint64_t i = 0; i < last; ++i)
  {
    exchange.Publish(MakeGodObject(plane));
  }
  servo.join();
  EXPECT_EQ(older, 0u);
}
}
