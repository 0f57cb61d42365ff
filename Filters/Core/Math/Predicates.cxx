#include "haptics/Math/Predicates.h"

#include "haptics/Math/TriangleSeenFrom.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace haptics
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 ToPoint(const Vector& v)
{
  return { v.x, v.y, v.z };
}
}

int Orientation(const Vector& a, const Vector& b, const Vector& c, const Vector& d) noexcept
{
  return static_cast<int>(CGAL::orientation(ToPoint(a), ToPoint(b), ToPoint(c), ToPoint(d)));
}

bool LineMeetsTriangle(
  const Vector& p, const Vector& q, const Vector& a, const Vector& b, const Vector& c) noexcept
{
  const auto answer = TriangleSeenFrom(p, a, b, c).Ask(q - p);
  if (answer != TriangleSeenFrom::Answer::Unknown)
  {
    return answer == TriangleSeenFrom::Answer::Meets;
  }
  bool positive = false;
  bool negative = false;
  const Vector* const corners[4] = { &a, &b, &c, &a };
  for (int edge = 0; edge < 3; ++edge)
  {
    const int side = Orientation(p, q, *corners[edge], *corners[edge + 1]);
    positive = positive || side > 0;
    negative = negative || side < 0;
    if (positive && negative)
    {
      return false;
    }
  }
  return true;
}
}
