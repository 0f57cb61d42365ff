// The mouse strokes a sphere with the space bar held, in virtual time: hand under the cursor,
// arrow, trail, and the bar and number of the force. Seen to fail when the bar was always empty,
// without the read-out, without the trail and without the arrow.
#include "ImageTestTools.h"

#include "vtkCommand.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticScene.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkMouseHapticDevice.h"
#include "vtkNew.h"

#include <iostream>

int TestMouseTouch(int argc, char* argv[])
{
  TestBall ball(30.0, 60, 60); // the workspace is fitted: any unit will do

  vtkNew<vtkMouseHapticDevice> mouse;
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(ball.Actor);
  scene->SetDevice(mouse);
  vtkNew<vtkInteractorStyleHaptic> style;
  style->SetScene(scene);
  vtkGodObjectActor* hand = style->GetView()->GetGodObjectActor();
  hand->ShowTrailOn();
  hand->SetSize(0.03);

  TestPicture picture(ball.Actor, hand);
  vtkRenderer* const renderer = picture.Renderer;
  vtkRenderWindowInteractor* const interactor = picture.Interactor;
  renderer->AddViewProp(style->GetView()->GetOverlay());
  interactor->SetInteractorStyle(style);
  interactor->Initialize();
  renderer->ResetCamera();
  picture.Window->Render();
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
    std::cerr << "The mouse does not touch the ball: " << scene->GetErrorMessage() << '\n';
    return EXIT_FAILURE;
  }
  style->UpdateScene(); // the status line
  return picture.Compare(argc, argv);
}
