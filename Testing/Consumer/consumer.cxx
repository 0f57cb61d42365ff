#include <vtkHapticScene.h>
#include <vtkNew.h>
#include <vtkSimulatedHapticDevice.h>
#include <vtkSphereSource.h>

#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> sphere; // any vtkPolyData, in any unit; here R = 0.5
  sphere->SetThetaResolution(200);
  sphere->SetPhiResolution(200);

  vtkNew<vtkSimulatedHapticDevice> device; // or vtkFalconHapticDevice, vtkMouseHapticDevice
  vtkNew<vtkHapticScene> scene;
  scene->SetDevice(device);
  scene->AddSurface(sphere->GetOutputPort());

  device->SetPosition(0.0, 0.0, 0.51); // [m]; 10 mm above the sphere
  scene->Step(1);                      // virtual time; with a hand at the device: Engage()
  device->SetPosition(0.0, 0.0, 0.495);
  scene->Step(200);
  std::cout << "pressed in by " << scene->GetPenetration() << ", the force is "
            << scene->GetForce()[2] << " N\n";
  return scene->GetTouching() ? 0 : 1;
}
