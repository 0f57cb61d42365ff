// Surfaces and HIPs that nobody should send: a right answer or none, never a leap or a NaN.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Tick/SurfaceForce.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace haptics;
using namespace haptics::testing;

namespace
{
TriangleMesh OneTriangle(double size)
{
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, 0 }, { size, 0, 0 }, { 0, size, 0 } };
  mesh.Triangles = { { 0, 1, 2 } };
  return mesh;
}
}

TEST(BadSurfaces, ASingleTriangleIsTouchedFromBothSides)
{
  for (const double size : { 1e-6, 1.0, 1e6 })
  {
    for (const double from : { 1.0, -1.0 })
    {
      GodObject god({ MakeSurface(OneTriangle(size), Side::Automatic) });
      god.Update({ 0.2 * size, 0.3 * size, from * size });
      const Contact& contact = god.Update({ 0.2 * size, 0.3 * size, -0.1 * from * size });
      ASSERT_EQ(contact.Status, UpdateStatus::Touching);
      EXPECT_NEAR(contact.Penetration, 0.1 * size, 1e-9 * size);
      EXPECT_NEAR(contact.Displacement[2], 0.1 * from * size, 1e-9 * size);
    }
  }
}

TEST(BadSurfaces, TrianglesWithoutAreaAmongGoodOnesChangeNothing)
{
  TriangleMesh mesh = Square(0.1, 2);
  TriangleMesh withFlat = mesh;
  for (std::int32_t i = 0; i < 9; ++i)
  {
    withFlat.Triangles.push_back({ i, i, (i + 1) % 9 });
    withFlat.Triangles.push_back({ i, i, i });
  }
  withFlat.Triangles.push_back({ 0, 1, 2 }); // in one line
  GodObject clean({ MakeSurface(mesh, Side::Front) });
  GodObject flat({ MakeSurface(withFlat, Side::Front) });
  for (int tick = 0; tick < 500; ++tick)
  {
    const double a = 0.02 * tick;
    const Vec3 hip{ 0.08 * std::sin(a), 0.08 * std::cos(1.7 * a), 0.01 * std::cos(3.0 * a) };
    ASSERT_EQ(clean.Update(hip).Displacement, flat.Update(hip).Displacement) << "tick " << tick;
  }
}

// Coordinates of 1e8 are known to 1.5e-8: details of 1e-3 are there, and hold to that.
TEST(BadSurfaces, DetailsOfAMillimetreHoldAtCoordinatesOfAHundredMillion)
{
  const Vec3 far{ 1e8, -1e8, 1e8 };
  const auto surface = MakeSurface(Moved(Star(3, 1e-3, 0.3, 5), far), Side::Front);
  const ExactQueries exact(surface);
  GodObject god({ surface });
  god.Update(far + Vec3{ 0, 0, 5e-3 });
  int touching = 0;
  for (int tick = 0; tick < 2000; ++tick)
  {
    const double a = 0.01 * tick;
    const Vec3 hip = far + 5e-4 * Unit({ std::cos(a), std::sin(1.3 * a), std::sin(0.7 * a) });
    const Contact& contact = god.Update(hip);
    touching += contact.Status == UpdateStatus::Touching;
    ASSERT_LT(contact.Penetration, 2e-3);
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    for (int i = 0; i + 1 < corners; ++i)
    {
      ASSERT_FALSE(exact.Crosses(way[i], way[i + 1])) << "tick " << tick;
    }
  }
  EXPECT_EQ(touching, 2000);
}

TEST(BadSurfaces, AHipThatIsNoPlaceAmongGoodOnesLeavesNoTrace)
{
  const auto surface = MakeSurface(Icosphere(3, 0.05), Side::Front);
  GodObject steady({ surface });
  GodObject disturbed({ surface });
  const double bad[] = { std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::max() };
  for (int tick = 0; tick < 600; ++tick)
  {
    const double a = 0.01 * tick;
    const Vec3 hip = 0.045 * Unit({ std::cos(a), std::sin(a), 0.3 });
    if (tick == 0)
    {
      steady.Update(2.0 * hip);
      disturbed.Update(2.0 * hip);
    }
    if (tick % 7 == 3)
    {
      Vec3 wrong = hip;
      wrong[tick % 3] = bad[tick % 2 + tick % 3 / 2];
      const Contact& contact = disturbed.Update(wrong);
      ASSERT_EQ(contact.Status, UpdateStatus::InvalidHip);
      ASSERT_EQ(SurfaceForce().Update(contact, 0.001, 500.0, {}), (Vec3{ 0, 0, 0 }));
    }
    ASSERT_EQ(disturbed.Update(hip).Displacement, steady.Update(hip).Displacement)
      << "tick " << tick;
  }
}

TEST(BadSurfaces, AHipThatJumpsAcrossTheWorldGetsAFiniteForceAndCrossesNothing)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    const auto surface = MakeSurface(Star(3, 0.05, 0.4, 9), side);
    const ExactQueries exact(surface);
    GodObject god({ surface });
    const double distances[] = { 0.2, 1e3, 1e-3, 1e12, 0.04, 1e60 };
    for (int tick = 0; tick < 3000; ++tick)
    {
      const double a = 1.7 * tick;
      const double distance = distances[tick % 6];
      const Contact& contact =
        god.Update(distance * Unit({ std::cos(a), std::sin(a), std::sin(2.3 * a) }));
      MaterialLimits limits;
      limits.MaximumForce = 3.3;
      const Vec3 force = SurfaceForce().Update(contact, 0.001, 500.0, limits);
      ASSERT_LE(Length(force), limits.MaximumForce * (1.0 + 1e-12)) << "tick " << tick;
      int corners = 0;
      const Vec3* const way = god.Way(corners);
      for (int i = 0; i + 1 < corners; ++i)
      {
        ASSERT_FALSE(exact.Crosses(way[i], way[i + 1])) << "tick " << tick;
      }
    }
  }
}
