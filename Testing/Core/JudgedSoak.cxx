#include "JudgedSoak.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <climits>
#include <cstdio>

namespace haptics::testing
{
namespace
{
/// Of each kind of fault so many are printed for a scene and kind of way.
constexpr long MostPrinted = 3;
}

JudgedSoak::JudgedSoak(const SoakOptions& options)
  : Options(options)
{
  PrintHead("scene", options.Seed);
}

void JudgedSoak::PrintHead(const char* first, unsigned seed)
{
  std::printf("%-34s %9s %9s %9s %6s %5s %5s %7s %8s %6s %7s %9s   (seed %u)\n", first, "ticks",
    "contacts", "crossings", "grazes", "gaps", "away", "phantom", "pressed", "stuck", "balance",
    "overloads", seed);
}

void JudgedSoak::Print(const std::string& name, const TrialCount& count)
{
  std::printf("%-34s %9ld %9ld %9ld %6ld %5ld %5ld %7ld %8ld %6ld %7ld %9ld\n", name.c_str(),
    count.Ticks, count.Contacts, count[Fault::Crossing], count[Fault::Graze], count[Fault::Gap],
    count[Fault::Away], count[Fault::Phantom], count.Presses, count[Fault::Stuck],
    count[Fault::Balance], count.Unanswered);
  std::fflush(stdout);
}

bool JudgedSoak::IsGood(const TrialCount& count)
{
  return count[Fault::Crossing] == 0 && count[Fault::Gap] == 0 && count[Fault::Away] == 0 &&
    count[Fault::Phantom] == 0 && count[Fault::Stuck] * 10000 <= std::max(count.Presses, 10000L);
}

void JudgedSoak::PrintFaults(Trial& trial, std::string name, const unsigned& episode, long most)
{
  trial.OnFault = [&trial, &episode, name = std::move(name), most](const Finding& f)
  {
    if (trial.Count()[f.What] > most || f.What == Fault::Graze || f.What == Fault::Balance)
    {
      return;
    }
    std::printf("%s  %s, episode %u, tick %ld, surface %d, triangle %d, share %.3g\n"
                "  from { %.17g, %.17g, %.17g } to { %.17g, %.17g, %.17g } "
                "HIP { %.17g, %.17g, %.17g }\n",
      NameOf(f.What), name.c_str(), episode, trial.Count().Ticks, f.Part, f.Triangle, f.Share,
      f.From[0], f.From[1], f.From[2], f.To[0], f.To[1], f.To[2], f.Hip[0], f.Hip[1], f.Hip[2]);
  };
}

void JudgedSoak::RunKind(const std::string& scene, const std::vector<TouchedSurface>& surfaces,
  const std::vector<Trial::Part>& parts, SurfacePath& path, SurfacePath::Kind kind,
  TrialCount& count)
{
  GodObjectFollower god(surfaces);
  GodObjectFollower probe(surfaces);
  Trial::Settings settings = Trial::SettingsOf(surfaces);
  settings.Seed = this->Options.Seed;
  settings.PressEvery = this->Options.PressEvery;
  Trial trial(parts, god, probe, settings);
  const bool isReplay = this->Options.Episode >= 0;
  unsigned episode =
    isReplay ? static_cast<unsigned>(this->Options.Episode) : 1000003u * this->Options.Seed;
  PrintFaults(
    trial, scene + ", " + SurfacePath::NameOf(kind), episode, isReplay ? LONG_MAX : MostPrinted);
  long strokes = 0;
  do
  {
    const std::vector<Vec3> way = path.Make(kind, episode);
    const bool isPlaced = trial.Place(way.front());
    for (std::size_t tick = 0; isPlaced && tick < way.size(); ++tick)
    {
      trial.Tick(way[tick]);
      if (isReplay)
      {
        const Vec3& p = trial.Position();
        std::printf("  %zu: HIP { %.17g, %.17g, %.17g } god-object { %.17g, %.17g, %.17g }\n", tick,
          way[tick][0], way[tick][1], way[tick][2], p[0], p[1], p[2]);
      }
    }
    ++episode;
    ++strokes;
  } while (!isReplay && trial.Count().Ticks < this->Options.Ticks && strokes < this->Options.Ticks);
  count += trial.Count();
  this->OfKinds[kind] += trial.Count();
}

void JudgedSoak::Run(const std::string& scene, const std::vector<TouchedSurface>& surfaces)
{
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  const std::vector<Trial::Part> parts = Trial::PartsOf(surfaces);
  for (const Trial::Part& part : parts)
  {
    const auto first = static_cast<std::int32_t>(points.size());
    for (const Vec3& p : part.Surface->Points())
    {
      points.push_back(p + part.Offset);
    }
    for (const auto& [a, b, c] : part.Surface->Triangles())
    {
      triangles.push_back({ first + a, first + b, first + c });
    }
  }
  SurfacePath path(std::move(points), std::move(triangles));
  TrialCount count;
  for (int k = 0; k < SurfacePath::NumberOfKinds; ++k)
  {
    const auto kind = static_cast<SurfacePath::Kind>(k);
    if (this->Options.Kind.empty() || this->Options.Kind == SurfacePath::NameOf(kind))
    {
      this->RunKind(scene, surfaces, parts, path, kind, count);
    }
  }
  Print(scene, count);
  this->All += count;
}

bool JudgedSoak::Finish()
{
  Print("all", this->All);
  std::printf("\n");
  PrintHead("kind of way", this->Options.Seed);
  for (const auto& [kind, count] : this->OfKinds)
  {
    Print(SurfacePath::NameOf(kind), count);
  }
  return IsGood(this->All);
}
}
