#include "Judge.h"

#include "AnalyticSurfaces.h"
#include "ExactSigns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace haptics::testing
{
namespace
{
constexpr int SidesOfCone = 16;
constexpr int LargestLeaf = 4;

std::vector<bool> BacksOf(const TriangleSurface& surface)
{
  std::vector<bool> backs;
  for (std::size_t i = 0; i < surface.Triangles().size(); ++i)
  {
    backs.push_back(surface.TouchesBack(static_cast<std::int32_t>(i)));
  }
  return backs;
}

/// Whether segment and box are farther apart than `reach`, certainly: by the axes of the box and
/// those across it and the segment. `slack` is far over what rounding makes of that.
bool AreApart(
  const Vec3& from, const Vec3& to, double reach, const Vec3& low, const Vec3& high, double slack)
{
  Vec3 half, middle, way;
  for (int k = 0; k < 3; ++k)
  {
    if (std::max(from[k], to[k]) + reach < low[k] || std::min(from[k], to[k]) - reach > high[k])
    {
      return true;
    }
    half[k] = 0.5 * (high[k] - low[k]) + reach + slack;
    middle[k] = 0.5 * (from[k] + to[k]) - 0.5 * (low[k] + high[k]);
    way[k] = 0.5 * (to[k] - from[k]);
  }
  for (int k = 0; k < 3; ++k)
  {
    const int u = (k + 1) % 3;
    const int v = (k + 2) % 3;
    const double distance = std::abs(middle[u] * way[v] - middle[v] * way[u]);
    if (distance > half[u] * std::abs(way[v]) + half[v] * std::abs(way[u]))
    {
      return true;
    }
  }
  return false;
}
}

Judge::Judge(const TriangleSurface& surface)
  : Judge(surface.Points(), surface.Triangles(), BacksOf(surface))
{
}

Judge::Judge(std::vector<Vec3> points, std::vector<Triangle> triangles, std::vector<bool> hasBack)
  : Places(std::move(points))
  , Corners(std::move(triangles))
  , Backs(std::move(hasBack))
{
  this->Build();
}

void Judge::Build()
{
  std::vector<Box> boxes(this->Corners.size());
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    const auto& [a, b, c] = this->Corners[i];
    const Vec3 &p = this->Places[a], &q = this->Places[b], &r = this->Places[c];
    for (int k = 0; k < 3; ++k)
    {
      boxes[i].Low[k] = std::min({ p[k], q[k], r[k] });
      boxes[i].High[k] = std::max({ p[k], q[k], r[k] });
      this->Size = std::max({ this->Size, -boxes[i].Low[k], boxes[i].High[k] });
    }
    if (!HasNoArea(p, q, r))
    {
      this->Order.push_back(static_cast<std::int32_t>(i));
    }
  }
  this->Nodes.reserve(2 * this->Order.size() / LargestLeaf + 2);
  this->Nodes.push_back({ {}, 0, static_cast<std::int32_t>(this->Order.size()) });
  for (std::size_t n = 0; n < this->Nodes.size(); ++n)
  {
    Node node = this->Nodes[n];
    const double far = std::numeric_limits<double>::infinity();
    node.Bounds = { { far, far, far }, { -far, -far, -far } };
    const auto begin = this->Order.begin() + node.First;
    const auto end = begin + node.Count;
    for (auto i = begin; i != end; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        node.Bounds.Low[k] = std::min(node.Bounds.Low[k], boxes[*i].Low[k]);
        node.Bounds.High[k] = std::max(node.Bounds.High[k], boxes[*i].High[k]);
      }
    }
    if (node.Count > LargestLeaf)
    {
      const Vec3 extent = node.Bounds.High - node.Bounds.Low;
      const int axis =
        static_cast<int>(std::max_element(extent.begin(), extent.end()) - extent.begin());
      const std::int32_t half = node.Count / 2;
      std::nth_element(begin, begin + half, end,
        [&](std::int32_t x, std::int32_t y) {
          return boxes[x].Low[axis] + boxes[x].High[axis] <
            boxes[y].Low[axis] + boxes[y].High[axis];
        });
      const Node left{ {}, node.First, half };
      const Node right{ {}, node.First + half, node.Count - half };
      node.First = static_cast<std::int32_t>(this->Nodes.size());
      node.Count = 0;
      this->Nodes.push_back(left);
      this->Nodes.push_back(right);
    }
    this->Nodes[n] = node;
  }
  for (const std::int32_t triangle : this->Order)
  {
    this->Boxes.push_back(boxes[triangle]);
    this->LargestClearance = std::max(this->LargestClearance, this->ClearanceOf(triangle));
  }
}

