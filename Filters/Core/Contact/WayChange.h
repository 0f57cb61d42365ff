#ifndef Haptics_WayChange_h
#define Haptics_WayChange_h

#include "haptics/Contact/GodObjectState.h"

namespace haptics
{
/// @brief Finds where on a piece of the HIP's way what holds the god-object changes: there
/// WayFollower cuts the piece.
class WayChange
{
public:
  explicit WayChange(const GodObjectState& god)
    : God(god)
  {
  }

  /// Has the next cast looked at, or not. `hipWay`: the length of the HIP's way in this update.
  void Begin(bool isLookedFor, double hipWay)
  {
    this->IsLookedFor = isLookedFor;
    this->HipWay = hipWay;
    this->At = 1.0;
  }
  /// What comes after the first cast of a piece is not looked at.
  void Stop() { this->IsLookedFor = false; }

  bool IsToBeCut(const Vector& goal, const Vector& hip, const FacetHit& hit)
  {
    return this->IsLookedFor && this->Find(goal, hip, hit);
  }
  /// Whether there is one: here, and nothing has moved.
  bool IsFound() const { return this->At < 1.0; }
  /// Where, as a fraction of the way.
  double Fraction() const { return this->At; }

private:
  bool Find(const Vector& goal, const Vector& hip, const FacetHit& hit);

  const GodObjectState& God;
  double HipWay = 0.0;
  bool IsLookedFor = false;
  double At = 1.0;
};
}

#endif
