#ifndef Haptics_SurfaceCensus_h
#define Haptics_SurfaceCensus_h

#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCleaner.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

class vtkPolyData;

namespace haptics
{
/// A box, empty at first.
struct VTKHAPTICSFILTERS_EXPORT PartBox
{
  Vec3 Low{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vec3 High{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  bool IsEmpty() const { return !(this->Low[0] <= this->High[0]); }
  void Add(const Vec3& point);
  void Merge(const PartBox& other);
  bool Contains(const Vec3& point, double margin) const;
  /// Of a place outside; 0 of one inside.
  double DistanceTo(const Vec3& place) const;
};

/// The frame in which the parts of a surface are cleaned: that of the bounds of all.
VTKHAPTICSFILTERS_EXPORT CleaningFrame FrameOf(const PartBox& all);

/// @brief What the parts of a surface come to together, where no process has more than one of them.
///
/// A reduction in two rounds. The first gives the box of the used points of each part
/// (MeasureUsedPoints()). With the boxes of all, each part, cleaned in the frame of all, is counted
/// by itself (Add()), and the counts are merged in any order and grouping (Merge()): the result is
/// that of the whole surface.
///
/// An edge whose ends lie in the box of no other part is no other part's, and is only a number
/// then. All others are kept by their places until the end, so that a part may stand for some of an
/// edge's triangles. Parts that are cut in space share few, parts that are dealt out triangle by
/// triangle nearly all: then this holds as much as the surface's edges.
///
/// Points of different parts are one where they have the same place relative to the frame's origin,
/// or, with a tolerance, where they are within it of each other: what two processes compute of one
/// point may differ in the last digits. Whether a closed piece is inside out is found by a sum of
/// volumes, which rounds in another order for other parts.
class VTKHAPTICSFILTERS_EXPORT SurfaceCensus
{
public:
  /// `tolerance`: within which points of different parts are one; the parts were cleaned with it.
  /// Finite, >= 0. [world unit]
  explicit SurfaceCensus(double tolerance = 0.0)
    : Tolerance(tolerance)
  {
  }

  /// `others`: the boxes of all parts but this one; none where it is alone.
  void Add(const CleanedMesh& part, const CleaningFrame& frame, const std::vector<PartBox>& others);
  void Merge(const SurfaceCensus& other);
  /// The record; all but Version, CrackWidth and Region. `all`: the box of all parts.
  PatchRecord Finish(const PartBox& all) const;

  /// Adds ranges of arrays: their finite values.
  void AddRanges(vtkPolyData* part, const CleanedMesh& cleaned);
  ///@{
  /// For another process of the same machine type and build. False where `bytes` are not a
  /// census'; then this one is of no use.
  std::string Pack() const;
  bool Unpack(const std::string& bytes);
  ///@}
  /// How many edges are kept by their places.
  std::size_t NumberOfSharedEdges() const { return this->Edges.size(); }

private:
  using Key = std::array<Vec3, 2>; ///< the lower end first
  struct Hash
  {
    std::size_t operator()(const Key& key) const;
  };
  struct Uses
  {
    std::int64_t Up = 0; ///< triangles that go from the lower end to the other
    std::int64_t Down = 0;
    std::int32_t Piece = -1; ///< of one of them
  };
  using EdgeUses = std::unordered_map<Key, Uses, Hash>;
  struct Piece
  {
    double SignedVolume = 0.0;
    PartBox Box;
    bool IsOpen = false;
  };

  void Count(
    const CleanedMesh& part, const CleaningFrame& frame, const std::vector<PartBox>& others);
  EdgeUses MergeEnds(std::vector<std::int32_t>& parents) const;
  void AddLongestEdge(const TriangleMesh& mesh, const Triangle& t);
  template <class Self, class Archive>
  static void Transfer(Self& self, Archive& archive);

  double Tolerance;
  SurfaceReport Counts; ///< of edges that no other part has
  std::int64_t Triangles = 0;
  double SquaredEdge = 0.0;
  std::array<bool, 3> AreExact{ { true, true, true } };
  std::vector<Piece> Pieces;
  std::vector<std::int32_t> Parents; ///< of pieces: disjoint sets
  EdgeUses Edges;
  ArrayRanges PointRanges;
  ArrayRanges CellRanges;
};
}

#endif
