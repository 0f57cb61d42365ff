#ifndef Haptics_Judge_h
#define Haptics_Judge_h

#include "haptics/Surface/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace haptics::testing
{
/// @brief What is in the way of a point among triangles: exact, by a search tree and arithmetic of
/// its own (ExactSigns).
///
/// Points are in the frame of the triangles: of a TriangleSurface, its local one. Triangles without
/// area are in nobody's way.
class Judge
{
public:
  /// `hasBack`: for each triangle whether it is touched from its back too.
  Judge(std::vector<Vec3> points, std::vector<Triangle> triangles, std::vector<bool> hasBack);
  /// Of a surface that does not deform.
  explicit Judge(const TriangleSurface& surface);

  static constexpr std::int32_t Nothing = -1;

  /// A triangle that a straight way crosses from a side that can be touched, or Nothing. To end on
  /// a triangle is to cross it; to start on one only where it is touched from its front alone and
  /// left behind.
  std::int32_t FindCrossed(const Vec3& from, const Vec3& to) const;
  bool Crosses(const Vec3& from, const Vec3& to) const
  {
    return this->FindCrossed(from, to) != Nothing;
  }

  /// A triangle touched from both sides that a way in its very plane comes upon, or Nothing: such a
  /// way passes through no side, but a point that stops there has left both.
  std::int32_t FindGrazed(const Vec3& from, const Vec3& to) const;

  /// Whether a point lies on a triangle.
  bool IsOnTriangle(const Vec3& x) const;

  /// Whether no triangle that can be touched from `eye` meets the cone from there to `goal`, of a
  /// radius of `spread` of its length, about a tube of radius `slack`. It is taken 2 % wider, so
  /// that it is not said of a view that is not plain. Triangles that `eye` lies on are in the way.
  bool IsInView(const Vec3& goal, const Vec3& eye, double spread, double slack) const;
  /// Within a cone of a thousandth: a plain view. `slack`: the rounding of `eye`, nearer than which
  /// a triangle next to the way might as well be in it.
  bool IsInPlainView(const Vec3& goal, const Vec3& eye, double slack = 0.0) const
  {
    return this->IsInView(goal, eye, 1e-3, slack);
  }

  /// The largest distance that float64 needs from any of the triangles within `reach` of a point to
  /// know its side of them, where they are slivers; at most a millionth of their longest edge.
  double SliverClearance(const Vec3& x, double reach) const;
  /// The unit normals of all triangles within `reach` of a point, towards it.
  std::vector<Vec3> NormalsNear(const Vec3& x, double reach) const;
  /// All triangles that may come within `reach` of a segment.
  std::vector<std::int32_t> FindNear(const Vec3& from, const Vec3& to, double reach) const;
  /// Of all triangles.
  double LargestSliverClearance() const { return this->LargestClearance; }

  const std::vector<Vec3>& Points() const { return this->Places; }
  const std::vector<Triangle>& Triangles() const { return this->Corners; }
  bool HasBack(std::int32_t triangle) const { return this->Backs[triangle]; }

private:
  struct Box
  {
    Vec3 Low, High;
  };
  struct Node
  {
    Box Bounds;
    std::int32_t First = 0; ///< of the triangles in Order, or the first of two children
    std::int32_t Count = 0; ///< of triangles; 0: not a leaf
  };

  void Build();
  /// Calls visit(triangle) for all that come within `reach` of a segment, until it returns true.
  template <class Visitor>
  bool Visit(const Vec3& from, const Vec3& to, double reach, const Visitor& visit) const;
  bool Meets(std::int32_t triangle, const Vec3& eye, const std::vector<Vec3>& cone) const;
  double ClearanceOf(std::int32_t triangle) const;

  std::vector<Vec3> Places;
  std::vector<Triangle> Corners;
  std::vector<bool> Backs;
  std::vector<std::int32_t> Order; ///< of the triangles that have an area
  std::vector<Box> Boxes;          ///< of triangles, in that order
  std::vector<Node> Nodes;
  double Size = 0.0; ///< no coordinate is larger
  double LargestClearance = 0.0;
  mutable std::int32_t LastBlocker = Nothing; ///< of views: the next one's is likely the same
};
}

#endif
