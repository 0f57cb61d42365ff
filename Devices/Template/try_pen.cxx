// Lets the pen fall onto a table for two seconds; fails where the table does not hold it.
#include "vtkPenHapticDevice.h"

#include <vtkHapticScene.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

int main()
{
  vtkNew<vtkPlaneSource> table; // 1 m by 1 m at z = 0
  vtkNew<vtkPenHapticDevice> pen;
  vtkNew<vtkHapticScene> scene;
  scene->SetDevice(pen);
  scene->AddSurface(table->GetOutputPort());
  if (!scene->Engage())
  {
    std::cerr << scene->GetErrorMessage() << "\n";
    return 1;
  }
  double force = 0.0;
  for (int frame = 0; frame < 100; ++frame)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    scene->Update();
    force = scene->GetForce()[2];
  }
  std::cout << "the table holds it with " << force << " N, pressed in by "
            << 1000.0 * scene->GetPenetration() << " mm\n";
  scene->Release();
  return std::abs(force - 0.981) < 0.1 ? 0 : 1; // 100 g
}
