#include "haptics/Contact/WorkingSet.h"

#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/Predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics
{
namespace
{
/// Heights that differ by less than so many clearances may do so by rounding.
constexpr double SlackOfHeight = 1.0 / 16.0;
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

WorkingSet::WorkingSet(
  std::shared_ptr<const TriangleSurface> surface, std::int32_t index, const SurfaceFrame& frame)
  : Touched(std::move(surface))
  , Index(index)
  , ToSurface(frame)
  , Now(this->Touched->Deforms() ? 0.0 : 1.0)
  , Next(this->Now)
  , RadiusToTry(this->Touched->Radius())
{
  this->KeepClearOfRounding();
  const std::size_t capacity =
    std::min<std::size_t>(LargestNumberOfTriangles, this->Touched->Triangles().size());
  this->Found.resize(capacity);
  this->Triangles.resize(capacity);
  this->Flipped.resize(capacity);
  this->Widths.resize(capacity);
  for (auto* values :
    { &this->NormalX, &this->NormalY, &this->NormalZ, &this->PlaneOffset, &this->Error,
      &this->Clearance, &this->Distance, &this->TargetDistance, &this->Limit, &this->Low[0],
      &this->Low[1], &this->Low[2], &this->High[0], &this->High[1], &this->High[2] })
  {
    values->resize(capacity);
  }
}

/// Positions are rounded in the scene frame, which may be far from this surface.
void WorkingSet::KeepClearOfRounding()
{
  this->MinimumClearance = std::max(this->Touched->Clearance(),
    1024.0 * UnitRoundoff * (glm::length(this->ToSurface.Origin()) + this->Touched->Radius()));
  this->Reach = LargestGrowth(this->MinimumClearance, this->Touched->Radius());
}

void WorkingSet::SetFrame(const SurfaceFrame& frame)
{
  this->ToSurface = frame;
  this->IsTargetMeasured = false;
  const double farthest = this->MinimumClearance / (1024.0 * UnitRoundoff);
  if (glm::length(frame.Origin()) + this->Touched->Radius() > farthest)
  {
    this->KeepClearOfRounding();
    // Twice as far, so that one that goes on does not come here in every tick.
    this->MinimumClearance *= 2.0;
    this->Reach *= 2.0;
    this->Covered = Region::Nothing;
    this->EmptyRadius = 0.0;
  }
}

void WorkingSet::Place(const Vector& position)
{
  this->Position = this->ToSurface.PointToLocal(position);
  this->Covered = Region::Nothing;
}

void WorkingSet::Return(const Vector& local)
{
  this->Position = local;
  this->Covered = Region::Nothing;
}

void WorkingSet::Restart(const Vector& position)
{
  this->EmptyRadius = 0.0;
  this->RadiusToTry = this->Touched->Radius();
  this->LargestToTry = HUGE_VAL;
  this->MostInBall = FewInBall;
  this->Place(position);
  this->GatheredAt = this->Position;
}

void WorkingSet::Continue(const WorkingSet& previous)
{
  this->MinimumClearance = std::max(this->MinimumClearance, previous.MinimumClearance);
  this->Reach = std::max(this->Reach, previous.Reach);
  this->Position = previous.Position;
  this->Covered = Region::Nothing;
  if (this->Touched == previous.Touched)
  {
    this->Now = previous.Now;
    this->Next = this->Now;
    this->Elapsed = previous.Elapsed;
  }
  // What it has learned of the surface.
  this->RadiusToTry = previous.RadiusToTry;
  this->LargestToTry = previous.LargestToTry;
  this->MostInBall = previous.MostInBall;
}

bool WorkingSet::IsEmptyAround(const Vector& x) const
{
  return this->EmptyRadius > 0.0 &&
    SquaredLength(x - this->EmptyCentre) < this->EmptyRadius * this->EmptyRadius;
}

bool WorkingSet::PassesThroughNothing(const Vector& to)
{
  const bool isEmpty =
    this->Covered == Region::Ball && this->IsEmptyAround(this->Position) && this->IsEmptyAround(to);
  if (isEmpty)
  {
    this->Target = to;
    this->IsTargetMeasured = false;
  }
  return isEmpty;
}

bool WorkingSet::IsInBall(const Vector& x) const
{
  return SquaredLength(x - this->Centre) <= this->Radius * this->Radius;
}

bool WorkingSet::IsFarOut() const
{
  const double far = 8.0 * this->Touched->Radius();
  return SquaredLength(this->Position) > far * far;
}

bool WorkingSet::FindFirstHit(
  const Vector& goal, const ActivePlanes& active, WorkBudget& budget, FacetHit& hit)
{
  const Vector to = this->ToSurface.PointToLocal(goal);
  if (this->IsSweeping())
  {
    return this->FindSwept(to, budget, hit);
  }
  if (this->PassesThroughNothing(to))
  {
    return true;
  }
  const auto isAnswered = [&]
  {
    // All triangles in the ball are known: a hit inside it is the first of the whole way.
    return this->IsInBall(to) ||
      (hit && this->IsInBall(this->Position + hit.Fraction * (to - this->Position)));
  };
  if (this->Covered == Region::Ball)
  {
    hit = this->Scan(to, active);
    if (isAnswered())
    {
      return true;
    }
  }
  // Another ball is worth while where the god-object has neared the rim of the old one.
  const bool isGatheredHere = this->Covered == Region::Ball && this->GatheredAt == this->Position;
  if (!isGatheredHere && this->GatherBall(budget))
  {
    hit = this->Scan(to, active);
    if (isAnswered())
    {
      return true;
    }
  }
  if (this->Covered == Region::Ball && this->IsFarOut())
  {
    const double fraction = this->Radius / glm::length(to - this->Position);
    hit.Fraction = fraction * (1.0 - 0x1p-40);
    hit.IsWaypoint = true;
    return true;
  }
  if (!this->GatherSegment(to, budget))
  {
    return false;
  }
  hit = this->Scan(to, active);
  return true;
}

/// `normal` is the facet's, by the order of its corners; `nearest`: see CoverageOf().
Coverage WorkingSet::CoverageAt(std::int32_t triangle, const Vector& normal, double clearance,
  double wayError, const Vector& x, Vector& nearest) const
{
  const auto [a, b, c] = this->CornersOf(triangle);
  return CoverageOf(
    normal, a, b, c, x, GrowthOverSharedEdges * clearance + wayError,
    GrowthOverGaps * clearance + wayError,
    [&](int edge) { return this->IsOpenEdge(triangle, edge); }, nearest);
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
    this->CoverageAt(facet.Triangle, normal, clearance, wayError, x, nearest);
  return coverage >= Coverage::Own ||
    (coverage == Coverage::Reach &&
      !planes.PassesOver(this->ToSurface.PointToScene(nearest), facet));
}

void WorkingSet::Measure(const Vector& x, std::vector<double>& distances) const
{
  const Vector d = x - this->Centre;
  const double* const nx = this->NormalX.data();
  const double* const ny = this->NormalY.data();
  const double* const nz = this->NormalZ.data();
  const double* const offset = this->PlaneOffset.data();
  double* const out = distances.data();
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    out[i] = nx[i] * d.x + ny[i] * d.y + nz[i] * d.z - offset[i];
  }
}

void WorkingSet::MeasurePosition()
{
  this->Measure(this->Position, this->Distance);
  this->IsPositionMeasured = true;
  this->TurnToPosition();
  this->SetLimits();
}

void WorkingSet::MeasureTarget(const Vector& to)
{
  this->Target = to;
  this->Measure(to, this->TargetDistance);
  this->IsTargetMeasured = true;
  this->IsTargetClear = false;
}

void WorkingSet::TurnToPosition()
{
  if (this->HasThin)
  {
    this->TurnThin();
  }
  if (this->Touched->TouchedSide() == Side::Front)
  {
    return;
  }
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (this->Distance[i] > this->Error[i] || this->Widths[i] != Width::Broad ||
      !this->Touched->TouchesBack(this->Triangles[i]))
    {
      continue;
    }
    bool isBehind = this->Distance[i] < 0.0;
    if (std::abs(this->Distance[i]) <= this->Error[i])
    {
      const auto [a, b, c] = this->CornersOf(this->Triangles[i]);
      const int side = Orientation(a, b, c, this->Position);
      isBehind = (this->Flipped[i] ? -side : side) < 0;
    }
    if (isBehind)
    {
      this->Flipped[i] ^= 1;
      for (auto* values :
        { &this->NormalX, &this->NormalY, &this->NormalZ, &this->PlaneOffset, &this->Distance })
      {
        (*values)[i] = -(*values)[i];
      }
    }
  }
}

