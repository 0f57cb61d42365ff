#ifndef Haptics_GodObjectImplementation_h
#define Haptics_GodObjectImplementation_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Contact/WorkingSet.h"
#include "haptics/Material/Friction.h"
#include "haptics/Material/MaterialBlend.h"

namespace haptics
{
/// A pass meets at most a few facets; more come of rounding.
constexpr int LargestNumberOfCasts = 12;
/// Triangles looked up in one update, all passes and surfaces together: a few dozen in practice,
/// and a few milliseconds at the most.
constexpr std::int64_t LargestNumberOfTriangles = 1 << 17;

/// How often an update looks whether what holds is there; once where it is.
constexpr int LargestNumberOfReleases = 4;

/// Each cast makes at most one motion, so does each release, and one more goes to what is in plain
/// view.
constexpr int LargestWayOfPiece =
  GodObject::LargestNumberOfPasses * LargestNumberOfCasts + LargestNumberOfReleases + 2;
/// Where half of it has been used the rest is one piece.
constexpr int LargestWay = 2 * LargestWayOfPiece;

/// What a god-object does: GodObject.cxx moves it to the HIP, GodObjectMotion.cxx with surfaces
/// that move, GodObjectRelease.cxx lets go of planes that hold where no facet is,
/// GodObjectMaterial.cxx tells what they feel like and lets friction hold it.
class GodObject::Implementation
{
public:
  explicit Implementation(std::vector<TouchedSurface> surfaces);

  void Place(const Vector& position);
  bool Continue(const Implementation& previous);
  void Advance(double dt, double haste);
  bool HasArrived() const;
  void Update(const Vector& hip);
  void ListConstraints();
  void UpdateMaterial();
  void StayInContact(const Implementation& previous);
  void Land(const Implementation& previous);
  void Settle(const Implementation& previous);
  bool IsOnSameSide(const Vector& other);
  bool FeelsAs(const Implementation& previous) const;

  std::vector<TouchedSurface> Surfaces;
  std::vector<WorkingSet> Sets; ///< one a surface
  std::size_t Felt = 0;         ///< how many surfaces are; those that are gripped come after them
  Vector Origin{ 0 };           ///< of the scene frame, in the world
  Vector Position{ 0 };         ///< scene frame
  int PassesAllowed = LargestNumberOfPasses;
  int PiecesAllowed = 1;
  Vector HipBefore{ 0 }; ///< where the HIP's way to the next update begins
  bool IsPlaced = false;
  bool IsOverloaded = false;
  /// Surfaces close in on the god-object and leave no place that all of them allow: each keeps a
  /// god-object of its own until they do.
  bool IsSplit = false;
  bool HasProperties = false; ///< of any surface
  Vector Carried{ 0 };        ///< by surfaces that moved or changed, since the last update
  ActivePlanes Active;
  Contact Result;
  std::array<Vec3, LargestWay> Way;
  int WaySize = 0;

private:
  /// A surface that can move, and the pose that its set has.
  struct Mover
  {
    std::int32_t Surface = -1;
    SurfaceMotion* Motion = nullptr;
    Vector Pivot{ 0 };
    RigidPose Pose;
    std::uint64_t Jumps = 0;
    SurfaceFrame Before; ///< while a step is tried
  };

  void WalkWithFriction(const Vector& hip);
  Vector AimWithFriction(const Vector& hip);
  void AddMaterials(const ActivePlane& plane, double push, MaterialBlend& blend);
  void AddMaterial(
    const FacetId& facet, double push, const Vector& normal, MaterialBlend& blend) const;
  void Approach(const Vector& hip);
  void Follow(const Vector& from, const Vector& hip);
  bool ChangesOnWay(const Vector& goal, const Vector& hip, const FacetHit& hit) const;
  bool Walk(const Vector& goal);
  bool Pass(const Vector& hip);
  bool Release(const Vector& goal);
  bool MayBeReleased(const Vector& pull);
  bool IsNoGap(const Vector& to);
  bool MoveTowards(const Vector& target);
  bool IsSupported();
  void KeepSupports(bool keepsFar);
  bool IsOver(const ActivePlane& plane, bool& isInside) const;
  void LookAhead(const Vector& hip, const std::array<FacetId, 3>& before);

  SurfaceFrame FrameOf(std::int32_t surface, const RigidPose& pose) const;
  void TakePose(Mover& mover);
  const WorkingSet* FindPredecessor(
    std::int32_t surface, const Implementation& previous, bool& isSame) const;
  bool IsGripped(std::int32_t surface) const
  {
    return static_cast<std::size_t>(surface) >= this->Felt;
  }
  void TakeFromHand(const Implementation& previous);
  bool MoveSurfaces(double dt, double haste);
  bool Step(double part);
  void StepApart();
  bool MoveAll(const Vector& wish, ActivePlanes& planes);
  bool FindFirstHit(const Vector& goal, const ActivePlanes& planes, FacetHit& hit);
  bool IsClear(const Vector& to);
  void MoveSets();
  bool Join(const Vector& hip);

  std::vector<SurfaceMotion*> Motions; ///< each once
  std::vector<Mover> Movers;
  std::vector<std::int32_t> Deforming; ///< surfaces
  WorkBudget Budget;
  double SharingUnit = 0.0;          ///< largest clearance of those that are felt
  std::vector<FacetAlong> Along;     ///< of each that is felt, where a plane holds
  std::vector<std::int32_t> Scratch; ///< for questions to another god-object's surfaces
  int PassesLeft = 0;                ///< of this piece of an update
  int PieceStart = 0;                ///< the corner of the way where it began
  bool LooksForChange = false;       ///< the next cast is to tell whether the piece is to be cut
  bool IsChangeFound = false;        ///< it is: nothing has moved
  std::vector<Vector> LocalStarts;   ///< of the sets, before the first piece
  int ReleasesLeft = 0;
  Vector LastHip{ 0 };
  double GoalMoved = HUGE_VAL; ///< since the update before
  /// Of a release: who asked.
  struct Refusal
  {
    Vector Position{ 0 };
    Vector Pull{ 0 };
    std::array<FacetId, 3> Facets;
    int Rounds = 0; ///< of tries while the goal was at rest
  };
  Refusal Refused;
  Friction Cone;
  /// The surfaces that count: all, but for a god-object that is split.
  std::size_t First = 0;
  std::size_t Last = 0;
};
}

#endif
