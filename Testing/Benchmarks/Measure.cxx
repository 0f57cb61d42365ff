// Measures what the charts show and prints it as CSV. charts.sh runs all parts; --help lists them.
#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "Comparison.h"
#include "ExactEngine.h"
#include "MeshToPolyData.h"
#include "MethodList.h"
#include "PaperMethod.h"
#include "ProfileSurfaces.h"
#include "Scenes.h"
#include "Statistics.h"

#include "vtkNew.h"
#include "vtkQuadricDecimation.h"
#include "vtkVersion.h"

#include <CGAL/version_macros.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double SurfaceStiffness = 500.0; // [N/m]
constexpr unsigned Seed = 11;

struct Options
{
  std::string Folder = "build/surfaces";
  bool Full = false;

  int Ticks() const { return this->Full ? 20000 : 2000; }
  int Replays() const { return this->Full ? 5 : 3; }
};

using Clock = std::chrono::steady_clock;

double Milliseconds(Clock::duration time)
{
  return std::chrono::duration<double, std::milli>(time).count();
}

void PrintComparison(const ListedMethod& method, const std::string& surface,
  const std::string& kind, std::size_t triangles, const Samples& s)
{
  const auto& times = s.Times;
  std::printf("\"%s\",%s,\"%s\",%s,%zu,%zu,%ld,%ld,%ld,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,%.3g,"
              "%.4g,%.4g,%.4g,%.4g\n",
    method.Name.c_str(), method.Family.c_str(), surface.c_str(), kind.c_str(), triangles,
    times.size(), s.Contacts, s.Leaks, s.Singular, 1e3 * Quantile(s.Position, 0.5),
    1e3 * Quantile(s.Position, 0.99), 1e3 * Quantile(s.Position, 1.0), Quantile(s.Direction, 0.5),
    Quantile(s.Direction, 0.99), Quantile(s.Direction, 1.0), Quantile(s.Magnitude, 0.99),
    SurfaceStiffness * Quantile(s.Position, 1.0), Mean(times), Quantile(times, 0.5),
    Quantile(times, 0.99), Quantile(times, 0.999));
  std::fflush(stdout);
}

/// Three sizes, over which the charts pool.
const char* SizeClass(std::size_t triangles)
{
  return triangles < 1000 ? "under 1k" : triangles < 10000 ? "1k to 10k" : "over 10k";
}

void MeasureMethods(const Options& options)
{
  std::puts("method,family,surface,kind,triangles,ticks,contacts,leaks,singular,ep_p50_mm,"
            "ep_p99_mm,ep_max_mm,etheta_p50_deg,etheta_p99_deg,etheta_max_deg,ef_p99,"
            "force_error_max_n,mean_us,p50_us,p99_us,p999_us");
  const auto methods = AllMethods();
  struct Pool
  {
    Samples Together;
    std::size_t Triangles = 0; // of the largest
  };
  std::map<std::pair<std::size_t, std::string>, Pool> pools;
  for (const BenchmarkSurface& surface : AllBenchmarkSurfaces(options.Folder))
  {
    const TriangleMesh mesh = surface.Make();
    if (mesh.Triangles.empty())
    {
      continue;
    }
    // Methods that look at every triangle take milliseconds there.
    const int ticks = mesh.Triangles.size() > 100000 ? options.Ticks() / 4 : options.Ticks();
    std::fprintf(stderr, "methods: %s, %zu triangles\n", surface.Name, mesh.Triangles.size());
    const Stroke stroke = MakeReference(mesh, MakeStroke(surface, mesh, ticks, Seed));
    for (std::size_t i = 0; i < methods.size(); ++i)
    {
      if (mesh.Triangles.size() > methods[i].MostTriangles)
      {
        continue;
      }
      const MethodPointer method = methods[i].Make(mesh);
      Samples samples = Compare(*method, stroke, options.Replays());
      PrintComparison(methods[i], surface.Name, surface.Kind, mesh.Triangles.size(), samples);
      if (surface.Strokes == StrokeKind::Edges)
      {
        samples.Times.clear(); // no hand jumps by 10 cm a tick: not a servo's times
      }
      for (const char* const name : { SizeClass(mesh.Triangles.size()), "all" })
      {
        Pool& pool = pools[{ i, name }];
        pool.Together.Add(samples);
        pool.Triangles = std::max(pool.Triangles, mesh.Triangles.size());
      }
    }
  }
  for (const auto& [key, pool] : pools)
  {
    PrintComparison(methods[key.first], key.second, "pooled", pool.Triangles, pool.Together);
  }
}

