#ifndef Haptics_DeformingSurface_h
#define Haptics_DeformingSurface_h

#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/Facet.h"
#include "haptics/Surface/TriangleSurface.h"

#include <array>
#include <cstdint>
#include <memory>

namespace haptics
{
/// @brief A surface at a fraction of its deformation's time, and the sweep to a later one.
///
/// The fraction is 0 when the surface is first touched and 1 when its points have arrived; that of
/// a surface that does not deform is always 1. Positions are in the surface's local frame.
class DeformingSurface
{
public:
  explicit DeformingSurface(std::shared_ptr<const TriangleSurface> surface);

  const TriangleSurface& Surface() const { return *this->Snapshot; }

  double Fraction() const { return this->Now; }
  /// After the next motion.
  double NextFraction() const { return this->Next; }
  /// Whether the next motion sweeps the surface on.
  bool IsSweeping() const { return this->Next != this->Now; }

  /// Sets where a tick of `dt` [s] ends.
  void BeginTick(double dt);
  /// Sets where the next sweep ends: at a part of the tick, 0 to 1.
  void SweepTo(double part);
  void SweepNothing() { this->Next = this->Now; }
  /// From here on, parts are of what is left of the tick.
  void BeginRest();
  void FinishSweep() { this->Now = this->Next; }
  void SkipTick();
  /// Takes the time of another one, if that is of the same snapshot.
  void Continue(const DeformingSurface& previous);

  struct Corners
  {
    Vector A, B, C;
  };
  Corners CornersOf(std::int32_t triangle) const { return this->CornersAt(triangle, this->Now); }
  /// After the next motion.
  Corners NextCornersOf(std::int32_t triangle) const
  {
    return this->CornersAt(triangle, this->Next);
  }
  /// Whether no other triangle shares the edge from a triangle's corner `edge` to the next.
  bool IsOpenEdge(std::int32_t triangle, int edge) const
  {
    return this->Snapshot->AdjacentTriangles()[triangle][edge] == BoundaryEdge;
  }
  bool HasOpenEdge(std::int32_t triangle) const
  {
    return this->IsOpenEdge(triangle, 0) || this->IsOpenEdge(triangle, 1) ||
      this->IsOpenEdge(triangle, 2);
  }

  /// How a triangle lies under x, to within `clearance` and `wayError`. `normal` is the facet's, by
  /// the order of its corners; `nearest`: see CoverageOf().
  Coverage CoverageAt(std::int32_t triangle, const Vector& normal, double clearance,
    double wayError, const Vector& x, Vector& nearest) const
  {
    const auto [a, b, c] = this->CornersOf(triangle);
    return CoverageOf(
      normal, a, b, c, x, GrowthOverSharedEdges * clearance + wayError,
      GrowthOverGaps * clearance + wayError,
      [&](int edge) { return this->IsOpenEdge(triangle, edge); }, nearest);
  }

  /// Whether CoverageAt() is Coverage::Inside, which is soon known.
  bool IsInside(std::int32_t triangle, const Vector& normal, double clearance, double wayError,
    const Vector& x) const
  {
    const auto [a, b, c] = this->CornersOf(triangle);
    return haptics::IsInside(normal, a, b, c, x, GrowthOverSharedEdges * clearance + wayError);
  }

  /// The point that is over the same place of the triangle after the next motion, and as high.
  Vector PointAfterSweep(std::int32_t triangle, const Vector& x) const;
  /// The triangle behind the edge over which the way along `way` from x leaves a triangle: negative
  /// where there is none, or more than one. `fraction`: of the way, 0 to 1, where it does.
  std::int32_t NextTriangle(
    std::int32_t triangle, const Vector& x, const Vector& way, double& fraction) const;

  /// How much each corner of a triangle counts at x: >= 0, sum 1.
  std::array<double, 3> CornerWeights(std::int32_t triangle, const Vector& x) const;
  /// How the weights of its second and third corner rise over the triangle.
  std::array<Vector, 2> WeightGradients(std::int32_t triangle) const;

private:
  Corners CornersAt(std::int32_t triangle, double fraction) const
  {
    const auto& corners = this->Snapshot->Triangles()[triangle];
    if (fraction < 1.0)
    {
      return { ToVector(this->Snapshot->PointAt(corners[0], fraction)),
        ToVector(this->Snapshot->PointAt(corners[1], fraction)),
        ToVector(this->Snapshot->PointAt(corners[2], fraction)) };
    }
    const auto& points = this->Snapshot->Points();
    return { ToVector(points[corners[0]]), ToVector(points[corners[1]]),
      ToVector(points[corners[2]]) };
  }

  std::shared_ptr<const TriangleSurface> Snapshot;
  double Now;
  double Next; ///< after the next motion
  double TickStart = 1.0;
  double TickEnd = 1.0;
  double Elapsed = 0.0; ///< [s]
};
}

#endif
