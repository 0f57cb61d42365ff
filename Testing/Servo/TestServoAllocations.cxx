#include "ServoTestTools.h"
#include "haptics/Servo/ServoCycle.h"
#include "haptics/Servo/ServoStatistics.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

// A program of its own, whose heap counts: a servo tick must not use it.
namespace
{
thread_local long Allocations = 0;
}

void* operator new(std::size_t size)
{
  ++Allocations;
  if (void* memory = std::malloc(size))
  {
    return memory;
  }
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept
{
  ++Allocations;
  std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept
{
  ++Allocations;
  std::free(memory);
}

namespace
{
TEST(ServoAllocations, AreCountedInTheLibrariesToo)
{
  const long before = Allocations;
  MakePlane();
  EXPECT_GT(Allocations, before);
}

TEST(ServoAllocations, DoNotHappenInATick)
{
  haptics::ServoCycle cycle(1024);
  haptics::ServoStatistics statistics;
  const auto channel = MakePressingHand(0.002);
  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  cycle.Begin(channel, haptics::ServoState::Stepping);
  const long before = Allocations;
  for (int i = 0; i < 2000; ++i) // beyond the records' capacity, and through a change of surface
  {
    ASSERT_TRUE(cycle.Tick(i * 0.001));
    statistics.AddTick(1000000, 1000);
  }
  EXPECT_EQ(Allocations, before);

  cycle.GetExchange().Publish(MakeGodObject(MakePlane()));
  const long published = Allocations;
  ASSERT_TRUE(cycle.Tick(2.0));
  EXPECT_EQ(Allocations, published) << "taking new surfaces";
  EXPECT_GT(channel->LastForce[2], 0.0);
}

TEST(ServoAllocations, DoNotHappenWhileTheHandGripsAndLetsGo)
{
  haptics::ServoCycle cycle(1024);
  const auto channel = MakePressingHand(0.002);
  const auto motion = std::make_shared<haptics::SurfaceMotion>(haptics::RigidPose());
  haptics::TouchedSurface part(MakePlane(), motion);
  cycle.Begin(channel, haptics::ServoState::Stepping);
  for (int i = 0; i < 41; ++i)
  {
    part.IsGripped = i % 2 == 1;
    cycle.GetExchange().Publish(std::make_unique<haptics::GodObject>(std::vector{ part }));
    if (part.IsGripped)
    {
      motion->JumpTo({ { 0.0, 0.0, -0.00004 * i }, { 1.0, 0.0, 0.0, 0.0 } });
    }
    const long published = Allocations;
    for (int tick = 0; tick < 10; ++tick)
    {
      ASSERT_TRUE(cycle.Tick(0.001 * (10 * i + tick)));
    }
    ASSERT_EQ(Allocations, published) << i;
  }
  EXPECT_GT(channel->LastForce[2], 0.0) << "let go at last, it is touched";
}
}