/// A circle of the HIP 20 mm under the outside of a torus of R = 1 m, tube 0.4 m, 1 mm a tick,
/// winding around the tube as well.
std::vector<Vec3> AroundTorus(int ticks)
{
  std::vector<Vec3> hips;
  for (int tick = 0; tick < ticks; ++tick)
  {
    const double a = 1e-3 * tick / 1.4;
    const double b = 0.3 * std::sin(1.7 * a);
    const double tube = tick == 0 ? 0.42 : 0.38;
    const double r = 1.0 + tube * std::cos(b);
    hips.push_back({ r * std::cos(a), r * std::sin(a), tube * std::sin(b) });
  }
  return hips;
}

TriangleMesh TorusOf(std::size_t triangles)
{
  const int around = std::max(6, static_cast<int>(std::lround(std::sqrt(triangles * 1.75))));
  const int across = std::max(4, static_cast<int>(std::lround(0.5 * triangles / around)));
  return Torus(1.0, 0.4, around, across);
}

void PrintCost(
  const char* method, std::size_t triangles, double making, const std::vector<double>& times)
{
  std::printf("\"%s\",%zu,%zu,%.4g,%.4g,%.4g,%.4g,%.4g\n", method, triangles, times.size(), making,
    Mean(times), Quantile(times, 0.5), Quantile(times, 0.99), Quantile(times, 0.999));
  std::fflush(stdout);
}

void MeasureCost(const Options& options)
{
  std::puts("method,triangles,ticks,making_ms,mean_us,p50_us,p99_us,p999_us");
  const std::set<std::string> drawn = { "nearest surface", "paper",
    "vtkStaticCellLocator, tol 1e-6", "vtkModifiedBSPTree, tol 1e-6", "vtkOBBTree, tol 1e-6",
    "this project, BruteForce", "this project, Embree" };
  for (double size = 100.0; size <= 1.01e7; size *= size < 9e5 ? std::sqrt(10.0) : 10.0)
  {
    // 616 triangles are the paper's Fig. 1.
    for (const double wanted : { size, size > 500.0 && size < 1500.0 ? 616.0 : 0.0 })
    {
      if (wanted == 0.0)
      {
        continue;
      }
      const TriangleMesh mesh =
        wanted == 616.0 ? Torus(1.0, 0.4, 28, 11) : TorusOf(static_cast<std::size_t>(wanted));
      std::fprintf(stderr, "cost: %zu triangles\n", mesh.Triangles.size());
      for (const ListedMethod& method : AllMethods())
      {
        if (!drawn.count(method.Name) || wanted > method.MostTriangles)
        {
          continue;
        }
        const auto start = Clock::now();
        const MethodPointer made = method.Make(mesh);
        const double making = Milliseconds(Clock::now() - start);
        // Of the slowest methods fewer ticks: a thousand are enough for a p99.9.
        const bool isSlow = Quantile(TimesOf(*made, AroundTorus(20), 1), 0.5) > 200.0;
        const int ticks = isSlow ? 1000 : options.Full ? 20000 : 5000;
        PrintCost(method.Name.c_str(), mesh.Triangles.size(), making,
          TimesOf(*made, AroundTorus(ticks), options.Replays()));
      }
    }
  }
}

/// Where looking at every triangle stops being the fastest.
void MeasureEngines(const Options& options)
{
  std::puts("method,triangles,ticks,making_ms,mean_us,p50_us,p99_us,p999_us");
  const std::pair<const char*, EngineKind> engines[] = { { "BruteForce", EngineKind::BruteForce },
    { "Embree", EngineKind::Embree } };
  for (const int across : { 4, 6, 8, 11, 16, 23, 32, 45, 64, 90, 128 })
  {
    const TriangleMesh mesh = Torus(1.0, 0.4, across * 7 / 4, across);
    for (const auto& [name, engine] : engines)
    {
      const auto start = Clock::now();
      const MethodPointer method = MakeWithEngine(mesh, engine);
      const double making = Milliseconds(Clock::now() - start);
      PrintCost(name, mesh.Triangles.size(), making,
        TimesOf(*method, AroundTorus(options.Full ? 50000 : 10000), options.Replays()));
    }
  }
}

