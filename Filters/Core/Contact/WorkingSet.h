#ifndef Haptics_WorkingSet_h
#define Haptics_WorkingSet_h

#include "haptics/Contact/ActivePlanes.h"
#include "haptics/Contact/NarrowGap.h"
#include "haptics/Surface/Facet.h"
#include "haptics/Surface/SurfaceFrame.h"
#include "haptics/Surface/SurfaceSide.h"
#include "haptics/Surface/TriangleSurface.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace haptics
{
/// The first facet that a motion meets.
struct FacetHit
{
  double Fraction = HUGE_VAL; ///< of the motion, 0 to 1; HUGE_VAL: none
  double Slack = 0.0;         ///< by which rounding may change Fraction
  double Depth = 0.0;         ///< of the motion's end behind the plane, less the slack of that
  ActivePlane Plane;
  /// No facet: so far nothing can be, and from there the rest is to be looked at. A way from far
  /// out is known too badly to say what it meets.
  bool IsWaypoint = false;

  explicit operator bool() const { return this->Fraction <= 1.0; }

  /// Takes the other one in, if it comes first. Of facets met at once the one most pressed against
  /// counts, and of those the first in the list: so neither the order in which an engine finds them
  /// nor rounding matters.
  void Take(const FacetHit& other);
};

/// A facet that lies along a plane, and how much it counts there, 0 to 1.
struct FacetAlong
{
  std::int32_t Triangle = -1;
  double Weight = 0.0;
};

/// @brief The triangles around the god-object, side by side in memory.
///
/// A ball of triangles is gathered from the surface's engine once and serves every cast and every
/// certificate of several ticks. A motion that leaves the ball is answered from the triangles along
/// it. Either way no triangle that the motion can meet is missing, because engines are
/// conservative.
///
/// All positions are in the scene frame. Inside, the surface's local frame is used: a position
/// always rounds to the same local point, so that pieces of the path join exactly.
///
/// A surface that moves is another frame: the god-object stays at the local point where it was, and
/// the next motion starts from there, so that what is certified is the way as the surface sees it.
///
/// A surface that deforms is told to sweep to a later fraction of its time; the next motion is then
/// made together with its triangles.
class WorkingSet
{
public:
  /// Most that one gathering holds: more meet in no point of any surface seen, and fewer would
  /// leave the tip of a finely cut cone out of touch.
  static constexpr std::int32_t LargestNumberOfTriangles = 1 << 15;

  /// `index` names the surface in FacetIds.
  WorkingSet(
    std::shared_ptr<const TriangleSurface> surface, std::int32_t index, const SurfaceFrame& frame);

  const TriangleSurface& Surface() const { return *this->Touched; }

  const SurfaceFrame& Frame() const { return this->ToSurface; }
  /// Moves the surface; the god-object stays at its local point.
  void SetFrame(const SurfaceFrame& frame);
  /// Where the god-object is in the surface's local frame, exactly as certified.
  const Vector& LocalPosition() const { return this->Position; }

  /// Puts the god-object somewhere without moving it there.
  void Place(const Vector& position);
  /// The same, and forgets what it has learned of the surface: what follows is the same to the last
  /// digit, whatever was touched before.
  void Restart(const Vector& position);
  /// Goes back to a local point where it has been, from where nothing has moved since.
  void Return(const Vector& local);
  /// Stands where another set of the same surface has its god-object.
  void Continue(const WorkingSet& previous);
  /// Stands where another set had its god-object, of a surface that has changed all at once. False
  /// where the changed surface has gone over it: then on the nearest place of the side that it was
  /// on. `held`: a plane of the surface before that held it, or null.
  /// `scratch`: for what the surface before is asked.
  bool Succeed(
    const WorkingSet& previous, const ActivePlane* held, TriangleList scratch, WorkBudget& budget);

  /// Whether another place is enclosed by the surface as often as the god-object; true where
  /// nothing encloses, false where it cannot be told. Scene frame.
  bool IsOnSameSide(const Vector& place, WorkBudget& budget);

  /// Finds the first facet met on the way to `goal`, short of which the god-object has to stop.
  /// Active facets count only where they would be crossed. False when the budget ends first, or one
  /// place has more triangles than fit: then nothing may move.
  bool FindFirstHit(
    const Vector& goal, const ActivePlanes& active, WorkBudget& budget, FacetHit& hit);

  /// Certifies a motion to `target`, on the way to the goal of the last FindFirstHit and no farther
  /// than its hit: true only if it touches no facet from the side that can be touched. Exact.
  bool IsClear(const Vector& target);

  /// Certifies a motion to anywhere around. False also where not all triangles there are known, and
  /// in a sweep. `inTheWay`: set to the plane of a facet that is, if one is known.
  bool IsClearNear(const Vector& target, ActivePlane& inTheWay);

  /// How many triangles a certificate looks at.
  std::int32_t GatheredTriangles() const { return this->Count; }

  /// Calls visit(plane, hasRim) for the gathered facets within so many of their clearances of the
  /// god-object; of the plane, only Facet and Normal are set. `hasRim`: whether an edge of the
  /// facet is no other's.
  template <class Visitor>
  void VisitNear(double clearances, const Visitor& visit)
  {
    if (!this->IsPositionMeasured)
    {
      this->MeasurePosition();
    }
    for (std::int32_t i = 0; i < this->Count; ++i)
    {
      const double reach = clearances * this->Clearance[i];
      if (std::abs(this->Distance[i]) <= reach && this->MeetsBox(i, this->Position, reach))
      {
        ActivePlane plane;
        plane.Facet = { this->Index, this->Triangles[i] };
        plane.Normal = this->ToSurface.VectorToScene(this->FacetNormal(i));
        visit(plane);
      }
    }
  }

  /// What there is of edges that no other facet shares within so many clearances of the god-object.
  enum class Rims
  {
    None,
    Joined, ///< of one facet, or of several with corners in common
    Apart   ///< of facets that have none: there may be a gap between them
  };
  Rims FindRimsNear(double clearances);

  /// Moves to the target of the last IsClear, which must have been true.
  void Move();

  ///@{
  /// A surface that deforms. Between two ticks the fraction of its time goes on to what it is after
  /// `dt` [s]; of that way any part, 0 to 1, is swept with the next motion.
  double Fraction() const { return this->Now; }
  void BeginTick(double dt);
  void SweepTo(double part);
  void SweepNothing() { this->Next = this->Now; }
  /// Parts are of what is left of the tick from here on.
  void BeginRest();
  /// Goes to the end of the tick, whatever it passes; a solid that has gone over the god-object has
  /// it on the nearest place outside.
  void SkipTick(WorkBudget& budget);
  ///@}

  /// The plane as its facet will be after the next motion.
  void Renew(ActivePlane& plane) const;
  /// The local point that stays over the same place of the plane's facet, and as high, in the next
  /// motion.
  Vector CarriedBy(const ActivePlane& plane) const;

  /// Whether the god-object stands over the facet itself, not only over its plane: `planes` are
  /// those that hold it.
  /// `isInside` is set to whether it is not near an edge of the facet.
  bool Covers(const ActivePlane& plane, const Vector& position, const ActivePlanes& planes,
    bool& isInside) const;
  /// The unit normal (scene frame) of the facet behind the edge over which a way leaves a plane's
  /// facet. False where there is none, or none that is known.
  bool FindNextNormal(
    const ActivePlane& plane, const Vector& from, const Vector& to, Vector& normal) const;
  /// Whether the god-object stands beyond the facet, which reaches there over a gap, and what comes
  /// along `other` passes over the facet.
  bool IsPassedOver(
    const ActivePlane& plane, const Vector& position, const ActivePlane& other) const;

  /// Whether the facet of a plane is, for certain, in the straight way to `goal`; of one as thin as
  /// a line, if it `isNew`, to within rounding.
  bool StandsInWay(const ActivePlane& plane, const Vector& goal, bool isNew) const;
  /// Whether the straight way to `goal` meets no facet from a side that can be touched: exact, but
  /// false where the budget ends first or the way is not known well enough. Adds to `gap` what is
  /// near the way. Afterwards IsClear() can be asked about `goal`.
  bool IsOpen(const Vector& goal, WorkBudget& budget, NarrowGap& gap);

  /// The facet that lies along a plane with this normal (scene frame), below the god-object: wholly
  /// up to the distance `near`, from `far` on no longer, by a smooth step between. None where it
  /// cannot be told. Between motions.
  FacetAlong FindAlong(const Vector& normal, double near, double far, WorkBudget& budget);

  /// How much each corner of a triangle counts where the god-object stands over it: >= 0, sum 1.
  std::array<double, 3> CornerWeights(std::int32_t triangle) const;
  /// How the weights of its second and third corner rise over the triangle, scene frame.
  std::array<Vec3, 2> WeightGradients(std::int32_t triangle) const;

private:
  enum class Region
  {
    Nothing,
    Ball,
    Segment
  };

  bool GatherBall(WorkBudget& budget);
  bool GatherSegment(const Vector& to, WorkBudget& budget);
  /// Keeps of the found triangles those that meet the ball about `middle`. `farthest`: no place
  /// that will be asked for is farther from Centre.
  void Fill(const TriangleList& found, const Vector& middle, double radius, double farthest);
  void ForgetTriangles()
  {
    this->Count = 0;
    this->LastTouched = -1;
    this->HasThin = false;
  }
  bool FillThin(std::int32_t i, double farthest);
  bool IsSeam(std::int32_t triangle, const Facet& facet, double clearance) const;
  void KeepClearOfRounding();
  void Measure(const Vector& x, std::vector<double>& distances) const;
  void MeasurePosition();
  void MeasureTarget(const Vector& to);
  void TurnToPosition();
  void TurnThin();
  void SetLimits();
  void GrowEmptyBall(double nearest);
  FacetHit Scan(const Vector& to, const ActivePlanes& active);
  bool MeetsAny(const Vector& to);
  bool Touches(std::int32_t i, double distance, const Vector& to) const;
  /// Whether the way to `to` comes into a triangle's box, grown by `reach`: as far as the way's own
  /// box tells.
  bool MeetsBox(std::int32_t i, const Vector& to, double reach) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double p = this->Position[axis];
      const double q = to[axis];
      if (this->Low[axis][i] - reach > std::max(p, q) ||
        this->High[axis][i] + reach < std::min(p, q))
      {
        return false;
      }
    }
    return true;
  }
  /// Whether no other triangle shares the edge from a triangle's corner `edge` to the next.
  bool IsOpenEdge(std::int32_t triangle, int edge) const
  {
    return this->Touched->AdjacentTriangles()[triangle][edge] == BoundaryEdge;
  }
  bool HasOpenEdge(std::int32_t triangle) const
  {
    return this->IsOpenEdge(triangle, 0) || this->IsOpenEdge(triangle, 1) ||
      this->IsOpenEdge(triangle, 2);
  }
  /// A gathered triangle that a motion touches from the side that can be touched, or -1.
  std::int32_t FindTouched(const Vector& to);
  /// Whether a motion touches the triangle that was found last; false where it is not known.
  bool StillTouches(const Vector& to) const;
  struct Corners
  {
    Vector A, B, C;
  };
  Corners CornersOf(std::int32_t triangle) const { return this->CornersAt(triangle, this->Now); }
  Corners CornersAt(std::int32_t triangle, double fraction) const
  {
    const auto& corners = this->Touched->Triangles()[triangle];
    if (fraction < 1.0)
    {
      return { ToVector(this->Touched->PointAt(corners[0], fraction)),
        ToVector(this->Touched->PointAt(corners[1], fraction)),
        ToVector(this->Touched->PointAt(corners[2], fraction)) };
    }
    const auto& points = this->Touched->Points();
    return { ToVector(points[corners[0]]), ToVector(points[corners[1]]),
      ToVector(points[corners[2]]) };
  }
  bool PlaceBack(const Enclosed& before, const Enclosed& now, WorkBudget& budget);
  bool PlaceOff(
    const Vector& nearest, const Vector& outwards, const Enclosed* enclosed, WorkBudget& budget);
  SurfaceSide Sides(WorkBudget& budget);
  bool IsSweeping() const { return this->Next != this->Now; }
  bool GatherSwept(const Vector& to, WorkBudget& budget);
  bool FindSwept(const Vector& to, WorkBudget& budget, FacetHit& hit);
  bool Sweeps(std::int32_t triangle, const Vector& to, FacetHit& hit) const;
  void MoveSwept();
  Coverage CoverageAt(std::int32_t triangle, const Vector& normal, double clearance,
    double wayError, const Vector& x, Vector& nearest) const;
  bool Covers(const FacetId& facet, const Vector& normal, double clearance, double wayError,
    const Vector& x, const ActivePlanes& planes) const;
  Coverage CoverageAt(const ActivePlane& plane, const Vector& position, Vector& nearest) const;
  Vector FacetNormal(std::int32_t i) const
  {
    const Vector n{ this->NormalX[i], this->NormalY[i], this->NormalZ[i] };
    return this->Flipped[i] ? -n : n;
  }
  bool IsInBall(const Vector& x) const;
  bool IsFarOut() const;
  bool IsEmptyAround(const Vector& x) const;
  /// Whether a motion stays in the empty ball: then nothing has to be measured for it.
  bool PassesThroughNothing(const Vector& to);

  std::shared_ptr<const TriangleSurface> Touched;
  std::int32_t Index;
  SurfaceFrame ToSurface;
  double MinimumClearance = 0.0;
  double Reach = 0.0; ///< no facet is felt farther than this from itself

  double Now = 1.0;  ///< fraction of a deformation's time
  double Next = 1.0; ///< after the next motion
  double TickStart = 1.0;
  double TickEnd = 1.0;
  double Elapsed = 0.0;      ///< [s] of a deformation
  bool IsSweepClear = false; ///< to Target

  /// An engine that finds more in a ball is stopped, and a ball of half the radius is tried. Where
  /// even the smallest ball has more, as near the tip of a fan, more are let through.
  static constexpr std::int32_t FewInBall = 64;

  Region Covered = Region::Nothing;
  Vector Centre{ 0 };                  ///< of the ball; start of the segment
  double Radius = 0.0;                 ///< of the ball
  double RadiusToTry = 0.0;            ///< next time
  double LargestToTry = HUGE_VAL;      ///< below a radius that had too many, for some time
  std::int32_t MostInBall = FewInBall; ///< where the engine is stopped
  Vector GatheredAt{ 0 };              ///< where the god-object was when the last ball was gathered
  Vector EmptyCentre{ 0 };             ///< of a ball in which no facet is felt: nothing to look at
  double EmptyRadius = 0.0;
  Vector Position{ 0 };            ///< god-object, local frame
  Vector Target{ 0 };              ///< of the last cast or certificate, local frame
  bool IsPositionMeasured = false; ///< Distance holds for Position
  bool IsTargetMeasured = false;   ///< TargetDistance holds for Target

  // Structure of arrays, one entry a gathered triangle. Distances are to its plane, positive on
  // the side that the god-object is on when both sides can be touched.
  std::int32_t Count = 0;
  std::int32_t LastTouched = -1; ///< by a motion that was not clear
  std::int32_t FoundCount = 0;   ///< what the engine found, of which Count are near enough
  std::vector<std::int32_t> Found;
  std::vector<std::int32_t> Triangles;
  std::vector<std::uint8_t> Flipped;
  /// Which side of a thin triangle the god-object is on, and what crosses it, is told exactly.
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
  std::vector<Width> Widths;
  bool HasThin = false;
  std::vector<double> NormalX, NormalY, NormalZ, PlaneOffset;
  std::array<std::vector<double>, 3> Low, High; ///< its box
  std::vector<double> Error, Clearance;
  std::vector<double> Distance, TargetDistance;
  bool IsTargetClear = false; ///< no triangle can be touched on the way to Target, for certain
  /// A motion that ends farther from the plane than this does not meet the facet, nor touch it.
  std::vector<double> Limit;
};
}

#endif
