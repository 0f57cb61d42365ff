#ifndef Haptics_CollisionEngine_h
#define Haptics_CollisionEngine_h

#include "haptics/Math/ProgressCall.h"
#include "haptics/Math/Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace haptics
{
/// What answers "which triangles come near here".
enum class EngineKind
{
  Automatic,  ///< BruteForce on a surface of few triangles, else Embree
  BruteForce, ///< looks at every triangle: the reference, and the fastest on tiny surfaces
  Embree,     ///< a bounding volume hierarchy of eight boxes a node, which Intel Embree builds
  Exact       ///< CGAL's tree: the oracle; only where HapticsExactEngineGPL is loaded
};

/// A fixed list of triangle indices, filled by an engine. Never allocates.
struct TriangleList
{
  std::int32_t* Indices = nullptr;
  std::int32_t Capacity = 0;
  std::int32_t Count = 0;
  bool Overflow = false; ///< more than Capacity were found: the list is not whole

  /// False once the list has overflowed: the engine can stop looking.
  bool Add(std::int32_t triangle)
  {
    if (this->Count == this->Capacity)
    {
      this->Overflow = true;
      return false;
    }
    this->Indices[this->Count++] = triangle;
    return true;
  }
};

/// What an engine is built over. It keeps references to the arrays.
struct EngineInput
{
  const std::vector<Vec3>& Points; ///< local frame
  const std::vector<std::array<std::int32_t, 3>>& Triangles;
  double Radius; ///< no point is farther from the local origin
  double Margin; ///< FindOnSegment thickens its segment by this
  /// Where points come from that are on their way: a triangle is found where it passes. Null: none
  /// moves. Engines that cannot Refit() do not look at it.
  const std::vector<Vec3>* StartPoints = nullptr;
  /// Of making the engine; engines that are quick to make do not call it.
  ProgressCall Progress = {};
};

/// @brief Proposes the triangles that a contact update has to look at.
///
/// Both questions are answered *conservatively*: every triangle that meets the region is in the
/// list, each once, in any order; others may be. Certainty comes from the caller's predicates.
/// Coordinates are in the surface's local frame, no farther from its origin than twice its radius.
/// Queries are made by one or more servo threads at once: const, no allocation, no lock, no
/// exception.
class VTKHAPTICSCORE_EXPORT CollisionEngine
{
public:
  virtual ~CollisionEngine() = default;

  /// Appends the triangles that meet the ball.
  virtual void FindInBall(
    const Vec3& centre, double radius, TriangleList& found) const noexcept = 0;
  /// Appends the triangles that come within the engine's margin of the segment.
  virtual void FindOnSegment(
    const Vec3& from, const Vec3& to, TriangleList& found) const noexcept = 0;

  /// Takes in points that have moved, with the same triangles; the order in which they were taken
  /// together stays. No query may run meanwhile. False where memory ran out, or this kind of engine
  /// cannot: then it is of no more use. Any thread but the servo's.
  virtual bool Refit(const EngineInput& input)
  {
    (void)input;
    return false;
  }

  /// A copy to Refit(), for far less than an engine takes to make. Null where this kind cannot.
  /// Throws std::bad_alloc.
  virtual std::unique_ptr<CollisionEngine> Clone() const { return nullptr; }

  virtual EngineKind Kind() const noexcept = 0;
  /// Bytes held beyond the surface's own points and triangles.
  virtual std::size_t MemoryBytes() const noexcept = 0;
};

/// Makes an engine, or returns null when it is not there, memory ran out, or input.Progress stopped
/// it. Automatic picks by size.
VTKHAPTICSCORE_EXPORT std::unique_ptr<CollisionEngine> MakeEngine(
  EngineKind kind, const EngineInput& input);

/// Says what EngineKind::Exact makes. Called by the optional GPL library, which alone has it.
using EngineFactory = std::unique_ptr<CollisionEngine> (*)(const EngineInput& input);
VTKHAPTICSCORE_EXPORT void SetExactEngineFactory(EngineFactory factory);
}

#endif
