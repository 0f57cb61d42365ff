// The hand slides over a bump in virtual time: surface, god-object, HIP below it, spring, force
// arrow and trail must be where the baseline has them.
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

int TestGodObjectActor(int argc, char* argv[])
{
  vtkNew<vtkSphereSource> bump;
  bump->SetRadius(0.05);
  bump->SetThetaResolution(60);
  bump->SetPhiResolution(60);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(bump->GetOutputPort());
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
  hand->SetSize(0.03);
  for (int tick = 0; tick <= 100; ++tick)
  {
    const double s = tick / 100.0;
    device->SetPosition(-0.03 + 0.05 * s, -0.02 + 0.035 * s, s < 0.05 ? 0.06 : 0.034);
    scene->Step(1);
  }
  if (!scene->GetTouching())
  {
    cerr << "The hand does not touch the sphere: " << scene->GetErrorMessage() << endl;
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
  renderer->GetActiveCamera()->SetPosition(0.05, -0.2, 0.25);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.3);
  renderer->ResetCameraClippingRange();
  hand->IncludeInClippingRange(renderer);
  window->Render();

  // The default of 10 would not even miss the arrow; this leaves room for another driver's edges.
  const int result = vtkRegressionTestImageThreshold(window, 0.2);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
}
