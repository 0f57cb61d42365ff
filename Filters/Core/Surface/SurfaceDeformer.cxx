#include "haptics/Surface/SurfaceDeformer.h"

#include "haptics/Math/CoordinateRange.h"
#include "haptics/Math/VectorMath.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace haptics
{
namespace
{
/// An engine's order is lost where triangles that it took together have moved apart: groups of
/// neighbours are watched, as many as show it.
constexpr std::size_t LargestNumberOfGroups = 512;
constexpr std::int32_t LargestGroup = 16;
/// How much the groups' boxes may have grown, against the surface itself.
constexpr double LargestGrowthOfGroups = 1.5;
/// More snapshots than these are in nobody's hands at once: the servo's, the next, the one built.
constexpr std::size_t LargestNumberOfEngines = 4;
constexpr double LongestDuration = 1.0; // [s]

std::string FindFault(
  const std::vector<Vec3>& points, double duration, const TriangleSurface& surface)
{
  if (points.size() != surface.Points().size())
  {
    return std::to_string(points.size()) + " points were given for a surface of " +
      std::to_string(surface.Points().size()) +
      ": where their number changes the surface has to be built anew";
  }
  if (!(duration >= 0.0 && duration <= LongestDuration))
  {
    return "the duration of a deformation must be from 0 to 1 s";
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!IsInRange(points[i]))
    {
      return "point " + std::to_string(i) + " is not finite, or beyond 1e70";
    }
  }
  if (surface.Engine().Kind() == EngineKind::Exact)
  {
    return "the exact engine cannot follow points that move: build the surface with another";
  }
  return {};
}
}

struct SurfaceDeformer::Engine
{
  std::unique_ptr<CollisionEngine> Collision;
  std::atomic<bool> IsFree{ true }; ///< no snapshot holds it
  std::vector<std::int32_t> Groups; ///< LargestGroup triangles each, -1 where fewer
  double SizeWhenBuilt = 0.0;

  /// The mean size of the groups' boxes, in radii: those of the points, as an input's may be that
  /// of its bounds.
  double Size(const EngineInput& input, double radius) const
  {
    double sum = 0.0;
    for (std::size_t start = 0; start < this->Groups.size(); start += LargestGroup)
    {
      Vector low(HUGE_VAL);
      Vector high(-HUGE_VAL);
      for (std::int32_t k = 0; k < LargestGroup && this->Groups[start + k] >= 0; ++k)
      {
        for (const std::int32_t corner : input.Triangles[this->Groups[start + k]])
        {
          const Vector x = ToVector(input.Points[corner]);
          low = glm::min(low, x);
          high = glm::max(high, x);
        }
      }
      sum += glm::length(high - low);
    }
    return this->Groups.empty()
      ? 0.0
      : sum * LargestGroup / static_cast<double>(this->Groups.size()) / radius;
  }

  /// Whether what was taken together is still close together.
  bool HasOrder(const EngineInput& input, double radius) const
  {
    return this->Collision &&
      this->Size(input, radius) <= LargestGrowthOfGroups * this->SizeWhenBuilt;
  }

  /// Chooses groups of triangles that the new engine finds close together.
  void Watch(const EngineInput& input, double radius)
  {
    this->Groups.clear();
    const std::size_t count = input.Triangles.size();
    const std::size_t stride = std::max<std::size_t>(1, count / LargestNumberOfGroups);
    std::vector<std::int32_t> found(LargestGroup);
    for (std::size_t i = 0; i < count; i += stride)
    {
      Vector middle(0.0);
      double size = 0.0;
      for (const std::int32_t corner : input.Triangles[i])
      {
        const Vector x = ToVector(input.Points[corner]);
        middle += x / 3.0;
        size = std::max(size, glm::length(x - ToVector(input.Points[input.Triangles[i][0]])));
      }
      TriangleList list{ found.data(), LargestGroup };
      this->Collision->FindInBall(ToVec3(middle), size, list);
      std::fill(found.begin() + list.Count, found.end(), -1);
      this->Groups.insert(this->Groups.end(), found.begin(), found.end());
    }
    this->SizeWhenBuilt = this->Size(input, radius);
  }
};

SurfaceDeformer::SurfaceDeformer(std::shared_ptr<const TriangleSurface> surface)
  : Current(std::move(surface))
{
}

SurfaceDeformer::~SurfaceDeformer() = default;

