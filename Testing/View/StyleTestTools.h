#ifndef Haptics_StyleTestTools_h
#define Haptics_StyleTestTools_h

#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkGodObjectActor.h"
#include "vtkHapticView.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <chrono>
#include <thread>

/// A window of 100 by 100 pixels over a table, whose events the test sends itself, one by one.
struct Window
{
  LedHand Hand;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> RenderWindow;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkInteractorStyleHaptic> Style;
  vtkNew<vtkActor> Table;

  Window()
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(MakeTable(0.0));
    this->Table->SetMapper(mapper);
    this->Renderer->AddActor(this->Table);
    this->Renderer->AddViewProp(this->Style->GetView()->GetGodObjectActor());
    this->RenderWindow->SetSize(100, 100);
    this->RenderWindow->AddRenderer(this->Renderer);
    this->Interactor->SetRenderWindow(this->RenderWindow);
    this->Style->SetScene(this->Hand.Scene);
    this->Interactor->SetInteractorStyle(this->Style);
    this->Interactor->Initialize();
    this->Renderer->ResetCamera();
    this->RenderWindow->Render();
    this->Hand.Scene->AddSurface(this->Table);
    this->Hand.MoveTo(0.01);
    this->Timer();
  }
  void Timer()
  {
    // The style rests between two pictures.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    int id = this->Style->GetTimerId();
    this->Interactor->InvokeEvent(vtkCommand::TimerEvent, &id);
  }
  void Press(char key)
  {
    this->Interactor->SetKeyEventInformation(0, 0, key, 0, nullptr);
    this->Interactor->InvokeEvent(vtkCommand::CharEvent);
  }
  /// Sends an event of the mouse, or of a key that is named as X names it.
  void Send(unsigned long event, int x, int y, const char* key = nullptr, bool control = false)
  {
    this->Interactor->SetEventInformation(x, y, control ? 1 : 0, 0, 0, 0, key);
    this->Interactor->InvokeEvent(event);
  }
};

#endif
