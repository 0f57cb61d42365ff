#include "haptics/Devices/LatestValue.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace
{
TEST(LatestValue, IsTheInitialValueUntilOneIsPublished)
{
  haptics::LatestValue<int> value(7);
  EXPECT_FALSE(value.Update());
  EXPECT_EQ(value.Get(), 7);
}

TEST(LatestValue, GivesTheLastOfManyPublishedValuesOnce)
{
  haptics::LatestValue<int> value(0);
  for (int i = 1; i <= 5; ++i)
  {
    value.Publish(i);
  }
  EXPECT_TRUE(value.Update());
  EXPECT_EQ(value.Get(), 5);
  EXPECT_FALSE(value.Update());
  EXPECT_EQ(value.Get(), 5);
}

TEST(LatestValue, StaysUnchangedForTheReaderUntilItUpdates)
{
  haptics::LatestValue<int> value(0);
  value.Publish(1);
  ASSERT_TRUE(value.Update());
  value.Publish(2);
  value.Publish(3);
  EXPECT_EQ(value.Get(), 1);
}

TEST(LatestValue, IsNeverTornAndNeverOlderBetweenTwoThreads)
{
  using Block = std::array<std::uint64_t, 64>;
  constexpr std::uint64_t last = 200000;
  haptics::LatestValue<Block> value(Block{});

  std::thread publisher(
    [&value]
    {
      Block block;
      for (std::uint64_t i = 1; i <= last; ++i)
      {
        block.fill(i);
        value.Publish(block);
      }
    });

  std::uint64_t seen = 0;
  std::uint64_t torn = 0;
  std::uint64_t older = 0;
  while (seen < last)
  {
    if (!value.Update())
    {
      std::this_thread::yield();
      continue;
    }
    const Block& block = value.Get();
    for (const std::uint64_t word : block)
    {
      torn += word != block[0];
    }
    older += block[0] <= seen;
    seen = block[0];
  }
  publisher.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(older, 0u);
  EXPECT_EQ(seen, last) << "the last value published must reach the reader";
}
}
