#ifndef Haptics_ClosedLoop_h
#define Haptics_ClosedLoop_h

#include "ContactMethod.h"
#include "haptics/Devices/Simulated/SimulatedBody.h"

#include <functional>
#include <vector>

namespace haptics::testing
{
/// One tick of a closed loop, in the device's frame, which is the world's [s, m, N].
struct LoopTick
{
  double Time;
  Vec3 Hip;    ///< as the encoders report it
  Vec3 Held;   ///< to where the method pulls: the god-object, where it has one
  Vec3 Force;  ///< asked for
  double Work; ///< that the forces have done on the body since it was placed, without delay [J]
  double Lost; ///< to the device's own friction since then, at least [J]
};

/// @brief A servo in virtual time: a simulated device's body in a hand, and a method to touch with.
///
///     hand's target --[ spring ]-- ( body ) --- HIP ---> method --- K (held - HIP) ---> motors
///
/// The force is held from tick to tick (zero-order hold); between two ticks the body's motion is
/// solved, not stepped. The same in every run and on every machine.
class ClosedLoop
{
public:
  ClosedLoop(ContactMethod& method, const BodyParameters& body);

  /// At rest, without force.
  void Place(const Vec3& position);
  /// The hand's target from now on, as a function of the time since the last Place() [s].
  void Follow(std::function<Vec3(double)> target) { this->Target = std::move(target); }
  void Pull(const Vec3& target);

  double Stiffness = 500.0; ///< K [N/m]
  double Period = 0.001;    ///< T of the ticks to come [s]

  /// Goes on for so many ticks and appends them to Ticks.
  void Run(int ticks);
  std::vector<LoopTick> Ticks;

private:
  ContactMethod& Method;
  BodyParameters Parameters;
  SimulatedBody Body;
  std::function<Vec3(double)> Target;
  Vec3 Force{};
  double Work = 0.0;
  double Lost = 0.0;
};

/// A body pressed a millimetre into a surface by a constant force: what finds where it shakes.
struct PressedScene
{
  std::function<MethodPointer()> Make;
  Vec3 Start{};          ///< in free space, less than a millimetre from the surface [m]
  Vec3 Direction{};      ///< of the push, unit
  Vec3 Nudge{};          ///< direction in which the rest is disturbed, unit
  double Damping = 0.35; ///< b [N s/m]
  double Delay = 0.0;    ///< t_d [s]
  /// The periods of the ticks, over and over [s].
  std::vector<double> Periods = { 0.001 };
  /// Friction in the motion over half a period and the delay. The formulas are for 0, and err by
  /// about a sixth of it.
  double Share = 0.05;

  /// b / (E[T^2] / (2 E[T]) + t_d): 2b/T where the periods are alike and nothing is late.
  double Formula() const;
};

/// The largest stiffness at which the body comes to rest, as a multiple of the formula's; by
/// bisection between 0.1 and 1.5 to half a percent. 0 or 1.5 where it is not between.
double MeasuredBoundary(const PressedScene& scene);
}

#endif
