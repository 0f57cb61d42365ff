#include "ProfileSurfaces.h"

#include "AnalyticSurfaces.h"

#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

/// Turns about the y axis, +x up.
TriangleMesh Turned(TriangleMesh mesh, double degrees)
{
  const double c = std::cos(degrees * Degree);
  const double s = std::sin(degrees * Degree);
  for (Vec3& p : mesh.Points)
  {
    p = { c * p[0] - s * p[2], p[1], s * p[0] + c * p[2] };
  }
  return mesh;
}
}

TriangleMesh Extruded(const std::vector<std::array<double, 2>>& profile,
  const std::array<double, 2>& centre, double halfWidth)
{
  // Points of the front end (y < 0) are even, those of the back end odd; the centres come last.
  TriangleMesh mesh;
  for (const auto& [x, z] : profile)
  {
    mesh.Points.push_back({ x, -halfWidth, z });
    mesh.Points.push_back({ x, halfWidth, z });
  }
  const auto count = static_cast<std::int32_t>(profile.size());
  mesh.Points.push_back({ centre[0], -halfWidth, centre[1] });
  mesh.Points.push_back({ centre[0], halfWidth, centre[1] });
  for (std::int32_t i = 0; i < count; ++i)
  {
    const std::int32_t a = 2 * i;
    const std::int32_t b = 2 * ((i + 1) % count);
    mesh.Triangles.push_back({ a, b + 1, b });
    mesh.Triangles.push_back({ a, a + 1, b + 1 });
    mesh.Triangles.push_back({ 2 * count, a, b });
    mesh.Triangles.push_back({ 2 * count + 1, b + 1, a + 1 });
  }
  return mesh;
}

TriangleMesh Slab(double degrees, double halfSize)
{
  return Turned(Moved(Box(halfSize, halfSize, halfSize, 2), { 0, 0, -halfSize }), degrees);
}

TriangleMesh Ridge(double degrees, double size)
{
  const double half = size * std::tan(0.5 * degrees * Degree);
  return Extruded({ { 0, 0 }, { -half, -size }, { half, -size } }, { 0, -0.5 * size }, size);
}

TriangleMesh GroovedBlock(double degrees, double depth)
{
  const double half = depth * std::tan(0.5 * degrees * Degree);
  const double side = half + depth;
  return Extruded({ { 0, 0 }, { -half, depth }, { -side, depth }, { -side, -depth },
                    { side, -depth }, { side, depth }, { half, depth } },
    { 0, -0.5 * depth }, depth);
}

TriangleMesh HeightBlock(
  const std::function<double(double, double)>& height, double halfSize, int cells)
{
  // A box of as many cells, stretched between the heights and a plane below.
  TriangleMesh mesh = Box(halfSize, halfSize, halfSize, cells);
  for (Vec3& p : mesh.Points)
  {
    const double fraction = 0.5 * (p[2] / halfSize + 1.0);
    p[2] = -2.0 * halfSize + fraction * (height(p[0], p[1]) + 2.0 * halfSize);
  }
  return mesh;
}

TriangleMesh ThreePlanes(double degrees, double halfSize)
{
  TriangleMesh mesh;
  for (int k = 0; k < 3; ++k)
  {
    const double c = std::cos(120.0 * k * Degree);
    const double s = std::sin(120.0 * k * Degree);
    TriangleMesh plane = Turned(Square(halfSize), degrees);
    for (Vec3& p : plane.Points)
    {
      p = { c * p[0] - s * p[1], s * p[0] + c * p[1], p[2] };
    }
    mesh = Joined(std::move(mesh), plane);
  }
  return mesh;
}

TriangleMesh Sheets(int count, double gap, double halfSize)
{
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i)
  {
    mesh = Joined(std::move(mesh), Moved(Square(halfSize, 3), { 0, 0, -gap * i }));
  }
  return mesh;
}

TriangleMesh Cracked(const TriangleMesh& mesh, double width)
{
  TriangleMesh cracked;
  for (const Triangle& triangle : mesh.Triangles)
  {
    Vec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      corners[k] = mesh.Points[triangle[k]];
    }
    // Towards the middle of the inscribed circle each edge moves in by half the width.
    const double lengths[3] = { Length(corners[2] - corners[1]), Length(corners[0] - corners[2]),
      Length(corners[1] - corners[0]) };
    const double around = lengths[0] + lengths[1] + lengths[2];
    const Vec3 middle = (1.0 / around) *
      (lengths[0] * corners[0] + lengths[1] * corners[1] + lengths[2] * corners[2]);
    const double radius = Length(Cross(corners[1] - corners[0], corners[2] - corners[0])) / around;
    const double factor = 1.0 - 0.5 * width / radius;
    const auto first = static_cast<std::int32_t>(cracked.Points.size());
    for (const Vec3& corner : corners)
    {
      cracked.Points.push_back(middle + factor * (corner - middle));
    }
    cracked.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return cracked;
}
}
