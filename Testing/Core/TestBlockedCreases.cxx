// Which motions along creases are known to be blocked.
#include "haptics/Contact/BlockedCreases.h"

#include <gtest/gtest.h>

using namespace haptics;

namespace
{
constexpr FacetId A{ 0, 3 }, B{ 0, 8 }, C{ 0, 9 };

ActivePlane PlaneOf(const FacetId& facet)
{
  ActivePlane plane;
  plane.Facet = facet;
  return plane;
}
}

TEST(BlockedCreases, AreThoseOfTheSameStepAlongTheSameTwoPlanes)
{
  const Vector step(1e-9, 2e-9, 0.0);
  BlockedCreases blocked;
  EXPECT_EQ(blocked.Find(A, B, step), nullptr);
  blocked.Add(A, B, step, PlaneOf(C));
  ASSERT_NE(blocked.Find(A, B, step), nullptr);
  EXPECT_TRUE(blocked.Find(A, B, step)->Facet == C);
  EXPECT_NE(blocked.Find(B, A, step * (1.0 + 1e-15)), nullptr); // in either order, but for rounding
  EXPECT_EQ(blocked.Find(A, B, -step), nullptr);
  EXPECT_EQ(blocked.Find(A, C, step), nullptr);
  EXPECT_EQ(blocked.Find(B, C, step), nullptr);
  // A facet that is a line to within rounding has no plane of its own.
  EXPECT_EQ(blocked.Find(A, B, step + Vector(0.0, 0.0, 1e-11)), nullptr);
  blocked.Add(A, B, -step, PlaneOf(A));
  EXPECT_TRUE(blocked.Find(A, B, step)->Facet == C);
  EXPECT_TRUE(blocked.Find(A, B, -step)->Facet == A);
}

TEST(BlockedCreases, AreForgottenElsewhere)
{
  const Vector place(1.0, 2.0, 3.0);
  const Vector step(0.0, 0.0, 1e-9);
  BlockedCreases blocked;
  blocked.StandAt(place, 1e-9, { A, B, C });
  blocked.Add(A, B, step, PlaneOf(C));
  blocked.StandAt(place + Vector(0.0, 0.9e-9, 0.0), 1e-9, { A, B, C });
  EXPECT_NE(blocked.Find(A, B, step), nullptr);
  // No nearer to where that was found by steps than at once.
  blocked.StandAt(place + Vector(0.0, 1.8e-9, 0.0), 1e-9, { A, B, C });
  EXPECT_EQ(blocked.Find(A, B, step), nullptr);
  blocked.Add(A, B, step, PlaneOf(C));
  blocked.StandAt(place + Vector(0.0, 1.8e-9, 0.0), 1e-9, { A, B, FacetId{ 0, 10 } });
  EXPECT_EQ(blocked.Find(A, B, step), nullptr);
}

TEST(BlockedCreases, OfMoreThanFitTheFirstAreKept)
{
  const Vector step(0.0, 0.0, 1e-9);
  BlockedCreases blocked;
  for (int i = 1; i < 100; ++i)
  {
    blocked.Add({ 0, 0 }, { 0, i }, step, PlaneOf(A));
  }
  EXPECT_NE(blocked.Find({ 0, 0 }, { 0, 1 }, step), nullptr);
  EXPECT_EQ(blocked.Find({ 0, 0 }, { 0, 99 }, step), nullptr);
}
