// Whether a servo keeps 1 kHz while a surface under it deforms, and what each side of that costs.
//
// Two threads, as in a scene: one makes a snapshot of waving points 60 or 30 times a second and
// hands it over, the other ticks at 1 kHz and strokes the surface. Prints CSV, a line a size. Needs
// two cores for itself; `--help` lists the options.
#include "AnalyticSurfaces.h"
#include "Statistics.h"
#include "haptics/Servo/GodObjectExchange.h"
#include "haptics/Servo/RealTimePriority.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
using Clock = std::chrono::steady_clock;
constexpr double Period = 0.001;         // [s] of the servo
constexpr std::size_t NumberOfFirst = 2; // snapshots that are not counted

double Since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of all threads, so that a busy machine does not count [s]; the servo's share is small.
double ProcessorTime()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Case
{
  const char* Name;
  int Level;   ///< of the icosphere
  double Rate; ///< snapshots a second; 0: nothing moves
  bool Moves;  ///< as a rigid body as well
};

/// A sphere of R = 0.1 m whose points go in and out by up to 5 %, at moments of a period of 1 s
/// that are made beforehand: they are the source's work.
std::vector<std::vector<Vec3>> MakeWaves(const std::vector<Vec3>& points, int moments)
{
  std::vector<std::vector<Vec3>> waves(static_cast<std::size_t>(moments));
  for (int moment = 0; moment < moments; ++moment)
  {
    const double phase = 2.0 * M_PI * moment / moments;
    std::vector<Vec3>& wave = waves[static_cast<std::size_t>(moment)];
    wave.reserve(points.size());
    for (const Vec3& p : points)
    {
      wave.push_back((1.0 + 0.05 * std::sin(40.0 * p[0] + 60.0 * p[2] + phase)) * p);
    }
  }
  return waves;
}