TriangleMesh Decimated(const TriangleMesh& mesh, std::size_t triangles)
{
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(ToPolyData(mesh));
  decimation->SetTargetReduction(1.0 - static_cast<double>(triangles) / mesh.Triangles.size());
  decimation->Update();
  return ToMesh(decimation->GetOutput());
}

void PrintDetail(const char* shape, const char* how, std::size_t triangles, const Samples& s)
{
  std::printf("\"%s\",%s,%zu,%ld,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", shape, how, triangles,
    s.Contacts, 1e3 * Quantile(s.Position, 0.5), 1e3 * Quantile(s.Position, 0.95),
    1e3 * Quantile(s.Position, 0.99), Quantile(s.Direction, 0.95), Quantile(s.Direction, 0.99),
    Quantile(s.Magnitude, 0.99));
  std::fflush(stdout);
}

/// The force on a hand 5 mm deep in a sphere of R = 30 mm, against the true sphere.
Samples AgainstSphere(const TriangleMesh& mesh, int ticks)
{
  const double radius = 0.03;
  const MethodPointer method = MakeCertified({ MakeSurface(mesh) });
  HipPath path(HipPath::Smooth, radius, Seed);
  Samples samples;
  method->Place({ 0, 0, 0.05 });
  for (int tick = 0; tick < ticks; ++tick)
  {
    const Vec3 outwards = Unit(path.Next());
    const Vec3 hip = (tick == 0 ? 0.04 : 0.025) * outwards;
    const Vec3 held = method->Update(hip);
    if (tick > 100)
    {
      AddSample(samples, hip, held, radius * outwards);
    }
  }
  return samples;
}

/// A coarse surface against the oracle of the fine one. The god-object is never put back: where the
/// fine one stands may be inside the coarse one.
Samples AgainstFine(const TriangleMesh& coarse, const Stroke& stroke)
{
  const MethodPointer method = MakeCertified({ MakeSurface(coarse, Side::Front) });
  method->Place(stroke.Hips.front());
  Samples samples;
  for (std::size_t tick = 0; tick < stroke.Hips.size(); ++tick)
  {
    const Vec3& hip = stroke.Hips[tick];
    const Vec3 held = method->Update(hip);
    if (stroke.Counts[tick])
    {
      AddSample(samples, hip, held, stroke.Right[tick]);
    }
  }
  return samples;
}

/// Real surfaces have folds into which a deep press falls, or not, by a hair [m].
constexpr double LightTouch = 0.002;

void MeasureDetail(const Options& options)
{
  std::puts("shape,how,triangles,contacts,ep_p50_mm,ep_p95_mm,ep_p99_mm,etheta_p95_deg,"
            "etheta_p99_deg,ef_p99");
  const int ticks = options.Full ? 20000 : 6000;
  for (int level = 1; level <= 7; ++level)
  {
    const TriangleMesh mesh = Icosphere(level, 0.03);
    PrintDetail("sphere", "subdivided", mesh.Triangles.size(), AgainstSphere(mesh, ticks));
  }
  const TriangleMesh fine = Icosphere(6, 0.03);
  for (const std::size_t triangles : { 160, 640, 2560, 10240, 40960 })
  {
    const TriangleMesh mesh = Decimated(fine, triangles);
    PrintDetail("sphere", "decimated", mesh.Triangles.size(), AgainstSphere(mesh, ticks));
  }
  for (const char* const name : { "pial", "gearbox" })
  {
    const BenchmarkSurface surface{ name, "", {}, StrokeKind::Around, HipPath::Smooth, 0.05,
      LightTouch };
    const TriangleMesh mesh = ReadSurface(options.Folder, name, 0.05);
    if (mesh.Triangles.empty())
    {
      continue;
    }
    std::fprintf(stderr, "detail: %s\n", name);
    const Stroke stroke = MakeReference(mesh, MakeStroke(surface, mesh, ticks, Seed));
    for (const double share : { 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75 })
    {
      const auto wanted = static_cast<std::size_t>(share * mesh.Triangles.size());
      const TriangleMesh coarse = Decimated(mesh, wanted);
      PrintDetail(name, "decimated", coarse.Triangles.size(), AgainstFine(coarse, stroke));
    }
  }
}

