#ifndef Haptics_ContactTick_h
#define Haptics_ContactTick_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Math/WorkspaceTransform.h"
#include "haptics/Tick/SurfaceForce.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticsCoreModule.h"

namespace haptics
{
/// @brief One tick, from a haptic interface point (HIP) to a record of its contact and force.
///
///     HIP -> GodObject::Update -> Contact -> SurfaceForce (-> ForceGuard) -> TickRecord
///
/// A servo and vtkGodObjectTrace both go this way, so what they report means the same:
///
///     const Contact& contact = tick.Touch(god, position, hip, deviceToWorld);
///     const Vec3 force = law.Update(contact, ...);  // a servo: a ForceGuard, which asks its law
///     tick.Record(god, force, law, record);
///
/// Servo thread; no allocation, no lock.
class VTKHAPTICSCORE_EXPORT ContactTick
{
public:
  /// Forgets everything: the next tick is the first one.
  void Restart() noexcept { *this = ContactTick(); }

  /// Moves the god-object to a HIP, given in both frames, and returns the contact in the device
  /// frame [m]. Valid until the next call.
  const Contact& Touch(GodObject& god, const Vec3& devicePosition, const Vec3& hip,
    const WorkspaceTransform& deviceToWorld) noexcept;

  /// The same of a god-object that stays where it is, with a device that may be anywhere.
  const Contact& Hold(
    GodObject& god, const Vec3& devicePosition, const WorkspaceTransform& deviceToWorld) noexcept;

  /// Writes what became of that contact: all of a record but Tick, Time, Buttons, Generation and
  /// Limits. `force`: the one that is held until the next tick, device frame [N]; `law`: what it
  /// was made by.
  void Record(
    const GodObject& god, const Vec3& force, const SurfaceForce& law, TickRecord& record) noexcept;

private:
  const Contact& Take(const Contact& contact, const Vec3& devicePosition,
    const WorkspaceTransform& deviceToWorld) noexcept;

  Contact InDevice{};
  Vec3 Force{}; ///< held since the last tick [N]
  double Work = 0.0;
  bool IsFirst = true;
  WorkspaceTransform DeviceToWorld;
};
}

#endif
