#include "ExactSigns.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace haptics::testing
{
namespace
{
using Rational = boost::multiprecision::cpp_rational;

/// A sum of float64 numbers that do not overlap, the smallest first: its sign is the last one's.
/// This file is compiled without fused multiply-add, on which the error terms rely.
template <int Capacity>
struct Expansion
{
  std::array<double, Capacity> Part;
  int Size = 0;

  void Push(double x)
  {
    if (x != 0.0)
    {
      this->Part[this->Size++] = x;
    }
  }
  int Sign() const { return this->Size == 0 ? 0 : (this->Part[this->Size - 1] > 0.0 ? 1 : -1); }
};

/// sum + error is x + y exactly.
void TwoSum(double x, double y, double& sum, double& error)
{
  sum = x + y;
  const double other = sum - x;
  error = (x - (sum - other)) + (y - other);
}

void Split(double x, double& high, double& low)
{
  const double big = 134217729.0 * x; // 2^27 + 1
  high = big - (big - x);
  low = x - high;
}

/// product + error is x * y exactly.
void TwoProduct(double x, double y, double& product, double& error)
{
  product = x * y;
  double xHigh, xLow, yHigh, yLow;
  Split(x, xHigh, xLow);
  Split(y, yHigh, yLow);
  error = xLow * yLow - (((product - xHigh * yHigh) - xLow * yHigh) - xHigh * yLow);
}

Expansion<2> Difference(double x, double y)
{
  double sum, error;
  TwoSum(x, -y, sum, error);
  Expansion<2> difference;
  difference.Push(error);
  difference.Push(sum);
  return difference;
}

/// Adds a number to an expansion that has room for one more (Grow-Expansion).
template <int N>
void Add(Expansion<N>& e, double x)
{
  Expansion<N> grown;
  double carry = x;
  for (int i = 0; i < e.Size; ++i)
  {
    double sum, error;
    TwoSum(carry, e.Part[i], sum, error);
    grown.Push(error);
    carry = sum;
  }
  grown.Push(carry);
  e = grown;
}

/// sign * a * b is added to `sum`.
template <int N, int A, int B>
void AddProduct(Expansion<N>& sum, const Expansion<A>& a, const Expansion<B>& b, double sign)
{
  for (int i = 0; i < a.Size; ++i)
  {
    for (int j = 0; j < b.Size; ++j)
    {
      double product, error;
      TwoProduct(sign * a.Part[i], b.Part[j], product, error);
      Add(sum, error);
      Add(sum, product);
    }
  }
}

int SignByExpansions(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  std::array<std::array<Expansion<2>, 3>, 3> m;
  const Vec3* const rows[3] = { &b, &c, &d };
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      m[i][k] = Difference((*rows[i])[k], a[k]);
    }
  }
  Expansion<192> determinant;
  for (int k = 0; k < 3; ++k)
  {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    Expansion<16> minor;
    AddProduct(minor, m[0][u], m[1][v], 1.0);
    AddProduct(minor, m[0][v], m[1][u], -1.0);
    AddProduct(determinant, minor, m[2][k], 1.0);
  }
  return determinant.Sign();
}
}

int SignOfVolumeByRationals(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  std::array<std::array<Rational, 3>, 3> m;
  const Vec3* const rows[3] = { &b, &c, &d };
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      m[i][k] = Rational((*rows[i])[k]) - Rational(a[k]);
    }
  }
  Rational determinant = 0;
  for (int k = 0; k < 3; ++k)
  {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    determinant += (m[0][u] * m[1][v] - m[0][v] * m[1][u]) * m[2][k];
  }
  return determinant.sign();
}

int SignOfVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double bx = b[0] - a[0], by = b[1] - a[1], bz = b[2] - a[2];
  const double cx = c[0] - a[0], cy = c[1] - a[1], cz = c[2] - a[2];
  const double dx = d[0] - a[0], dy = d[1] - a[1], dz = d[2] - a[2];
  const double byCz = by * cz, bzCy = bz * cy;
  const double bzCx = bz * cx, bxCz = bx * cz;
  const double bxCy = bx * cy, byCx = by * cx;
  const double determinant = (byCz - bzCy) * dx + (bzCx - bxCz) * dy + (bxCy - byCx) * dz;
  const double permanent = (std::abs(byCz) + std::abs(bzCy)) * std::abs(dx) +
    (std::abs(bzCx) + std::abs(bxCz)) * std::abs(dy) +
    (std::abs(bxCy) + std::abs(byCx)) * std::abs(dz);
  // Shewchuk's bound A is (7 + 56 u) u times the permanent; the constant is for what underflows,
  // which is under 1e-230 where d is not that far off.
  const double bound = 8.0 * 0x1p-53 * permanent + 1e-220;
  constexpr double large = 1e90;
  if (permanent < large * large * large && std::abs(dx) + std::abs(dy) + std::abs(dz) < large)
  {
    if (determinant > bound)
    {
      return 1;
    }
    if (determinant < -bound)
    {
      return -1;
    }
  }
  // Expansions are exact while no part of a product of three leaves float64's range.
  double largest = 0.0;
  double smallest = HUGE_VAL;
  for (const Vec3* const p : { &a, &b, &c, &d })
  {
    for (const double x : *p)
    {
      largest = std::max(largest, std::abs(x));
      smallest = x == 0.0 ? smallest : std::min(smallest, std::abs(x));
    }
  }
  // The last bit of a number is 2^-52 of it, and of a product of three 2^-156.
  const bool isInRange = largest < large && smallest > 1e-80;
  return isInRange ? SignByExpansions(a, b, c, d) : SignOfVolumeByRationals(a, b, c, d);
}

namespace
{
/// A point off the plane of a triangle, or false where it has no area.
bool PointOffPlane(const Vec3& a, const Vec3& b, const Vec3& c, Vec3& off)
{
  for (int k = 0; k < 3; ++k)
  {
    off = a;
    off[k] = a[k] == 0.0 ? 1.0 : -a[k];
    if (SignOfVolume(a, b, c, off) != 0)
    {
      return true;
    }
  }
  return false;
}

/// Of a segment and a triangle in one plane.
bool SegmentMeetsInPlane(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  Vec3 off;
  if (!PointOffPlane(a, b, c, off))
  {
    return false;
  }
  const int turn = SignOfVolume(a, b, c, off);
  // On which side of u-v a point of the plane lies; +1: as the triangle.
  const auto side = [&](const Vec3& u, const Vec3& v, const Vec3& x)
  { return turn * SignOfVolume(u, v, x, off); };
  const Vec3* const corners[4] = { &a, &b, &c, &a };
  const auto isWithin = [&](const Vec3& x)
  { return side(a, b, x) >= 0 && side(b, c, x) >= 0 && side(c, a, x) >= 0; };
  if (isWithin(p) || isWithin(q))
  {
    return true;
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vec3& u = *corners[i];
    const Vec3& v = *corners[i + 1];
    const int ofU = side(p, q, u), ofV = side(p, q, v), ofP = side(u, v, p), ofQ = side(u, v, q);
    // One along the edge's line meets another edge too, if it meets the triangle at all.
    const bool isAlong = ofP == 0 && ofQ == 0;
    if (!isAlong && ofU * ofV <= 0 && ofP * ofQ <= 0)
    {
      return true;
    }
  }
  return false;
}
}

bool HasNoArea(const Vec3& a, const Vec3& b, const Vec3& c)
{
  Vec3 off;
  return !PointOffPlane(a, b, c, off);
}

bool SegmentMeets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const int before = SignOfVolume(a, b, c, p);
  const int after = SignOfVolume(a, b, c, q);
  if (before * after > 0)
  {
    return false;
  }
  if (before == 0 && after == 0)
  {
    return SegmentMeetsInPlane(p, q, a, b, c);
  }
  const int ab = SignOfVolume(p, q, a, b);
  const int bc = SignOfVolume(p, q, b, c);
  if (ab * bc < 0)
  {
    return false;
  }
  const int ca = SignOfVolume(p, q, c, a);
  return ab * ca >= 0 && bc * ca >= 0;
}
}
