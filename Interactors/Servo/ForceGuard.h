#ifndef Haptics_ForceGuard_h
#define Haptics_ForceGuard_h

#include "haptics/Material/ForceModel.h"
#include "haptics/Math/Vec3.h"
#include "haptics/Servo/PassivityController.h"
#include "haptics/Servo/SafetySettings.h"
#include "haptics/Servo/SlewLimiter.h"
#include "haptics/Servo/StiffnessLimit.h"
#include "haptics/Tick/SurfaceForce.h"
#include "vtkHapticsServoModule.h"

#include <cstdint>

namespace haptics
{
/// @brief From a contact to the force that a hand may be given. Servo thread.
///
///     stiffness limit -> SurfaceForce -> contact damping -> passivity -> clamp -> slew,
///     soft start
///
/// A force may shrink at once as the hand moves (what an exchange of materials softens goes over
/// the soft start's time, see SurfaceForce), but grows and turns no faster than the slew limit, and
/// what this does gives the hand no energy (class SlewLimiter):
///
/// Where the hand has gone beyond what is known of a surface (Contact::AwaitsData), the force that
/// it had falls to zero over the soft start's time; what comes when the data have come starts
/// softly, and is added to what is left of that. (A spring to the last known place would hold the
/// hand with 3.3 N after 22 ms at 0.3 m/s, all of which would be gone in the tick in which data
/// come; measured by TestPatchLatency.)
///
/// After a late tick all of this goes on as after two periods at most, and so softly.
///
///        allowed next force: within slew * T of the line from zero to the last force
///             ________
///         0 ( o------> )  last force
///             --------
class VTKHAPTICSSERVO_EXPORT ForceGuard
{
public:
  /// Readies a new run; it begins with a soft start.
  void Restart(const SafetySettings& settings) noexcept;
  /// From here on the force grows softly for a while: a run starts, or a pause or a halt has ended.
  void StartSoftly(const SafetySettings& settings) noexcept;
  /// The device has let go of the last force: the next one grows from zero.
  void Release() noexcept { this->Slew.Release(); }
  ///@{
  /// For the next force. Surfaces or their materials have been exchanged: what that does to it, by
  /// Contact::SurfaceDisplacement and by another stiffness, starts softly, and all else goes on.
  void NoticeExchange() noexcept { this->HasExchange = true; }
  /// The HIP has been put elsewhere, by another workspace: whatever the force grows starts softly.
  void NoticeJump() noexcept { this->HasJump = true; }
  ///@}
  /// The force to ask for [N]; finite, and never longer than `model` allows. `contact`: device
  /// frame; `period`: since the last tick [s]; below 0 or not finite counts as 0.
  Vec3 Force(const Contact& contact, double period, const ForceModel& model,
    const SafetySettings& settings) noexcept;

  /// What limited the last force: bits of SafetyLimit.
  std::uint32_t GetLimits() const noexcept { return this->Limits; }
  /// What the last force was made by, before it was limited.
  const SurfaceForce& GetLaw() const noexcept { return this->Law; }
  /// The passivity observer's balance [J]; 0 while it is off: without passivity control and without
  /// properties.
  double GetPassivityBalance() const noexcept { return this->Passivity.GetEnergy(); }

private:
  Vec3 Spring(const Contact& contact, double period, const ForceModel& model,
    const SafetySettings& settings) noexcept;
  Vec3 Damping(const Contact& contact, double period, const SafetySettings& settings) noexcept;
  void Fade(bool awaitsData, double step, const SafetySettings& settings) noexcept;
  Vec3 LimitSlew(const Vec3& force, const Contact& contact, double step, double maximumForce,
    const SafetySettings& settings) noexcept;

  StiffnessLimit Stiffener;
  SurfaceForce Law;
  PassivityController Passivity;
  SlewLimiter Slew;
  Vec3 LastPosition{};
  Vec3 Step{}; // of the HIP against the surface [m]
  bool IsFirst = true;
  bool HasExchange = false;
  bool HasJump = false;
  bool WasTouching = false;
  bool WasPaused = false;
  double NormalSpeed = 0.0; // [m/s], smoothed
  double SoftTimeLeft = 0.0;
  bool WasWaiting = false; // for data
  Vec3 Fading{};           // what is left of the force before that [N]
  double FadingRate = 0.0; // [N/s]
  Vec3 LastForce{};        // [N]
  double Stiffness = 0.0;  // of the last tick's contact; 0 in free space [N/m]
  bool WasPlain = true;
  std::uint32_t Limits = 0;
};
}

#endif
