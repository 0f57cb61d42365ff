#ifndef Haptics_RandomVectors_h
#define Haptics_RandomVectors_h

#include "haptics/Math/Vec3.h"

#include <random>

namespace haptics::testing
{
/// Of normally distributed components, so that all directions are alike.
inline Vec3 NormalVector(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  return { x, y, normal(random) };
}
}

#endif
