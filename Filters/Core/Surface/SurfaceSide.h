#ifndef Haptics_SurfaceSide_h
#define Haptics_SurfaceSide_h

#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/TriangleSurface.h"

#include <cstdint>

namespace haptics
{
/// How many triangles may still be looked up: what bounds the work of a tick.
struct WorkBudget
{
  std::int64_t Triangles = 0;
};

/// How often a point is enclosed: 1 inside a solid, 0 outside.
struct Enclosed
{
  int Front = 0; ///< by what is counted as Encloser::Front
  int Both = 0;  ///< by what is counted as Encloser::Both
};

/// How a straight way crosses a triangle: 0: not, +1 or -1: from back or front; 2: along an edge,
/// by a corner, or with an end on it. Exact.
VTKHAPTICSCORE_EXPORT int CrossingOf(
  const Vector& from, const Vector& to, const Vector& a, const Vector& b, const Vector& c);

/// A place of a surface.
struct SurfacePlace
{
  Vector Point{ 0 };
  Vector Normal{ 0 };         ///< of the facet there that faces the asker most
  Vector Normals{ 0 };        ///< the sum of those of all facets there: out of a notch's tip
  std::int32_t Triangle = -1; ///< of which it is
  bool IsOnRim = false;       ///< at the border of an open surface
};

/// @brief On which side of a whole surface a point is, and the nearest way to the other.
///
/// What is asked when a surface has changed all at once, so that no motion shows. Local frame of
/// the surface, at a fraction of its deformation's time. Servo thread: no allocation; bounded by
/// the budget.
class SurfaceSide
{
public:
  /// `scratch`: a list to work with; what finds more than fit at once is not answered.
  SurfaceSide(
    const TriangleSurface& surface, double fraction, TriangleList scratch, WorkBudget& budget);

  /// How often the triangles that enclose space do so with the point. Exact, by the crossings of a
  /// ray, in a patch of the way from its anchor. False where it is not known: too many triangles in
  /// the way, or beyond the patch.
  bool CountEnclosing(const Vector& x, Enclosed& enclosed);

  /// Whether a point is so near to the surface, against its size, that the nearest place matters.
  bool IsInReach(const Vector& x) const;
  /// The nearest place of the triangles that enclose in one way, or of all where `kind` is null.
  /// False where there is none within reach, or too many are as near. In a patch, where `kind` is
  /// given, false also where something beyond it may be nearer.
  bool FindNearest(const Vector& x, const Encloser* kind, SurfacePlace& nearest);

private:
  struct Corners
  {
    Vector A, B, C;
  };
  Corners CornersOf(std::int32_t triangle) const;
  /// Adds the crossings of a way. False where it meets an edge or a corner, `isKnown` where too
  /// many are in the way.
  bool AddCrossings(const Vector& from, const Vector& to, Enclosed& crossings, bool& isKnown);
  bool CountInPatch(const SurfacePatch& patch, const Vector& x, Enclosed& enclosed);
  /// The nearest place of what was found, and how far it is: HUGE_VAL where there is none.
  double ChooseNearest(
    const Vector& x, const Encloser* kind, const TriangleList& found, SurfacePlace& nearest) const;

  const TriangleSurface& Surface;
  double Fraction;
  TriangleList Scratch;
  WorkBudget& Budget;
};
}

#endif
