#include "ServoCycle.h"
#include "ServoStatistics.h"
#include "ServoTestTools.h"

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
}
