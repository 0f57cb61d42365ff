#ifndef Facet_h
#define Facet_h

#include "VectorMath.h"

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

/// How far a facet is taken to reach beyond each of its edges 0-1, 1-2 and 2-0.
using Growth = std::array<double, 3>;

/// Whether x, projected on the triangle's plane, lies in the triangle grown beyond its edges.
/// `normal` is the unit normal; its sign follows the corners' order.
inline bool CoversGrown(const Vector& normal, const Vector& a, const Vector& b, const Vector& c,
  const Vector& x, const Growth& growth)
{
  const auto isWithin = [&](const Vector& from, const Vector& to, double reach)
  {
    const Vector edge = to - from;
    const double inward = glm::dot(glm::cross(normal, edge), x - from);
    return inward >= 0.0 || inward * inward <= reach * reach * SquaredLength(edge);
  };
  return isWithin(a, b, growth[0]) && isWithin(b, c, growth[1]) && isWithin(c, a, growth[2]);
}

/// A facet is met a little beyond its edges, by so many clearances: closes gaps as wide.
constexpr double GrowthOverGaps = 4.0;
/// Where backs are touched too, less beyond an edge that facets share: a god-object that comes
/// around a sharp edge at one clearance's height passes behind the next facet's plane, no farther
/// beyond its edge than that, and must not be held there. A shared edge has no gap to close.
constexpr double GrowthSeenFromBehind = 0.25;

/// The widest that any facet of a surface reaches beyond itself.
inline double LargestGrowth(double clearance, double longestEdge)
{
  return (GrowthOverGaps + 1.0) * std::max(clearance, 1e-6 * longestEdge);
}
}

#endif
