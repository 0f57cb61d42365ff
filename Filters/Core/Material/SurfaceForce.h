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
///     law: gain · phi(depth), phi the depth or a profile, along the displacement
///       + shading: the same turned, less itself     + damping: -B · velocity
///
/// **No energy is made.** A law that does not change is the slope of a potential and makes none on
/// any closed way. What may make some is paid out of a tank:
///
/// - it is filled by what is lost for the hand: a gain that falls under a spring that is pressed,
///   the friction's work, the damping's work;
/// - a gain rises only by what the tank holds: dK <= 2E/d^2 for a linear spring (where a stiffness,
///   a texture or the surface itself changes under a hand that presses d deep, dK d^2/2 would come
///   from nowhere). It rises freely at a new touch;
/// - force shading that pushes the way the hand goes does so only as far as the tank holds.
///
/// Energies are those of the force that changes evenly over a tick (trapezoids); that a servo holds
/// it instead is what the device's own damping pays for, under K <= 2b/T. What is left when the
/// hand lets go is forgotten; a debt is kept. Force that the largest force cuts off fills no tank.
///
/// **Damping** uses the velocity of the HIP through a filter of first order with a time constant of
/// 5 ms: that is its delay, for all slow motions. It is at most MaterialLimits::Damping, and never
/// pulls towards the surface. What it costs of the stable stiffness is |B| (Colgate and Schenkel:
/// b > KT/2 + |B|), which MaterialLimits::Stiffness has to account for.
///
/// Servo thread; no allocation, no lock.
class VTKHAPTICSCORE_EXPORT SurfaceForce
{
public:
  /// Forgets everything.
  void Restart() noexcept { *this = SurfaceForce(); }
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
  double WantedGain(
    const Material& felt, double plainStiffness, const MaterialLimits& limits) noexcept;
  void SetGain(const Contact& contact, double wanted, double depth) noexcept;

  bool WasTouching = false;
  bool HasProperties = false; ///< something touched since the touch began has some
  bool Clamped = false;
  bool Limited = false;
  bool HeldBack = false;
  double Tank = 0.0;
  double Gain = 0.0;
  double Stiffness = 0.0;
  double Depth = 0.0;                    ///< at the last tick [m]
  double Stored = 0.0;                   ///< in the spring at the last tick [J]
  const ForceProfile* Profile = nullptr; ///< of the last tick; only compared: it may be gone
  Vec3 Position{};
  Vec3 Velocity{};   ///< filtered [m/s]
  Vec3 LawForce{};   ///< of the last tick [N]
  Vec3 OtherForce{}; ///< shading and damping of the last tick [N]
};
}

#endif
