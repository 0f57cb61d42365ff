// The update against the oracle, in device scale: metres, 1 kHz.
#include "AnalyticSurfaces.h"
#include "HipPath.h"
#include "Oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace haptics;
using namespace haptics::testing;

namespace
{
struct Scene
{
  const char* Name;
  TriangleMesh Mesh;
  double Reach;
};

class AgainstOracle : public ::testing::TestWithParam<HipPath::Kind>
{
};
}

// E_p p99 <= 0.05 mm and max <= 0.1 mm, E_theta p99 <= 3 degrees.
TEST_P(AgainstOracle, StaysWithinATenthOfAMillimetreOnStrokes)
{
  const Scene scenes[] = {
    { "sphere", Icosphere(4, 0.03), 0.03 },
    { "box", Box(0.03, 0.03, 0.03, 8), 0.03 },
    { "torus", Torus(0.025, 0.008, 64, 32), 0.033 },
    { "inside of a sphere", InsideOut(Icosphere(4, 0.03)), 0.03 },
  };
  for (const Scene& scene : scenes)
  {
    const auto surface = MakeSurface(scene.Mesh);
    GodObject god({ surface });
    Oracle oracle(surface);
    HipPath path(GetParam(), scene.Reach, 11);
    Accuracy accuracy;
    SlipWatch watch;
    for (int tick = 0; tick < 4000; ++tick)
    {
      const Vec3 hip = path.Next();
      if (tick == 0)
      {
        god.Place(hip);
        oracle.Place(hip);
      }
      const Vec3 position = god.Update(hip).Position;
      const Vec3 right = oracle.Update(hip);
      const bool slips = watch.SlipsAt(hip, right);
      // A direction needs a force to have one: 0.1 N at 500 N/m.
      if (Length(right - hip) > 2e-4 && !slips)
      {
        accuracy.Add(hip, position, right);
      }
    }
    if (accuracy.Size() == 0)
    {
      continue;
    }
    std::printf(
      "%-20s %-12s contact ticks %5zu   E_p p50 %8.4f p99 %8.4f max %8.4f mm   E_theta p99 "
      "%6.3f max %6.3f deg   E_F p99 %.4f\n",
      scene.Name, HipPath::NameOf(GetParam()), accuracy.Size(), 1e3 * accuracy.PositionError(0.5),
      1e3 * accuracy.PositionError(0.99), 1e3 * accuracy.PositionError(1.0),
      accuracy.DirectionError(0.99), accuracy.DirectionError(1.0), accuracy.MagnitudeError(0.99));
    if (GetParam() == HipPath::Plunge)
    {
      // At 5 mm a tick and half a radius deep, several facets of a sphere of 1.2 mm facets each
      // have their foot point inside: the oracle stops at the first, the update may at the next.
      EXPECT_LE(accuracy.PositionError(0.99), 1.2e-3) << scene.Name;
    }
    else
    {
      EXPECT_LE(accuracy.PositionError(0.99), 0.05e-3) << scene.Name;
      EXPECT_LE(accuracy.PositionError(1.0), 0.1e-3) << scene.Name;
    }
    EXPECT_LE(accuracy.DirectionError(0.99), 3.0) << scene.Name;
    // A twentieth is the least that a hand can distinguish.
    EXPECT_LE(accuracy.MagnitudeError(0.99), 0.05) << scene.Name;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, AgainstOracle,
  ::testing::Values(HipPath::Smooth, HipPath::AlongLines, HipPath::Plunge),
  [](const auto& info) { return HipPath::IdentifierOf(info.param); });
