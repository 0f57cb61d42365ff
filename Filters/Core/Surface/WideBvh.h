#ifndef Haptics_WideBvh_h
#define Haptics_WideBvh_h

#include "haptics/Surface/CollisionEngine.h"

#include <cstdint>
#include <vector>

namespace haptics
{
/// Up to eight boxes, first those of child nodes, then those of triangles. A box lies on a grid of
/// 10-bit numbers over the node's own box: plane = Origin + step * number, rounded outwards.
struct alignas(32) WideBvhNode
{
  static constexpr int Width = 8;
  static constexpr int Bits = 10;
  /// Eight numbers at once: a vector register where the machine has such, else two or more.
  using Lanes = std::int32_t __attribute__((vector_size(4 * Width)));

  float Origin[3];
  std::uint8_t StepExponent[3]; ///< step as float32 has it: a power of two, times 10 bits is exact
  std::uint8_t NumberOfNodes : 4;
  std::uint8_t NumberOfTriangles : 4;
  std::uint32_t FirstNode;     ///< child nodes lie side by side
  std::uint32_t FirstTriangle; ///< in WideBvh::Order
  Lanes Low, High;             ///< x, y, z from the lowest bit on
};

/// @brief A bounding volume hierarchy of eight children a node, for balls and segments.
///
/// Its order is chosen by a builder (EmbreeEngine.cxx); Fit() works out the boxes, and again
/// whenever points have moved.
class WideBvh
{
public:
  /// More levels than this are refused by the builder: it bounds the stack of a query.
  static constexpr int LargestDepth = 40;

  /// A node and what is under it, which Fit() leaves to one thread.
  struct Subtree
  {
    std::uint32_t Root;
    std::uint32_t First, End; ///< all nodes under it, and no others
  };

  std::vector<WideBvhNode> Nodes; ///< the root first, children after their parents
  /// Triangle indices, as nodes refer to them, and WideBvhNode::Width more, read but not used.
  std::vector<std::int32_t> Order;
  std::vector<Subtree> Subtrees; ///< in the order of their nodes, which are the last ones

  /// Works out all boxes from the points, by several threads. Throws std::bad_alloc.
  void Fit(const EngineInput& input);

  /// As CollisionEngine's.
  void FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept;
  void FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept;

  std::size_t MemoryBytes() const;

private:
  double Scale = 1.0; ///< surface's local frame to that of the boxes
};
}

#endif
