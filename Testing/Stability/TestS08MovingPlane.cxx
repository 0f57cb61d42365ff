// S8: a surface that moves pushes steadily, though it is updated 30 times a second only.
// More: Testing/Core/TestMovingSurfaces.cxx and TestDeformingSurfaces.cxx.
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

TEST(S08MovingPlane, PushesWithoutSteps)
{
  EXPECT_LE(LargestStep(SceneOf("S8").Ours()), 0.05);
}

TEST(S08MovingPlane, PushesInStepsWhereTheMeshIsStepped)
{
  EXPECT_NEAR(LargestStep(SceneOf("S8").Other()), 700.0 * 0.03 * 0.033, 0.01);
}
