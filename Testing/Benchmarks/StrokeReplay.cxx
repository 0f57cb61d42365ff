// Replays strokes over surfaces: what a tick costs in time, and under callgrind in instructions.
//
// It uses only what this project's core has had from its early days on, under either of the paths
// that its headers have had, so that contact.sh can build it against other commits.
#include "Callgrind.h"

#if __has_include("haptics/Contact/GodObject.h")
#include "haptics/Contact/GodObject.h"
#else
#include "GodObject.h"
#endif
#if __has_include("haptics/Math/LargePages.h")
#include "haptics/Math/LargePages.h"
#define HAPTICS_HAS_LARGE_PAGES
#endif

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>

using namespace haptics;

namespace
{
const char* const Help = R"(Replays strokes that HapticsStrokeBenchmark --save has made.

HapticsStrokeReplay SURFACES [--both]

SURFACES  a file of surfaces; standard output says how many triangles they have, the bytes a
          triangle of their snapshots, and how long these took to build [s]
--both    both sides of the surfaces can be touched

Then reads commands from standard input, one a line, and answers each with a line:
stroke FILE   takes the stroke of a file; answers with the number of its ticks
run           goes through the stroke with a new god-object
run cold      the same, with 16 MB of other memory read before each tick
report        the mean, median, 99th and 99.9th percentile and longest time of a tick [us], and the
              share of ticks in contact; the time of a tick is the median of its runs
answers FILE  writes the places of the god-object
)";

[[noreturn]] void Fail(const std::string& why)
{
  std::fprintf(stderr, "HapticsStrokeReplay: %s.\n", why.c_str());
  std::exit(2);
}

template <class T>
std::vector<T> ReadVector(std::istream& file)
{
  std::uint64_t count = 0;
  file.read(reinterpret_cast<char*>(&count), sizeof(count));
  std::vector<T> values;
#ifdef HAPTICS_HAS_LARGE_PAGES // as vtkGodObjectFilter makes them
  ReserveLargePages(values, file ? count : 0);
#endif
  values.resize(file ? count : 0);
  file.read(
    reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
  if (!file)
  {
    Fail("a file ends early");
  }
  return values;
}

using Surfaces = std::vector<TouchedSurface>;

Surfaces BuildSurfaces(const std::string& path, Side side)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    Fail("cannot read " + path);
  }
  std::vector<TriangleMesh> meshes;
  while (file.peek() != std::ifstream::traits_type::eof())
  {
    TriangleMesh mesh;
    mesh.Points = ReadVector<Vec3>(file);
    mesh.Triangles = ReadVector<Triangle>(file);
    meshes.push_back(std::move(mesh));
  }
  SurfaceOptions options;
  options.TouchedSide = side;
  Surfaces surfaces;
  double triangles = 0.0;
  double bytes = 0.0;
  const auto before = std::chrono::steady_clock::now();
  for (TriangleMesh& mesh : meshes)
  {
    std::string error;
    const auto surface = TriangleSurface::Build(std::move(mesh), options, error);
    if (!surface)
    {
      Fail(error);
    }
    triangles += static_cast<double>(surface->Triangles().size());
    bytes += static_cast<double>(surface->MemoryBytes());
    surfaces.emplace_back(surface);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - before;
  std::printf("%.0f %.1f %.3f\n", triangles, bytes / triangles, seconds.count());
  return surfaces;
}

/// Reads so much of other memory that a core's own caches hold nothing else.
class CacheFlush
{
public:
  void Run()
  {
    for (std::size_t i = 0; i < this->Memory.size(); i += 8)
    {
      this->Sum = this->Sum + this->Memory[i];
    }
  }

private:
  std::vector<std::uint64_t> Memory = std::vector<std::uint64_t>(std::size_t(2) << 20, 1);
  volatile std::uint64_t Sum = 0;
};