/// An engine that no snapshot holds any more, or a new one to be built.
std::shared_ptr<SurfaceDeformer::Engine> SurfaceDeformer::Borrow()
{
  for (const auto& engine : this->Engines)
  {
    // Acquire: what its last holder read was read before what comes now is written.
    if (engine->IsFree.load(std::memory_order_acquire))
    {
      return engine;
    }
  }
  if (this->Engines.size() == LargestNumberOfEngines)
  {
    this->Engines.erase(this->Engines.begin()); // its holders keep it alive
  }
  this->Engines.push_back(std::make_shared<Engine>());
  return this->Engines.back();
}

/// Takes the engine that the latest snapshot has. Throws std::bad_alloc.
void SurfaceDeformer::CopyLatest(Engine& engine) const
{
  engine.Collision = this->Current->Engine().Clone();
  if (this->LatestEngine)
  {
    engine.Groups = this->LatestEngine->Groups;
    engine.SizeWhenBuilt = this->LatestEngine->SizeWhenBuilt;
  }
  else
  {
    engine.Watch(this->Current->Input(), this->Current->EndRadius);
  }
}

bool SurfaceDeformer::Fit(Engine& engine, const TriangleSurface& next)
{
  const EngineInput input = next.Input();
  bool hasOrder = engine.HasOrder(input, next.EndRadius);
  if (!hasOrder)
  {
    this->CopyLatest(engine);
    hasOrder = engine.HasOrder(input, next.EndRadius);
  }
  if (hasOrder)
  {
    return engine.Collision->Refit(input);
  }
  engine.Collision = MakeEngine(this->Current->Engine().Kind(), input);
  if (!engine.Collision)
  {
    return false;
  }
  ++this->Builds;
  engine.Watch(input, next.EndRadius);
  return true;
}

std::shared_ptr<const TriangleSurface> SurfaceDeformer::Deform(
  std::vector<Vec3> points, double duration, std::string& error)
{
  return this->Make(std::move(points), duration, true, error);
}

std::shared_ptr<const TriangleSurface> SurfaceDeformer::Replace(
  std::vector<Vec3> points, std::string& error)
{
  return this->Make(std::move(points), 0.0, false, error);
}

double SurfaceDeformer::LongestWay(const std::vector<Vec3>& points) const
{
  const std::vector<Vec3>& from = this->Current->Points();
  const Vector origin = ToVector(this->Current->Origin());
  double squared = 0.0;
  for (std::size_t i = 0; i < points.size() && points.size() == from.size(); ++i)
  {
    squared = std::max(squared, SquaredLength(ToVector(points[i]) - origin - ToVector(from[i])));
  }
  return std::sqrt(squared);
}

/// `follows`: from where the latest snapshot ends; else in its place.
std::shared_ptr<const TriangleSurface> SurfaceDeformer::Make(
  std::vector<Vec3> points, double duration, bool follows, std::string& error)
{
  error = FindFault(points, duration, *this->Current);
  if (!error.empty())
  {
    return nullptr;
  }
  const TriangleSurface& from = *this->Current;
  std::shared_ptr<TriangleSurface> next(new TriangleSurface);
  next->SurfaceOrigin = from.SurfaceOrigin;
  next->Shared = from.Shared;
  next->CrackWidth = from.CrackWidth;
  next->ActualSide = from.ActualSide;
  if (follows)
  {
    next->Duration = duration;
    next->Predecessor = from.Number;
    next->Start = from.LocalPoints;
  }
  const Vector origin = ToVector(from.SurfaceOrigin);
  for (Vec3& p : points)
  {
    p = ToVec3(WithoutNegligible(ToVector(p) - origin, NegligibleShare * from.SurfaceRadius));
  }
  next->LocalPoints = std::make_shared<const std::vector<Vec3>>(std::move(points));
  if (!next->Measure(&from))
  {
    error = "no triangle of the surface has an area any more";
    return nullptr;
  }
  const std::shared_ptr<Engine> engine = this->Borrow();
  if (!this->Fit(*engine, *next))
  {
    engine->Collision = nullptr; // made anew next time
    error = "memory ran out while the collision engine was fitted";
    return nullptr;
  }
  engine->IsFree.store(false, std::memory_order_relaxed);
  this->LatestEngine = engine;
  next->Collision = std::shared_ptr<CollisionEngine>(engine->Collision.get(),
    [engine](CollisionEngine*) { engine->IsFree.store(true, std::memory_order_release); });
  this->Current = next;
  return next;
}
}
