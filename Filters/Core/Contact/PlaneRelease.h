#ifndef Haptics_PlaneRelease_h
#define Haptics_PlaneRelease_h

#include "haptics/Contact/BlockedCreases.h"
#include "haptics/Contact/GodObjectState.h"

#include <array>

namespace haptics
{
/// @brief Lets a point go of planes that hold it where no facet is.
///
/// Planes are wider than their facets, and where facets meet at a corner that is neither convex nor
/// concave, no three planes are what is free. So a god-object that is held asks whether it is held
/// by facets. What was refused is remembered, so that nobody asks twice.
class PlaneRelease
{
public:
  explicit PlaneRelease(GodObjectState& god)
    : God(god)
  {
  }

  /// True if a motion was made: the next pass goes on from there.
  bool Release(const Vector& goal);
  /// What was refused, and which creases are blocked.
  void Forget()
  {
    this->Refused = {};
    this->Blocked = {};
  }

  /// What was refused before, in the frame of the first surface that held.
  struct Refusal
  {
    Vector Position{ 0 };
    Vector Pull{ 0 };
    std::array<FacetId, 3> Facets;
    int Rounds = 0; ///< of tries while the goal was at rest
  };
  Refusal Refused;
  int Left = 0;                ///< so many releases may be asked for
  int Start = 0;               ///< the corner of the way where this piece of the update began
  double GoalMoved = HUGE_VAL; ///< since the update before

private:
  bool MayBeReleased(const Vector& pull);
  bool IsNoGap(const Vector& to);

  GodObjectState& God;
  BlockedCreases Blocked;
};
}

#endif
