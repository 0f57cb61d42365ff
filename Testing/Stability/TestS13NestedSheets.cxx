// S13: parallel sheets passed at once leave one plane to stay on, not a singular system.
#include "ProfileSurfaces.h"
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics;
using namespace haptics::testing;

TEST(S13NestedSheets, TheFirstHoldsAndSlides)
{
  for (const LoopTick& tick : SceneOf("S13").Ours())
  {
    if (tick.Hip[2] < 0.0)
    {
      const Vec3 foot{ tick.Hip[0], tick.Hip[1], 0.0 };
      ASSERT_LT(Length(tick.Held - foot), 1e-9) << tick.Time << " s";
    }
  }
}

TEST(S13NestedSheets, AreSingularWhereAllThatAreCrossedConstrain)
{
  const MethodPointer paper = Paper(Sheets(8, 2e-4, 0.05), false);
  const Trace trace = IntoSheets(*paper);
  EXPECT_GT(paper->SingularSolves(), 190);
  EXPECT_GT(trace.back().Force[0], -1e9); // finite
  EXPECT_GT(Length(trace.back().Held - Vec3{ trace.back().Hip[0], 0.001, 0.0 }), 0.005);
}
