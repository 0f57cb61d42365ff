// Moves a god-object over surfaces that break methods, on random ways about the origin and on ways
// that seek what is hard on a surface, and has an exact judge say of every tick whether it crosses
// a triangle, is held by nothing or is stuck. Prints tables; exits with 1 where the judge finds
// fault, or the pull of a HIP stays unanswered. `--help` says how to run it for long, or one
// stroke again.
#include "AnalyticSurfaces.h"
#include "HipPath.h"
#include "JudgedSoak.h"
#include "SoakOptions.h"
#include "SoakScenes.h"
#include "Trial.h"
#include "haptics/Contact/GodObject.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// Takes from `pull` what the normals span, one after another (Gram-Schmidt).
/// `lastPushes`: the last normal's share is against the pull.
double Remainder(const Vec3& pull, const std::vector<Vec3>& normals, bool& lastPushes)
{
  std::vector<Vec3> basis;
  Vec3 rest = pull;
  for (const Vec3& n : normals)
  {
    Vec3 direction = n;
    for (const Vec3& b : basis)
    {
      direction = direction - Dot(direction, b) * b;
    }
    direction = Unit(direction);
    const double share = Dot(rest, direction);
    lastPushes = share <= 0.0;
    rest = rest - share * direction;
    basis.push_back(direction);
  }
  return Length(rest);
}

/// How much of the pull from the god-object to the HIP its constraints leave unanswered, 0 to 1.
/// The multiplier of the last normal has the sign of what Gram-Schmidt leaves along it, so the
/// pull is answered when that holds with each normal put last.
double UnansweredPull(const Contact& contact)
{
  const Vec3 pull = -1.0 * contact.Displacement;
  double best = Length(pull);
  for (int subset = 1; subset < 1 << contact.NumberOfConstraints; ++subset)
  {
    std::vector<Vec3> normals;
    for (int i = 0; i < contact.NumberOfConstraints; ++i)
    {
      if (subset & (1 << i))
      {
        normals.push_back(contact.Constraints[i].Normal);
      }
    }
    double worst = 0.0;
    for (std::size_t last = 0; last < normals.size(); ++last)
    {
      std::rotate(normals.begin(), normals.begin() + 1, normals.end());
      bool pushes = false;
      const double remainder = Remainder(pull, normals, pushes);
      worst = std::max(worst, pushes ? remainder : Length(pull));
    }
    best = std::min(best, worst);
  }
  return best / contact.Penetration;
}

/// What HipPath's ways come to, besides what a judge counts.
class HipPathSoak
{
public:
  explicit HipPathSoak(const SoakOptions& options)
    : Options(options)
  {
    JudgedSoak::PrintHead("scene, ways about the origin", options.Seed);
  }

  void Run(const SoakScene& scene)
  {
    const std::vector<TouchedSurface> surfaces = scene.Make();
    const std::vector<Trial::Part> parts = Trial::PartsOf(surfaces);
    TrialCount count;
    for (int kind = 0; kind < HipPath::NumberOfKinds; ++kind)
    {
      this->RunKind(scene, surfaces, parts, static_cast<HipPath::Kind>(kind), count);
    }
    JudgedSoak::Print(scene.Name, count);
    this->All += count;
  }

  bool Finish() const
  {
    JudgedSoak::Print("all", this->All);
    std::printf("stalls: %ld, twice in a row: %ld\n\n", this->Stalls, this->DoubleStalls);
    return this->DoubleStalls == 0 && this->Stalls * 100000 <= std::max(this->All.Ticks, 100000L) &&
      this->All.Ticks > 0 && JudgedSoak::IsGood(this->All);
  }

private:
  void RunKind(const SoakScene& scene, const std::vector<TouchedSurface>& surfaces,
    const std::vector<Trial::Part>& parts, HipPath::Kind kind, TrialCount& count)
  {
    const unsigned seed = this->Options.Seed + kind;
    GodObjectFollower god(surfaces);
    GodObjectFollower probe(surfaces);
    Trial::Settings settings = Trial::SettingsOf(surfaces);
    settings.PressEvery = this->Options.PressEvery;
    Trial trial(parts, god, probe, settings);
    JudgedSoak::PrintFaults(trial, scene.Name + ", " + HipPath::NameOf(kind), seed);
    HipPath path(kind, scene.Reach, seed);
    const double radius = surfaces.front().Surface->Radius();
    bool stalledBefore = false;
    trial.OnTick = [&](const Vec3& before, const Vec3& now, const Vec3&)
    {
      const Contact& contact = god.God().Current();
      const bool stalled = contact.Status != UpdateStatus::Free &&
        contact.Penetration > 1e-6 * radius && Length(now - before) < 1e-9 * radius &&
        UnansweredPull(contact) > 1e-3;
      this->Stalls += stalled;
      this->DoubleStalls += stalled && stalledBefore;
      stalledBefore = stalled;
    };
    for (long tick = 0; tick < this->Options.Ticks; ++tick)
    {
      const Vec3 hip = path.Next();
      if (tick % 20000 == 0 && trial.Place(hip))
      {
        // A restart, wherever that is: inside is free to leave.
        stalledBefore = false;
      }
      trial.Tick(hip);
    }
    count += trial.Count();
  }

  SoakOptions Options;
  TrialCount All;
  long Stalls = 0;
  long DoubleStalls = 0;
};
}

int main(int argc, char* argv[])
{
  const SoakOptions options = SoakOptions::Parse(argc, argv, 1000, 25000);
  bool good = true;
  if (options.Kind.empty())
  {
    HipPathSoak soak(options);
    for (const SoakScene& scene : AllSoakScenes())
    {
      if (scene.Reach > 0.0 && options.Chooses(scene.Name.c_str()))
      {
        soak.Run(scene);
      }
    }
    good = soak.Finish();
  }
  JudgedSoak soak(options);
  for (const SoakScene& scene : AllSoakScenes())
  {
    if (options.Chooses(scene.Name.c_str()))
    {
      soak.Run(scene.Name, scene.Make());
    }
  }
  good = soak.Finish() && good;
  return good ? 0 : 1;
}
