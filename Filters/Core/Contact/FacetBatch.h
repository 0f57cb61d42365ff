#ifndef Haptics_FacetBatch_h
#define Haptics_FacetBatch_h

#include "haptics/Surface/Facet.h"

#include <array>
#include <cstdint>

namespace haptics
{
/// @brief The planes of a few dozen triangles worked out side by side.
///
/// The same arithmetic as Facet, step by step, in loops without branches that a compiler can turn
/// into vector instructions: one triangle after the other costs three times as much, and that was
/// most of what gathering costs.
class FacetBatch
{
public:
  static constexpr std::int32_t Capacity = 64;

  void Set(std::int32_t i, const Vector& a, const Vector& b, const Vector& c)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->A[axis][i] = a[axis];
      this->B[axis][i] = b[axis];
      this->C[axis][i] = c[axis];
    }
  }

  /// What is asked of the triangles.
  struct Question
  {
    Vector Middle{ 0 };   ///< of the ball that a triangle has to meet
    double Radius = 0.0;  ///< of that ball
    Vector Centre{ 0 };   ///< planes are given relative to it
    double Farthest = 0;  ///< no place that will be asked for is farther from Centre
    Vector Position{ 0 }; ///< SquaredDistance is from here
    double MinimumClearance = 0.0;
  };
  /// Works out the first `count` triangles set.
  void Answer(std::int32_t count, const Question& question);

  ///@{
  /// Of triangle i, after Answer().
  /// Whether it may meet the ball.
  bool Meets(std::int32_t i) const { return this->SquaredDistances[i] >= 0.0; }
  /// Of its box from Position.
  double SquaredDistance(std::int32_t i) const { return this->SquaredDistances[i]; }
  double Normal(std::int32_t i, int axis) const { return this->N[axis][i]; }
  double PlaneOffset(std::int32_t i) const { return this->Offsets[i]; }
  double Error(std::int32_t i) const { return this->Errors[i]; }
  double Clearance(std::int32_t i) const { return this->Clearances[i]; }
  /// The corners of its box.
  double Low(std::int32_t i, int axis) const { return this->Lows[axis][i]; }
  double High(std::int32_t i, int axis) const { return this->Highs[axis][i]; }
  /// Whether all of the above is good enough; of a thin triangle, or one without area, Facet has to
  /// be asked.
  bool IsWellKnown(std::int32_t i) const { return this->Conditions[i] < Facet::WellConditioned; }
  ///@}

private:
  using Values = std::array<double, Capacity>;

  std::array<Values, 3> A, B, C, N; ///< corners and unit normals by axis
  std::array<Values, 3> Lows, Highs;
  Values Offsets, Errors, Clearances, Conditions;
  Values SquaredDistances; ///< negative where the triangle does not meet the ball
};
}

#endif
