#include "WorkingSet.h"

#include "FacetBatch.h"
#include "Predicates.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Most triangles that one gathering holds: more meet in no point of any surface seen, and fewer
/// would leave the tip of a finely cut cone out of touch.
constexpr std::int32_t LargestSet = 1 << 15;
/// An engine that finds more in a ball is stopped, and a ball of half the radius is tried. Where
/// even the smallest ball has more, as near the tip of a fan, more are let through.
constexpr std::int32_t FewInBall = 64;
/// About as many make gathering rare and scanning quick.
constexpr double WantedInBall = 16.0;
/// How far ahead of the god-object a ball is centred, in radii.
constexpr double Lead = 0.5;

void Prefetch(const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
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
  const std::size_t capacity = std::min<std::size_t>(LargestSet, this->Touched->Triangles().size());
  this->Found.resize(capacity);
  this->Triangles.resize(capacity);
  this->Flipped.resize(capacity);
  for (auto* values : { &this->NormalX, &this->NormalY, &this->NormalZ, &this->PlaneOffset,
         &this->Error, &this->Clearance, &this->Distance, &this->TargetDistance, &this->Limit })
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

bool WorkingSet::GatherBall(WorkBudget& budget)
{
  this->Covered = Region::Nothing;
  const Vector moved = this->Position - this->GatheredAt;
  this->GatheredAt = this->Position;
  const double surfaceRadius = this->Touched->Radius();
  const double fromOrigin = glm::length(this->Position);
  if (fromOrigin > 1.5 * surfaceRadius)
  {
    // No triangle is this far out.
    this->Centre = this->Position;
    this->Radius = (fromOrigin - surfaceRadius) * (1.0 - 0x1p-40);
    this->RadiusToTry = surfaceRadius;
    this->Count = 0;
    this->FoundCount = 0;
    this->EmptyCentre = this->Position;
    this->EmptyRadius = this->Radius;
    this->MeasurePosition();
    this->Covered = Region::Ball;
    return true;
  }
  const auto capacity = static_cast<std::int32_t>(this->Found.size());
  const double lead = glm::length(moved);
  double radius = this->RadiusToTry;
  const double smallest = 0x1p-20 * surfaceRadius;
  while (budget.Triangles > 0)
  {
    // Ahead of a steady motion, so that the ball serves longer.
    const bool isSteady = lead > 0.0 && lead < 2.0 * radius;
    this->Centre = this->Position + (isSteady ? Lead * radius / lead : 0.0) * moved;
    TriangleList found{ this->Found.data(), std::min(capacity, this->MostInBall) };
    this->Touched->Engine().FindInBall(ToVec3(this->Centre), radius, found);
    budget.Triangles -= found.Count;
    if (!found.Overflow)
    {
      this->Radius = radius * (1.0 - 0x1p-40);
      this->Fill(found, this->Centre, radius, radius);
      this->Covered = Region::Ball;
      const double change = std::sqrt(WantedInBall / (this->Count + 1.0));
      // A surface of small triangles comes into a growing ball all at once: a radius that was too
      // large is not tried again soon.
      this->LargestToTry *= 1.05;
      this->RadiusToTry =
        std::min({ radius * std::clamp(change, 0.5, 4.0), surfaceRadius, this->LargestToTry });
      if (found.Count < this->MostInBall / 4)
      {
        this->MostInBall = std::max(FewInBall, this->MostInBall / 2);
      }
      return true;
    }
    if (radius > smallest)
    {
      this->LargestToTry = 0.7 * radius;
      radius *= 0.5;
    }
    else if (this->MostInBall < capacity)
    {
      this->MostInBall *= 4;
      this->LargestToTry = HUGE_VAL;
    }
    else
    {
      return false;
    }
  }
  return false;
}

bool WorkingSet::GatherSegment(const Vector& to, WorkBudget& budget)
{
  this->Covered = Region::Nothing;
  this->Centre = this->Position;
  // Far away there is no triangle, and the engine's coordinates are for the surface's own size.
  const double reach = 1.5 * this->Touched->Radius();
  const Vector way = to - this->Position;
  const double a = SquaredLength(way);
  const double b = glm::dot(way, this->Position);
  const double c = SquaredLength(this->Position) - reach * reach;
  const double root = b * b - a * c;
  double enter = 0.0;
  double leave = 1.0;
  if (a > 0.0 && root > 0.0)
  {
    enter = std::max(0.0, (-b - std::sqrt(root)) / a);
    leave = std::min(1.0, (-b + std::sqrt(root)) / a);
  }
  const Vector first = this->Position + enter * way;
  const Vector last = this->Position + leave * way;
  TriangleList found{ this->Found.data(), static_cast<std::int32_t>(this->Found.size()) };
  if ((a == 0.0 || root > 0.0) && enter <= leave)
  {
    this->Touched->Engine().FindOnSegment(ToVec3(first), ToVec3(last), found);
    budget.Triangles -= found.Count;
  }
  if (found.Overflow || budget.Triangles <= 0)
  {
    return false;
  }
  this->Radius = HUGE_VAL;
  this->Fill(
    found, 0.5 * (first + last), 0.5 * glm::length(last - first) + this->Reach, std::sqrt(a));
  this->Covered = Region::Segment;
  return true;
}

Growth WorkingSet::GrowthOf(std::int32_t triangle, double clearance, double wayError) const
{
  const bool hasBacks = this->Touched->TouchedSide() == Side::Both;
  Growth growth;
  for (int k = 0; k < 3; ++k)
  {
    const bool isShared = this->Touched->AdjacentTriangles()[triangle][k] != BoundaryEdge;
    growth[k] =
      (hasBacks && isShared ? GrowthSeenFromBehind : GrowthOverGaps) * clearance + wayError;
  }
  return growth;
}

void WorkingSet::Fill(
  const TriangleList& found, const Vector& middle, double radius, double farthest)
{
  this->Count = 0;
  this->FoundCount = found.Count;
  double nearest = HUGE_VAL;
  // The corners lie anywhere in memory: all are called for before the first is waited for.
  for (std::int32_t k = 0; k < found.Count; ++k)
  {
    Prefetch(&this->Touched->Triangles()[found.Indices[k]]);
  }
  for (std::int32_t k = 0; k < found.Count; ++k)
  {
    for (const std::int32_t corner : this->Touched->Triangles()[found.Indices[k]])
    {
      Prefetch(&this->Touched->Points()[corner]);
    }
  }
  FacetBatch batch;
  for (std::int32_t start = 0; start < found.Count; start += FacetBatch::Capacity)
  {
    const std::int32_t size = std::min(FacetBatch::Capacity, found.Count - start);
    for (std::int32_t k = 0; k < size; ++k)
    {
      const auto [a, b, c] = this->CornersOf(found.Indices[start + k]);
      batch.Set(k, a, b, c);
    }
    batch.Answer(
      size, { middle, radius, this->Centre, farthest, this->Position, this->MinimumClearance });
    for (std::int32_t k = 0; k < size; ++k)
    {
      if (!batch.Meets(k))
      {
        continue;
      }
      nearest = std::min(nearest, batch.SquaredDistance(k));
      const std::int32_t i = this->Count++;
      this->Triangles[i] = found.Indices[start + k];
      this->Flipped[i] = 0;
      this->NormalX[i] = batch.Normal(k, 0);
      this->NormalY[i] = batch.Normal(k, 1);
      this->NormalZ[i] = batch.Normal(k, 2);
      this->PlaneOffset[i] = batch.PlaneOffset(k);
      this->Error[i] = batch.Error(k);
      this->Clearance[i] = batch.Clearance(k);
    }
  }
  this->EmptyRadius = 0.0;
  this->GrowEmptyBall(std::sqrt(nearest));
  this->MeasurePosition();
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
}

void WorkingSet::TurnToPosition()
{
  if (this->Touched->TouchedSide() != Side::Both)
  {
    return;
  }
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
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
    limit[i] = distance[i] < -error[i] ? -HUGE_VAL : least;
  }
  if (this->Covered != Region::Ball)
  {
    return;
  }
  double nearest = HUGE_VAL;
  for (std::int32_t i = 0; i < this->Count && nearest > this->Reach; ++i)
  {
    nearest = std::min(nearest, std::abs(distance[i]));
  }
  // No triangle is nearer than its plane.
  if (nearest > this->Reach)
  {
    this->GrowEmptyBall(nearest);
  }
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
  FacetHit hit;
  double deepest = HUGE_VAL;
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    if (this->TargetDistance[i] >= this->Limit[i])
    {
      continue;
    }
    const double here = this->Distance[i];
    const double there = this->TargetDistance[i];
    const double clearance = this->Clearance[i];
    const double approach = here - there;
    // Within two clearances is near enough: steps of rounding's size are not worth their check.
    const double stop = here <= 2.0 * clearance ? 0.0 : (here - clearance) / approach;
    const FacetId id{ this->Index, this->Triangles[i] };
    // Of facets met at once the one most pressed against, so that the order in which an engine
    // finds them does not matter.
    if (stop > hit.Fraction ||
      (stop == hit.Fraction &&
        (there > deepest || (there == deepest && id.Triangle > hit.Plane.Facet.Triangle))))
    {
      continue;
    }
    const bool isActive = active.Has(id);
    if (isActive && there > 0.0)
    {
      continue;
    }
    const auto [a, b, c] = this->CornersOf(id.Triangle);
    const Vector normal = this->FacetNormal(i);
    const Growth growth = this->GrowthOf(id.Triangle, clearance, wayError);
    const double enter = std::max(0.0, (here - 0.5 * clearance) / approach);
    const double cross = std::clamp(here / approach, 0.0, 1.0);
    const bool meets =
      (!isActive && CoversGrown(normal, a, b, c, this->Position + enter * way, growth)) ||
      (there <= 0.0 && CoversGrown(normal, a, b, c, this->Position + cross * way, growth));
    if (meets)
    {
      deepest = there;
      hit.Fraction = stop;
      hit.Plane.Facet = id;
      hit.Plane.IsFlipped = this->Flipped[i];
      hit.Plane.Normal = this->ToSurface.VectorToScene(this->Flipped[i] ? -normal : normal);
      hit.Plane.Anchor = this->ToSurface.PointToScene(a);
      hit.Plane.Clearance = clearance;
      hit.Plane.IsFar = this->Covered == Region::Segment;
    }
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
  if (!this->IsPositionMeasured)
  {
    this->MeasurePosition();
  }
  if (!this->IsTargetMeasured || to != this->Target)
  {
    this->MeasureTarget(to);
  }
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const bool mayBeBefore = this->Distance[i] >= -this->Error[i];
    const bool mayEndBehind = this->TargetDistance[i] <= this->Error[i];
    if (mayBeBefore && mayEndBehind && this->Touches(i, this->Position, to))
    {
      return false;
    }
  }
  return true;
}

bool WorkingSet::Touches(std::int32_t i, const Vector& from, const Vector& to) const
{
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
  const int after = this->TargetDistance[i] < -this->Error[i] ? -1 : Orientation(a, b, c, to);
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

bool WorkingSet::Covers(const ActivePlane& plane, const Vector& position) const
{
  const auto [a, b, c] = this->CornersOf(plane.Facet.Triangle);
  const Vector normal =
    this->ToSurface.VectorToLocal(plane.IsFlipped ? -plane.Normal : plane.Normal);
  return CoversGrown(normal, a, b, c, this->ToSurface.PointToLocal(position),
    this->GrowthOf(plane.Facet.Triangle, plane.Clearance, 0.0));
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
