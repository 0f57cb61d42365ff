#ifndef Haptics_SurfaceRay_h
#define Haptics_SurfaceRay_h

#include "haptics/Math/Vec3.h"
#include "haptics/Surface/TriangleSurface.h"

#include <optional>

namespace haptics
{
/// How far along a ray the first triangle lies that can be touched from there, in lengths of
/// `direction`; nothing where there is none. `from` and `direction`: world frame, any length.
/// For the GUI: it allocates.
std::optional<double> CastRay(
  const TriangleSurface& surface, const Vec3& from, const Vec3& direction);
}

#endif
