// One stroke over one surface: what a tick costs in time, and by callgrind in instructions.
#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "FirstHit.h"
#include "Statistics.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
const char* const Help = R"(Times a stroke over a surface, tick by tick.

HapticsStrokeBenchmark SURFACE STROKE [--engine NAME] [--both] [--ticks N] [--repeat N]
                       [--surfaces FOLDER]

SURFACE  sphereL    20 * 4^L triangles, R = 1 m (L = 8: 1.3 million, 9: 5.2 million)
         noiseL     the same, its points pulled in by up to an edge's length: rough
         starL      the same, its points pulled in by up to 10 cm: spikes
         NAME       a real surface of FOLDER (default build/surfaces), scaled to R = 1 m
STROKE   slide      20 mm deep, 1 mm a tick          fast     20 mm deep, 4 mm a tick
         wander     20 mm deep, 2 to 6 mm a tick, turning at random
         plunge     from 60 mm above to 70 mm below at 5 mm a tick, and back, at random places
         near       1 mm above, 1 mm a tick          above    20 mm above, 1 mm a tick
         hold       20 mm deep, at rest but for a tremor of 55 um
--engine Automatic (default), BruteForce or Embree
--both   both sides of the surface can be touched
--ticks  of one stroke (default 10000)
--repeat strokes, each with a new god-object (default 9): the medians of their figures are printed

Prints: surface, stroke, engine in use, triangles, bytes a triangle, seconds to build; the mean,
median, 99th and 99.9th percentile and longest time of a tick [us]; the share of ticks in contact;
and a sum over the bits of all places of the god-object, by which answers are compared.

Instructions a tick, exact and repeatable, without those of making surface and stroke:
  valgrind --tool=callgrind --toggle-collect=RunTicks HapticsStrokeBenchmark sphere8 slide --repeat 1
)";

struct Options
{
  std::string Surface;
  std::string Stroke;
  std::string Folder = "build/surfaces";
  EngineKind Engine = EngineKind::Automatic;
  Side TouchedSide = Side::Front;
  int Ticks = 10000;
  int Repeat = 9;
};

[[noreturn]] void Fail(const std::string& why)
{
  std::fprintf(stderr, "%s. --help says how it is used.\n", why.c_str());
  std::exit(2);
}

const char* const EngineNames[] = { "Automatic", "BruteForce", "Embree", "Exact" };

EngineKind EngineByName(const std::string& name)
{
  for (const EngineKind kind :
    { EngineKind::Automatic, EngineKind::BruteForce, EngineKind::Embree })
  {
    if (name == EngineNames[static_cast<int>(kind)])
    {
      return kind;
    }
  }
  Fail("There is no engine " + name);
}

int Positive(const std::string& text)
{
  const int number = std::atoi(text.c_str());
  return number > 0 ? number : (Fail("'" + text + "' is not a number above 0"), 0);
}

Options Read(int argc, char** argv)
{
  Options options;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string
    { return i + 1 < argc ? argv[++i] : (Fail(word + " needs a value"), ""); };
    if (word == "--help")
    {
      std::fputs(Help, stdout);
      std::exit(0);
    }
    else if (word == "--engine")
    {
      options.Engine = EngineByName(value());
    }
    else if (word == "--both")
    {
      options.TouchedSide = Side::Both;
    }
    else if (word == "--ticks")
    {
      options.Ticks = Positive(value());
    }
    else if (word == "--repeat")
    {
      options.Repeat = Positive(value());
    }
    else if (word == "--surfaces")
    {
      options.Folder = value();
    }
    else
    {
      names.push_back(word);
    }
  }
  if (names.size() != 2)
  {
    Fail("A surface and a stroke are needed");
  }
  options.Surface = names[0];
  options.Stroke = names[1];
  return options;
}

/// The length of an edge of Icosphere(level, 1), about.
double EdgeLength(int level)
{
  return 1.1 * std::ldexp(1.0, -level);
}

TriangleMesh MakeMesh(const Options& options)
{
  const std::string& name = options.Surface;
  const int level = name.empty() ? 0 : name.back() - '0';
  const std::string shape = name.substr(0, name.size() - 1);
  if (level >= 0 && level <= 9)
  {
    if (shape == "sphere")
    {
      return Icosphere(level, 1.0);
    }
    if (shape == "noise")
    {
      return Star(level, 1.0, EdgeLength(level), 1);
    }
    if (shape == "star")
    {
      return Star(level, 1.0, 0.1, 1);
    }
  }
  TriangleMesh mesh = ReadSurface(options.Folder, name, 1.0);
  return mesh.Triangles.empty() ? (Fail("There is no surface " + name), mesh) : mesh;
}

Vec3 RandomDirection(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return Unit({ normal(random), normal(random), normal(random) });
}

