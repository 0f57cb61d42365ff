#ifndef Haptics_Facet_h
#define Haptics_Facet_h

#include "haptics/Math/AccurateCross.h"
#include "haptics/Math/VectorMath.h"

#include <algorithm>
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
  /// How many times rounding is amplified: at least |e1||e2| / |e1 × e2| at the anchor, or what is
  /// left of that where the cross product is worked out in twice the digits.
  double Condition = HUGE_VAL;
  double SmallestHeight = 0.0; ///< over the longest edge
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
    // The mean of the squared sides is at least their product, and needs no root.
    const double sides = 0.5 * (squared[next] + squared[last]);
    this->SetNormal(glm::cross(this->Corner[next] - v, this->Corner[last] - v), sides, 1.0);
    if (!(this->Condition < WellConditioned))
    {
      this->SetNormal(
        AccurateCross(v, this->Corner[next], this->Corner[last]), sides, ShareOfAccurateCross);
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

  /// From this condition on a normal is worked out in twice the digits.
  static constexpr double WellConditioned = 64.0;

private:
  /// `n`: along the normal, with an error of `share` times the roundings of a cross product.
  void SetNormal(const Vector& n, double sides, double share)
  {
    const double squaredLength = SquaredLength(n);
    if (squaredLength > 0.0)
    {
      const double inverse = 1.0 / std::sqrt(squaredLength);
      this->Normal = inverse * n;
      this->SmallestHeight = squaredLength * inverse / this->LongestEdge;
      this->Condition = share < 1.0 ? 1.0 + share * sides * inverse : sides * inverse;
    }
  }
};

/// A facet is met a little beyond its edges, by so many clearances, where an edge is no other
/// facet's: closes gaps as wide.
constexpr double GrowthOverGaps = 4.0;
/// Where several facets come together with gaps between them, there is a hole in which the next
/// facets may be so many clearances apart.
constexpr double WidthOfGaps = 1.5 * GrowthOverGaps;
/// Beyond an edge that facets share there is no gap: only rounding to cover. It has to be less than
/// one clearance: a god-object that comes around a sharp edge passes behind the next facet's plane
/// at one clearance's height, and must not be held there.
constexpr double GrowthOverSharedEdges = 0.25;

/// How a point that is projected on a facet's plane lies.
enum class Coverage
{
  None,
  Reach, ///< beyond the facet, where it reaches over a gap
  Own,   ///< on the facet itself, or as good as that
  Inside ///< on the facet, and not near any of its edges
};

/// The nearest point to x on a segment.
inline Vector NearestOnSegment(const Vector& from, const Vector& to, const Vector& x)
{
  const Vector edge = to - from;
  const double squared = SquaredLength(edge);
  const double along =
    squared > 0.0 ? std::clamp(glm::dot(x - from, edge) / squared, 0.0, 1.0) : 0.0;
  return from + along * edge;
}

/// The nearest point to x on the triangle's edges, be they as close to one line as they may.
inline Vector NearestOnEdges(const Vector& a, const Vector& b, const Vector& c, const Vector& x)
{
  Vector nearest = a;
  double least = HUGE_VAL;
  const auto take = [&](const Vector& from, const Vector& to)
  {
    const Vector point = NearestOnSegment(from, to, x);
    const double distance = SquaredLength(x - point);
    if (distance < least)
    {
      least = distance;
      nearest = point;
    }
  };
  take(a, b);
  take(b, c);
  take(c, a);
  return nearest;
}

/// How x, projected on a triangle's plane, lies to one of its edges, or to several side by side.
template <class Real>
struct EdgeSide
{
  Real Inward; ///< distance from the edge, times the edge's length; negative beyond it
  Real SquaredLength;

