#ifndef Haptics_VectorMath_h
#define Haptics_VectorMath_h

#include "haptics/Math/Vec3.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

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

/// A bound on how far from `origin` a point of a box is, and on how far it is once rounded there.
/// The middle of a box as small as the rounding of its coordinates is itself rounded: half its
/// diagonal is none.
inline double RadiusAbout(const Vector& origin, const Vector& low, const Vector& high)
{
  return glm::length(glm::max(glm::abs(low - origin), glm::abs(high - origin))) * (1.0 + 0x1p-40);
}

/// What is smaller than this share of a surface's radius is taken for 0 in its local frame: 2^15
/// times less than rounding is, and CGAL's exact numbers then never outgrow the room that they have
/// without allocating.
constexpr double NegligibleShare = 0x1p-68;

inline Vector WithoutNegligible(const Vector& x, double negligible)
{
  return { std::abs(x.x) < negligible ? 0.0 : x.x, std::abs(x.y) < negligible ? 0.0 : x.y,
    std::abs(x.z) < negligible ? 0.0 : x.z };
}
}

#endif
