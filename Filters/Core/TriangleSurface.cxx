#include "TriangleSurface.h"

#include "Facet.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
std::string FindFault(const TriangleMesh& mesh, const SurfaceOptions& options)
{
  if (mesh.Triangles.empty())
  {
    return "the surface has no triangle";
  }
  if (!std::isfinite(options.CrackWidth) || options.CrackWidth < 0.0)
  {
    return "the crack width must be finite and not negative";
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Vec3& p = mesh.Points[i];
    // Not less is also how NaN answers.
    if (!(std::abs(p[0]) < LargestCoordinate && std::abs(p[1]) < LargestCoordinate &&
          std::abs(p[2]) < LargestCoordinate))
    {
      return "point " + std::to_string(i) + " is not finite, or beyond 1e70";
    }
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (const std::int32_t corner : mesh.Triangles[i])
    {
      if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.Points.size())
      {
        return "triangle " + std::to_string(i) + " names point " + std::to_string(corner) +
          ", which is not one of the " + std::to_string(mesh.Points.size());
      }
    }
  }
  return {};
}

/// Moves the origin to the middle of the used points and returns their greatest distance from it.
double Recentre(TriangleMesh& mesh, Vec3& origin)
{
  Vector low(HUGE_VAL);
  Vector high(-HUGE_VAL);
  for (const Triangle& t : mesh.Triangles)
  {
    for (const std::int32_t corner : t)
    {
      const Vector p = ToVector(mesh.Points[corner]);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const Vector middle = low + 0.5 * (high - low);
  origin = ToVec3(middle);
  for (Vec3& p : mesh.Points)
  {
    p = ToVec3(ToVector(p) - middle);
  }
  return 0.5 * glm::length(high - low) * (1.0 + 0x1p-40);
}

/// Longest edge of the triangles that have an area; 0 when none has.
double LongestEdgeWithArea(const TriangleMesh& mesh)
{
  double longest = 0.0;
  for (const Triangle& t : mesh.Triangles)
  {
    const Facet facet(
      ToVector(mesh.Points[t[0]]), ToVector(mesh.Points[t[1]]), ToVector(mesh.Points[t[2]]));
    if (facet.HasArea())
    {
      longest = std::max(longest, facet.LongestEdge);
    }
  }
  return longest;
}
}

std::shared_ptr<const TriangleSurface> TriangleSurface::Build(
  TriangleMesh mesh, const SurfaceOptions& options, std::string& error)
{
  error = FindFault(mesh, options);
  if (!error.empty())
  {
    return nullptr;
  }
  std::shared_ptr<TriangleSurface> surface(new TriangleSurface);
  surface->SurfaceRadius = Recentre(mesh, surface->SurfaceOrigin);
  surface->Mesh = std::move(mesh);
  const double longestEdge = LongestEdgeWithArea(surface->Mesh);
  if (longestEdge == 0.0)
  {
    error = "no triangle of the surface has an area";
    return nullptr;
  }
  const double crackWidth = std::min(options.CrackWidth, surface->SurfaceRadius);
  surface->MinimumClearance =
    std::max(1024.0 * UnitRoundoff * surface->SurfaceRadius, 0.25 * crackWidth);
  surface->Found = AnalyseSurface(surface->Mesh.Points, surface->Mesh.Triangles, surface->Adjacent);
  surface->Touched = options.TouchedSide;
  if (surface->Touched == Side::Automatic)
  {
    const SurfaceReport& found = surface->Found;
    surface->Touched =
      found.Closed && found.Oriented && found.InsideOutComponents == 0 ? Side::Front : Side::Both;
  }
  const EngineInput input{ surface->Mesh.Points, surface->Mesh.Triangles, surface->SurfaceRadius,
    LargestGrowth(surface->MinimumClearance, longestEdge) };
  surface->Collision = MakeEngine(options.Engine, input);
  if (!surface->Collision)
  {
    error = options.Engine == EngineKind::Exact
      ? "the exact engine is in the library HapticsExactEngineGPL, which is not loaded"
      : "memory ran out while the collision engine was built";
    return nullptr;
  }
  return surface;
}

TriangleSurface::~TriangleSurface() = default;

std::size_t TriangleSurface::MemoryBytes() const
{
  return sizeof(*this) + this->Mesh.Points.capacity() * sizeof(Vec3) +
    this->Mesh.Triangles.capacity() * sizeof(Triangle) +
    this->Adjacent.capacity() * sizeof(Neighbours::value_type) + this->Collision->MemoryBytes();
}
}
