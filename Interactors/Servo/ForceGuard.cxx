#include "haptics/Servo/ForceGuard.h"

#include "haptics/Math/Vec3Operations.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace haptics
{
namespace
{
// An encoder's steps divided by a millisecond are not a velocity; so much [s] makes one of them.
constexpr double SpeedSmoothing = 0.005;
// What desktop devices can damp without shaking [N s/m]: Touch 4, Premium 5, Falcon 20.
constexpr double LargestPassivityDamping = 4.0;
// Of the device's damping; what a surface's own takes is missing for its stiffness.
constexpr double LargestShareOfDamping = 0.5;
// After a late tick a force that grows, fades or softens may not make up for all of the time that
// has passed: that would be one step.
constexpr double LongestStep = 2.0; // nominal periods
// Of the speed at which a spring's force grows as fast as the slew limit: a hand as slow as this is
// at rest, or slower than the soft start itself pushes it; but no motion that the limit might meet.
constexpr double RestShare = 0.03;
constexpr double LargestRestShare = 0.3;
}

void ForceGuard::Restart(const SafetySettings& settings) noexcept
{
  *this = ForceGuard();
  this->Stiffener.Restart(settings.NominalPeriod);
  this->StartSoftly(settings);
}

void ForceGuard::StartSoftly(const SafetySettings& settings) noexcept
{
  this->SoftTimeLeft = settings.SoftStartTime;
}

Vec3 ForceGuard::Force(const Contact& contact, double since, const ForceModel& model,
  const SafetySettings& settings) noexcept
{
  // A device may have a time of its own, and report anything.
  const double period = std::isfinite(since) ? std::max(0.0, since) : 0.0;
  // What goes by time alone does not make up for that of a late tick.
  const double step = std::min(period, LongestStep * settings.NominalPeriod);
  const bool isPlain = contact.Material.IsPlain;
  const bool isTouching = contact.IsTouching();
  // Against the surface, which may move.
  this->Step = this->IsFirst
    ? Vec3{}
    : Sum(Sum(contact.Hip, -1.0, this->LastPosition), -1.0, contact.SurfaceDisplacement);
  Vec3 force = this->Spring(contact, period, model, settings);
  force = Sum(force, 1.0, this->Damping(contact, period, settings));
  if (settings.PassivityControl || !isPlain)
  {
    const Vec3 damping = this->Passivity.Update(contact.Hip, period, settings.DeviceDamping,
      settings.PassivityControl ? LargestPassivityDamping : 0.0, isTouching);
    if (damping != Vec3{})
    {
      this->Limits |= PassivityDamped;
      force = Sum(force, 1.0, damping);
    }
  }
  else
  {
    this->Passivity.Restart();
  }

  const double length = Length(force);
  if (!std::isfinite(length))
  {
    force = {};
  }
  else if (length > model.MaximumForce)
  {
    force = Sum({}, model.MaximumForce / length, force);
    this->Limits |= ForceClamped;
  }
  if (settings.Paused)
  {
    force = {};
    this->Limits |= PausedForce;
  }
  else if (this->WasPaused)
  {
    this->StartSoftly(settings);
    this->HasJump = true; // where the hand went meanwhile took no work
  }
  this->WasPaused = settings.Paused;
  this->Fade(contact.AwaitsData, step, settings);
  force = contact.AwaitsData ? Vec3{} : force;

  force = this->LimitSlew(force, contact, step, model.MaximumForce, settings);
  if (this->Fading != Vec3{})
  {
    force = settings.Paused ? Vec3{} : Sum(force, 1.0, this->Fading);
    const double sum = Length(force);
    force = sum > model.MaximumForce ? Sum({}, model.MaximumForce / sum, force) : force;
  }
  this->LastForce = force;
  this->Passivity.Sent(force, contact.SurfaceDisplacement);
  this->IsFirst = false;
  this->HasExchange = false;
  this->HasJump = false;
  return force;
}

void ForceGuard::Fade(bool awaitsData, double step, const SafetySettings& settings) noexcept
{
  if (awaitsData && !this->WasWaiting)
  {
    this->Fading = this->LastForce;
    this->FadingRate = Length(this->LastForce) / settings.SoftStartTime; // infinite at once
  }
  this->HasJump = this->HasJump || awaitsData || this->WasWaiting;
  this->WasWaiting = awaitsData;
  this->Limits |= awaitsData ? DataAwaited : 0u;
  const double length = Length(this->Fading);
  const double left = length - step * this->FadingRate;
  this->Fading = left > 0.0 ? Sum({}, left / length, this->Fading) : Vec3{};
}

/// What the contact asks for, with no more stiffness and damping than device and periods bear.
Vec3 ForceGuard::Spring(const Contact& contact, double period, const ForceModel& model,
  const SafetySettings& settings) noexcept
{
  const double plain = this->Stiffener.Update(period, model.Stiffness, settings);
  MaterialLimits limits;
  limits.MaximumForce = model.MaximumForce;
  limits.Damping = settings.DeviceDamping > 0.0
    ? std::max(0.0, LargestShareOfDamping * settings.DeviceDamping - settings.ContactDamping)
    : LargestPassivityDamping;
  const double damping = std::min(contact.Material.Damping, limits.Damping);
  limits.Stiffness = std::min(model.LargestStiffness, this->Stiffener.Allowed(settings, damping));
  if (this->HasExchange && settings.SoftStartTime > 0.0)
  {
    const double longest = LongestStep * settings.NominalPeriod;
    this->Law.NoticeExchange(settings.SoftStartTime, longest,
      std::min(period, longest) * model.MaximumForce / settings.SoftStartTime);
  }
  const Vec3 force = this->Law.Update(contact, period, plain, limits);
  const bool isLimited = contact.Material.IsPlain || !contact.IsTouching() ? plain < model.Stiffness
                                                                           : this->Law.IsLimited();
  this->Limits = (isLimited ? StiffnessLimited : 0u) |
    (this->Law.IsHeldBack() ? EnergyHeldBack : 0u) | (this->Law.IsClamped() ? ForceClamped : 0u);
  return force;
}

Vec3 ForceGuard::Damping(
  const Contact& contact, double period, const SafetySettings& settings) noexcept
{
  // How far the surface moved before it was touched nobody knows.
  const bool knowsSpeed = this->WasTouching && period > 0.0;
  this->LastPosition = contact.Hip;
  this->WasTouching = contact.IsTouching();
  const double depth = Length(contact.Displacement);
  if (settings.ContactDamping <= 0.0 || !contact.IsTouching() || depth == 0.0 || !knowsSpeed)
  {
    this->NormalSpeed = 0.0;
    return {};
  }
  const Vec3 normal = Sum({}, 1.0 / depth, contact.Displacement);
  const double weight = period / (period + SpeedSmoothing);
  this->NormalSpeed += weight * (Dot(this->Step, normal) / period - this->NormalSpeed);
  // A surface pushes and never pulls: damping takes at most the spring's own force away.
  const double pull = this->Law.GetStiffness() * depth;
  return Sum({}, std::max(-settings.ContactDamping * this->NormalSpeed, -pull), normal);
}

Vec3 ForceGuard::LimitSlew(const Vec3& force, const Contact& contact, double step,
  double maximumForce, const SafetySettings& settings) noexcept
{
  const double slewRate = settings.SlewLimit;
  const double softRate = settings.SoftStartTime > 0.0
    ? std::min(slewRate, maximumForce / settings.SoftStartTime)
    : slewRate;
  const bool isStarting = this->SoftTimeLeft > 0.0;
  this->SoftTimeLeft -= isStarting ? step : 0.0; // nor is it over because its first tick was late

  SlewRequest request;
  request.Force = force;
  request.Displacement = contact.IsTouching() ? contact.Displacement : Vec3{};
  request.Step = this->Step;
  request.Stiffness = this->Law.GetStiffness();
  request.Reach = step * (isStarting ? softRate : slewRate);
  request.SoftReach = step * softRate;
  request.RestMotion = isStarting
    ? std::numeric_limits<double>::infinity()
    : step * std::min(RestShare * slewRate + softRate, LargestRestShare * slewRate) /
      request.Stiffness; // infinite without stiffness: nobody asks
  request.IsGiven = this->IsFirst;
  const double depth = Length(request.Displacement);
  if (this->HasJump)
  {
    request.Change = std::numeric_limits<double>::infinity();
  }
  else if (depth > 0.0)
  {
    const double hardened =
      this->Stiffness > 0.0 ? std::max(0.0, request.Stiffness - this->Stiffness) : 0.0;
    if (this->HasExchange)
    {
      request.Change = request.Stiffness * Length(contact.SurfaceDisplacement) + hardened * depth;
    }
    // Surfaces with properties pay for theirs themselves.
    else if (contact.Material.IsPlain && this->WasPlain)
    {
      request.Hardening = hardened;
    }
  }
  this->Stiffness = depth > 0.0 ? request.Stiffness : 0.0;
  this->WasPlain = contact.Material.IsPlain;

  const Vec3 limited = this->Slew.Limit(request);
  if (this->Slew.IsLimiting())
  {
    this->Limits |= isStarting || this->Slew.IsSoft() ? SoftStarted : ForceSlewed;
  }
  return limited;
}
}
