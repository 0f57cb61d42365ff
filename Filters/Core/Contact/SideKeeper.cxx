#include "haptics/Contact/SideKeeper.h"

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

SurfaceSide SideKeeper::Sides() const
{
  return SurfaceSide(
    this->Surface.Surface(), this->Surface.Fraction(), this->Scratch, this->Budget);
}

bool SideKeeper::CountEnclosing(const Vector& x, Enclosed& enclosed) const
{
  return HasInside(this->Surface.Surface()) && this->Sides().CountEnclosing(x, enclosed);
}

bool SideKeeper::AreOnSameSide(const Vector& here, const Vector& there) const
{
  Enclosed first;
  Enclosed second;
  return !HasInside(this->Surface.Surface()) ||
    (this->CountEnclosing(here, first) && this->CountEnclosing(there, second) &&
      first.Front == second.Front && first.Both == second.Both);
}

std::optional<Enclosed> SideKeeper::Before(const Past& past) const
{
  const TriangleSurface& touched = this->Surface.Surface();
  const TriangleSurface& touchedBefore = past.Surface.Surface();
  Enclosed enclosed;
  if (!HasInside(touched) || !(touchedBefore.Enclosing() == touched.Enclosing()))
  {
    return std::nullopt;
  }
  if (past.Owed)
  {
    return past.Owed;
  }
  const bool isCounted =
    SurfaceSide(touchedBefore, past.Surface.Fraction(), past.Scratch, this->Budget)
      .CountEnclosing(past.Position, enclosed);
  return isCounted ? std::optional<Enclosed>(enclosed) : std::nullopt;
}

bool SideKeeper::IsOnSideOf(const Enclosed& before, const Vector& position) const
{
  Enclosed now;
  return !this->Sides().IsInReach(position) ||
    (this->CountEnclosing(position, now) && IsSameSide(now, before));
}

bool SideKeeper::PlaceAfter(
  const Past& past, const std::optional<Enclosed>& before, Vector& position) const
{
  const TriangleSurface& touched = this->Surface.Surface();
  const TriangleSurface& touchedBefore = past.Surface.Surface();
  Enclosed enclosed;
  const bool isCounted = before && this->CountEnclosing(position, enclosed);
  if (isCounted && !IsSameSide(enclosed, *before))
  {
    return this->PlaceBack(*before, enclosed, position);
  }
  const bool isHeld = past.Holder >= 0;
  const bool isTold =
    isCounted && isHeld && touchedBefore.EncloserOf(past.Holder) != Encloser::None;
  const Encloser uncounted = Encloser::None;
  SurfacePlace nearest;
  if (!isHeld || isTold ||
    !this->Sides().FindNearest(position, isCounted ? &uncounted : nullptr, nearest))
  {
    return false;
  }
  // Nothing to count: it has been gone over where what held it has come to its other side.
  const bool isTurned =
    touched.TouchesBack(nearest.Triangle) && glm::dot(nearest.Normal, past.Normal) < 0.0;
  const Vector outwards = isTurned ? -nearest.Normal : nearest.Normal;
  const bool isBehind = glm::dot(outwards, position - nearest.Point) < 0.0;
  return !nearest.IsOnRim && isBehind && glm::dot(outwards, past.Normal) >= LeastCosine &&
    this->PlaceOff(nearest.Point, outwards, nullptr, position);
}

bool SideKeeper::PlaceWhereEnclosed(const Enclosed& before, Vector& position) const
{
  Enclosed now;
  return this->CountEnclosing(position, now) && !IsSameSide(now, before) &&
    this->PlaceBack(before, now, position);
}

/// Puts the god-object off the nearest point of what encloses it otherwise than before, on the side
/// that it had. False, with nothing changed, where that does not come about.
bool SideKeeper::PlaceBack(const Enclosed& before, const Enclosed& now, Vector& position) const
{
  const Encloser kind = now.Front > before.Front ? Encloser::Front : Encloser::Both;
  SurfacePlace nearest;
  if (!this->Sides().FindNearest(position, &kind, nearest))
  {
    return false;
  }
  // From the tip of a narrow notch the normal of one of its walls leads into the other.
  const double length = glm::length(nearest.Normals);
  const Vector between = length > LeastCosine ? nearest.Normals / length : nearest.Normal;
  return this->PlaceOff(nearest.Point, nearest.Normal, &before, position) ||
    this->PlaceOff(nearest.Point, -nearest.Normal, &before, position) ||
    this->PlaceOff(nearest.Point, between, &before, position) ||
    this->PlaceOff(nearest.Point, -between, &before, position);
}

/// Puts the god-object off the nearest point of the surface; where `enclosed` is given, on the side
/// that it had when it was enclosed so often. False, with nothing changed, where that does not come
/// about.
bool SideKeeper::PlaceOff(
  const Vector& nearest, const Vector& outwards, const Enclosed* enclosed, Vector& position) const
{
  SurfaceSide side = this->Sides();
  double height = this->Clearance;
  for (int i = 0; i < LargestNumberOfHeights; ++i)
  {
    const Vector place = nearest + height * outwards;
    Enclosed count;
    if (!enclosed || (side.CountEnclosing(place, count) && IsSameSide(count, *enclosed)))
    {
      position = place;
      return true;
    }
    height *= 4.0;
  }
  return false;
}
}
