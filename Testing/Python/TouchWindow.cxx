// A window over a ball that is touched with the mouse, as a C++ program has it: it ends by q, e,
// its close button and Ctrl-C, and main() goes on after that.
#include "vtkActor.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticScene.h"
#include "vtkHapticView.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkMouseHapticDevice.h"
#include "vtkNew.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"

#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(40);
  ball->SetPhiResolution(40);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);

  vtkNew<vtkInteractorStyleHaptic> style;
  vtkHapticScene* scene = style->GetScene();
  scene->AddSurface(actor);
  vtkNew<vtkMouseHapticDevice> mouse;
  scene->SetDevice(mouse);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->AddViewProp(style->GetView()->GetGodObjectActor());
  renderer->AddViewProp(style->GetView()->GetOverlay());
  vtkNew<vtkRenderWindow> window;
  window->SetSize(300, 200);
  window->SetWindowName("VTK Haptics");
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(style);
  interactor->Initialize();
  window->Render();
  if (!scene->EngageInView(renderer->GetActiveCamera()))
  {
    std::cerr << scene->GetErrorMessage() << "\n";
    return 1;
  }
  interactor->Start();
  std::cout << "the event loop has ended\n";
  return style->GetInterrupted() ? 130 : 0;
}
