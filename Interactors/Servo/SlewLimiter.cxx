#include "haptics/Servo/SlewLimiter.h"

#include "haptics/Math/Vec3Operations.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// A hand is at rest if it was so for some 35 ticks: a swing turns in fewer.
constexpr double MotionKept = 0.98;

/// What the hand gets back from a depth when `withheld` stays so: the force is K d up to `force`,
/// and that much from there on, less what is withheld.
double StoredEnergy(double depth, double force, double stiffness, double withheld) noexcept
{
  const double peak = std::min(force, stiffness * depth);
  const double rest = peak - withheld;
  return rest > 0.0 ? rest * (0.5 * rest / stiffness + depth - peak / stiffness) : 0.0;
}

/// As near to `wanted` as `reach` lets it come from the line between zero and `last`.
Vec3 Grow(const Vec3& last, const Vec3& wanted, double reach) noexcept
{
  const double squared = Dot(last, last);
  const double share = squared > 0.0 ? std::clamp(Dot(wanted, last) / squared, 0.0, 1.0) : 0.0;
  const Vec3 nearest = Sum({}, share, last);
  const Vec3 change = Sum(wanted, -1.0, nearest);
  const double length = std::sqrt(Dot(change, change));
  return length <= reach ? wanted : Sum(nearest, reach / length, change);
}
}

Vec3 SlewLimiter::Limit(const SlewRequest& request) noexcept
{
  const double depth = std::sqrt(Dot(request.Displacement, request.Displacement));
  if (!(depth > 0.0) || !(request.Stiffness > 0.0) || !std::isfinite(depth * request.Stiffness))
  {
    const Vec3 force = Grow(this->Last, request.Force, request.Reach);
    this->Restart();
    this->Limiting = force != request.Force;
    this->Last = force;
    return force;
  }

  const Vec3 normal = Sum({}, 1.0 / depth, request.Displacement);
  const double along = std::max(0.0, Dot(request.Force, normal));
  this->Withheld = std::min(this->Withheld, along);
  const double before = this->Withheld;
  const double motion = std::max(MotionKept * this->Motion, std::abs(Dot(request.Step, normal)));
  this->Motion = std::min(motion, 2.0 * request.RestMotion);
  const double growth = along - this->Withheld - Dot(this->Last, normal);
  this->Withheld += std::clamp(growth, 0.0, request.Hardening * depth);
  this->GiveBack(request, along, depth);
  const bool hasChanged = request.Change > request.SoftReach;
  this->Soft = this->Soft || hasChanged;

  const Vec3 wanted = Sum(request.Force, -this->Withheld, normal);
  const Vec3 force = Grow(this->Last, wanted, this->Soft ? request.SoftReach : request.Reach);
  this->Withheld = std::clamp(this->Withheld + Dot(Sum(wanted, -1.0, force), normal), 0.0, along);
  this->Soft = this->Soft && force != request.Force;

  const double stored = StoredEnergy(depth, along, request.Stiffness, this->Withheld);
  const double missing = StoredEnergy(depth, along, request.Stiffness, 0.0) - stored;
  // What surfaces do by changing is their own work.
  const bool isGiven = hasChanged || request.IsGiven;
  const double pressed = -0.5 * Dot(Sum(this->Last, 1.0, force), request.Step);
  this->Credit =
    isGiven ? missing : std::clamp(this->Credit + pressed - (stored - this->Stored), 0.0, missing);
  this->Limiting = before > 0.0 || force != request.Force;
  this->Stored = stored;
  this->Last = force;
  return force;
}

/// What is withheld comes back as fast as the limit allows where that is paid for, else softly.
void SlewLimiter::GiveBack(const SlewRequest& request, double along, double depth) noexcept
{
  if (this->Withheld <= 0.0)
  {
    return;
  }
  const double now = StoredEnergy(depth, along, request.Stiffness, this->Withheld);
  const auto cost = [&](double withheld)
  { return StoredEnergy(depth, along, request.Stiffness, withheld) - now; };
  const double fast = std::max(0.0, this->Withheld - request.Reach);
  const double slow = std::max(0.0, this->Withheld - request.SoftReach);
  if (!this->Soft && cost(fast) <= this->Credit)
  {
    this->Withheld = fast;
    return;
  }
  const double price = cost(slow);
  const double means = this->Motion < request.RestMotion ? price : this->Credit;
  this->Withheld -= (this->Withheld - slow) * (price > means ? means / price : 1.0);
}
}
