#ifndef Haptics_SurfaceForce_h
#define Haptics_SurfaceForce_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Math/Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <limits>

namespace haptics
{
/// What device and servo allow.
struct MaterialLimits
{
  double Stiffness = std::numeric_limits<double>::infinity();    ///< [N/m]
  double Damping = 4.0;                                          ///< [N s/m]
  double MaximumForce = std::numeric_limits<double>::infinity(); ///< [N]
};

/// @brief From a contact to its force: a spring, and what the properties of surfaces make of it:
/// stiffness, profile, texture, shading, damping.
///
/// Where nothing has properties since the touch began it is the spring K (p - h) and nothing else.
///
///     F = gain phi(d) n  -  U(d) P grad(gain)  +  resistance  +  shading  +  damping
///
/// with the depth d = |p - h|, n = (p - h) / d, phi the depth or a profile, U its integral over the
/// depth, P the projection on the directions in which the planes in contact let the god-object go.
///
/// **What varies over a surface acts while sliding.** The first two terms are the slope of one
/// potential, gain(p) U(d) (for a linear spring K(p) d^2 / 2): from soft to hard a hand does work
/// against the second one, from hard to soft it gets it back. It takes SlopeMargin more than it
/// gives, for what happens within a tick. It acts on what has a gradient (values at points,
/// images), is never more than the first one, and is left out where there is friction, which takes
/// what it needs.
///
/// **No energy is made.** Every other rise of the gain (cells with values of their own, planes that
/// share the push, a rough or exchanged surface) is paid out of a tank. It is filled by what is
/// lost for the hand: a gain that falls under a spring that is pressed, friction, damping, and the
/// resistance, by which the hand pays what is missing over the next JumpWidth of its way, with at
/// most as much as the spring pushes. So a jump of the stiffness is spread over about that width,
/// deep in a soft surface over some times that. At a new touch the gain is free.
///
/// The tank holds no more than what one contact can need: dK d^2 / 2 up to the stiffest place of
/// the surface, and with force shading, which pushes the way the hand goes only as far as the tank
/// holds, as much as is in the spring. It leaks, with a time constant of TankMemory: the force
/// does not depend on what was rubbed before. A debt of Credit of what is in the spring may stand
/// while the hand slides; it is taken off the gain as the hand lets go.
///
/// Energies are those of the force that changes evenly over a tick (trapezoids), of the hand's
/// motion against the surface, which may move; that a servo holds the force instead is what the
/// device's own damping pays for, under K <= 2b/T. What is left when the hand lets go is forgotten;
/// a debt is kept. Force that the largest force cuts off fills no tank.
///
/// **An exchange that softens** under the hand (another array, a constant in its place) lowers the
/// gain evenly over some time, and not within a tick: see NoticeExchange(). On its way down the
/// gain fills the tank as ever.
///
/// **Damping** uses the velocity of the HIP against the surface, from the second tick of a contact
/// on, through a filter of first order with a time constant of 5 ms: that is its delay, for all
/// slow motions. It is at most MaterialLimits::Damping, and never pulls towards the surface. What
/// it costs of the stable stiffness is |B| (Colgate and Schenkel: b > KT/2 + |B|), which
/// MaterialLimits::Stiffness has to account for.
///
/// Servo thread; no allocation, no lock.
class VTKHAPTICSCORE_EXPORT SurfaceForce
{
public:
  static constexpr double JumpWidth = 0.002;  ///< [m] of the hand's way
  static constexpr double TankMemory = 0.1;   ///< [s]
  static constexpr double SlopeMargin = 0.02; ///< of the lateral force
  static constexpr double Credit = 0.03;      ///< of what the spring holds

  /// Forgets everything.
  void Restart() noexcept { *this = SurfaceForce(); }
  /// Materials have been exchanged: where the gain of the next Update() falls by that, it falls
  /// over `time` [s], where a late tick counts for `longest` [s] at most. What falls by less than
  /// `smallest` [N] is the hand's own way, and follows at once.
  void NoticeExchange(double time, double longest, double smallest) noexcept
  {
    this->FallTime = time;
    this->LongestFall = longest;
    this->SmallestFall = smallest;
  }
  /// The force [N], not longer than the largest one. `contact`: device frame; `period` since the
  /// last tick [s]; `plainStiffness` [N/m] is that of surfaces which have none of their own. Zero
  /// in free space, and where the displacement is not finite.
  Vec3 Update(const Contact& contact, double period, double plainStiffness,
    const MaterialLimits& limits) noexcept;

  /// Of the last force: the gain [N/m], or with a profile its steepest slope [N/m]; the plain
  /// stiffness in free space.
  double GetStiffness() const noexcept { return this->Stiffness; }
  /// Whether the last force had less stiffness than the surface, because of the limits.
  bool IsLimited() const noexcept { return this->Limited; }
  /// Whether it was cut off at the largest force.
  bool IsClamped() const noexcept { return this->Clamped; }
  /// Whether it had less because of the tank.
  bool IsHeldBack() const noexcept { return this->HeldBack; }
  /// What the tank holds [J]; negative: a debt.
  double GetTank() const noexcept { return this->Tank; }

private:
  Vec3 PlainForce(const Contact& contact, double depth, double plainStiffness,
    const MaterialLimits& limits) noexcept;
  /// What a surface asks for, and what the energies of a tick need to know.
  struct Wish
  {
    double Gain = 0.0;    ///< within the limits
    double Largest = 0.0; ///< of the surface anywhere, within the limits
    Vec3 Gradient{};      ///< of the gain, in the directions that are free [per m]
  };
  Wish WishOf(const Contact& contact, double plainStiffness, const MaterialLimits& limits) noexcept;
  void FallSoftly(Wish& wish, double time, double limit, double depth, double period) noexcept;
  Vec3 Lateral(const Contact& contact, const Wish& wish, double depth) const noexcept;
  void SetGain(const Contact& contact, const Wish& wish, double depth, const Vec3& step,
    const Vec3& lateral, double period) noexcept;
  Vec3 Shading(const Contact& contact, const Vec3& step, double magnitude, double period) noexcept;
  Vec3 Damping(const Contact& contact, double magnitude, double largest) const noexcept;

  bool WasTouching = false;
  bool HasProperties = false; ///< something touched since the touch began has some
  bool Clamped = false;
  bool Limited = false;
  bool HeldBack = false;
  double Tank = 0.0;
  double Gain = 0.0;
  double WantedGain = 0.0;   ///< at the last tick
  double Excess = 0.0;       ///< of the gain, from before an exchange that softened
  double ExcessRate = 0.0;   ///< at which that goes [per s]
  double FallTime = 0.0;     ///< of an exchange since the last tick; 0: there was none [s]
  double LongestFall = 0.0;  ///< in one tick [s]
  double SmallestFall = 0.0; ///< [N]
  double Stiffness = 0.0;
  double Missing = 0.0;                  ///< for the gain that is wanted [J]
  double Depth = 0.0;                    ///< at the last tick [m]
  double Stored = 0.0;                   ///< in the spring at the last tick [J]
  const ForceProfile* Profile = nullptr; ///< of the last tick; only compared: it may be gone
  Vec3 Position{};
  Vec3 Velocity{};     ///< against the surface, filtered [m/s]
  Vec3 LawForce{};     ///< of the last tick [N]
  Vec3 LateralForce{}; ///< the gradient's and the resistance, of the last tick [N]
  Vec3 OtherForce{};   ///< shading and damping of the last tick [N]
};
}

#endif
