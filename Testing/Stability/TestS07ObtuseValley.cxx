// S7: in an obtuse valley a wall that would pull lets go, and the other takes over at the crease.
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// The largest distance from the nearest allowed point: on the crease while x <= d tan(15 deg),
/// then on the wall.
double LargestError(const Trace& trace)
{
  const double phi = 15.0 * M_PI / 180.0;
  double largest = 0.0;
  for (const LoopTick& tick : trace)
  {
    const Vec3& hip = tick.Hip;
    if (hip[2] >= 0.0)
    {
      continue;
    }
    const double along = std::max(0.0, hip[0] * std::cos(phi) + hip[2] * std::sin(phi));
    const Vec3 nearest{ along * std::cos(phi), hip[1], along * std::sin(phi) };
    largest = std::max(largest, Length(tick.Held - nearest));
  }
  return largest;
}
}

TEST(S07ObtuseValley, LeavesItsCreaseWithinAMicrometre)
{
  EXPECT_LT(LargestError(SceneOf("S7").Ours()), 1e-6);
}

TEST(S07ObtuseValley, LetsThePaperThroughItsCreaseThoughIterated)
{
  EXPECT_GT(LargestError(SceneOf("S7").Other()), 0.03);
}
