#ifndef Haptics_FacetTable_h
#define Haptics_FacetTable_h

#include "haptics/Contact/DeformingSurface.h"
#include "haptics/Contact/FacetBatch.h"
#include "haptics/Math/TriangleSeenFrom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace haptics
{
/// @brief Facets around a god-object, one column a value, measured from where it is and where it
/// goes.
///
/// Distances are to a facet's plane, positive on the side that the god-object is on where both
/// sides can be touched. Side by side in memory all of them are measured by vector instructions;
/// what rounding leaves open is decided by exact predicates. Positions are in the surface's local
/// frame.
class FacetTable
{
public:
  /// `capacity`: most facets at once.
  FacetTable(std::shared_ptr<const TriangleSurface> surface, std::size_t capacity);

  DeformingSurface& Surface() { return this->Geometry; }
  const DeformingSurface& Surface() const { return this->Geometry; }

  /// Lists those of the triangles that meet the ball of `question`, whose Position is this one's.
  /// Returns the distance of the nearest one's box from there, HUGE_VAL where there is none.
  double Fill(const TriangleList& found, const FacetBatch::Question& question);
  /// Lists nothing; places will be measured relative to `centre`.
  void Clear(const Vector& centre);
  /// Lists what a table of another patch of the same surface does, as it was measured there. False,
  /// and nothing is listed, where one of its triangles is not in this patch, or there are so many
  /// that it takes long. Servo thread.
  bool TakeOver(const FacetTable& previous);
  std::int32_t Size() const { return this->Count; }
  const Vector& Centre() const { return this->Middle; }

  ///@{
  /// The god-object.
  const Vector& Position() const { return this->From; }
  void SetPosition(const Vector& position)
  {
    this->From = position;
    this->ShortReach = -1.0;
  }
  /// Whether there are facets that are met as lines, or not at all.
  bool HasThin() const { return this->HasThinFacets; }
  bool IsPositionMeasured() const { return this->IsFromMeasured; }
  void MeasurePosition();
  ///@}

  ///@{
  /// Where its next motion ends.
  const Vector& Target() const { return this->To; }
  void SetTarget(const Vector& target)
  {
    this->To = target;
    this->IsToMeasured = false;
  }
  /// Position has to be measured.
  void MeasureTarget(const Vector& target);
  void ForgetTarget() { this->IsToMeasured = false; }
  /// Whether by the measured distances alone no facet can be met on the way there, nor touched.
  bool IsKnownClear(const Vector& target) const
  {
    return this->HasTarget(target) && this->IsToClear;
  }
  bool HasTarget(const Vector& target) const { return this->IsToMeasured && target == this->To; }
  /// Moves to the target. False where the position is not measured then.
  bool MoveToTarget();
  ///@}

  ///@{
  /// Of the facet in row i.
  std::int32_t Triangle(std::int32_t i) const { return this->Triangles[i]; }
  /// Whether the god-object is on its back.
  bool IsFlipped(std::int32_t i) const { return this->Flipped[i] != 0; }
  /// Whether it is met as a line, with no neighbour on one side.
  bool IsOfWire(std::int32_t i) const
  {
    return this->Widths[i] == Width::Wire && this->Geometry.HasOpenEdge(this->Triangles[i]);
  }
  /// Towards the god-object.
  Vector NormalTowards(std::int32_t i) const
  {
    return { this->NormalX[i], this->NormalY[i], this->NormalZ[i] };
  }
  /// By the order of its corners.
  Vector Normal(std::int32_t i) const
  {
    const Vector n = this->NormalTowards(i);
    return this->Flipped[i] ? -n : n;
  }
  double Clearance(std::int32_t i) const { return this->Clearances[i]; }
  double Distance(std::int32_t i) const { return this->Distances[i]; }
  /// Of either distance, HUGE_VAL where the facet is met as a line.
  double Error(std::int32_t i) const { return this->Errors[i]; }
  ///@}
  double TargetDistance(std::int32_t i) const { return this->TargetDistances[i]; }
  /// Calls visit(i) for each row that the motion to the measured target may meet, or touch, as far
  /// as planes say, until that returns false.
  template <class Visitor>
  void VisitMet(const Visitor& visit) const
  {
    for (std::int32_t first = 0; first < this->Count; first += RowsInMask)
    {
      for (std::uint64_t rows = this->Met[first / RowsInMask]; rows != 0; rows &= rows - 1)
      {
        if (!visit(first + __builtin_ctzll(rows)))
        {
          return;
        }
      }
    }
  }

  /// Whether the way to `to` comes into a triangle's box, grown by `reach`: as far as the way's own
  /// box says.
  bool MeetsBox(std::int32_t i, const Vector& to, double reach) const
  {
    return this->IsBoxMet(i, this->From, to, reach);
  }
  /// Whether a place is in that box.
  bool IsInBox(std::int32_t i, const Vector& x, double reach) const
  {
    return this->IsBoxMet(i, x, x, reach);
  }
  /// Distance from Position() to the nearest plane, less its error.
  double NearestPlane() const { return this->Nearest; }

  /// A facet that a motion to `to` touches from a side that can be touched, or -1. Exact. Position
  /// has to be measured.
  std::int32_t FindTouched(const Vector& to);
  /// The same, for many short motions to be tried from one position. Afterwards `to` is the
  /// measured target where none is touched.
  std::int32_t FindTouchedShort(const Vector& to);
  /// Whether a motion touches the facet that was found last; false where it is not known.
  bool StillTouches(const Vector& to) const;

  /// What there is of edges that no other facet shares near the god-object.
  enum class Rims
  {
    None,
    Joined, ///< of one facet, or of several with corners in common
    Apart   ///< of facets that have none: there may be a gap between them
  };
  /// Within so many clearances.
  Rims FindRims(double clearances) const;

private:
  /// By the box of a way from one place to another.
  bool IsBoxMet(std::int32_t i, const Vector& from, const Vector& to, double reach) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double p = from[axis];
      const double q = to[axis];
      if (this->Low[axis][i] - reach > std::max(p, q) ||
        this->High[axis][i] + reach < std::min(p, q))
      {
        return false;
      }
    }
    return true;
  }
  void FillRest();
  bool FillThin(std::int32_t i, const FacetBatch::Question& question);
  bool IsSeam(std::int32_t triangle, const Facet& facet, double clearance) const;
  void TurnToPosition();
  void TurnThin();
  void SetLimits();
  double DistanceOf(std::int32_t i, const Vector& x) const
  {
    const Vector d = x - this->Middle;
    return this->NormalX[i] * d.x + this->NormalY[i] * d.y + this->NormalZ[i] * d.z -
      this->PlaneOffset[i];
  }
  void ListShort(double reach);
  bool Touches(std::int32_t i, double distance, const Vector& to) const;

  /// Which side of a thin triangle the god-object is on, and what crosses it, is decided exactly.
  enum class Width : std::uint8_t
  {
    Broad,
    /// Thinner than its clearance: met as a line. Across it no direction is its own, so its plane
    /// is the one that faces the god-object.
    Wire,
    /// Thinner than rounding, on the edge of a broad one that goes on from it: not met, as nothing
    /// reaches it but along the other's plane.
    Seam
  };

  DeformingSurface Geometry;
  Vector Middle{ 0 };          ///< planes are kept relative to it
  Vector From{ 0 };            ///< the god-object
  Vector To{ 0 };              ///< of the last cast or certificate
  bool IsFromMeasured = false; ///< Distances hold for From
  bool IsToMeasured = false;   ///< TargetDistances hold for To
  bool IsToClear = false;
  bool HasThinFacets = false;
  std::int32_t Count = 0;
  std::int32_t LastTouched = -1; ///< by a motion that was not clear
  std::vector<std::int32_t> Triangles;
  std::vector<std::uint8_t> Flipped;
  std::vector<Width> Widths;
  std::vector<double> NormalX, NormalY, NormalZ, PlaneOffset;
  std::array<std::vector<double>, 3> Low, High; ///< its box
  std::vector<double> Errors, Clearances;
  std::vector<double> Distances, TargetDistances;
  /// A motion that ends farther from the plane than this does not meet the facet, nor touch it.
  std::vector<double> Limits;
  double Nearest = HUGE_VAL; ///< of Distances, less their errors
  /// A bit for each row whose target distance is at most its limit.
  std::vector<std::uint64_t> Met;
  static constexpr std::int32_t RowsInMask = 64;
  /// A facet that motions no longer than ShortReach may touch.
  struct ShortRow
  {
    std::int32_t Row;
    TriangleSeenFrom FromHere;
  };
  static constexpr std::int32_t MostShortRows = 64;
  std::array<ShortRow, MostShortRows> ShortRows;
  std::int32_t ShortCount = 0; ///< MostShortRows + 1: more than are listed
  double ShortReach = -1.0;    ///< negative: not listed for this position
};
}

#endif
