#include "haptics/Scene/SurfaceRay.h"

#include "haptics/Math/Vec3Operations.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace haptics
{
namespace
{
/// The part of the ray inside the ball around the local origin; false where it misses it.
bool ClipToBall(const Vec3& from, const Vec3& direction, double radius, double& begin, double& end)
{
  const double a = Dot(direction, direction);
  const double b = Dot(from, direction);
  const double discriminant = b * b - a * (Dot(from, from) - radius * radius);
  if (!(a > 0.0) || !(discriminant >= 0.0))
  {
    return false;
  }
  const double root = std::sqrt(discriminant);
  begin = std::max(0.0, (-b - root) / a);
  end = (-b + root) / a;
  return end >= 0.0;
}

/// Where the ray meets a triangle, by T. Moller and B. Trumbore, "Fast, Minimum Storage
/// Ray/Triangle Intersection", 1997.
std::optional<double> Meet(
  const Vec3& from, const Vec3& direction, const Vec3& p, const Vec3& q, const Vec3& r, bool front)
{
  const Vec3 first = Minus(q, p);
  const Vec3 second = Minus(r, p);
  const Vec3 across = Cross(direction, second);
  const double determinant = Dot(first, across);
  if (determinant == 0.0 || (front && determinant < 0.0))
  {
    return std::nullopt;
  }
  const Vec3 toFrom = Minus(from, p);
  const double u = Dot(toFrom, across) / determinant;
  const Vec3 turned = Cross(toFrom, first);
  const double v = Dot(direction, turned) / determinant;
  const double t = Dot(second, turned) / determinant;
  if (u < 0.0 || v < 0.0 || u + v > 1.0 || t < 0.0)
  {
    return std::nullopt;
  }
  return t;
}
}

std::optional<RayHit> CastRay(
  const TriangleSurface& surface, const Vec3& from, const Vec3& direction)
{
  const Vec3 local = Minus(from, surface.Origin());
  double begin = 0.0;
  double end = 0.0;
  if (!ClipToBall(local, direction, 1.01 * surface.Radius(), begin, end))
  {
    return std::nullopt;
  }
  const auto count = static_cast<std::int32_t>(surface.Triangles().size());
  // A ray that meets more triangles than that looks at all of them.
  std::vector<std::int32_t> candidates(static_cast<std::size_t>(std::min(count, 4096)));
  TriangleList found;
  found.Indices = candidates.data();
  found.Capacity = static_cast<std::int32_t>(candidates.size());
  surface.Engine().FindOnSegment(Sum(local, begin, direction), Sum(local, end, direction), found);
  if (found.Overflow)
  {
    candidates.resize(static_cast<std::size_t>(count));
    std::iota(candidates.begin(), candidates.end(), 0);
    found.Count = count;
  }
  std::optional<RayHit> nearest;
  for (std::int32_t i = 0; i < found.Count; ++i)
  {
    const std::int32_t id = candidates[static_cast<std::size_t>(i)];
    const Triangle& triangle = surface.Triangles()[static_cast<std::size_t>(id)];
    const auto corner = [&](int k) -> const Vec3&
    { return surface.Points()[static_cast<std::size_t>(triangle[k])]; };
    const std::optional<double> t =
      Meet(local, direction, corner(0), corner(1), corner(2), !surface.TouchesBack(id));
    if (t && (!nearest || *t < nearest->Distance))
    {
      const Vec3 normal = Cross(Minus(corner(1), corner(0)), Minus(corner(2), corner(0)));
      nearest = RayHit{ *t, Dot(normal, direction) > 0.0 ? Sum({}, -1.0, normal) : normal };
    }
  }
  if (nearest)
  {
    vtkMath::Normalize(nearest->Normal.data());
  }
  return nearest;
}
}
