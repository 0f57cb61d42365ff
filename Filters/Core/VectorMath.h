#ifndef VectorMath_h
#define VectorMath_h

#include "Vec3.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace haptics
{
using Vector = glm::dvec3;

inline Vector ToVector(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}

inline Vec3 ToVec3(const Vector& v)
{
  return { v.x, v.y, v.z };
}

inline double SquaredLength(const Vector& v)
{
  return glm::dot(v, v);
}

/// Half the distance from 1 to the next float64: the bound on one relative rounding error.
constexpr double UnitRoundoff = 0x1p-53;
}

#endif
