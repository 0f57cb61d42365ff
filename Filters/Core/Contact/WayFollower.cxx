#include "haptics/Contact/WayFollower.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// How far beyond a change a substep ends, as a share of the way; twice as far, and so on, while
/// none comes of it.
constexpr double SmallestShare = 1.0 / 256.0;
}

/// Takes the god-object along with the HIP on its straight way since the update before, from where
/// what holds it changes to where it changes next; what is left when no substep is left is one.
///
///     from ---|-----------|--> hip        each | lies a little beyond a change
///
/// Each substep is certified as an update is, and brings the god-object no farther from its own
/// end. That alone does not do: around a corner the way may end farther from the HIP than it began,
/// and K <= 2b/T rests on V = K |p - h|^2 / 2, with the force held over the whole tick. Then what
/// was tried is forgotten, and the tick is made in one step.
void WayFollower::Follow(const Vector& from, const Vector& hip)
{
  const Vector start = this->God.Position;
  for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
  {
    this->LocalStarts[i] = this->God.Around.Sets[i].LocalPosition();
  }
  const double hipWay = this->Planes.GoalMoved;
  double done = 0.0; // of the way
  double share = SmallestShare;
  bool wasCut = false;
  for (int left = this->SubstepsAllowed - 1; done < 1.0; --left)
  {
    const ActivePlanes planes = this->God.Active;
    const Friction cone = this->God.Cone;
    this->Planes.Start = this->God.WaySize - 1;
    this->Planes.Left = LargestNumberOfReleases;
    const bool mayBeCut =
      left > 0 && done + share < 1.0 && this->God.WaySize + LargestWayOfPiece <= LargestWay;
    this->Change.Begin(mayBeCut, hipWay);
    this->Planes.GoalMoved = (1.0 - done) * hipWay;
    this->Walker.Approach(hip);
    const double next = done + this->Change.Fraction() * (1.0 - done) + share;
    if (this->Change.IsFound()) // then nothing has moved
    {
      wasCut = true;
      this->God.Active = planes;
      this->God.Cone = cone;
      this->Change.Begin(false, hipWay);
      this->Planes.GoalMoved = std::min(next - done, 1.0 - done) * hipWay;
      const bool isOnWay = next < 1.0;
      this->Walker.Approach(isOnWay ? from + next * (hip - from) : hip, !isOnWay);
    }
    const bool isSame = this->God.Active.SupportFacets() == planes.SupportFacets();
    share = isSame ? 2.0 * share : SmallestShare;
    done = next;
  }
  this->Change.Stop();
  if (wasCut &&
    SquaredLength(this->God.Position - hip) > SquaredLength(start - hip) * (1.0 + 1e-12))
  {
    this->God.Position = start;
    for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
    {
      this->God.Around.Sets[i].Return(this->LocalStarts[i]);
    }
    this->God.Active.Clear();
    this->God.Cone.Reset();
    this->God.WaySize = 1;
    this->Planes.Start = 0;
    this->Planes.GoalMoved = hipWay;
    this->Walker.Approach(hip);
  }
}
}