void WorkingSet::TurnThin()
{
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (this->Widths[i] == Width::Broad)
    {
      continue;
    }
    const auto [a, b, c] = this->CornersOf(this->Triangles[i]);
    const bool isBehind = Orientation(a, b, c, this->Position) < 0;
    this->Flipped[i] = isBehind && this->Touched->TouchesBack(this->Triangles[i]) ? 1 : 0;
    if (this->Widths[i] == Width::Seam)
    {
      this->Distance[i] = -std::numeric_limits<double>::max(); // nothing meets it
      continue;
    }
    const Facet facet(a, b, c);
    const Vector& anchor = facet.Corner[facet.Anchor];
    const Vector along =
      glm::normalize(facet.Corner[(facet.Anchor + 2) % 3] - facet.Corner[(facet.Anchor + 1) % 3]);
    const Vector from = this->Position - anchor;
    const Vector across = from - glm::dot(from, along) * along;
    const double distance = glm::length(across);
    // Nearer than rounding the direction is not known. Else what rounding of a longer way along the
    // line has left of that is taken out.
    const bool isKnown = distance > 0.125 * this->Clearance[i];
    const Vector normal = isKnown
      ? glm::normalize(across / distance - glm::dot(across / distance, along) * along)
      : (isBehind ? -facet.Normal : facet.Normal);
    this->NormalX[i] = normal.x;
    this->NormalY[i] = normal.y;
    this->NormalZ[i] = normal.z;
    this->PlaneOffset[i] = glm::dot(normal, anchor - this->Centre);
    // What is behind one that has only a front may go where it wants.
    this->Distance[i] = isBehind && !this->Touched->TouchesBack(this->Triangles[i])
      ? -std::numeric_limits<double>::max()
      : glm::dot(normal, from);
  }
}

