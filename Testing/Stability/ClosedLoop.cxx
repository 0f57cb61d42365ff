#include "ClosedLoop.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
ClosedLoop::ClosedLoop(ContactMethod& method, const BodyParameters& body)
  : Method(method)
  , Parameters(body)
  , Body(body)
{
}

void ClosedLoop::Place(const Vec3& position)
{
  this->Body.Place(0.0, position);
  this->Method.Place(position);
  this->Force = {};
  this->Work = 0.0;
  this->Lost = 0.0;
  this->Ticks.clear();
  this->Pull(position);
}

void ClosedLoop::Pull(const Vec3& target)
{
  this->Target = [target](double) { return target; };
}

void ClosedLoop::Run(int ticks)
{
  for (int i = 0; i < ticks; ++i)
  {
    const double time = this->Body.GetTime();
    const Vec3 hip = this->Body.GetMeasuredPosition();
    const Vec3 held = this->Method.Update(hip);
    Vec3 force = this->Stiffness * (held - hip);
    this->Ticks.push_back({ time, hip, held, force, this->Work, this->Lost });
    const double length = Length(force);
    if (length > this->Parameters.MaximumForce)
    {
      force = (this->Parameters.MaximumForce / length) * force;
    }
    this->Body.Ask(force);
    const Vec3 before = this->Body.GetPosition();
    this->Body.Advance(time + this->Period, this->Target(time + this->Period));
    const Vec3 moved = this->Body.GetPosition() - before;
    this->Work += Dot(force, moved);
    // Not less than this, whatever the motion in between (Cauchy and Schwarz).
    this->Lost += this->Parameters.Damping * Dot(moved, moved) / this->Period +
      this->Parameters.CoulombFriction *
        (std::abs(moved[0]) + std::abs(moved[1]) + std::abs(moved[2]));
  }
}

double PressedScene::Formula() const
{
  double sum = 0.0;
  double squares = 0.0;
  for (const double period : this->Periods)
  {
    sum += period;
    squares += period * period;
  }
  return this->Damping / (0.5 * squares / sum + this->Delay);
}

namespace
{
/// Whether a surface of that stiffness shakes ever more when a body at rest is nudged.
bool Shakes(const PressedScene& scene, double stiffness)
{
  constexpr double Depth = 1e-3;        // [m]
  constexpr double HandStiffness = 0.1; // [N/m], pulled far: a force that does not depend on place
  const double formula = scene.Formula();
  const double late = scene.Damping / formula;
  BodyParameters body;
  body.Damping = scene.Damping;
  body.Mass = scene.Damping * late / (0.5 * scene.Share);
  body.MaximumForce = 1e4;
  body.Delay = scene.Delay;
  body.HandStiffness = HandStiffness;
  body.HandDamping = 0.0;
  const MethodPointer method = scene.Make();
  ClosedLoop loop(*method, body);
  loop.Place(scene.Start);

  // Energy decays or grows by about a factor e in so many ticks at a tenth off the boundary.
  double mean = 0.0;
  for (const double period : scene.Periods)
  {
    mean += period / scene.Periods.size();
  }
  const int ticks = static_cast<int>(20.0 / scene.Share * late / mean);
  std::size_t next = 0;
  const auto run = [&](int count)
  {
    loop.Ticks.clear();
    for (int i = 0; i < count; ++i)
    {
      loop.Period = scene.Periods[next++ % scene.Periods.size()];
      loop.Run(1);
    }
  };
  const auto swing = [&](int count)
  {
    run(count);
    Vec3 low = loop.Ticks.front().Hip;
    Vec3 high = low;
    for (const LoopTick& tick : loop.Ticks)
    {
      for (int k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], tick.Hip[k]);
        high[k] = std::max(high[k], tick.Hip[k]);
      }
    }
    return Length(high - low);
  };
  const auto press = [&](double hardness, const Vec3& direction)
  {
    loop.Stiffness = hardness;
    loop.Pull(scene.Start + (hardness * Depth / HandStiffness) * direction);
  };

  // At rest on a soft surface; then stiffness and push grow together, so that it stays at rest.
  press(0.05 * formula, scene.Direction);
  run(6 * ticks);
  press(stiffness, scene.Direction + 0.01 * scene.Nudge);
  const double first = swing(2 * ticks);
  run(2 * ticks);
  const double last = swing(2 * ticks);
  return last >= first || last > 0.2 * Depth;
}
}

double MeasuredBoundary(const PressedScene& scene)
{
  const double formula = scene.Formula();
  double still = 0.1;
  double shaking = 1.5;
  if (Shakes(scene, still * formula))
  {
    return 0.0;
  }
  if (!Shakes(scene, shaking * formula))
  {
    return shaking;
  }
  while (shaking - still > 0.005)
  {
    const double middle = 0.5 * (still + shaking);
    (Shakes(scene, middle * formula) ? shaking : still) = middle;
  }
  return still;
}
}
