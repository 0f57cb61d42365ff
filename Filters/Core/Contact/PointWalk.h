#ifndef Haptics_PointWalk_h
#define Haptics_PointWalk_h

#include "haptics/Contact/PlaneRelease.h"
#include "haptics/Contact/WayChange.h"

#include <array>

namespace haptics
{
/// @brief Moves a god-object that is a point to a goal, as far as facets let it: the passes of
/// Zilles and Salisbury (1995), section 4.
class PointWalk
{
public:
  PointWalk(GodObjectState& god, WayChange& change, PlaneRelease& planes)
    : God(god)
    , Change(change)
    , Planes(planes)
  {
  }

  /// An update begins: what holds the point now is no news.
  void Begin() { this->HeldBefore = this->God.Active.SupportFacets(); }

  /// Moves to the nearest point to the goal that the surfaces let it reach. True if it came there.
  bool Walk(const Vector& goal);
  void LookAhead(const Vector& hip);

private:
  bool Pass(const Vector& hip, const FacetId& beyond);
  bool MeetsAgain(const Vector& hip) const;

  GodObjectState& God;
  WayChange& Change;
  PlaneRelease& Planes;
  std::array<FacetId, 3> HeldBefore; ///< this update
  FacetId InTheWay;                  ///< when it was last looked ahead
  bool IsOtherInTheWay = false;      ///< than what held it, then
};
}

#endif
