#ifndef Haptics_SurfaceMotion_h
#define Haptics_SurfaceMotion_h

#include "haptics/Math/Mailbox.h"
#include "haptics/Math/RigidPose.h"
#include "vtkHapticsCoreModule.h"

#include <cmath>
#include <cstdint>

namespace haptics
{
/// @brief How a surface moves as a rigid body: set now and then, interpolated at the servo's rate.
///
///     GUI thread   --MoveTo, JumpTo-->   [ newest ]   --Advance-->   servo thread
///                  <--Read-------------  [ pose   ]   <------------
///
/// A motion goes from where the surface is to the target in a straight line, turning evenly (slerp)
/// about the pivot. With `duration` the interval between two updates, the surface is **one update
/// behind** its source and never stands still between two updates that come in time; where one
/// comes late it waits at the last target, where one comes early it goes on from where it is.
///
/// Wait-free on both sides. Several god-objects may touch surfaces of one motion, in one servo
/// thread.
class VTKHAPTICSCORE_EXPORT SurfaceMotion
{
public:
  /// Starts at `pose`, which has to be finite and whose rotation is normalised; see IsValid().
  /// `pivot`: what moves on a straight line, in the surface's frame; sensibly its middle, a
  /// snapshot's Origin(). `radius`: how far the surface reaches from there, so that turning counts
  /// as speed [world unit].
  explicit SurfaceMotion(const RigidPose& pose, const Vec3& pivot = {}, double radius = 0.0);

  /// Whether a pose is finite, with a rotation that is not zero. Any thread.
  static bool IsValid(const RigidPose& pose) noexcept;

  ///@{
  /// GUI thread.
  /// Moves to `target` over `duration` [s], finite and >= 0; 0: within the next tick. What is in
  /// the way is pushed, at any speed. False, with nothing changed, where the pose or the duration
  /// is not valid.
  bool MoveTo(const RigidPose& target, double duration);
  /// Is at `target` with the next tick, as if it had been taken away and put there: nothing is
  /// pushed. False, with nothing changed, where the pose is not valid.
  bool JumpTo(const RigidPose& target);
  /// Limits the speed of the next motions [world unit / s]; > 0, default HUGE_VAL. A motion that is
  /// faster takes longer. 5 m/s in the device's frame is what a hand can follow.
  bool SetLargestSpeed(double speed);

  /// The motion as the servo has it.
  struct State
  {
    RigidPose Pose;
    bool IsMoving = false;
    bool IsSlowed = false; ///< the last motion was faster than the largest speed
  };
  /// The latest state that is whole; a tick old at the most.
  const State& Read();
  ///@}

  ///@{
  /// Servo thread.
  /// Goes on by `dt` [s] and returns the pose. What is not a positive time is none.
  const RigidPose& Advance(double dt) noexcept;
  const RigidPose& Pose() const noexcept { return this->Now; }
  /// Counts the jumps.
  std::uint64_t Jumps() const noexcept { return this->NumberOfJumps; }
  ///@}

private:
  void Take() noexcept;
  double Length(const RigidPose& target) const noexcept;
  void Publish() noexcept;

  static constexpr std::size_t PoseSize = 7;
  using PoseNumbers = std::array<double, PoseSize>;
  /// The last jump's target and their number, the target, its duration, the largest speed.
  using Order = Mailbox<2 * PoseSize + 3>;
  /// The pose, whether it moves, whether it was slowed.
  using Report = Mailbox<PoseSize + 2>;

  const Vec3 Pivot;
  const double Radius;
  Order Orders;
  Report Reports;

  // The GUI thread's.
  Order::Numbers Ordered{};
  double LargestSpeed = HUGE_VAL;
  std::uint64_t SeenReport = 0;
  State LastState;

  // The servo thread's.
  std::uint64_t SeenOrder = 0;
  RigidPose Now, Start, Target;
  double Duration = 0.0;
  double Elapsed = 0.0;
  bool IsSlowed = false;
  std::uint64_t NumberOfJumps = 0;
};
}

#endif
