// The hand slides over a bump in virtual time: surface, god-object, HIP below it, spring, force
// arrow and trail must be where the baseline has them. Seen to fail without the arrow, without the
// trail, and with the god-object drawn at the HIP.
#include "ImageTestTools.h"

#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkSimulatedHapticDevice.h"

#include <iostream>

int TestGodObjectActor(int argc, char* argv[])
{
  TestBall bump(0.05, 60, 60);

  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(bump.Actor);
  scene->SetDevice(device);
  scene->SetStiffness(150.0);
  vtkNew<vtkHapticView> view;
  view->SetScene(scene);
  vtkGodObjectActor* hand = view->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->SetSize(0.03);
  for (int tick = 0; tick <= 100; ++tick)
  {
    const double s = tick / 100.0;
    device->SetPosition(-0.03 + 0.05 * s, -0.02 + 0.035 * s, s < 0.05 ? 0.06 : 0.034);
    scene->Step(1);
  }
  if (!scene->GetTouching())
  {
    std::cerr << "The hand does not touch the sphere: " << scene->GetErrorMessage() << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(bump.Actor, hand);
  picture.LookFrom(0.05, -0.2, 0.25, 1.3);
  return picture.Compare(argc, argv);
}
