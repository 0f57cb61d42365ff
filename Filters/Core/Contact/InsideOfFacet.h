#ifndef Haptics_InsideOfFacet_h
#define Haptics_InsideOfFacet_h

#include "haptics/Math/VectorMath.h"

#include <array>
#include <cstdint>

namespace haptics
{
/// @brief Where over one facet it is near none of its edges: as is asked again and again of a facet
/// that holds a god-object from one update to the next.
///
/// Says so only where CoverageOf() says Coverage::Inside. In the local frame of a surface that does
/// not deform.
class InsideOfFacet
{
public:
  bool Has(std::int32_t triangle, double own, const Vector& x) const
  {
    return triangle == this->Triangle && this->IsLearned && own == this->Own &&
      glm::dot(this->Inward[0], x) > this->Least[0] &&
      glm::dot(this->Inward[1], x) > this->Least[1] &&
      glm::dot(this->Inward[2], x) > this->Least[2];
  }

  /// For each place that is found to be inside: true where that has been often enough to learn
  /// where else it is, which takes as long as to ask a few times.
  bool IsWorthLearning(std::int32_t triangle, double own)
  {
    if (triangle != this->Triangle || own != this->Own)
    {
      this->Triangle = triangle;
      this->Own = own;
      this->Times = 0;
      this->IsLearned = false;
    }
    return this->Times < TimesToLearn && ++this->Times == TimesToLearn;
  }
  /// `normal` and `own`: as in CoverageOf(), `own` being at least 256 roundings of any coordinate.
  void Learn(const Vector& normal, const Vector& a, const Vector& b, const Vector& c)
  {
    this->IsLearned = true;
    const Vector* const corners[4] = { &a, &b, &c, &a };
    for (int k = 0; k < 3; ++k)
    {
      const Vector inward = glm::cross(normal, *corners[k + 1] - *corners[k]);
      this->Inward[k] = inward / glm::length(inward);
      this->Least[k] = glm::dot(this->Inward[k], *corners[k]) + ShareOfOwn * this->Own;
    }
  }

private:
  static constexpr int TimesToLearn = 3;
  /// More than `own` by more than what rounding makes of a distance.
  static constexpr double ShareOfOwn = 1.25;

  std::int32_t Triangle = -1;
  int Times = 0;
  double Own = 0.0;
  bool IsLearned = false;
  std::array<Vector, 3> Inward; ///< unit, along the facet, from each edge
  std::array<double, 3> Least;
};
}

#endif