std::vector<Vec3> MakePath(
  const Options& options, const std::shared_ptr<const TriangleSurface>& surface)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  GodObject ray({ surface });
  const double far = 2.0 * surface->Radius();
  const auto height = [&](const Vec3& outwards) {
    return far - FirstHit(ray, far * outwards, { 0, 0, 0 });
  };
  const bool isSphere = options.Surface.rfind("sphere", 0) == 0;
  double smoothed = 1.0;
  const auto at = [&](const Vec3& outwards, double above)
  {
    // Smoothed, as a hand does not jump into a hole.
    smoothed += isSphere ? 1.0 - smoothed : 0.02 * (height(outwards) - smoothed);
    return (smoothed + above) * outwards;
  };
  Vec3 u = Unit(Cross({ 0.3, 0.5, 0.81 }, { 0, 0, 1 }));
  Vec3 v = Unit(Cross({ 0.3, 0.5, 0.81 }, u));
  const auto turn = [&](double step)
  {
    const Vec3 from = u;
    u = Unit(u + step * v);
    v = Unit(v - step * from);
  };
  std::vector<Vec3> hips;
  const std::size_t ticks = static_cast<std::size_t>(options.Ticks);
  const std::string& stroke = options.Stroke;
  const bool isSteady = stroke == "slide" || stroke == "fast" || stroke == "near" ||
    stroke == "above" || stroke == "hold";
  if (!isSteady && stroke != "wander" && stroke != "plunge")
  {
    Fail("There is no stroke " + stroke);
  }
  while (hips.size() < ticks)
  {
    if (isSteady)
    {
      const double step = stroke == "fast" ? 4e-3 : stroke == "hold" ? 0.0 : 1e-3;
      const double above = stroke == "near" ? 1e-3 : stroke == "above" ? 20e-3 : -20e-3;
      turn(step);
      const Vec3 tremor = (stroke == "hold" ? 55e-6 : 0.0) * RandomDirection(random);
      hips.push_back(at(u, above) + tremor);
    }
    else if (stroke == "wander")
    {
      const double angle = 0.6 * (uniform(random) - 0.5);
      v = Unit(std::cos(angle) * v + std::sin(angle) * Cross(u, v));
      turn(2e-3 + 4e-3 * uniform(random));
      hips.push_back(at(u, -20e-3));
    }
    else
    {
      const Vec3 outwards = RandomDirection(random);
      smoothed = isSphere ? 1.0 : height(outwards);
      for (double above = 60e-3; above > -70e-3; above -= 5e-3)
      {
        hips.push_back((smoothed + above) * outwards);
      }
      for (double above = -70e-3; above < 60e-3; above += 5e-3)
      {
        hips.push_back((smoothed + above) * outwards);
      }
    }
  }
  hips.resize(ticks);
  return hips;
}
}

/// What callgrind looks at. Times are left empty under it.
extern "C" __attribute__((noinline)) void RunTicks(GodObject& god, const std::vector<Vec3>& hips,
  std::vector<double>& times, std::vector<Contact>& contacts)
{
  using Clock = std::chrono::steady_clock;
  for (std::size_t i = 0; i < hips.size(); ++i)
  {
    const auto before = Clock::now();
    contacts[i] = god.Update(hips[i]);
    times[i] = std::chrono::duration<double, std::micro>(Clock::now() - before).count();
  }
}

int main(int argc, char** argv)
{
  const Options options = Read(argc, argv);
  TriangleMesh mesh = MakeMesh(options);
  SurfaceOptions built;
  built.TouchedSide = options.TouchedSide;
  built.Engine = options.Engine;
  std::string error;
  const auto before = std::chrono::steady_clock::now();
  const std::shared_ptr<const TriangleSurface> surface =
    TriangleSurface::Build(std::move(mesh), built, error);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
  if (!surface)
  {
    Fail("The surface could not be built: " + error);
  }
  const std::vector<Vec3> hips = MakePath(options, surface);
  std::vector<double> figures[5];
  std::vector<double> times(hips.size());
  std::vector<Contact> contacts(hips.size());
  std::uint64_t sum = 0;
  long touching = 0;
  for (int i = 0; i < options.Repeat; ++i)
  {
    GodObject god({ surface });
    god.Update(1.2 * hips[0]);
    RunTicks(god, hips, times, contacts);
    figures[0].push_back(Mean(times));
    const double quantiles[] = { 0.5, 0.99, 0.999, 1.0 };
    for (int k = 0; k < 4; ++k)
    {
      figures[1 + k].push_back(Quantile(times, quantiles[k]));
    }
  }
  for (const Contact& contact : contacts)
  {
    touching += contact.Status == UpdateStatus::Touching;
    for (const double x : contact.Position)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &x, sizeof(bits));
      sum = 31 * sum + bits;
    }
  }
  std::printf("%s,%s,%s,%zu,%.1f,%.3f", options.Surface.c_str(), options.Stroke.c_str(),
    EngineNames[static_cast<int>(surface->Engine().Kind())], surface->Triangles().size(),
    static_cast<double>(surface->MemoryBytes()) / static_cast<double>(surface->Triangles().size()),
    seconds.count());
  for (std::vector<double>& figure : figures)
  {
    std::printf(",%.3f", Quantile(figure, 0.5));
  }
  std::printf(",%.4f,%016llx\n", static_cast<double>(touching) / static_cast<double>(hips.size()),
    static_cast<unsigned long long>(sum));
  return 0;
}
