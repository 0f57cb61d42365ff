#ifndef Haptics_BallWalk_h
#define Haptics_BallWalk_h

#include "haptics/Contact/GodObjectState.h"

namespace haptics
{
/// @brief Moves a god-object that is a ball: its centre keeps a radius off every facet.
class BallWalk
{
public:
  explicit BallWalk(GodObjectState& god)
    : God(god)
  {
  }

  /// Fits a ball that may overlap, lets it grow a little, and pushes it out of what that touches,
  /// the nearest way.
  void Grow();
  /// Moves the ball to the nearest point to the goal that the facets let it reach. Over what is
  /// round, edges and corners of facets, passes converge to it. True if it came there.
  bool Roll(const Vector& goal);

private:
  bool GrowBy(double growth);
  bool LiesFlat();
  bool FindWayRound(const Vector& goal, Vector& corner, Vector& end);
  bool RollRound(const Vector& corner, const Vector& end, const Vector& goal);
  bool RollTowards(const Vector& first, const Vector& goal);

  GodObjectState& God;
};
}

#endif
