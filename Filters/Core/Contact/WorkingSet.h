#ifndef Haptics_WorkingSet_h
#define Haptics_WorkingSet_h

#include "haptics/Contact/ActivePlanes.h"
#include "haptics/Contact/InsideOfFacet.h"
#include "haptics/Contact/NarrowGap.h"
#include "haptics/Contact/Neighbourhood.h"
#include "haptics/Contact/SideKeeper.h"
#include "haptics/Surface/SurfaceFrame.h"

#include <array>
#include <memory>
#include <optional>

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

/// @brief One surface as a god-object meets it: first hits and exact certificates of its motions.
///
/// All positions are in the scene frame. Inside, the surface's local frame is used: a position
/// always rounds to the same local point, so that pieces of the path join exactly.
///
/// A surface that moves is another frame: the god-object stays at the local point where it was, and
/// the next motion starts from there, so that what is certified is the way as the surface sees it.
///
/// A surface that deforms has to sweep to a later fraction of its time; the next motion is then
/// made together with its triangles.
class WorkingSet
{
public:
  /// `index` names the surface in FacetIds.
  WorkingSet(const std::shared_ptr<const TriangleSurface>& surface, std::int32_t index,
    const SurfaceFrame& frame);

  const TriangleSurface& Surface() const { return this->Geometry().Surface(); }

  const SurfaceFrame& Frame() const { return this->ToSurface; }
  /// Moves the surface; the god-object stays at its local point.
  void SetFrame(const SurfaceFrame& frame);
  /// Where the god-object is in the surface's local frame, exactly as certified.
  const Vector& LocalPosition() const { return this->Facets().Position(); }

  /// Puts the god-object somewhere without moving it there.
  void Place(const Vector& position);
  /// The same, and forgets what it has learned of the surface: what follows is the same to the last
  /// digit, whatever was touched before.
  void Restart(const Vector& position);
  /// Goes back to a local point where it has been, from where nothing has moved since.
  void Return(const Vector& local);
  /// Stands where another set of the same surface has its god-object.
  void Continue(const WorkingSet& previous);
  /// Goes on where another set of the same surface, or of another patch of it, stands, with all
  /// that it knows.
  void TakeOver(const WorkingSet& previous);
  ///@{
  /// Of a patch: how much of the way from the god-object to a HIP is known, and whether a place is;
  /// `radius`: of a ball there. Scene frame.
  double KnownPart(const Vector& hip, double radius) const;
  bool IsKnown(const Vector& place, double radius) const;
  ///@}
  /// Stands where another set had its god-object, of a surface that has changed all at once. False
  /// where the changed surface has gone over it: then on the nearest place of the side that it was
  /// on. Where a patch does not show that place, IsAstray(). `held`: a plane of the surface before
  /// that held it, or null. `scratch`: for what the surface before is asked.
  bool ContinueAfterChange(
    const WorkingSet& previous, const ActivePlane* held, TriangleList scratch, WorkBudget& budget);

  /// Stands where another set had its god-object, which is beyond what the patch shows.
  void StandBeyond(const WorkingSet& previous, TriangleList scratch, WorkBudget& budget);
  /// Whether a patch has not shown on which side the god-object is to be, or where that is: it does
  /// not move then, until another patch does.
  bool IsAstray() const { return this->Owed.has_value(); }

  /// Whether another place is enclosed by the surface as often as the god-object; true where
  /// nothing encloses, false where that cannot be decided. Scene frame.
  bool IsOnSameSide(const Vector& place, WorkBudget& budget);

  /// Finds the first facet met on the way to `goal`, short of which the god-object has to stop.
  /// Active facets count only where they would be crossed. False when the budget ends first, or one
  /// place has more triangles than fit: then nothing may move.
  bool FindFirstHit(
    const Vector& goal, const ActivePlanes& active, WorkBudget& budget, FacetHit& hit);

  /// Whether it is soon known that FindFirstHit() finds nothing on a motion, and that the motion is
  /// certified. Most motions are such, in free space and along planes.
  bool IsKnownClear(const Vector& target, const ActivePlanes& active)
  {
    const Vector to = this->ToSurface.PointToLocal(target);
    return !this->Geometry().IsSweeping() &&
      (this->Near.PassesThroughNothing(to) || this->KeepsOffPlanes(to, active));
  }

  /// Certifies a motion to `target`, on the way to the goal of the last FindFirstHit and no farther
  /// than its hit: true only if it touches no facet from the side that can be touched. Exact.
  bool IsClear(const Vector& target);

  /// Certifies a motion to anywhere around. False also where not all triangles there are known, and
  /// in a sweep. `inTheWay`: set to the plane of a facet that is, if one is known.
  bool IsClearNear(const Vector& target, ActivePlane& inTheWay);

  /// How many triangles a certificate looks at.
  std::int32_t GatheredTriangles() const { return this->Facets().Size(); }

  /// Calls visit(plane, hasRim) for the gathered facets within so many of their clearances of the
  /// god-object; of the plane, only Facet and Normal are set. `hasRim`: whether an edge of the
  /// facet is no other's.
  template <class Visitor>
  void VisitNear(double clearances, const Visitor& visit)
  {
    this->Near.RequirePosition();
    const FacetTable& facets = this->Facets();
    for (std::int32_t i = 0; i < facets.Size(); ++i)
    {
      const double reach = clearances * facets.Clearance(i);
      if (std::abs(facets.Distance(i)) <= reach && facets.MeetsBox(i, facets.Position(), reach))
      {
        ActivePlane plane;
        plane.Facet = { this->Index, facets.Triangle(i) };
        plane.Normal = this->ToSurface.VectorToScene(facets.Normal(i));
        visit(plane);
      }
    }
  }

