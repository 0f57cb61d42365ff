#ifndef Haptics_CarriedSurface_h
#define Haptics_CarriedSurface_h

#include "haptics/Math/Vec3.h"
#include "haptics/Scene/ActorMatrix.h"
#include "haptics/Tick/TickRecord.h"

#include <cstdint>

class vtkActor;

namespace haptics
{
class SurfaceSet;

/// @brief What the hand of a scene carries: a surface whose actor goes where the god-object goes.
///
/// The place where it was touched last before the servo let the hand into it stays in the hand. GUI
/// thread.
class CarriedSurface
{
public:
  static constexpr int Nothing = -1;
  /// The id of what is gripped, or Nothing.
  int Surface() const { return this->Id; }
  bool IsNothing() const { return this->Id == Nothing; }

  /// Grips a surface that is in the set and has an actor. `latest`: the last tick that is known.
  void Take(int surface, const TickRecord& latest, SurfaceSet& surfaces);
  /// Lets go. The surface stays where it is and is touched from the next publication on.
  void LetGo(SurfaceSet& surfaces);
  /// Whether what is gripped cannot be touched any more: taken away or hidden.
  bool IsLost(const SurfaceSet& surfaces) const;

  /// Takes the number of each god-object that is published.
  void OnPublished(std::uint64_t generation);
  /// Looks at the next tick.
  void OnTick(const TickRecord& tick, const SurfaceSet& surfaces);
  /// Moves `actor`, the one that a user sees as the surface, to where the hand has it in a tick.
  /// True where it has moved.
  bool Carry(const TickRecord& tick, vtkActor* actor, SurfaceSet& surfaces);
  /// Of the surface where it was gripped, world frame; zeros where it was not touched.
  const Vec3& Normal() const { return this->NormalThere; }

private:
  void Remember(const TickRecord& tick, const SurfaceSet& surfaces);

  int Id = Nothing;
  std::uint64_t Since = 0; ///< the first god-object that does not touch it; 0: not published yet
  bool IsHeld = false;     ///< by such a god-object
  Vec3 Point{};            ///< in the hand, in the actor's own frame
  Vec3 NormalThere{};
  std::uint64_t LastTick = 0; ///< that Point is of
};

/// Shifts an actor in the world through its position, whatever is above it: its user matrix, and in
/// an assembly the parts that it hangs on. `world`: its matrix with all of these. False, and
/// nothing changed, where that is flat, or it or the shift is not finite.
bool ShiftActor(vtkActor* actor, const Matrix4& world, const Vec3& by);
}

#endif
