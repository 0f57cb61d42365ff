#include "ExactQueries.h"

#include "AnalyticSurfaces.h"
#include "ExactSigns.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics::testing
{
namespace
{
/// Signs of the line p-q against the three edges: 1 inside, 0 on an edge, -1 outside.
int LineInTriangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const std::array<int, 3> signs{ SignOfVolume(p, q, a, b), SignOfVolume(p, q, b, c),
    SignOfVolume(p, q, c, a) };
  const auto [low, high] = std::minmax_element(signs.begin(), signs.end());
  if (*low < 0 && *high > 0)
  {
    return -1;
  }
  return std::count(signs.begin(), signs.end(), 0) ? 0 : 1;
}
}

ExactQueries::ExactQueries(std::shared_ptr<const TriangleSurface> surface, double fraction)
  : Surface(std::move(surface))
{
  for (std::size_t i = 0; i < this->Surface->Points().size(); ++i)
  {
    this->Points.push_back(this->Surface->PointAt(static_cast<std::int32_t>(i), fraction));
  }
  for (const Triangle& t : this->Surface->Triangles())
  {
    Bounds box{ this->Points[t[0]], this->Points[t[0]] };
    for (const std::int32_t corner : t)
    {
      for (int k = 0; k < 3; ++k)
      {
        const double x = this->Points[corner][k];
        box.Low[k] = std::min(box.Low[k], x);
        box.High[k] = std::max(box.High[k], x);
      }
    }
    this->Boxes.push_back(box);
  }
}

template <class Visitor>
bool ExactQueries::VisitBoxes(const Bounds& box, const Visitor& visit) const
{
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    const Bounds& b = this->Boxes[i];
    const bool apart = b.High[0] < box.Low[0] || b.Low[0] > box.High[0] || b.High[1] < box.Low[1] ||
      b.Low[1] > box.High[1] || b.High[2] < box.Low[2] || b.Low[2] > box.High[2];
    if (!apart)
    {
      const auto& [a, b1, c] = this->Surface->Triangles()[i];
      const auto& points = this->Points;
      if (visit(points[a], points[b1], points[c], static_cast<std::int32_t>(i)))
      {
        return true;
      }
    }
  }
  return false;
}

bool ExactQueries::Crosses(const Vec3& from, const Vec3& to) const
{
  const Vec3& p = from;
  const Vec3& q = to;
  Bounds box;
  for (int k = 0; k < 3; ++k)
  {
    box.Low[k] = std::min(p[k], q[k]);
    box.High[k] = std::max(p[k], q[k]);
  }
  return this->VisitBoxes(box,
    [&](const Vec3& a, const Vec3& b, const Vec3& c, std::int32_t triangle)
    {
      const int before = SignOfVolume(a, b, c, p);
      const int after = SignOfVolume(a, b, c, q);
      const bool both = this->Surface->TouchesBack(triangle);
      // Where both sides are touched, a point comes onto a triangle only within its plane, around
      // its rim, and may leave to either side.
      const bool changesSide =
        both ? before != 0 && before * after <= 0 : before >= 0 && after <= 0 && before != after;
      return changesSide && LineInTriangle(p, q, a, b, c) >= 0;
    });
}

bool ExactQueries::IsInside(const Vec3& point) const
{
  const Vec3& p = point;
  // A ray through an edge or a corner says nothing: take another.
  for (int attempt = 0; attempt < 16; ++attempt)
  {
    const double reach = 4.0 * this->Surface->Radius() + 2.0 * Length(point);
    const Vec3 end =
      point + reach * Unit({ 0.577 + 0.013 * attempt, 0.313 - 0.17 * attempt, 0.7547 });
    const Vec3& q = end;
    Bounds box;
    for (int k = 0; k < 3; ++k)
    {
      box.Low[k] = std::min(point[k], end[k]);
      box.High[k] = std::max(point[k], end[k]);
    }
    int crossings = 0;
    const bool isDegenerate = this->VisitBoxes(box,
      [&](const Vec3& a, const Vec3& b, const Vec3& c, std::int32_t)
      {
        const int before = SignOfVolume(a, b, c, p);
        const int after = SignOfVolume(a, b, c, q);
        if (before * after > 0 || (before == 0 && after == 0))
        {
          return false;
        }
        const int where = LineInTriangle(p, q, a, b, c);
        if (where < 0)
        {
          return false;
        }
        ++crossings;
        return where == 0 || before == 0 || after == 0;
      });
    if (!isDegenerate)
    {
      return crossings % 2 == 1;
    }
  }
  return false; // the point itself lies on the surface
}

double ExactQueries::Distance(const Vec3& point) const
{
  using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    Vec3 outside;
    for (int k = 0; k < 3; ++k)
    {
      outside[k] =
        std::max({ this->Boxes[i].Low[k] - point[k], point[k] - this->Boxes[i].High[k], 0.0 });
    }
    if (Length(outside) > best)
    {
      continue;
    }
    const auto& [a, b, c] = this->Surface->Triangles()[i];
    const auto& points = this->Points;
    const auto corner = [&points](int index)
    { return Exact::Point_3(points[index][0], points[index][1], points[index][2]); };
    const Exact::Triangle_3 triangle(corner(a), corner(b), corner(c));
    const double squared = CGAL::to_double(
      CGAL::squared_distance(Exact::Point_3(point[0], point[1], point[2]), triangle));
    best = std::min(best, std::sqrt(squared));
  }
  return best;
}
}
