#ifndef Haptics_EqualPoints_h
#define Haptics_EqualPoints_h

#include "haptics/Filters/PointReader.h"
#include "haptics/Math/ProgressCall.h"

#include <cstdint>
#include <vector>

namespace haptics
{
/// Finds for each point the first one with equal float64 coordinates relative to `origin`; as a
/// PointMerger of no tolerance, by several threads. `firstEqual` is negative where a point is of no
/// interest, which stays so, and takes the answers. False where `progress` has stopped the work.
bool FindEqualPoints(const PointReader& points, const Vec3& origin,
  std::vector<std::int32_t>& firstEqual, const ProgressCall& progress);
}

#endif
