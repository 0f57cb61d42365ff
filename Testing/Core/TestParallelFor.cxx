#include "haptics/Math/ParallelFor.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

using haptics::ParallelFor;

TEST(ParallelFor, DoesEachNumberOnceInPiecesOfOneSize)
{
  for (const std::size_t count : { 0u, 1u, 7u, 8u, 1000u })
  {
    std::vector<int> done(count, 0);
    EXPECT_TRUE(ParallelFor(count, 8,
      [&](std::size_t first, std::size_t last)
      {
        EXPECT_EQ(first % 8, 0u);
        EXPECT_EQ(last, std::min<std::size_t>(first + 8, count));
        for (std::size_t i = first; i < last; ++i)
        {
          ++done[i];
        }
      }));
    EXPECT_EQ(done, std::vector<int>(count, 1));
  }
}

TEST(ParallelFor, ThrowsWhatAPieceThrows)
{
  EXPECT_THROW(ParallelFor(1000, 1,
                 [](std::size_t first, std::size_t)
                 {
                   if (first == 500)
                   {
                     throw std::runtime_error("piece 500");
                   }
                 }),
    std::runtime_error);
}

TEST(ParallelFor, ReportsItsProgressOnTheCallingThreadAndEndsOnRequest)
{
  const std::thread::id caller = std::this_thread::get_id();
  double progress = 0.0;
  std::atomic<int> pieces{ 0 };
  EXPECT_FALSE(ParallelFor(
    1000, 1,
    [&](std::size_t, std::size_t)
    {
      ++pieces;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    },
    [&](double share)
    {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_GE(share, progress);
      progress = share;
      return share < 0.1;
    }));
  EXPECT_GE(progress, 0.1);
  EXPECT_LT(pieces, 1000);
}

/// The calling thread has nothing left to do, but is asked all the same.
TEST(ParallelFor, AsksWhileItWaitsForAPieceOfAnotherThread)
{
  if (std::thread::hardware_concurrency() < 2)
  {
    GTEST_SKIP() << "there is one core, so there is no other thread";
  }
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> hasOtherPiece{ false };
  std::atomic<bool> isAsked{ false };
  ParallelFor(
    2, 1,
    [&](std::size_t, std::size_t)
    {
      if (std::this_thread::get_id() == caller)
      {
        for (int i = 0; i < 10000 && !hasOtherPiece; ++i) // or both pieces would be this thread's
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return;
      }
      hasOtherPiece = true;
      for (int i = 0; i < 10000 && !isAsked; ++i)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    },
    [&](double share)
    {
      isAsked = isAsked || share == 0.5;
      return true;
    });
  EXPECT_TRUE(hasOtherPiece);
  EXPECT_TRUE(isAsked);
}
