// Equation (4) of the paper: the nearest point on one, two and three planes.
#include "haptics/Contact/ConstraintSolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using haptics::Dot;
using haptics::Plane;
using haptics::PlaneProjection;

namespace
{
template <class Real>
bool ProjectOnto(const Plane<Real>* const planes[3], int count, const Real& parallel, Real y[3],
  Real multipliers[3])
{
  PlaneProjection<Real> projection;
  if (!projection.Prepare(planes, count, parallel))
  {
    return false;
  }
  projection.Project(y, multipliers);
  return true;
}

/// Counts multiplications and divisions, which is what the paper counts.
struct Counted
{
  double Value = 0.0;
  static int Multiplications;

  Counted() = default;
  Counted(double value)
    : Value(value)
  {
  }
  friend Counted operator*(Counted a, Counted b)
  {
    ++Multiplications;
    return a.Value * b.Value;
  }
  friend Counted operator/(Counted a, Counted b)
  {
    ++Multiplications;
    return a.Value / b.Value;
  }
  friend Counted operator+(Counted a, Counted b) { return a.Value + b.Value; }
  friend Counted operator-(Counted a, Counted b) { return a.Value - b.Value; }
  friend bool operator>(Counted a, Counted b) { return a.Value > b.Value; }
};
int Counted::Multiplications = 0;

int MultiplicationsFor(int planes)
{
  const Plane<Counted> a{ { 1.0, 0.0, 0.0 }, 1.0 };
  const Plane<Counted> b{ { 0.6, 0.8, 0.0 }, 2.0 };
  const Plane<Counted> c{ { 0.0, 0.6, 0.8 }, 3.0 };
  const Plane<Counted>* const chosen[3] = { &a, &b, &c };
  Counted y[3] = { 0.1, 0.2, 0.3 };
  Counted multipliers[3];
  Counted::Multiplications = 0;
  EXPECT_TRUE(ProjectOnto(chosen, planes, Counted(1e-24), y, multipliers));
  return Counted::Multiplications;
}

Plane<double> TiltedPlane(double degrees, double towards, double offset)
{
  const double tilt = degrees * M_PI / 180.0;
  return { { std::sin(tilt) * std::cos(towards), std::sin(tilt) * std::sin(towards),
             std::cos(tilt) },
    offset };
}
}

TEST(ConstraintSolver, TakesNoMoreMultiplicationsThanThePaperStates)
{
  EXPECT_LE(MultiplicationsFor(1), 12);
  EXPECT_LE(MultiplicationsFor(2), 33);
  EXPECT_LE(MultiplicationsFor(3), 65);
  EXPECT_GT(MultiplicationsFor(1), 0); // the count counts
}

TEST(ConstraintSolver, FindsTheFootPointOnOnePlane)
{
  const Plane<double> floor{ { 0, 0, 1 }, 2.0 };
  const Plane<double>* const chosen[3] = { &floor };
  double y[3] = { 3, 4, 5 };
  double multipliers[3];
  ASSERT_TRUE(ProjectOnto(chosen, 1, 1e-24, y, multipliers));
  EXPECT_DOUBLE_EQ(y[0], 3);
  EXPECT_DOUBLE_EQ(y[1], 4);
  EXPECT_DOUBLE_EQ(y[2], 2);
  EXPECT_DOUBLE_EQ(multipliers[0], -3); // it would have to pull
}

TEST(ConstraintSolver, SolvesTheLagrangeSystemForRandomPlanes)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 2000; ++trial)
  {
    Plane<double> planes[3];
    for (auto& plane : planes)
    {
      double squared = 0.0;
      for (double& x : plane.Normal)
      {
        x = normal(random);
        squared += x * x;
      }
      for (double& x : plane.Normal)
      {
        x /= std::sqrt(squared);
      }
      plane.Offset = normal(random);
    }
    const Plane<double>* const chosen[3] = { &planes[0], &planes[1], &planes[2] };
    for (int count = 1; count <= 3; ++count)
    {
      const double wish[3] = { normal(random), normal(random), normal(random) };
      double y[3] = { wish[0], wish[1], wish[2] };
      double multipliers[3];
      ASSERT_TRUE(ProjectOnto(chosen, count, 1e-24, y, multipliers));
      for (int i = 0; i < count; ++i)
      {
        // Random normals may come near to parallel: a millionth is still far from chance.
        EXPECT_NEAR(Dot(planes[i].Normal, y), planes[i].Offset, 1e-6);
      }
      for (int k = 0; k < 3; ++k)
      {
        double sum = wish[k];
        for (int i = 0; i < count; ++i)
        {
          sum += multipliers[i] * planes[i].Normal[k];
        }
        EXPECT_NEAR(y[k], sum, 1e-6); // the stationarity of the Lagrangian
      }
    }
  }
}

TEST(ConstraintSolver, KeepsThirteenDigitsOnPlanesAThousandthOfADegreeApart)
{
  // Three planes through the point (0, 0, 0.05 m), tilted by 0.001 degrees.
  const double height = 0.05;
  Plane<double> planes[3];
  for (int i = 0; i < 3; ++i)
  {
    planes[i] = TiltedPlane(0.001, 2.0 * M_PI * i / 3.0, 0.0);
    planes[i].Offset = planes[i].Normal[2] * height;
  }
  const Plane<double>* const chosen[3] = { &planes[0], &planes[1], &planes[2] };
  double y[3] = { 0, 0, 0.045 };
  double multipliers[3];
  ASSERT_TRUE(ProjectOnto(chosen, 3, 1e-24, y, multipliers));
  for (const auto& plane : planes)
  {
    EXPECT_NEAR(Dot(plane.Normal, y), plane.Offset, 1e-13);
  }
  EXPECT_NEAR(y[2], height, 1e-13);
}

TEST(ConstraintSolver, RefusesParallelPlanes)
{
  const Plane<double> a{ { 0, 0, 1 }, 0.0 };
  const Plane<double> b{ { 0, 0, 1 }, 1e-3 };
  const Plane<double>* const chosen[3] = { &a, &b };
  double y[3] = { 0, 0, -1 };
  double multipliers[3];
  EXPECT_FALSE(ProjectOnto(chosen, 2, 1e-24, y, multipliers));
}
