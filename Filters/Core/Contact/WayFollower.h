#ifndef Haptics_WayFollower_h
#define Haptics_WayFollower_h

#include "haptics/Contact/HipApproach.h"

#include <vector>

namespace haptics
{
/// @brief Takes a point along with the HIP on its straight way since the update before, in
/// substeps.
class WayFollower
{
public:
  WayFollower(GodObjectState& god, WayChange& change, PlaneRelease& planes, HipApproach& walker)
    : God(god)
    , Change(change)
    , Planes(planes)
    , Walker(walker)
    , LocalStarts(god.Around.TouchableCount)
  {
  }

  void Follow(const Vector& from, const Vector& hip);

  int SubstepsAllowed = GodObject::DefaultSubstepLimit;

private:
  GodObjectState& God;
  WayChange& Change;
  PlaneRelease& Planes;
  HipApproach& Walker;
  std::vector<Vector> LocalStarts; ///< of the sets, before the first piece
};
}

#endif
