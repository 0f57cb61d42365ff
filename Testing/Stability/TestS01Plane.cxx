// S1: on a plane the largest stiffness that stays still is 2b/T (Colgate and Schenkel 1997).
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

TEST(S01Plane, ShakesFromTwiceTheDampingOverThePeriodOn)
{
  for (const double damping : { 0.05, 0.1, 0.35, 1.0 })
  {
    EXPECT_NEAR(MeasuredBoundary(OnPlane(damping, 1e-3)), 1.0, 0.05) << damping << " N s/m";
  }
  for (const double period : { 5e-3, 2e-3, 5e-4, 1e-4 })
  {
    EXPECT_NEAR(MeasuredBoundary(OnPlane(0.35, period)), 1.0, 0.05) << period << " s";
  }
}

TEST(S01Plane, TheDrawnRunsRestAndHammer)
{
  EXPECT_LT(Swing(SceneOf("S1").Ours(), 50), 2e-4);
  EXPECT_GT(Swing(SceneOf("S1").Other(), 50), 5e-4);
}
