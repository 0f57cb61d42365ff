#ifndef Haptics_FirstHit_h
#define Haptics_FirstHit_h

#include "AnalyticSurfaces.h"
#include "haptics/Contact/GodObject.h"

#include <algorithm>

namespace haptics::testing
{
/// Where a ray first meets a surface, as its distance from the ray's start; the length of the ray
/// where it meets none. The god-object is the ray's.
inline double FirstHit(GodObject& ray, const Vec3& from, const Vec3& to)
{
  ray.Place(from);
  ray.Update(to);
  int corners = 0;
  const Vec3* const way = ray.Way(corners);
  return corners > 1 ? std::min(Length(way[1] - way[0]), Length(to - from)) : 0.0;
}
}

#endif
