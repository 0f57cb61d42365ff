#include "haptics/Contact/GodObjectState.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A refused motion is tried at 1, 1/2, ... 1/32 of its length.
constexpr int LargestNumberOfHalvings = 6;
/// A plane touches while the ball is within so many heights of it.
constexpr double TouchingHeights = 2.0;
}

void GodObjectState::SetTipRadius(double radius)
{
  const double size = this->Around.UsableRadius(radius);
  if (size == this->Around.TipRadius)
  {
    return;
  }
  if ((size > 0.0) != this->Around.IsBall())
  {
    this->Active.Clear();
    this->Cone.Reset();
  }
  this->Around.TipRadius = size;
  this->Around.BallRadius = std::min(this->Around.BallRadius, size);
  this->Around.IsFit = false;
}

/// Makes the motion, or the largest tried part of it that is certified to cross nothing.
/// True if all of it was made.
bool GodObjectState::MoveTowards(const Vector& target)
{
  if (this->Around.IsBall())
  {
    this->MoveBall(target);
    return true;
  }
  Vector step = target - this->Position;
  Vector to = target;
  for (int halving = 0; halving < LargestNumberOfHalvings; ++halving)
  {
    if (this->Around.IsClear(to))
    {
      this->MoveTo(to);
      return halving == 0;
    }
    step *= 0.5;
    to = this->Position + step;
  }
  return false;
}

/// Makes a motion that all surfaces have just certified.
void GodObjectState::MoveTo(const Vector& target)
{
  this->Around.MoveSets();
  if (target != this->Position || !this->Active.DoAllSupport())
  {
    this->Active.SetKnownOver(false);
  }
  this->Position = target;
  this->Way[this->WaySize++] = ToVec3(target);
}

/// To a place on the way of the last cast, no farther than what it hit.
void GodObjectState::MoveBall(const Vector& to)
{
  this->Around.MoveSetsTo(to);
  this->Position = to;
  this->Way[this->WaySize++] = ToVec3(to);
  if (this->Around.HasComeThrough())
  {
    this->Around.FitBall();
  }
}

/// Where a ball, within what has only a front, cannot be followed: its centre goes as a point does,
/// and what that overlaps then it has to leave.
bool GodObjectState::MoveCentre(const Vector& to)
{
  const ActivePlanes none;
  for (std::size_t i = this->Around.First; i < this->Around.Last; ++i)
  {
    FacetHit other;
    if (!this->Around.Sets[i].FindFirstHit(to, none, this->Around.Budget, other) || other ||
      !this->Around.Sets[i].IsClear(to))
    {
      return false;
    }
  }
  this->Around.MoveSets();
  this->Position = to;
  this->Around.FitBall();
  return true;
}

/// Whether each plane that holds the god-object does so with its own facet. One that holds it
/// beyond its facet's edges has to be let go of: Fig. 5b.
/// `beyond`: set to the facet of that plane.
bool GodObjectState::IsSupported(FacetId& beyond)
{
  if (this->Active.IsKnownOver())
  {
    return true;
  }
  bool areInside = true;
  for (int i = 0; i < this->Active.SupportSize(); ++i)
  {
    bool isInside = false;
    if (!this->IsOver(this->Active.Support(i), isInside))
    {
      beyond = this->Active.Support(i).Facet;
      return false;
    }
    areInside = areInside && isInside;
  }
  this->Active.SetKnownOver(true, areInside);
  return true;
}

/// Keeps of the planes that held the god-object those that do so with their own facets. `beyond`:
/// one that is known not to.
void GodObjectState::KeepSupports(bool keepsFar, const FacetId& beyond)
{
  if (this->Around.IsBall())
  {
    this->KeepTouches(0.0);
    return;
  }
  const bool isKnown = this->Active.IsKnownOver();
  bool areInside = !isKnown || this->Active.IsKnownInside();
  this->Active.KeepSupports(
    [&](const ActivePlane& plane)
    {
      if (plane.IsFar && !keepsFar)
      {
        return false;
      }
      bool isInside = true;
      const bool isKept = isKnown || (!(plane.Facet == beyond) && this->IsOver(plane, isInside));
      areInside = areInside && isInside;
      return isKept;
    });
  this->Active.SetKnownOver(true, areInside);
}

/// Keeps of the planes that held the ball those whose facets it touches, or is within `slack` of.
void GodObjectState::KeepTouches(double slack)
{
  this->Around.RenewPlanes(this->Active);
  this->Active.KeepSupports([&](const ActivePlane& plane) { return this->Touches(plane, slack); });
}

bool GodObjectState::Touches(const ActivePlane& plane, double slack) const
{
  const double height = glm::dot(plane.Normal, this->Position - plane.Anchor);
  const double touching = TouchingHeights * plane.Clearance;
  // It is behind what it has come around an edge of.
  return height <= touching + slack &&
    height >= -touching - 2.0 * Surroundings::Tolerance * this->Around.BallRadius;
}

/// Lists the planes that hold the god-object, the one that pushes most first.
void GodObjectState::ListConstraints()
{
  const Vector displacement = ToVector(this->Result.Displacement);
  std::array<double, 3> pushes{};
  this->Result.NumberOfConstraints = this->Active.SupportSize();
  for (int i = 0; i < this->Result.NumberOfConstraints; ++i)
  {
    const ActivePlane& plane = this->Active.Support(i);
    const double push = glm::dot(plane.Normal, displacement);
    int place = i;
    for (; place > 0 && pushes[place - 1] < push; --place)
    {
      pushes[place] = pushes[place - 1];
      this->Result.Constraints[place] = this->Result.Constraints[place - 1];
    }
    pushes[place] = push;
    this->Result.Constraints[place] = { ToVec3(plane.Normal), plane.Facet.Surface,
      plane.Facet.Triangle };
  }
}
}
