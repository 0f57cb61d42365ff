#ifndef Haptics_MaterialTools_h
#define Haptics_MaterialTools_h

#include "haptics/Contact/GodObject.h"
#include "haptics/Material/SurfaceProperties.h"
#include "haptics/Tick/SurfaceForce.h"

#include <memory>

namespace haptics::testing
{
/// Properties that are the same everywhere; stiffness below 0: the servo's.
PropertyValues Everywhere(
  double stiffness, double damping, double staticFriction, double dynamicFriction, double texture);
/// Friction alone.
PropertyValues Rough(double staticFriction, double dynamicFriction);
/// Builds properties and fails the running test when that fails.
std::shared_ptr<const SurfaceProperties> MakeProperties(
  PropertyValues values, const TriangleSurface& surface);
/// A surface with these properties.
TouchedSurface Touchable(
  const std::shared_ptr<const TriangleSurface>& surface, PropertyValues values);
/// A value for each point of a surface. [local frame]
template <class Function>
PropertyField AtPoints(const TriangleSurface& surface, const Function& value)
{
  PropertyField field;
  for (const Vec3& point : surface.Points())
  {
    field.Values.push_back(static_cast<float>(value(point)));
  }
  return field;
}

/// @brief A hand on a known way, a god-object and its force, and the energy between them.
///
/// World and device frame are the same [m], a tick is 1 ms.
class MaterialHand
{
public:
  /// In free space at `start`; with a ball of the radius `tip`.
  MaterialHand(
    TouchedSurface surface, const Vec3& start, double plainStiffness = 500.0, double tip = 0.0);

  /// Moves the HIP and returns the force [N].
  Vec3 Move(const Vec3& hip);
  /// Moves it straight, so many ticks; returns the last force [N].
  Vec3 MoveStraight(const Vec3& to, int ticks);

  GodObject God;
  SurfaceForce Force;
  MaterialLimits Limits;
  double PlainStiffness;
  /// What the hand has got out of the servo [J], with a force that changes evenly over each tick.
  double EnergyOut = 0.0;
  /// The same with the force held over each tick, as a servo does.
  double HeldEnergyOut = 0.0;
  /// What a device of 1 N s/m has taken of it [J].
  double DeviceLoss = 0.0;
  Vec3 Hip{};
  Vec3 Last{}; ///< the last force [N]

private:
  bool IsFirst = true;
};
}

#endif
