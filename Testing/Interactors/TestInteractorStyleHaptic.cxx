#include "StyleTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkMatrix4x4.h"

#include <gtest/gtest.h>

#include <chrono>

TEST(InteractorStyleHaptic, RendersOnlyWhenSomethingHasChanged)
{
  Window window;
  ASSERT_NE(window.Style->GetTimerId(), 0);
  EventCounter renders(window.RenderWindow, vtkCommand::EndEvent);
  for (int i = 0; i < 30; ++i)
  {
    window.Timer();
  }
  EXPECT_EQ(renders.Count, 0) << "nothing moved";
  window.Table->SetPosition(0.0, 0.0, 0.001);
  window.Timer();
  EXPECT_EQ(renders.Count, 1);
  window.Timer();
  EXPECT_EQ(renders.Count, 1);
}

TEST(InteractorStyleHaptic, HasOneTimerThatRunsAndDisturbsNobodyElse)
{
  Window window;
  EventCounter others(window.Interactor, vtkCommand::TimerEvent);
  window.Table->SetPosition(0.0, 0.0, 0.001);
  const vtkIdType before = window.Style->GetNumberOfRenders();
  // VTK 9.1's ProcessEvents() fires no timers; the event loop does in every version. It ends at
  // each render, the window's own too, or when the guard's time is up.
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(window.Interactor);
  stop->SetCallback([](vtkObject*, unsigned long, void* interactor, void*)
    { static_cast<vtkRenderWindowInteractor*>(interactor)->TerminateApp(); });
  window.RenderWindow->AddObserver(vtkCommand::EndEvent, stop);
  window.Interactor->AddObserver(vtkCommand::TimerEvent, stop);
  window.Interactor->CreateOneShotTimer(10000);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (
    window.Style->GetNumberOfRenders() == before && std::chrono::steady_clock::now() < deadline)
  {
    window.Interactor->Start();
  }
  EXPECT_EQ(window.Style->GetNumberOfRenders(), before + 1) << "the timer has not come";
  EXPECT_EQ(others.Count, 0) << "the trackball style would take the timer for its own";
}

TEST(InteractorStyleHaptic, TheCameraTurnsAsInTheTrackballStyle)
{
  Window window;
  Window plain;
  vtkNew<vtkInteractorStyleTrackballCamera> trackball;
  plain.Interactor->SetInteractorStyle(trackball);
  for (Window* each : { &window, &plain })
  {
    vtkRenderWindowInteractor* interactor = each->Interactor;
    interactor->SetEventInformation(50, 50, 0, 0);
    interactor->InvokeEvent(vtkCommand::LeftButtonPressEvent);
    interactor->SetEventInformation(70, 60, 0, 0);
    interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
    // A timer of the scene's in the middle of a drag must not turn it further.
    each->Timer();
    interactor->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  }
  const double* turned = window.Renderer->GetActiveCamera()->GetPosition();
  const double* expected = plain.Renderer->GetActiveCamera()->GetPosition();
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(turned[i], expected[i], 1e-12);
  }
  EXPECT_GT(std::abs(turned[0]), 1e-3) << "the drag did turn the camera";
}

TEST(InteractorStyleHaptic, KeysEngageReleaseAndShowTheTrail)
{
  Window window;
  window.Press('h');
  EXPECT_TRUE(window.Hand.Scene->IsEngaged());
  window.Press('h');
  EXPECT_FALSE(window.Hand.Scene->IsEngaged());
  window.Press('b');
  EXPECT_TRUE(window.Hand.Scene->GetGodObjectActor()->GetShowTrail());
  window.Press('v');
  EXPECT_NE(window.Hand.Scene->GetWorkspaceTransform()->GetElement(0, 0), 1.0)
    << "fitted to the table as the camera sees it";
}

TEST(InteractorStyleHaptic, TheHandIsWithinTheClippingRange)
{
  Window window;
  window.Hand.MoveTo(0.3); // far above the flat table, towards the camera
  window.Table->SetPosition(0.0, 0.0, 0.001);
  window.Timer();
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  double range[2];
  camera->GetClippingRange(range);
  const double depth = camera->GetPosition()[2] - 0.3;
  ASSERT_GT(depth, 0.0);
  EXPECT_LT(range[0], depth);
  EXPECT_GT(range[1], depth);
}

TEST(InteractorStyleHaptic, AClosedWindowReleasesTheScene)
{
  Window window;
  ASSERT_TRUE(window.Hand.Scene->Engage());
  window.Interactor->InvokeEvent(vtkCommand::ExitEvent);
  EXPECT_FALSE(window.Hand.Scene->IsEngaged());
  EXPECT_EQ(window.Style->GetTimerId(), 0);
}

TEST(InteractorStyleHaptic, OutlivesItsInteractorAndItsWindow)
{
  vtkNew<vtkInteractorStyleHaptic> style;
  vtkSmartPointer<vtkHapticScene> scene;
  {
    Window window;
    scene = window.Hand.Scene;
    window.Interactor->SetInteractorStyle(style);
    style->SetScene(scene);
    ASSERT_NE(style->GetTimerId(), 0);
    window.RenderWindow->Finalize();
    window.Timer();
  }
  EXPECT_EQ(style->GetTimerId(), 0);
  EXPECT_FALSE(style->UpdateScene());
}