/// `nearest`: no gathered triangle is nearer to the god-object.
void WorkingSet::GrowEmptyBall(double nearest)
{
  const double rim = this->Radius - glm::length(this->Position - this->Centre);
  const double radius = std::min(nearest - this->Reach, rim);
  if (radius > this->EmptyRadius - glm::length(this->Position - this->EmptyCentre))
  {
    this->EmptyCentre = this->Position;
    this->EmptyRadius = radius;
  }
}

void WorkingSet::SetLimits()
{
  const double* const distance = this->Distance.data();
  const double* const error = this->Error.data();
  const double* const clearance = this->Clearance.data();
  double* const limit = this->Limit.data();
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const double half = 0.5 * clearance[i];
    const double least = half < distance[i] ? half : distance[i];
    const double value = least > error[i] ? least : error[i];
    limit[i] = distance[i] < -error[i] ? -HUGE_VAL : value;
  }
  if (this->Covered != Region::Ball)
  {
    return;
  }
  double nearest = HUGE_VAL;
  for (std::int32_t i = 0; i < this->Count && nearest > this->Reach; ++i)
  {
    nearest = std::min(nearest, std::abs(distance[i]) - error[i]);
  }
  // No triangle is nearer than its plane.
  if (nearest > this->Reach)
  {
    this->GrowEmptyBall(nearest);
  }
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

