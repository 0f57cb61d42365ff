#ifndef Haptics_AccurateCross_h
#define Haptics_AccurateCross_h

#include "haptics/Math/VectorMath.h"

#include <cmath>

namespace haptics
{
/// A number in twice the digits of a double: the unevaluated sum of two (Dekker 1971).
struct TwoDoubles
{
  double High = 0.0;
  double Low = 0.0;
};

inline TwoDoubles ExactSum(double a, double b)
{
  const double sum = a + b;
  const double bPart = sum - a;
  return { sum, (a - (sum - bPart)) + (b - bPart) };
}

inline TwoDoubles ExactProduct(double a, double b)
{
  const double product = a * b;
  return { product, std::fma(a, b, -product) };
}

inline TwoDoubles Product(const TwoDoubles& a, const TwoDoubles& b)
{
  const TwoDoubles product = ExactProduct(a.High, b.High);
  return ExactSum(product.High, product.Low + (a.High * b.Low + a.Low * b.High));
}

inline double Difference(const TwoDoubles& a, const TwoDoubles& b)
{
  const TwoDoubles high = ExactSum(a.High, -b.High);
  const TwoDoubles low = ExactSum(a.Low, -b.Low);
  const TwoDoubles sum = ExactSum(high.High, high.Low + low.High);
  return sum.High + (sum.Low + low.Low);
}

/// How far the rounding of AccurateCross is below that of a cross product in double.
constexpr double ShareOfAccurateCross = 0x1p-47;

/// (b - a) x (c - a), to within 2^-100 |b - a| |c - a|: the normal of a triangle that is as thin as
/// the rounding of its corners.
inline Vector AccurateCross(const Vector& a, const Vector& b, const Vector& c)
{
  TwoDoubles u[3];
  TwoDoubles v[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = ExactSum(b[axis], -a[axis]);
    v[axis] = ExactSum(c[axis], -a[axis]);
  }
  const auto component = [&](int i, int j)
  { return Difference(Product(u[i], v[j]), Product(u[j], v[i])); };
  return { component(1, 2), component(2, 0), component(0, 1) };
}
}

#endif
