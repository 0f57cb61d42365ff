#include "haptics/Tick/SurfaceForce.h"

#include "haptics/Material/ForceProfile.h"
#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
/// An encoder's steps divided by a millisecond are not a velocity; so much [s] makes one of them.
constexpr double VelocitySmoothing = 0.005;
/// The tank is let out to shading over about so many ticks, so that it fades and does not flicker.
constexpr double TicksToEmpty = 10.0;
/// Slower than this [m/s] a hand has no direction to speak of.
constexpr double SmallSpeed = 0.002;
/// The velocity comes late by its smoothing: a light device (45 g) shakes where more than mass over
/// that time, 9 N s/m, resists it.
constexpr double LargestResistance = 8.0; // [N s/m]
/// Planes closer than this [rad] leave the same directions free.
constexpr double SmallestAngle = 1e-6;

double LawForceOf(const ForceProfile* profile, double depth)
{
  return profile ? profile->Force(depth) : depth;
}

double LawEnergyOf(const ForceProfile* profile, double depth)
{
  return profile ? profile->Energy(depth) : 0.5 * depth * depth;
}
}

SurfaceForce::Wish SurfaceForce::WishOf(
  const Contact& contact, double plainStiffness, const MaterialLimits& limits) noexcept
{
  const Material& material = contact.Material;
  const bool hasProfile = material.Profile != nullptr;
  const double limit =
    limits.Stiffness / (hasProfile ? material.Profile->SteepestSlope() : 1.0); // of the gain
  const double smooth =
    hasProfile ? 1.0 : material.Stiffness + material.PlainShare * plainStiffness;
  const double largest = hasProfile
    ? 1.0
    : std::max(material.LargestStiffness, material.LargestPlainShare * plainStiffness);
  Wish wish;
  wish.Gain = smooth * (1.0 + material.Texture);
  wish.Largest = std::min(limit, largest * (1.0 + material.LargestTexture));
  this->Limited = wish.Gain > limit;
  if (this->Limited)
  {
    wish.Gain = limit;
    return wish;
  }
  Vector gradient = smooth * ToVector(material.TextureGradient);
  if (!hasProfile)
  {
    gradient += (1.0 + material.Texture) *
      (ToVector(material.StiffnessGradient) +
        plainStiffness * ToVector(material.PlainShareGradient));
  }
  // The planes in contact leave the directions that are normal to all of their normals.
  Vector axes[3];
  int count = 0;
  for (int i = 0; i < contact.NumberOfConstraints; ++i)
  {
    Vector axis = ToVector(contact.Constraints[i].Normal);
    for (int k = 0; k < count; ++k)
    {
      axis -= glm::dot(axis, axes[k]) * axes[k];
    }
    const double length = glm::length(axis);
    if (length > SmallestAngle)
    {
      axes[count++] = axis / length;
      gradient -= glm::dot(gradient, axes[count - 1]) * axes[count - 1];
    }
  }
  wish.Gradient = ToVec3(gradient);
  return wish;
}

/// What an exchange has softened goes evenly, over `time` from one on; 0: there was none. `limit`
/// is the largest gain.
void SurfaceForce::FallSoftly(
  Wish& wish, double time, double limit, double depth, double period) noexcept
{
  const double wanted = wish.Gain;
  const double fall = this->WantedGain - wanted;
  const double step = std::min(period, this->LongestFall);
  this->Excess = std::max(0.0, this->Excess - this->ExcessRate * step);
  if (time > 0.0 && this->WasTouching && fall * depth > this->SmallestFall)
  {
    this->Excess += fall;
    this->ExcessRate = this->Excess / time;
  }
  // No more than the spring had.
  this->Excess = std::min(this->Excess, std::max(0.0, this->Gain - wanted));
  wish.Gain = std::max(wanted, std::min(wanted + this->Excess, limit));
  this->WantedGain = wanted;
}

