// S12: delays and stalls lower the largest stiffness as b / (E[T^2] / (2 E[T]) + t_d) says.
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

TEST(S12Delay, LowersTheBoundaryByTheFormula)
{
  for (const double delay : { 0.0, 1e-3, 2e-3, 5e-3, 1e-2 })
  {
    PressedScene scene = OnPlane();
    scene.Share = 0.1;
    scene.Delay = delay;
    EXPECT_NEAR(MeasuredBoundary(scene), 1.0, 0.10) << delay << " s";
  }
}

TEST(S12Delay, AStallCountsByTheMeanOfTheSquares)
{
  // One tick in so many takes so long; the mean period alone would allow up to twice as much.
  const std::pair<int, double> stalls[] = { { 2, 2e-3 }, { 10, 5e-3 }, { 20, 1e-2 } };
  for (const auto& [every, period] : stalls)
  {
    PressedScene scene = OnPlane();
    scene.Share = 0.1;
    scene.Periods.assign(every, 1e-3);
    scene.Periods.back() = period;
    EXPECT_NEAR(MeasuredBoundary(scene), 1.0, 0.10) << period << " s in " << every << " ticks";
  }
}

TEST(S12Delay, TheDrawnRunsRestAndHammer)
{
  EXPECT_LT(Swing(SceneOf("S12").Ours(), 100), 2e-3);
  EXPECT_GT(Swing(SceneOf("S12").Other(), 100), 5e-3);
}
