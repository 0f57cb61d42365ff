#include "haptics/Servo/RingBuffer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>

using haptics::RingBuffer;

namespace
{
TEST(RingBuffer, GivesBackInOrderWhatWasPutIn)
{
  RingBuffer<int> ring(4);
  int value = 0;
  EXPECT_FALSE(ring.Pop(value));
  for (int round = 0; round < 5; ++round) // wraps round
  {
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_TRUE(ring.Push(10 * round + i));
    }
    for (int i = 0; i < 3; ++i)
    {
      ASSERT_TRUE(ring.Pop(value));
      EXPECT_EQ(value, 10 * round + i);
    }
    EXPECT_FALSE(ring.Pop(value));
  }
}

TEST(RingBuffer, RefusesWhenFullAndKeepsWhatItHas)
{
  RingBuffer<int> ring(4);
  ASSERT_EQ(ring.Capacity(), 4u);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(ring.HasRoom());
    EXPECT_TRUE(ring.Push(i));
  }
  EXPECT_FALSE(ring.HasRoom());
  EXPECT_FALSE(ring.Push(99));
  int value = -1;
  for (int i = 0; i < 4; ++i)
  {
    ASSERT_TRUE(ring.Pop(value));
    EXPECT_EQ(value, i);
  }
}

TEST(RingBuffer, RoundsItsCapacityUpToAPowerOfTwo)
{
  EXPECT_EQ(RingBuffer<int>(1).Capacity(), 1u);
  EXPECT_EQ(RingBuffer<int>(5).Capacity(), 8u);
}

TEST(RingBuffer, LosesAndReordersNothingBetweenTwoThreads)
{
  // Few laps, as each may take a busy machine two turns of its threads.
  constexpr std::uint64_t last = 100000;
  RingBuffer<std::uint64_t> ring(64);
  std::thread pusher(
    [&ring]
    {
      for (std::uint64_t i = 1; i <= last;)
      {
        if (ring.Push(i))
        {
          ++i;
        }
        else
        {
          std::this_thread::yield();
        }
      }
    });
  std::uint64_t expected = 1;
  std::uint64_t wrong = 0;
  while (expected <= last)
  {
    std::uint64_t value = 0;
    if (ring.Pop(value))
    {
      wrong += value != expected;
      ++expected;
    }
    else
    {
      std::this_thread::yield();
    }
  }
  pusher.join();
  EXPECT_EQ(wrong, 0u);
}
}
