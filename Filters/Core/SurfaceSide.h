#ifndef SurfaceSide_h
#define SurfaceSide_h

#include "TriangleSurface.h"
#include "VectorMath.h"

#include <cstdint>

namespace haptics
{
/// @brief On which side of a whole surface a point is, and the nearest way to the other.
///
/// What is asked when a surface has changed all at once, so that no motion tells. Local frame of
/// the surface, at a fraction of its deformation's time. Servo thread: no allocation; bounded by
/// the list.
class SurfaceSide
{
public:
  /// `scratch`: a list to work with, whose capacity bounds the work.
  SurfaceSide(const TriangleSurface& surface, double fraction, TriangleList scratch);

  /// How often a closed oriented surface encloses the point: 1 inside a solid, 0 outside. Exact, by
  /// the crossings of a ray. False where it cannot be told: too many triangles in the way.
  bool CountEnclosing(const Vector& x, int& winding);

  /// The nearest point of the surface, and the normal of the facet there that faces it most.
  /// `isOnRim`: at the border of an open surface. False where there is none within reach.
  bool FindNearest(const Vector& x, Vector& nearest, Vector& normal, bool& isOnRim);

private:
  struct Corners
  {
    Vector A, B, C;
  };
  Corners CornersOf(std::int32_t triangle) const;
  /// 0: not crossed, +1 or -1: crossed from back or front; 2: along an edge or a corner.
  int Crossing(const Vector& from, const Vector& to, std::int32_t triangle) const;

  const TriangleSurface& Surface;
  double Fraction;
  TriangleList Scratch;
};
}

#endif
