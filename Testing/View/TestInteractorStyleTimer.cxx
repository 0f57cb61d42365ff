// The style's timer in a real event loop: VTK 9.1's ProcessEvents() fires no timers.
//
// A program of its own, with one window and one loop. VTK 9.2 and 9.3 keep every X interactor that
// was ever initialised in a list, from which only the end of its own loop takes it: a loop looks at
// those of windows that are long gone, and crashes in XPending(). And where a loop has ended its
// window is closed, so that there is no second one.
#include "StyleTestTools.h"

#include "vtkCallbackCommand.h"

#include <gtest/gtest.h>

TEST(InteractorStyleTimer, HasOneTimerThatRunsAndDisturbsNobodyElse)
{
  Window window;
  EventCounter others(window.Interactor, vtkCommand::TimerEvent);
  window.Table->SetPosition(0.0, 0.0, 0.001);
  const vtkIdType before = window.Style->GetNumberOfRenders();
  // It ends at the style's first render, or when the guard's time is up.
  struct Loop
  {
    Window& Watched;
    vtkIdType Before;
    int Guard;
  } loop{ window, before, 0 };
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&loop);
  stop->SetCallback(
    [](vtkObject*, unsigned long, void* data, void* timer)
    {
      const auto& l = *static_cast<Loop*>(data);
      if (l.Watched.Style->GetNumberOfRenders() > l.Before ||
        (timer && *static_cast<int*>(timer) == l.Guard))
      {
        l.Watched.Interactor->TerminateApp();
      }
    });
  window.RenderWindow->AddObserver(vtkCommand::EndEvent, stop);
  window.Interactor->AddObserver(vtkCommand::TimerEvent, stop);
  loop.Guard = window.Interactor->CreateOneShotTimer(10000);
  window.Interactor->Start();
  EXPECT_EQ(window.Style->GetNumberOfRenders(), before + 1) << "the timer has not come";
  EXPECT_EQ(others.Count, 0) << "the trackball style would take the timer for its own";
}
