// S7: in an obtuse valley a wall that would pull lets go, and the other takes over at the crease.
#include "SuiteTools.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// The largest distance from the nearest allowed point: on the crease while |x| <= d tan(15 deg),
/// else on a wall.
double LargestError(const Trace& trace)
{
  const double phi = 15.0 * M_PI / 180.0;
  double largest = 0.0;
  for (const LoopTick& tick : trace)
  {
    const Vec3& hip = tick.Hip;
    const double aside = std::abs(hip[0]);
    if (hip[2] >= aside * std::tan(phi))
    {
      continue;
    }
    const double along = std::max(0.0, aside * std::cos(phi) + hip[2] * std::sin(phi));
    const double x = std::copysign(along * std::cos(phi), hip[0]);
    const Vec3 nearest{ x, hip[1], along * std::sin(phi) };
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
