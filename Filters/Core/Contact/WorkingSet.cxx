#include "haptics/Contact/WorkingSet.h"

#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/Predicates.h"
#include "haptics/Math/SweptTriangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
/// Heights that differ by less than so many clearances may do so by rounding.
constexpr double SlackOfHeight = 1.0 / 16.0;
/// A facet covers a place half a clearance over its plane, or less, from no farther than so many
/// clearances: those that it reaches over gaps, and one for a thin one's plane, which is another.
constexpr double FarthestCovered = GrowthOverGaps + 2.0;
/// Of facets met at once so many are compared.
constexpr int LargestNumberAtOnce = 32;
/// Facets of two surfaces lie along each other up to a thousandth of a radian, and from 1.8 degrees
/// on no longer.
constexpr double SquaredSineOfParallels = 1e-6;
constexpr double SquaredSineOfOthers = 1e-3;

/// 1 up to `from`, 0 from `to` on, a smooth step between.
double Fall(double x, double from, double to)
{
  const double t = std::clamp((to - x) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
}

WorkingSet::WorkingSet(const std::shared_ptr<const TriangleSurface>& surface, std::int32_t index,
  const SurfaceFrame& frame)
  : Index(index)
  , ToSurface(frame)
  , Near(surface)
{
  this->Near.KeepClearOfRounding(glm::length(frame.Origin()));
}

void WorkingSet::SetFrame(const SurfaceFrame& frame)
{
  this->ToSurface = frame;
  this->Near.Facets().ForgetTarget();
  this->Near.KeepClearAfterMove(glm::length(frame.Origin()));
}

void WorkingSet::Place(const Vector& position)
{
  this->Near.Place(this->ToSurface.PointToLocal(position));
}

void WorkingSet::Return(const Vector& local)
{
  this->Near.Place(local);
}

void WorkingSet::Restart(const Vector& position)
{
  this->Place(position);
  this->Owed.reset();
  this->Known = {};
  this->Near.ForgetLearned();
}

void WorkingSet::Continue(const WorkingSet& previous)
{
  this->Near.Place(previous.LocalPosition());
  this->Near.Continue(previous.Near);
  this->Geometry().Continue(previous.Geometry());
}

void WorkingSet::TakeOver(const WorkingSet& previous)
{
  this->ToSurface = previous.ToSurface;
  this->Near.TakeOver(previous.Near);
  this->Geometry().Continue(previous.Geometry());
}

double WorkingSet::KnownPart(const Vector& hip, double radius) const
{
  if (this->IsAstray())
  {
    return 0.0;
  }
  const SurfacePatch* const patch = this->Surface().Patch();
  return patch ? patch->Region().KnownPart(
                   ToVec3(this->LocalPosition()), ToVec3(this->ToSurface.PointToLocal(hip)), radius)
               : 1.0;
}

bool WorkingSet::IsKnown(const Vector& place, double radius) const
{
  const SurfacePatch* const patch = this->Surface().Patch();
  return !patch ||
    patch->Region().DistanceTo(ToVec3(this->ToSurface.PointToLocal(place))) + radius <=
    patch->Region().Radius;
}

SideKeeper WorkingSet::Sides(WorkBudget& budget)
{
  return SideKeeper(this->Geometry(), this->Near.Scratch(), this->Near.MinimumClearance(), budget);
}

SideKeeper::Past WorkingSet::PastOf(
  const WorkingSet& previous, const ActivePlane* held, TriangleList scratch) const
{
  return { previous.Geometry(), scratch, previous.LocalPosition(), held ? held->Facet.Triangle : -1,
    held ? this->ToSurface.VectorToLocal(held->Normal) : Vector(0.0), previous.Owed };
}

bool WorkingSet::ContinueAfterChange(
  const WorkingSet& previous, const ActivePlane* held, TriangleList scratch, WorkBudget& budget)
{
  const SideKeeper::Past past = this->PastOf(previous, held, scratch);
  const SideKeeper sides = this->Sides(budget);
  Vector position = this->LocalPosition();
  const std::optional<Enclosed> before = sides.Before(past);
  const bool isMoved = sides.PlaceAfter(past, before, position);
  if (this->Surface().Patch())
  {
    this->Owed = before && !sides.IsOnSideOf(*before, position) ? before : std::nullopt;
  }
  this->Near.Place(position);
  return !isMoved;
}

void WorkingSet::StandBeyond(const WorkingSet& previous, TriangleList scratch, WorkBudget& budget)
{
  if (this->Surface().Patch())
  {
    this->Owed = this->Sides(budget).Before(this->PastOf(previous, nullptr, scratch));
  }
}

bool WorkingSet::IsOnSameSide(const Vector& place, WorkBudget& budget)
{
  return this->Sides(budget).AreOnSameSide(
    this->LocalPosition(), this->ToSurface.PointToLocal(place));
}

void WorkingSet::SkipTick(WorkBudget& budget)
{
  const SideKeeper sides = this->Sides(budget);
  Vector position = this->LocalPosition();
  Enclosed before;
  const bool isCounted = sides.CountEnclosing(position, before);
  this->Geometry().SkipTick();
  if (isCounted)
  {
    sides.PlaceWhereEnclosed(before, position);
  }
  this->Near.Place(position);
  this->Near.ForgetEmptyBall();
}

void WorkingSet::SweepTo(double part)
{
  this->Geometry().SweepTo(part);
  this->IsSweepClear = false;
}

bool WorkingSet::FindFirstHit(
  const Vector& goal, const ActivePlanes& active, WorkBudget& budget, FacetHit& hit)
{
  const Vector to = this->ToSurface.PointToLocal(goal);
  if (this->Geometry().IsSweeping())
  {
    return this->FindSwept(to, budget, hit);
  }
  if (this->Near.GoesNowhere(to) || this->Near.PassesThroughNothing(to))
  {
    return true;
  }
  const auto isAnswered = [&]
  {
    // All triangles in the ball are known: a hit inside it is the first of the whole way.
    return this->Near.IsInBall(to) ||
      (hit &&
        this->Near.IsInBall(this->LocalPosition() + hit.Fraction * (to - this->LocalPosition())));
  };
  if (this->Near.HasBall())
  {
    this->Scan(to, active, hit);
    if (isAnswered())
    {
      return true;
    }
  }
  // A ball holds a small part of a leap, and is in vain where that meets nothing near by, as the
  // leap before did not.
  const bool isLeap = this->Near.IsLeap(to);
  if (isLeap && !this->Near.DoLeapsMeetNear())
  {
    if (this->Near.GatherSegment(to, budget))
    {
      this->Scan(to, active, hit);
      if (!hit ||
        !this->Near.MayHold(this->LocalPosition() + hit.Fraction * (to - this->LocalPosition())))
      {
        return true;
      }
    }
    this->Near.SetLeapsMeetNear(true);
  }
  // Another ball is worth while where the god-object has neared the rim of the old one.
  if (!this->Near.IsBallGatheredHere() && this->Near.GatherBallFor(to, budget))
  {
    this->Scan(to, active, hit);
    if (isAnswered())
    {
      return true;
    }
    if (isLeap)
    {
      this->Near.SetLeapsMeetNear(false);
    }
  }
  if (this->Near.HasBall() && this->Near.IsFarOut())
  {
    hit.Fraction = this->Near.FractionInBall(to);
    hit.IsWaypoint = true;
    return true;
  }
  if (!this->Near.GatherSegment(to, budget))
  {
    // Of more than fits the first may be near by.
    if (!this->Near.GatherBall(budget))
    {
      return false;
    }
    this->Scan(to, active, hit);
    return isAnswered();
  }
  this->Scan(to, active, hit);
  return true;
}

/// Whether a motion in the ball meets none of its facets, as their planes show.
bool WorkingSet::KeepsOffPlanes(const Vector& to, const ActivePlanes& active)
{
  if (!this->Near.HasBall() || !this->Near.IsInBall(to))
  {
    return false;
  }
  this->Near.RequireTarget(to);
  const FacetTable& facets = this->Facets();
  bool isClear = true;
  facets.VisitMet(
    [&](std::int32_t i)
    {
      // The facets that hold the god-object are among these. None is touched, nor, as Scan() has
      // it, met.
      const double there = facets.TargetDistance(i);
      isClear = there > facets.Error(i) &&
        (there >= std::min(0.5 * facets.Clearance(i), facets.Distance(i)) ||
          active.Has({ this->Index, facets.Triangle(i) }));
      return isClear;
    });
  return isClear;
}

/// Whether the facet is under x. Where it only reaches over a gap, what stands on the other lip of
/// the gap must not come down there; but along a plane under which the facet lies nothing comes
/// down: so a god-object that slides over the edge of a solid, or from one solid to the next, meets
/// none of the walls below.
bool WorkingSet::Covers(const FacetId& facet, const Vector& normal, double clearance,
  double wayError, const Vector& x, const ActivePlanes& planes) const
{
  Vector nearest;
  const Coverage coverage =
    this->Geometry().CoverageAt(facet.Triangle, normal, clearance, wayError, x, nearest);
  return coverage >= Coverage::Own ||
    (coverage == Coverage::Reach &&
      !planes.PassesOver(this->ToSurface.PointToScene(nearest), facet));
}

void FacetHit::Take(const FacetHit& other)
{
  if (!other || other.Fraction - other.Slack > this->Fraction + this->Slack)
  {
    return;
  }
  const bool isAtOnce =
    *this && other.Fraction + other.Slack >= this->Fraction - this->Slack && !other.IsWaypoint;
  if (isAtOnce && !this->IsWaypoint && other.Depth <= this->Depth)
  {
    this->Fraction = std::min(this->Fraction, other.Fraction);
    return;
  }
  const double first = std::min(this->Fraction, other.Fraction);
  *this = other;
  this->Fraction = first;
}

bool WorkingSet::FindSwept(const Vector& to, WorkBudget& budget, FacetHit& hit)
{
  this->IsSweepClear = false;
  if (!this->Near.GatherSwept(to, budget))
  {
    return false;
  }
  const TriangleList found = this->Near.Found();
  for (std::int32_t k = 0; k < found.Count; ++k)
  {
    this->Sweeps(found.Indices[k], to, hit);
  }
  this->Near.Facets().SetTarget(to);
  this->IsSweepClear = !hit;
  return true;
}

/// Whether a triangle may pass over the god-object, and does so before the hit, which it then is.
bool WorkingSet::Sweeps(std::int32_t triangle, const Vector& to, FacetHit& hit) const
{
  const auto [a0, b0, c0] = this->Geometry().CornersOf(triangle);
  const auto [a1, b1, c1] = this->Geometry().NextCornersOf(triangle);
  SweptTriangle swept;
  swept.From = { a0 - this->LocalPosition(), b0 - this->LocalPosition(),
    c0 - this->LocalPosition() };
  swept.To = { a1 - to, b1 - to, c1 - to };
  // 16 roundings of a coordinate: of the differences above, and of times that are halved.
  swept.Slack = this->Near.MinimumClearance() / 64.0;
  swept.IsOneSided = !this->Surface().TouchesBack(triangle);
  const double time = swept.TimeOfContact();
  if (time >= 1.0 || time > hit.Fraction)
  {
    return false;
  }
  Facet facet(swept.To[0], swept.To[1], swept.To[2]);
  if (!facet.HasArea())
  {
    facet = Facet(swept.From[0], swept.From[1], swept.From[2]);
    if (!facet.HasArea())
    {
      return false; // one without area is never touched
    }
  }
  const bool isFlipped = !swept.IsOneSided && Orientation(a0, b0, c0, this->LocalPosition()) < 0;
  const Vector normal = isFlipped ? -facet.Normal : facet.Normal;
  const double depth = glm::dot(normal, swept.To[0]);
  if (hit && time == hit.Fraction &&
    depth <= glm::dot(this->ToSurface.VectorToLocal(hit.Plane.Normal),
               this->ToSurface.PointToLocal(hit.Plane.Anchor) - to))
  {
    return false; // of those met at once the one most pressed against
  }
  hit.Fraction = time;
  hit.IsWaypoint = false;
  hit.Plane.Facet = { this->Index, triangle };
  hit.Plane.IsFlipped = isFlipped;
  hit.Plane.Normal = this->ToSurface.VectorToScene(normal);
  hit.Plane.Anchor = this->ToSurface.PointToScene(a1);
  hit.Plane.Clearance =
    facet.Clearance(this->Near.MinimumClearance(), glm::length(facet.Corner[facet.Anchor]));
  hit.Plane.IsFar = false;
  hit.Plane.IsOfWire = false;
  return true;
}

void WorkingSet::Scan(const Vector& to, const ActivePlanes& active, FacetHit& hit)
{
  FacetTable& facets = this->Near.Facets();
  this->Near.RequireTarget(to);
  const Vector way = to - this->LocalPosition();
  const double wayError = 16.0 * UnitRoundoff * glm::length(way);
  // The facets that are met first, all at once as far as that can be known.
  struct Meeting
  {
    std::int32_t Index;
    double Stop, Slack, There;
  };
  std::array<Meeting, LargestNumberAtOnce> meetings;
  int count = 0;
  double first = HUGE_VAL;
  double last = HUGE_VAL;
  const auto take = [&](std::int32_t i)
  {
    const double here = facets.Distance(i);
    const double there = facets.TargetDistance(i);
    const double clearance = facets.Clearance(i);
    // No farther than four clearances from a facet is it met, half a one over its plane.
    if (there >= std::min(0.5 * clearance, here) ||
      !facets.MeetsBox(i, to, 16.0 * clearance + 4.0 * wayError))
    {
      return;
    }
    const double approach = here - there;
    // Within two clearances is near enough: steps of rounding's size are not worth their check.
    const double stop = here <= 2.0 * clearance ? 0.0 : (here - clearance) / approach;
    const double slack = stop > 0.0 ? (SlackOfHeight * clearance + wayError) / approach : 0.0;
    if (stop - slack > last)
    {
      return;
    }
    const FacetId id{ this->Index, facets.Triangle(i) };
    const bool isActive = active.Has(id);
    if (isActive && there > 0.0)
    {
      return;
    }
    const Vector normal = facets.Normal(i);
    const double enter = std::max(0.0, (here - 0.5 * clearance) / approach);
    const double cross = std::clamp(here / approach, 0.0, 1.0);
    const auto coversAt = [&](double part)
    {
      const Vector x = this->LocalPosition() + part * way;
      return facets.IsInBox(i, x, FarthestCovered * clearance + 2.0 * wayError) &&
        this->Covers(id, normal, clearance, wayError, x, active);
    };
    if (!(!isActive && coversAt(enter)) && !(there <= 0.0 && coversAt(cross)))
    {
      return;
    }
    if (stop < first)
    {
      first = stop;
      last = stop + slack;
    }
    if (count == LargestNumberAtOnce)
    {
      const auto isLate = [last](const Meeting& m) { return m.Stop - m.Slack > last; };
      const auto end = std::remove_if(meetings.begin(), meetings.end(), isLate);
      count = std::min(static_cast<int>(end - meetings.begin()), LargestNumberAtOnce - 1);
    }
    meetings[count++] = { i, stop, slack, there };
  };
  facets.VisitMet(
    [&](std::int32_t i)
    {
      take(i);
      return true;
    });
  hit.Fraction = HUGE_VAL;
  const Meeting* chosen = nullptr;
  for (int k = 0; k < count; ++k)
  {
    const Meeting& m = meetings[k];
    if (m.Stop - m.Slack > last)
    {
      continue;
    }
    const double same = chosen ? SlackOfHeight * facets.Clearance(m.Index) + wayError : 0.0;
    if (!chosen || m.There < chosen->There - same ||
      (m.There <= chosen->There + same &&
        facets.Triangle(m.Index) < facets.Triangle(chosen->Index)))
    {
      chosen = &m;
    }
  }
  if (chosen)
  {
    const std::int32_t i = chosen->Index;
    const std::int32_t triangle = facets.Triangle(i);
    hit.Fraction = first;
    hit.IsWaypoint = false;
    hit.Slack = chosen->Slack;
    hit.Depth = -chosen->There - (SlackOfHeight * facets.Clearance(i) + wayError);
    hit.Plane.Facet = { this->Index, triangle };
    hit.Plane.IsFlipped = facets.IsFlipped(i);
    hit.Plane.Normal = this->ToSurface.VectorToScene(facets.NormalTowards(i));
    hit.Plane.Anchor = this->ToSurface.PointToScene(this->Geometry().CornersOf(triangle).A);
    hit.Plane.Clearance = facets.Clearance(i);
    hit.Plane.IsFar = this->Near.HasSegment();
    hit.Plane.IsOfWire = facets.IsOfWire(i);
  }
}

bool WorkingSet::IsClear(const Vector& target)
{
  const Vector to = this->ToSurface.PointToLocal(target);
  if (this->Geometry().IsSweeping())
  {
    return this->IsSweepClear && to == this->Facets().Target();
  }
  const bool isInBall = this->Near.HasBall() && this->Near.IsInBall(to);
  if ((isInBall && this->Facets().IsKnownClear(to)) || this->Near.GoesNowhere(to) ||
    this->Near.PassesThroughNothing(to))
  {
    return true;
  }
  if (this->Near.HasBall() && !isInBall)
  {
    return false; // short of the hit, but rounded to beyond it, where other triangles are
  }
  return this->Facets().IsKnownClear(to) || this->FindTouched(to) < 0;
}

bool WorkingSet::IsClearNear(const Vector& target, ActivePlane& inTheWay)
{
  const Vector to = this->ToSurface.PointToLocal(target);
  if (!this->Near.HasBall() || this->Geometry().IsSweeping() || !this->Near.IsInBall(to))
  {
    return false;
  }
  if (this->Near.PassesThroughNothing(to))
  {
    return true;
  }
  this->Near.RequirePosition();
  const std::int32_t i = this->Near.Facets().FindTouchedShort(to);
  if (i >= 0)
  {
    inTheWay.Facet = { this->Index, this->Facets().Triangle(i) };
    inTheWay.Normal = this->ToSurface.VectorToScene(this->Facets().NormalTowards(i));
  }
  return i < 0;
}

std::int32_t WorkingSet::FindTouched(const Vector& to)
{
  this->Near.RequirePosition();
  return this->Near.Facets().FindTouched(to);
}

void WorkingSet::Move()
{
  if (this->Geometry().IsSweeping())
  {
    this->Geometry().FinishSweep();
    this->Near.MoveSwept();
    return;
  }
  this->Near.Move();
}

void WorkingSet::Renew(ActivePlane& plane) const
{
  const auto [a, b, c] = this->Geometry().NextCornersOf(plane.Facet.Triangle);
  const Facet facet(a, b, c);
  if (facet.HasArea())
  {
    plane.Normal = this->ToSurface.VectorToScene(plane.IsFlipped ? -facet.Normal : facet.Normal);
  }
  plane.Anchor = this->ToSurface.PointToScene(a);
}

Vector WorkingSet::PointAfterSweep(const ActivePlane& plane) const
{
  return this->Geometry().PointAfterSweep(plane.Facet.Triangle, this->LocalPosition());
}

void WorkingSet::MoveTo(const Vector& place)
{
  this->Place(place);
  this->Geometry().FinishSweep();
}

/// `nearest` is in the local frame.
Coverage WorkingSet::CoverageAt(
  const ActivePlane& plane, const Vector& position, Vector& nearest) const
{
  const std::int32_t triangle = plane.Facet.Triangle;
  const double own = GrowthOverSharedEdges * plane.Clearance;
  const Vector x = this->ToSurface.PointToLocal(position);
  if (this->Known.Has(triangle, own, x))
  {
    return Coverage::Inside;
  }
  const Vector normal =
    this->ToSurface.VectorToLocal(plane.IsFlipped ? -plane.Normal : plane.Normal);
  const Coverage coverage =
    this->Geometry().CoverageAt(triangle, normal, plane.Clearance, 0.0, x, nearest);
  if (coverage == Coverage::Inside && this->Known.IsWorthLearning(triangle, own))
  {
    this->LearnInside(triangle, normal, plane.Clearance);
  }
  return coverage;
}

/// Not of a facet so thin that its plane is another one each time it is met.
void WorkingSet::LearnInside(std::int32_t triangle, const Vector& normal, double clearance) const
{
  const auto [a, b, c] = this->Geometry().CornersOf(triangle);
  if (!this->Surface().Deforms() && Facet(a, b, c).SmallestHeight >= clearance)
  {
    this->Known.Learn(normal, a, b, c);
  }
}

bool WorkingSet::Covers(const ActivePlane& plane, const Vector& position,
  const ActivePlanes& planes, bool& isInside) const
{
  Vector nearest;
  const Coverage coverage = this->CoverageAt(plane, position, nearest);
  isInside = coverage == Coverage::Inside;
  return coverage >= Coverage::Own ||
    (coverage == Coverage::Reach &&
      !planes.PassesOver(this->ToSurface.PointToScene(nearest), plane.Facet));
}

bool WorkingSet::FindNextNormal(const ActivePlane& plane, const Vector& from, const Vector& to,
  Vector& normal, double& fraction) const
{
  const Vector x = this->ToSurface.PointToLocal(from);
  const std::int32_t next = this->Geometry().NextTriangle(
    plane.Facet.Triangle, x, this->ToSurface.PointToLocal(to) - x, fraction);
  if (next < 0)
  {
    return false;
  }
  const auto [a, b, c] = this->Geometry().CornersOf(next);
  const Vector n = glm::cross(b - a, c - a);
  const double length = glm::length(n);
  if (!(length > 0.0))
  {
    return false;
  }
  normal = this->ToSurface.VectorToScene((plane.IsFlipped ? -1.0 : 1.0) / length * n);
  return true;
}

bool WorkingSet::StandsInWay(const ActivePlane& plane, const Vector& goal, bool isNew) const
{
  const Vector normal = this->ToSurface.VectorToLocal(plane.Normal);
  const auto [a, b, c] = this->Geometry().CornersOf(plane.Facet.Triangle);
  const Vector to = this->ToSurface.PointToLocal(goal);
  const double here = glm::dot(normal, this->LocalPosition() - a);
  const double there = glm::dot(normal, to - a);
  if (!(here > ActivePlane::CertainHeight * plane.Clearance) || !(there < -plane.Clearance))
  {
    return false;
  }
  const Vector way = to - this->LocalPosition();
  const Vector onPlane = this->LocalPosition() + (here / (here - there)) * way;
  const Vector byOrder = plane.IsFlipped ? -normal : normal;
  const double wayError = 16.0 * UnitRoundoff * glm::length(way);
  if (!isNew)
  {
    return this->Geometry().IsInside(
      plane.Facet.Triangle, byOrder, plane.Clearance, wayError, onPlane);
  }
  Vector nearest;
  const Coverage coverage = this->Geometry().CoverageAt(
    plane.Facet.Triangle, byOrder, plane.Clearance, wayError, onPlane, nearest);
  return coverage == Coverage::Inside ||
    (coverage == Coverage::Own && Facet(a, b, c).SmallestHeight < plane.Clearance);
}

bool WorkingSet::TouchesAgain(const Vector& goal) const
{
  return !this->Geometry().IsSweeping() && this->Near.HasBall() &&
    this->Facets().StillTouches(this->ToSurface.PointToLocal(goal));
}

bool WorkingSet::IsOpen(const Vector& goal, WorkBudget& budget, NarrowGap& gap)
{
  const Vector to = this->ToSurface.PointToLocal(goal);
  if (this->Geometry().IsSweeping() || this->Near.IsFarOut())
  {
    return false;
  }
  if (this->Near.PassesThroughNothing(to))
  {
    return true;
  }
  if (this->Near.HasBall() && (this->Facets().StillTouches(to) || this->FindTouched(to) >= 0))
  {
    return false;
  }
  if ((!this->Near.HasBall() || !this->Near.IsInBall(to)) &&
    (!this->Near.GatherSegment(to, budget) || this->FindTouched(to) >= 0))
  {
    return false;
  }
  const FacetTable& facets = this->Facets();
  for (std::int32_t i = 0; i < facets.Size(); ++i)
  {
    const double width = WidthOfGaps * facets.Clearance(i);
    if (facets.MeetsBox(i, to, 2.0 * width))
    {
      const std::int32_t triangle = facets.Triangle(i);
      const auto [a, b, c] = this->Geometry().CornersOf(triangle);
      gap.Add(this->ToSurface.PointToScene(a), this->ToSurface.PointToScene(b),
        this->ToSurface.PointToScene(c),
        { this->Geometry().IsOpenEdge(triangle, 0), this->Geometry().IsOpenEdge(triangle, 1),
          this->Geometry().IsOpenEdge(triangle, 2) },
        width);
    }
  }
  return true;
}

bool WorkingSet::IsPassedOver(
  const ActivePlane& plane, const Vector& position, const ActivePlane& other) const
{
  Vector nearest;
  return this->CoverageAt(plane, position, nearest) == Coverage::Reach &&
    other.PassesOver(this->ToSurface.PointToScene(nearest));
}

FacetAlong WorkingSet::FindAlong(const Vector& normal, double near, double far, WorkBudget& budget)
{
  FacetAlong best;
  if (this->Geometry().IsSweeping())
  {
    return best;
  }
  if (!this->Near.HoldsAllWithin(far) && !this->Near.IsBallGatheredHere() &&
    !this->Near.GatherBall(budget))
  {
    return best;
  }
  const FacetTable& facets = this->Facets();
  const Vector& position = this->LocalPosition();
  const Vector up = this->ToSurface.VectorToLocal(normal);
  double nearest = HUGE_VAL;
  for (std::int32_t i = 0; i < facets.Size(); ++i)
  {
    if (!facets.MeetsBox(i, position, far))
    {
      continue;
    }
    const std::int32_t triangle = facets.Triangle(i);
    double cosine = glm::dot(facets.Normal(i), up);
    cosine = this->Surface().TouchesBack(triangle) ? std::abs(cosine) : cosine;
    const auto [a, b, c] = this->Geometry().CornersOf(triangle);
    const Vector way = NearestToOrigin(a - position, b - position, c - position);
    if (cosine <= 0.0 || glm::dot(way, up) >= 0.0)
    {
      continue;
    }
    const double distance = glm::length(way);
    const double weight = Fall(distance, near, far) *
      Fall(1.0 - cosine * cosine, SquaredSineOfParallels, SquaredSineOfOthers);
    // Where several count as much, it is the one under the god-object.
    if (weight > best.Weight || (weight == best.Weight && weight > 0.0 && distance < nearest))
    {
      best = { triangle, weight };
      nearest = distance;
    }
  }
  return best;
}

std::array<Vec3, 2> WorkingSet::WeightGradients(std::int32_t triangle) const
{
  const auto [second, third] = this->Geometry().WeightGradients(triangle);
  return { ToVec3(this->ToSurface.VectorToScene(second)),
    ToVec3(this->ToSurface.VectorToScene(third)) };
}
}
