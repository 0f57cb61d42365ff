// S3: a sharp ridge, pressed below its edge, at a stiffness far above the device's own 2b/T.
#include "ProfileSurfaces.h"
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

namespace
{
/// Ticks of the last half second, when the hand has been still for as long, that turn the force by
/// more than 30 degrees.
int FlipsAtRest(const Trace& trace)
{
  int flips = 0;
  for (std::size_t i = trace.size() - 500; i < trace.size(); ++i)
  {
    const haptics::Vec3& before = trace[i - 1].Force;
    const haptics::Vec3& now = trace[i].Force;
    flips += Dot(before, now) < std::cos(M_PI / 6.0) * Length(before) * Length(now);
  }
  return flips;
}

/// What comes out of surface and device together: the forces' work and what is left in the spring,
/// less the device's own friction, which is what makes a held force passive [J].
double EnergyOut(const Trace& trace, double stiffness)
{
  const LoopTick& end = trace.back();
  const double d = Length(end.Held - end.Hip);
  return end.Work + 0.5 * stiffness * d * d - end.Lost;
}
}

TEST(S03Ridge, DoesNotFlipByItselfNorGiveEnergy)
{
  for (const double stiffness : { 300.0, 700.0, 1500.0 })
  {
    const MethodPointer method = Certified(Ridge(10, 0.05));
    const Trace trace = OverRidge(*method, stiffness);
    EXPECT_EQ(FlipsAtRest(trace), 0) << stiffness << " N/m";
    EXPECT_LE(EnergyOut(trace, stiffness), 0.0) << stiffness << " N/m";
  }
}

// The field has two sides at half the ridge's width: the hand goes through, to and fro.
TEST(S03Ridge, HoldsOnItsSideWhereTheNearestSurfaceLetsTheHandThrough)
{
  const auto crossings = [](const Trace& trace)
  {
    int count = 0;
    for (std::size_t i = 1; i < trace.size(); ++i)
    {
      // Well below the edge, where both sides are the ridge's.
      count += trace[i].Hip[2] < -0.002 && trace[i].Held[0] * trace[i - 1].Held[0] < 0.0;
    }
    return count;
  };
  EXPECT_EQ(crossings(SceneOf("S3").Ours()), 0);
  EXPECT_GE(crossings(SceneOf("S3").Other()), 3);
}