double Quantile(std::vector<float>& values, double quantile)
{
  const auto nth =
    values.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

class Replay
{
public:
  explicit Replay(Surfaces surfaces)
    : Scene(std::move(surfaces))
  {
  }

  void Take(const std::string& path)
  {
    std::ifstream file(path, std::ios::binary);
    if (!file)
    {
      Fail("cannot read " + path);
    }
    this->Hips = ReadVector<Vec3>(file);
    this->Runs.clear();
    std::printf("%zu\n", this->Hips.size());
  }

  void Run(bool isCold)
  {
    using Clock = std::chrono::steady_clock;
    GodObject god(this->Scene);
    const Vec3& first = this->Hips.front();
    god.Update({ 1.2 * first[0], 1.2 * first[1], 1.2 * first[2] });
    std::vector<float> times(this->Hips.size());
    this->Places.resize(this->Hips.size());
    this->Contacts = 0;
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
    for (std::size_t i = 0; i < this->Hips.size(); ++i)
    {
      if (isCold)
      {
        this->Flush.Run();
      }
      const auto before = Clock::now();
      const Contact& contact = god.Update(this->Hips[i]);
      const std::chrono::duration<float, std::micro> time = Clock::now() - before;
      times[i] = time.count();
      this->Places[i] = contact.Position;
      this->Contacts += contact.Status == UpdateStatus::Touching;
    }
    CALLGRIND_DUMP_STATS_AT("ticks");
    CALLGRIND_STOP_INSTRUMENTATION;
    this->Runs.push_back(std::move(times));
    std::printf("done\n");
  }

  void Report()
  {
    std::vector<float> ticks(this->Hips.size());
    std::vector<float> runs(this->Runs.size());
    for (std::size_t i = 0; i < ticks.size(); ++i)
    {
      std::transform(this->Runs.begin(), this->Runs.end(), runs.begin(),
        [i](const std::vector<float>& times) { return times[i]; });
      ticks[i] = static_cast<float>(Quantile(runs, 0.5));
    }
    const double count = static_cast<double>(ticks.size());
    std::printf("%.4f %.4f %.4f %.4f %.4f %.4f\n",
      std::accumulate(ticks.begin(), ticks.end(), 0.0) / count, Quantile(ticks, 0.5),
      Quantile(ticks, 0.99), Quantile(ticks, 0.999), Quantile(ticks, 1.0),
      static_cast<double>(this->Contacts) / count);
  }

  void Write(const std::string& path)
  {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(this->Places.data()),
      static_cast<std::streamsize>(this->Places.size() * sizeof(Vec3)));
    std::printf("%s\n", file.flush() ? "done" : "failed");
  }

private:
  Surfaces Scene;
  CacheFlush Flush;
  std::vector<Vec3> Hips;
  std::vector<Vec3> Places; ///< of the last run
  long Contacts = 0;
  std::vector<std::vector<float>> Runs; ///< times of ticks [us]
};
}

int main(int argc, char** argv)
{
  const std::string first = argc > 1 ? argv[1] : "--help";
  if (first == "--help")
  {
    std::fputs(Help, stdout);
    return argc > 1 ? 0 : 2;
  }
  const bool isBoth = argc > 2 && std::string(argv[2]) == "--both";
  if (argc > (isBoth ? 3 : 2))
  {
    Fail("--help says how it is used");
  }
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  Replay replay(BuildSurfaces(first, isBoth ? Side::Both : Side::Front));
  std::string line;
  while (std::getline(std::cin, line))
  {
    std::istringstream words(line);
    std::string command;
    std::string argument;
    words >> command >> argument;
    if (command == "stroke")
    {
      replay.Take(argument);
    }
    else if (command == "run")
    {
      replay.Run(argument == "cold");
    }
    else if (command == "report")
    {
      replay.Report();
    }
    else if (command == "answers")
    {
      replay.Write(argument);
    }
    else
    {
      Fail("there is no command " + line);
    }
  }
  return 0;
}
