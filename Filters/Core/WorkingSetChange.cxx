// The part of WorkingSet that goes on from a surface to the one that takes its place.
#include "WorkingSet.h"

namespace haptics
{
namespace
{
/// Whether enclosing is a matter of counting.
bool HasInside(const TriangleSurface& surface)
{
  return surface.Report().Closed && surface.Report().Oriented;
}
/// Whether a god-object may be enclosed so often that was so before: a front can be left through
/// its back, but where both sides are touched it stays on its own.
bool IsSameSide(const TriangleSurface& surface, int enclosed, int before)
{
  return surface.TouchedSide() == Side::Front ? enclosed <= before : enclosed == before;
}
/// A facet that leans farther than this from what held the god-object before is not taken for it.
constexpr double LeastCosine = 0.25;
/// A place is tried so many clearances off the surface, times 4, 16, ...
constexpr int LargestNumberOfHeights = 8;
}

SurfaceSide WorkingSet::SideOf(const TriangleSurface& surface, double fraction)
{
  return SurfaceSide(surface, fraction,
    TriangleList{ this->Found.data(), static_cast<std::int32_t>(this->Found.size()) });
}

bool WorkingSet::Succeed(const WorkingSet& previous, const ActivePlane* held)
{
  this->Covered = Region::Nothing;
  SurfaceSide before = this->SideOf(*previous.Touched, previous.Now);
  SurfaceSide now = this->SideOf(*this->Touched, this->Now);
  const Vector there = this->Position;
  int enclosedBefore = 0;
  int enclosed = 0;
  const bool isCounted = HasInside(*previous.Touched) && HasInside(*this->Touched) &&
    previous.Touched->TouchedSide() == this->Touched->TouchedSide() &&
    before.CountEnclosing(previous.Position, enclosedBefore) && now.CountEnclosing(there, enclosed);
  if (isCounted && IsSameSide(*this->Touched, enclosed, enclosedBefore))
  {
    return true;
  }
  Vector nearest(0.0);
  Vector normal(0.0);
  bool isOnRim = false;
  if ((!isCounted && !held) || !now.FindNearest(there, nearest, normal, isOnRim))
  {
    return true;
  }
  if (isCounted)
  {
    return !this->PlaceBack(nearest, normal, enclosedBefore);
  }
  // Nothing to count: it has been gone over where what held it has come to its other side.
  const Vector free = this->ToSurface.VectorToLocal(held->Normal);
  const bool isTurned = this->Touched->TouchedSide() == Side::Both && glm::dot(normal, free) < 0.0;
  const Vector outwards = isTurned ? -normal : normal;
  const bool isBehind = glm::dot(outwards, there - nearest) < 0.0;
  if (isOnRim || !isBehind || glm::dot(outwards, free) < LeastCosine)
  {
    return true;
  }
  return !this->PlaceOff(nearest, outwards, nullptr);
}

/// Puts the god-object off the nearest point of a closed surface, on whichever side it had when it
/// was enclosed so often. False, with nothing changed, where that does not come about.
bool WorkingSet::PlaceBack(const Vector& nearest, const Vector& normal, int enclosed)
{
  return this->PlaceOff(nearest, normal, &enclosed) || this->PlaceOff(nearest, -normal, &enclosed);
}

/// Puts the god-object off the nearest point of the surface; where `enclosed` is given, on the side
/// that it had when it was enclosed so often. False, with nothing changed, where that does not come
/// about.
bool WorkingSet::PlaceOff(const Vector& nearest, const Vector& outwards, const int* enclosed)
{
  SurfaceSide side = this->SideOf(*this->Touched, this->Now);
  double height = this->MinimumClearance;
  for (int i = 0; i < LargestNumberOfHeights; ++i)
  {
    const Vector place = nearest + height * outwards;
    int count = 0;
    if (!enclosed ||
      (side.CountEnclosing(place, count) && IsSameSide(*this->Touched, count, *enclosed)))
    {
      this->Position = place;
      return true;
    }
    height *= 4.0;
  }
  return false;
}

void WorkingSet::SkipTick()
{
  int before = 0;
  const bool isCounted = HasInside(*this->Touched) &&
    this->SideOf(*this->Touched, this->Now).CountEnclosing(this->Position, before);
  this->Now = this->TickEnd;
  this->Next = this->Now;
  this->Covered = Region::Nothing;
  this->EmptyRadius = 0.0;
  SurfaceSide side = this->SideOf(*this->Touched, this->Now);
  int after = 0;
  Vector nearest(0.0);
  Vector normal(0.0);
  bool isOnRim = false;
  if (isCounted && side.CountEnclosing(this->Position, after) &&
    !IsSameSide(*this->Touched, after, before) &&
    side.FindNearest(this->Position, nearest, normal, isOnRim))
  {
    this->PlaceBack(nearest, normal, before);
  }
}
}
