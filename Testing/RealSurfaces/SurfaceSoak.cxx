// HapticsSoak's judge on real surfaces, those that Data/get_surfaces.py has got, and
// HapticsBallSoak's with a twentieth of the ticks. Exits with 1 where a judge finds fault, with 77
// where there is no surface.
#include "JudgedBallSoak.h"
#include "JudgedSoak.h"
#include "RealSurface.h"
#include "vtkGodObjectFilter.h"

#include "vtkNew.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// A tick of a ball takes the judge so many times as long.
constexpr long TicksOfABall = 20;
}

int main(int argc, char* argv[])
{
  const char* const files[] = {
    "wing.stl",
    "t13.stl",
    "footbones.vtp",
    "propeller.stl",
    "motor.stl",
    "aneurysm.stl",
    "pial.vtp",
    "gearbox.stl",
    "fault.vtp",
#ifdef HAPTICS_TEST_ALL_REAL_SURFACES
    "cranium.vtp",
    "frog.vtp",
#endif
  };
  const SoakOptions options = SoakOptions::Parse(argc, argv, 1000, 40000);
  JudgedSoak soak(options);
  std::vector<std::pair<std::string, TouchedSurface>> touched;
  for (const char* const file : files)
  {
    const std::string path = PathOf({ file, 0, 0, 0, 0, false, 0 });
    if (!options.Chooses(file) || path.empty())
    {
      continue;
    }
    vtkNew<vtkGodObjectFilter> filter;
    filter->SetInputData(Read(path));
    filter->Update();
    if (!filter->GetSurface())
    {
      std::printf("%s: no surface\n", file);
      return 1;
    }
    touched.emplace_back(file, TouchedSurface{ filter->GetSurface() });
    soak.Run(file, { touched.back().second });
  }
  const bool isGood = soak.Finish();
  std::printf("\nballs\n");
  SoakOptions fewer = options;
  fewer.Ticks = std::max(1L, options.Ticks / TicksOfABall);
  JudgedBallSoak ballSoak(fewer);
  for (const auto& [file, surface] : touched)
  {
    ballSoak.Run(file, { surface });
  }
  const bool areBallsGood = ballSoak.Finish();
  if (touched.empty())
  {
    std::printf(
      "No surface in %s: 'python3 Data/get_surfaces.py' gets them.\n", HAPTICS_SURFACES_DIR);
    return 77;
  }
  return isGood && areBallsGood ? 0 : 1;
}
