// How long an update of the god-object takes, and what a surface costs to make.
//
// Times of single ticks are taken with the clock inside the loop, as their high quantiles are what
// a servo needs: the counters mean_us, p50_us, p99_us and p999_us. The clock adds about 0.03 us.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"
#include "Statistics.h"
#include "haptics/Contact/GodObject.h"

#include "vtkCellArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr int Ticks = 10000;

using SurfacePointer = std::shared_ptr<const TriangleSurface>;

SurfacePointer Build(TriangleMesh mesh, EngineKind engine)
{
  SurfaceOptions options;
  options.TouchedSide = Side::Front;
  options.Engine = engine;
  std::string error;
  return TriangleSurface::Build(std::move(mesh), options, error);
}

/// Spheres of R = 1 m, made once.
SurfacePointer Sphere(int level, bool inside, EngineKind engine)
{
  static std::map<std::tuple<int, bool, EngineKind>, SurfacePointer> made;
  SurfacePointer& surface = made[{ level, inside, engine }];
  if (!surface)
  {
    const TriangleMesh mesh = Icosphere(level, 1.0);
    surface = Build(inside ? InsideOut(mesh) : mesh, engine);
  }
  return surface;
}

/// A CSV file wants the same columns from every benchmark.
void ClearCounters(benchmark::State& state)
{
  for (const char* const name :
    { "triangles", "mean_us", "p50_us", "p99_us", "p999_us", "contact", "bytes_per_triangle" })
  {
    state.counters[name] = 0.0;
  }
}

/// Moves the god-object along the places of the HIP over and over, and reports single ticks.
void Stroke(benchmark::State& state, const SurfacePointer& surface, const std::vector<Vec3>& start,
  const std::vector<Vec3>& hips)
{
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  long contacts = 0;
  for (auto _ : state)
  {
    GodObject god({ surface });
    for (const Vec3& hip : start)
    {
      god.Update(hip);
    }
    for (const Vec3& hip : hips)
    {
      const auto before = Clock::now();
      const Contact& contact = god.Update(hip);
      times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
      contacts += contact.Status == UpdateStatus::Touching;
    }
  }
  ClearCounters(state);
  state.counters["triangles"] = static_cast<double>(surface->Triangles().size());
  state.counters["bytes_per_triangle"] =
    static_cast<double>(surface->MemoryBytes()) / surface->Triangles().size();
  state.counters["mean_us"] = Mean(times);
  state.counters["p50_us"] = Quantile(times, 0.5);
  state.counters["p99_us"] = Quantile(times, 0.99);
  state.counters["p999_us"] = Quantile(times, 0.999);
  state.counters["contact"] = static_cast<double>(contacts) / times.size();
}

