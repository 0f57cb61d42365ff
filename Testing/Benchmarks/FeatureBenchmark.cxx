// What a feature costs while it is off: ticks of a program that has it, but does not use it,
// against those of one that does without.
#include "AnalyticSurfaces.h"
#include "Callgrind.h"
#include "MaterialTools.h"
#include "Statistics.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Servo/ForceGuard.h"
#include "haptics/Servo/RingBuffer.h"
#include "haptics/Surface/SurfaceDeformer.h"
#include "haptics/Tick/ContactTick.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr int Ticks = 5000;
constexpr double Period = 1e-3;     // [s]
constexpr double Stiffness = 500.0; // [N/m]

using SurfacePointer = std::shared_ptr<const TriangleSurface>;
/// A tick, from a HIP to a force.
using Tick = std::function<Vec3(const Vec3&)>;

/// One that holds a god-object: made anew for each run.
struct Runner
{
  std::shared_ptr<GodObject> God;
  Tick Go;
};
using MakeRunner = std::function<Runner()>;

Runner Plain(std::vector<TouchedSurface> surfaces, Tip tip = Tip::Point)
{
  auto god = std::make_shared<GodObject>(std::move(surfaces), tip);
  auto law = std::make_shared<SurfaceForce>();
  return { god,
    [god, law](const Vec3& hip) { return law->Update(god->Update(hip), Period, Stiffness, {}); } };
}

struct Row
{
  const char* Feature;
  const char* Note; ///< what "with" is
  MakeRunner Without, With;
};

TouchedSurface Moving(const SurfacePointer& surface)
{
  return { surface, std::make_shared<SurfaceMotion>(RigidPose{}) };
}

/// Spheres next to the one that is stroked, farther than a hand reaches in a tick.
std::vector<TouchedSurface> WithOthers(const SurfacePointer& surface, int others)
{
  std::vector<TouchedSurface> all{ surface };
  for (int i = 0; i < others; ++i)
  {
    all.emplace_back(MakeSurface(Moved(Icosphere(4, 1.0), { 10.0 + 3.0 * i, 0, 0 })));
  }
  return all;
}

/// As far as a servo goes, with a guard, and with a record of each tick or without.
Runner Guarded(const SurfacePointer& surface, bool isRecorded)
{
  struct State
  {
    ContactTick Tick;
    ForceGuard Guard;
    SafetySettings Safety;
    TickRecord Record;
    RingBuffer<TickRecord> Records{ 64 };
  };
  auto god = std::make_shared<GodObject>(std::vector<TouchedSurface>{ surface });
  auto state = std::make_shared<State>();
  state->Guard.Restart(state->Safety);
  return { god,
    [god, state, isRecorded](const Vec3& hip)
    {
      const Contact& contact = state->Tick.Touch(*god, hip, hip, {});
      const Vec3 force = state->Guard.Force(contact, Period, { Stiffness }, state->Safety);
      if (isRecorded)
      {
        state->Tick.Record(*god, force, state->Guard.GetLaw(), state->Record);
        state->Records.Push(state->Record);
        TickRecord oldest;
        state->Records.Pop(oldest);
      }
      return force;
    } };
}

