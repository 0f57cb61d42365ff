#ifndef Haptics_StiffnessLimit_h
#define Haptics_StiffnessLimit_h

#include "haptics/Servo/SafetySettings.h"
#include "vtkHapticsServoModule.h"

namespace haptics
{
/// @brief The stiffness that a servo may use, from the periods of its ticks. Servo thread.
///
/// A spring K behind a zero-order hold stays passive in a device of damping b for
/// K <= 2 b E[T] / E[T^2] (Colgate and Schenkel 1997, with the mean over uneven periods), and with
/// a latency t_d for K <= b / (E[T^2] / (2 E[T]) + t_d). The means are taken over about the last
/// second, so that one stall softens the surfaces for about as long.
///
/// A stiffness falls at once. It rises slowly, over the soft start's time: raising the stiffness
/// under a hand that presses d deep puts in dK d^2 / 2 of energy.
class VTKHAPTICSSERVO_EXPORT StiffnessLimit
{
public:
  /// Forgets all periods: as if all had been `nominalPeriod` [s].
  void Restart(double nominalPeriod) noexcept;
  /// Counts a period [s] and returns the stiffness to use for a wanted one [N/m].
  double Update(double period, double wanted, const SafetySettings& settings) noexcept;
  /// What periods and damping allow now [N/m]; infinite where the device's damping is not known.
  /// `surfaceDamping`: damping by the servo besides the settings' own [N s/m].
  double Allowed(const SafetySettings& settings, double surfaceDamping = 0.0) const noexcept;

private:
  double NominalPeriod = 0.001;
  double MeanPeriod = 0.001;       // [s]
  double MeanSquaredPeriod = 1e-6; // [s^2]
  double Stiffness = -1.0;         // in use [N/m]; negative: none yet
};
}

#endif
