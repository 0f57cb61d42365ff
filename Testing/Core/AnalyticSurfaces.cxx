#include "AnalyticSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace haptics::testing
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

/// Adds points once each, by an integer key that distinguishes them.
class PointGrid
{
public:
  explicit PointGrid(TriangleMesh& mesh)
    : Mesh(mesh)
  {
  }
  std::int32_t Add(const std::array<int, 3>& key, const Vec3& point)
  {
    const auto [entry, isNew] =
      this->Indices.try_emplace(key, static_cast<std::int32_t>(this->Mesh.Points.size()));
    if (isNew)
    {
      this->Mesh.Points.push_back(point);
    }
    return entry->second;
  }

private:
  TriangleMesh& Mesh;
  std::map<std::array<int, 3>, std::int32_t> Indices;
};
}

TriangleMesh Square(double halfSize, int cells)
{
  TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      mesh.Points.push_back(
        { halfSize * (2.0 * i / cells - 1.0), halfSize * (2.0 * j / cells - 1.0), 0.0 });
    }
  }
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      const int a = j * (cells + 1) + i;
      const int d = a + cells + 1;
      mesh.Triangles.push_back({ a, a + 1, d + 1 });
      mesh.Triangles.push_back({ a, d + 1, d });
    }
  }
  return mesh;
}

TriangleMesh Icosphere(int level, double radius)
{
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.Points = { { -1, t, 0 }, { 1, t, 0 }, { -1, -t, 0 }, { 1, -t, 0 }, { 0, -1, t }, { 0, 1, t },
    { 0, -1, -t }, { 0, 1, -t }, { t, 0, -1 }, { t, 0, 1 }, { -t, 0, -1 }, { -t, 0, 1 } };
  mesh.Triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 },
    { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
    { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
    { 9, 8, 1 } };
  for (int l = 0; l < level; ++l)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [entry, isNew] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.Points.size()));
      if (isNew)
      {
        mesh.Points.push_back(Unit(mesh.Points[a]) + Unit(mesh.Points[b]));
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.Triangles)
    {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    mesh.Triangles = std::move(finer);
  }
  for (Vec3& p : mesh.Points)
  {
    p = radius * Unit(p);
  }
  return mesh;
}

TriangleMesh Box(double halfX, double halfY, double halfZ, int cells)
{
  const Vec3 half{ halfX, halfY, halfZ };
  TriangleMesh mesh;
  PointGrid grid(mesh);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const int side : { 0, cells })
    {
      const auto corner = [&](int i, int j)
      {
        std::array<int, 3> key{};
        key[axis] = side;
        key[u] = i;
        key[v] = j;
        Vec3 p;
        for (int k = 0; k < 3; ++k)
        {
          p[k] = half[k] * (2.0 * key[k] / cells - 1.0);
        }
        return grid.Add(key, p);
      };
      for (int i = 0; i < cells; ++i)
      {
        for (int j = 0; j < cells; ++j)
        {
          std::array<int, 4> q{ corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
            corner(i, j + 1) };
          if (side == 0)
          {
            std::reverse(q.begin(), q.end());
          }
          mesh.Triangles.push_back({ q[0], q[1], q[2] });
          mesh.Triangles.push_back({ q[0], q[2], q[3] });
        }
      }
    }
  }
  return mesh;
}

TriangleMesh Star(int level, double radius, double amplitude, unsigned seed)
{
  TriangleMesh mesh = Icosphere(level, radius);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> factor(1.0 - amplitude, 1.0);
  for (Vec3& p : mesh.Points)
  {
    p = factor(random) * p;
  }
  return mesh;
}

TriangleMesh Torus(double radius, double tube, int around, int across)
{
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const double a = 2.0 * Pi * i / around;
      const double b = 2.0 * Pi * j / across;
      const double r = radius + tube * std::cos(b);
      mesh.Points.push_back({ r * std::cos(a), r * std::sin(a), tube * std::sin(b) });
      const int p = i * across + j;
      const int q = ((i + 1) % around) * across + j;
      const int qNext = ((i + 1) % around) * across + (j + 1) % across;
      const int pNext = i * across + (j + 1) % across;
      mesh.Triangles.push_back({ p, q, qNext });
      mesh.Triangles.push_back({ p, qNext, pNext });
    }
  }
  return mesh;
}

