#ifndef Haptics_MovingSurfaces_h
#define Haptics_MovingSurfaces_h

#include "haptics/Contact/HipApproach.h"

#include <vector>

namespace haptics
{
/// @brief The surfaces that move or deform, and how they take the god-object along.
///
/// What has to be certain for all surfaces at once is here, too: that the god-objects that each has
/// in its own frame come to one place (MoveAll()), and what becomes of them where there is none.
class MovingSurfaces
{
public:
  MovingSurfaces(GodObjectState& god, PlaneRelease& planes, HipApproach& walker);

  /// Takes all motions on by `dt` [s], and the god-object with them; what deforms, faster by
  /// `haste`.
  void Advance(double dt, double haste);
  bool HasArrived() const;

  /// Takes the poses that the motions have now.
  void TakePoses();
  /// The poses of another god-object's sets, with the same surfaces.
  void TakeOver(const MovingSurfaces& previous);
  void TakeFromHand(const Surroundings& previous);

  bool MoveAll(const Vector& wish, ActivePlanes& planes);
  bool Join(const Vector& hip);

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

  void TakePose(Mover& mover);
  bool MoveSurfaces(double dt, double haste);
  bool Step(double part);
  void StepApart();

  GodObjectState& God;
  PlaneRelease& Planes;
  HipApproach& Walker;
  std::vector<SurfaceMotion*> Motions; ///< each once
  std::vector<Mover> Movers;
  std::vector<std::int32_t> Deforming; ///< surfaces
};
}

#endif
