// The part of WorkingSet that knows surfaces which deform.
#include "haptics/Contact/WorkingSet.h"
#include "haptics/Math/Predicates.h"
#include "haptics/Math/SweptTriangle.h"

#include <algorithm>

namespace haptics
{
void WorkingSet::BeginTick(double dt)
{
  this->Elapsed += dt > 0.0 ? dt : 0.0;
  this->TickStart = this->Now;
  const double duration = this->Touched->DeformDuration();
  this->TickEnd = this->Elapsed < duration ? this->Elapsed / duration : 1.0;
}

void WorkingSet::SweepTo(double part)
{
  this->Next =
    part < 1.0 ? this->TickStart + part * (this->TickEnd - this->TickStart) : this->TickEnd;
  this->IsSweepClear = false;
}

void WorkingSet::BeginRest()
{
  this->Next = this->Now;
  this->TickStart = this->Now;
}

/// All triangles that can come to the god-object while it goes there: engines find a triangle
/// wherever it passes.
bool WorkingSet::GatherSwept(const Vector& to, WorkBudget& budget)
{
  const auto holdsWay = [&]
  { return this->Covered == Region::Ball && this->IsInBall(this->Position) && this->IsInBall(to); };
  if (holdsWay())
  {
    return true;
  }
  if (this->GatherBall(budget) && holdsWay())
  {
    return true;
  }
  return this->GatherSegment(to, budget);
}

bool WorkingSet::FindSwept(const Vector& to, WorkBudget& budget, FacetHit& hit)
{
  this->IsSweepClear = false;
  if (!this->GatherSwept(to, budget))
  {
    return false;
  }
  for (std::int32_t k = 0; k < this->FoundCount; ++k)
  {
    this->Sweeps(this->Found[k], to, hit);
  }
  this->Target = to;
  this->IsSweepClear = !hit;
  return true;
}

/// Whether a triangle may pass over the god-object, and does so before the hit, which it then is.
bool WorkingSet::Sweeps(std::int32_t triangle, const Vector& to, FacetHit& hit) const
{
  const auto [a0, b0, c0] = this->CornersAt(triangle, this->Now);
  const auto [a1, b1, c1] = this->CornersAt(triangle, this->Next);
  SweptTriangle swept;
  swept.From = { a0 - this->Position, b0 - this->Position, c0 - this->Position };
  swept.To = { a1 - to, b1 - to, c1 - to };
  // 16 roundings of a coordinate: of the differences above, and of times that are halved.
  swept.Slack = this->MinimumClearance / 64.0;
  swept.IsOneSided = !this->Touched->TouchesBack(triangle);
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
  const bool isFlipped = !swept.IsOneSided && Orientation(a0, b0, c0, this->Position) < 0;
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
    facet.Clearance(this->MinimumClearance, glm::length(facet.Corner[facet.Anchor]));
  hit.Plane.IsFar = false;
  hit.Plane.IsOfWire = false;
  return true;
}

void WorkingSet::MoveSwept()
{
  this->Position = this->Target;
  this->Now = this->Next;
  this->IsTargetMeasured = false;
  if (this->Covered == Region::Ball)
  {
    // What the engine found holds for the whole sweep; planes and distances are new.
    const TriangleList found{ this->Found.data(), this->FoundCount, this->FoundCount };
    const double radius = this->Radius * (1.0 + 0x1p-39);
    this->Fill(found, this->Centre, radius, radius);
  }
  else
  {
    this->Covered = Region::Nothing;
  }
}

void WorkingSet::Renew(ActivePlane& plane) const
{
  const auto [a, b, c] = this->CornersAt(plane.Facet.Triangle, this->Next);
  const Facet facet(a, b, c);
  if (facet.HasArea())
  {
    plane.Normal = this->ToSurface.VectorToScene(plane.IsFlipped ? -facet.Normal : facet.Normal);
  }
  plane.Anchor = this->ToSurface.PointToScene(a);
}

Vector WorkingSet::CarriedBy(const ActivePlane& plane) const
{
  if (!this->IsSweeping())
  {
    return this->Position;
  }
  const auto before = this->CornersAt(plane.Facet.Triangle, this->Now);
  const auto after = this->CornersAt(plane.Facet.Triangle, this->Next);
  const Facet from(before.A, before.B, before.C);
  const Facet to(after.A, after.B, after.C);
  if (!from.HasArea() || !to.HasArea())
  {
    return this->Position;
  }
  const Vector u = before.B - before.A;
  const Vector v = before.C - before.A;
  const Vector x = this->Position - before.A;
  const double uu = glm::dot(u, u);
  const double uv = glm::dot(u, v);
  const double vv = glm::dot(v, v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0.0))
  {
    return this->Position;
  }
  const double s = (vv * glm::dot(u, x) - uv * glm::dot(v, x)) / determinant;
  const double t = (uu * glm::dot(v, x) - uv * glm::dot(u, x)) / determinant;
  const double height = glm::dot(from.Normal, x);
  return after.A + s * (after.B - after.A) + t * (after.C - after.A) + height * to.Normal;
}
}
