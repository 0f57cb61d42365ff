#ifndef Haptics_SurfaceRay_h
#define Haptics_SurfaceRay_h

#include "haptics/Math/Vec3.h"
#include "haptics/Surface/TriangleSurface.h"

#include <optional>

namespace haptics
{
/// Where a ray meets a surface.
struct RayHit
{
  double Distance = 0.0; ///< in lengths of the ray's direction
  Vec3 Normal{};         ///< of the triangle, unit length, against the ray
};

/// The first triangle along a ray that can be touched from there; nothing where there is none.
/// `from` and `direction`: the surface's frame, any length. For the GUI: it allocates.
std::optional<RayHit> CastRay(
  const TriangleSurface& surface, const Vec3& from, const Vec3& direction);
}

#endif