/// What acts across the spring: the potential's slope along the surface, and the resistance by
/// which the hand pays for what is missing.
Vec3 SurfaceForce::Lateral(const Contact& contact, const Wish& wish, double depth) const noexcept
{
  const ForceProfile* const profile = contact.Material.Profile;
  const Vector velocity = ToVector(this->Velocity);
  const double largest = wish.Gain * LawForceOf(profile, depth);
  Vector lateral(0.0);
  if (contact.Material.StaticFriction <= 0.0)
  {
    lateral = -LawEnergyOf(profile, depth) * ToVector(wish.Gradient);
    const double length = glm::length(lateral);
    if (length > largest)
    {
      lateral *= largest / length;
    }
    const double gives = glm::dot(lateral, velocity);
    const double scale = length * (glm::length(velocity) + SmallSpeed);
    lateral *= scale > 0.0 ? 1.0 - SlopeMargin * gives / scale : 1.0;
  }
  if (this->Missing > 0.0)
  {
    const Vector normal = ToVector(contact.Displacement) / depth;
    const Vector along = velocity - glm::dot(velocity, normal) * normal;
    const double resistance =
      std::min(this->Missing / JumpWidth, this->Gain * LawForceOf(profile, depth));
    lateral -= along * std::min(resistance / (glm::length(along) + SmallSpeed), LargestResistance);
  }
  return ToVec3(lateral);
}

void SurfaceForce::SetGain(const Contact& contact, const Wish& wish, double depth, const Vec3& step,
  const Vec3& lateral, double period) noexcept
{
  const ForceProfile* const profile = contact.Material.Profile;
  const double energy = LawEnergyOf(profile, depth);
  this->Missing = 0.0;
  if (!this->WasTouching || this->Depth == 0.0 || energy == 0.0)
  {
    this->Gain = wish.Gain;
    this->Stored = this->Gain * energy;
    this->Profile = profile;
    this->HeldBack = false;
    return;
  }
  // The last tick's law, at this tick's depth: what the spring would hold now.
  const bool isSameLaw = profile == this->Profile;
  const double ratio = depth / this->Depth;
  const double held = isSameLaw ? this->Gain * energy : this->Stored * ratio * ratio;
  const Vector force = ToVector(contact.Displacement) *
    (isSameLaw ? this->Gain * LawForceOf(profile, depth) / depth : 2.0 * held / (depth * depth));
  const Vector moved = ToVector(step);
  if (!this->Clamped)
  {
    // What hand and moving surfaces have put in and the spring does not hold: the friction's work,
    // and what the lateral force has taken.
    const Vector mean =
      0.5 * (ToVector(this->LawForce) + force + ToVector(this->LateralForce) + ToVector(lateral));
    this->Tank -= glm::dot(mean, moved) + (held - this->Stored);
  }
  const double given = glm::dot(ToVector(this->OtherForce), moved);
  this->Tank -= this->Clamped ? std::max(given, 0.0) : given;

  // As much of the wanted gain as is paid for; a debt beyond the credit is taken off it.
  // Nothing is known of the work of a force that was cut off.
  const double change = wish.Gain * energy - held;
  const double available = this->Clamped ? std::max(this->Tank, 0.0)
                                         : this->Tank + Credit * std::min(held, wish.Gain * energy);
  const double paid = std::max(std::min(change, available), -held);
  this->Gain = change <= paid ? wish.Gain : (held + paid) / energy;
  this->Missing = std::max(0.0, (wish.Gain - this->Gain) * energy);
  this->Tank -= this->Clamped ? std::max(paid, 0.0) : paid;
  this->HeldBack = this->Gain < (1.0 - Credit) * wish.Gain;

  this->Stored = this->Gain * energy;
  const double need = std::max(0.0, wish.Largest - this->Gain) * energy +
    (contact.Material.IsShaded ? this->Stored : 0.0);
  const double kept = std::max(0.0, 1.0 - period / TankMemory);
  this->Tank = this->Tank > 0.0 ? std::min(kept * this->Tank, need) : this->Tank;
  this->Profile = profile;
}

