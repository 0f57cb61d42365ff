#ifndef Haptics_NearestOnTriangle_h
#define Haptics_NearestOnTriangle_h

#include "haptics/Math/VectorMath.h"

namespace haptics
{
/// The point of a triangle that is nearest to the origin, to within rounding: a corner, a point of
/// an edge, or one inside, by the signs of the barycentric coordinates.
inline Vector NearestToOrigin(const Vector& a, const Vector& b, const Vector& c)
{
  const Vector ab = b - a;
  const Vector ac = c - a;
  const double d1 = -glm::dot(ab, a);
  const double d2 = -glm::dot(ac, a);
  const double d3 = -glm::dot(ab, b);
  const double d4 = -glm::dot(ac, b);
  const double d5 = -glm::dot(ab, c);
  const double d6 = -glm::dot(ac, c);
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return a;
  }
  if (d3 >= 0.0 && d4 <= d3)
  {
    return b;
  }
  if (d6 >= 0.0 && d5 <= d6)
  {
    return c;
  }
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return a + (d1 / (d1 - d3)) * ab;
  }
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return a + (d2 / (d2 - d6)) * ac;
  }
  if (va <= 0.0 && d4 >= d3 && d5 >= d6)
  {
    return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? a + (vb / sum) * ab + (vc / sum) * ac : a;
}
}

#endif
