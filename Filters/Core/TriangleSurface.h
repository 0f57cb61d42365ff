#ifndef TriangleSurface_h
#define TriangleSurface_h

#include "CollisionEngine.h"
#include "SurfaceReport.h"
#include "Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace haptics
{
/// Which side of a triangle can be touched.
enum class Side
{
  Front,    ///< the side its normal points to: the paper's one-sided surfaces
  Both,     ///< no path crosses any triangle, from either side
  Automatic ///< Front where the surface is closed, oriented and not inside out; Both elsewhere
};

/// Corner indices into the points, counter-clockwise as seen from the front.
using Triangle = std::array<std::int32_t, 3>;

/// What a surface is built from.
struct TriangleMesh
{
  std::vector<Vec3> Points;        ///< world frame, any unit
  std::vector<Triangle> Triangles; ///< one without area, or under 1e-160, is never touched
};

struct SurfaceOptions
{
  Side TouchedSide = Side::Automatic;
  EngineKind Engine = EngineKind::Automatic;

  /// Widest gap between facets that still feels closed [world unit]; default 0, finite and >= 0;
  /// more than the surface's Radius() counts as that.
  /// Points that were once stored in single precision have gaps of about 1e-7 of the surface's
  /// size where facets meet without sharing corners; vtkGodObjectFilter sets that by itself.
  double CrackWidth = 0.0;
};

/// @brief An immutable triangle surface with its collision engine: the snapshot that is touched.
///
/// Built once off the servo thread, then shared and read from any thread. Points are kept in
/// float64 relative to Origin(), so that a surface far from the world's origin keeps its detail.
class VTKHAPTICSCORE_EXPORT TriangleSurface
{
public:
  /// Builds a snapshot, or returns null and says in `error` what is wrong and where: no triangle,
  /// no triangle with an area, a corner index out of range, a coordinate that is not finite, an
  /// engine that this build does not have.
  static std::shared_ptr<const TriangleSurface> Build(
    TriangleMesh mesh, const SurfaceOptions& options, std::string& error);
  ~TriangleSurface();

  TriangleSurface(const TriangleSurface&) = delete;
  TriangleSurface& operator=(const TriangleSurface&) = delete;

  /// Origin of the local frame, in the world frame: the middle of the bounds.
  const Vec3& Origin() const { return this->SurfaceOrigin; }
  /// Points in the local frame: world minus Origin().
  const std::vector<Vec3>& Points() const { return this->Mesh.Points; }
  const std::vector<Triangle>& Triangles() const { return this->Mesh.Triangles; }
  /// Half the diagonal of the bounds: no point is farther from Origin(). [world unit]
  double Radius() const { return this->SurfaceRadius; }
  /// Across each edge of each triangle: the neighbour, BoundaryEdge or NonManifoldEdge.
  const Neighbours& AdjacentTriangles() const { return this->Adjacent; }
  /// How far in front of a facet the god-object is kept at least [world unit]: 1024 roundings of
  /// a coordinate, or a quarter of the crack width, whichever is more.
  double Clearance() const { return this->MinimumClearance; }

  /// Front or Both: what Automatic came to.
  Side TouchedSide() const { return this->Touched; }
  const SurfaceReport& Report() const { return this->Found; }
  const CollisionEngine& Engine() const { return *this->Collision; }
  /// Bytes that this snapshot holds, its engine included.
  std::size_t MemoryBytes() const;

private:
  TriangleSurface() = default;

  TriangleMesh Mesh;
  Vec3 SurfaceOrigin{};
  Neighbours Adjacent;
  double SurfaceRadius = 0.0;
  double MinimumClearance = 0.0;
  Side Touched = Side::Front;
  SurfaceReport Found;
  std::unique_ptr<CollisionEngine> Collision;
};
}

#endif
