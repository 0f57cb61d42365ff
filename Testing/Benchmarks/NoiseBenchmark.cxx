// The force on a resting hand from its own noise, by a point and by balls.
#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "FirstHit.h"
#include "HandNoise.h"
#include "RandomVectors.h"
#include "Statistics.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
const char* const Help = R"(Measures the force on a resting hand from its own noise.

HapticsNoiseBenchmark [--surfaces FOLDER] [--places N] [--seed N]

A hand comes to random places of a surface as large as in the hand (radius 50 mm), 2 mm deep, and
holds still for a second, at 500 N/m: with tremor of 50 um on each axis (8 to 12 Hz) and coordinates
rounded to 55 um. Surfaces: sphere, rough ball, and those of FOLDER (default build/surfaces).

Prints CSV: surface, radius of the tip [mm] (0: a point), places in contact, mean of the force [N], of
its standard deviation [mN], of the gain (that deviation over that of a spring to a point that stays;
0.58 on a plane), 95th percentile of the gain, share of places with a gain over 2 [%], and the mean of
the deviation of the force's change from tick to tick [mN].
)";

constexpr double Hand = 0.05;   // [m]
constexpr double Depth = 0.002; // [m]
constexpr double Radii[] = { 0.0, 0.5e-3, 1e-3, 3e-3 };

TriangleMesh MakeMesh(const std::string& folder, const std::string& name)
{
  return name == "sphere" ? Icosphere(5, Hand)
    : name == "rough"     ? Star(6, Hand, 0.03, 4)
                          : ReadSurface(folder, name, Hand);
}

void Measure(const std::string& name, const std::shared_ptr<const TriangleSurface>& surface,
  double radius, int places, unsigned seed)
{
  std::mt19937 random(seed);
  GodObject ray({ surface });
  std::vector<double> forces, deviations, gains, steps;
  for (int i = 0; i < places; ++i)
  {
    Vec3 outwards = Unit(NormalVector(random));
    Vec3 top = 2.0 * Hand * outwards;
    Vec3 bottom{};
    if (name == "fault") // a terrain, from above
    {
      bottom = { 0.5 * Hand * outwards[0], 0.5 * Hand * outwards[1], -2.0 * Hand };
      top = { bottom[0], bottom[1], 2.0 * Hand };
      outwards = { 0.0, 0.0, 1.0 };
    }
    const double way = FirstHit(ray, top, bottom);
    if (way >= Length(bottom - top))
    {
      continue; // through a hole
    }
    const Vec3 touched = top - way * outwards;
    const RestingForce rest = Rest(surface, touched + (0.01 + radius) * outwards,
      touched + (radius - Depth) * outwards, radius, RestingHand, seed + static_cast<unsigned>(i));
    if (rest.IsTouching)
    {
      forces.push_back(rest.Mean);
      deviations.push_back(1e3 * rest.Deviation);
      gains.push_back(rest.Gain);
      steps.push_back(1e3 * rest.Step);
    }
  }
  if (gains.empty())
  {
    return;
  }
  const auto loud = std::count_if(gains.begin(), gains.end(), [](double g) { return g > 2.0; });
  std::printf("%s,%g,%zu,%.3f,%.2f,%.3f,%.3f,%.1f,%.2f\n", name.c_str(), 1e3 * radius, gains.size(),
    Mean(forces), Mean(deviations), Mean(gains), Quantile(gains, 0.95),
    100.0 * static_cast<double>(loud) / static_cast<double>(gains.size()), Mean(steps));
  std::fflush(stdout);
}
}

int main(int argc, char** argv)
{
  std::string folder = "build/surfaces";
  int places = 200;
  unsigned seed = 1;
  for (int i = 1; i < argc; i += 2)
  {
    const std::string word = argv[i];
    if (word == "--help" || i + 1 == argc)
    {
      std::fputs(Help, word == "--help" ? stdout : stderr);
      return word == "--help" ? 0 : 2;
    }
    if (word == "--surfaces")
    {
      folder = argv[i + 1];
    }
    else if (word == "--places" || word == "--seed")
    {
      const int number = std::atoi(argv[i + 1]);
      if (number < 1)
      {
        std::fprintf(stderr, "%s needs a whole number above 0.\n", argv[i]);
        return 2;
      }
      places = word == "--places" ? number : places;
      seed = word == "--seed" ? static_cast<unsigned>(number) : seed;
    }
    else
    {
      std::fprintf(stderr, "There is no option %s. --help says how it is used.\n", argv[i]);
      return 2;
    }
  }
  std::printf("surface,radius,places,force,deviation,gain,gain_p95,loud,step\n");
  for (const char* const name : { "sphere", "rough", "fault", "pial", "t13", "gearbox", "wing" })
  {
    TriangleMesh mesh = MakeMesh(folder, name);
    if (mesh.Triangles.empty())
    {
      continue; // ReadSurface has said so
    }
    std::string error;
    const auto surface = TriangleSurface::Build(std::move(mesh), SurfaceOptions(), error);
    if (!surface)
    {
      std::fprintf(stderr, "%s could not be built: %s\n", name, error.c_str());
      return 1;
    }
    for (const double radius : Radii)
    {
      Measure(name, surface, radius, places, seed);
    }
  }
  return 0;
}
