#ifndef Haptics_BallFacet_h
#define Haptics_BallFacet_h

#include "haptics/Math/VectorMath.h"

namespace haptics
{
/// A plane between a point and a facet.
struct Separation
{
  Vector Normal{ 0 };    ///< unit, towards the point
  double Distance = 0.0; ///< that no corner of the facet is nearer along it
  double Height = 0.0;   ///< over the facet's own plane
  int Edge = -1;         ///< nearest is one from this corner to the next; -1: no edge
  int Corner = -1;       ///< nearest is this corner
};

/// @brief A triangle as a ball meets it: by planes that separate the ball's centre from it.
///
/// Such a plane is normal to (centre - nearest point), at the least height over the triangle's
/// three corners: it separates whatever the nearest point's own error is.
struct BallFacet
{
  Vector A{ 0 }, B{ 0 }, C{ 0 };
  Vector Normal{ 0 }; ///< unit; zero without area
  double Doubt = 0.0; ///< error of the normal
  Vector Edges[3]{};  ///< from A, B, and C to the next
  double SquaredLengths[3]{};
  Vector Inward[3]{};  ///< in its plane, across the edges
  bool IsThin = false; ///< its edges may be beyond rounding's reach of each other, or not

  BallFacet() = default;
  BallFacet(const Vector& a, const Vector& b, const Vector& c) { this->Set(a, b, c); }
  void Set(const Vector& a, const Vector& b, const Vector& c);

  /// Whether x, projected on its plane, is within its edges.
  bool IsOver(const Vector& x) const
  {
    return glm::dot(this->Inward[0], x - this->A) >= 0.0 &&
      glm::dot(this->Inward[1], x - this->B) >= 0.0 &&
      glm::dot(this->Inward[2], x - this->C) >= 0.0;
  }

  /// Of x over the plane through the facet's lowest corner along its normal.
  double LeastHeight(const Vector& x) const;

  ///@{
  /// `isOneSided`: right over the facet the plane is that of its front, though x be behind it. In
  /// place where it is kept, as a copy of what has just been written is waited for.
  void Separate(bool isOneSided, const Vector& x, Separation& separation) const;
  Separation Separate(bool isOneSided, const Vector& x) const
  {
    Separation separation;
    this->Separate(isOneSided, x, separation);
    return separation;
  }
  ///@}

private:
  /// Exact. `height`: of x over the plane.
  bool IsBehind(const Vector& x, double height) const;
};
}

#endif
