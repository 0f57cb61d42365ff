#ifndef Haptics_Vec3Operations_h
#define Haptics_Vec3Operations_h

#include "haptics/Math/Vec3.h"

#include <cmath>

namespace haptics
{
/// The arithmetic of Vec3 outside of the core, which has GLM's (VectorMath.h).
inline Vec3 Minus(const Vec3& a, const Vec3& b) noexcept
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

/// a + s b
inline Vec3 Sum(const Vec3& a, double s, const Vec3& b) noexcept
{
  return { a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2] };
}

inline double Dot(const Vec3& a, const Vec3& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec3 Cross(const Vec3& a, const Vec3& b) noexcept
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Neither overflows nor loses digits.
inline double Length(const Vec3& a) noexcept
{
  return std::hypot(a[0], a[1], a[2]);
}
}

#endif
