#include "JudgedBallSoak.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace haptics::testing
{
namespace
{
/// Shares of the surface's radius, which stands for 50 mm in the hand: tips of 0.5, 1 and 3 mm.
constexpr double Radii[] = { 0.01, 0.02, 0.06 };
constexpr long MostPrinted = 3;

void PrintHead(const char* first, unsigned seed)
{
  std::printf("%-34s %9s %9s %9s %8s %9s %5s %8s %7s %6s %8s %9s   (seed %u)\n", first, "ticks",
    "contacts", "pieces", "overlaps", "crossings", "away", "rests", "phantom", "stuck", "shrunk",
    "overloads", seed);
}

void Print(const std::string& name, const BallCount& count)
{
  std::printf("%-34s %9ld %9ld %9ld %8ld %9ld %5ld %8ld %7ld %6ld %8ld %9ld\n", name.c_str(),
    count.Ticks, count.Contacts, count.Pieces, count.Overlaps, count.Crossings, count.Away,
    count.Rests, count.Phantoms, count.Stuck, count.Shrunk, count.Overloads);
  std::fflush(stdout);
}

SurfacePath PathOver(const std::vector<TouchedSurface>& surfaces)
{
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (const TouchedSurface& touched : surfaces)
  {
    const TriangleSurface& surface = *touched.Surface;
    const auto first = static_cast<std::int32_t>(points.size());
    for (const Vec3& p : surface.Points())
    {
      points.push_back(p + (surface.Origin() - surfaces.front().Surface->Origin()));
    }
    for (const auto& [a, b, c] : surface.Triangles())
    {
      triangles.push_back({ first + a, first + b, first + c });
    }
  }
  return { std::move(points), std::move(triangles) };
}
}

JudgedBallSoak::JudgedBallSoak(const SoakOptions& options)
  : Options(options)
  , OfKinds(SurfacePath::NumberOfKinds)
{
  PrintHead("scene", options.Seed);
}

BallCount JudgedBallSoak::RunKind(const std::string& scene,
  const std::vector<TouchedSurface>& surfaces, SurfacePath& path, SurfacePath::Kind kind,
  double share)
{
  double size = 0.0;
  for (const TouchedSurface& touched : surfaces)
  {
    size = std::max(size, touched.Surface->Radius());
  }
  BallTrial trial(surfaces, share * size, this->Options.PressEvery);
  unsigned episode = this->Options.Episode >= 0 ? static_cast<unsigned>(this->Options.Episode)
                                                : 1000003u * this->Options.Seed;
  std::map<std::string, long> printed;
  trial.OnFault = [&](const char* what, const Vec3& from, const Vec3& to, const Vec3& hip)
  {
    if (printed[what]++ < MostPrinted)
    {
      std::printf("%s  %s, %s, radius %.3g, episode %u, tick %ld\n"
                  "  from { %.17g, %.17g, %.17g } to { %.17g, %.17g, %.17g } "
                  "HIP { %.17g, %.17g, %.17g } ball %.17g\n",
        what, scene.c_str(), SurfacePath::NameOf(kind), share * size, episode, trial.Count().Ticks,
        from[0], from[1], from[2], to[0], to[1], to[2], hip[0], hip[1], hip[2],
        trial.God().BallRadius());
    }
  };
  long strokes = 0;
  do
  {
    const std::vector<Vec3> way = path.Make(kind, episode);
    trial.Place(way.front());
    for (const Vec3& hip : way)
    {
      trial.Tick(hip);
    }
    ++episode;
    ++strokes;
  } while (this->Options.Episode < 0 && trial.Count().Ticks < this->Options.Ticks &&
    strokes < this->Options.Ticks);
  return trial.Count();
}

void JudgedBallSoak::Run(const std::string& scene, const std::vector<TouchedSurface>& surfaces)
{
  SurfacePath path = PathOver(surfaces);
  BallCount count;
  for (int k = 0; k < SurfacePath::NumberOfKinds; ++k)
  {
    const auto kind = static_cast<SurfacePath::Kind>(k);
    if (!this->Options.Kind.empty() && this->Options.Kind != SurfacePath::NameOf(kind))
    {
      continue;
    }
    for (const double share : Radii)
    {
      const BallCount one = this->RunKind(scene, surfaces, path, kind, share);
      count += one;
      this->OfKinds[static_cast<std::size_t>(k)] += one;
    }
  }
  Print(scene, count);
  this->All += count;
}

bool JudgedBallSoak::Finish()
{
  Print("all", this->All);
  std::printf("\n");
  PrintHead("kind of way", this->Options.Seed);
  for (int k = 0; k < SurfacePath::NumberOfKinds; ++k)
  {
    Print(SurfacePath::NameOf(static_cast<SurfacePath::Kind>(k)),
      this->OfKinds[static_cast<std::size_t>(k)]);
  }
  return this->All.IsGood();
}
}
