#ifndef FeelBlend_h
#define FeelBlend_h

#include "Feel.h"
#include "VectorMath.h"

namespace haptics
{
/// @brief What several facets that hold the god-object at once feel like together: each counts by
/// its share of the push.
class FeelBlend
{
public:
  /// A facet that pushes with `push` > 0 (any unit) along `normal`, and what it feels like.
  /// `shaded` is the interpolated normal there, of any length; zero where nothing is shaded.
  void Add(const Feel& feel, double push, const Vector& normal, const Vector& shaded);
  /// What came of it; plain where nothing was added.
  Feel Blended() const;
  /// The displacement turned as the normal turns by shading; of the same length.
  Vector Shade(const Vector& displacement) const;

private:
  Feel Sum;
  double Push = 0.0;
  double StrongestPush = 0.0;
  Vector Normal{ 0 };
  Vector ShadedNormal{ 0 };
  bool IsShaded = false;
};
}

#endif
