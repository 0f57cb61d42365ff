// The only file that knows Embree: releases 3 and 4 differ in how a query gets its callback.
#include "haptics/Surface/EmbreeEngine.h"

#include "haptics/Math/VectorMath.h"

#if HAPTICS_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <atomic>
#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
/// Embree works in float32. The surface is scaled by a power of two (exact) so that no coordinate
/// is above 1, and every box is padded by this much: 16 roundings of a coordinate of 1, where a
/// slab test of a box against a rounded ray errs by fewer than 4, and a distance test by as many.
constexpr double Pad = 0x1p-20;

#if HAPTICS_EMBREE_VERSION >= 4
using RayContext = RTCRayQueryContext;
#else
using RayContext = RTCIntersectContext;
#endif

/// Embree hands the first member back to the callback, and with it the list.
struct SegmentQuery
{
  RayContext Context;
  TriangleList* Found;
};

bool CollectFromBall(RTCPointQueryFunctionArguments* query)
{
  auto* found = static_cast<TriangleList*>(query->userPtr);
  if (found->Add(static_cast<std::int32_t>(query->primID)))
  {
    return false;
  }
  query->query->radius = 0.0f; // the list is full: nothing more is of use
  return true;
}

void CollectFromSegment(const RTCOccludedFunctionNArguments* query)
{
  if (!query->valid[0])
  {
    return;
  }
  auto* segment = reinterpret_cast<SegmentQuery*>(query->context);
  if (!segment->Found->Add(static_cast<std::int32_t>(query->primID)))
  {
    RTCRayN_tfar(query->ray, query->N, 0) = -HUGE_VALF; // occluded: ends the traversal
  }
}

/// The bounds of a point, or of the way that it goes, in Embree's frame, as a triangle's are made
/// of them: rounding keeps the order, so that it does not matter which is done first.
struct PointBounds
{
  glm::vec4 Low, High; // laid out as in RTCBounds, the last is not used
};

/// Whether the program ends, and Embree's static objects with it. What outlives them, as
/// ParaView's session does in a script that ends by sys.exit(), must not call Embree any more. Made
/// after Embree has made its own, this one goes before them.
class EmbreeLife
{
public:
  ~EmbreeLife() { Over = true; }
  static bool IsOver() { return Over; }

private:
  static inline std::atomic<bool> Over{ false };
};

