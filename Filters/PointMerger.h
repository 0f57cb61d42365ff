#ifndef Haptics_PointMerger_h
#define Haptics_PointMerger_h

#include "haptics/Math/Vec3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace haptics
{
/// @brief Gives equal points one index; deterministic, in O(1) a point whatever their distribution.
///
/// A point goes to the nearest kept point within the tolerance, or is kept itself. VTK's locators
/// bin points by the bounds, and slow down to O(n^2) where one outlier stretches these.
class PointMerger
{
public:
  /// `tolerance`: largest distance between merged points [unit of the points]; 0 merges only points
  /// with equal float64 coordinates.
  PointMerger(std::size_t expectedPoints, double tolerance);

  /// Index of the kept point that stands for the finite `point`: Points().size() - 1 where it is
  /// new.
  std::int32_t Insert(const Vec3& point);
  const std::vector<Vec3>& Points() const { return this->Merged; }

private:
  Vec3 Cell(const Vec3& point) const;
  std::size_t Slot(const Vec3& cell) const;
  std::int32_t FindNear(const Vec3& point, const Vec3& cell) const;
  void Grow();

  double Tolerance;
  std::vector<Vec3> Merged;
  std::vector<std::int32_t> Next;  // the next point of the same cell; unused at tolerance 0
  std::vector<std::int32_t> Table; // hash table, open addressing: first point of a cell, or -1
};
}

#endif
