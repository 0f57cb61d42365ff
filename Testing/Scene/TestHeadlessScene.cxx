#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkSimulatedHapticDevice.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

namespace
{
/// The shared libraries that this process has loaded, by their paths.
std::set<std::string> LoadedLibraries()
{
  std::set<std::string> libraries;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
  {
    const std::size_t path = line.find('/');
    if (path != std::string::npos && line.find(".so", path) != std::string::npos)
    {
      libraries.insert(line.substr(path));
    }
  }
  return libraries;
}

/// The first that draws or opens windows; empty where none does.
std::string FirstThatDraws(const std::set<std::string>& libraries)
{
  for (const std::string& library : libraries)
  {
    const std::string name = library.substr(library.rfind('/') + 1);
    for (const char* drawing : { "libvtkRendering", "libvtkInteraction", "libvtkHapticsView",
           "libGL", "libOpenGL", "libEGL", "libX11", "libQt" })
    {
      if (name.compare(0, std::string(drawing).size(), drawing) == 0)
      {
        return library;
      }
    }
  }
  return "";
}
}

TEST(HeadlessScene, TouchesAndLoadsNoRenderingLibrary)
{
  vtkNew<vtkPlaneSource> table;
  table->SetOrigin(-0.1, -0.1, 0.0);
  table->SetPoint1(0.1, -0.1, 0.0);
  table->SetPoint2(-0.1, 0.1, 0.0);
  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  scene->SetDevice(device);
  scene->AddSurface(table->GetOutputPort());
  device->SetPosition(0.0, 0.0, 0.01);
  scene->Step(1);
  device->SetPosition(0.0, 0.0, -0.002);
  scene->Step(200);
  EXPECT_TRUE(scene->GetTouching());
  EXPECT_GT(scene->GetForce()[2], 0.5);

  const std::set<std::string> libraries = LoadedLibraries();
  ASSERT_FALSE(libraries.empty());
  EXPECT_EQ(FirstThatDraws(libraries), "");
}
