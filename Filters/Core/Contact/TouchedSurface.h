#ifndef Haptics_TouchedSurface_h
#define Haptics_TouchedSurface_h

#include "haptics/Material/SurfaceProperties.h"
#include "haptics/Surface/SurfaceMotion.h"
#include "haptics/Surface/TriangleSurface.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace haptics
{
/// One surface as a god-object touches it: its snapshot, and all that is not geometry.
struct TouchedSurface
{
  /// A snapshot alone is a surface that stands still, frictionless, with the servo's stiffness.
  TouchedSurface(std::shared_ptr<const TriangleSurface> surface,
    std::shared_ptr<SurfaceMotion> motion = nullptr,
    std::shared_ptr<const SurfaceProperties> properties = nullptr)
    : Surface(std::move(surface))
    , Motion(std::move(motion))
    , Properties(std::move(properties))
  {
  }

  std::shared_ptr<const TriangleSurface> Surface; ///< not null
  /// How it moves as a rigid body; what the snapshot calls the world is then the surface's own
  /// frame. Null, the default: it stands still, and costs nothing.
  std::shared_ptr<SurfaceMotion> Motion;
  /// Its material; built for Surface. Null, the default: plain, and costs nothing.
  std::shared_ptr<const SurfaceProperties> Properties;
  /// The same number for all snapshots of what its user takes for one surface. Where its geometry
  /// changes all at once, contact goes on from it to the next (GodObject::Continue()); 0, the
  /// default: a surface of its own that comes and goes.
  std::uint64_t Identity = 0;
  /// The hand carries it: it is not touched, its motion is not followed, and the god-object keeps
  /// the local point that it had when it was gripped. Let go of, contact goes on from that point,
  /// so that the hand is on the side where it was. Default off. Surfaces that are gripped come last
  /// in a god-object's list.
  bool IsGripped = false;
};
}

#endif