template <class Visitor>
bool Judge::Visit(const Vec3& from, const Vec3& to, double reach, const Visitor& visit) const
{
  if (this->Order.empty())
  {
    return false;
  }
  double size = this->Size;
  for (int k = 0; k < 3; ++k)
  {
    size = std::max({ size, std::abs(from[k]), std::abs(to[k]) });
  }
  const double slack = 0x1p-44 * size;
  std::int32_t stack[64];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0)
  {
    const Node& node = this->Nodes[stack[--depth]];
    if (AreApart(from, to, reach, node.Bounds.Low, node.Bounds.High, slack))
    {
      continue;
    }
    if (node.Count == 0)
    {
      stack[depth++] = node.First;
      stack[depth++] = node.First + 1;
      continue;
    }
    for (std::int32_t i = node.First; i < node.First + node.Count; ++i)
    {
      if (!AreApart(from, to, reach, this->Boxes[i].Low, this->Boxes[i].High, slack) &&
        visit(this->Order[i]))
      {
        return true;
      }
    }
  }
  return false;
}

std::int32_t Judge::FindCrossed(const Vec3& from, const Vec3& to) const
{
  std::int32_t crossed = Nothing;
  this->Visit(from, to, 0.0,
    [&](std::int32_t triangle)
    {
      const auto& [i, j, k] = this->Corners[triangle];
      const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
      const int before = SignOfVolume(a, b, c, from);
      if (before < 0 && !this->Backs[triangle])
      {
        return false;
      }
      const int after = SignOfVolume(a, b, c, to);
      // Where both sides are touched, a point comes onto a triangle only within its plane, around
      // its rim, and may leave to either side.
      const bool changesSide =
        this->Backs[triangle] ? before != 0 && before * after <= 0 : after <= 0 && before != after;
      if (changesSide && SegmentMeets(from, to, a, b, c))
      {
        crossed = triangle;
      }
      return crossed != Nothing;
    });
  return crossed;
}

std::int32_t Judge::FindGrazed(const Vec3& from, const Vec3& to) const
{
  std::int32_t grazed = Nothing;
  this->Visit(from, to, 0.0,
    [&](std::int32_t triangle)
    {
      const auto& [i, j, k] = this->Corners[triangle];
      const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
      if (this->Backs[triangle] && SignOfVolume(a, b, c, from) == 0 &&
        SignOfVolume(a, b, c, to) == 0 && SegmentMeets(from, to, a, b, c))
      {
        grazed = triangle;
      }
      return grazed != Nothing;
    });
  return grazed;
}

bool Judge::IsOnTriangle(const Vec3& x) const
{
  return this->Visit(x, x, 0.0,
    [&](std::int32_t triangle)
    {
      const auto& [i, j, k] = this->Corners[triangle];
      return SegmentMeets(x, x, this->Places[i], this->Places[j], this->Places[k]);
    });
}

/// `cone`: the corners of its base, then those of its blunt tip.
bool Judge::Meets(std::int32_t triangle, const Vec3& eye, const std::vector<Vec3>& cone) const
{
  const auto& [i, j, k] = this->Corners[triangle];
  const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
  if (!this->Backs[triangle] && SignOfVolume(a, b, c, eye) < 0)
  {
    return false; // seen from behind
  }
  // Two convex bodies meet where an edge of one meets a face of the other, or one holds the other:
  // the triangle has no inside to hold the cone, which has one to hold the triangle.
  bool isWithin = true;
  const Vec3* const base = cone.data();
  const Vec3* const tip = base + SidesOfCone;
  const auto meetsFace = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& inner)
  {
    if (HasNoArea(p, q, r))
    {
      return false; // of a tip that is a point
    }
    isWithin = isWithin && SignOfVolume(p, q, r, a) * SignOfVolume(p, q, r, inner) > 0;
    return SegmentMeets(a, b, p, q, r) || SegmentMeets(b, c, p, q, r) ||
      SegmentMeets(c, a, p, q, r);
  };
  for (int side = 0; side < SidesOfCone; ++side)
  {
    const int next = (side + 1) % SidesOfCone;
    const Vec3& inner = base[(side + SidesOfCone / 2) % SidesOfCone];
    if (SegmentMeets(tip[side], base[side], a, b, c) ||
      SegmentMeets(base[side], base[next], a, b, c) ||
      SegmentMeets(tip[side], tip[next], a, b, c) ||
      meetsFace(tip[side], base[side], base[next], inner) ||
      meetsFace(tip[side], base[next], tip[next], inner))
    {
      return true;
    }
    const bool isFan = side > 0 && next > 0;
    if (isFan &&
      (meetsFace(base[0], base[side], base[next], eye) ||
        meetsFace(tip[0], tip[side], tip[next], base[0])))
    {
      return true;
    }
  }
  return isWithin;
}

