// The part of WorkingSet that fetches triangles from the surface's engine.
#include "haptics/Contact/WorkingSet.h"

#include "haptics/Contact/FacetBatch.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
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
    this->ForgetTriangles();
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

void WorkingSet::Fill(
  const TriangleList& found, const Vector& middle, double radius, double farthest)
{
  this->ForgetTriangles();
  this->IsTargetMeasured = false;
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
      const std::int32_t i = this->Count;
      this->Triangles[i] = found.Indices[start + k];
      this->Flipped[i] = 0;
      this->Widths[i] = Width::Broad;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Low[axis][i] = batch.Low(k, axis);
        this->High[axis][i] = batch.High(k, axis);
      }
      if (batch.IsWellKnown(k))
      {
        this->NormalX[i] = batch.Normal(k, 0);
        this->NormalY[i] = batch.Normal(k, 1);
        this->NormalZ[i] = batch.Normal(k, 2);
        this->PlaneOffset[i] = batch.PlaneOffset(k);
        this->Error[i] = batch.Error(k);
        this->Clearance[i] = batch.Clearance(k);
      }
      else if (!this->FillThin(i, farthest))
      {
        continue;
      }
      nearest = std::min(nearest, batch.SquaredDistance(k));
      ++this->Count;
    }
  }
  this->EmptyRadius = 0.0;
  this->GrowEmptyBall(std::sqrt(nearest));
  this->MeasurePosition();
}

/// Whether a thin triangle's longest edge is one of a broad triangle's too, which goes on from it
/// in the same orientation and is touched from the same sides, and no edge of it is open.
bool WorkingSet::IsSeam(std::int32_t triangle, const Facet& facet, double clearance) const
{
  if (!(facet.SmallestHeight < GrowthOverSharedEdges * clearance))
  {
    return false;
  }
  const auto& neighbours = this->Touched->AdjacentTriangles()[triangle];
  const std::int32_t other = neighbours[(facet.Anchor + 1) % 3];
  if (*std::min_element(neighbours.begin(), neighbours.end()) < 0 ||
    this->Touched->TouchesBack(triangle) != this->Touched->TouchesBack(other))
  {
    return false;
  }
  const auto& corners = this->Touched->Triangles()[triangle];
  const std::int32_t from = corners[(facet.Anchor + 1) % 3];
  const std::int32_t to = corners[(facet.Anchor + 2) % 3];
  const auto& others = this->Touched->Triangles()[other];
  const auto place = std::find(others.begin(), others.end(), to) - others.begin();
  if (place == 3 || others[(place + 1) % 3] != from)
  {
    return false;
  }
  const auto [a, b, c] = this->CornersOf(other);
  return Facet(a, b, c).SmallestHeight >= clearance;
}

/// The plane of a thin triangle. False where it has no area.
bool WorkingSet::FillThin(std::int32_t i, double farthest)
{
  const auto [a, b, c] = this->CornersOf(this->Triangles[i]);
  const Facet facet(a, b, c);
  if (!facet.HasArea())
  {
    return false;
  }
  const Vector from = facet.Corner[facet.Anchor] - this->Centre;
  const double reach = glm::length(from) + farthest;
  this->NormalX[i] = facet.Normal.x;
  this->NormalY[i] = facet.Normal.y;
  this->NormalZ[i] = facet.Normal.z;
  this->PlaneOffset[i] = glm::dot(facet.Normal, from);
  this->Error[i] = facet.DistanceError(reach);
  this->Clearance[i] = facet.Clearance(this->MinimumClearance, reach);
  this->Widths[i] = Width::Broad;
  if (facet.SmallestHeight < this->Clearance[i])
  {
    this->Widths[i] =
      this->IsSeam(this->Triangles[i], facet, this->Clearance[i]) ? Width::Seam : Width::Wire;
    this->HasThin = true;
    this->Error[i] = HUGE_VAL; // that of the triangle's plane, which is not known here
  }
  return true;
}
}