/// A circle about the middle of a sphere of R = 1 m, 1 mm a tick unless said otherwise.
std::vector<Vec3> Circle(double radius, double step = 1e-3)
{
  const Vec3 u = Unit(Cross({ 0.3, 0.5, 0.81 }, { 0, 0, 1 }));
  const Vec3 v = Unit(Cross({ 0.3, 0.5, 0.81 }, u));
  std::vector<Vec3> hips;
  for (int tick = 0; tick < Ticks; ++tick)
  {
    const double a = step * tick / radius;
    hips.push_back(radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return hips;
}

void SlideOutside(benchmark::State& state)
{
  const auto hips = Circle(0.98);
  Stroke(state, Sphere(static_cast<int>(state.range(0)), false, EngineKind::Embree),
    { 1.2 * hips[0] }, hips);
}

/// As many facets a tick on every sphere as SlideOutside meets on the finest: what is left is how
/// the cost grows with the surface itself.
void SlideAcrossFacets(benchmark::State& state)
{
  const int level = static_cast<int>(state.range(0));
  const auto hips = Circle(0.98, std::ldexp(1e-3, 8 - level));
  Stroke(state, Sphere(level, false, EngineKind::Embree), { 1.2 * hips[0] }, hips);
}

void SlideInside(benchmark::State& state)
{
  const auto hips = Circle(1.02);
  Stroke(state, Sphere(static_cast<int>(state.range(0)), true, EngineKind::Embree),
    { 0.8 * hips[0] }, hips);
}

void FreeSpace(benchmark::State& state)
{
  // 20 mm above the surface, as far as the slides are below it.
  const auto hips = Circle(1.02);
  Stroke(state, Sphere(static_cast<int>(state.range(0)), false, EngineKind::Embree), {}, hips);
}

void SlideWith(benchmark::State& state, EngineKind engine)
{
  const auto hips = Circle(0.98);
  Stroke(state, Sphere(static_cast<int>(state.range(0)), false, engine), { 1.2 * hips[0] }, hips);
}

/// Where a ray from outside towards the middle first meets the surface, 2 % of the radius deeper.
std::vector<Vec3> StrokeOver(const SurfacePointer& surface)
{
  const double radius = surface->Radius();
  GodObject ray({ surface });
  std::vector<Vec3> hips;
  double height = radius;
  for (int tick = 0; tick < Ticks; ++tick)
  {
    const double a = 1e-3 * tick; // 1/1000 of the radius a tick
    const Vec3 outwards = Unit({ std::cos(a), std::sin(a), 0.3 * std::sin(0.7 * a) });
    ray.Place(surface->Origin() + 1.1 * radius * outwards);
    int corners = 0;
    ray.Update(surface->Origin());
    const Vec3* const way = ray.Way(corners);
    const double met = corners > 1 ? Length(way[1]) : 0.0;
    // Smoothed, as a hand does not jump into a hole.
    height += 0.02 * (std::min(met, 1.1 * radius) - height);
    hips.push_back(surface->Origin() + (height - 0.02 * radius) * outwards);
  }
  return hips;
}

void SlideOverFile(benchmark::State& state, const std::string& name)
{
  const char* const folder = std::getenv("HAPTICS_SURFACES");
  const std::string path = std::string(folder ? folder : "build/surfaces") + "/" + name + ".vtp";
  vtkNew<vtkXMLPolyDataReader> reader;
  if (!reader->CanReadFile(path.c_str()))
  {
    state.SkipWithError(("no " + path + ": python3 Data/get_surfaces.py " + name).c_str());
    return;
  }
  reader->SetFileName(path.c_str());
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->Update();
  const SurfacePointer surface = filter->GetSurface();
  const auto hips = StrokeOver(surface);
  Stroke(state, surface, { 1.2 * (hips[0] - surface->Origin()) + surface->Origin() }, hips);
}

/// What a surface's properties cost: a slide with everything from the HIP to the force, on a sphere
/// of 20,480 triangles. "plain" has none, and no property's code is run for it.
void SlideFelt(benchmark::State& state, const PropertyValues& values, bool isPlain)
{
  const SurfacePointer surface = Sphere(5, false, EngineKind::Embree);
  const TouchedSurface touched = isPlain ? TouchedSurface(surface) : Touchable(surface, values);
  const auto hips = Circle(0.98);
  std::vector<double> means;
  for (auto _ : state)
  {
    GodObject god({ touched });
    god.Update(1.2 * hips[0]);
    SurfaceForce force;
    const auto before = std::chrono::steady_clock::now();
    for (const Vec3& hip : hips)
    {
      benchmark::DoNotOptimize(force.Update(god.Update(hip), 1e-3, 500.0, {}));
    }
    const std::chrono::duration<double, std::micro> time =
      std::chrono::steady_clock::now() - before;
    means.push_back(time.count() / Ticks);
  }
  ClearCounters(state);
  state.counters["triangles"] = static_cast<double>(surface->Triangles().size());
  state.counters["mean_us"] = means.front();
  state.counters["contact"] = 1.0;
}

PropertyValues Varying(Property property, double least, double most)
{
  PropertyValues values;
  const SurfacePointer surface = Sphere(5, false, EngineKind::Embree);
  values[property] = AtPoints(*surface,
    [=](const Vec3& p) { return least + (most - least) * (0.5 + 0.5 * std::sin(20.0 * p[0])); });
  return values;
}

PropertyValues Everything()
{
  PropertyValues values = Varying(Property::Stiffness, 200.0, 800.0);
  values[Property::Damping].Constant = 1.0;
  values[Property::StaticFriction].Constant = 0.4;
  values[Property::DynamicFriction] = Varying(Property::DynamicFriction, 0.1, 0.3).Fields[3];
  values[Property::Texture] = Varying(Property::Texture, -0.2, 0.2).Fields[4];
  values.Shading = true;
  return values;
}

PropertyValues Shaded()
{
  PropertyValues values;
  values.Shading = true;
  return values;
}

PropertyValues Button()
{
  PropertyValues values;
  std::string error;
  values.Profile = ForceProfile::Build({ 0.0, 1.0, 2.0, 1.0, 3.0 }, 0.01, error);
  return values;
}

/// From Update() of the filter on plain triangles to a surface that can be touched.
void MakeTouchable(benchmark::State& state, const std::function<TriangleMesh()>& make)
{
  const TriangleMesh mesh = make();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.Points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    cells->InsertNextCell({ a, b, c });
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  input->SetPolys(cells);
  double bytes = 0.0;
  for (auto _ : state)
  {
    vtkNew<vtkGodObjectFilter> filter;
    filter->SetInputData(input);
    filter->Update();
    bytes = static_cast<double>(filter->GetSurface()->MemoryBytes()) +
      1024.0 * filter->GetOutput()->GetActualMemorySize();
  }
  ClearCounters(state);
  state.counters["triangles"] = static_cast<double>(mesh.Triangles.size());
  state.counters["bytes_per_triangle"] = bytes / mesh.Triangles.size();
}

// 1,280, 20,480, 327,680 and 1,310,720 triangles.
#define HAPTICS_LEVELS Arg(3)->Arg(5)->Arg(7)->Arg(8)
// One iteration is a stroke of 10,000 ticks; what is compared are medians of the repetitions.
#define HAPTICS_REPEATED                                                                           \
  Iterations(1)->Repetitions(9)->ReportAggregatesOnly()->Unit(benchmark::kMillisecond)

BENCHMARK(SlideOutside)->HAPTICS_LEVELS->HAPTICS_REPEATED;
BENCHMARK(SlideAcrossFacets)->HAPTICS_LEVELS->HAPTICS_REPEATED;
BENCHMARK(SlideInside)->HAPTICS_LEVELS->HAPTICS_REPEATED;
BENCHMARK(FreeSpace)->HAPTICS_LEVELS->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, plain, PropertyValues(), true)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, stiffness, Varying(Property::Stiffness, 200, 800), false)
  ->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, damping, Everywhere(-1, 1.0, 0, 0, 0), false)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, friction, Rough(0.4, 0.3), false)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, texture, Varying(Property::Texture, -0.2, 0.2), false)
  ->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, shading, Shaded(), false)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, button, Button(), false)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideFelt, everything, Everything(), false)->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideOverFile, frog, "frog")->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideWith, BruteForce, EngineKind::BruteForce)
  ->DenseRange(0, 5)
  ->HAPTICS_REPEATED;
BENCHMARK_CAPTURE(SlideWith, Embree, EngineKind::Embree)->DenseRange(0, 5)->HAPTICS_REPEATED;
#define HAPTICS_MADE                                                                               \
  Iterations(1)->Repetitions(5)->ReportAggregatesOnly()->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(MakeTouchable, 328k, [] { return Icosphere(7, 1.0); })->HAPTICS_MADE;
BENCHMARK_CAPTURE(MakeTouchable, 1.3M, [] { return Icosphere(8, 1.0); })->HAPTICS_MADE;
BENCHMARK_CAPTURE(MakeTouchable, 10M, [] { return Torus(1.0, 0.3, 2500, 2000); })->HAPTICS_MADE;
}

BENCHMARK_MAIN();
