#ifndef Haptics_TriangleBounds_h
#define Haptics_TriangleBounds_h

#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/CollisionEngine.h"

#include <glm/common.hpp>

namespace haptics
{
struct TriangleBounds
{
  Vector Low, High;
};

inline TriangleBounds BoundsOf(
  const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& t)
{
  const Vector a = ToVector(points[t[0]]);
  const Vector b = ToVector(points[t[1]]);
  const Vector c = ToVector(points[t[2]]);
  return { glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)) };
}

/// Of one that moves, all that it passes.
inline TriangleBounds BoundsOf(const EngineInput& input, const std::array<std::int32_t, 3>& t)
{
  const TriangleBounds box = BoundsOf(input.Points, t);
  if (!input.StartPoints)
  {
    return box;
  }
  const TriangleBounds start = BoundsOf(*input.StartPoints, t);
  return { glm::min(box.Low, start.Low), glm::max(box.High, start.High) };
}
}

#endif
