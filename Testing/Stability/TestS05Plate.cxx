// S5: thin plates hold against any force and any speed (Fig. 4).
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Thicknesses[] = { 0.1e-3, 0.5e-3, 1e-3, 5e-3 };

TriangleMesh Plate(double thickness)
{
  return Box(0.05, 0.05, 0.5 * thickness, 4);
}
}

TEST(S05Plate, IsNotPushedThroughByFiveNewtons)
{
  for (const double thickness : Thicknesses)
  {
    const MethodPointer method = Certified(Plate(thickness));
    const Trace trace = ThroughPlate(*method, thickness);
    for (const LoopTick& tick : trace)
    {
      ASSERT_GE(tick.Held[2], 0.5 * thickness - 1e-9) << thickness << " m, " << tick.Time << " s";
    }
    EXPECT_NEAR(trace.back().Force[2], 5.0, 0.1) << thickness << " m";
  }
}

TEST(S05Plate, StopsAPlungeOfFiveMetresASecond)
{
  for (const double thickness : Thicknesses)
  {
    for (const double speed : { 0.1, 1.0, 5.0 })
    {
      const MethodPointer method = Certified(Plate(thickness));
      Vec3 hip{ 0.0013, 0.0021, 0.02 };
      method->Place(hip);
      while (hip[2] > -0.04)
      {
        hip[2] -= 1e-3 * speed;
        ASSERT_GE(method->Update(hip)[2], 0.5 * thickness - 1e-9)
          << thickness << " m, " << speed << " m/s, HIP at " << hip[2];
      }
    }
  }
}

// At 500 N/m five newtons need 10 mm: anything under 20 mm lets go at half its thickness.
TEST(S05Plate, IsPushedThroughWhereOnlyTheNearestSurfaceCounts)
{
  for (const double thickness : { 1e-3, 5e-3, 15e-3 })
  {
    const MethodPointer method = Nearest(Plate(thickness));
    EXPECT_LT(ThroughPlate(*method, thickness).back().Hip[2], -0.02) << thickness << " m";
  }
}
