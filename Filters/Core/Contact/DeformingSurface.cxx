#include "haptics/Contact/DeformingSurface.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
DeformingSurface::DeformingSurface(std::shared_ptr<const TriangleSurface> surface)
  : Snapshot(std::move(surface))
  , Now(this->Snapshot->Deforms() ? 0.0 : 1.0)
  , Next(this->Now)
{
}

void DeformingSurface::BeginTick(double dt)
{
  this->Elapsed += dt > 0.0 ? dt : 0.0;
  this->TickStart = this->Now;
  const double duration = this->Snapshot->DeformDuration();
  this->TickEnd = this->Elapsed < duration ? this->Elapsed / duration : 1.0;
}

void DeformingSurface::SweepTo(double part)
{
  this->Next =
    part < 1.0 ? this->TickStart + part * (this->TickEnd - this->TickStart) : this->TickEnd;
}

void DeformingSurface::BeginRest()
{
  this->Next = this->Now;
  this->TickStart = this->Now;
}

void DeformingSurface::SkipTick()
{
  this->Now = this->TickEnd;
  this->Next = this->Now;
}

void DeformingSurface::Continue(const DeformingSurface& previous)
{
  if (this->Snapshot == previous.Snapshot)
  {
    this->Now = previous.Now;
    this->Next = this->Now;
    this->Elapsed = previous.Elapsed;
  }
}

Vector DeformingSurface::PointAfterSweep(std::int32_t triangle, const Vector& x) const
{
  if (!this->IsSweeping())
  {
    return x;
  }
  const auto before = this->CornersOf(triangle);
  const auto after = this->NextCornersOf(triangle);
  const Facet from(before.A, before.B, before.C);
  const Facet to(after.A, after.B, after.C);
  if (!from.HasArea() || !to.HasArea())
  {
    return x;
  }
  const Vector u = before.B - before.A;
  const Vector v = before.C - before.A;
  const Vector d = x - before.A;
  const double uu = glm::dot(u, u);
  const double uv = glm::dot(u, v);
  const double vv = glm::dot(v, v);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0.0))
  {
    return x;
  }
  const double s = (vv * glm::dot(u, d) - uv * glm::dot(v, d)) / determinant;
  const double t = (uu * glm::dot(v, d) - uv * glm::dot(u, d)) / determinant;
  const double height = glm::dot(from.Normal, d);
  return after.A + s * (after.B - after.A) + t * (after.C - after.A) + height * to.Normal;
}

std::int32_t DeformingSurface::NextTriangle(
  std::int32_t triangle, const Vector& x, const Vector& way, double& fraction) const
{
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector* const corners[4] = { &a, &b, &c, &a };
  const Vector up = glm::cross(b - a, c - a);
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
      next = this->Snapshot->AdjacentTriangles()[triangle][k];
    }
  }
  fraction = std::clamp(first, 0.0, 1.0);
  return next;
}

std::array<double, 3> DeformingSurface::CornerWeights(std::int32_t triangle, const Vector& x) const
{
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector normal = glm::cross(b - a, c - a);
  std::array<double, 3> weights = { glm::dot(normal, glm::cross(c - b, x - b)),
    glm::dot(normal, glm::cross(a - c, x - c)), glm::dot(normal, glm::cross(b - a, x - a)) };
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

std::array<Vector, 2> DeformingSurface::WeightGradients(std::int32_t triangle) const
{
  const auto [a, b, c] = this->CornersOf(triangle);
  const Vector normal = glm::cross(b - a, c - a);
  const double squared = glm::dot(normal, normal);
  if (!(squared > 0.0))
  {
    return { Vector(0.0), Vector(0.0) };
  }
  return { glm::cross(c - a, normal) / squared, glm::cross(normal, b - a) / squared };
}
}
