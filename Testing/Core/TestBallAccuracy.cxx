// A ball against its own oracle, which moves slowly: in device scale, metres, 1 kHz.
#include "AnalyticSurfaces.h"
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
  double Size;       ///< about how far out it is touched
  double Depth;      ///< of the HIP's way inside of that
  double Rise = 1.0; ///< of the way over z = 0
};

/// A curve around the origin that never closes, at 0.2 m/s.
Vec3 HipAt(const Scene& scene, double radius, int tick)
{
  const double s = 2e-4 / scene.Size * tick;
  const Vec3 outwards =
    Unit({ std::cos(s), std::sin(1.3 * s + 0.4), scene.Rise * std::sin(0.7 * s) });
  const double depth = scene.Depth * (0.55 - 0.45 * std::cos(0.02 * tick));
  return (scene.Size + radius - depth) * outwards;
}
}

// E_p p99 <= 0.05 mm, and max <= 0.1 mm, as of the point.
TEST(BallAgainstOracle, StaysWithinATenthOfAMillimetreOnStrokes)
{
  const Scene scenes[] = {
    { "sphere", Icosphere(4, 0.03), 0.03, 0.004 },
    { "inside of a sphere", InsideOut(Icosphere(4, 0.03)), 0.03, -0.004 },
    { "torus", Torus(0.025, 0.008, 128, 64), 0.033, 0.002, 0.1 },
    { "box", Box(0.02, 0.02, 0.02, 8), 0.024, 0.003 },
    { "star", Star(3, 0.03, 0.02, 4), 0.03, 0.002 },
  };
  for (const Scene& scene : scenes)
  {
    const auto surface = MakeSurface(scene.Mesh);
    for (const double radius : { 5e-4, 1e-3, 3e-3 })
    {
      const bool isInside = scene.Depth < 0.0;
      GodObject god({ surface }, Tip::Ball);
      god.SetTipRadius(radius);
      Oracle oracle(surface, radius);
      Accuracy accuracy;
      SlipWatch watch;
      for (int tick = 0; tick < 1500; ++tick)
      {
        const Vec3 hip = HipAt(scene, isInside ? -radius : radius, tick);
        if (tick == 0)
        {
          const Vec3 start = (isInside ? 0.5 : 1.6) * hip;
          god.Place(start);
          god.Update(start);
          oracle.Place(start);
        }
        const Vec3 position = god.Update(hip).Position;
        const Vec3 right = oracle.Update(hip);
        const bool slips = watch.SlipsAt(hip, right);
        if (Length(right - hip) > 2e-4 && !slips)
        {
          accuracy.Add(hip, position, right);
        }
      }
      ASSERT_GT(accuracy.Size(), 300u) << scene.Name;
      std::printf("%-20s tip %.1f mm: contact ticks %5zu   E_p p50 %8.4f p99 %8.4f max %8.4f mm   "
                  "E_theta p99 %6.3f max %6.3f deg\n",
        scene.Name, 1e3 * radius, accuracy.Size(), 1e3 * accuracy.PositionError(0.5),
        1e3 * accuracy.PositionError(0.99), 1e3 * accuracy.PositionError(1.0),
        accuracy.DirectionError(0.99), accuracy.DirectionError(1.0));
      EXPECT_LE(accuracy.PositionError(0.99), 5e-5) << scene.Name << ", tip " << radius;
      EXPECT_LE(accuracy.PositionError(1.0), 1e-4) << scene.Name << ", tip " << radius;
    }
  }
}
