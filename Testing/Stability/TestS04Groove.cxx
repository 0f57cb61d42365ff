// S4: acute grooves are not crossed (Fig. 6), and planes nearly parallel have an answer.
#include "ExactQueries.h"
#include "ProfileSurfaces.h"
#include "SuiteTools.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr int Runs = 100;

/// Runs in which the point was pressed into the solid, of strokes down a wall and across at random
/// depths and speeds.
int Crossed(double degrees, const std::function<MethodPointer(const TriangleMesh&)>& make)
{
  const TriangleMesh mesh = GroovedBlock(degrees, 0.03);
  const auto surface = MakeSurface(mesh);
  const ExactQueries exact(surface);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int crossed = 0;
  for (int run = 0; run < Runs; ++run)
  {
    const MethodPointer method = make(mesh);
    const double side = run % 2 ? 1.0 : -1.0;
    const double press = 0.001 + 0.004 * share(random);
    const double speed = 1e-4 + 4e-4 * share(random); // 0.1 to 0.5 m/s
    const double across = 5e-5 * share(random);
    Vec3 hip{ 0, 1e-3 * share(random), 0.02 };
    method->Place(hip);
    hip[0] = side * (0.02 * std::tan(0.5 * degrees * M_PI / 180.0) + press);
    bool isCrossed = false;
    while (hip[2] > -0.005)
    {
      const Vec3 held = method->Update(hip);
      // Deeper than any method's clearance.
      const Vec3 local = held - surface->Origin();
      isCrossed |= held != hip && exact.IsInside(local) && exact.Distance(local) > 2e-7;
      hip[2] -= speed;
      hip[0] -= side * across;
    }
    crossed += isCrossed;
  }
  return crossed;
}
}

TEST(S04Groove, IsNeverCrossed)
{
  for (const double degrees : { 60.0, 30.0, 10.0, 1.0, 0.2 })
  {
    EXPECT_EQ(Crossed(degrees, Certified), 0) << degrees << " degrees";
  }
}

TEST(S04Groove, IsCrossedByThePaperWithoutIteration)
{
  for (const double degrees : { 60.0, 30.0, 10.0 })
  {
    const int literal =
      Crossed(degrees, [](const TriangleMesh& mesh) { return Paper(mesh, false); });
    const int iterated =
      Crossed(degrees, [](const TriangleMesh& mesh) { return Paper(mesh, true); });
    const int grown =
      Crossed(degrees, [](const TriangleMesh& mesh) { return Paper(mesh, true, 1e-6); });
    std::printf("groove of %g degrees: crossed in %d of %d strokes, iterated in %d, with grown "
                "edges in %d\n",
      degrees, literal, Runs, iterated, grown);
    EXPECT_GT(literal, Runs / 10) << degrees << " degrees";
  }
}

TEST(S04Groove, ThreePlanesAThousandthOfADegreeApartHaveAnAnswer)
{
  for (const double degrees : { 30.0, 10.0, 1.0, 0.1, 0.01, 0.001 })
  {
    GodObject god({ MakeSurface(ThreePlanes(degrees, 0.1)) });
    god.Update({ 1e-4, 2e-4, 0.01 });
    for (int tick = 0; tick < 500; ++tick)
    {
      const double a = 0.02 * tick;
      const Vec3 hip{ 2e-4 * std::cos(a), 2e-4 * std::sin(a), -0.005 };
      const Contact& contact = god.Update(hip);
      ASSERT_EQ(contact.Status, UpdateStatus::Touching) << degrees << " degrees";
      // The walls' rise keeps the nearest point within the sway of the hand.
      ASSERT_NEAR(contact.Penetration, 0.005, 5e-4) << degrees << " degrees, tick " << tick;
      int corners = 0;
      god.Way(corners);
      ASSERT_LE(corners - 1, 12) << degrees << " degrees, tick " << tick;
    }
  }
}

TEST(S04Groove, TheDrawnRunKeepsPressingWhereThePaperLetsGo)
{
  // The HIP ends 6 mm below the crease and 6 mm beyond it.
  EXPECT_NEAR(SceneOf("S4").Ours().back().Force[2], 500.0 * 0.006, 0.05);
  EXPECT_LT(Length(SceneOf("S4").Other().back().Force), 0.5);
}
