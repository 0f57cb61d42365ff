#ifndef Haptics_BallSet_h
#define Haptics_BallSet_h

#include "haptics/Contact/BallFacet.h"
#include "haptics/Contact/SeparatingPlanes.h"
#include "haptics/Contact/WorkingSet.h"

#include <cstdint>
#include <vector>

namespace haptics
{
/// @brief The triangles of one surface around a ball, and where a motion of the ball first touches.
///
/// What a ball of radius r must keep out of for one triangle, the Minkowski sum of both, is convex,
/// and so is the distance from the triangle along a straight motion. All that is decided here is
/// decided by planes that separate the ball's centre from a triangle: normal to (centre - nearest
/// point), at the least height over the triangle's three corners, whatever the nearest point's own
/// error is. Newton's method along the motion,
///
///     t += (distance - r) / approach
///
/// goes from plane to plane, never beyond the first contact, and ends there, or at a plane that the
/// rest of the motion stays in front of. A plane from anywhere on the motion is as good: that from
/// where an edge is nearest is asked first, and the facet's own begins. So the cast is its own
/// certificate, with an error of some roundings of a coordinate, far below the height that is kept.
///
/// **From outside.** A triangle that has only a front is touched where the centre is in front of
/// it; at an edge or a corner that it shares, where the centre is outside of all the triangles
/// there: none of them is nearer, and the direction agrees with their normals' sum, for a corner
/// weighted by their angles (Baerentzen and Aanaes, "Signed distance computation using the angle
/// weighted pseudonormal", 2005). So a ball that leaves a solid is held by none of its edges. What
/// it passes from behind it overlaps: the motion is cut there, and the ball has to be fitted anew.
///
/// Where the surface is, and the ball's centre in its frame, is what its WorkingSet says. No
/// allocation after construction.
class BallSet
{
public:
  /// Most that one gathering holds; a place with more holds the ball (UpdateStatus::Overloaded).
  static constexpr std::int32_t LargestNumberOfTriangles = 1 << 13;

  /// `index` names the surface in FacetIds.
  BallSet(const TriangleSurface& surface, std::int32_t index);

  /// Forgets what it has learned of the surface.
  void Restart();

  /// Finds the first facet that a ball touches on the way to `goal` (scene frame), a height short
  /// of it. Where the surface deforms meanwhile, any that may be touched. False when the budget
  /// ends first, or one place has more triangles than fit: then nothing may move. `inParts`: one
  /// that goes on from waypoints pays only for the facets up to where the ball is stopped.
  bool FindFirstHit(const WorkingSet& set, const Vector& goal, double radius, bool inParts,
    WorkBudget& budget, FacetHit& hit);

  /// The radius, at most `radius`, of the largest ball about the centre that no facet is in.
  double LargestFit(const WorkingSet& set, double radius, WorkBudget& budget);

  /// Calls add(plane) for all facets that the ball would overlap with this radius.
  template <class Visitor>
  void VisitOverlaps(const WorkingSet& set, double radius, WorkBudget& budget, const Visitor& visit)
  {
    const Vector& x = set.LocalPosition();
    const double height = this->HeightOver(set, radius);
    if (!this->Require(set, radius + height, budget))
    {
      return;
    }
    this->Planes.VisitWithin([radius] { return radius; },
      [&](std::int32_t i)
      {
        const Separation plane = this->SeparatedFrom(this->Triangles[i], x).Plane;
        if (plane.Distance < radius && this->IsTouched(i, plane, x, height))
        {
          visit(this->PlaneOf(this->Triangles[i], set, plane, x, radius, height));
        }
      });
  }

  /// Whether the ball has to be fitted anew where the last cast may take it: it passes a facet from
  /// its back, which it overlaps then, or its centre is stopped by the front of one.
  bool HasComeThrough() const { return this->IsThrough; }

  /// Puts a plane where it separates the ball, as its set has it now, from the plane's facet (as
  /// that will be after the next motion).
  void Renew(const WorkingSet& set, double radius, ActivePlane& plane);

  /// The plane that will separate the ball from the same facet when it has come as near as that
  /// lets it to `goal` (scene frame), around an edge or a corner. False where that facet lets it
  /// be there, or the goal is behind it or close to it.
  bool FindLast(const WorkingSet& set, const Vector& goal, double radius, const FacetId& facet,
    ActivePlane& last);

