#include "haptics/Tick/ContactTick.h"

#include "haptics/Math/VectorMath.h"

namespace haptics
{
const Contact& ContactTick::Touch(GodObject& god, const Vec3& devicePosition, const Vec3& hip,
  const WorkspaceTransform& deviceToWorld) noexcept
{
  return this->Take(god.Update(hip), devicePosition, deviceToWorld);
}

const Contact& ContactTick::Hold(
  GodObject& god, const Vec3& devicePosition, const WorkspaceTransform& deviceToWorld) noexcept
{
  return this->Take(god.Hold(), devicePosition, deviceToWorld);
}

const Contact& ContactTick::Take(const Contact& contact, const Vec3& devicePosition,
  const WorkspaceTransform& deviceToWorld) noexcept
{
  if (!this->IsFirst)
  {
    const Vector step = ToVector(devicePosition) - ToVector(this->InDevice.Hip);
    this->Work -= glm::dot(ToVector(this->Force), step);
  }
  this->IsFirst = false;
  this->DeviceToWorld = deviceToWorld;
  this->InDevice = contact;
  this->InDevice.Hip = devicePosition;
  this->InDevice.Displacement = deviceToWorld.VectorToDevice(contact.Displacement);
  this->InDevice.Position =
    ToVec3(ToVector(devicePosition) + ToVector(this->InDevice.Displacement));
  this->InDevice.Penetration = glm::length(ToVector(this->InDevice.Displacement));
  this->InDevice.Carried = deviceToWorld.VectorToDevice(contact.Carried);
  for (int i = 0; i < contact.NumberOfConstraints; ++i)
  {
    this->InDevice.Constraints[i].Normal =
      deviceToWorld.DirectionToDevice(contact.Constraints[i].Normal);
  }
  if (contact.Status == UpdateStatus::InvalidHip)
  {
    this->InDevice.Carried = {};
    this->InDevice.Material = haptics::Material();
  }
  Material& material = this->InDevice.Material;
  for (Vec3* const gradient :
    { &material.StiffnessGradient, &material.PlainShareGradient, &material.TextureGradient })
  {
    // A metre of the hand's way is `Scale` world units.
    *gradient = ToVec3(deviceToWorld.Scale * ToVector(deviceToWorld.DirectionToDevice(*gradient)));
  }
  if (contact.Material.IsShaded)
  {
    this->InDevice.Shaded = deviceToWorld.VectorToDevice(contact.Shaded);
  }
  return this->InDevice;
}

void ContactTick::Record(
  const GodObject& god, const Vec3& force, const SurfaceForce& law, TickRecord& record) noexcept
{
  static_cast<Contact&>(record) = god.Current();
  record.DevicePosition = this->InDevice.Hip;
  record.Force = force;
  record.WorldForce = this->DeviceToWorld.DirectionToWorld(force);
  if (record.NumberOfConstraints > 0)
  {
    record.Local = god.LocalPosition(record.Constraints[0].Surface);
    record.DeformFraction = god.DeformFraction(record.Constraints[0].Surface);
  }
  record.Stiffness = law.GetStiffness();
  record.Energy = this->Work;
  record.Tank = law.GetTank();
  this->Force = force;
}
}
