#include "haptics/Devices/Simulated/SimulatedBody.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
// A tenth of a second of delay and jitter at 10 kHz.
constexpr std::size_t MostPending = 1024;
// An axis that turns and sticks more often than this within one interval is at rest.
constexpr int MostEvents = 32;
constexpr int MostIterations = 60;

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix Multiply(const Matrix& a, const Matrix& b) noexcept
{
  Matrix product{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        product[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return product;
}

/// e^m: Taylor's series of m / 2^n, squared n times.
Matrix Exponential(Matrix m) noexcept
{
  double norm = 0.0;
  for (const auto& row : m)
  {
    norm = std::max(norm, std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
  }
  const int squarings = norm > 0.25 ? std::ilogb(norm) + 3 : 0;
  for (auto& row : m)
  {
    for (double& element : row)
    {
      element = std::ldexp(element, -squarings);
    }
  }
  // Horner: 1 + m (1 + m/2 (1 + m/3 (...))); below a norm of 1/4 the 13th term is under 1e-17.
  constexpr int Terms = 13;
  constexpr Matrix Identity{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  Matrix sum = Identity;
  for (int term = Terms; term > 0; --term)
  {
    sum = Multiply(m, sum);
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        sum[i][j] = sum[i][j] / term + Identity[i][j];
      }
    }
  }
  for (int i = 0; i < squarings; ++i)
  {
    sum = Multiply(sum, sum);
  }
  return sum;
}
}

SimulatedBody::SimulatedBody(const BodyParameters& parameters)
  : Parameters(parameters)
  , Pending(MostPending)
{
}

void SimulatedBody::Place(double time, const DevicePoint& position) noexcept
{
  this->Time = time;
  this->Target = position;
  for (std::size_t i = 0; i < 3; ++i)
  {
    this->Axes[i] = { position[i], 0.0 };
  }
  this->Force = {};
  this->NumberPending = 0;
  this->Seed = 1;
}

DevicePoint SimulatedBody::GetPosition() const noexcept
{
  return { this->Axes[0].Position, this->Axes[1].Position, this->Axes[2].Position };
}

std::array<double, 3> SimulatedBody::GetVelocity() const noexcept
{
  return { this->Axes[0].Velocity, this->Axes[1].Velocity, this->Axes[2].Velocity };
}

DevicePoint SimulatedBody::GetMeasuredPosition() const noexcept
{
  DevicePoint position = this->GetPosition();
  const double step = this->Parameters.EncoderResolution;
  if (step > 0.0)
  {
    for (double& coordinate : position)
    {
      coordinate = step * std::round(coordinate / step);
    }
  }
  return position;
}

/// Evenly spread in [0, 1): SplitMix64 (Steele, Lea and Flood 2014), the same in every run.
double SimulatedBody::Random() noexcept
{
  std::uint64_t z = (this->Seed += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

void SimulatedBody::Ask(const std::array<double, 3>& force) noexcept
{
  const double length = std::hypot(force[0], force[1], force[2]);
  std::array<double, 3> given = force;
  if (length > this->Parameters.MaximumForce)
  {
    for (double& component : given)
    {
      component *= this->Parameters.MaximumForce / length;
    }
  }
  double time = this->Time + this->Parameters.Delay;
  if (this->Parameters.Jitter > 0.0)
  {
    time += this->Parameters.Jitter * this->Random();
  }
  const auto slot = [this](std::size_t i) -> PendingForce&
  { return this->Pending[(this->FirstPending + i) % this->Pending.size()]; };
  if (this->NumberPending > 0)
  {
    time = std::max(time, slot(this->NumberPending - 1).Time); // forces do not overtake each other
  }
  if (this->NumberPending == this->Pending.size())
  {
    --this->NumberPending; // the newest of too many replaces the one before it
  }
  slot(this->NumberPending) = { time, given };
  ++this->NumberPending;
}

void SimulatedBody::Advance(double time, const DevicePoint& target) noexcept
{
  const double startTime = this->Time;
  const DevicePoint start = this->Target;
  std::array<double, 3> speed{};
  for (std::size_t i = 0; i < 3 && time > startTime; ++i)
  {
    speed[i] = (target[i] - start[i]) / (time - startTime);
  }
  while (this->NumberPending > 0 && this->Pending[this->FirstPending].Time <= time)
  {
    const PendingForce& next = this->Pending[this->FirstPending];
    this->Hold(std::max(next.Time, this->Time), start, startTime, speed);
    this->Force = next.Force;
    this->FirstPending = (this->FirstPending + 1) % this->Pending.size();
    --this->NumberPending;
  }
  this->Hold(time, start, startTime, speed);
  this->Time = time;
  this->Target = target;
}

void SimulatedBody::Hold(double until, const DevicePoint& start, double startTime,
  const std::array<double, 3>& targetSpeed) noexcept
{
  const double duration = until - this->Time;
  if (duration > 0.0)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double target = start[i] + targetSpeed[i] * (this->Time - startTime);
      this->AdvanceAxis(this->Axes[i], { this->Force[i], target, targetSpeed[i] }, duration);
    }
    this->Time = until;
  }
}

/// With y the offset from the target and s the direction of motion:
///     m y'' = F - b v_t - s f_c - k y - (b + c) y'      k, c: the hand's, v_t: the target's speed
SimulatedBody::Matrix SimulatedBody::Transition(double duration) const noexcept
{
  const BodyParameters& p = this->Parameters;
  return Exponential({ { { 0.0, duration, 0.0 },
    { -p.HandStiffness / p.Mass * duration, -(p.Damping + p.HandDamping) / p.Mass * duration,
      duration },
    { 0.0, 0.0, 0.0 } } });
}

const SimulatedBody::Matrix& SimulatedBody::CachedTransition(double duration) noexcept
{
  if (duration != this->CachedDuration)
  {
    this->Cached = this->Transition(duration);
    this->CachedDuration = duration;
  }
  return this->Cached;
}

SimulatedBody::Axis SimulatedBody::Move(const Axis& axis, const Input& input,
  const Matrix& transition, double direction, double duration) const noexcept
{
  const BodyParameters& p = this->Parameters;
  const double y = axis.Position - input.Target;
  const double rate = axis.Velocity - input.TargetSpeed;
  const double acceleration =
    (input.Force - p.Damping * input.TargetSpeed - direction * p.CoulombFriction) / p.Mass;
  const auto row = [&](std::size_t i)
  { return transition[i][0] * y + transition[i][1] * rate + transition[i][2] * acceleration; };
  return { input.Target + input.TargetSpeed * duration + row(0), input.TargetSpeed + row(1) };
}

/// When an axis that goes in `direction` now and against it at the end comes to rest. Bisection,
/// since it cannot fail; about 60 steps give every bit.
double SimulatedBody::TimeOfRest(
  const Axis& axis, const Input& input, double direction, double duration) const noexcept
{
  double before = 0.0;
  double after = duration;
  for (int i = 0; i < MostIterations && before < after; ++i)
  {
    const double middle = 0.5 * (before + after);
    if (middle <= before || middle >= after)
    {
      break;
    }
    const Axis there = this->Move(axis, input, this->Transition(middle), direction, middle);
    (there.Velocity * direction > 0.0 ? before : after) = middle;
  }
  return after;
}

void SimulatedBody::AdvanceAxis(Axis& axis, const Input& input, double duration) noexcept
{
  const BodyParameters& p = this->Parameters;
  if (p.CoulombFriction <= 0.0)
  {
    axis = this->Move(axis, input, this->CachedTransition(duration), 0.0, duration);
    return;
  }
  Input now = input;
  double left = duration;
  const auto pass = [&](double time)
  {
    now.Target += now.TargetSpeed * time;
    left -= time;
  };
  for (int event = 0; event < MostEvents && left > 0.0; ++event)
  {
    double direction = axis.Velocity > 0.0 ? 1.0 : -1.0;
    if (axis.Velocity == 0.0)
    {
      // What pulls at the resting axis; it grows as the target moves away.
      const double pull = now.Force + p.HandStiffness * (now.Target - axis.Position) +
        p.HandDamping * now.TargetSpeed;
      const double growth = p.HandStiffness * now.TargetSpeed;
      direction = pull > 0.0 ? 1.0 : -1.0;
      if (std::abs(pull) <= p.CoulombFriction)
      {
        if (growth == 0.0)
        {
          return;
        }
        direction = growth > 0.0 ? 1.0 : -1.0;
        const double stuck = (direction * p.CoulombFriction - pull) / growth;
        if (stuck >= left)
        {
          return;
        }
        pass(stuck);
      }
    }
    const Axis end = this->Move(axis, now,
      left == duration ? this->CachedTransition(left) : this->Transition(left), direction, left);
    if (end.Velocity * direction >= 0.0)
    {
      axis = end;
      return;
    }
    const double rest = this->TimeOfRest(axis, now, direction, left);
    axis = this->Move(axis, now, this->Transition(rest), direction, rest);
    axis.Velocity = 0.0;
    pass(rest);
  }
  axis.Velocity = 0.0;
}
}
