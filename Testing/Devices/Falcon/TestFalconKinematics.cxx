#include "haptics/Devices/Falcon/FalconKinematics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace
{
using namespace haptics::FalconKinematics;

// The usable cube with its faces, edges and corners, and the axis out to where homing ends.
std::vector<Vector> Workspace()
{
  constexpr int n = 12;
  std::vector<Vector> points;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int k = 0; k <= n; ++k)
      {
        points.push_back({ -0.03 + 0.06 * i / n, -0.03 + 0.06 * j / n, 0.095 + 0.06 * k / n });
      }
    }
  }
  for (double z = 0.155; z < 0.1721; z += 0.001)
  {
    points.push_back({ 0.0, 0.0, z });
  }
  return points;
}

double Distance(const Vector& a, const Vector& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

auto At(const Vector& p)
{
  return testing::PrintToString(p);
}

TEST(FalconKinematics, ReturnsFromEveryPlaceToItself)
{
  for (const Vector& p : Workspace())
  {
    Vector angles{};
    Vector back{};
    ASSERT_TRUE(Inverse(p, angles)) << At(p);
    ASSERT_TRUE(Forward(angles, back)) << At(p);
    ASSERT_LT(Distance(p, back), 1e-10) << At(p);
  }
}

// Stamper's equations as he wrote them, with the angles of the parallelogram.
TEST(FalconKinematics, FitsStampersEquations)
{
  const double degree = std::acos(-1.0) / 180.0;
  const double leg[3] = { 105.0 * degree, -15.0 * degree, -135.0 * degree };
  for (const Vector& p : Workspace())
  {
    Vector angles{};
    ASSERT_TRUE(Inverse(p, angles)) << At(p);
    for (int i = 0; i < 3; ++i)
    {
      const double u = std::cos(leg[i]) * p[0] + std::sin(leg[i]) * p[1] - 0.040;
      const double v = -std::sin(leg[i]) * p[0] + std::cos(leg[i]) * p[1] + 0.02309;
      const double theta3 = std::acos((v - 0.025) / 0.1025);
      const double second = 0.0225 + 0.1025 * std::sin(theta3);
      const double theta2 =
        std::atan2(p[2] - 0.060 * std::sin(angles[i]), u + 0.01443 - 0.060 * std::cos(angles[i]));
      EXPECT_NEAR(0.060 * std::cos(angles[i]) - 0.01443 + second * std::cos(theta2), u, 1e-13);
      EXPECT_NEAR(0.060 * std::sin(angles[i]) + second * std::sin(theta2), p[2], 1e-13);
    }
  }
}

TEST(FalconKinematics, HasAJacobianThatIsTheSlopeOfForward)
{
  constexpr double step = 1e-5; // [rad]: the error of a central difference is its square, 1e-10
  for (const Vector& p : Workspace())
  {
    Vector angles{};
    Matrix jacobian{};
    ASSERT_TRUE(Inverse(p, angles)) << At(p);
    ASSERT_TRUE(Jacobian(p, angles, jacobian)) << At(p);
    for (int column = 0; column < 3; ++column)
    {
      Vector above = angles;
      Vector below = angles;
      above[column] += step;
      below[column] -= step;
      Vector to{};
      Vector from{};
      ASSERT_TRUE(Forward(above, to)) << At(p);
      ASSERT_TRUE(Forward(below, from)) << At(p);
      for (int row = 0; row < 3; ++row)
      {
        ASSERT_NEAR(jacobian[row][column], (to[row] - from[row]) / (2.0 * step), 1e-6)
          << At(p) << " row " << row << " column " << column;
      }
    }
  }
}

// Circulating drivers put sin^2 theta2 there, which makes z forces 9 to 37 % too strong.
TEST(FalconKinematics, SpendsAtTheMotorsThePowerThatTheHandGets)
{
  const std::vector<Vector> forces{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 3, -5, 7 } };
  const std::vector<Vector> rates{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -2, 1, 4 } };
  for (const Vector& p : Workspace())
  {
    Vector angles{};
    Matrix jacobian{};
    ASSERT_TRUE(Inverse(p, angles)) << At(p);
    ASSERT_TRUE(Jacobian(p, angles, jacobian)) << At(p);
    for (const Vector& force : forces)
    {
      for (const Vector& rate : rates)
      {
        const Vector velocity{ Dot(jacobian[0], rate), Dot(jacobian[1], rate),
          Dot(jacobian[2], rate) };
        ASSERT_NEAR(Dot(force, velocity), Dot(Torques(jacobian, force), rate), 1e-9) << At(p);
      }
    }
  }
}