bool Judge::IsInView(const Vec3& goal, const Vec3& eye, double spread, double slack) const
{
  const auto blocks = [&](std::int32_t triangle)
  {
    const auto& [i, j, k] = this->Corners[triangle];
    const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
    if ((this->Backs[triangle] || SignOfVolume(a, b, c, eye) >= 0) &&
      SegmentMeets(eye, goal, a, b, c))
    {
      this->LastBlocker = triangle;
      return true;
    }
    return false;
  };
  if (this->LastBlocker != Nothing && blocks(this->LastBlocker))
  {
    return false;
  }
  if (this->Visit(eye, goal, 0.0, blocks))
  {
    return false;
  }
  const Vec3 axis = goal - eye;
  const double length = Length(axis);
  if (length == 0.0)
  {
    return true;
  }
  const Vec3 ahead = (1.0 / length) * axis;
  int least = 0;
  double largest = this->Size;
  for (int k = 0; k < 3; ++k)
  {
    least = std::abs(ahead[k]) < std::abs(ahead[least]) ? k : least;
    largest = std::max({ largest, std::abs(goal[k]), std::abs(eye[k]) });
  }
  Vec3 across{};
  across[least] = 1.0;
  const Vec3 u = Unit(Cross(ahead, across));
  const Vec3 v = Cross(ahead, u);
  // Around the cone, and by rounding wider.
  const double wider = 1.0 / std::cos(M_PI / SidesOfCone);
  const double radius = wider * std::max(spread * length, slack) + 0x1p-50 * largest;
  std::vector<Vec3> cone;
  for (const auto& [middle, wide] : { std::pair(goal, radius), std::pair(eye, wider * slack) })
  {
    for (int side = 0; side < SidesOfCone; ++side)
    {
      const double angle = 2.0 * M_PI * side / SidesOfCone;
      cone.push_back(middle + (wide * std::cos(angle)) * u + (wide * std::sin(angle)) * v);
    }
  }
  return !this->Visit(eye, goal, 1.1 * radius,
    [&](std::int32_t triangle) { return this->Meets(triangle, eye, cone); });
}

double Judge::ClearanceOf(std::int32_t triangle) const
{
  const auto& [i, j, k] = this->Corners[triangle];
  const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
  const double longest = std::max({ Length(b - a), Length(c - b), Length(a - c) });
  const double height = Length(Cross(b - a, c - a)) / longest;
  // A normal is known to some roundings of the longest edge over the height.
  const double known = height > 0.0 ? 0x1p-44 * longest * (this->Size / height) : HUGE_VAL;
  return std::min(known, 1e-6 * longest);
}

double Judge::SliverClearance(const Vec3& x, double reach) const
{
  double largest = 0.0;
  this->Visit(x, x, reach,
    [&](std::int32_t triangle)
    {
      largest = std::max(largest, this->ClearanceOf(triangle));
      return false;
    });
  return largest;
}
std::vector<Vec3> Judge::NormalsNear(const Vec3& x, double reach) const
{
  std::vector<Vec3> normals;
  this->Visit(x, x, reach,
    [&](std::int32_t triangle)
    {
      const auto& [i, j, k] = this->Corners[triangle];
      const Vec3 &a = this->Places[i], &b = this->Places[j], &c = this->Places[k];
      const Vec3 normal = Cross(b - a, c - a);
      const int side = SignOfVolume(a, b, c, x);
      if (Length(normal) > 0.0)
      {
        normals.push_back((side < 0 ? -1.0 : 1.0) * Unit(normal));
      }
      return false;
    });
  return normals;
}

std::vector<std::int32_t> Judge::FindNear(const Vec3& from, const Vec3& to, double reach) const
{
  std::vector<std::int32_t> near;
  this->Visit(from, to, reach,
    [&near](std::int32_t triangle)
    {
      near.push_back(triangle);
      return false;
    });
  return near;
}
}
