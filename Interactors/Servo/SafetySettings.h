#ifndef Haptics_SafetySettings_h
#define Haptics_SafetySettings_h

#include <cstdint>

namespace haptics
{
/// @brief What stands between a computed force and a hand. The defaults are the safe ones.
///
/// Plain memory, handed to the servo thread. vtkHapticSafety holds and checks them for the user.
struct SafetySettings
{
  /// How fast a force may grow or turn [N/s]; it may shrink at once.
  double SlewLimit = 1000.0;
  /// For so long [s] after an engage, a pause or a halt a force grows at most so fast that it would
  /// take as long to the largest one; as fast goes what a change under the hand does to it. 0: off.
  double SoftStartTime = 0.1;
  /// Share of the stiffness that the device's damping allows at the measured periods.
  double StiffnessMargin = 0.9;
  /// Damping of a contact along its normal [N s/m]; 0: off.
  double ContactDamping = 0.0;
  /// Whether energy that the servo has made is taken back by damping.
  bool PassivityControl = false;
  /// No force, but the servo goes on.
  bool Paused = false;

  double DeviceDamping = 0.0;   ///< b of the device's mechanics [N s/m]; 0: unknown, no limit by it
  double DeviceLatency = 0.0;   ///< from the servo's force to the hand [s]
  double NominalPeriod = 0.001; ///< [s]
};

/// What kept a tick's force from being the plain spring's. Bits.
enum SafetyLimit : std::uint32_t
{
  ForceClamped = 1,     ///< the device's or the user's largest force
  ForceSlewed = 2,      ///< grew or turned faster than the slew limit, or still lacks that much
  SoftStarted = 4,      ///< grew faster than a soft start lets it, or still lacks that much
  StiffnessLimited = 8, ///< the periods and the device's damping allow less than was asked for
  PassivityDamped = 16, ///< energy was taken back
  PausedForce = 32,     ///< paused
  EnergyHeldBack = 64,  ///< a surface is stiffer here than anything has paid for; see SurfaceForce
  DataAwaited = 128     ///< the hand is ahead of what is known of a surface; see ForceGuard
};
}

#endif
