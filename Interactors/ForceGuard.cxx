#include "ForceGuard.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
double Dot(const Vec3& a, const Vec3& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double Length(const Vec3& v) noexcept
{
  return std::hypot(v[0], v[1], v[2]);
}

/// a + s b
Vec3 Sum(const Vec3& a, double s, const Vec3& b) noexcept
{
  return { a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2] };
}

// An encoder's steps divided by a millisecond are not a velocity; so much [s] makes one of them.
constexpr double SpeedSmoothing = 0.005;
// What desktop devices can damp without shaking [N s/m]: Touch 4, Premium 5, Falcon 20.
constexpr double LargestPassivityDamping = 4.0;
// Of the device's damping; what a surface's own takes is missing for its stiffness.
constexpr double LargestShareOfDamping = 0.5;
// After a late tick the force may not make up for all of the time that has passed.
constexpr double LongestStep = 2.0; // nominal periods
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
  const bool isPlain = contact.Felt.IsPlain;
  const bool isTouching = contact.IsTouching();
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
  }
  this->WasPaused = settings.Paused;

  force = this->LimitSlew(force, period, model.MaximumForce, settings);
  this->Passivity.Sent(force, contact.Carried);
  this->Last = force;
  return force;
}

/// What the contact asks for, with no more stiffness and damping than device and periods bear.
Vec3 ForceGuard::Spring(const Contact& contact, double period, const ForceModel& model,
  const SafetySettings& settings) noexcept
{
  const double plain = this->Stiffener.Update(period, model.Stiffness, settings);
  FeelLimits limits;
  limits.MaximumForce = model.MaximumForce;
  limits.Damping = settings.DeviceDamping > 0.0
    ? std::max(0.0, LargestShareOfDamping * settings.DeviceDamping - settings.ContactDamping)
    : LargestPassivityDamping;
  const double damping = std::min(contact.Felt.Damping, limits.Damping);
  limits.Stiffness = std::min(model.LargestStiffness, this->Stiffener.Allowed(settings, damping));
  const Vec3 force = this->Law.Update(contact, period, plain, limits);
  const bool isLimited =
    contact.Felt.IsPlain || !contact.IsTouching() ? plain < model.Stiffness : this->Law.IsLimited();
  this->Limits = (isLimited ? StiffnessLimited : 0u) |
    (this->Law.IsHeldBack() ? EnergyHeldBack : 0u) | (this->Law.IsClamped() ? ForceClamped : 0u);
  return force;
}

Vec3 ForceGuard::Damping(
  const Contact& contact, double period, const SafetySettings& settings) noexcept
{
  // Against the surface, which may move; how far it did before it was touched nobody knows.
  const Vec3 step = Sum(Sum(contact.Hip, -1.0, this->LastPosition), -1.0, contact.Carried);
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
  this->NormalSpeed += weight * (Dot(step, normal) / period - this->NormalSpeed);
  // A surface pushes and never pulls: damping takes at most the spring's own force away.
  const double pull = this->Law.GetStiffness() * depth;
  return Sum({}, std::max(-settings.ContactDamping * this->NormalSpeed, -pull), normal);
}

Vec3 ForceGuard::LimitSlew(
  const Vec3& force, double period, double maximumForce, const SafetySettings& settings) noexcept
{
  // Nor is a soft start over because its first tick was late.
  const double step = std::min(period, LongestStep * settings.NominalPeriod);
  double rate = settings.SlewLimit;
  SafetyLimit cause = ForceSlewed;
  if (this->SoftTimeLeft > 0.0)
  {
    const double softRate = maximumForce / settings.SoftStartTime;
    if (softRate < rate)
    {
      rate = softRate;
      cause = SoftStarted;
    }
    this->SoftTimeLeft -= step;
  }

  const double squaredLast = Dot(this->Last, this->Last);
  const double share =
    squaredLast > 0.0 ? std::clamp(Dot(force, this->Last) / squaredLast, 0.0, 1.0) : 0.0;
  const Vec3 nearest = Sum({}, share, this->Last);
  const Vec3 change = Sum(force, -1.0, nearest);
  const double length = Length(change);
  const double reach = rate * step;
  if (length <= reach)
  {
    return force;
  }
  this->Limits |= cause;
  return Sum(nearest, reach / length, change);
}
}
