#ifndef Haptics_ExactQueries_h
#define Haptics_ExactQueries_h

#include "haptics/Surface/TriangleSurface.h"

namespace haptics::testing
{
/// @brief Exact answers about a surface that share no code with the contact update: every box is
/// looked at, and ExactSigns decides. For many questions about one surface that stands still, Judge
/// is faster.
///
/// Points are in the surface's local frame.
class ExactQueries
{
public:
  /// `fraction`: of the time that a surface which deforms is on its way, 0 to 1.
  explicit ExactQueries(std::shared_ptr<const TriangleSurface> surface, double fraction = 1.0);

  /// Whether a straight way from `from` to `to` meets a triangle from a side that can be touched.
  /// As for the god-object, ending on a triangle counts; starting on it counts only for one that is
  /// touched from its front and left behind.
  bool Crosses(const Vec3& from, const Vec3& to) const;

  /// Whether a point lies inside a closed surface: the parity of crossings of a ray.
  bool IsInside(const Vec3& point) const;

  /// Distance to the nearest triangle; the error is rounding's.
  double Distance(const Vec3& point) const;

private:
  struct Bounds
  {
    Vec3 Low, High;
  };
  template <class Visitor>
  bool VisitBoxes(const Bounds& box, const Visitor& visit) const;

  std::shared_ptr<const TriangleSurface> Surface;
  std::vector<Vec3> Points;
  std::vector<Bounds> Boxes;
};
}

#endif
