#ifndef Haptics_PassivityController_h
#define Haptics_PassivityController_h

#include "haptics/Math/Vec3.h"
#include "vtkHapticsServoModule.h"

namespace haptics
{
/// @brief Watches the energy between servo and hand, and takes back what the servo has made.
///
/// The observer and controller of Hannaford and Ryu (2002) in impedance causality: the force of the
/// last tick was held while the hand moved on, so the servo took in -F.dx of energy, and the
/// device's own damping b another b v^2 T. While the balance is negative the controller adds
/// -alpha v, alpha = -E / (T v^2), bounded by what a device can damp without shaking.
///
/// A surface that moves does work of its own: the force, in the mean over the tick, times the way
/// that it took the god-object. What the servo passes on of that it has not made. With the mean a
/// spring's account is exact: a surface that goes out and back under a hand at rest leaves nothing.
///
/// A balance that is positive where the hand lets go of the surface is forgotten: it is no credit
/// for the next contact. Device frame. Servo thread.
class VTKHAPTICSSERVO_EXPORT PassivityController
{
public:
  void Restart() noexcept;
  /// Takes in where the hand is [m] and returns the damping force to add [N].
  /// `period` [s], `deviceDamping` [N s/m], `largestDamping` [N s/m], `touching`: now.
  Vec3 Update(const Vec3& position, double period, double deviceDamping, double largestDamping,
    bool touching) noexcept;
  /// Takes in the force that was finally asked for [N], and how far surfaces moved the god-object
  /// since the last tick [m].
  void Sent(const Vec3& force, const Vec3& surfaceStep) noexcept;
  /// The balance [J]: negative where the servo has made energy.
  double GetEnergy() const noexcept { return this->Energy; }

private:
  bool HasPosition = false;
  Vec3 Position{};
  Vec3 Force{};
  double Energy = 0.0;
};
}

#endif
