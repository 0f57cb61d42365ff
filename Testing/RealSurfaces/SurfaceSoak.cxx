// HapticsSoak's judge on real surfaces, those that Data/get_surfaces.py has got. Exits with 1 where
// the judge finds fault, with 77 where there is no surface.
#include "JudgedSoak.h"
#include "RealSurface.h"
#include "vtkGodObjectFilter.h"

#include "vtkNew.h"

#include <cstdio>

using namespace haptics::testing;

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
  int surfaces = 0;
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
    soak.Run(file, { filter->GetSurface() });
    ++surfaces;
  }
  const bool isGood = soak.Finish();
  if (surfaces == 0)
  {
    std::printf(
      "No surface in %s: 'python3 Data/get_surfaces.py' gets them.\n", HAPTICS_SURFACES_DIR);
    return 77;
  }
  return isGood ? 0 : 1;
}
