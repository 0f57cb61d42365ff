#include "haptics/Contact/WayChange.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A facet that is met before this fraction of a way is met where the god-object is.
constexpr double AtOnce = 1e-6;
/// A change that takes the god-object on by no more than this share of the HIP's way is none.
constexpr double LeastBend = 0.25;
}

/// Looks at the first way of a piece, to `goal`, and what it meets. True if the piece is to be cut:
/// At then is where what holds the god-object changes, as a fraction of the way.
bool WayChange::Find(const Vector& goal, const Vector& hip, const FacetHit& hit)
{
  if (hit && hit.Fraction < AtOnce)
  {
    return false; // the way begins behind what is met at once
  }
  this->IsLookedFor = false;
  const int size = this->God.Active.SupportSize();
  // A god-object at depth d goes on d sin(angle) farther where its facet's neighbour turns so much;
  // on smooth ground that is nothing, and one step leads to the same place.
  const double depth = glm::length(goal - hip);
  const auto isBent = [&](const Vector& a, const Vector& b)
  {
    return depth * glm::length(glm::cross(a, b)) > LeastBend * this->HipWay || glm::dot(a, b) < 0.0;
  };
  if (hit)
  {
    bool isNew = !hit.IsWaypoint;
    for (int i = 0; i < size; ++i)
    {
      isNew = isNew && isBent(hit.Plane.Normal, this->God.Active.Support(i).Normal);
    }
    this->At = isNew ? hit.Fraction : 1.0;
    return this->At < 1.0;
  }
  for (int i = 0; i < size; ++i)
  {
    const ActivePlane& plane = this->God.Active.Support(i);
    const WorkingSet& set = this->God.Around.Sets[plane.Facet.Surface];
    const double still = 4.0 * plane.Clearance;
    bool isInside = false;
    if (SquaredLength(goal - this->God.Position) > still * still &&
      !set.Covers(plane, goal, this->God.Active, isInside))
    {
      Vector next(0.0);
      double fraction = 0.0;
      const bool isKnown = set.FindNextNormal(plane, this->God.Position, goal, next, fraction);
      const Vector edge = this->God.Position + fraction * (goal - this->God.Position);
      // Beyond the edge nothing holds: a slot that is crossed within the tick is not fallen into.
      const bool isLetGo = size == 1 && (!isKnown || glm::dot(next, hip - edge) > 0.0);
      if (fraction > AtOnce && !isLetGo && (!isKnown || isBent(plane.Normal, next)))
      {
        this->At = std::min(this->At, fraction);
      }
    }
  }
  return this->At < 1.0;
}
}