void Run(const Case& scene, double seconds)
{
  const TriangleMesh mesh = Icosphere(scene.Level, 0.1);
  const std::vector<std::vector<Vec3>> waves = MakeWaves(mesh.Points, static_cast<int>(scene.Rate));
  const auto ball = MakeSurface(mesh);
  const auto motion = scene.Moves ? std::make_shared<SurfaceMotion>(RigidPose{}) : nullptr;
  SurfaceDeformer deformer(ball);
  GodObjectExchange exchange;
  std::uint64_t published = 0;
  std::atomic<std::uint64_t> taken{ 0 };
  const auto publish = [&](const std::shared_ptr<const TriangleSurface>& surface)
  {
    std::vector<TouchedSurface> list{ { surface, motion } };
    list.front().Identity = 1;
    published = exchange.Publish(std::make_unique<GodObject>(std::move(list)));
  };
  publish(ball);

  std::atomic<bool> isOver{ false };
  std::vector<double> ticks;
  std::vector<double> late;
  long touching = 0;
  const auto room = static_cast<std::size_t>(2.0 * seconds / Period);
  ticks.reserve(room);
  late.reserve(room);
  std::thread servo(
    [&]
    {
      if (const int result = RequestRealTimePriority(Urgency::Servo))
      {
        std::fprintf(stderr, "%s\n", DescribePriority(result).c_str());
      }
      auto due = Clock::now();
      double angle = 0.0;
      exchange.Take().Object->Update({ 0.2, 0, 0 });
      while (!isOver && ticks.size() < room)
      {
        due += std::chrono::microseconds(1000);
        std::this_thread::sleep_until(due);
        const auto start = Clock::now();
        late.push_back(std::chrono::duration<double>(start - due).count());
        angle += 0.001; // 0.1 m/s on the surface
        NumberedGodObject& numbered = exchange.Take();
        taken.store(numbered.Generation, std::memory_order_relaxed);
        GodObject& god = *numbered.Object;
        god.Advance(Period, exchange.HasNext());
        touching += god.Update({ 0.095 * std::cos(angle), 0.095 * std::sin(angle), 0 }).Status ==
          UpdateStatus::Touching;
        ticks.push_back(Since(start));
      }
    });

  std::vector<double> deforms;
  std::vector<double> costs;
  auto start = Clock::now();
  double first = 0.0; // of a deforming surface's life: the engine is copied
  double due = 0.0;
  while (Since(start) < seconds)
  {
    if (scene.Rate <= 0.0)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    due = std::max(due + 1.0 / scene.Rate, Since(start) - 1.0 / scene.Rate);
    std::this_thread::sleep_until(
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due)));
    if (taken.load(std::memory_order_relaxed) != published)
    {
      continue; // the servo has not come to the last one: this one is left out
    }
    exchange.Collect(); // as a scene does with each update
    std::vector<Vec3> points = waves[deforms.size() % waves.size()];
    const auto before = Clock::now();
    const double spent = ProcessorTime();
    std::string error;
    const auto next = deformer.Deform(std::move(points), 1.0 / scene.Rate, error);
    if (!next)
    {
      std::fprintf(stderr, "%s\n", error.c_str());
      std::exit(1);
    }
    publish(next);
    if (motion)
    {
      motion->MoveTo({ { 0.01 * std::sin(Since(start)), 0, 0 } }, 1.0 / scene.Rate);
    }
    deforms.push_back(Since(before));
    costs.push_back(ProcessorTime() - spent);
    if (first == 0.0 && deforms.size() == NumberOfFirst)
    {
      first = std::accumulate(deforms.begin(), deforms.end(), 0.0);
      deforms.clear();
      costs.clear();
      start = Clock::now();
      due = 0.0;
    }
  }
  const double rate = static_cast<double>(deforms.size()) / Since(start);
  isOver = true;
  servo.join();

  const double kept = static_cast<double>(std::count_if(
                        late.begin(), late.end(), [](double x) { return x < Period; })) /
    static_cast<double>(late.size());
  std::printf("%s,%zu,%.1f,%.2f,%.2f,%.2f,%zu,%.2f,%.2f,%.2f,%.2f,%.4f,%.1f,%.3f,%d,%.1f\n",
    scene.Name, ball->Triangles().size(), rate, 1e3 * Quantile(costs, 0.5),
    1e3 * Quantile(deforms, 0.5), 1e3 * Quantile(deforms, 1.0), ticks.size(),
    1e6 * Quantile(ticks, 0.5), 1e6 * Quantile(ticks, 0.99), 1e6 * Quantile(ticks, 0.999),
    1e6 * Quantile(ticks, 1.0), kept, 1e6 * Quantile(late, 0.999),
    static_cast<double>(touching) / static_cast<double>(ticks.size()), deformer.NumberOfBuilds(),
    1e3 * first);
  std::fflush(stdout);
}
}

int main(int argc, char* argv[])
{
  double seconds = 10.0;
  for (int i = 1; i < argc; ++i)
  {
    if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc)
    {
      seconds = std::atof(argv[++i]);
    }
    else
    {
      std::printf(
        "Usage: %s [--seconds S]\n\n  --seconds S  for each case; default 10\n\n"
        "deform: from points to the god-object that is handed over; cpu: of all threads;\n"
        "first: of the first two, which copy the engine and are not counted elsewhere;\n"
        "tick: one servo cycle without the device; kept: share of ticks that began\n"
        "within their period.\n",
        argv[0]);
      return std::strcmp(argv[i], "--help") == 0 ? 0 : 2;
    }
  }
  std::printf("case,triangles,snapshots_per_s,deform_cpu_ms_p50,deform_ms_p50,deform_ms_max,ticks,"
              "tick_us_p50,"
              "tick_us_p99,tick_us_p999,tick_us_max,kept,late_us_p999,contact,builds,first_ms\n");
  const Case cases[] = { { "still", 5, 0.0, false }, { "deforming", 5, 60.0, false },
    { "deforming and moving", 5, 60.0, true }, { "still", 7, 0.0, false },
    { "deforming", 7, 30.0, false } };
  for (const Case& scene : cases)
  {
    Run(scene, seconds);
  }
  return 0;
}
