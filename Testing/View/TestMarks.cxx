// A ball is stroked from left to right; two landmarks, the trail, the touched triangle, the force
// coloured by its strength with its legend; the HIP is occluded by the ball, not seen through it.
// Seen to fail without the landmarks, without the trail, without the triangle, without the legend,
// with the force not coloured, and with the HIP seen through the ball.
#include "ImageTestTools.h"

#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkSimulatedHapticDevice.h"

#include <cmath>
#include <iostream>

int TestMarks(int argc, char* argv[])
{
  TestBall ball(0.05, 16, 12);

  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(ball.Actor);
  scene->SetDevice(device);
  scene->SetStiffness(110.0);
  vtkNew<vtkHapticView> view;
  view->SetScene(scene);
  vtkGodObjectActor* hand = view->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->ShowActiveTrianglesOn();
  hand->ShowLegendOn();
  hand->ColorForceByMagnitudeOn();
  hand->SeeThroughOff();
  hand->SetSize(0.035);
  for (int tick = 0; tick <= 400; ++tick)
  {
    const double s = tick / 400.0;
    const double reach = s < 0.05 ? 0.07 : 0.04;
    const double angle = 2.5 - 1.3 * s;
    device->SetPosition(
      reach * std::cos(angle), -0.6 * reach * std::sin(angle), 0.8 * reach * std::sin(angle));
    scene->Step(1);
    if (tick == 120 || tick == 260)
    {
      if (scene->DropLandmark() < 0)
      {
        return EXIT_FAILURE;
      }
    }
  }
  scene->Step(1);
  if (!scene->GetTouching())
  {
    std::cerr << "The hand does not touch the ball: " << scene->GetErrorMessage() << '\n';
    return EXIT_FAILURE;
  }

  TestPicture picture(ball.Actor, hand);
  picture.LookFrom(0.0, -0.3, 0.2);
  return picture.Compare(argc, argv);
}
