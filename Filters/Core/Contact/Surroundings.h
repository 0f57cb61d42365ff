#ifndef Haptics_Surroundings_h
#define Haptics_Surroundings_h

#include "haptics/Contact/BallSet.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Contact/WorkingSet.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace haptics
{
/// @brief The surfaces that a god-object is among, each with what is near it, as its tip meets
/// them.
///
/// A question is put to each surface in turn, and the answer is that of all of them: the first
/// facet in the way, whether a motion is clear, what is known of a patch. A point asks the
/// WorkingSets; a ball asks the BallSets too, with the radius that is in effect. All positions are
/// in the scene frame; where the god-object is, each WorkingSet keeps in the frame of its surface.
class Surroundings
{
public:
  /// Triangles looked up in one update, all passes and surfaces together: a few dozen in practice,
  /// and a few milliseconds at the most.
  static constexpr std::int64_t LargestNumberOfTriangles = 1 << 17;
  /// What a ball may be short of its size without being shrunk for it: of the radius.
  static constexpr double Tolerance = 1e-6;

  Surroundings(std::vector<TouchedSurface> surfaces, Tip tip);

  bool IsBall() const { return this->TipRadius > 0.0; }
  /// The radius that a tip of this size has, up to a limit that the surfaces set; 0: a point.
  double UsableRadius(double radius) const;
  bool IsGripped(std::int32_t surface) const
  {
    return static_cast<std::size_t>(surface) >= this->TouchableCount;
  }
  SurfaceFrame FrameOf(std::int32_t surface, const RigidPose& pose) const;

  /// Forgets what has been used of the triangles that may be looked up.
  void RenewBudget() { this->Budget.Triangles = LargestNumberOfTriangles; }

  ///@{
  /// Of patches: how much of the way to a HIP, and whether a place, is known to all surfaces.
  double KnownPart(const Vector& hip) const;
  bool IsKnown(const Vector& place) const;
  /// Of a god-object that is split: a place where one surface has its own, but not known to all;
  /// there may be room. None where surfaces close in.
  std::optional<Vector> UnknownPlace() const;
  /// Whether one of them has lost its side: WorkingSet::IsAstray().
  bool IsAstray() const
  {
    return std::any_of(
      this->Sets.begin(), this->Sets.end(), [](const WorkingSet& set) { return set.IsAstray(); });
  }
  ///@}
  /// Whether one surface alone counts, which neither moves nor deforms.
  bool IsOneAtRest() const
  {
    return this->Last - this->First == 1 && !this->Surfaces[this->First].Motion &&
      !this->Sets[this->First].Surface().Deforms();
  }
  bool IsOnSameSide(const Vector& other);

  /// The first facet that any surface has in the way. False: more to look at than a tick may.
  bool FindFirstHit(const Vector& goal, const ActivePlanes& planes, FacetHit& hit)
  {
    if (this->IsBall())
    {
      return this->FindFirstTouch(goal, hit);
    }
    for (std::size_t i = this->First; i < this->Last; ++i)
    {
      if (i == this->First)
      {
        if (!this->Sets[i].FindFirstHit(goal, planes, this->Budget, hit))
        {
          return false;
        }
        continue;
      }
      FacetHit other;
      if (!this->Sets[i].FindFirstHit(goal, planes, this->Budget, other))
      {
        return false;
      }
      hit.Take(other);
    }
    return true;
  }
  /// `inParts`: as BallSet::FindFirstHit.
  bool FindFirstTouch(const Vector& goal, FacetHit& hit, bool inParts = false)
  {
    for (std::size_t i = this->First; i < this->Last; ++i)
    {
      FacetHit other;
      if (!this->Balls[i].FindFirstHit(
            this->Sets[i], goal, this->BallRadius, inParts, this->Budget, other))
      {
        return false;
      }
      hit.Take(other);
    }
    return true;
  }
  /// Whether all surfaces certify the motion on the way of the last FindFirstHit().
  bool IsClear(const Vector& to)
  {
    if (this->HasPatches && !this->IsKnown(to))
    {
      return false;
    }
    if (this->IsBall())
    {
      return true; // the cast of a ball is its certificate
    }
    for (std::size_t i = this->First; i < this->Last; ++i)
    {
      if (!this->Sets[i].IsClear(to))
      {
        return false;
      }
    }
    return true;
  }
  /// Whether it is soon known that the god-object meets nothing on its way there, and so neither a
  /// cast nor a certificate is needed. It is the target then.
  bool IsKnownClear(const Vector& to, const ActivePlanes& planes)
  {
    bool isClear = !this->HasPatches;
    for (std::size_t i = this->First; i < this->Last && isClear; ++i)
    {
      isClear = this->Sets[i].IsKnownClear(to, planes);
    }
    return isClear;
  }
  /// To the target of the last IsClear().
  void MoveSets()
  {
    for (std::size_t i = this->First; i < this->Last; ++i)
    {
      this->Sets[i].Move();
    }
  }
  /// To a place on the way of a ball's last cast.
  void MoveSetsTo(const Vector& place);

  ///@{
  /// Which surfaces count: one, where each has a god-object of its own, or all.
  void CountOne(std::size_t surface)
  {
    this->First = surface;
    this->Last = surface + 1;
  }
  void CountAll()
  {
    this->First = 0;
    this->Last = this->TouchableCount;
  }
  ///@}

  void FitBall();
  bool HasComeThrough() const;
  /// Puts a plane where its facet is after the next motion.
  void RenewPlane(ActivePlane& plane)
  {
    const auto i = static_cast<std::size_t>(plane.Facet.Surface);
    if (this->IsBall())
    {
      this->Balls[i].Renew(this->Sets[i], this->BallRadius, plane);
      return;
    }
    this->Sets[i].Renew(plane);
  }
  /// The same for all of them.
  void RenewPlanes(ActivePlanes& planes)
  {
    planes.Renew([this](ActivePlane& plane) { this->RenewPlane(plane); });
  }
  void StandAt(const Vector& place);
  Vector LocalTouch(const Constraint& constraint) const;

  std::vector<TouchedSurface> Surfaces;
  std::vector<WorkingSet> Sets;   ///< one a surface
  std::vector<BallSet> Balls;     ///< the same for a ball; none for a point
  std::size_t TouchableCount = 0; ///< of the surfaces; those that are gripped come after them
  Vector Origin{ 0 };             ///< of the scene frame, in the world
  double TipRadius = 0.0;         ///< of a ball [world unit]; 0: a point
  double BallRadius = 0.0;        ///< in effect: less while the ball overlaps
  bool IsFit = false;             ///< the ball overlaps nothing
  bool HasProperties = false;     ///< any surface
  bool HasPatches = false;        ///< among the touchable surfaces
  double SharingUnit = 0.0;       ///< largest clearance of the touchable ones
  WorkBudget Budget;
  /// The surfaces that count: all, but for a god-object that is split.
  std::size_t First = 0;
  std::size_t Last = 0;
};
}

#endif
