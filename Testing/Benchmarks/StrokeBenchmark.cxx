// One stroke over one surface: what a tick costs in time, and by callgrind in instructions.
#include "AnalyticSurfaces.h"
#include "HandStrokes.h"
#include "Statistics.h"
#include "haptics/Contact/GodObject.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
const char* const Help = R"(Times a stroke over a surface, tick by tick.

HapticsStrokeBenchmark SURFACE STROKE [--engine NAME] [--both] [--tip R] [--ticks N] [--repeat N]
                       [--surfaces FOLDER]
HapticsStrokeBenchmark SURFACE STROKE,STROKE... --save FOLDER [--both] [--ticks N]

%s--engine Automatic (default), BruteForce or Embree
--both   both sides of the surface can be touched
--tip    the radius of a ball in place of the point [m]; the stroke is as much higher. Where a surface
         is 100 mm across in the hand, 0.02 is a tip of 1 mm
--ticks  of one stroke (default 10000)
--surfaces where real surfaces are (default build/surfaces)
--save   times nothing: leaves the surface and its strokes in FOLDER, for HapticsStrokeReplay
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
  std::string SaveFolder;
  EngineKind Engine = EngineKind::Automatic;
  Side TouchedSide = Side::Front;
  double Tip = 0.0;
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
      std::printf(Help, HandStrokesHelp);
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
    else if (word == "--tip")
    {
      const std::string radius = value();
      options.Tip = std::atof(radius.c_str());
      if (!(options.Tip > 0.0))
      {
        Fail("'" + radius + "' is not a radius above 0");
      }
    }
    else if (word == "--ticks")
    {
      options.Ticks = Positive(value());
    }
    else if (word == "--repeat")
    {
      options.Repeat = Positive(value());
    }
    else if (word == "--save")
    {
      options.SaveFolder = value();
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

HandSurfaces Build(std::vector<TriangleMesh> meshes, const Options& options)
{
  SurfaceOptions built;
  built.TouchedSide = options.TouchedSide;
  built.Engine = options.Engine;
  HandSurfaces surfaces;
  for (TriangleMesh& mesh : meshes)
  {
    std::string error;
    surfaces.push_back(TriangleSurface::Build(std::move(mesh), built, error));
    if (!surfaces.back())
    {
      Fail("The surface could not be built: " + error);
    }
  }
  return surfaces;
}

std::vector<Vec3> MakeStroke(
  const Options& options, const std::string& stroke, const HandSurfaces& surfaces)
{
  std::vector<Vec3> hips =
    MakeHandStroke(stroke, options.Surface, surfaces, options.Ticks, options.Tip);
  return hips.empty() ? (Fail("There is no stroke " + stroke), hips) : hips;
}

template <class T>
void Write(std::ofstream& file, const std::vector<T>& values)
{
  const std::uint64_t count = values.size();
  file.write(reinterpret_cast<const char*>(&count), sizeof(count));
  file.write(
    reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

/// As StrokeReplay.cxx reads them.
void Save(const Options& options, std::vector<TriangleMesh> meshes)
{
  std::ofstream surface(options.SaveFolder + "/" + options.Surface, std::ios::binary);
  for (const TriangleMesh& mesh : meshes)
  {
    Write(surface, mesh.Points);
    Write(surface, mesh.Triangles);
  }
  const HandSurfaces surfaces = Build(std::move(meshes), options);
  std::istringstream strokes(options.Stroke);
  bool isWritten = static_cast<bool>(surface.flush());
  for (std::string stroke; std::getline(strokes, stroke, ',');)
  {
    std::ofstream file(options.SaveFolder + "/" + stroke, std::ios::binary);
    Write(file, MakeStroke(options, stroke, surfaces));
    isWritten = isWritten && file.flush();
  }
  if (!isWritten)
  {
    Fail("The files could not be written to " + options.SaveFolder);
  }
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
  std::vector<TriangleMesh> meshes = MakeHandSurfaces(options.Surface, options.Folder);
  if (meshes.empty())
  {
    return 2;
  }
  if (!options.SaveFolder.empty())
  {
    Save(options, std::move(meshes));
    return 0;
  }
  const auto before = std::chrono::steady_clock::now();
  const HandSurfaces surfaces = Build(std::move(meshes), options);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
  const std::vector<Vec3> hips = MakeStroke(options, options.Stroke, surfaces);
  double triangles = 0.0;
  double bytes = 0.0;
  for (const auto& surface : surfaces)
  {
    triangles += static_cast<double>(surface->Triangles().size());
    bytes += static_cast<double>(surface->MemoryBytes());
  }
  std::vector<double> figures[5];
  std::vector<double> times(hips.size());
  std::vector<Contact> contacts(hips.size());
  std::uint64_t sum = 0;
  long touching = 0;
  for (int i = 0; i < options.Repeat; ++i)
  {
    GodObject god({ surfaces.begin(), surfaces.end() }, options.Tip > 0.0 ? Tip::Ball : Tip::Point);
    god.SetTipRadius(options.Tip);
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
  std::printf("%s,%s,%s,%.0f,%.1f,%.3f", options.Surface.c_str(), options.Stroke.c_str(),
    EngineNames[static_cast<int>(surfaces.front()->Engine().Kind())], triangles, bytes / triangles,
    seconds.count());
  for (std::vector<double>& figure : figures)
  {
    std::printf(",%.3f", Quantile(figure, 0.5));
  }
  std::printf(",%.4f,%016llx\n", static_cast<double>(touching) / static_cast<double>(hips.size()),
    static_cast<unsigned long long>(sum));
  return 0;
}