class EmbreeEngine final : public CollisionEngine
{
public:
  explicit EmbreeEngine(const EngineInput& input)
    : Device(rtcNewDevice(nullptr))
  {
    this->Take(input);
    rtcSetDeviceMemoryMonitorFunction(this->Device, CountBytes, this);
    this->Scene = rtcNewScene(this->Device);
    rtcSetSceneFlags(this->Scene, RTC_SCENE_FLAG_ROBUST);
    this->Geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(
      this->Geometry, static_cast<unsigned>(this->Triangles->size()));
    rtcSetGeometryUserData(this->Geometry, this);
    rtcSetGeometryBoundsFunction(this->Geometry, ComputeBounds, nullptr);
    rtcSetGeometryOccludedFunction(this->Geometry, CollectFromSegment);
    if (input.IsRefitted)
    {
      // Only a scene of low quality keeps a hierarchy of its own for each geometry; that one is of
      // the usual quality, and a refit takes a twentieth of the time of building it.
      rtcSetSceneFlags(
        this->Scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
      rtcSetSceneBuildQuality(this->Scene, RTC_BUILD_QUALITY_LOW);
      rtcSetGeometryBuildQuality(this->Geometry, RTC_BUILD_QUALITY_REFIT);
    }
    rtcCommitGeometry(this->Geometry);
    rtcAttachGeometry(this->Scene, this->Geometry);
    rtcReleaseGeometry(this->Geometry); // the scene keeps it
    rtcCommitScene(this->Scene);
    if (!input.IsRefitted)
    {
      std::vector<PointBounds>().swap(this->Bounds); // an assignment would keep its memory
    }
    static const EmbreeLife life;
  }

  ~EmbreeEngine() override
  {
    if (!EmbreeLife::IsOver())
    {
      rtcReleaseScene(this->Scene);
      rtcReleaseDevice(this->Device);
    }
  }

  EmbreeEngine(const EmbreeEngine&) = delete;
  EmbreeEngine& operator=(const EmbreeEngine&) = delete;

  /// False when Embree could not build, as when memory ran out.
  bool IsBuilt() const { return rtcGetDeviceError(this->Device) == RTC_ERROR_NONE; }

  bool Refit(const EngineInput& input) override
  {
    this->Take(input);
    rtcCommitGeometry(this->Geometry);
    rtcCommitScene(this->Scene);
    return this->IsBuilt();
  }

  void FindInBall(const Vec3& centre, double radius, TriangleList& found) const noexcept override
  {
    RTCPointQuery query{};
    query.x = static_cast<float>(centre[0] * this->Scale);
    query.y = static_cast<float>(centre[1] * this->Scale);
    query.z = static_cast<float>(centre[2] * this->Scale);
    query.radius = static_cast<float>(radius * this->Scale * (1.0 + Pad));
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(this->Scene, &query, &context, CollectFromBall, &found);
  }

  void FindOnSegment(const Vec3& from, const Vec3& to, TriangleList& found) const noexcept override
  {
    const Vector origin = ToVector(from) * this->Scale;
    const Vector direction = ToVector(to) * this->Scale - origin;
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0f;
    ray.tfar = 1.0f;
    ray.mask = ~0u;
    SegmentQuery query;
    query.Found = &found;
#if HAPTICS_EMBREE_VERSION >= 4
    rtcInitRayQueryContext(&query.Context);
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &query.Context;
    rtcOccluded1(this->Scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&query.Context);
    rtcOccluded1(this->Scene, &query.Context, &ray);
#endif
  }

  EngineKind Kind() const noexcept override
  {
    return EngineKind::Embree;
  }
  std::size_t MemoryBytes() const noexcept override
  {
    return static_cast<std::size_t>(this->Bytes.load()) +
      this->Bounds.capacity() * sizeof(PointBounds);
  }

private:
  void Take(const EngineInput& input)
  {
    this->Triangles = &input.Triangles;
    this->Scale = std::exp2(-std::ceil(std::log2(input.Radius)));
    const double pad = Pad + input.Margin * this->Scale;
    // Each corner belongs to about six triangles: its part is worked out once.
    this->Bounds.resize(input.Points.size());
    for (std::size_t i = 0; i < this->Bounds.size(); ++i)
    {
      const Vector to = ToVector(input.Points[i]) * this->Scale;
      const Vector from = input.StartPoints ? ToVector((*input.StartPoints)[i]) * this->Scale : to;
      this->Bounds[i].Low = glm::vec4(glm::min(from, to) - pad, 0.0);
      this->Bounds[i].High = glm::vec4(glm::max(from, to) + pad, 0.0);
    }
  }

  static void ComputeBounds(const RTCBoundsFunctionArguments* arguments)
  {
    const auto* self = static_cast<const EmbreeEngine*>(arguments->geometryUserPtr);
    const auto& t = (*self->Triangles)[arguments->primID];
    const PointBounds& a = self->Bounds[t[0]];
    const PointBounds& b = self->Bounds[t[1]];
    const PointBounds& c = self->Bounds[t[2]];
    const glm::vec4 low = glm::min(glm::min(a.Low, b.Low), c.Low);
    const glm::vec4 high = glm::max(glm::max(a.High, b.High), c.High);
    // Embree reads four numbers at once, which waits for four that were written one by one.
    std::memcpy(&arguments->bounds_o->lower_x, &low, sizeof(low));
    std::memcpy(&arguments->bounds_o->upper_x, &high, sizeof(high));
  }

  static bool CountBytes(void* self, ssize_t bytes, bool)
  {
    static_cast<EmbreeEngine*>(self)->Bytes += bytes;
    return true;
  }

  // Read while Embree builds, and never by a query.
  const std::vector<std::array<std::int32_t, 3>>* Triangles = nullptr;
  std::vector<PointBounds> Bounds; ///< empty where no refit will come

  double Scale = 1.0; ///< surface's local frame to Embree's
  std::atomic<std::ptrdiff_t> Bytes{ 0 };
  RTCDevice Device;
  RTCScene Scene = nullptr;
  RTCGeometry Geometry = nullptr;
};
}

std::unique_ptr<CollisionEngine> MakeEmbreeEngine(const EngineInput& input)
{
  auto engine = std::make_unique<EmbreeEngine>(input);
  return engine->IsBuilt() ? std::move(engine) : nullptr;
}
}