TriangleMesh Groove(double degrees, double size)
{
  const double half = 0.5 * degrees * Pi / 180.0;
  const double x = size * std::sin(half);
  const double z = size * std::cos(half);
  TriangleMesh mesh;
  mesh.Points = { { 0, -size, 0 }, { 0, size, 0 }, { x, size, z }, { x, -size, z }, { -x, size, z },
    { -x, -size, z } };
  mesh.Triangles = { { 0, 2, 1 }, { 0, 3, 2 }, { 0, 1, 4 }, { 0, 4, 5 } };
  return mesh;
}

TriangleMesh InsideCorner(double size)
{
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, 0 }, { size, 0, 0 }, { 0, size, 0 }, { 0, 0, size }, { size, size, 0 },
    { 0, size, size }, { size, 0, size } };
  mesh.Triangles = { { 0, 1, 4 }, { 0, 4, 2 }, { 0, 2, 5 }, { 0, 5, 3 }, { 0, 3, 6 }, { 0, 6, 1 } };
  return mesh;
}

TriangleMesh Soup(int count, double size, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 centre{ place(random), place(random), place(random) };
    const int first = static_cast<int>(mesh.Points.size());
    for (int k = 0; k < 3; ++k)
    {
      mesh.Points.push_back(centre + size * Vec3{ place(random), place(random), place(random) });
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

TriangleMesh InsideOut(TriangleMesh mesh)
{
  for (Triangle& t : mesh.Triangles)
  {
    std::swap(t[1], t[2]);
  }
  return mesh;
}

TriangleMesh Moved(TriangleMesh mesh, const Vec3& by)
{
  for (Vec3& p : mesh.Points)
  {
    p = p + by;
  }
  return mesh;
}

TriangleMesh Scaled(TriangleMesh mesh, double factor)
{
  for (Vec3& p : mesh.Points)
  {
    p = factor * p;
  }
  return mesh;
}

TriangleMesh Joined(TriangleMesh first, const TriangleMesh& second)
{
  const auto offset = static_cast<std::int32_t>(first.Points.size());
  first.Points.insert(first.Points.end(), second.Points.begin(), second.Points.end());
  for (const auto& [a, b, c] : second.Triangles)
  {
    first.Triangles.push_back({ a + offset, b + offset, c + offset });
  }
  first.Sides.insert(first.Sides.end(), second.Sides.begin(), second.Sides.end());
  return first;
}

TriangleMesh Sided(TriangleMesh mesh, Side side)
{
  mesh.Sides.assign(mesh.Triangles.size(), side);
  return mesh;
}

TriangleMesh SidedAtRandom(TriangleMesh mesh, unsigned seed)
{
  std::mt19937 random(seed);
  mesh.Sides.clear();
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    mesh.Sides.push_back(random() % 2 == 0 ? Side::Front : Side::Both);
  }
  return mesh;
}

std::shared_ptr<const TriangleSurface> MakeSurface(TriangleMesh mesh, Side side, EngineKind engine)
{
  SurfaceOptions options;
  options.TouchedSide = side;
  options.Engine = engine;
  std::string error;
  auto surface = TriangleSurface::Build(std::move(mesh), options, error);
  EXPECT_TRUE(surface) << error;
  return surface;
}

Vec3 operator+(const Vec3& a, const Vec3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

Vec3 operator-(const Vec3& a, const Vec3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vec3 operator*(double s, const Vec3& a)
{
  return { s * a[0], s * a[1], s * a[2] };
}

double Dot(const Vec3& a, const Vec3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 Cross(const Vec3& a, const Vec3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double Length(const Vec3& a)
{
  return std::sqrt(Dot(a, a));
}

Vec3 Unit(const Vec3& a)
{
  return (1.0 / Length(a)) * a;
}
}