TEST(FalconKinematics, FollowsAStepWithinOneTick)
{
  Vector far{};
  Vector near{};
  ASSERT_TRUE(Inverse({ 0.03, -0.03, 0.095 }, far));
  ASSERT_TRUE(Inverse({ -0.03, 0.03, 0.155 }, near));
  Vector p{};
  ASSERT_TRUE(Forward(far, p));
  ASSERT_TRUE(Forward(near, p));
  EXPECT_LT(Distance(p, { -0.03, 0.03, 0.155 }), 1e-10);
}

TEST(FalconKinematics, KeepsEveryCountAndTurns35DegreesAtZero)
{
  for (int count = -32768; count <= 32767; ++count)
  {
    const auto c = static_cast<std::int16_t>(count);
    ASSERT_EQ(CountOfAngle(AngleOfCount(c)), c);
  }
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_NEAR(AngleOfCount(0), 35.0 * degree, 1e-15);
  EXPECT_NEAR(AngleOfCount(1000) - AngleOfCount(0), 36.4347 * degree, 1e-6);
  EXPECT_EQ(CountOfAngle(1e6), 32767) << "clamped, not wrapped";
  EXPECT_EQ(CountOfAngle(-1e6), -32768);
}

TEST(FalconKinematics, ResolvesTheEncodersToTensOfMicrometres)
{
  for (const Vector& p : Workspace())
  {
    Vector angles{};
    Matrix jacobian{};
    ASSERT_TRUE(Inverse(p, angles));
    ASSERT_TRUE(Jacobian(p, angles, jacobian));
    const double count = AngleOfCount(1) - AngleOfCount(0);
    for (int leg = 0; leg < 3; ++leg)
    {
      const double tip = count * std::hypot(jacobian[0][leg], jacobian[1][leg], jacobian[2][leg]);
      EXPECT_GT(tip, 15e-6) << At(p);
      EXPECT_LT(tip, 80e-6) << At(p);
    }
  }
}

TEST(FalconKinematics, RefusesWhatIsOutOfReach)
{
  Vector angles{ 1, 2, 3 };
  EXPECT_FALSE(Inverse({ 0.0, 0.0, 0.3 }, angles));
  EXPECT_FALSE(Inverse({ 0.5, 0.0, 0.1 }, angles));
  EXPECT_EQ(angles, (Vector{ 1, 2, 3 }));
  Vector p{ 1, 2, 3 };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Forward({ nan, 0.6, 0.6 }, p));
  EXPECT_FALSE(Forward({ 3.1, 0.0, 0.0 }, p)) << "cranks so far apart pull the rods off";
  EXPECT_EQ(p, (Vector{ 1, 2, 3 }));
}

// Whatever the encoders say, the answer is a pose that fits or a refusal.
TEST(FalconKinematics, AnswersAnyCountsWithAPoseThatFitsOrARefusal)
{
  int refused = 0;
  for (int i = -32768; i <= 32767; i += 2521)
  {
    for (int j = -32768; j <= 32767; j += 2521)
    {
      for (int k = -32768; k <= 32767; k += 2521)
      {
        const Vector angles{ AngleOfCount(static_cast<std::int16_t>(i)),
          AngleOfCount(static_cast<std::int16_t>(j)), AngleOfCount(static_cast<std::int16_t>(k)) };
        Vector p{};
        if (!Forward(angles, p))
        {
          ++refused;
          continue;
        }
        ASSERT_LT(Distance(p, {}), 0.35) << "a leg is not longer";
      }
    }
  }
  EXPECT_GT(refused, 0);
}
}
