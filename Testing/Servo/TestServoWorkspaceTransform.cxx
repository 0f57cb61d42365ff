#include "haptics/Math/WorkspaceTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using haptics::Vec3;
using haptics::WorkspaceTransform;

namespace
{
void ExpectNear(const Vec3& a, const Vec3& b, double tolerance)
{
  EXPECT_LT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), tolerance)
    << "(" << a[0] << ", " << a[1] << ", " << a[2] << ")";
}

// A quarter turn about z, metres to millimetres, moved to (10, 20, 30) mm.
const double Turned[16] = { 0, -1000, 0, 10, 1000, 0, 0, 20, 0, 0, 1000, 30, 0, 0, 0, 1 };

TEST(WorkspaceTransform, IsTheIdentityByDefault)
{
  const WorkspaceTransform transform;
  EXPECT_EQ(transform.PointToWorld({ 1, 2, 3 }), (Vec3{ 1, 2, 3 }));
  EXPECT_EQ(transform.VectorToDevice({ 1, 2, 3 }), (Vec3{ 1, 2, 3 }));
}

TEST(WorkspaceTransform, TakesPointsToTheWorldVectorsBackAndKeepsTheLengthOfForces)
{
  WorkspaceTransform transform;
  std::string error;
  ASSERT_TRUE(transform.SetMatrix(Turned, error)) << error;
  ExpectNear(transform.PointToWorld({ 0.001, 0, 0.002 }), { 10, 21, 32 }, 1e-12);
  ExpectNear(transform.VectorToDevice({ 0, 1, 2 }), { 0.001, 0, 0.002 }, 1e-15);
  ExpectNear(transform.DirectionToWorld({ 3, 0, 0 }), { 0, 3, 0 }, 1e-15);
}

TEST(WorkspaceTransform, GivesItsMatrixBack)
{
  WorkspaceTransform transform;
  std::string error;
  ASSERT_TRUE(transform.SetMatrix(Turned, error)) << error;
  double matrix[16];
  transform.GetMatrix(matrix);
  for (int i = 0; i < 16; ++i)
  {
    EXPECT_NEAR(matrix[i], Turned[i], 1e-12) << "element " << i;
  }
}

TEST(WorkspaceTransform, TakesVerySmallAndVeryLargeScales)
{
  for (const double scale : { 1e-9, 1e-3, 1.0, 3e4, 1e12 })
  {
    const double matrix[16] = { scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, scale, 0, 0, 0, 0, 1 };
    WorkspaceTransform transform;
    std::string error;
    ASSERT_TRUE(transform.SetMatrix(matrix, error)) << error;
    EXPECT_NEAR(transform.Scale / scale, 1.0, 1e-14);
  }
}

TEST(WorkspaceTransform, RefusesWhatIsNoSimilarityAndStaysAsItWas)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double bad[][16] = {
    { nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },
    { 1, 0, 0, nan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },
    { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 },   // singular
    { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },  // a mirror
    { 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },   // not uniform
    { 1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, // a shear
    { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.1, 1 }, // a perspective
  };
  for (const auto& matrix : bad)
  {
    WorkspaceTransform transform;
    std::string error;
    ASSERT_TRUE(transform.SetMatrix(Turned, error));
    EXPECT_FALSE(transform.SetMatrix(matrix, error));
    EXPECT_FALSE(error.empty());
    ExpectNear(transform.PointToWorld({ 0.001, 0, 0.002 }), { 10, 21, 32 }, 1e-12);
  }
}
}
