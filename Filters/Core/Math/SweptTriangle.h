#ifndef Haptics_SweptTriangle_h
#define Haptics_SweptTriangle_h

#include "haptics/Math/VectorMath.h"

#include <array>

namespace haptics
{
/// @brief A triangle that moves past a point: its corners go straight and evenly, relative to it.
///
/// The point is the origin. Triangles that share corners share their ways, so nothing slips through
/// between them.
struct SweptTriangle
{
  std::array<Vector, 3> From, To;
  /// No corner is known better than this.
  double Slack = 0.0;
  /// Whether only a sweep from front to back counts.
  bool IsOneSided = false;

  /// A time from 0 to 1 up to which the triangle is certain not to pass over the origin; 1 where it
  /// never does. What is not certain counts as passing. Bounded: at most 63 looks.
  double TimeOfContact() const;
};
}

#endif
