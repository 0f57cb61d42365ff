#include "haptics/Contact/PointWalk.h"

#include "haptics/Contact/NarrowGap.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A god-object is at its HIP when it is so many clearances from it: as near as what it touches
/// lets it come.
constexpr double NearEnough = 8.0;

/// Facets whose planes were let go of in a pass.
class FacetsPassedOver
{
public:
  bool Has(const FacetId& facet) const
  {
    return std::find(this->Facets.begin(), this->Facets.begin() + this->Count, facet) !=
      this->Facets.begin() + this->Count;
  }
  /// False where there are too many.
  bool Add(const FacetId& facet)
  {
    if (this->Count == static_cast<int>(this->Facets.size()))
    {
      return false;
    }
    this->Facets[this->Count++] = facet;
    return true;
  }

private:
  std::array<FacetId, LargestNumberOfCasts> Facets;
  int Count = 0;
};
}

bool PointWalk::Walk(const Vector& goal)
{
  FacetId beyond;
  while (this->God.PassesLeft-- > 0)
  {
    if (this->God.Active.IsEmpty() && this->God.Around.IsKnownClear(goal, this->God.Active))
    {
      this->God.MoveTo(goal);
      return true;
    }
    const Vector before = this->God.Position;
    const bool arrived = this->Pass(goal, beyond);
    this->Change.Stop();
    if (this->God.Position == goal)
    {
      return true;
    }
    if (this->God.IsOverloaded || this->Change.IsFound())
    {
      return false;
    }
    beyond = FacetId();
    const bool isSupported = arrived && this->God.IsSupported(beyond);
    if (isSupported ||
      SquaredLength(this->God.Position - before) <= 1e-18 * SquaredLength(goal - before))
    {
      if (!this->Planes.Release(goal))
      {
        return isSupported;
      }
      beyond = FacetId();
    }
  }
  return false;
}

/// Moves to the nearest point to the HIP that the facets met on the way allow. `beyond`: of what
/// holds the god-object, a facet that is known not to be below it.
/// True if it came there.
bool PointWalk::Pass(const Vector& hip, const FacetId& beyond)
{
  // The facets that the god-object lies on hold it still: the cast to the HIP would meet them
  // first, so it is left out.
  this->God.KeepSupports(false, beyond);
  Vector goal =
    this->God.Active.IsEmpty() ? hip : this->God.Active.Nearest(this->God.Position, hip);
  FacetsPassedOver passed;
  for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
  {
    FacetHit hit;
    const bool isClear =
      this->God.Active.SupportSize() > 0 && this->God.Around.IsKnownClear(goal, this->God.Active);
    if (!isClear && !this->God.Around.FindFirstHit(goal, this->God.Active, hit))
    {
      this->God.IsOverloaded = true;
      return false;
    }
    if (this->Change.IsToBeCut(goal, hip, hit))
    {
      return false;
    }
    if (isClear)
    {
      this->God.MoveTo(goal);
      return true;
    }
    if (!hit)
    {
      const bool arrived = this->God.MoveTowards(goal);
      if (arrived || this->God.Active.SupportSize() == 0)
      {
        return arrived;
      }
      const Vector next = this->God.Active.Nearest(this->God.Position, hip);
      if (next == goal)
      {
        return false;
      }
      goal = next;
      continue;
    }
    if (hit.Fraction > 0.0)
    {
      this->God.MoveTowards(this->God.Position + hit.Fraction * (goal - this->God.Position));
    }
    if (hit.IsWaypoint)
    {
      continue;
    }
    if (this->God.Active.Has(hit.Plane.Facet))
    {
      return false;
    }
    // One that was met beyond its facet's edge, which is under the new one, is in nobody's way.
    // Where two are under each other, the one that is met again has both stay.
    if (!passed.Has(hit.Plane.Facet))
    {
      this->God.Active.Keep(
        [&](const ActivePlane& plane)
        {
          const bool isPassedOver = this->God.Around.Sets[plane.Facet.Surface].IsPassedOver(
            plane, this->God.Position, hit.Plane);
          return !isPassedOver || !passed.Add(plane.Facet);
        });
    }
    this->God.Active.Add(hit.Plane);
    goal = this->God.Active.Nearest(this->God.Position, hip);
  }
  return false;
}

/// Whether a facet that an earlier motion touched is in the straight way to the HIP, too.
bool PointWalk::MeetsAgain(const Vector& hip) const
{
  const auto sets = this->God.Around.Sets.begin();
  return std::any_of(sets + static_cast<std::ptrdiff_t>(this->God.Around.First),
    sets + static_cast<std::ptrdiff_t>(this->God.Around.Last),
    [&](const WorkingSet& set) { return set.TouchesAgain(hip); });
}

/// What is in plain view is reached: goes to the HIP where no facet is in the straight way there
/// and that does not squeeze through a gap to be closed. So neither what facets reach over gaps nor
/// planes that hold together, though each alone would let go, hold where nothing is.
/// A line is met by what goes through it to within rounding, and let go of in the next update.
void PointWalk::LookAhead(const Vector& hip)
{
  const int size = this->God.Active.SupportSize();
  if (this->God.IsOverloaded)
  {
    return;
  }
  double near = 0.0;
  for (int i = 0; i < size; ++i)
  {
    near = std::max(near, NearEnough * this->God.Active.Support(i).Clearance);
  }
  if (SquaredLength(hip - this->God.Position) <= near * near)
  {
    return;
  }
  if (this->IsOtherInTheWay && this->MeetsAgain(hip))
  {
    return;
  }
  this->IsOtherInTheWay = false;
  const auto standsInWay = [&](const ActivePlane& plane)
  {
    const bool isNew = std::find(this->HeldBefore.begin(), this->HeldBefore.end(), plane.Facet) ==
      this->HeldBefore.end();
    return this->God.Around.Sets[plane.Facet.Surface].StandsInWay(plane, hip, isNew);
  };
  // First that which was in the way before: most often it still is.
  for (const bool isAsked : { true, false })
  {
    for (int i = 0; i < size; ++i)
    {
      const ActivePlane& plane = this->God.Active.Support(i);
      if ((plane.Facet == this->InTheWay) == isAsked && standsInWay(plane))
      {
        this->InTheWay = plane.Facet;
        return;
      }
    }
  }
  NarrowGap gap(this->God.Position, hip);
  for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
  {
    if (!this->God.Around.Sets[i].IsOpen(hip, this->God.Around.Budget, gap))
    {
      this->IsOtherInTheWay = true;
      return;
    }
  }
  if (!gap.IsFound() && this->God.MoveTowards(hip))
  {
    this->God.Active.Clear();
  }
}
}
