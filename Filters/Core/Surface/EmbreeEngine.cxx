// The only file that knows Embree.
#include "haptics/Surface/EmbreeEngine.h"

#include "haptics/Surface/TriangleBounds.h"
#include "haptics/Surface/WideBvh.h"

#if HAPTICS_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <new>
#include <utility>

namespace haptics
{
namespace
{
constexpr unsigned Width = WideBvhNode::Width;

/// What Embree's builder makes: a node of child nodes, or a leaf of triangles.
struct BuiltNode
{
  unsigned Count;
  bool IsLeaf;
  union
  {
    BuiltNode* Children[Width];
    std::int32_t Triangles[Width];
  };
};

BuiltNode* Allocate(RTCThreadLocalAllocator allocator)
{
  return static_cast<BuiltNode*>(
    rtcThreadLocalAlloc(allocator, sizeof(BuiltNode), alignof(BuiltNode)));
}

void* CreateNode(RTCThreadLocalAllocator allocator, unsigned count, void*)
{
  BuiltNode* const node = Allocate(allocator);
  node->Count = count;
  node->IsLeaf = false;
  return node;
}

void SetChildren(void* node, void** children, unsigned count, void*)
{
  std::transform(children, children + count, static_cast<BuiltNode*>(node)->Children,
    [](void* child) { return static_cast<BuiltNode*>(child); });
}

/// WideBvh::Fit() works out the boxes, when built as when points have moved.
void SetBounds(void*, const RTCBounds**, unsigned, void*) {}

void* CreateLeaf(
  RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*)
{
  BuiltNode* const leaf = Allocate(allocator);
  leaf->Count = static_cast<unsigned>(count);
  leaf->IsLeaf = true;
  std::transform(primitives, primitives + count, leaf->Triangles,
    [](const RTCBuildPrimitive& primitive) { return static_cast<std::int32_t>(primitive.primID); });
  return leaf;
}

std::vector<RTCBuildPrimitive> TriangleBoxes(const EngineInput& input)
{
  std::vector<RTCBuildPrimitive> boxes(input.Triangles.size());
  // Embree rejects boxes beyond 1e18: points are taken in radii.
  const double scale = 1.0 / input.Radius;
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    const TriangleBounds bounds = BoundsOf(input, input.Triangles[i]);
    const glm::vec3 low(bounds.Low * scale);
    const glm::vec3 high(bounds.High * scale);
    boxes[i] = { low.x, low.y, low.z, 0u, high.x, high.y, high.z, static_cast<unsigned>(i) };
  }
  return boxes;
}

/// Puts what Embree has built in one array, and small leaves into their parents where there is
/// room. False where the tree is too deep.
bool Flatten(const BuiltNode& root, std::size_t triangles, WideBvh& tree)
{
  struct Task
  {
    const BuiltNode* From;
    std::uint32_t To;
    int Depth;
  };
  tree.Nodes.reserve(triangles / 4 + 1);
  tree.Order.reserve(triangles);
  tree.Nodes.emplace_back();
  std::vector<Task> tasks{ { &root, 0, 1 } };
  while (!tasks.empty())
  {
    const Task task = tasks.back();
    tasks.pop_back();
    if (task.Depth > WideBvh::LargestDepth)
    {
      return false;
    }
    const BuiltNode* nodes[Width];
    unsigned numberOfNodes = 0;
    const auto firstTriangle = static_cast<std::uint32_t>(tree.Order.size());
    const auto take = [&](const BuiltNode& leaf)
    { tree.Order.insert(tree.Order.end(), leaf.Triangles, leaf.Triangles + leaf.Count); };
    if (task.From->IsLeaf)
    {
      take(*task.From);
    }
    else
    {
      const BuiltNode* children[Width];
      const unsigned count = task.From->Count;
      std::copy(task.From->Children, task.From->Children + count, children);
      const auto weight = [](const BuiltNode* node)
      { return node->IsLeaf ? node->Count : Width + 1; };
      std::stable_sort(children, children + count,
        [&](const BuiltNode* a, const BuiltNode* b) { return weight(a) < weight(b); });
      unsigned lanes = count;
      for (unsigned i = 0; i < count; ++i)
      {
        if (children[i]->IsLeaf && lanes - 1 + children[i]->Count <= Width)
        {
          lanes += children[i]->Count - 1;
          take(*children[i]);
        }
        else
        {
          nodes[numberOfNodes++] = children[i];
        }
      }
    }
    const auto firstNode = static_cast<std::uint32_t>(tree.Nodes.size());
    tree.Nodes.resize(tree.Nodes.size() + numberOfNodes);
    WideBvhNode& node = tree.Nodes[task.To];
    node.FirstNode = firstNode;
    node.FirstTriangle = firstTriangle;
    node.NumberOfNodes = static_cast<std::uint8_t>(numberOfNodes);
    node.NumberOfTriangles = static_cast<std::uint8_t>(tree.Order.size() - firstTriangle);
    for (unsigned i = 0; i < numberOfNodes; ++i)
    {
      tasks.push_back({ nodes[i], firstNode + i, task.Depth + 1 });
    }
  }
  tree.Nodes.shrink_to_fit();
  return true;
}

template <class Handle>
using Owner = std::unique_ptr<Handle, void (*)(Handle*)>;

/// False where memory ran out.
bool BuildWithEmbree(const EngineInput& input, WideBvh& tree)
{
  std::vector<RTCBuildPrimitive> boxes = TriangleBoxes(input);
  const Owner<RTCDeviceTy> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  const Owner<RTCBVHTy> bvh(rtcNewBVH(device.get()), rtcReleaseBVH);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = Width;
  arguments.sahBlockSize = Width;
  arguments.maxLeafSize = Width;
  arguments.bvh = bvh.get();
  arguments.primitives = boxes.data();
  arguments.primitiveCount = boxes.size();
  arguments.primitiveArrayCapacity = boxes.size();
  arguments.createNode = CreateNode;
  arguments.setNodeChildren = SetChildren;
  arguments.setNodeBounds = SetBounds;
  arguments.createLeaf = CreateLeaf;
  const auto* const root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
  return root && rtcGetDeviceError(device.get()) == RTC_ERROR_NONE &&
    Flatten(*root, boxes.size(), tree);
}

class EmbreeEngine final : public CollisionEngine
{
public:
  explicit EmbreeEngine(WideBvh tree)
    : Tree(std::move(tree))
  {
  }

  void FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept override
  {
    this->Tree.FindInBall(centre, radius, found);
  }

  void FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept override
  {
    this->Tree.FindOnSegment(from, to, found);
  }

  bool Refit(const EngineInput& input) override
  {
    try
    {
      this->Tree.Fit(input);
      return true;
    }
    catch (const std::bad_alloc&)
    {
      return false;
    }
  }

  std::unique_ptr<CollisionEngine> Clone() const override
  {
    return std::make_unique<EmbreeEngine>(this->Tree);
  }

  EngineKind Kind() const noexcept override { return EngineKind::Embree; }
  std::size_t MemoryBytes() const noexcept override { return this->Tree.MemoryBytes(); }

private:
  WideBvh Tree;
};
}

std::unique_ptr<CollisionEngine> MakeEmbreeEngine(const EngineInput& input)
{
  try
  {
    WideBvh tree;
    if (!BuildWithEmbree(input, tree))
    {
      return nullptr;
    }
    tree.Fit(input);
    return std::make_unique<EmbreeEngine>(std::move(tree));
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}
}
