#include "haptics/Tick/ContactTick.h"

#include "haptics/Math/VectorMath.h"

namespace haptics
{
namespace
{
/// The barycentric weights of where a point falls on a triangle's plane, kept within the triangle:
/// a god-object stands over it, or beyond an edge by a clearance.
Vec3 WeightsIn(
  const TriangleSurface& surface, const Triangle& triangle, double fraction, const Vec3& local)
{
  const Vector a = ToVector(surface.PointAt(triangle[0], fraction));
  const Vector b = ToVector(surface.PointAt(triangle[1], fraction));
  const Vector c = ToVector(surface.PointAt(triangle[2], fraction));
  const Vector p = ToVector(local);
  const Vector normal = glm::cross(b - a, c - a);
  const Vector areas{ glm::dot(normal, glm::cross(c - b, p - b)),
    glm::dot(normal, glm::cross(a - c, p - c)), glm::dot(normal, glm::cross(b - a, p - a)) };
  const Vector weights = glm::max(areas, Vector(0.0));
  const double sum = weights[0] + weights[1] + weights[2];
  return sum > 0.0 ? ToVec3(weights / sum) : Vec3{ 1.0, 0.0, 0.0 };
}
}

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
  this->InDevice.SurfaceDisplacement = deviceToWorld.VectorToDevice(contact.SurfaceDisplacement);
  for (int i = 0; i < contact.NumberOfConstraints; ++i)
  {
    this->InDevice.Constraints[i].Normal =
      deviceToWorld.DirectionToDevice(contact.Constraints[i].Normal);
  }
  if (contact.Status == UpdateStatus::InvalidHip)
  {
    this->InDevice.SurfaceDisplacement = {};
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
    const Constraint& strongest = record.Constraints[0];
    record.Local = god.LocalTouch(strongest);
    record.DeformFraction = god.DeformFraction(record.Constraints[0].Surface);
    const TriangleSurface& surface =
      *god.Surfaces()[static_cast<std::size_t>(strongest.Surface)].Surface;
    const Triangle& triangle = surface.Triangles()[static_cast<std::size_t>(strongest.Triangle)];
    record.Weights = WeightsIn(surface, triangle, record.DeformFraction, record.Local);
  }
  else
  {
    record.Weights = {};
  }
  record.Stiffness = law.GetStiffness();
  record.Energy = this->Work;
  record.Tank = law.GetTank();
  this->Force = force;
}
}