  /// What there is of edges that no other facet shares within so many clearances of the god-object.
  using Rims = FacetTable::Rims;
  Rims FindRimsNear(double clearances) const { return this->Facets().FindRims(clearances); }

  /// Moves to the target of the last IsClear, which must have been true.
  void Move();
  /// Moves to a place (scene frame), in a sweep together with the surface, where another has
  /// certified the motion.
  void MoveTo(const Vector& place);

  ///@{
  /// A surface that deforms. Between two ticks the fraction of its time goes on to what it is after
  /// `dt` [s]; of that way any part, 0 to 1, is swept with the next motion.
  double Fraction() const { return this->Geometry().Fraction(); }
  /// After the next motion.
  double NextFraction() const { return this->Geometry().NextFraction(); }
  bool IsSweeping() const { return this->Geometry().IsSweeping(); }
  void BeginTick(double dt) { this->Geometry().BeginTick(dt); }
  void SweepTo(double part);
  void SweepNothing() { this->Geometry().SweepNothing(); }
  /// Parts are of what is left of the tick from here on.
  void BeginRest() { this->Geometry().BeginRest(); }
  /// Goes to the end of the tick, whatever it passes; a solid that has gone over the god-object has
  /// it on the nearest place outside.
  void SkipTick(WorkBudget& budget);
  ///@}

  /// The plane as its facet will be after the next motion.
  void Renew(ActivePlane& plane) const;
  /// The local point that stays over the same place of the plane's facet, and as high, in the next
  /// motion.
  Vector PointAfterSweep(const ActivePlane& plane) const;

  /// Whether the god-object stands over the facet itself, not only over its plane: `planes` are
  /// those that hold it.
  /// `isInside` is set to whether it is not near an edge of the facet.
  bool Covers(const ActivePlane& plane, const Vector& position, const ActivePlanes& planes,
    bool& isInside) const;
  /// The unit normal (scene frame) of the facet behind the edge over which a way leaves a plane's
  /// facet, and the fraction of the way at which it does. False where there is none, or none that
  /// is known.
  bool FindNextNormal(const ActivePlane& plane, const Vector& from, const Vector& to,
    Vector& normal, double& fraction) const;
  /// Whether the god-object stands beyond the facet, which reaches there over a gap, and what comes
  /// along `other` passes over the facet.
  bool IsPassedOver(
    const ActivePlane& plane, const Vector& position, const ActivePlane& other) const;

  /// Whether the facet of a plane is, for certain, in the straight way to `goal`; of one as thin as
  /// a line, if it `isNew`, to within rounding.
  bool StandsInWay(const ActivePlane& plane, const Vector& goal, bool isNew) const;
  /// Whether the facet that was touched last, by whatever motion, is in the straight way to `goal`:
  /// exact, but false where that is not soon known.
  bool TouchesAgain(const Vector& goal) const;
  /// Whether the straight way to `goal` meets no facet from a side that can be touched: exact, but
  /// false where the budget ends first or the way is not known well enough. Adds to `gap` what is
  /// near the way. Afterwards IsClear() can be asked about `goal`.
  bool IsOpen(const Vector& goal, WorkBudget& budget, NarrowGap& gap);

  /// The facet that lies along a plane with this normal (scene frame), below the god-object: wholly
  /// up to the distance `near`, from `far` on no longer, by a smooth step between. None where it
  /// cannot be decided. Between motions.
  FacetAlong FindAlong(const Vector& normal, double near, double far, WorkBudget& budget);

  /// How much each corner of a triangle counts where the god-object stands over it: >= 0, sum 1.
  std::array<double, 3> CornerWeights(std::int32_t triangle) const
  {
    return this->Geometry().CornerWeights(triangle, this->LocalPosition());
  }
  /// How the weights of its second and third corner rise over the triangle, scene frame.
  std::array<Vec3, 2> WeightGradients(std::int32_t triangle) const;

private:
  DeformingSurface& Geometry() { return this->Near.Facets().Surface(); }
  const DeformingSurface& Geometry() const { return this->Near.Facets().Surface(); }
  const FacetTable& Facets() const { return this->Near.Facets(); }
  SideKeeper Sides(WorkBudget& budget);
  SideKeeper::Past PastOf(
    const WorkingSet& previous, const ActivePlane* held, TriangleList scratch) const;
  bool KeepsOffPlanes(const Vector& to, const ActivePlanes& active);
  void Scan(const Vector& to, const ActivePlanes& active, FacetHit& hit);
  std::int32_t FindTouched(const Vector& to);
  bool FindSwept(const Vector& to, WorkBudget& budget, FacetHit& hit);
  bool Sweeps(std::int32_t triangle, const Vector& to, FacetHit& hit) const;
  bool Covers(const FacetId& facet, const Vector& normal, double clearance, double wayError,
    const Vector& x, const ActivePlanes& planes) const;
  Coverage CoverageAt(const ActivePlane& plane, const Vector& position, Vector& nearest) const;
  void LearnInside(std::int32_t triangle, const Vector& normal, double clearance) const;

  std::int32_t Index;
  SurfaceFrame ToSurface;
  Neighbourhood Near;
  bool IsSweepClear = false;   ///< to the target
  mutable InsideOfFacet Known; ///< of the last facet that was asked of often
  /// Of a patch: how often the god-object is to be enclosed, and is not, or is not known to be.
  std::optional<Enclosed> Owed;
};
}

#endif
