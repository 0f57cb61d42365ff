#ifndef Haptics_Friction_h
#define Haptics_Friction_h

#include "haptics/Math/VectorMath.h"

namespace haptics
{
/// @brief Coulomb friction of a god-object: it stays while the HIP pulls within the friction cone.
///
///          nearest      t       god-object
///     ------- x <-------------- o ---------  surface
///             |             /
///             | d       /         |t| <= mu_s |d|: stuck
///             |     /             else it slides to where |t| = mu_d |d|
///             h
///
/// `nearest` is the nearest point to the HIP h that the planes in contact allow, where the
/// god-object would be without friction. The spring's force then has the part along t that friction
/// bears. Once it slides, mu_d decides until the pull has fallen well below; so a hand that moves
/// on in the small steps of its encoders slides and does not stutter.
///
/// The state belongs to the god-object, so that several may touch one surface. Servo thread.
class Friction
{
public:
  void Reset() { this->IsSliding = false; }

  /// Where the update is to aim at instead of the HIP: `position` itself, bit for bit, while stuck;
  /// else a point on the way to the HIP. As every update comes no farther from what it aims at,
  /// and that lies between the god-object and the HIP, none comes farther from the HIP either: the
  /// premise of the stability bound K <= 2b/T stands.
  Vector Aim(const Vector& position, const Vector& nearest, const Vector& hip,
    double staticFriction, double dynamicFriction)
  {
    const double pull = glm::length(nearest - position);
    const double push = glm::length(nearest - hip);
    const double slides = dynamicFriction * push;
    this->IsSliding = this->IsSliding && pull > StickShare * slides;
    // What was left at the cone's side by the last slide is not beyond it.
    const double limit = this->IsSliding ? slides : staticFriction * push;
    if (pull <= limit * (1.0 + Rounding))
    {
      return position;
    }
    this->IsSliding = true;
    return position + (1.0 - slides / pull) * (hip - position);
  }

private:
  static constexpr double Rounding = 1e-9;
  /// Depths as encoders report them tremble by a few per cent.
  static constexpr double StickShare = 0.9;

  bool IsSliding = false;
};
}

#endif
