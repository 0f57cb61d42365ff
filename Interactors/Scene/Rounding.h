#ifndef Haptics_Rounding_h
#define Haptics_Rounding_h

#include "haptics/Math/Vec3.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
/// Of coordinates in the world: a shift by less is rounding, and would draw a picture again and
/// again.
constexpr double CoordinateRounding = 1e-14;

inline double LargestComponent(const Vec3& v)
{
  return std::max({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) });
}
}

#endif
