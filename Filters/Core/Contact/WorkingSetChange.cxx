// The part of WorkingSet that goes on from a surface to the one that takes its place.
#include "haptics/Contact/WorkingSet.h"

namespace haptics
{
namespace
{
/// Whether enclosing is a matter of counting.
bool HasInside(const TriangleSurface& surface)
{
  return !(surface.Enclosing() == TriangleSurface::Enclosure());
}
/// Whether a god-object may be enclosed so often that was so before: a front can be left through
/// its back, but where both sides are touched it stays on its own.
bool IsSameSide(const Enclosed& now, const Enclosed& before)
{
  return now.Front <= before.Front && now.Both == before.Both;
}
/// A facet that leans farther than this from what held the god-object before is not taken for it.
constexpr double LeastCosine = 0.25;
/// A place is tried so many clearances off the surface, times 4, 16, ...
constexpr int LargestNumberOfHeights = 8;
}

SurfaceSide WorkingSet::Sides(WorkBudget& budget)
{
  return SurfaceSide(*this->Touched, this->Now,
    TriangleList{ this->Found.data(), static_cast<std::int32_t>(this->Found.size()) }, budget);
}

bool WorkingSet::Succeed(
  const WorkingSet& previous, const ActivePlane* held, TriangleList scratch, WorkBudget& budget)
{
  this->Covered = Region::Nothing;
  SurfaceSide before(*previous.Touched, previous.Now, scratch, budget);
  SurfaceSide now = this->Sides(budget);
  const Vector there = this->Position;
  Enclosed enclosedBefore;
  Enclosed enclosed;
  const bool isCounted = HasInside(*this->Touched) &&
    previous.Touched->Enclosing() == this->Touched->Enclosing() &&
    before.CountEnclosing(previous.Position, enclosedBefore) && now.CountEnclosing(there, enclosed);
  if (isCounted && !IsSameSide(enclosed, enclosedBefore))
  {
    return !this->PlaceBack(enclosedBefore, enclosed, budget);
  }
  const bool isTold =
    isCounted && held && previous.Touched->EncloserOf(held->Facet.Triangle) != Encloser::None;
  const Encloser uncounted = Encloser::None;
  SurfacePlace nearest;
  if (!held || isTold || !now.FindNearest(there, isCounted ? &uncounted : nullptr, nearest))
  {
    return true;
  }
  // Nothing to count: it has been gone over where what held it has come to its other side.
  const Vector free = this->ToSurface.VectorToLocal(held->Normal);
  const bool isTurned =
    this->Touched->TouchesBack(nearest.Triangle) && glm::dot(nearest.Normal, free) < 0.0;
  const Vector outwards = isTurned ? -nearest.Normal : nearest.Normal;
  const bool isBehind = glm::dot(outwards, there - nearest.Point) < 0.0;
  if (nearest.IsOnRim || !isBehind || glm::dot(outwards, free) < LeastCosine)
  {
    return true;
  }
  return !this->PlaceOff(nearest.Point, outwards, nullptr, budget);
}

bool WorkingSet::IsOnSameSide(const Vector& place, WorkBudget& budget)
{
  if (!HasInside(*this->Touched))
  {
    return true;
  }
  SurfaceSide side = this->Sides(budget);
  Enclosed here;
  Enclosed there;
  return side.CountEnclosing(this->Position, here) &&
    side.CountEnclosing(this->ToSurface.PointToLocal(place), there) && here.Front == there.Front &&
    here.Both == there.Both;
}

/// Puts the god-object off the nearest point of what encloses it otherwise than before, on the side
/// that it had. False, with nothing changed, where that does not come about.
bool WorkingSet::PlaceBack(const Enclosed& before, const Enclosed& now, WorkBudget& budget)
{
  const Encloser kind = now.Front > before.Front ? Encloser::Front : Encloser::Both;
  SurfacePlace nearest;
  if (!this->Sides(budget).FindNearest(this->Position, &kind, nearest))
  {
    return false;
  }
  // From the tip of a narrow notch the normal of one of its walls leads into the other.
  const double length = glm::length(nearest.Normals);
  const Vector between = length > LeastCosine ? nearest.Normals / length : nearest.Normal;
  return this->PlaceOff(nearest.Point, nearest.Normal, &before, budget) ||
    this->PlaceOff(nearest.Point, -nearest.Normal, &before, budget) ||
    this->PlaceOff(nearest.Point, between, &before, budget) ||
    this->PlaceOff(nearest.Point, -between, &before, budget);
}

/// Puts the god-object off the nearest point of the surface; where `enclosed` is given, on the side
/// that it had when it was enclosed so often. False, with nothing changed, where that does not come
/// about.
bool WorkingSet::PlaceOff(
  const Vector& nearest, const Vector& outwards, const Enclosed* enclosed, WorkBudget& budget)
{
  SurfaceSide side = this->Sides(budget);
  double height = this->MinimumClearance;
  for (int i = 0; i < LargestNumberOfHeights; ++i)
  {
    const Vector place = nearest + height * outwards;
    Enclosed count;
    if (!enclosed || (side.CountEnclosing(place, count) && IsSameSide(count, *enclosed)))
    {
      this->Position = place;
      return true;
    }
    height *= 4.0;
  }
  return false;
}

void WorkingSet::SkipTick(WorkBudget& budget)
{
  Enclosed before;
  const bool isCounted =
    HasInside(*this->Touched) && this->Sides(budget).CountEnclosing(this->Position, before);
  this->Now = this->TickEnd;
  this->Next = this->Now;
  this->Covered = Region::Nothing;
  this->EmptyRadius = 0.0;
  Enclosed after;
  if (isCounted && this->Sides(budget).CountEnclosing(this->Position, after) &&
    !IsSameSide(after, before))
  {
    this->PlaceBack(before, after, budget);
  }
}
}
