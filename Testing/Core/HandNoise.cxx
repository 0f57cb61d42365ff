#include "HandNoise.h"

#include "AnalyticSurfaces.h"

#include <cmath>
#include <random>

namespace haptics::testing
{
namespace
{
constexpr double Stiffness = 500.0; // [N/m]
constexpr int TicksToCome = 200;
constexpr int TicksAtRest = 1000;

/// sqrt(E|x - E x|^2).
double DeviationOf(const std::vector<Vec3>& values)
{
  const auto count = static_cast<double>(values.size());
  Vec3 mean{};
  for (const Vec3& v : values)
  {
    mean = mean + (1.0 / count) * v;
  }
  double sum = 0.0;
  for (const Vec3& v : values)
  {
    sum += Dot(v - mean, v - mean);
  }
  return std::sqrt(sum / count);
}
}

std::vector<Vec3> HoldStill(const Vec3& place, const HandNoise& noise, int ticks, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0.0, 2.0 * M_PI);
  std::uniform_real_distribution<double> frequency(8.0, 12.0);
  Vec3 phases{};
  Vec3 frequencies{};
  for (int k = 0; k < 3; ++k)
  {
    phases[k] = phase(random);
    frequencies[k] = frequency(random);
  }
  std::vector<Vec3> hips;
  for (int i = 0; i < ticks; ++i)
  {
    Vec3 hip = place;
    for (int k = 0; k < 3; ++k)
    {
      hip[k] += noise.Tremor * std::sin(2e-3 * M_PI * frequencies[k] * i + phases[k]);
      hip[k] = noise.Encoder > 0.0 ? noise.Encoder * std::round(hip[k] / noise.Encoder) : hip[k];
    }
    hips.push_back(hip);
  }
  return hips;
}

RestingForce Rest(const std::shared_ptr<const TriangleSurface>& surface, const Vec3& from,
  const Vec3& place, double radius, const HandNoise& noise, unsigned seed)
{
  GodObject god({ surface }, radius > 0.0 ? Tip::Ball : Tip::Point);
  god.SetTipRadius(radius);
  god.Place(from);
  const std::vector<Vec3> hips = HoldStill(place, noise, TicksToCome + TicksAtRest, seed);
  std::vector<Vec3> forces;
  std::vector<Vec3> steps;
  std::vector<Vec3> places;
  RestingForce rest;
  rest.IsTouching = true;
  for (std::size_t i = 0; i < hips.size(); ++i)
  {
    // The way there, then as long to settle as it took.
    const double s = std::min(1.0, 2.0 * static_cast<double>(i) / TicksToCome);
    const Contact& contact = god.Update(hips[i] + (1.0 - s) * (from - place));
    if (i >= TicksToCome)
    {
      const Vec3 force = Stiffness * contact.Displacement;
      if (!forces.empty())
      {
        steps.push_back(force - forces.back());
      }
      forces.push_back(force);
      places.push_back(hips[i]);
      rest.IsTouching = rest.IsTouching && contact.IsTouching();
      rest.Mean += Length(force) / TicksAtRest;
    }
  }
  rest.Deviation = DeviationOf(forces);
  rest.Step = DeviationOf(steps);
  rest.Gain = rest.Deviation / (Stiffness * DeviationOf(places));
  return rest;
}
}
