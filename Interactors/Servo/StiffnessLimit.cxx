#include "haptics/Servo/StiffnessLimit.h"

#include <algorithm>
#include <limits>

namespace haptics
{
namespace
{
constexpr double Memory = 1.0; // [s]
}

void StiffnessLimit::Restart(double nominalPeriod) noexcept
{
  this->NominalPeriod = nominalPeriod;
  this->MeanPeriod = nominalPeriod;
  this->MeanSquaredPeriod = nominalPeriod * nominalPeriod;
  this->Stiffness = -1.0;
}

double StiffnessLimit::Allowed(const SafetySettings& settings, double surfaceDamping) const noexcept
{
  if (settings.DeviceDamping <= 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  // Damping by the servo takes from what the mechanics have for the spring: b > K T / 2 + |B|.
  const double damping =
    std::max(0.0, settings.DeviceDamping - settings.ContactDamping - surfaceDamping);
  const double halfPeriod = 0.5 * this->MeanSquaredPeriod / this->MeanPeriod;
  return settings.StiffnessMargin * damping / (halfPeriod + settings.DeviceLatency);
}

double StiffnessLimit::Update(double period, double wanted, const SafetySettings& settings) noexcept
{
  const double weight = std::min(1.0, this->NominalPeriod / Memory);
  this->MeanPeriod += weight * (period - this->MeanPeriod);
  this->MeanSquaredPeriod += weight * (period * period - this->MeanSquaredPeriod);

  const double target = std::min(wanted, this->Allowed(settings));
  const bool rises = this->Stiffness >= 0.0 && target > this->Stiffness;
  if (rises && settings.SoftStartTime > 0.0)
  {
    const double rise = target * std::min(1.0, this->NominalPeriod / settings.SoftStartTime);
    this->Stiffness = std::min(target, this->Stiffness + rise);
  }
  else
  {
    this->Stiffness = target;
  }
  return this->Stiffness;
}
}
