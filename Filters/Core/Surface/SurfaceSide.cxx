#include "haptics/Surface/SurfaceSide.h"

#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/Predicates.h"
#include "haptics/Surface/Facet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace haptics
{
namespace
{
/// Directions of rays, along no axis; the next is taken where one meets an edge or a corner.
constexpr std::array<std::array<double, 3>, 4> Directions = { { { 0.57, 0.61, 0.55 },
  { -0.43, 0.31, 0.85 }, { 0.21, -0.93, 0.29 }, { -0.71, -0.37, -0.60 } } };
/// Points within this of the nearest one's distance are as near.
constexpr double EqualDistance = 1e-9;
/// Balls that are looked into for the nearest place: 14 that grow to the surface's size, and some
/// between the last two where the larger has too many triangles.
constexpr int LargestNumberOfBalls = 32;
}

SurfaceSide::SurfaceSide(
  const TriangleSurface& surface, double fraction, TriangleList scratch, WorkBudget& budget)
  : Surface(surface)
  , Fraction(fraction)
  , Scratch(scratch)
  , Budget(budget)
{
}

SurfaceSide::Corners SurfaceSide::CornersOf(std::int32_t triangle) const
{
  const auto& [a, b, c] = this->Surface.Triangles()[triangle];
  return { ToVector(this->Surface.PointAt(a, this->Fraction)),
    ToVector(this->Surface.PointAt(b, this->Fraction)),
    ToVector(this->Surface.PointAt(c, this->Fraction)) };
}

int CrossingOf(
  const Vector& from, const Vector& to, const Vector& a, const Vector& b, const Vector& c)
{
  const int before = Orientation(a, b, c, from);
  const int after = Orientation(a, b, c, to);
  if (before * after > 0 || !LineMeetsTriangle(from, to, a, b, c))
  {
    return 0;
  }
  const bool isClean = before != 0 && after != 0 && Orientation(from, to, a, b) != 0 &&
    Orientation(from, to, b, c) != 0 && Orientation(from, to, c, a) != 0;
  return isClean ? after : 2;
}

bool SurfaceSide::AddCrossings(
  const Vector& from, const Vector& to, Enclosed& crossings, bool& isKnown)
{
  TriangleList found = this->Scratch;
  found.Count = 0;
  found.Overflow = false;
  this->Surface.Engine().FindOnSegment(ToVec3(from), ToVec3(to), found);
  this->Budget.Triangles -= found.Count;
  isKnown = !found.Overflow && this->Budget.Triangles > 0;
  bool isClean = true;
  for (std::int32_t k = 0; k < found.Count && isClean && isKnown; ++k)
  {
    const Encloser kind = this->Surface.EncloserOf(found.Indices[k]);
    if (kind != Encloser::None)
    {
      const auto [a, b, c] = this->CornersOf(found.Indices[k]);
      const int crossing = CrossingOf(from, to, a, b, c);
      isClean = crossing != 2;
      (kind == Encloser::Front ? crossings.Front : crossings.Both) += crossing;
    }
  }
  return isClean;
}

bool SurfaceSide::CountInPatch(const SurfacePatch& patch, const Vector& x, Enclosed& enclosed)
{
  if (!patch.Enclosure().IsCounted || !patch.Knows(ToVec3(x)))
  {
    return false;
  }
  const Vector anchor = ToVector(patch.Enclosure().Anchor);
  Enclosed counted;
  (this->Surface.Enclosing().OneSided == Encloser::Front ? counted.Front : counted.Both) =
    patch.Enclosure().Count;
  bool isKnown = true;
  // Straight, or by a place elsewhere in the region.
  enclosed = counted;
  bool isClean = this->AddCrossings(x, anchor, enclosed, isKnown);
  for (std::size_t i = 0; i < Directions.size() && isKnown && !isClean; ++i)
  {
    const auto& [u, v, w] = Directions[i];
    const Vector bend =
      ToVector(patch.Region().From) + 0.5 * patch.Region().Radius * glm::normalize(Vector(u, v, w));
    enclosed = counted;
    isClean = this->AddCrossings(x, bend, enclosed, isKnown) && isKnown &&
      this->AddCrossings(bend, anchor, enclosed, isKnown);
  }
  return isClean && isKnown;
}

bool SurfaceSide::CountEnclosing(const Vector& x, Enclosed& enclosed)
{
  enclosed = Enclosed();
  const double radius = this->Surface.Radius();
  if (glm::length(x) > radius)
  {
    return true; // no triangle is this far out
  }
  if (const SurfacePatch* const patch = this->Surface.Patch())
  {
    return this->CountInPatch(*patch, x, enclosed);
  }
  for (const auto& [u, v, w] : Directions)
  {
    // To just outside the ball that holds all triangles.
    const Vector direction = glm::normalize(Vector(u, v, w));
    const double along = glm::dot(x, direction);
    const double outside = 1.05 * radius;
    const Vector to =
      x + (std::sqrt(along * along - SquaredLength(x) + outside * outside) - along) * direction;
    Enclosed crossings;
    bool isKnown = true;
    const bool isClean = this->AddCrossings(x, to, crossings, isKnown);
    if (isClean || !isKnown)
    {
      enclosed = crossings;
      return isKnown;
    }
  }
  return false;
}

bool SurfaceSide::IsInReach(const Vector& x) const
{
  return glm::length(x) <= 1.5 * this->Surface.Radius();
}

bool SurfaceSide::FindNearest(const Vector& x, const Encloser* kind, SurfacePlace& nearest)
{
  const double surfaceRadius = this->Surface.Radius();
  if (!this->IsInReach(x))
  {
    return false;
  }
  double small = 0.0;      // a ball with nothing to be found
  double large = HUGE_VAL; // one with too much
  double radius = 0x1p-12 * surfaceRadius;
  for (int ball = 0; ball < LargestNumberOfBalls && small < 4.0 * surfaceRadius; ++ball)
  {
    TriangleList found = this->Scratch;
    found.Count = 0;
    found.Overflow = false;
    this->Surface.Engine().FindInBall(ToVec3(x), radius, found);
    this->Budget.Triangles -= found.Count;
    if (this->Budget.Triangles <= 0)
    {
      return false;
    }
    if (!found.Overflow && this->ChooseNearest(x, kind, found, nearest) <= radius)
    {
      const SurfacePatch* const patch = this->Surface.Patch();
      return !patch || !kind || patch->HoldsNearest(ToVec3(x), glm::length(nearest.Point - x));
    }
    (found.Overflow ? large : small) = radius;
    radius = large < HUGE_VAL ? 0.5 * (small + large) : 2.0 * radius;
  }
  return false;
}

double SurfaceSide::ChooseNearest(
  const Vector& x, const Encloser* kind, const TriangleList& found, SurfacePlace& nearest) const
{
  double best = HUGE_VAL;
  double facing = -1.0;
  Vector normals{ 0 };
  // The first round finds the distance, the second the facet that faces x most of those there.
  for (int round = 0; round < 2; ++round)
  {
    for (std::int32_t k = 0; k < found.Count; ++k)
    {
      const std::int32_t id = found.Indices[k];
      if (kind && this->Surface.EncloserOf(id) != *kind)
      {
        continue;
      }
      const auto [a, b, c] = this->CornersOf(id);
      const Facet facet(a, b, c);
      if (!facet.HasArea())
      {
        continue;
      }
      const Vector way = NearestToOrigin(a - x, b - x, c - x);
      const double distance = glm::length(way);
      if (round == 0)
      {
        best = std::min(best, distance);
        continue;
      }
      const double cosine = distance > 0.0 ? std::abs(glm::dot(facet.Normal, way)) / distance : 1.0;
      if (distance > best * (1.0 + EqualDistance))
      {
        continue;
      }
      normals += facet.Normal;
      if (cosine > facing)
      {
        facing = cosine;
        nearest = { x + way, facet.Normal, Vector(0), id, false };
        for (int k3 = 0; k3 < 3; ++k3)
        {
          const Vector& from = facet.Corner[k3];
          const Vector edge = facet.Corner[(k3 + 1) % 3] - from;
          const double off = glm::length(glm::cross(edge, nearest.Point - from));
          nearest.IsOnRim = nearest.IsOnRim ||
            (this->Surface.AdjacentTriangles()[id][k3] == BoundaryEdge &&
              off <= EqualDistance * SquaredLength(edge));
        }
      }
    }
  }
  nearest.Normals = normals;
  return best;
}
}
