#ifndef Haptics_ExactSigns_h
#define Haptics_ExactSigns_h

#include "haptics/Math/Vec3.h"

namespace haptics::testing
{
/// Exact answers about points, segments and triangles, for what judges the core: no code is shared
/// with it, nor its library. A float64 sign outside a proven bound on its error decides; else
/// expansions (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", 1997) do, and rational numbers where the exponents leave their range.

/// The sign of det(b - a, c - a, d - a): +1 where d sees a, b, c counter-clockwise (their front),
/// -1 behind, 0 in their plane. Exact for every finite input.
int SignOfVolume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The same by rational numbers alone.
int SignOfVolumeByRationals(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether the triangle is a point or a part of a line.
bool HasNoArea(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the closed segment p-q meets the closed triangle, which has an area; also where they lie
/// in one plane.
bool SegmentMeets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);
}

#endif
