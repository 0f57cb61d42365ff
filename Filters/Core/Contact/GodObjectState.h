#ifndef Haptics_GodObjectState_h
#define Haptics_GodObjectState_h

#include "haptics/Contact/Surroundings.h"
#include "haptics/Material/Friction.h"

#include <array>

namespace haptics
{
/// A pass meets at most a few facets; more come of rounding.
constexpr int LargestNumberOfCasts = 12;
/// How often an update looks whether what holds is there; once where it is.
constexpr int LargestNumberOfReleases = 4;
/// Each cast makes at most one motion, so does each release, and one more goes to what is in plain
/// view.
constexpr int LargestWayOfPiece =
  GodObject::LargestNumberOfPasses * LargestNumberOfCasts + LargestNumberOfReleases + 2;
/// Where half of it has been used the rest is one substep.
constexpr int LargestWay = 2 * LargestWayOfPiece;

/// @brief Where a god-object stands, what holds it, and the way that it has come in this update.
///
/// What moves it (PointWalk, BallWalk, PlaneRelease, MovingSurfaces) does so by the functions here,
/// so that each piece of the way is certified, and begins, to the bit, where the last one ended.
class GodObjectState
{
public:
  GodObjectState(std::vector<TouchedSurface> surfaces, Tip tip)
    : Around(std::move(surfaces), tip)
  {
  }

  void SetTipRadius(double radius);

  ///@{
  /// Motions. See their definitions for what has to have been certified.
  bool MoveTowards(const Vector& target);
  void MoveTo(const Vector& target);
  void MoveBall(const Vector& to);
  bool MoveCentre(const Vector& to);
  ///@}

  ///@{
  /// The planes that hold it.
  bool IsSupported(FacetId& beyond);
  void KeepSupports(bool keepsFar, const FacetId& beyond = FacetId());
  bool IsOver(const ActivePlane& plane, bool& isInside) const
  {
    return this->Around.Sets[plane.Facet.Surface].Covers(
      plane, this->Position, this->Active, isInside);
  }
  void KeepTouches(double slack);
  bool Touches(const ActivePlane& plane, double slack) const;
  ///@}

  /// Writes the planes that hold it to the result.
  void ListConstraints();

  Surroundings Around;
  Vector Position{ 0 }; ///< scene frame
  ActivePlanes Active;
  Friction Cone;
  std::array<Vec3, LargestWay> Way;
  int WaySize = 0;
  int PassesLeft = 0; ///< of this piece of an update
  bool IsPlaced = false;
  bool IsOverloaded = false;
  /// Surfaces close in on the god-object and leave no place that all of them allow: each keeps a
  /// god-object of its own until they do.
  bool IsSplit = false;
  Vector HipBefore{ 0 };           ///< where the HIP's way to the next update begins
  Vector SurfaceDisplacement{ 0 }; ///< by surfaces that moved or changed, since the last update
  Contact Result;
};
}

#endif
