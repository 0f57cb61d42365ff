// The only file that knows Embree.
#include "haptics/Surface/EmbreeEngine.h"

#include "haptics/Math/LargePages.h"
#include "haptics/Math/ParallelFor.h"
#include "haptics/Surface/TriangleBounds.h"
#include "haptics/Surface/WideBvh.h"

#if HAPTICS_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <new>
#include <thread>
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

/// What Embree builds over: a triangle, or a few that follow on each other and share edges, so that
/// there is less to build. The geometry's number is how many.
constexpr unsigned LargestGroup = 2;
constexpr unsigned GroupsInLeaf = Width / LargestGroup;

void* CreateLeaf(
  RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* groups, std::size_t count, void*)
{
  BuiltNode* const leaf = Allocate(allocator);
  leaf->Count = 0;
  leaf->IsLeaf = true;
  for (std::size_t i = 0; i < count; ++i)
  {
    for (unsigned k = 0; k < groups[i].geomID; ++k)
    {
      leaf->Triangles[leaf->Count++] = static_cast<std::int32_t>(groups[i].primID + k);
    }
  }
  return leaf;
}

bool ShareAnEdge(const std::array<std::int32_t, 3>& a, const std::array<std::int32_t, 3>& b)
{
  const auto isCorner = [&b](std::int32_t corner)
  { return corner == b[0] || corner == b[1] || corner == b[2]; };
  return isCorner(a[0]) + isCorner(a[1]) + isCorner(a[2]) >= 2;
}

/// Half the area of a box.
float Area(const RTCBuildPrimitive& box)
{
  const float x = box.upper_x - box.lower_x;
  const float y = box.upper_y - box.lower_y;
  const float z = box.upper_z - box.lower_z;
  return x * y + y * z + z * x;
}

RTCBuildPrimitive Union(const RTCBuildPrimitive& a, const RTCBuildPrimitive& b)
{
  return { std::min(a.lower_x, b.lower_x), std::min(a.lower_y, b.lower_y),
    std::min(a.lower_z, b.lower_z), a.geomID + b.geomID, std::max(a.upper_x, b.upper_x),
    std::max(a.upper_y, b.upper_y), std::max(a.upper_z, b.upper_z), a.primID };
}

struct BuildInput
{
  std::unique_ptr<RTCBuildPrimitive[]> Groups; ///< not cleared first, unlike a vector's
  std::size_t Count;
};

/// Groups of triangles that are found together more often than not.
BuildInput GroupTriangles(const EngineInput& input)
{
  constexpr std::size_t pieceSize = 1 << 14;
  const std::size_t count = input.Triangles.size();
  // Embree rejects boxes beyond 1e18: points are taken in radii.
  const double scale = 1.0 / input.Radius;
  const auto boxOf = [&](std::size_t i) -> RTCBuildPrimitive
  {
    const TriangleBounds bounds = BoundsOf(input, input.Triangles[i]);
    const glm::vec3 low(bounds.Low * scale);
    const glm::vec3 high(bounds.High * scale);
    return { low.x, low.y, low.z, 1u, high.x, high.y, high.z, static_cast<unsigned>(i) };
  };
  std::vector<std::vector<RTCBuildPrimitive>> pieces((count + pieceSize - 1) / pieceSize);
  ParallelFor(count, pieceSize,
    [&](std::size_t first, std::size_t last)
    {
      std::vector<RTCBuildPrimitive>& groups = pieces[first / pieceSize];
      groups.reserve((last - first) * 3 / 4);
      groups.push_back(boxOf(first));
      for (std::size_t i = first + 1; i < last; ++i)
      {
        RTCBuildPrimitive& group = groups.back();
        const RTCBuildPrimitive next = boxOf(i);
        const RTCBuildPrimitive both = Union(group, next);
        if (both.geomID <= LargestGroup &&
          ShareAnEdge(input.Triangles[i - 1], input.Triangles[i]) &&
          Area(both) <= Area(group) + Area(next))
        {
          group = both;
        }
        else
        {
          groups.push_back(next);
        }
      }
    });
  std::vector<std::size_t> starts;
  std::size_t total = 0;
  for (const auto& piece : pieces)
  {
    starts.push_back(total);
    total += piece.size();
  }
  BuildInput groups{ std::unique_ptr<RTCBuildPrimitive[]>(new RTCBuildPrimitive[total]), total };
  ParallelFor(pieces.size(), 1,
    [&](std::size_t i, std::size_t)
    {
      std::copy(pieces[i].begin(), pieces[i].end(), groups.Groups.get() + starts[i]);
      pieces[i] = {};
    });
  return groups;
}

