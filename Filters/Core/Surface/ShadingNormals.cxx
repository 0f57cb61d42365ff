#include "haptics/Surface/ShadingNormals.h"

#include "haptics/Surface/Facet.h"

#include <cmath>
#include <numeric>

namespace haptics
{
namespace
{
using Corner = std::size_t; // 3 · triangle + 0, 1, 2

/// Sets of corners that share a normal.
class Groups
{
public:
  explicit Groups(std::size_t size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), Corner{ 0 });
  }
  Corner Find(Corner corner)
  {
    while (this->Parents[corner] != corner)
    {
      this->Parents[corner] = this->Parents[this->Parents[corner]];
      corner = this->Parents[corner];
    }
    return corner;
  }
  void Join(Corner a, Corner b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<Corner> Parents;
};

double AngleBetween(const Vector& a, const Vector& b)
{
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}
}

std::vector<std::array<float, 3>> ShadingNormals(
  const TriangleSurface& surface, double featureAngle)
{
  const auto& triangles = surface.Triangles();
  const auto corner = [&](std::size_t triangle, int k)
  { return ToVector(surface.Points()[triangles[triangle][k]]); };

  std::vector<Vector> facets(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    facets[i] = Facet(corner(i, 0), corner(i, 1), corner(i, 2)).Normal;
  }
  const double largestTurn = featureAngle * std::acos(-1.0) / 180.0;
  Groups groups(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t other = surface.AdjacentTriangles()[i][k];
      if (other < 0 || static_cast<std::size_t>(other) < i ||
        AngleBetween(facets[i], facets[other]) > largestTurn)
      {
        continue;
      }
      const std::int32_t from = triangles[i][k];
      const std::int32_t to = triangles[i][(k + 1) % 3];
      for (int m = 0; m < 3; ++m)
      {
        // Along a shared edge consistently oriented neighbours go opposite ways.
        if (triangles[other][m] == to && triangles[other][(m + 1) % 3] == from)
        {
          const Corner there = 3 * static_cast<Corner>(other);
          groups.Join(3 * i + k, there + (m + 1) % 3);
          groups.Join(3 * i + (k + 1) % 3, there + m);
        }
      }
    }
  }

  std::vector<Vector> sums(3 * triangles.size(), Vector(0.0));
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector here = corner(i, k);
      const double angle =
        AngleBetween(corner(i, (k + 1) % 3) - here, corner(i, (k + 2) % 3) - here);
      sums[groups.Find(3 * i + k)] += angle * facets[i];
    }
  }
  std::vector<std::array<float, 3>> normals(3 * triangles.size());
  for (Corner c = 0; c < normals.size(); ++c)
  {
    const Vector sum = sums[groups.Find(c)];
    const double length = glm::length(sum);
    const Vector normal = length > 0.0 ? sum / length : facets[c / 3];
    normals[c] = { static_cast<float>(normal.x), static_cast<float>(normal.y),
      static_cast<float>(normal.z) };
  }
  return normals;
}
}