/// Turns the law's force as the interpolated normal turns, as far as the tank pays for.
Vec3 SurfaceForce::Shading(
  const Contact& contact, const Vec3& step, double magnitude, double period) noexcept
{
  const Vector displacement = ToVector(contact.Displacement);
  Vector shading =
    (ToVector(contact.Shaded) - displacement) * (magnitude / glm::length(displacement));
  const double gives = std::max({ glm::dot(shading, ToVector(step)),
    glm::dot(shading, ToVector(this->Velocity)) * period, 0.0 });
  shading *= gives > 0.0 ? std::min(1.0, std::max(this->Tank, 0.0) / (TicksToEmpty * gives)) : 1.0;
  return ToVec3(shading);
}

Vec3 SurfaceForce::Damping(const Contact& contact, double magnitude, double largest) const noexcept
{
  Vector damping = -std::min(contact.Material.Damping, largest) * ToVector(this->Velocity);
  const Vector displacement = ToVector(contact.Displacement);
  const double depth = glm::length(displacement);
  const double pull = glm::dot(damping, displacement) / depth;
  if (pull < -magnitude)
  {
    damping -= displacement * ((pull + magnitude) / depth);
  }
  return ToVec3(damping);
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
  this->WantedGain = plainStiffness;
  this->Stiffness = plainStiffness;
  this->Depth = depth;
  this->Stored = 0.5 * plainStiffness * depth * depth;
  this->Profile = nullptr;
  this->Position = contact.Hip;
  this->LawForce = ToVec3(law);
  this->LateralForce = {};
  this->OtherForce = {};
  this->Velocity = {};
  this->Clamped = length > limits.MaximumForce;
  return ToVec3(this->Clamped ? law * (limits.MaximumForce / length) : law);
}

Vec3 SurfaceForce::Update(const Contact& contact, double period, double plainStiffness,
  const MaterialLimits& limits) noexcept
{
  const double fallTime = std::exchange(this->FallTime, 0.0);
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
  Vector step(0.0);
  if (this->WasTouching)
  {
    step = ToVector(contact.Hip) - ToVector(this->Position) - ToVector(contact.SurfaceDisplacement);
    const double weight = period > 0.0 ? period / (period + VelocitySmoothing) : 0.0;
    const Vector velocity = period > 0.0 ? step / period : Vector(0.0);
    this->Velocity = ToVec3(glm::mix(ToVector(this->Velocity), velocity, weight));
  }
  Wish wish = this->WishOf(contact, plainStiffness, limits);
  if (!contact.Material.Profile && !this->Profile)
  {
    this->FallSoftly(wish, fallTime, limits.Stiffness, depth, period);
  }
  else // gains of profiles are no stiffnesses: the force follows at once
  {
    this->WantedGain = wish.Gain;
    this->Excess = 0.0;
  }
  const Vec3 lateral = this->Lateral(contact, wish, depth);
  this->SetGain(contact, wish, depth, ToVec3(step), lateral, period);
  this->Stiffness = this->Gain * (this->Profile ? this->Profile->SteepestSlope() : 1.0);

  const double magnitude = this->Gain * LawForceOf(this->Profile, depth);
  const Vector law = displacement * (magnitude / depth);
  Vector other(0.0);
  if (contact.Material.IsShaded)
  {
    other += ToVector(this->Shading(contact, ToVec3(step), magnitude, period));
  }
  if (contact.Material.Damping > 0.0)
  {
    other += ToVector(this->Damping(contact, magnitude, limits.Damping));
  }

  Vector force = law + ToVector(lateral) + other;
  const double length = glm::length(force);
  this->Clamped = length > limits.MaximumForce;
  if (this->Clamped)
  {
    force *= limits.MaximumForce / length;
  }
  this->WasTouching = true;
  this->Depth = depth;
  this->Position = contact.Hip;
  this->LawForce = ToVec3(law);
  this->LateralForce = lateral;
  this->OtherForce = ToVec3(other);
  return ToVec3(force);
}
}