/// Puts a tree that Embree has built in one array, and small leaves into their parents where there
/// is room.
class Flattener
{
public:
  /// A node of the tree that is in its place, but for what is under it.
  struct Task
  {
    const BuiltNode* From;
    std::uint32_t To;
    int Depth;
  };

  explicit Flattener(WideBvh& tree)
    : Tree(tree)
  {
  }

  void Start(const Task& task)
  {
    this->Tree.Nodes.resize(task.To + 1);
    this->Tasks = { task };
  }

  /// False where the tree is too deep.
  bool IsShallow() const { return this->Shallow; }
  const std::vector<Task>& Waiting() const { return this->Tasks; }

  /// Goes on with the task at a place of those that wait: its children wait in its stead.
  void Expand(std::size_t place)
  {
    const Task task = this->Tasks[place];
    this->Tasks.erase(this->Tasks.begin() + static_cast<std::ptrdiff_t>(place));
    if (task.Depth > WideBvh::LargestDepth)
    {
      this->Shallow = false;
      return;
    }
    const BuiltNode* nodes[Width];
    unsigned numberOfNodes = 0;
    const auto firstTriangle = static_cast<std::uint32_t>(this->Tree.Order.size());
    if (task.From->IsLeaf)
    {
      this->Take(*task.From);
    }
    else
    {
      numberOfNodes = this->TakeSmallLeaves(*task.From, nodes);
    }
    const auto firstNode = static_cast<std::uint32_t>(this->Tree.Nodes.size());
    this->Tree.Nodes.resize(this->Tree.Nodes.size() + numberOfNodes);
    WideBvhNode& node = this->Tree.Nodes[task.To];
    node.FirstNode = firstNode;
    node.FirstTriangle = firstTriangle;
    node.NumberOfNodes = static_cast<std::uint8_t>(numberOfNodes);
    node.NumberOfTriangles = static_cast<std::uint8_t>(this->Tree.Order.size() - firstTriangle);
    for (unsigned i = 0; i < numberOfNodes; ++i)
    {
      this->Tasks.push_back({ nodes[i], firstNode + i, task.Depth + 1 });
    }
  }

private:
  void Take(const BuiltNode& leaf)
  {
    this->Tree.Order.insert(this->Tree.Order.end(), leaf.Triangles, leaf.Triangles + leaf.Count);
  }

  /// Takes the smallest leaves among the children, as long as there is a lane for each triangle,
  /// and returns the number of the others, which it puts into `nodes`.
  unsigned TakeSmallLeaves(const BuiltNode& parent, const BuiltNode** nodes)
  {
    const auto weight = [](const BuiltNode* node)
    { return node->IsLeaf ? node->Count : Width + 1; };
    const BuiltNode* children[Width];
    for (unsigned i = 0; i < parent.Count; ++i)
    {
      children[i] = parent.Children[i];
      std::rotate(std::upper_bound(children, children + i, children[i],
                    [&](const BuiltNode* a, const BuiltNode* b) { return weight(a) < weight(b); }),
        children + i, children + i + 1);
    }
    unsigned lanes = parent.Count;
    unsigned numberOfNodes = 0;
    for (unsigned i = 0; i < parent.Count; ++i)
    {
      if (children[i]->IsLeaf && lanes - 1 + children[i]->Count <= Width)
      {
        lanes += children[i]->Count - 1;
        this->Take(*children[i]);
      }
      else
      {
        nodes[numberOfNodes++] = children[i];
      }
    }
    return numberOfNodes;
  }

  WideBvh& Tree;
  std::vector<Task> Tasks;
  bool Shallow = true;
};

