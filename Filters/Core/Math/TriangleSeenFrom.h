#ifndef Haptics_TriangleSeenFrom_h
#define Haptics_TriangleSeenFrom_h

#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
/// @brief A triangle as it is seen from a point: which lines through the point meet it, as far as
/// float64 knows.
///
/// A line meets it where it passes its three edges on the same side. That is the sign of the
/// determinant of three differences of points: a sum of six products, each of at most the product
/// of the three sizes (largest coordinates). A difference is rounded once, and a product takes part
/// in two multiplications and three additions, so it errs by at most 6 (3 + 2 + 3) u of that
/// product of sizes. CGAL's filter bounds by the cube of the largest size, which decides nothing
/// about a way that is far shorter than the triangle.
class TriangleSeenFrom
{
public:
  enum class Answer
  {
    Misses,
    Meets,
    Unknown
  };

  TriangleSeenFrom() = default;
  TriangleSeenFrom(const Vector& from, const Vector& a, const Vector& b, const Vector& c)
  {
    const Vector corners[3] = { a - from, b - from, c - from };
    const double sizes[3] = { SizeOf(corners[0]), SizeOf(corners[1]), SizeOf(corners[2]) };
    for (int edge = 0; edge < 3; ++edge)
    {
      const int next = edge < 2 ? edge + 1 : 0;
      this->Sides[edge] = glm::cross(corners[edge], corners[next]);
      this->Errors[edge] = IsSafe(sizes[edge]) && IsSafe(sizes[next])
        ? RelativeError * sizes[edge] * sizes[next]
        : HUGE_VAL;
    }
  }

  /// Of the line that leads `way` from the point: a difference of points, rounded once, and not in
  /// the triangle's plane.
  Answer Ask(const Vector& way) const
  {
    const double size = SizeOf(way);
    if (!IsSafe(size))
    {
      return Answer::Unknown;
    }
    int above = 0;
    int below = 0;
    for (int edge = 0; edge < 3; ++edge)
    {
      const double side = glm::dot(way, this->Sides[edge]);
      const double error = size * this->Errors[edge];
      above += side > error;
      below += side < -error;
    }
    return above > 0 && below > 0 ? Answer::Misses
      : above == 3 || below == 3  ? Answer::Meets
                                  : Answer::Unknown;
  }

private:
  static double SizeOf(const Vector& v)
  {
    return std::max(std::abs(v.x), std::max(std::abs(v.y), std::abs(v.z)));
  }
  /// Whether products of three neither overflow nor lose digits.
  static bool IsSafe(double size) { return size > 1e-90 && size < 1e90; }

  /// Of a determinant, in products of sizes: 48 u, and some for the bound's own roundings.
  static constexpr double RelativeError = 64.0 * UnitRoundoff;

  Vector Sides[3];  ///< of the plane through the point and an edge
  double Errors[3]; ///< of a product with Sides, for a way of size 1
};
}

#endif
