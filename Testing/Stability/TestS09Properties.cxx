// S9 and S10 as they are drawn; what properties may and may not do is in
// Testing/Core/TestSurfaceEnergy.cxx, S11 too.
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

namespace
{
/// What the hand has got out of the force over the run, the force changing evenly over a tick [J].
double EnergyOut(const Trace& trace)
{
  double energy = 0.0;
  for (std::size_t i = 1; i < trace.size(); ++i)
  {
    energy += 0.5 * Dot(trace[i].Force + trace[i - 1].Force, trace[i].Hip - trace[i - 1].Hip);
  }
  return energy;
}
}

TEST(S09Stiffness, MakesNoEnergyWhereAPlainSpringMakesSevenMillijoules)
{
  EXPECT_LE(EnergyOut(SceneOf("S9").Ours()), 1e-9);
  EXPECT_NEAR(EnergyOut(SceneOf("S9").Other()), 7.5e-3, 0.2e-3);
}

TEST(S10Friction, TakesEnergyInEveryRub)
{
  const double push = 500.0 * 0.004;
  EXPECT_LT(EnergyOut(SceneOf("S10").Ours()), -0.3 * push * 0.02);
  EXPECT_NEAR(EnergyOut(SceneOf("S10").Other()), -0.5 * push * 0.004, 0.1 * push * 0.004);
}
