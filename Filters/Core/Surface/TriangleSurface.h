#ifndef Haptics_TriangleSurface_h
#define Haptics_TriangleSurface_h

#include "haptics/Math/ProgressCall.h"
#include "haptics/Math/Vec3.h"
#include "haptics/Surface/CollisionEngine.h"
#include "haptics/Surface/SurfacePatch.h"
#include "haptics/Surface/SurfaceReport.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
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
  Mixed      ///< reported of a surface whose triangles differ; cannot be asked for
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
  /// Of a patch: for each triangle its number in the whole surface, the same in every patch; no two
  /// are equal. Empty elsewhere.
  std::vector<std::int64_t> Ids = {};
  /// Of a patch that deforms: where each point comes from. World frame.
  std::vector<Vec3> Starts = {};
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

  /// Widest gap between facets that still counts as closed [world unit]; default 0, finite and >=
  /// 0; more than the surface's Radius() counts as that. Points that were once stored in single
  /// precision have gaps of about 1e-7 of the surface's size where facets meet without sharing
  /// corners; vtkGodObjectFilter sets that by itself.
  double CrackWidth = 0.0;

  /// Where the mesh is a patch of a larger surface: what belongs to that, and where the mesh has
  /// all of its triangles (world frame). CrackWidth is the record's then, Automatic what the whole
  /// surface comes to, and a patch without triangles is one where nothing is. Null: a surface of
  /// its own.
  std::shared_ptr<const WholeSurface> Whole = nullptr;
  PatchRegion Region = {};
  PatchEnclosure Enclosure = {}; ///< world frame
  /// Of a patch whose points come from TriangleMesh::Starts: how long they are on their way, from
  /// when it is first touched [s]. Region and Enclosure are good for all of it. None: it is at
  /// rest.
  std::optional<double> DeformDuration = std::nullopt;
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
  /// that are not as many as the triangles, an engine that this build does not have. Null and no
  /// error where `progress` stopped it.
  static std::shared_ptr<const TriangleSurface> Build(TriangleMesh mesh,
    const SurfaceOptions& options, std::string& error, const ProgressCall& progress = {});
  ~TriangleSurface();

  TriangleSurface(const TriangleSurface&) = delete;

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
  Side TouchedSide() const { return this->ActualSide; }
  /// Whether a triangle is touched from its back too.
  bool TouchesBack(std::int32_t triangle) const
  {
    return this->ActualSide == Side::Mixed ? this->Shared->HasBack[triangle] != 0
                                           : this->ActualSide == Side::Both;
  }
  /// What the triangles enclose: those whose fronts only are touched, and the others.
  struct Enclosure
  {
    Encloser OneSided = Encloser::None;
    Encloser TwoSided = Encloser::None;

    bool operator==(const Enclosure& other) const
    {
      return this->OneSided == other.OneSided && this->TwoSided == other.TwoSided;
    }
  };
  const Enclosure& Enclosing() const { return this->Shared->Encloses; }
  Encloser EncloserOf(std::int32_t triangle) const
  {
    const Enclosure& all = this->Enclosing();
    return this->TouchesBack(triangle) ? all.TwoSided : all.OneSided;
  }
  /// Of the surface as it was built; of a patch: of the whole.
  const SurfaceReport& Report() const { return this->Shared->Found; }
  const CollisionEngine& Engine() const { return *this->Collision; }
  /// Bytes that this snapshot holds, its engine included, and what it shares with others.
  std::size_t MemoryBytes() const;

  ///@{
  /// Which part it is of a larger surface; null where it is no part. A patch encloses
  /// what the whole does where PatchEnclosure is known and no triangle has a side of its own, and
  /// nothing elsewhere.
  const SurfacePatch* Patch() const { return this->Part.get(); }
  /// Whether both are patches of one surface.
  bool IsOfSameWhole(const TriangleSurface& other) const
  {
    return this->Part && other.Part && this->Part->Whole() == other.Part->Whole();
  }
  /// The triangle of this patch that another patch of the same surface, or of the version that this
  /// one follows, has under `triangle`; -1 where it is not here. Servo thread.
  std::int32_t FindSame(const TriangleSurface& other, std::int32_t triangle) const noexcept;
  /// The record of this surface, for patches of it; of a patch: that of the whole.
  WholeSurface Whole() const;
  ///@}

  ///@{
  /// A surface that deforms, made by SurfaceDeformer, or a patch with a DeformDuration: its points
  /// are on their way from StartPoints() to Points() for a time.
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
  /// Whether this one starts where `previous` ends: the next snapshot of one deforming surface, or
  /// a patch of it.
  bool Follows(const TriangleSurface& previous) const
  {
    return this->Predecessor == previous.Number || this->FollowsAsPatch(previous);
  }
  /// Of a patch that deforms: whether it does follow that one, and what both know starts, bit for
  /// bit, where that ends.
  bool GoesOnFrom(const TriangleSurface& previous) const;
  /// The same surface where it has come to rest, as one of its own that follows none.
  std::shared_ptr<const TriangleSurface> AtRest() const;
  ///@}

private:
  friend class SurfaceDeformer;

  TriangleSurface();
  TriangleSurface& operator=(const TriangleSurface&) = default;

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

  bool FollowsAsPatch(const TriangleSurface& previous) const
  {
    return this->Start && this->Part && previous.Part && this->Part->Whole().Before != 0 &&
      this->Part->Whole().Before == previous.Part->Whole().Version &&
      this->SurfaceOrigin == previous.SurfaceOrigin;
  }
  /// What takes the place of Recentre() and Measure() in a patch.
  void TakeFrame(TriangleMesh& mesh, const SurfaceOptions& options);
  /// Works out diagonal, radius, longest edge and clearance; `start`: what it deforms from, or
  /// null. False where no triangle has an area.
  bool Measure(const TriangleSurface* start);
  EngineInput Input() const;

  /// A snapshot's are the next one's start.
  std::shared_ptr<const std::vector<Vec3>> LocalPoints, Start;
  std::shared_ptr<const Topology> Shared;
  std::shared_ptr<const SurfacePatch> Part;
  Vec3 SurfaceOrigin{};
  double SurfaceRadius = 0.0;
  double SurfaceDiagonal = 0.0;
  double LongestEdge = 0.0; ///< of triangles that have an area
  double EndRadius = 0.0;   ///< as SurfaceRadius, of the points where they go
  double EndLongestEdge = 0.0;
  double CrackWidth = 0.0;
  double MinimumClearance = 0.0;
  double Duration = 0.0;
  Side ActualSide = Side::Front;
  std::uint64_t Number = 0;      ///< of this snapshot among all
  std::uint64_t Predecessor = 0; ///< 0: none
  std::shared_ptr<CollisionEngine> Collision;
};
}

#endif
