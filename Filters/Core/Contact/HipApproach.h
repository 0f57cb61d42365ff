#ifndef Haptics_HipApproach_h
#define Haptics_HipApproach_h

#include "haptics/Contact/BallWalk.h"
#include "haptics/Contact/PointWalk.h"

namespace haptics
{
/// @brief Takes a god-object to where the surfaces, and friction, let a HIP have it, in one piece.
class HipApproach
{
public:
  HipApproach(GodObjectState& god, WayChange& change, PlaneRelease& planes)
    : God(god)
    , Change(change)
    , Point(god, change, planes)
    , Ball(god)
  {
  }

  /// An update begins.
  void Begin()
  {
    if (this->God.Around.IsBall() && !this->God.Around.IsFit)
    {
      this->Ball.Grow();
    }
    this->Point.Begin();
  }
  /// `endsAtHip`: the update ends there, so what is in plain view is gone to.
  void Approach(const Vector& hip, bool endsAtHip = true);
  /// Moves to the nearest point to the goal that the surfaces let it reach, without friction. True
  /// if it came there.
  bool Walk(const Vector& goal)
  {
    return this->God.Around.IsBall() ? this->Ball.Roll(goal) : this->Point.Walk(goal);
  }
  /// With all passes that an update may make.
  void RenewPasses() { this->God.PassesLeft = this->PassesAllowed; }

  int PassesAllowed = GodObject::LargestNumberOfPasses;

private:
  void WalkWithFriction(const Vector& hip);
  Vector AimWithFriction(const Vector& hip);

  GodObjectState& God;
  WayChange& Change;
  PointWalk Point;
  BallWalk Ball;
};
}

#endif