  /// The local point that a ball is taken to by the place of the plane's facet that it touches.
  Vector PointAfterSweep(const WorkingSet& set, double radius, const ActivePlane& plane) const;

  /// How far off the surface a ball is kept: 1024 roundings of a coordinate.
  double HeightOver(const WorkingSet& set, double radius) const;

private:
  struct Motion;
  /// What is known of a facet, for as long as no other takes its place.
  struct KnownFacet
  {
    std::int32_t Triangle = -1;
    std::int32_t Shape = 0; ///< of the surface, as Shape
    BallFacet Facet;
    bool IsSeparated = false;
    Vector From{ 0 }; ///< where it was separated from
    Separation Plane;

    bool IsSeparatedFrom(const Vector& x) const { return this->IsSeparated && this->From == x; }
    void SeparateFrom(const Vector& x, bool isOneSided)
    {
      this->Facet.Separate(isOneSided, x, this->Plane);
      this->From = x;
      this->IsSeparated = true;
    }
  };
  static constexpr std::uint32_t NumberOfKnownFacets = 256;

  void SetFacet(std::int32_t triangle, double fraction, BallFacet& facet) const;
  BallFacet FacetAt(std::int32_t triangle, double fraction) const;
  KnownFacet& Known(std::int32_t triangle);
  const KnownFacet& SeparatedFrom(std::int32_t triangle, const Vector& x);
  bool IsOneSided(std::int32_t triangle) const { return !this->Surface.TouchesBack(triangle); }
  double KnownPart(const Vector& from, const Vector& way, double reach) const;
  bool Gather(const WorkingSet& set, double reach, double length, double wanted,
    const Vector& ahead, WorkBudget& budget);
  bool FindAround(const Vector& centre, double radius, WorkBudget& budget, bool& isWhole);
  void Load(const WorkingSet& set);
  template <class PointOf>
  void AddPlanes(const PointOf& pointOf);
  void Remember(std::int32_t i, const KnownFacet& known);
  void Cast(const WorkingSet& set, const Motion& motion, FacetHit& hit);
  void Meet(std::int32_t i, const WorkingSet& set, const Motion& motion, FacetHit& hit);
  bool IsTouched(std::int32_t i, const Separation& plane, const Vector& x, double height);
  bool IsEdgeTouched(
    std::int32_t triangle, const Separation& plane, const Vector& x, double height);
  bool IsCornerTouched(
    std::int32_t triangle, const Separation& plane, const Vector& x, double height);
  void PassFromBehind(
    const BallFacet& facet, const Separation& start, const Motion& motion, FacetHit& hit);
  void StopInFront(std::int32_t triangle, const WorkingSet& set, const KnownFacet& known,
    const Motion& motion, double met, FacetHit& hit);
  bool FindSwept(
    const WorkingSet& set, const Vector& to, double radius, WorkBudget& budget, FacetHit& hit);
  void Follow(const WorkingSet& set);
  bool Require(const WorkingSet& set, double reach, WorkBudget& budget);
  ActivePlane PlaneOf(std::int32_t triangle, const WorkingSet& set, const Separation& plane,
    const Vector& x, double radius, double height) const;

  const TriangleSurface& Surface;
  std::int32_t Index;

  // Every triangle that meets the ball about Centre is in the list.
  bool IsGathered = false;
  Vector Centre{ 0 };
  double Radius = 0.0;
  double Margin = 0.0;    ///< to gather beyond what is asked for: serves several ticks
  std::int32_t Most = 0;  ///< where an engine that finds more is stopped
  double Fraction = 1.0;  ///< of the deformation's time, where the corners are
  std::int32_t Shape = 0; ///< changes with Fraction

  std::int32_t Count = 0;
  std::vector<std::int32_t> Triangles;
  SeparatingPlanes Planes; ///< of those in the list
  Vector Last{ 0 };        ///< where the ball's centre was when they were last asked
  bool IsThrough = false;
  std::vector<KnownFacet> KnownFacets; ///< a triangle's place is its index's last bits
};
}

#endif
