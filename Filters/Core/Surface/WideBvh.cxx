#include "haptics/Surface/WideBvh.h"

#include "haptics/Math/LaneMask.h"
#include "haptics/Math/ParallelFor.h"
#include "haptics/Math/VectorClones.h"
#include "haptics/Surface/TriangleBounds.h"

#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
/// Why no triangle is left out. The surface is scaled by a power of two (exact), so that its points
/// lie within 1 of the origin, a query within 2, and a plane of a box differs from a query's
/// point by less than 4. Boxes are padded by Pad, and what is computed of a query errs, measured as
/// a shift of the plane, in units of 2^-24: the box's rounding to float32 by 2, the point's by 1,
/// Origin - point by 2, and for a segment the inverse of its direction by 4, the two products by 3
/// and 2, their sum by 4: together 18, where Pad is 32. For a ball the sum errs by 4, together 9,
/// and the squares by a relative 2^-21, which SquareMargin covers. Grid planes are outside of what
/// they bound, exactly.
constexpr double Pad = 0x1p-19;
constexpr float SquareMargin = 1.0f + 0x1p-19f;

constexpr int Width = WideBvhNode::Width;
constexpr std::int32_t LastStep = (1 << WideBvhNode::Bits) - 1;

/// A slower segment than this (in radii) stands still along an axis; it never leaves the padding.
constexpr double StandsStill = 0x1p-60;

struct Box
{
  glm::vec3 Low{ HUGE_VALF };
  glm::vec3 High{ -HUGE_VALF };

  void Add(const Box& other)
  {
    this->Low = glm::min(this->Low, other.Low);
    this->High = glm::max(this->High, other.High);
  }
};

Box BoxOf(const EngineInput& input, std::int32_t triangle, double scale, double pad)
{
  const TriangleBounds bounds = BoundsOf(input, input.Triangles[triangle]);
  return { glm::vec3(bounds.Low * scale - pad), glm::vec3(bounds.High * scale + pad) };
}

/// The exponent, as float32 has it, of the smallest power of two with which `LastStep` steps reach
/// so far. Boxes have at least twice the padding: it is never near the ends of float32's range.
std::uint8_t StepExponentFor(double extent)
{
  int exponent = 0;
  std::frexp(extent / LastStep, &exponent); // a number from 0.5 on and under 1
  return static_cast<std::uint8_t>(exponent + 127);
}

HAPTICS_ALWAYS_INLINE float StepFrom(std::uint8_t exponent)
{
  const std::uint32_t bits = static_cast<std::uint32_t>(exponent) << 23;
  float step;
  std::memcpy(&step, &bits, sizeof(step));
  return step;
}

/// Lays the children's boxes on the grid of their union.
void Quantize(const Box& whole, const Box* children, int count, WideBvhNode& node)
{
  node.Low = node.High = WideBvhNode::Lanes{};
  for (int k = 0; k < 3; ++k)
  {
    const double origin = whole.Low[k];
    node.Origin[k] = whole.Low[k];
    node.StepExponent[k] = StepExponentFor(whole.High[k] - origin);
    const double step = StepFrom(node.StepExponent[k]);
    for (int i = 0; i < count; ++i)
    {
      const auto low = static_cast<std::int32_t>(std::floor((children[i].Low[k] - origin) / step));
      const auto high = static_cast<std::int32_t>(std::ceil((children[i].High[k] - origin) / step));
      node.Low[i] |= low << (WideBvhNode::Bits * k);
      node.High[i] |= high << (WideBvhNode::Bits * k);
    }
  }
}

using Lanes = WideBvhNode::Lanes;
using Reals = float __attribute__((vector_size(sizeof(Lanes))));

/// The numbers of one axis. A macro, as older machines' functions cannot take wide vectors alike.
#define HAPTICS_GRID(lanes, k)                                                                     \
  __builtin_convertvector(((lanes) >> (WideBvhNode::Bits * (k))) & LastStep, Reals)

struct Ball
{
  float Centre[3];
  float SquaredRadius;

  HAPTICS_ALWAYS_INLINE unsigned Meets(const WideBvhNode& node) const
  {
    Reals squared{};
    for (int k = 0; k < 3; ++k)
    {
      const float origin = node.Origin[k] - this->Centre[k];
      const float step = StepFrom(node.StepExponent[k]);
      const Reals below = origin + step * HAPTICS_GRID(node.Low, k);
      const Reals above = -origin - step * HAPTICS_GRID(node.High, k);
      Reals gap = below > above ? below : above;
      gap = gap > 0.0f ? gap : Reals{};
      squared += gap * gap;
    }
    return MaskOf(squared <= this->SquaredRadius);
  }
};

struct Segment
{
  float From[3];
  float Inverse[3]; ///< of the way to the other end

  HAPTICS_ALWAYS_INLINE unsigned Meets(const WideBvhNode& node) const
  {
    Reals enter{};
    Reals leave = enter + 1.0f;
    for (int k = 0; k < 3; ++k)
    {
      const float origin = (node.Origin[k] - this->From[k]) * this->Inverse[k];
      const float step = StepFrom(node.StepExponent[k]) * this->Inverse[k];
      const Reals low = origin + step * HAPTICS_GRID(node.Low, k);
      const Reals high = origin + step * HAPTICS_GRID(node.High, k);
      const Reals first = low < high ? low : high;
      const Reals last = low < high ? high : low;
      enter = enter > first ? enter : first;
      leave = leave < last ? leave : last;
    }
    return MaskOf(enter <= leave);
  }
};

