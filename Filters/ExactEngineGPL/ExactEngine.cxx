#include "ExactEngine.h"

#include "haptics/Surface/CollisionEngine.h"

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>

namespace haptics
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 ToPoint(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}

/// A triangle by its index; its corners stay in the surface.
struct Primitive
{
  using Id = std::int32_t;
  using Datum = Kernel::Triangle_3;
  using Datum_reference = Datum;
  using Point = Kernel::Point_3;
  using Point_reference = Point;
  using Shared_data = const EngineInput*;

  Primitive(std::vector<std::int32_t>::const_iterator index, Shared_data)
    : Index(*index)
  {
  }
  Id id() const { return this->Index; }
  Datum datum(Shared_data input) const
  {
    const auto& [a, b, c] = input->Triangles[this->Index];
    return { ToPoint(input->Points[a]), ToPoint(input->Points[b]), ToPoint(input->Points[c]) };
  }
  Point reference_point(Shared_data input) const
  {
    return ToPoint(input->Points[input->Triangles[this->Index][0]]);
  }
  static Shared_data construct_shared_data(Shared_data input) { return input; }

  std::int32_t Index;
};

#if CGAL_VERSION_MAJOR >= 6
using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif
using Tree = CGAL::AABB_tree<Traits>;

/// Walks the tree and lists the triangles whose boxes answer yes to `Meets`.
template <class Meets>
class Listing
{
public:
  Listing(const Traits& traits, const Meets& meets, TriangleList& found)
    : TreeTraits(traits)
    , IsMet(meets)
    , Found(found)
  {
  }
  bool go_further() const { return !this->Found.Overflow; }
  bool do_intersect(int, const CGAL::AABB_node<Traits>& node) const
  {
    return this->IsMet(node.bbox());
  }
  void intersection(int, const Primitive& primitive)
  {
    if (this->IsMet(primitive.datum(this->TreeTraits.shared_data()).bbox()))
    {
      this->Found.Add(primitive.id());
    }
  }

private:
  const Traits& TreeTraits;
  const Meets& IsMet;
  TriangleList& Found;
};

class ExactEngine final : public CollisionEngine
{
public:
  explicit ExactEngine(const EngineInput& input)
    : Input(input)
  {
    std::vector<std::int32_t> all(input.Triangles.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = static_cast<std::int32_t>(i);
    }
    this->Triangles.insert(all.cbegin(), all.cend(), &this->Input);
    this->Triangles.build();
  }

  void FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept override
  {
    const CGAL::Bbox_3 ball(centre[0] - radius, centre[1] - radius, centre[2] - radius,
      centre[0] + radius, centre[1] + radius, centre[2] + radius);
    this->List([&ball](const CGAL::Bbox_3& box) { return CGAL::do_overlap(box, ball); }, found);
  }

  // NOLINTNEXTLINE(bugprone-exception-escape): of memory for exact numbers there is always enough
  void FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept override
  {
    const Kernel::Segment_3 segment(ToPoint(from), ToPoint(to));
    const double margin = this->Input.Margin;
    this->List(
      [&segment, margin](const CGAL::Bbox_3& box)
      {
        const CGAL::Bbox_3 thick(box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
          box.xmax() + margin, box.ymax() + margin, box.zmax() + margin);
        return CGAL::do_intersect(thick, segment);
      },
      found);
  }

  EngineKind Kind() const noexcept override { return EngineKind::Exact; }
  std::size_t MemoryBytes() const noexcept override
  {
    // CGAL does not report it: a node of a box and two children for each triangle, and its index.
    return this->Triangles.size() * (sizeof(CGAL::Bbox_3) + 2 * sizeof(void*) + sizeof(Primitive));
  }

private:
  template <class Meets>
  void List(const Meets& meets, TriangleList& found) const
  {
    Listing<Meets> listing(this->Triangles.traits(), meets, found);
    this->Triangles.traversal(0, listing);
  }

  EngineInput Input;
  Tree Triangles;
};

std::unique_ptr<CollisionEngine> MakeExactEngine(const EngineInput& input)
{
  return std::make_unique<ExactEngine>(input);
}
}

void EnableExactEngine()
{
  SetExactEngineFactory(MakeExactEngine);
}
}
