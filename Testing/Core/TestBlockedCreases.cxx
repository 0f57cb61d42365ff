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

TEST(BlockedCreases, ACreaseIsTheSameInEitherOrder)
{
  // The cross product of the normals turns round with their order.
  EXPECT_EQ(BlockedCreases::KeyOf(A, B, true), BlockedCreases::KeyOf(B, A, false));
  EXPECT_EQ(BlockedCreases::KeyOf(A, B, false), BlockedCreases::KeyOf(B, A, true));
  EXPECT_NE(BlockedCreases::KeyOf(A, B, true), BlockedCreases::KeyOf(A, B, false));
  EXPECT_NE(BlockedCreases::KeyOf(A, B, true), BlockedCreases::KeyOf(A, C, true));
  EXPECT_NE(BlockedCreases::KeyOf(A, C, true), BlockedCreases::KeyOf(B, C, true));
}

TEST(BlockedCreases, AreForgottenElsewhere)
{
  const Vector place(1.0, 2.0, 3.0);
  const auto forward = BlockedCreases::KeyOf(A, B, true);
  BlockedCreases blocked;
  blocked.StandAt(place, 1e-9, { A, B, C });
  EXPECT_EQ(blocked.Find(forward), nullptr);
  blocked.Add(forward, PlaneOf(C));
  ASSERT_NE(blocked.Find(forward), nullptr);
  EXPECT_TRUE(blocked.Find(forward)->Facet == C);
  EXPECT_EQ(blocked.Find(BlockedCreases::KeyOf(A, B, false)), nullptr);
  blocked.StandAt(place + Vector(0.0, 0.9e-9, 0.0), 1e-9, { A, B, C });
  EXPECT_NE(blocked.Find(forward), nullptr);
  // No nearer to where that was found by steps than at once.
  blocked.StandAt(place + Vector(0.0, 1.8e-9, 0.0), 1e-9, { A, B, C });
  EXPECT_EQ(blocked.Find(forward), nullptr);
  blocked.Add(forward, PlaneOf(C));
  blocked.StandAt(place + Vector(0.0, 1.8e-9, 0.0), 1e-9, { A, B, FacetId{ 0, 10 } });
  EXPECT_EQ(blocked.Find(forward), nullptr);
}

TEST(BlockedCreases, OfMoreThanFitTheFirstAreKept)
{
  BlockedCreases blocked;
  for (int i = 1; i < 100; ++i)
  {
    blocked.Add(BlockedCreases::KeyOf({ 0, 0 }, { 0, i }, true), PlaneOf(A));
  }
  EXPECT_NE(blocked.Find(BlockedCreases::KeyOf({ 0, 0 }, { 0, 1 }, true)), nullptr);
  EXPECT_EQ(blocked.Find(BlockedCreases::KeyOf({ 0, 0 }, { 0, 99 }, true)), nullptr);
}
