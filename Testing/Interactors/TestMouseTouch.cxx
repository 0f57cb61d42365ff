// The mouse strokes a sphere with the space bar held, in virtual time: hand under the cursor,
// arrow, trail, and the bar and number of the force. Seen to fail when the bar was always empty.
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticScene.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkMouseHapticDevice.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

int TestMouseTouch(int argc, char* argv[])
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(30.0); // the workspace is fitted: any unit will do
  ball->SetThetaResolution(60);
  ball->SetPhiResolution(60);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> surface;
  surface->SetMapper(mapper);
  surface->GetProperty()->SetColor(0.55, 0.65, 0.75);

  vtkNew<vtkMouseHapticDevice> mouse;
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(surface);
  scene->SetDevice(mouse);
  vtkGodObjectActor* hand = scene->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->SetSize(0.03);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.95, 0.95, 0.95);
  renderer->AddActor(surface);
  renderer->AddViewProp(hand);
  renderer->AddViewProp(scene->GetOverlay());
  vtkNew<vtkRenderWindow> window;
  window->SetSize(300, 300);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleHaptic> style;
  style->SetScene(scene);
  interactor->SetInteractorStyle(style);
  interactor->Initialize();
  renderer->ResetCamera();
  window->Render();
  if (!scene->FitWorkspace(renderer->GetActiveCamera()))
  {
    return EXIT_FAILURE;
  }
  style->UpdateScene(); // connects the mouse
  scene->Step(1);       // opens it
  interactor->SetEventInformation(90, 110, 0, 0);
  interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
  scene->Step(200);
  interactor->SetEventInformation(90, 110, 0, 0, 0, 0, "space");
  interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  for (int x = 90; x <= 200; x += 2)
  {
    interactor->SetEventInformation(x, 110 + (x - 90) / 2, 0, 0);
    interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
    scene->Step(16); // of 60 frames a second
  }
  if (!scene->GetTouching())
  {
    cerr << "The mouse does not touch the ball: " << scene->GetErrorMessage() << endl;
    return EXIT_FAILURE;
  }
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
