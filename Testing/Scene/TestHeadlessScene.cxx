#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>

#include <unistd.h>

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

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they keep what is freed
TEST(HeadlessScene, SurfacesThatNoTickHasTakenAreForgotten)
{
  const auto megabytes = []
  {
    long pages = 0;
    std::ifstream file("/proc/self/statm");
    file >> pages >> pages; // the second is what is resident
    return pages * sysconf(_SC_PAGESIZE) / (1 << 20);
  };
  vtkNew<vtkSphereSource> ball; // 20,000 triangles: 3 MB a snapshot
  ball->SetThetaResolution(100);
  ball->SetPhiResolution(100);
  vtkNew<vtkTrivialProducer> source;
  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  scene->SetDevice(device);
  scene->AddSurface(source->GetOutputPort());
  const auto exchange = [&](int times)
  {
    for (int i = 0; i < times; ++i)
    {
      ball->SetRadius(0.05 + 1e-4 * i);
      ball->SetThetaResolution(100 + i % 2); // other cells
      ball->Update();
      vtkNew<vtkPolyData> geometry;
      geometry->DeepCopy(ball->GetOutput());
      source->SetOutput(geometry);
      scene->Update();
    }
  };
  ball->Update();
  source->SetOutput(ball->GetOutput());
  device->SetPosition(0.0, 0.0, 1.0);
  ASSERT_EQ(scene->Step(1), 1); // the servo steps, and then does not
  exchange(10);
  const long before = megabytes();
  exchange(60);
  EXPECT_LT(megabytes() - before, 60) << "60 snapshots take some 200";
}
#endif
