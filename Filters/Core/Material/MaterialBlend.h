#ifndef Haptics_MaterialBlend_h
#define Haptics_MaterialBlend_h

#include "haptics/Material/Material.h"
#include "haptics/Math/VectorMath.h"

namespace haptics
{
/// @brief The common material of several facets that hold the god-object at once: each counts by
/// its share of the push. What is added in another order is the same to within rounding.
class MaterialBlend
{
public:
  /// A facet that pushes with `push` > 0 (any unit) along `normal`, and its material.
  /// `shaded` is the interpolated normal there, of any length; zero where nothing is shaded.
  void Add(const Material& material, double push, const Vector& normal, const Vector& shaded);
  /// What came of it; plain where nothing was added.
  Material Blended() const;
  /// The displacement turned as the normal turns by shading; of the same length.
  Vector Shade(const Vector& displacement) const;

private:
  Material Sum;
  double Push = 0.0;
  double StrongestPush = 0.0;
  Vector Normal{ 0 };
  Vector ShadedNormal{ 0 };
  bool IsShaded = false;
};
}

#endif
