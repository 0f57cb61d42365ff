#ifndef Haptics_Facet_h
#define Haptics_Facet_h

#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace haptics
{
/// @brief The plane of one triangle, and how well float64 knows it.
///
/// All distances are evaluated as n·(x − v) with v a corner of the triangle, so that their error
/// grows with the distance from the triangle and not with that from the world's origin.
struct Facet
{
  Vector Corner[3];   ///< as given; Corner[Anchor] is the one opposite the longest edge
  Vector Normal{ 0 }; ///< unit; zero when the triangle has no area
  double LongestEdge = 0.0;
  /// At least |e1||e2| / |e1 × e2| at the anchor: how many times rounding is amplified.
  double Condition = HUGE_VAL;
  int Anchor = 0;

  Facet(const Vector& a, const Vector& b, const Vector& c)
    : Corner{ a, b, c }
  {
    const double squared[3] = { SquaredLength(c - b), SquaredLength(a - c), SquaredLength(b - a) };
    // By the law of sines the angle opposite the longest edge has the largest sine.
    this->Anchor = squared[0] >= squared[1] ? (squared[0] >= squared[2] ? 0 : 2)
                                            : (squared[1] >= squared[2] ? 1 : 2);
    this->LongestEdge = std::sqrt(squared[this->Anchor]);
    const int next = (this->Anchor + 1) % 3;
    const int last = (this->Anchor + 2) % 3;
    const Vector& v = this->Corner[this->Anchor];
    const Vector n = glm::cross(this->Corner[next] - v, this->Corner[last] - v);
    const double squaredLength = SquaredLength(n);
    if (squaredLength > 0.0)
    {
      const double inverse = 1.0 / std::sqrt(squaredLength);
      this->Normal = inverse * n;
      // The mean of the squared sides is at least their product, and needs no root.
      this->Condition = 0.5 * (squared[next] + squared[last]) * inverse;
    }
  }

  bool HasArea() const { return std::isfinite(this->Condition); }

  /// Bound on the error of Normal·(x − anchor) for any x at most `distance` from the anchor.
  /// The cross product's error is at most 9u|e1||e2|, the rest of the evaluation below 16u.
  double DistanceError(double distance) const
  {
    return 32.0 * UnitRoundoff * this->Condition * distance;
  }

  /// How far in front of this facet the god-object is kept: enough for the side to be certain at
  /// `distance` from it, but never more than a millionth of the facet.
  double Clearance(double minimum, double distance) const
  {
    return std::max(
      minimum, std::min(4.0 * this->DistanceError(distance), 1e-6 * this->LongestEdge));
  }
};

/// A facet is met a little beyond its edges, by so many clearances, where an edge is no other
/// facet's: closes gaps as wide.
constexpr double GrowthOverGaps = 4.0;
/// Beyond an edge that facets share there is no gap: only rounding to cover. It has to be less than
/// one clearance: a god-object that comes around a sharp edge passes behind the next facet's plane
/// at one clearance's height, and must not be held there.
constexpr double GrowthOverSharedEdges = 0.25;

/// How far a facet is taken to reach beyond each of its edges 0-1, 1-2 and 2-0.
using Growth = std::array<double, 3>;

/// How a point that is projected on a facet's plane lies.
enum class Coverage
{
  None,
  Reach, ///< beyond the facet, where it reaches over a gap
  Own    ///< on the facet itself, or as good as that
};

/// How x lies over the triangle. It reaches beyond its edges by `growth` and no farther from its
/// corners either, so that a needle ends where its tip is; within `own` of it is as good as on it.
/// `normal` is the unit normal; its sign follows the corners' order. `nearest` is set where x is
/// beyond the triangle and it reaches there: to its nearest point.
inline Coverage CoverageOf(const Vector& normal, const Vector& a, const Vector& b, const Vector& c,
  const Vector& x, const Growth& growth, double own, Vector& nearest)
{
  double reach = -1.0;
  const auto isWithin = [&](const Vector& from, const Vector& to, double width)
  {
    const Vector edge = to - from;
    const double inward = glm::dot(glm::cross(normal, edge), x - from);
    if (inward >= 0.0)
    {
      return true;
    }
    reach = std::max(reach, width);
    return inward * inward <= width * width * SquaredLength(edge);
  };
  if (!isWithin(a, b, growth[0]) || !isWithin(b, c, growth[1]) || !isWithin(c, a, growth[2]))
  {
    return Coverage::None;
  }
  if (reach < 0.0)
  {
    return Coverage::Own;
  }
  const Vector y = x - glm::dot(normal, x - a) * normal;
  const Vector way = NearestToOrigin(a - y, b - y, c - y);
  nearest = y + way;
  const double squared = SquaredLength(way);
  return squared > reach * reach ? Coverage::None
    : squared > own * own        ? Coverage::Reach
                                 : Coverage::Own;
}

/// The widest that any facet of a surface reaches beyond itself.
inline double LargestGrowth(double clearance, double longestEdge)
{
  return (GrowthOverGaps + 1.0) * std::max(clearance, 1e-6 * longestEdge);
}
}

#endif