  /// `normal`: the triangle's, by the order of its corners.
  EdgeSide(const Vector& normal, const Real& fromX, const Real& fromY, const Real& fromZ,
    const Real& toX, const Real& toY, const Real& toZ, const Vector& x)
  {
    const Real edgeX = toX - fromX;
    const Real edgeY = toY - fromY;
    const Real edgeZ = toZ - fromZ;
    this->Inward = (normal.y * edgeZ - edgeY * normal.z) * (x.x - fromX) +
      (normal.z * edgeX - edgeZ * normal.x) * (x.y - fromY) +
      (normal.x * edgeY - edgeX * normal.y) * (x.z - fromZ);
    this->SquaredLength = edgeX * edgeX + edgeY * edgeY + edgeZ * edgeZ;
  }
  auto IsInside(double own) const
  {
    return (this->Inward > 0.0) & (this->Inward * this->Inward > own * own * this->SquaredLength);
  }
};

/// The same for its edges ab, bc and ca.
class EdgeSides
{
public:
  EdgeSides(
    const Vector& normal, const Vector& a, const Vector& b, const Vector& c, const Vector& x)
    : First(normal, Two{ a.x, b.x }, Two{ a.y, b.y }, Two{ a.z, b.z }, Two{ b.x, c.x },
        Two{ b.y, c.y }, Two{ b.z, c.z }, x)
    , Last(normal, c.x, c.y, c.z, a.x, a.y, a.z, x)
  {
  }
  double Inward(int k) const { return k < 2 ? this->First.Inward[k] : this->Last.Inward; }
  bool IsNear(int k, double width) const
  {
    const double squared = k < 2 ? this->First.SquaredLength[k] : this->Last.SquaredLength;
    return this->Inward(k) * this->Inward(k) <= width * width * squared;
  }
  /// On the inner side of all of them, and not near any.
  bool IsInside(double own) const
  {
    const auto areFirst = this->First.IsInside(own);
    return (areFirst[0] & areFirst[1]) != 0 && this->Last.IsInside(own);
  }

private:
  using Two = double __attribute__((vector_size(16)));
  EdgeSide<Two> First;
  EdgeSide<double> Last;
};

/// Whether CoverageOf() is Coverage::Inside.
inline bool IsInside(const Vector& normal, const Vector& a, const Vector& b, const Vector& c,
  const Vector& x, double own)
{
  return EdgeSides(normal, a, b, c, x).IsInside(own);
}

/// How x, projected on the triangle's plane, lies over it. The triangle reaches by `overGaps`
/// beyond edges that are `isOpen()` and no farther from its corners, so that a needle ends where
/// its tip is; within `own` of it is as good as on it. `normal` is the unit normal; its sign
/// follows the corners' order. `nearest` is set with Coverage::Reach: to the triangle's nearest
/// point.
template <class EdgeTest>
inline Coverage CoverageOf(const Vector& normal, const Vector& a, const Vector& b, const Vector& c,
  const Vector& x, double own, double overGaps, const EdgeTest& isOpen, Vector& nearest)
{
  const EdgeSides sides(normal, a, b, c, x);
  if (sides.IsInside(own))
  {
    return Coverage::Inside;
  }
  double reach = own;
  for (int k = 0; k < 3; ++k)
  {
    if (sides.Inward(k) >= 0.0)
    {
      continue;
    }
    if (isOpen(k) && sides.IsNear(k, overGaps))
    {
      reach = overGaps;
    }
    else if (!sides.IsNear(k, own))
    {
      return Coverage::None;
    }
  }
  // Near an edge: which of a thin triangle's is certain only of its distance.
  const Vector y = x - glm::dot(normal, x - a) * normal;
  const Vector* const corners[4] = { &a, &b, &c, &a };
  for (int k = 0; k < 3; ++k)
  {
    if (sides.IsNear(k, own) &&
      SquaredLength(y - NearestOnSegment(*corners[k], *corners[k + 1], y)) <= own * own)
    {
      return Coverage::Own;
    }
  }
  nearest = NearestOnEdges(a, b, c, y);
  const double distance = SquaredLength(nearest - y);
  return distance <= own * own ? Coverage::Own
    : distance > reach * reach ? Coverage::None
                               : Coverage::Reach;
}

/// The widest that any facet of a surface reaches beyond itself.
inline double LargestGrowth(double clearance, double longestEdge)
{
  return (WidthOfGaps + 1.0) * std::max(clearance, 1e-6 * longestEdge);
}
}

#endif