FacetHit WorkingSet::Scan(const Vector& to, const ActivePlanes& active)
{
  if (!this->IsPositionMeasured)
  {
    this->MeasurePosition();
  }
  this->MeasureTarget(to);
  const Vector way = to - this->Position;
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
  const double* const after = this->TargetDistance.data();
  const double* const limit = this->Limit.data();
  const std::int32_t gathered = this->Count;
  bool isClear = true;
  for (std::int32_t i = 0; i < gathered; ++i)
  {
    if (after[i] > limit[i])
    {
      continue;
    }
    isClear = false;
    const double here = this->Distance[i];
    const double there = this->TargetDistance[i];
    const double clearance = this->Clearance[i];
    // No farther than four clearances from a facet is it met, half a one over its plane.
    if (there >= std::min(0.5 * clearance, here) ||
      !this->MeetsBox(i, to, 16.0 * clearance + 4.0 * wayError))
    {
      continue;
    }
    const double approach = here - there;
    // Within two clearances is near enough: steps of rounding's size are not worth their check.
    const double stop = here <= 2.0 * clearance ? 0.0 : (here - clearance) / approach;
    const double slack = stop > 0.0 ? (SlackOfHeight * clearance + wayError) / approach : 0.0;
    if (stop - slack > last)
    {
      continue;
    }
    const FacetId id{ this->Index, this->Triangles[i] };
    const bool isActive = active.Has(id);
    if (isActive && there > 0.0)
    {
      continue;
    }
    const Vector normal = this->FacetNormal(i);
    const double enter = std::max(0.0, (here - 0.5 * clearance) / approach);
    const double cross = std::clamp(here / approach, 0.0, 1.0);
    const bool meets =
      (!isActive &&
        this->Covers(id, normal, clearance, wayError, this->Position + enter * way, active)) ||
      (there <= 0.0 &&
        this->Covers(id, normal, clearance, wayError, this->Position + cross * way, active));
    if (!meets)
    {
      continue;
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
  }
  this->IsTargetClear = isClear;
  FacetHit hit;
  const Meeting* chosen = nullptr;
  for (int k = 0; k < count; ++k)
  {
    const Meeting& m = meetings[k];
    if (m.Stop - m.Slack > last)
    {
      continue;
    }
    const double same = chosen ? SlackOfHeight * this->Clearance[m.Index] + wayError : 0.0;
    if (!chosen || m.There < chosen->There - same ||
      (m.There <= chosen->There + same &&
        this->Triangles[m.Index] < this->Triangles[chosen->Index]))
    {
      chosen = &m;
    }
  }
  if (chosen)
  {
    const std::int32_t i = chosen->Index;
    const std::int32_t triangle = this->Triangles[i];
    const Vector normal = this->FacetNormal(i);
    hit.Fraction = first;
    hit.Slack = chosen->Slack;
    hit.Depth = -chosen->There - (SlackOfHeight * this->Clearance[i] + wayError);
    hit.Plane.Facet = { this->Index, triangle };
    hit.Plane.IsFlipped = this->Flipped[i];
    hit.Plane.Normal = this->ToSurface.VectorToScene(this->Flipped[i] ? -normal : normal);
    hit.Plane.Anchor = this->ToSurface.PointToScene(this->CornersOf(triangle).A);
    hit.Plane.Clearance = this->Clearance[i];
    hit.Plane.IsFar = this->Covered == Region::Segment;
    hit.Plane.IsOfWire = this->Widths[i] == Width::Wire && this->HasOpenEdge(triangle);
  }
  return hit;
}

bool WorkingSet::IsClear(const Vector& target)
{
  const Vector to = this->ToSurface.PointToLocal(target);
  if (this->IsSweeping())
  {
    return this->IsSweepClear && to == this->Target;
  }
  if (this->PassesThroughNothing(to))
  {
    return true;
  }
  if (this->Covered == Region::Ball && !this->IsInBall(to))
  {
    return false; // short of the hit, but rounded to beyond it, where other triangles are
  }
  const bool isKnown = this->IsTargetMeasured && this->IsTargetClear && to == this->Target;
  return isKnown || !this->MeetsAny(to);
}

bool WorkingSet::IsClearNear(const Vector& target, ActivePlane& inTheWay)
{
  const Vector to = this->ToSurface.PointToLocal(target);
  if (this->Covered != Region::Ball || this->IsSweeping() || !this->IsInBall(to))
  {
    return false;
  }
  if (this->PassesThroughNothing(to))
  {
    return true;
  }
  const std::int32_t i = this->FindTouched(to);
  if (i >= 0)
  {
    const Vector normal = this->FacetNormal(i);
    inTheWay.Facet = { this->Index, this->Triangles[i] };
    inTheWay.Normal = this->ToSurface.VectorToScene(this->Flipped[i] ? -normal : normal);
  }
  return i < 0;
}

WorkingSet::Rims WorkingSet::FindRimsNear(double clearances)
{
  std::array<std::int32_t, 8> found;
  std::size_t count = 0;
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const std::int32_t triangle = this->Triangles[i];
    const double reach = clearances * this->Clearance[i];
    if (!this->HasOpenEdge(triangle) || !this->MeetsBox(i, this->Position, reach))
    {
      continue;
    }
    const auto [a, b, c] = this->CornersOf(triangle);
    const Vector* const corners[4] = { &a, &b, &c, &a };
    bool isNear = false;
    for (int k = 0; k < 3; ++k)
    {
      const Vector nearest = NearestOnSegment(*corners[k], *corners[k + 1], this->Position);
      isNear = isNear ||
        (this->IsOpenEdge(triangle, k) && SquaredLength(nearest - this->Position) <= reach * reach);
    }
    if (!isNear)
    {
      continue;
    }
    const auto& ends = this->Touched->Triangles()[triangle];
    const bool isJoined = std::all_of(found.begin(), found.begin() + count,
      [&](std::int32_t other)
      {
        const auto& others = this->Touched->Triangles()[other];
        return std::find_first_of(ends.begin(), ends.end(), others.begin(), others.end()) !=
          ends.end();
      });
    if (!isJoined || count == found.size())
    {
      return Rims::Apart;
    }
    found[count++] = triangle;
  }
  return count > 0 ? Rims::Joined : Rims::None;
}

