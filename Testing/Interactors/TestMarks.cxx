// A ball is stroked from left to right; two landmarks, the trail, the touched triangle, the force
// coloured by its strength with its legend; the HIP is occluded by the ball, not seen through it.
// Seen to fail when the landmarks' part was never visible.
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticScene.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSimulatedHapticDevice.h"
#include "vtkSphereSource.h"

#include <cmath>

int TestMarks(int argc, char* argv[])
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  ball->SetThetaResolution(16);
  ball->SetPhiResolution(12);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> surface;
  surface->SetMapper(mapper);
  surface->GetProperty()->SetColor(0.55, 0.65, 0.75);

  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(surface);
  scene->SetDevice(device);
  scene->SetStiffness(150.0);
  vtkGodObjectActor* hand = scene->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->ShowActiveTrianglesOn();
  hand->ShowLegendOn();
  hand->ColorForceByMagnitudeOn();
  hand->SeeThroughOff();
  hand->SetSize(0.025);
  for (int tick = 0; tick <= 400; ++tick)
  {
    const double s = tick / 400.0;
    const double reach = s < 0.05 ? 0.07 : 0.04;
    const double angle = 2.4 - 1.5 * s;
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
    cerr << "The hand does not touch the ball: " << scene->GetErrorMessage() << endl;
    return EXIT_FAILURE;
  }

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.95, 0.95, 0.95);
  renderer->AddActor(surface);
  renderer->AddViewProp(hand);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(300, 300);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  renderer->GetActiveCamera()->SetPosition(0.0, -0.3, 0.2);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.3);
  renderer->ResetCameraClippingRange();
  hand->IncludeInClippingRange(renderer);
  window->Render();

  const int result = vtkRegressionTestImageThreshold(window, 0.2);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
}
