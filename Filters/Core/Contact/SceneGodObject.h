#ifndef Haptics_SceneGodObject_h
#define Haptics_SceneGodObject_h

#include "haptics/Contact/ContactMaterial.h"
#include "haptics/Contact/MovingSurfaces.h"
#include "haptics/Contact/WayFollower.h"

namespace haptics
{
/// @brief A god-object in the frame of its scene: its state, and what moves it.
class SceneGodObject
{
public:
  SceneGodObject(std::vector<TouchedSurface> surfaces, Tip tip)
    : God(std::move(surfaces), tip)
    , Scratch(God.Around.Surfaces.empty() ? 0 : Neighbourhood::LargestNumberOfTriangles)
  {
  }

  /// Puts it somewhere as in free space.
  void Place(const Vector& position);
  /// Moves it towards the HIP, to where the surfaces let it go.
  void Update(const Vector& hip);

  GodObjectState God;
  WayChange Change{ God };
  PlaneRelease Planes{ God };
  HipApproach Walker{ God, Change, Planes };
  WayFollower Follower{ God, Change, Planes, Walker };
  MovingSurfaces Moving{ God, Planes, Walker };
  ContactMaterial Materials{ God };
  Vector LastHip{ 0 };
  std::vector<std::int32_t> Scratch; ///< for questions to the surfaces of another one
};
}

#endif
