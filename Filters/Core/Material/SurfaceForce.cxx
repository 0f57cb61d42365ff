#include "haptics/Material/SurfaceForce.h"

#include "haptics/Material/ForceProfile.h"
#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// An encoder's steps divided by a millisecond are not a velocity; so much [s] makes one of them.
constexpr double VelocitySmoothing = 0.005;
/// The tank is let out to shading over about so many ticks, so that it fades and does not flicker.
constexpr double TicksToEmpty = 10.0;

double LawForceOf(const ForceProfile* profile, double depth)
{
  return profile ? profile->Force(depth) : depth;
}

double LawEnergyOf(const ForceProfile* profile, double depth)
{
  return profile ? profile->Energy(depth) : 0.5 * depth * depth;
}
}

double SurfaceForce::WantedGain(
  const Material& felt, double plainStiffness, const MaterialLimits& limits) noexcept
{
  const double slope = felt.Profile ? felt.Profile->SteepestSlope() : 1.0;
  const double smooth = felt.Profile ? 1.0 : felt.Stiffness + felt.PlainShare * plainStiffness;
  const double wanted = smooth * (1.0 + felt.Texture);
  this->Limited = wanted * slope > limits.Stiffness;
  return this->Limited ? limits.Stiffness / slope : wanted;
}

void SurfaceForce::SetGain(const Contact& contact, double wanted, double depth) noexcept
{
  const ForceProfile* const profile = contact.Material.Profile;
  const double energy = LawEnergyOf(profile, depth);
  this->HeldBack = false;
  if (!this->WasTouching || this->Depth == 0.0 || energy == 0.0)
  {
    this->Gain = wanted;
  }
  else
  {
    // The last tick's law, at this tick's depth: what the spring would hold now.
    const bool isSameLaw = profile == this->Profile;
    const double ratio = depth / this->Depth;
    const double held = isSameLaw ? this->Gain * energy : this->Stored * ratio * ratio;
    const Vector displacement = ToVector(contact.Displacement);
    const Vector force = displacement *
      (isSameLaw ? this->Gain * LawForceOf(profile, depth) / depth : 2.0 * held / (depth * depth));
    const Vector step = ToVector(contact.Hip) - ToVector(this->Position);
    if (!this->Clamped)
    {
      // What hand and moving surfaces have put in and the spring does not hold: the friction's
      // work.
      const Vector pressed = ToVector(contact.Carried) - step;
      this->Tank +=
        0.5 * glm::dot(ToVector(this->LawForce) + force, pressed) - (held - this->Stored);
    }
    const double given = glm::dot(ToVector(this->OtherForce), step);
    this->Tank -= this->Clamped ? std::max(given, 0.0) : given;

    const double change = wanted * energy - held;
    if (change <= 0.0)
    {
      this->Gain = wanted;
      this->Tank -= this->Clamped ? 0.0 : change;
    }
    else
    {
      const double paid = std::min(change, std::max(this->Tank, 0.0));
      this->HeldBack = paid < change;
      this->Gain = this->HeldBack ? (held + paid) / energy : wanted;
      this->Tank -= paid;
    }
  }
  this->Stored = this->Gain * energy;
  this->Profile = profile;
}

/// The spring alone. What it remembers is for surfaces with properties that the same touch may
/// come to.
Vec3 SurfaceForce::PlainForce(const Contact& contact, double depth, double plainStiffness,
  const MaterialLimits& limits) noexcept
{
  const Vector law = plainStiffness * ToVector(contact.Displacement);
  const double length = glm::length(law);
  this->WasTouching = true;
  this->Limited = false;
  this->HeldBack = false;
  this->Gain = plainStiffness;
  this->Stiffness = plainStiffness;
  this->Depth = depth;
  this->Stored = 0.5 * plainStiffness * depth * depth;
  this->Profile = nullptr;
  this->Position = contact.Hip;
  this->LawForce = ToVec3(law);
  this->OtherForce = {};
  this->Clamped = length > limits.MaximumForce;
  return ToVec3(this->Clamped ? law * (limits.MaximumForce / length) : law);
}

Vec3 SurfaceForce::Update(const Contact& contact, double period, double plainStiffness,
  const MaterialLimits& limits) noexcept
{
  const Vector displacement = ToVector(contact.Displacement);
  const double depth = glm::length(displacement);
  if (!contact.IsTouching() || !std::isfinite(depth) || depth == 0.0)
  {
    const double debt = std::min(this->Tank, 0.0);
    this->Restart();
    this->Tank = debt;
    this->Stiffness = plainStiffness;
    return {};
  }
  this->HasProperties = this->HasProperties || !contact.Material.IsPlain;
  if (!this->HasProperties)
  {
    return this->PlainForce(contact, depth, plainStiffness, limits);
  }
  this->SetGain(contact, this->WantedGain(contact.Material, plainStiffness, limits), depth);
  this->Stiffness = this->Gain * (this->Profile ? this->Profile->SteepestSlope() : 1.0);

  const bool needsVelocity = contact.Material.Damping > 0.0 || contact.Material.IsShaded;
  Vector step(0.0);
  Vector velocity(0.0);
  if (needsVelocity && this->WasTouching && period > 0.0)
  {
    step = ToVector(contact.Hip) - ToVector(this->Position);
    const double weight = period / (period + VelocitySmoothing);
    velocity = ToVector(this->Velocity);
    velocity += weight * (step / period - velocity);
  }

  const double magnitude = this->Gain * LawForceOf(this->Profile, depth);
  const Vector law = displacement * (magnitude / depth);
  Vector other(0.0);
  if (contact.Material.IsShaded)
  {
    other = (ToVector(contact.Shaded) - displacement) * (magnitude / depth);
    const double gives =
      std::max({ glm::dot(other, step), glm::dot(other, velocity) * period, 0.0 });
    other *= gives > 0.0 ? std::min(1.0, std::max(this->Tank, 0.0) / (TicksToEmpty * gives)) : 1.0;
  }
  if (contact.Material.Damping > 0.0)
  {
    Vector damping = -std::min(contact.Material.Damping, limits.Damping) * velocity;
    const double pull = glm::dot(damping, displacement) / depth;
    if (pull < -magnitude)
    {
      damping -= displacement * ((pull + magnitude) / depth);
    }
    other += damping;
  }

  Vector force = law + other;
  const double length = glm::length(force);
  this->Clamped = length > limits.MaximumForce;
  if (this->Clamped)
  {
    force *= limits.MaximumForce / length;
  }
  this->WasTouching = true;
  this->Depth = depth;
  this->Position = contact.Hip;
  this->Velocity = ToVec3(velocity);
  this->LawForce = ToVec3(law);
  this->OtherForce = ToVec3(other);
  return ToVec3(force);
}
}
