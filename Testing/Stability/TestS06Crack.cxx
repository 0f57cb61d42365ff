// S6: a gap between facets is closed if, and only if, CrackWidth says so: four clearances reach
// across it.
#include "CertifiedMethod.h"
#include "ProfileSurfaces.h"
#include "SuiteTools.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// Ticks of sweeps exactly along the cracks in which the point has fallen in.
int LeaksOf(const Trace& trace)
{
  return static_cast<int>(std::count_if(trace.begin(), trace.end(),
    [](const LoopTick& tick) { return tick.Hip[2] < 0.03 && tick.Held[2] < 0.03 - 1e-4; }));
}

int Leaks(double crack, double crackWidth)
{
  SurfaceOptions options;
  options.TouchedSide = Side::Front;
  options.CrackWidth = crackWidth;
  std::string error;
  const auto surface =
    TriangleSurface::Build(Cracked(Box(0.03, 0.03, 0.03, 8), crack), options, error);
  EXPECT_TRUE(surface) << error;
  const MethodPointer method = MakeCertified({ surface });
  return LeaksOf(AlongCracks(*method, 4000));
}
}

TEST(S06Crack, IsClosedIfItsWidthIsKnown)
{
  for (const double crack : { 1e-6, 1e-5, 1e-4 })
  {
    EXPECT_EQ(Leaks(crack, crack), 0) << crack << " m";
    EXPECT_GT(Leaks(crack, 0.2 * crack), 0) << crack << " m: the sweep does not meet the cracks";
  }
}

TEST(S06Crack, LetsThePaperThroughThoughIterated)
{
  EXPECT_EQ(LeaksOf(SceneOf("S6").Ours()), 0);
  EXPECT_GT(LeaksOf(SceneOf("S6").Other()), 100);
}
