#include "haptics/Contact/GodObjectImplementation.h"

#include <algorithm>

namespace haptics
{
/// Takes the god-object along with the HIP on its straight way since the update before, in pieces
/// where what holds it changes, as if the HIP were sampled so much more often; the rest is one
/// piece as soon as nothing changes any more.
///
///     from ----|----|----|----> hip        each | is where the god-object comes to rest
///
/// Each piece is certified as an update is, and brings the god-object no farther from its own end.
/// That alone does not do: around a corner the way may end farther from the HIP than it began, and
/// K <= 2b/T rests on V = K |p - h|^2 / 2, with the force held over the whole tick. Then what was
/// tried is forgotten, and the tick is made in one piece.
void GodObject::Implementation::Follow(const Vector& from, const Vector& hip)
{
  const Vector start = this->Position;
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    this->LocalStarts[i] = this->Sets[i].LocalPosition();
  }
  const double whole = this->GoalMoved;
  const double share = 1.0 / this->PiecesAllowed;
  int pieces = 0;
  for (bool isLast = false; !isLast; ++pieces)
  {
    const bool mayBeCut =
      pieces + 1 < this->PiecesAllowed && this->WaySize + LargestWayOfPiece <= LargestWay;
    const ActivePlanes planes = this->Active;
    const Friction cone = this->Cone;
    this->PieceStart = this->WaySize - 1;
    this->GoalMoved = whole * (1.0 - share * pieces);
    this->LooksForChange = mayBeCut;
    this->IsChangeFound = false;
    this->Approach(hip);
    isLast = !this->IsChangeFound;
    if (!isLast)
    {
      this->Active = planes;
      this->Cone = cone;
      this->GoalMoved = whole * share;
      this->IsChangeFound = false;
      this->Approach(from + share * (pieces + 1) * (hip - from));
    }
  }
  this->LooksForChange = false;
  if (pieces > 1 &&
    SquaredLength(this->Position - hip) > SquaredLength(start - hip) * (1.0 + 1e-12))
  {
    this->Position = start;
    for (std::size_t i = this->First; i < this->Last; ++i)
    {
      this->Sets[i].Return(this->LocalStarts[i]);
    }
    this->Active.Clear();
    this->Cone.Reset();
    this->WaySize = 1;
    this->PieceStart = 0;
    this->GoalMoved = whole;
    this->Approach(hip);
  }
}

/// Whether what holds the god-object changes on its way to `goal`, and bends that by more than the
/// HIP moves in the tick: on smooth ground one piece leads to the same place.
bool GodObject::Implementation::ChangesOnWay(
  const Vector& goal, const Vector& hip, const FacetHit& hit) const
{
  const int size = this->Active.SupportSize();
  if (hit && (hit.IsWaypoint || size != 1))
  {
    return !hit.IsWaypoint;
  }
  // A god-object at depth d goes on d sin(angle) farther where its facet's neighbour turns so much.
  const double depth = glm::length(goal - hip);
  const auto isBent = [&](const Vector& a, const Vector& b)
  { return depth * glm::length(glm::cross(a, b)) > this->GoalMoved || glm::dot(a, b) < 0.0; };
  if (hit)
  {
    return isBent(hit.Plane.Normal, this->Active.Support(0).Normal);
  }
  for (int i = 0; i < size; ++i)
  {
    const ActivePlane& plane = this->Active.Support(i);
    const WorkingSet& set = this->Sets[plane.Facet.Surface];
    bool isInside = false;
    if (!set.Covers(plane, goal, this->Active, isInside))
    {
      Vector next(0.0);
      if (size > 1 || !set.FindNextNormal(plane, this->Position, goal, next) ||
        isBent(plane.Normal, next))
      {
        return true;
      }
    }
  }
  return false;
}
}