/// Whether the way to `to` meets a gathered triangle.
bool WorkingSet::MeetsAny(const Vector& to)
{
  return this->FindTouched(to) >= 0;
}

std::int32_t WorkingSet::FindTouched(const Vector& to)
{
  if (!this->IsPositionMeasured)
  {
    this->MeasurePosition();
  }
  if (!this->IsTargetMeasured || to != this->Target)
  {
    this->MeasureTarget(to);
  }
  const double* const before = this->Distance.data();
  const double* const after = this->TargetDistance.data();
  const double* const error = this->Error.data();
  const std::int32_t count = this->Count;
  for (std::int32_t i = 0; i < count; ++i)
  {
    // Asked first whether it may end behind: few motions do.
    if (after[i] <= error[i] && before[i] >= -error[i] && this->MeetsBox(i, to, 0.0) &&
      this->Touches(i, after[i], to))
    {
      this->LastTouched = i;
      return i;
    }
  }
  return -1;
}

bool WorkingSet::StillTouches(const Vector& to) const
{
  const std::int32_t i = this->LastTouched;
  if (i < 0 || !this->IsPositionMeasured || !(this->Distance[i] >= -this->Error[i]))
  {
    return false;
  }
  const Vector d = to - this->Centre;
  const double after =
    this->NormalX[i] * d.x + this->NormalY[i] * d.y + this->NormalZ[i] * d.z - this->PlaneOffset[i];
  return after <= this->Error[i] && this->MeetsBox(i, to, 0.0) && this->Touches(i, after, to);
}

/// `distance`: of `to` from the triangle's plane, as measured.
bool WorkingSet::Touches(std::int32_t i, double distance, const Vector& to) const
{
  const Vector& from = this->Position;
  auto [a, b, c] = this->CornersOf(this->Triangles[i]);
  if (this->Flipped[i])
  {
    std::swap(b, c);
  }
  const int before = this->Distance[i] > this->Error[i] ? 1 : Orientation(a, b, c, from);
  if (before < 0)
  {
    return false;
  }
  const int after = distance < -this->Error[i] ? -1 : Orientation(a, b, c, to);
  if (after > 0 || (before == 0 && after == 0))
  {
    return false;
  }
  return LineMeetsTriangle(from, to, a, b, c);
}

void WorkingSet::Move()
{
  if (this->IsSweeping())
  {
    this->MoveSwept();
    return;
  }
  this->Position = this->Target;
  if (this->Covered == Region::Segment)
  {
    this->Covered = Region::Nothing;
    return;
  }
  this->IsPositionMeasured = this->IsTargetMeasured;
  if (this->IsTargetMeasured)
  {
    std::swap(this->Distance, this->TargetDistance);
    this->IsTargetMeasured = false;
    this->TurnToPosition();
    this->SetLimits();
  }
}

