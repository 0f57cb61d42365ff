#include "Comparison.h"

#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "Oracle.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr double Depth = 2e-7; // [m], deeper than any method's clearance
/// A point farther off than this has lost its history: it is put back.
constexpr double Lost = 5e-3;    // [m]
constexpr double PutBack = 1e-5; // [m] in front of the oracle's point

double Degrees(const Vec3& a, const Vec3& b)
{
  const double scale = Length(a) * Length(b);
  const double cosine = scale > 0.0 ? Dot(a, b) / scale : -1.0;
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / M_PI;
}
}

Stroke MakeReference(const TriangleMesh& mesh, std::vector<Vec3> hips)
{
  Stroke stroke;
  stroke.Surface = MakeSurface(mesh, Side::Front, EngineKind::Embree);
  stroke.Hips = std::move(hips);
  Oracle oracle(stroke.Surface);
  oracle.Place(stroke.Hips.front());
  Vec3 before = stroke.Hips.front();
  Vec3 hipBefore = before;
  int slipped = 0;
  for (const Vec3& hip : stroke.Hips)
  {
    const Vec3 right = oracle.Update(hip);
    const bool slips = Length(right - before) > 4.0 * Length(hip - hipBefore) + 1e-4;
    slipped = slips ? 3 : std::max(slipped - 1, 0);
    stroke.Right.push_back(right);
    stroke.Counts.push_back(slipped == 0 && Length(right - hip) > 2e-4);
    before = right;
    hipBefore = hip;
  }
  return stroke;
}

void Samples::Add(const Samples& other)
{
  this->Contacts += other.Contacts;
  this->Leaks += other.Leaks;
  this->Singular += other.Singular;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from)
  { to.insert(to.end(), from.begin(), from.end()); };
  append(this->Position, other.Position);
  append(this->Direction, other.Direction);
  append(this->Magnitude, other.Magnitude);
  append(this->Times, other.Times);
}

void AddSample(Samples& samples, const Vec3& hip, const Vec3& held, const Vec3& right)
{
  ++samples.Contacts;
  samples.Position.push_back(Length(held - right));
  samples.Direction.push_back(Degrees(held - hip, right - hip));
  samples.Magnitude.push_back(std::abs(Length(held - hip) / Length(right - hip) - 1.0));
}

Samples Compare(ContactMethod& method, const Stroke& stroke, int replays)
{
  Samples samples;
  const ExactQueries exact(stroke.Surface);
  const std::size_t ticks = stroke.Hips.size();
  std::vector<char> isPutBack(ticks, false);
  const auto placeBack = [&](std::size_t tick)
  {
    const Vec3 away = stroke.Right[tick] - stroke.Hips[tick];
    method.Place(
      Length(away) > 0.0 ? stroke.Right[tick] + PutBack * Unit(away) : stroke.Right[tick]);
  };

  method.Place(stroke.Hips.front());
  bool wasLost = false;
  for (std::size_t tick = 0; tick < ticks; ++tick)
  {
    const Vec3& hip = stroke.Hips[tick];
    const Vec3& right = stroke.Right[tick];
    const Vec3 held = method.Update(hip);
    const double error = Length(held - right);
    bool isLost = false;
    if (stroke.Counts[tick])
    {
      AddSample(samples, hip, held, right);
      const Vec3 local = held - stroke.Surface->Origin();
      isLost = samples.Direction.back() > 90.0 ||
        (error > Depth && exact.IsInside(local) && exact.Distance(local) > Depth);
    }
    samples.Leaks += isLost && !wasLost;
    wasLost = isLost;
    if (isLost || error > Lost)
    {
      placeBack(tick);
      isPutBack[tick] = true;
    }
  }
  samples.Singular = method.SingularSolves();

  samples.Times = TimesOf(method, stroke.Hips, replays,
    [&](std::size_t tick)
    {
      if (isPutBack[tick])
      {
        placeBack(tick);
      }
    });
  return samples;
}

std::vector<double> TimesOf(ContactMethod& method, const std::vector<Vec3>& hips, int replays,
  const std::function<void(std::size_t)>& afterTick)
{
  using Clock = std::chrono::steady_clock;
  std::vector<double> times(hips.size(), HUGE_VAL);
  for (int replay = 0; replay < replays; ++replay)
  {
    method.Forget();
    method.Place(hips.front());
    for (std::size_t tick = 0; tick < hips.size(); ++tick)
    {
      const auto before = Clock::now();
      method.Update(hips[tick]);
      const std::chrono::duration<double, std::micro> time = Clock::now() - before;
      times[tick] = std::min(times[tick], time.count());
      afterTick(tick);
    }
  }
  return times;
}
}
