#ifndef Haptics_TriangleSurface_h
#define Haptics_TriangleSurface_h

#include "haptics/Math/Vec3.h"
#include "haptics/Surface/CollisionEngine.h"
#include "haptics/Surface/SurfaceReport.h"
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
  Front,     ///< the side its normal points to: the paper's one-sided surfaces
  Both,      ///< no path crosses any triangle, from either side
  Automatic, ///< Front where the surface is closed, oriented and not inside out; Both elsewhere
  Mixed      ///< told of a surface whose triangles differ; not to be asked for
};

/// Corner indices into the points, counter-clockwise as seen from the front.
using Triangle = std::array<std::int32_t, 3>;

/// What a surface is built from.
struct TriangleMesh
{
  std::vector<Vec3> Points;        ///< world frame, any unit
  std::vector<Triangle> Triangles; ///< one without area, or under 1e-160, is never touched
  /// The side of each triangle where they differ; empty: SurfaceOptions::TouchedSide for all.
  /// Automatic is what it comes to for the surface as a whole.
  std::vector<Side> Sides = {};
};

/// How a triangle encloses space together with others, so that to be inside is a matter of
/// counting.
enum class Encloser
{
  None,
  Front, ///< what is inside may leave, and not come back
  Both   ///< what is inside stays there
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
  /// no triangle with an area, a corner index out of range, a coordinate that is not finite, sides
  /// that are not as many as the triangles, an engine that this build does not have.
  static std::shared_ptr<const TriangleSurface> Build(
    TriangleMesh mesh, const SurfaceOptions& options, std::string& error);
  ~TriangleSurface();

  TriangleSurface(const TriangleSurface&) = delete;
  TriangleSurface& operator=(const TriangleSurface&) = delete;

  /// Origin of the local frame, in the world frame: the middle of the bounds, or 0 in a coordinate
  /// in which a point would have to be rounded for it.
  const Vec3& Origin() const { return this->SurfaceOrigin; }
  /// Points in the local frame: world minus Origin(). Of a surface that deforms: where they go.
  const std::vector<Vec3>& Points() const { return *this->LocalPoints; }
  const std::vector<Triangle>& Triangles() const { return this->Shared->Triangles; }
  /// No point is farther from Origin(): half the diagonal of the bounds, and their middle's
  /// distance from there. [world unit]
  double Radius() const { return this->SurfaceRadius; }
  /// Diagonal of the bounds, where it has come to rest. [world unit]
  double Diagonal() const { return this->SurfaceDiagonal; }
  /// Across each edge of each triangle: the neighbour, BoundaryEdge or NonManifoldEdge.
  const Neighbours& AdjacentTriangles() const { return this->Shared->Adjacent; }
  /// How far in front of a facet the god-object is kept at least [world unit]: 1024 roundings of
  /// a coordinate, or a quarter of the crack width, whichever is more.
  double Clearance() const { return this->MinimumClearance; }

  /// Front, Both or Mixed: what was asked for came to.
  Side TouchedSide() const { return this->Touched; }
  /// Whether a triangle is touched from its back too.
  bool TouchesBack(std::int32_t triangle) const
  {
    return this->Touched == Side::Mixed ? this->Shared->HasBack[triangle] != 0
                                        : this->Touched == Side::Both;
  }
  /// What the triangles enclose: those whose fronts only are touched, and the others.
  struct Enclosure
  {
    Encloser Fronts = Encloser::None;
    Encloser Boths = Encloser::None;

    bool operator==(const Enclosure& other) const
    {
      return this->Fronts == other.Fronts && this->Boths == other.Boths;
    }
  };
  const Enclosure& Enclosing() const { return this->Shared->Encloses; }
  Encloser EncloserOf(std::int32_t triangle) const
  {
    const Enclosure& all = this->Enclosing();
    return this->TouchesBack(triangle) ? all.Boths : all.Fronts;
  }
  /// Of the surface as it was built.
  const SurfaceReport& Report() const { return this->Shared->Found; }
  const CollisionEngine& Engine() const { return *this->Collision; }
  /// Bytes that this snapshot holds, its engine included, and what it shares with others.
  std::size_t MemoryBytes() const;

  ///@{
  /// A surface that deforms, made by SurfaceDeformer: its points are on their way from
  /// StartPoints() to Points() for a time.
  bool Deforms() const { return this->Start != nullptr; }
  /// Local frame; null where nothing deforms.
  const std::vector<Vec3>* StartPoints() const { return this->Start.get(); }
  /// How long the points are on their way [s], from when the snapshot is first touched.
  double DeformDuration() const { return this->Duration; }
  /// A point when a fraction of the time is over, 0 to 1: the same for every triangle that shares
  /// it.
  Vec3 PointAt(std::int32_t point, double fraction) const
  {
    const Vec3& to = (*this->LocalPoints)[point];
    if (fraction >= 1.0 || !this->Start)
    {
      return to;
    }
    const Vec3& from = (*this->Start)[point];
    return { from[0] + fraction * (to[0] - from[0]), from[1] + fraction * (to[1] - from[1]),
      from[2] + fraction * (to[2] - from[2]) };
  }
  /// Whether this one starts where `previous` ends: the next snapshot of one deforming surface.
  bool Follows(const TriangleSurface& previous) const
  {
    return this->Predecessor == previous.Number;
  }
  ///@}

private:
  friend class SurfaceDeformer;

  TriangleSurface();

  /// What does not change when points move.
  struct Topology
  {
    std::vector<Triangle> Triangles;
    Neighbours Adjacent;
    SurfaceReport Found;
    std::vector<std::uint8_t> HasBack; ///< for each triangle; empty where all have the same side
    Enclosure Encloses;
  };

  /// What the sides asked for come to, and what encloses by them.
  static Side ChooseSides(
    const std::vector<Vec3>& points, std::vector<Side> asked, Side forAll, Topology& topology);

  /// Works out diagonal, radius, longest edge and clearance; `start`: what it deforms from, or
  /// null. False where no triangle has an area.
  bool Measure(const TriangleSurface* start);
  EngineInput Input() const;

  /// A snapshot's are the next one's start.
  std::shared_ptr<const std::vector<Vec3>> LocalPoints, Start;
  std::shared_ptr<const Topology> Shared;
  Vec3 SurfaceOrigin{};
  double SurfaceRadius = 0.0;
  double SurfaceDiagonal = 0.0;
  double LongestEdge = 0.0; ///< of triangles that have an area
  double EndRadius = 0.0;   ///< as SurfaceRadius, of the points where they go
  double EndLongestEdge = 0.0;
  double CrackWidth = 0.0;
  double MinimumClearance = 0.0;
  double Duration = 0.0;
  Side Touched = Side::Front;
  std::uint64_t Number = 0;      ///< of this snapshot among all
  std::uint64_t Predecessor = 0; ///< 0: none
  std::shared_ptr<CollisionEngine> Collision;
};
}

#endif
