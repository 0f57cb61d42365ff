#ifndef Haptics_SimulatedBody_h
#define Haptics_SimulatedBody_h

#include "haptics/Devices/Simulated/SimulatedPath.h"
#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace haptics
{
/// What a simulated device's mechanics and the hand on it are. All finite and >= 0, the mass > 0.
struct BodyParameters
{
  double Mass = 0.045;            ///< at the tip, the same in all directions [kg]
  double Damping = 0.35;          ///< viscous friction b [N s/m]
  double CoulombFriction = 0.0;   ///< on each axis [N]
  double EncoderResolution = 0.0; ///< step of the measured position [m]; 0: none
  double MaximumForce = 3.3;      ///< of the motors [N]
  double Delay = 0.0;             ///< from a force that is asked for to the one that acts [s]
  double Jitter = 0.0;            ///< at most so much more, evenly spread [s]
  double HandStiffness = 100.0;   ///< of the hand that pulls the tip to its target [N/m]
  double HandDamping = 2.0;       ///< of the hand, against the target's motion [N s/m]
};

/// @brief A device's tip in a hand: mass, friction, motors behind a hold, encoders. Deterministic.
///
///     target --[ hand: spring + damper ]-- ( mass ) --[ b, Coulomb ]-- ground
///                                              ^
///                         motors: force held since it was asked for, after delay and jitter
///
/// The motion between two ticks is solved, not stepped: the linear parts by the exponential of
/// their matrix, with the force held and the target going straight; the times at which an axis
/// comes to rest, sticks by Coulomb friction and breaks away again are found to rounding. (An axis
/// that turns round twice within one tick is seen as not turning.) The Coulomb friction acts on
/// each axis apart, as the joints of a Cartesian device would.
///
/// Any thread, one at a time. Only the constructor allocates.
class VTKHAPTICSDEVICES_EXPORT SimulatedBody
{
public:
  explicit SimulatedBody(const BodyParameters& parameters);

  /// At rest at a position [m] at a time [s], without force; jitter starts anew.
  void Place(double time, const DevicePoint& position) noexcept;
  /// Moves on to a time [s] not before the last, the hand's target going straight to `target` [m].
  void Advance(double time, const DevicePoint& target) noexcept;
  /// The servo asks for a force [N] at the time of the last Advance() or Place(). One longer than
  /// the motors can give is shortened.
  void Ask(const std::array<double, 3>& force) noexcept;

  double GetTime() const noexcept { return this->Time; }
  DevicePoint GetPosition() const noexcept;           ///< true [m]
  std::array<double, 3> GetVelocity() const noexcept; ///< true [m/s]
  DevicePoint GetMeasuredPosition() const noexcept;   ///< as the encoders report it [m]

private:
  // Transition of (offset from the target, its rate, acceleration by constant forces) over a time.
  using Matrix = std::array<std::array<double, 3>, 3>;
  struct Axis
  {
    double Position = 0.0;
    double Velocity = 0.0;
  };
  struct Input
  {
    double Force;       // [N]
    double Target;      // at the start of the interval [m]
    double TargetSpeed; // [m/s]
  };
  struct PendingForce
  {
    double Time;
    std::array<double, 3> Force;
  };

  Matrix Transition(double duration) const noexcept;
  const Matrix& CachedTransition(double duration) noexcept;
  void Hold(double until, const DevicePoint& start, double startTime,
    const std::array<double, 3>& targetSpeed) noexcept;
  void AdvanceAxis(Axis& axis, const Input& input, double duration) noexcept;
  Axis Move(const Axis& axis, const Input& input, const Matrix& transition, double direction,
    double duration) const noexcept;
  double TimeOfRest(
    const Axis& axis, const Input& input, double direction, double duration) const noexcept;
  double Random() noexcept;

  BodyParameters Parameters;
  double Time = 0.0;
  DevicePoint Target{};
  std::array<Axis, 3> Axes{};
  std::array<double, 3> Force{};     // acting now [N]
  std::vector<PendingForce> Pending; // a ring, in order of time
  std::size_t FirstPending = 0;
  std::size_t NumberPending = 0;
  Matrix Cached{};
  double CachedDuration = -1.0;
  std::uint64_t Seed = 1;
};
}

#endif