std::vector<Row> MakeRows(const SurfacePointer& surface)
{
  const MakeRunner plain = [surface] { return Plain({ surface }); };
  const auto touching = [surface](const PropertyValues& values) -> MakeRunner
  { return [=] { return Plain({ Touchable(surface, values) }); }; };
  const auto limited = [surface](int limit) -> MakeRunner
  {
    return [=]
    {
      Runner runner = Plain({ surface });
      runner.God->SetSubstepLimit(limit);
      return runner;
    };
  };
  const auto guarded = [surface](bool isRecorded) -> MakeRunner
  { return [=] { return Guarded(surface, isRecorded); }; };
  const auto deformed = [surface]() -> Runner
  {
    SurfaceDeformer deformer(surface);
    std::vector<Vec3> points = surface->Points();
    for (Vec3& p : points)
    {
      p = p + surface->Origin();
    }
    std::string error;
    return Plain({ deformer.Replace(points, error) });
  };
  const auto shaded = []
  {
    PropertyValues values;
    values.Shading = true;
    return values;
  };
  return {
    { "nothing", "the same again: what the measuring itself makes", plain, plain },
    { "tip, off", "a ball of radius 0", plain,
      [surface] { return Plain({ surface }, Tip::Ball); } },
    { "substeps, off", "a limit of 1", plain, limited(1) },
    { "several surfaces, 1 out of reach", "a surface more in the list", plain,
      [surface] { return Plain(WithOthers(surface, 1)); } },
    { "several surfaces, 8 out of reach", "8 surfaces more in the list", plain,
      [surface] { return Plain(WithOthers(surface, 8)); } },
    { "motion, at rest", "a SurfaceMotion that rests, not advanced", plain,
      [surface] { return Plain({ Moving(surface) }); } },
    { "deformation, at rest", "a snapshot of a SurfaceDeformer", plain, deformed },
    { "friction, off", "coefficients of 0 on a surface with a damping, against that alone",
      touching(Everywhere(-1, 1.0, 0, 0, 0)), touching(Rough(0.0, 0.0)) },
    { "texture, off", "a texture of 0 on a surface with friction, against that alone",
      touching(Rough(0.4, 0.3)), touching(Everywhere(-1, 0, 0.4, 0.3, 0)) },
    { "record (trace), always on", "each tick written into the queue", guarded(false),
      guarded(true) },
    { "guard, always on", "against the force law alone", plain, guarded(false) },
    { "friction, on", "0.4 and 0.3", plain, touching(Rough(0.4, 0.3)) },
    { "texture, on", "a constant one of 0.2", plain, touching(Everywhere(-1, 0, 0, 0, 0.2)) },
    { "shading, on", "", plain, touching(shaded()) },
    { "tip, on", "a ball of 20 mm, where R = 1 m", plain,
      [surface]
      {
        Runner runner = Plain({ surface }, Tip::Ball);
        runner.God->SetTipRadius(0.02);
        return runner;
      } },
    { "substeps, on", "a limit of 4", plain, limited(4) },
  };
}

std::vector<Vec3> MakeStroke()
{
  std::vector<Vec3> hips;
  for (int tick = 0; tick < Ticks; ++tick)
  {
    const double a = 1e-3 * tick;
    hips.push_back(0.98 * Unit({ std::cos(a), std::sin(a), 0.3 * std::sin(0.7 * a) }));
  }
  return hips;
}

/// Mean time of a tick [us].
double Run(const MakeRunner& make, const std::vector<Vec3>& hips)
{
  using Clock = std::chrono::steady_clock;
  const Runner runner = make();
  runner.God->Update(1.2 * hips.front());
  Vec3 sum{};
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const auto before = Clock::now();
  for (const Vec3& hip : hips)
  {
    sum = sum + runner.Go(hip);
  }
  const std::chrono::duration<double, std::micro> time = Clock::now() - before;
  CALLGRIND_DUMP_STATS_AT("ticks");
  CALLGRIND_STOP_INSTRUMENTATION;
  if (!(Length(sum) < 1e9)) // so that the forces are made
  {
    std::abort();
  }
  return time.count() / static_cast<double>(hips.size());
}
}

int main(int argc, char** argv)
{
  const bool hasRepeat = argc == 3 && std::strcmp(argv[1], "--repeat") == 0;
  const int repeat = hasRepeat ? std::atoi(argv[2]) : 25;
  if ((argc > 1 && !hasRepeat) || repeat < 1)
  {
    std::printf(
      "HapticsFeatureBenchmark [--repeat N]\n\n"
      "What features cost on a slide over 20,480 triangles, 20 mm deep at R = 1 m, from HIP to "
      "force. A CSV:\nthe mean time of a tick without and with [us], the medians of N runs "
      "(default 25) that take turns, and their\nratio. features.py has the exact instructions "
      "too.\n");
    return argc == 2 && std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
  }
  const SurfacePointer surface = MakeSurface(Icosphere(5, 1.0));
  const std::vector<Vec3> hips = MakeStroke();
  std::printf("feature,with,ticks,without_us,with_us,ratio\n");
  for (const Row& row : MakeRows(surface))
  {
    std::vector<double> without;
    std::vector<double> with;
    std::vector<double> ratios;
    for (int i = 0; i < repeat; ++i)
    {
      without.push_back(Run(row.Without, hips));
      with.push_back(Run(row.With, hips));
      ratios.push_back(with.back() / without.back());
    }
    std::printf("\"%s\",\"%s\",%zu,%.4f,%.4f,%.3f\n", row.Feature, row.Note, hips.size(),
      Quantile(without, 0.5), Quantile(with, 0.5), Quantile(ratios, 0.5));
    std::fflush(stdout);
  }
  return 0;
}