/// The largest stiffness that rests in scenes with one, two and many planes, as a share of 2b/T.
void MeasureBoundaries()
{
  std::puts("method,scene,boundary");
  for (const ListedMethod& method : AllMethods())
  {
    const auto print = [&](const char* scene, std::function<MethodPointer()> make)
    {
      PressedScene pressed;
      pressed.Make = std::move(make);
      pressed.Start = { 1e-5, 0.001, 2e-4 };
      pressed.Direction = { 0, 0, -1 };
      pressed.Nudge = std::strcmp(scene, "plane") ? Vec3{ 0.6, 0, -0.8 } : Vec3{ 0, 0, -1 };
      std::printf("\"%s\",%s,%.3f\n", method.Name.c_str(), scene, MeasuredBoundary(pressed));
      std::fflush(stdout);
    };
    print("plane", [&] { return method.Make(Slab(0, 0.1)); });
    for (const double degrees : { 170.0, 120.0, 60.0 })
    {
      print(("valley of " + std::to_string(static_cast<int>(degrees)) + " deg").c_str(),
        [&] { return method.Make(GroovedBlock(degrees, 0.02)); });
    }
  }
  for (const double degrees : { 10.0, 60.0 })
  {
    PressedScene pressed;
    pressed.Make = [=] { return SummedValley(degrees); };
    pressed.Start = { 1e-5, 0.001, 2e-4 };
    pressed.Direction = { 0, 0, -1 };
    pressed.Nudge = { 0.6, 0, -0.8 };
    std::printf("sum of fields,valley of %d deg,%.3f\n", static_cast<int>(180 - degrees),
      MeasuredBoundary(pressed));
  }
}

void PrintHelp(const char* program)
{
  std::printf(
    "Usage: %s PART [--full] [--surfaces FOLDER]\n\n"
    "  methods     every method on every surface: accuracy, leaks, time of a tick\n"
    "  cost        time of a tick against the number of triangles\n"
    "  engines     BruteForce against Embree on small surfaces\n"
    "  detail      what coarser surfaces cost in accuracy\n"
    "  boundaries  the largest stiffness that rests, as a share of 2b/T\n\n"
    "  --full      longer strokes: half an hour\n"
    "  --surfaces  where Data/get_surfaces.py left its surfaces; default build/surfaces\n",
    program);
}
}

int main(int argc, char* argv[])
{
  Options options;
  std::string part;
  for (int i = 1; i < argc; ++i)
  {
    const std::string argument = argv[i];
    if (argument == "--full")
    {
      options.Full = true;
    }
    else if (argument == "--versions")
    {
      std::printf("VTK %s, Embree %s, CGAL %s\n", vtkVersion::GetVTKVersion(),
        HAPTICS_EMBREE_VERSION_TEXT, CGAL_VERSION_STR);
      return 0;
    }
    else if (argument == "--surfaces" && i + 1 < argc)
    {
      options.Folder = argv[++i];
    }
    else if (part.empty() && argument[0] != '-')
    {
      part = argument;
    }
    else
    {
      PrintHelp(argv[0]);
      return argument == "--help" ? 0 : 2;
    }
  }
  EnableExactEngine();
  const std::map<std::string, std::function<void()>> parts = {
    { "methods", [&] { MeasureMethods(options); } },
    { "cost", [&] { MeasureCost(options); } },
    { "engines", [&] { MeasureEngines(options); } },
    { "detail", [&] { MeasureDetail(options); } },
    { "boundaries", [] { MeasureBoundaries(); } },
  };
  const auto found = parts.find(part);
  if (found == parts.end())
  {
    PrintHelp(argv[0]);
    return 2;
  }
  found->second();
  return 0;
}