/// `nearest` is in the local frame.
Coverage WorkingSet::CoverageAt(
  const ActivePlane& plane, const Vector& position, Vector& nearest) const
{
  const Vector normal =
    this->ToSurface.VectorToLocal(plane.IsFlipped ? -plane.Normal : plane.Normal);
  return this->CoverageAt(plane.Facet.Triangle, normal, plane.Clearance, 0.0,
    this->ToSurface.PointToLocal(position), nearest);
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

bool WorkingSet::FindNextNormal(
  const ActivePlane& plane, const Vector& from, const Vector& to, Vector& normal) const
{
  const std::int32_t triangle = plane.Facet.Triangle;
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector* const corners[4] = { &a, &b, &c, &a };
  const Vector up = glm::cross(b - a, c - a);
  const Vector x = this->ToSurface.PointToLocal(from);
  const Vector way = this->ToSurface.PointToLocal(to) - x;
  double first = HUGE_VAL;
  std::int32_t next = BoundaryEdge;
  for (int k = 0; k < 3; ++k)
  {
    const Vector outwards = glm::cross(*corners[k + 1] - *corners[k], up);
    const double speed = glm::dot(outwards, way);
    const double left = -glm::dot(outwards, x - *corners[k]);
    if (speed > 0.0 && left < first * speed)
    {
      first = left / speed;
      next = this->Touched->AdjacentTriangles()[triangle][k];
    }
  }
  if (next < 0)
  {
    return false;
  }
  const auto [d, e, f] = this->CornersOf(next);
  const Vector n = glm::cross(e - d, f - d);
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
  const auto [a, b, c] = this->CornersOf(plane.Facet.Triangle);
  const Vector to = this->ToSurface.PointToLocal(goal);
  const double here = glm::dot(normal, this->Position - a);
  const double there = glm::dot(normal, to - a);
  if (!(here > ActivePlane::CertainHeight * plane.Clearance) || !(there < -plane.Clearance))
  {
    return false;
  }
  const Vector x = this->Position + (here / (here - there)) * (to - this->Position);
  Vector nearest;
  const Coverage coverage =
    this->CoverageAt(plane.Facet.Triangle, plane.IsFlipped ? -normal : normal, plane.Clearance,
      16.0 * UnitRoundoff * glm::length(to - this->Position), x, nearest);
  return coverage == Coverage::Inside ||
    (isNew && coverage == Coverage::Own && Facet(a, b, c).SmallestHeight < plane.Clearance);
}

bool WorkingSet::IsOpen(const Vector& goal, WorkBudget& budget, NarrowGap& gap)
{
  const Vector to = this->ToSurface.PointToLocal(goal);
  if (this->IsSweeping() || this->IsFarOut())
  {
    return false;
  }
  if (this->PassesThroughNothing(to))
  {
    return true;
  }
  if (this->Covered == Region::Ball && (this->StillTouches(to) || this->MeetsAny(to)))
  {
    return false;
  }
  if ((this->Covered != Region::Ball || !this->IsInBall(to)) &&
    (!this->GatherSegment(to, budget) || this->MeetsAny(to)))
  {
    return false;
  }
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const double width = WidthOfGaps * this->Clearance[i];
    if (this->MeetsBox(i, to, 2.0 * width))
    {
      const std::int32_t triangle = this->Triangles[i];
      const auto [a, b, c] = this->CornersOf(triangle);
      gap.Add(this->ToSurface.PointToScene(a), this->ToSurface.PointToScene(b),
        this->ToSurface.PointToScene(c),
        { this->IsOpenEdge(triangle, 0), this->IsOpenEdge(triangle, 1),
          this->IsOpenEdge(triangle, 2) },
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
  if (this->IsSweeping())
  {
    return best;
  }
  const bool isBall = this->Covered == Region::Ball;
  const bool isKnown = isBall && glm::length(this->Position - this->Centre) + far <= this->Radius;
  const bool isGatheredHere = isBall && this->GatheredAt == this->Position;
  if (!isKnown && !isGatheredHere && !this->GatherBall(budget))
  {
    return best;
  }
  const Vector up = this->ToSurface.VectorToLocal(normal);
  double nearest = HUGE_VAL;
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (!this->MeetsBox(i, this->Position, far))
    {
      continue;
    }
    const std::int32_t triangle = this->Triangles[i];
    double cosine = glm::dot(this->FacetNormal(i), up);
    cosine = this->Touched->TouchesBack(triangle) ? std::abs(cosine) : cosine;
    const auto [a, b, c] = this->CornersOf(triangle);
    const Vector way = NearestToOrigin(a - this->Position, b - this->Position, c - this->Position);
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
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector normal = glm::cross(b - a, c - a);
  const double squared = glm::dot(normal, normal);
  if (!(squared > 0.0))
  {
    return {};
  }
  const auto inScene = [this, squared](const Vector& v)
  { return ToVec3(this->Frame().VectorToScene(v / squared)); };
  return { inScene(glm::cross(c - a, normal)), inScene(glm::cross(normal, b - a)) };
}

std::array<double, 3> WorkingSet::CornerWeights(std::int32_t triangle) const
{
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector normal = glm::cross(b - a, c - a);
  std::array<double, 3> weights = { glm::dot(normal, glm::cross(c - b, this->Position - b)),
    glm::dot(normal, glm::cross(a - c, this->Position - c)),
    glm::dot(normal, glm::cross(b - a, this->Position - a)) };
  for (double& weight : weights)
  {
    weight = std::max(weight, 0.0); // a clearance beyond an edge
  }
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0.0))
  {
    return { 1.0, 0.0, 0.0 };
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}
}
