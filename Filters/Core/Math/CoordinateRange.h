#ifndef Haptics_CoordinateRange_h
#define Haptics_CoordinateRange_h

#include "haptics/Math/Vec3.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
/// Whether all three coordinates are smaller than LargestCoordinate; NaN is not.
inline bool IsInRange(const Vec3& p) noexcept
{
  return std::all_of(p.begin(), p.end(), [](double x) { return std::abs(x) < LargestCoordinate; });
}
}

#endif
