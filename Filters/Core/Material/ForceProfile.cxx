#include "haptics/Material/ForceProfile.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
std::shared_ptr<const ForceProfile> ForceProfile::Build(
  const std::vector<double>& forces, double range, std::string& error)
{
  error.clear();
  if (forces.size() < 2)
  {
    error = "a force profile needs at least two forces, and has " + std::to_string(forces.size());
    return nullptr;
  }
  if (!std::isfinite(range) || range <= 0.0)
  {
    error = "the range of a force profile has to be finite and above 0 m, and is " +
      std::to_string(range);
    return nullptr;
  }
  for (std::size_t i = 0; i < forces.size(); ++i)
  {
    if (!std::isfinite(forces[i]) || forces[i] < 0.0)
    {
      error = "force " + std::to_string(i) + " of a force profile is " + std::to_string(forces[i]) +
        " N; it has to be finite and not below 0";
      return nullptr;
    }
  }
  if (forces[0] != 0.0)
  {
    error = "a force profile has to begin with 0 N at 0 m, and begins with " +
      std::to_string(forces[0]) + " N";
    return nullptr;
  }
  std::shared_ptr<ForceProfile> profile(new ForceProfile);
  profile->Step = range / static_cast<double>(forces.size() - 1);
  profile->Nodes.reserve(forces.size());
  profile->Nodes.push_back({ 0.0, 0.0 });
  for (std::size_t i = 1; i < forces.size(); ++i)
  {
    const double slope = (forces[i] - forces[i - 1]) / profile->Step;
    profile->Steepest = std::max(profile->Steepest, slope);
    profile->LastSlope = std::max(slope, 0.0);
    profile->Nodes.push_back({ forces[i],
      profile->Nodes.back().Energy + 0.5 * (forces[i] + forces[i - 1]) * profile->Step });
  }
  return profile;
}

double ForceProfile::Force(double depth) const noexcept
{
  const double x = depth / this->Step;
  const std::size_t last = this->Nodes.size() - 1;
  if (!(x < static_cast<double>(last)))
  {
    return this->Nodes[last].Force +
      this->LastSlope * (depth - this->Step * static_cast<double>(last));
  }
  const auto i = static_cast<std::size_t>(x);
  const double share = x - static_cast<double>(i);
  return this->Nodes[i].Force + share * (this->Nodes[i + 1].Force - this->Nodes[i].Force);
}

double ForceProfile::Energy(double depth) const noexcept
{
  const std::size_t last = this->Nodes.size() - 1;
  const double x = depth / this->Step;
  const std::size_t i = x < static_cast<double>(last) ? static_cast<std::size_t>(x) : last;
  const double rest = depth - this->Step * static_cast<double>(i);
  return this->Nodes[i].Energy + 0.5 * (this->Nodes[i].Force + this->Force(depth)) * rest;
}
}