/// False where the tree is too deep.
bool Flatten(const BuiltNode& root, std::size_t triangles, WideBvh& tree)
{
  // The uppermost nodes first, then what is under them, a subtree to a thread.
  constexpr std::size_t enoughSubtrees = 128;
  Flattener top(tree);
  top.Start({ &root, 0, 1 });
  while (!top.Waiting().empty() && top.Waiting().size() < enoughSubtrees)
  {
    top.Expand(0);
  }
  const std::vector<Flattener::Task>& subtrees = top.Waiting();
  std::vector<WideBvh> parts(subtrees.size());
  std::atomic<bool> isShallow{ top.IsShallow() };
  ParallelFor(parts.size(), 1,
    [&](std::size_t i, std::size_t)
    {
      parts[i].Nodes.reserve(triangles / (4 * parts.size()) + 1);
      parts[i].Order.reserve(triangles / parts.size() + 1);
      Flattener part(parts[i]);
      part.Start({ subtrees[i].From, 0, subtrees[i].Depth });
      while (!part.Waiting().empty())
      {
        part.Expand(part.Waiting().size() - 1); // depth first: what is searched together is close
      }
      isShallow = isShallow && part.IsShallow();
    });
  // All of a part but its root, which has its place already, comes after what there is.
  std::size_t numberOfNodes = tree.Nodes.size();
  std::size_t numberOfTriangles = tree.Order.size();
  std::vector<std::uint32_t> firstTriangles;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const auto first = static_cast<std::uint32_t>(numberOfNodes);
    firstTriangles.push_back(static_cast<std::uint32_t>(numberOfTriangles));
    numberOfNodes += parts[i].Nodes.size() - 1;
    numberOfTriangles += parts[i].Order.size();
    tree.Subtrees.push_back({ subtrees[i].To, first, static_cast<std::uint32_t>(numberOfNodes) });
  }
  ReserveLargePages(tree.Nodes, numberOfNodes);
  ReserveLargePages(tree.Order, numberOfTriangles + Width);
  tree.Nodes.resize(numberOfNodes);
  tree.Order.resize(numberOfTriangles + Width);
  ParallelFor(parts.size(), 1,
    [&](std::size_t i, std::size_t)
    {
      const WideBvh::Subtree& subtree = tree.Subtrees[i];
      for (WideBvhNode& node : parts[i].Nodes)
      {
        node.FirstNode += subtree.First - 1;
        node.FirstTriangle += firstTriangles[i];
      }
      tree.Nodes[subtree.Root] = parts[i].Nodes.front();
      std::copy(
        parts[i].Nodes.begin() + 1, parts[i].Nodes.end(), tree.Nodes.begin() + subtree.First);
      std::copy(
        parts[i].Order.begin(), parts[i].Order.end(), tree.Order.begin() + firstTriangles[i]);
      parts[i] = {};
    });
  return isShallow;
}

/// Passes Embree's progress on, on the thread that builds: Embree has others help it.
class BuildMonitor
{
public:
  explicit BuildMonitor(const ProgressCall& progress)
    : Progress(progress)
  {
  }
  static bool Notice(void* monitor, double fraction)
  {
    auto& self = *static_cast<BuildMonitor*>(monitor);
    if (std::this_thread::get_id() == self.Builder &&
      !ReportProgress(self.Progress, BuildShare * fraction))
    {
      self.Stopped = true;
    }
    return !self.Stopped;
  }
  bool IsStopped() const { return this->Stopped; }

  /// Of the time that the engine takes; the rest is putting its nodes in order.
  static constexpr double BuildShare = 0.7;

private:
  const ProgressCall& Progress;
  const std::thread::id Builder = std::this_thread::get_id();
  std::atomic<bool> Stopped{ false };
};

template <class Handle>
using Owner = std::unique_ptr<Handle, void (*)(Handle*)>;

/// False where memory ran out, or it was stopped.
bool BuildWithEmbree(const EngineInput& input, WideBvh& tree)
{
  const BuildInput groups = GroupTriangles(input);
  const Owner<RTCDeviceTy> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  const Owner<RTCBVHTy> bvh(rtcNewBVH(device.get()), rtcReleaseBVH);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = Width;
  arguments.sahBlockSize = 1; // each triangle in a node is tested by itself
  // What fits into one node need not be parted well.
  arguments.minLeafSize = std::max(1u, GroupsInLeaf * 3 / 4);
  arguments.maxLeafSize = GroupsInLeaf;
  arguments.bvh = bvh.get();
  arguments.primitives = groups.Groups.get();
  arguments.primitiveCount = groups.Count;
  arguments.primitiveArrayCapacity = groups.Count;
  arguments.createNode = CreateNode;
  arguments.setNodeChildren = SetChildren;
  arguments.setNodeBounds = SetBounds;
  arguments.createLeaf = CreateLeaf;
  BuildMonitor monitor(input.Progress);
  arguments.buildProgress = BuildMonitor::Notice;
  arguments.userPtr = &monitor;
  const auto* const root = static_cast<const BuiltNode*>(rtcBuildBVH(&arguments));
  return root && !monitor.IsStopped() && rtcGetDeviceError(device.get()) == RTC_ERROR_NONE &&
    Flatten(*root, input.Triangles.size(), tree);
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
    if (!BuildWithEmbree(input, tree) ||
      !ReportProgress(input.Progress, 0.5 + 0.5 * BuildMonitor::BuildShare))
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
