// The suite's scenes touched with a ball: the limits of a point, and of places a radius farther
// out.
#include "CertifiedMethod.h"
#include "ProfileSurfaces.h"
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Rounding = 1e-9;
}

TEST(S01WithTip, ShakesFromTwiceTheDampingOverThePeriodOn)
{
  for (const double damping : { 0.05, 0.35, 1.0 })
  {
    EXPECT_NEAR(MeasuredBoundary(OnPlane(damping, 1e-3, TipRadius)), 1.0, 0.05)
      << damping << " N s/m";
  }
  EXPECT_NEAR(MeasuredBoundary(OnPlane(0.35, 5e-3, TipRadius)), 1.0, 0.05);
  EXPECT_LT(Swing(SceneOf("S1").Ball(), 50), 2e-4);
}

TEST(S02WithTip, IsAsStableInAValleyAsOnAPlane)
{
  for (const double degrees : { 10.0, 60.0, 120.0 })
  {
    const double half = 0.5 * degrees * M_PI / 180.0;
    PressedScene scene = OnPlane(0.35, 1e-3, TipRadius);
    scene.Make = [=] { return CertifiedValley(degrees, TipRadius); };
    scene.Start = { 1e-5, 0.001, TipRadius / std::cos(half) + 2e-4 };
    scene.Nudge = { 0.6, 0, -0.8 };
    EXPECT_NEAR(MeasuredBoundary(scene), 1.0, 0.05) << degrees << " degrees between the normals";
  }
}

// The ball goes round the edge where the point stays on its side: no flips, and no energy.
TEST(S03WithTip, DoesNotFlipByItselfNorGiveEnergy)
{
  const Trace trace = SceneOf("S3").Ball();
  const LoopTick& end = trace.back();
  const double d = Length(end.Held - end.Hip);
  EXPECT_LE(end.Work + 0.5 * 1500.0 * d * d - end.Lost, 0.0);
  for (std::size_t i = trace.size() - 500; i < trace.size(); ++i)
  {
    const Vec3& before = trace[i - 1].Force;
    const Vec3& now = trace[i].Force;
    ASSERT_GE(Dot(before, now), std::cos(M_PI / 6.0) * Length(before) * Length(now));
  }
}

// It lies in the groove where both walls are a radius away.
TEST(S04WithTip, TouchesBothWallsOfAGroove)
{
  for (const double degrees : { 60.0, 30.0, 10.0 })
  {
    const MethodPointer method = CertifiedBall(GroovedBlock(degrees, 0.03));
    const double crease = TipRadius / std::sin(0.5 * degrees * M_PI / 180.0);
    for (const LoopTick& tick : DownGroove(*method, degrees))
    {
      ASSERT_GE(tick.Held[2], crease - Rounding) << degrees << " degrees";
    }
  }
}

TEST(S05WithTip, IsNotPushedThroughAPlate)
{
  for (const double thickness : { 1e-7, 1e-4, 4e-3 })
  {
    const MethodPointer method = CertifiedBall(Box(0.05, 0.05, 0.5 * thickness, 4));
    const Trace trace = ThroughPlate(*method, thickness);
    for (const LoopTick& tick : trace)
    {
      ASSERT_GE(tick.Held[2], 0.5 * thickness + TipRadius - Rounding) << thickness << " m";
    }
    EXPECT_NEAR(trace.back().Force[2], 5.0, 0.1) << thickness << " m";
  }
}

// Cracks that are narrower than the ball are closed without being asked to.
TEST(S06WithTip, ComesIntoNoCrack)
{
  for (const double crack : { 1e-6, 1e-5, 1e-4 })
  {
    const MethodPointer method = CertifiedBall(Cracked(Box(0.03, 0.03, 0.03, 8), crack));
    for (const LoopTick& tick : AlongCracks(*method, 4000))
    {
      // Over a crack it hangs by r - sqrt(r^2 - w^2 / 4) at the most: half a crack aside, twice.
      ASSERT_GE(tick.Held[2], std::min(tick.Hip[2], 0.03 + TipRadius - crack * crack / TipRadius))
        << crack << " m";
    }
  }
}

// In the valley that is a radius inside of the walls.
TEST(S07WithTip, LeavesAnObtuseCreaseWithinAMicrometre)
{
  const double phi = 15.0 * M_PI / 180.0;
  const double lift = TipRadius / std::cos(phi);
  for (const LoopTick& tick : SceneOf("S7").Ball())
  {
    const double depth = tick.Hip[2] - lift;
    const double aside = std::abs(tick.Hip[0]);
    if (depth < aside * std::tan(phi))
    {
      const double along = std::max(0.0, aside * std::cos(phi) + depth * std::sin(phi));
      const Vec3 nearest{ std::copysign(along * std::cos(phi), tick.Hip[0]), tick.Hip[1],
        along * std::sin(phi) + lift };
      ASSERT_LT(Length(tick.Held - nearest), 1e-6) << tick.Time << " s";
    }
  }
}

TEST(S08WithTip, IsPushedWithoutSteps)
{
  EXPECT_LE(LargestStep(SceneOf("S8").Ball()), 0.05);
}

TEST(S09WithTip, MakesNoEnergy)
{
  for (const char* const name : { "S9", "S10" })
  {
    const Trace trace = SceneOf(name).Ball();
    double energy = 0.0;
    for (std::size_t i = 1; i < trace.size(); ++i)
    {
      energy += 0.5 * Dot(trace[i].Force + trace[i - 1].Force, trace[i].Hip - trace[i - 1].Hip);
    }
    EXPECT_LE(energy, 1e-9) << name;
  }
}

TEST(S12WithTip, ShakesBehindADelayAsThePointDoes)
{
  PressedScene scene = OnPlane(0.35, 1e-3, TipRadius);
  scene.Share = 0.1;
  scene.Delay = 5e-3;
  EXPECT_NEAR(MeasuredBoundary(scene), 1.0, 0.10);
  EXPECT_LT(Swing(SceneOf("S12").Ball(), 100), 2e-3);
}

TEST(S13WithTip, StaysOnTheFirstOfNestedSheets)
{
  for (const LoopTick& tick : SceneOf("S13").Ball())
  {
    if (tick.Hip[2] < 0.0)
    {
      const Vec3 foot{ tick.Hip[0], tick.Hip[1], TipRadius };
      ASSERT_LT(Length(tick.Held - foot), Rounding) << tick.Time << " s";
    }
  }
}