/// So many of the nodes to come are called for before they are looked at.
constexpr int CalledFor = 3;

/// Writes the numbers of the bits of a mask, and what follows them is overwritten too: `Width` in
/// all. Returns how many count.
HAPTICS_ALWAYS_INLINE int WriteSet(unsigned mask, const Lanes& numbers, void* to)
{
  Lanes ordered = numbers;
  PutSetFirst(mask, ordered);
  std::memcpy(to, &ordered, sizeof(ordered));
  return __builtin_popcount(mask);
}

template <class Region>
HAPTICS_ALWAYS_INLINE void Find(const WideBvh& tree, const Region& region, TriangleList& found)
{
  // The first entries are there only to be called for.
  std::uint32_t stack[CalledFor + (Width - 1) * WideBvh::LargestDepth + 1 + Width];
  int size = 0;
  while (size <= CalledFor)
  {
    stack[size++] = 0;
  }
  while (size > CalledFor)
  {
    const WideBvhNode& node = tree.Nodes[stack[--size]];
    const unsigned nodes = node.NumberOfNodes;
    const unsigned met = region.Meets(node) & ((1u << (nodes + node.NumberOfTriangles)) - 1u);
    const unsigned metNodes = met & ((1u << nodes) - 1u);
    const unsigned metTriangles = met >> nodes;
    if (nodes != 0) // known before what is met is
    {
      const Lanes children =
        static_cast<std::int32_t>(node.FirstNode) + Lanes{ 0, 1, 2, 3, 4, 5, 6, 7 };
      size += WriteSet(metNodes, children, stack + size);
      for (int i = 1; i <= CalledFor; ++i)
      {
        const auto* const next = reinterpret_cast<const char*>(&tree.Nodes[stack[size - i]]);
        __builtin_prefetch(next);
        __builtin_prefetch(next + 64);
      }
    }
    const std::int32_t* const order = &tree.Order[node.FirstTriangle];
    if (found.Capacity - found.Count >= Width)
    {
      Lanes triangles;
      std::memcpy(&triangles, order, sizeof(triangles));
      found.Count += WriteSet(metTriangles, triangles, found.Indices + found.Count);
      continue;
    }
    for (unsigned rest = metTriangles; rest != 0; rest &= rest - 1)
    {
      if (!found.Add(order[__builtin_ctz(rest)]))
      {
        return;
      }
    }
  }
}

HAPTICS_VECTOR_CLONES
void FindByBall(const WideBvh& tree, const Ball& ball, TriangleList& found)
{
  Find(tree, ball, found);
}

HAPTICS_VECTOR_CLONES
void FindBySegment(const WideBvh& tree, const Segment& segment, TriangleList& found)
{
  Find(tree, segment, found);
}
}

void WideBvh::Fit(const EngineInput& input)
{
  this->Scale = std::exp2(-std::ceil(std::log2(input.Radius)));
  const double pad = Pad + input.Margin * this->Scale;
  std::vector<Box> boxes(this->Nodes.size());
  const auto fit = [&](std::size_t i)
  {
    WideBvhNode& node = this->Nodes[i];
    Box children[Width];
    int count = 0;
    for (int j = 0; j < node.NumberOfNodes; ++j)
    {
      children[count++] = boxes[node.FirstNode + j];
    }
    for (int j = 0; j < node.NumberOfTriangles; ++j)
    {
      children[count++] = BoxOf(input, this->Order[node.FirstTriangle + j], this->Scale, pad);
    }
    for (int j = 0; j < count; ++j)
    {
      boxes[i].Add(children[j]);
    }
    Quantize(boxes[i], children, count, node);
  };
  // Children come after their parents.
  ParallelFor(this->Subtrees.size(), 1,
    [&](std::size_t first, std::size_t)
    {
      const Subtree& subtree = this->Subtrees[first];
      for (std::size_t i = subtree.End; i-- > subtree.First;)
      {
        fit(i);
      }
    });
  for (std::size_t i = this->Subtrees.empty() ? this->Nodes.size() : this->Subtrees.front().First;
       i-- > 0;)
  {
    fit(i);
  }
}

void WideBvh::FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept
{
  Ball ball;
  for (int k = 0; k < 3; ++k)
  {
    ball.Centre[k] = static_cast<float>(centre[k] * this->Scale);
  }
  const float r = static_cast<float>(radius * this->Scale);
  ball.SquaredRadius = r * r * SquareMargin;
  FindByBall(*this, ball, found);
}

void WideBvh::FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept
{
  Segment segment;
  for (int k = 0; k < 3; ++k)
  {
    const double way = (to[k] - from[k]) * this->Scale;
    segment.From[k] = static_cast<float>(from[k] * this->Scale);
    segment.Inverse[k] =
      static_cast<float>(1.0 / (std::abs(way) < StandsStill ? StandsStill : way));
  }
  FindBySegment(*this, segment, found);
}

std::size_t WideBvh::MemoryBytes() const
{
  return this->Nodes.capacity() * sizeof(WideBvhNode) +
    this->Order.capacity() * sizeof(std::int32_t) + this->Subtrees.capacity() * sizeof(Subtree);
}
}
