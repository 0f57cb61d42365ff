// Runs the suite's scenes and writes what happened, for Testing/Benchmarks/charts.py to draw.
// Usage: HapticsSceneTraces FOLDER      writes scenes.csv, traces.csv and ratios.csv there
#include "AnalyticSurfaces.h"
#include "Scenes.h"
#include "haptics/Files/OutputFile.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

using namespace haptics::testing;

namespace
{
/// Rows of one run: more are thinned out, as a chart has no room for them.
constexpr std::size_t MostRows = 400;

/// A table that is written whole or not at all, at its end.
class Table
{
public:
  explicit Table(std::string name)
    : Name(std::move(name))
    , Stream(open_memstream(&this->Text, &this->Size))
  {
  }
  ~Table()
  {
    std::fclose(this->Stream);
    std::string error;
    if (!haptics::OutputFile::WriteWhole(this->Name, this->Text, this->Size, error))
    {
      std::fprintf(stderr, "%s\n", error.c_str());
      std::exit(1);
    }
    std::free(this->Text);
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  std::FILE* get() const { return this->Stream; }

private:
  const std::string Name;
  char* Text = nullptr;
  std::size_t Size = 0;
  std::FILE* const Stream;
};

void WriteRun(std::FILE* file, const Scene& scene, const char* run, const Trace& trace)
{
  const std::size_t every = (trace.size() + MostRows - 1) / MostRows;
  for (std::size_t i = 0; i < trace.size(); i += every)
  {
    const LoopTick& tick = trace[i];
    std::fprintf(file, "%s,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f\n", scene.Name, run, tick.Time,
      1e3 * tick.Hip[0], 1e3 * tick.Hip[2], 1e3 * tick.Held[0], 1e3 * tick.Held[2],
      Dot(tick.Force, scene.Axis));
  }
}

/// Fig. 3: how hard a valley presses on a HIP under its crease, as a multiple of K times the depth.
double Ratio(const MethodPointer& method)
{
  const haptics::Vec3 above{ 0, 0.001, 0.002 };
  const haptics::Vec3 hip{ 0, 0.001, -0.004 };
  method->Place(above);
  return Length(method->Update(hip) - hip) / 0.004;
}
}

int main(int argc, char* argv[])
{
  if (argc != 2 || argv[1][0] == '-')
  {
    std::printf(
      "Usage: %s FOLDER      writes scenes.csv, traces.csv and ratios.csv there\n", argv[0]);
    return argc == 2 && std::string(argv[1]) == "--help" ? 0 : 2;
  }
  const std::string folder = std::string(argv[1]) + "/";
  const Table scenes(folder + "scenes.csv");
  const Table traces(folder + "traces.csv");
  std::fputs("scene,title,ours,other,component\n", scenes.get());
  std::fputs("scene,run,time_s,hip_x_mm,hip_z_mm,held_x_mm,held_z_mm,force_n\n", traces.get());
  for (const Scene& scene : AllScenes())
  {
    std::fprintf(scenes.get(), "%s,\"%s\",\"%s\",\"%s\",%s\n", scene.Name, scene.Title,
      scene.OursLabel, scene.OtherLabel, scene.Axis[0] == 1.0 ? "x" : "z");
    for (const auto& [x, z] : scene.Profile)
    {
      std::fprintf(traces.get(), "%s,surface,0,%.4f,%.4f,0,0,0\n", scene.Name, 1e3 * x, 1e3 * z);
    }
    WriteRun(traces.get(), scene, "ours", scene.Ours());
    WriteRun(traces.get(), scene, "other", scene.Other());
    WriteRun(traces.get(), scene, "ball", scene.Ball());
  }
  const Table ratios(folder + "ratios.csv");
  std::fputs("degrees,ours,sum\n", ratios.get());
  for (int degrees = 0; degrees <= 150; degrees += 10)
  {
    std::fprintf(ratios.get(), "%d,%.6f,%.6f\n", degrees, Ratio(CertifiedValley(degrees)),
      Ratio(SummedValley(degrees)));
  }
  return 0;
}
