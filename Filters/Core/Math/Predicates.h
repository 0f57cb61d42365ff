#ifndef Haptics_Predicates_h
#define Haptics_Predicates_h

#include "haptics/Math/VectorMath.h"

namespace haptics
{
/// On which side of the plane through a, b, c the point d lies: +1 where the corners are seen
/// counter-clockwise (the front), -1 behind, 0 exactly on the plane. Exact for every finite input:
/// CGAL's filtered kernel.
int Orientation(const Vector& a, const Vector& b, const Vector& c, const Vector& d) noexcept;

/// Whether the line through p and q meets the closed triangle a, b, c, given that p and q are not
/// strictly on one side of its plane and not both on it. Exact.
bool LineMeetsTriangle(
  const Vector& p, const Vector& q, const Vector& a, const Vector& b, const Vector& c) noexcept;
}

#endif
