// The table lies at z = 0 and fills the window; the camera looks down on it. The mouse's window is
// stepped in virtual time.
//
//        camera  |
//                v   hand   o  under the cursor
//     ------------------------------ table
#include "StyleTestTools.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkHapticGrip.h"
#include "vtkHapticOverlay.h"
#include "vtkMouseHapticDevice.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
/// A table at z = 0, 0.2 m wide, that slopes by 1 mm to a slit along y: two walls that meet below.
vtkSmartPointer<vtkPolyData> MakeSlit(double width, double depth)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  const double profile[7][2] = { { -0.1, 0.0 }, { -0.006, 0.0 }, { -0.5 * width, -0.001 },
    { 0.0, -depth }, { 0.5 * width, -0.001 }, { 0.006, 0.0 }, { 0.1, 0.0 } };
  for (const auto& corner : profile)
  {
    points->InsertNextPoint(corner[0], -0.1, corner[1]);
    points->InsertNextPoint(corner[0], 0.1, corner[1]);
  }
  for (vtkIdType i = 0; i < 12; i += 2)
  {
    const vtkIdType quad[4] = { i, i + 2, i + 3, i + 1 };
    quads->InsertNextCell(4, quad);
  }
  vtkNew<vtkPolyData> slit;
  slit->SetPoints(points);
  slit->SetPolys(quads);
  return slit;
}

struct MouseWindow : Window
{
  vtkNew<vtkMouseHapticDevice> Mouse;

  MouseWindow()
  {
    this->Hand.Scene->SetDevice(this->Mouse);
    this->Mouse->SetTarget(0.0, 0.0, 0.02);
    this->Mouse->SetSmoothing(0.0);
    this->Timer(); // the style connects the mouse
    this->Tick();
  }
  void Tick() { this->Hand.Scene->Step(1); }
  /// All timers of the interactor run out.
  void RunTimersOut()
  {
    for (int id = 1; id < 50; ++id)
    {
      this->Interactor->InvokeEvent(vtkCommand::TimerEvent, &id);
    }
  }
  double Height() { return this->Hand.Scene->GetHapticInterfacePoint()[2]; }
  /// Where a point of the world is in the window [pixel].
  void Project(const double world[3], double display[2])
  {
    this->Renderer->SetWorldPoint(world[0], world[1], world[2], 1.0);
    this->Renderer->WorldToDisplay();
    std::copy_n(this->Renderer->GetDisplayPoint(), 2, display);
  }
};
}

TEST(MouseHapticDevice, HoversOnTheSurfaceUnderTheCursorWithoutTouching)
{
  MouseWindow window;
  EXPECT_EQ(window.Mouse->GetInteractor(), window.Interactor.Get());
  window.Table->RotateX(20.0);
  window.Timer();
  window.Hand.Scene->Step(100);
  for (const int x : { 30, 60 })
  {
    window.Send(vtkCommand::MouseMoveEvent, x, 45);
    window.Tick();
    double display[2];
    window.Project(window.Hand.Scene->GetHapticInterfacePoint(), display);
    EXPECT_NEAR(display[0], x, 1e-6);
    EXPECT_NEAR(display[1], 45.0, 1e-6);
    EXPECT_FALSE(window.Hand.Scene->GetTouching());
    window.Mouse->SetPressed(true);
    window.Tick();
    EXPECT_TRUE(window.Hand.Scene->GetTouching()) << "one tick later: it was just above";
    window.Mouse->SetPressed(false);
    window.Tick();
    EXPECT_FALSE(window.Hand.Scene->GetTouching());
  }
}

TEST(MouseHapticDevice, AHeldPressEndsWhereTheMouseLeavesTheWindowAndAChosenOneStays)
{
  MouseWindow window;
  window.Send(vtkCommand::MouseMoveEvent, 40, 45);
  window.Send(vtkCommand::KeyPressEvent, 40, 45, "space");
  window.Tick();
  EXPECT_TRUE(window.Mouse->GetPressed());
  window.Send(vtkCommand::LeaveEvent, 99, 45);
  window.Tick();
  EXPECT_FALSE(window.Mouse->GetPressed()) << "the key's release would go unheard";

  window.Send(vtkCommand::MouseMoveEvent, 40, 45);
  window.Mouse->SetPressed(true); // as a button next to the view does
  window.Tick();
  window.Send(vtkCommand::LeaveEvent, 99, 45);
  window.Tick();
  EXPECT_TRUE(window.Mouse->GetPressed());
  EXPECT_TRUE(window.Hand.Scene->GetTouching());
}

// The cursor goes over a step, from the lower table to one above it, and over its edge into the
// emptiness: the hand is put down on the other side, and never between.
TEST(MouseHapticDevice, IsPutDownBehindAnEdgeAndWaitsOverNothing)
{
  MouseWindow window;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> step;
  step->SetMapper(mapper);
  step->SetPosition(0.0, 0.0, 0.03);
  step->SetScale(0.3, 0.3, 1.0);
  window.Renderer->AddActor(step);
  window.Hand.Scene->AddSurface(step);
  window.Timer();
  const double edge[3] = { 0.3 * window.Table->GetBounds()[1], 0.0, 0.03 };
  double at[2];
  window.Project(edge, at);
  const int x = static_cast<int>(at[0]);
  window.Send(vtkCommand::MouseMoveEvent, x + 6, 50);
  window.Send(vtkCommand::KeyPressEvent, x + 6, 50, "space");
  window.Tick();
  EXPECT_NEAR(window.Hand.Scene->GetGodObject()[2], 0.0, Clearance);
  for (const int left : { 6, 7, 8 })
  {
    window.Send(vtkCommand::MouseMoveEvent, x - left, 50);
    window.Tick();
    EXPECT_NEAR(window.Hand.Scene->GetGodObject()[2], 0.03, Clearance);
    EXPECT_NEAR(window.Hand.Scene->GetPenetration(), 0.003, Clearance) << "steady";
  }
  const double outside[3] = { 2.0 * window.Table->GetBounds()[1], 0.0, 0.0 };
  window.Project(outside, at);
  window.Table->VisibilityOff();
  window.Timer();
  window.Send(vtkCommand::MouseMoveEvent, 95, 50);
  window.Tick();
  EXPECT_TRUE(window.Mouse->GetWaiting());
  EXPECT_STRNE(window.Mouse->GetStatusMessage(), "");
  EXPECT_FALSE(window.Hand.Scene->GetTouching());
  EXPECT_NEAR(window.Height(), 0.031, 0.0005) << "over the place where it was";
  window.Send(vtkCommand::MouseMoveEvent, x - 8, 50);
  window.Tick();
  EXPECT_FALSE(window.Mouse->GetWaiting());
  EXPECT_TRUE(window.Hand.Scene->GetTouching()) << "the key is held all the while";
}

// A slit that no pixel shows, as between two folds of a cortex. The hand slides over it, and the
// god-object falls in, after which nobody looks for a while, as while a large picture is drawn:
//
//        o hand  -->
//     ----_________  _________-----
//                  ||
//                  ||
//                 o  god-object, kept from following
TEST(MouseHapticDevice, AHandIsNoDeeperThanAskedForWhereAFoldHoldsTheGodObject)
{
  MouseWindow window;
  window.Mouse->Close();
  window.Mouse->SetSmoothing(0.012);
  window.Mouse->Open();
  const double middle[3] = { 0.0, 0.0, 0.0 };
  double at[2];
  window.Project(middle, at);
  const int x = static_cast<int>(at[0]);
  vtkNew<vtkActor> slit;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeSlit(2e-5, 0.02));
  slit->SetMapper(mapper);
  slit->SetPosition(0.001, 0.0, 0.01); // between two pixels
  window.Renderer->AddActor(slit);
  window.Hand.Scene->AddSurface(slit);
  window.Timer();
  window.Send(vtkCommand::MouseMoveEvent, x - 4, 50);
  window.Send(vtkCommand::KeyPressEvent, x - 4, 50, "space");
  window.Hand.Scene->Step(200);
  ASSERT_NEAR(window.Hand.Scene->GetPenetration(), 0.003, 1e-5);
  window.Send(vtkCommand::MouseMoveEvent, x + 5, 50);
  int deep = 0;
  for (int i = 0; i < 300; ++i)
  {
    window.Tick();
    deep += window.Hand.Scene->GetPenetration() > 1.25 * 0.003;
  }
  ASSERT_LT(window.Hand.Scene->GetGodObject()[2], 0.0089)
    << "it is in the slit, or this shows nothing";
  EXPECT_LE(deep, 1) << "the tick in which the hand notices it";
  EXPECT_GT(window.Hand.Scene->GetPenetration(), 0.0031) << "it goes as far as that";
  // Whoever looks again puts the hand down where the cursor is.
  for (int i = 0; i < 20; ++i)
  {
    window.Timer();
    window.Tick();
  }
  EXPECT_NEAR(window.Hand.Scene->GetGodObject()[2], 0.01, Clearance);
  EXPECT_NEAR(window.Hand.Scene->GetPenetration(), 0.003, 1e-5);
}

TEST(MouseHapticDevice, ShiftWithTheLeftButtonPressesAndLeavesTheCameraAlone)
{
  MouseWindow window;
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  double before[3];
  camera->GetPosition(before);
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Interactor->SetEventInformation(50, 50, 0, 1);
  window.Interactor->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  for (const int x : { 52, 54 })
  {
    window.Interactor->SetEventInformation(x, 50, 0, 1);
    window.Interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
    window.Hand.Scene->Step(100);
    EXPECT_NEAR(window.Hand.Scene->GetForce()[2], 500.0 * 0.003, 1e-3);
  }
  window.Interactor->SetEventInformation(54, 50, 0, 0); // Shift was let go first
  window.Interactor->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
  window.Tick();
  EXPECT_FALSE(window.Hand.Scene->GetTouching());
  EXPECT_TRUE(std::equal(before, before + 3, camera->GetPosition()));
}

TEST(MouseHapticDevice, TheWheelSetsHowDeepWhileSpaceIsHeld)
{
  MouseWindow window;
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  window.Hand.Scene->Step(100);
  EXPECT_NEAR(window.Hand.Scene->GetForce()[2], 500.0 * 0.004, 1e-3);
  for (int i = 0; i < 50; ++i)
  {
    window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  }
  EXPECT_LE(500.0 * window.Mouse->GetPressDepth(), window.Mouse->GetMaximumForce());
  for (int i = 0; i < 50; ++i)
  {
    window.Send(vtkCommand::MouseWheelBackwardEvent, 50, 50);
  }
  window.Hand.Scene->Step(100);
  EXPECT_TRUE(window.Hand.Scene->GetTouching()) << "as long as it is held";
}

TEST(MouseHapticDevice, TheWheelLandsOnTheSurfaceThenPressesAStepANotch)
{
  MouseWindow window;
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Tick();
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  window.Tick();
  EXPECT_NEAR(window.Height(), -0.001, 1e-9);
  EXPECT_TRUE(window.Hand.Scene->GetTouching());
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  window.Tick();
  EXPECT_NEAR(window.Height(), -0.002, 1e-9);
  EXPECT_NEAR(window.Hand.Scene->GetForce()[2], 500.0 * 0.002, 500.0 * Clearance);
  for (int i = 0; i < 3; ++i)
  {
    window.Send(vtkCommand::MouseWheelBackwardEvent, 50, 50);
    window.Tick();
  }
  EXPECT_FALSE(window.Hand.Scene->GetTouching());
  EXPECT_EQ(window.Hand.Scene->GetForce()[2], 0.0);
}

TEST(MouseHapticDevice, TheWheelZoomsAgainOnceTheSceneIsReleased)
{
  MouseWindow window;
  vtkCamera* camera = window.Renderer->GetActiveCamera();
  const double before = camera->GetDistance();
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  EXPECT_EQ(camera->GetDistance(), before);
  window.Hand.Scene->Release();
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  EXPECT_LT(camera->GetDistance(), before);
}

TEST(MouseHapticDevice, ASpaceBarThatIsLetGoOfBetweenTwoRunsIsNotPressed)
{
  MouseWindow window;
  window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
  EXPECT_TRUE(window.Mouse->GetPressed());
  window.Hand.Scene->Release();
  window.Send(vtkCommand::KeyReleaseEvent, 50, 50, "space");
  window.Tick();
  EXPECT_FALSE(window.Mouse->GetPressed());
}

TEST(MouseHapticDevice, TheWheelZoomsOnlyWithControl)
{
  MouseWindow window;
  const double before = window.Renderer->GetActiveCamera()->GetDistance();
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50);
  EXPECT_EQ(window.Renderer->GetActiveCamera()->GetDistance(), before);
  window.Send(vtkCommand::MouseWheelForwardEvent, 50, 50, nullptr, true);
  EXPECT_LT(window.Renderer->GetActiveCamera()->GetDistance(), before);
}

TEST(MouseHapticDevice, TheSpaceBarPressesFollowsTheSurfaceAndLiftsOff)
{
  MouseWindow window;
  window.Table->RotateX(20.0); // a plane of the view would leave it
  window.Timer();
  window.Hand.Scene->Step(100); // the table turns at 5 m/s at most
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
  for (const int y : { 50, 40, 30 })
  {
    window.Send(vtkCommand::MouseMoveEvent, 50, y);
    window.Tick();
    EXPECT_TRUE(window.Hand.Scene->GetTouching());
    // 3 mm along the view: across the tilted table that is less, but for the view's own angle.
    EXPECT_NEAR(window.Hand.Scene->GetPenetration(), 0.003 * std::cos(0.35), 0.0005);
  }
  window.Send(vtkCommand::KeyReleaseEvent, 50, 30, "space");
  window.RunTimersOut();
  window.Tick();
  EXPECT_FALSE(window.Hand.Scene->GetTouching());
}

TEST(MouseHapticDevice, ASpaceBarThatRepeatsItselfIsNotLetGo)
{
  MouseWindow window;
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
  for (int i = 0; i < 5; ++i)
  {
    window.Send(vtkCommand::KeyReleaseEvent, 50, 50, "space");
    window.Tick();
    EXPECT_TRUE(window.Hand.Scene->GetTouching());
    window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
    window.RunTimersOut();
    window.Tick();
    EXPECT_TRUE(window.Hand.Scene->GetTouching());
  }
  window.Send(vtkCommand::KeyReleaseEvent, 50, 50, "space");
  window.RunTimersOut();
  window.Tick();
  EXPECT_FALSE(window.Hand.Scene->GetTouching());
}

// The style that drags the camera takes events for itself. The key that is let go of just before,
// or meanwhile, is heard all the same.
TEST(MouseHapticDevice, ASpaceBarThatIsLetGoOfWhileTheCameraIsDraggedIsNotHeld)
{
  for (const bool isBefore : { true, false })
  {
    MouseWindow window;
    window.Send(vtkCommand::MouseMoveEvent, 50, 50);
    window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
    window.Tick();
    ASSERT_TRUE(window.Hand.Scene->GetTouching());
    if (isBefore)
    {
      window.Send(vtkCommand::KeyReleaseEvent, 50, 50, "space");
    }
    window.Send(vtkCommand::LeftButtonPressEvent, 50, 50);
    window.Send(vtkCommand::MouseMoveEvent, 60, 50);
    if (!isBefore)
    {
      window.Send(vtkCommand::KeyReleaseEvent, 60, 50, "space");
    }
    window.RunTimersOut();
    window.Tick();
    EXPECT_FALSE(window.Mouse->GetPressed()) << isBefore;
    EXPECT_FALSE(window.Hand.Scene->GetTouching()) << isBefore;
    window.Send(vtkCommand::LeftButtonReleaseEvent, 60, 50);
    window.Tick();
    EXPECT_FALSE(window.Hand.Scene->GetTouching()) << isBefore;
  }
}

// x with the space bar held: the hand carries the table in the plane of the view, and is not drawn
// down to the floor behind it; with the wheel it goes there in steps.
TEST(MouseHapticDevice, AKeyGripsTheTableAndTheMouseCarriesIt)
{
  MouseWindow window;
  window.Hand.Scene->AddSurface(MakeTable(-0.05));
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Send(vtkCommand::KeyPressEvent, 50, 50, "space");
  window.Tick();
  ASSERT_TRUE(window.Hand.Scene->GetTouching());
  double held[3];
  window.Hand.Scene->GetGodObject(held);
  window.Press('x');
  for (const int x : { 50, 60, 70 })
  {
    window.Send(vtkCommand::MouseMoveEvent, x, 45);
    window.Tick();
    EXPECT_NEAR(window.Height(), -0.003, 1e-9);
  }
  double display[2];
  double carried[3];
  for (int i = 0; i < 3; ++i)
  {
    carried[i] = held[i] + window.Table->GetPosition()[i];
  }
  window.Project(carried, display);
  EXPECT_NEAR(display[0], 70.0, 1e-6) << "what was gripped is under the cursor";
  EXPECT_NEAR(display[1], 45.0, 1e-6);
  window.Send(vtkCommand::MouseWheelForwardEvent, 70, 45);
  window.Tick();
  EXPECT_NEAR(window.Height(), -0.008, 1e-9);
  EXPECT_NEAR(window.Table->GetPosition()[2], -0.008, Clearance);
  window.Press('x');
  window.Tick();
  EXPECT_EQ(window.Hand.Scene->GetGrip()->GetSurface(), -1);
  window.Send(vtkCommand::MouseMoveEvent, 71, 45);
  window.Tick();
  EXPECT_NEAR(window.Hand.Scene->GetForce()[2], 500.0 * 0.003, 1e-3) << "space presses on";
}

TEST(MouseHapticDevice, StaysWhileTheCameraIsDragged)
{
  MouseWindow window;
  window.Send(vtkCommand::MouseMoveEvent, 50, 50);
  window.Send(vtkCommand::LeftButtonPressEvent, 50, 50);
  double before[3];
  window.Mouse->GetTarget(before);
  window.Send(vtkCommand::MouseMoveEvent, 80, 60);
  double after[3];
  window.Mouse->GetTarget(after);
  EXPECT_TRUE(std::equal(before, before + 3, after));
  EXPECT_GT(std::abs(window.Renderer->GetActiveCamera()->GetPosition()[0]), 1e-3);
  EXPECT_TRUE(window.Mouse->GetWaiting());
  window.Send(vtkCommand::LeftButtonReleaseEvent, 80, 60);
  window.Send(vtkCommand::MouseMoveEvent, 55, 50);
  EXPECT_FALSE(window.Mouse->GetWaiting());
  window.Mouse->GetTarget(after);
  EXPECT_NE(before[0], after[0]);
}

TEST(MouseHapticDevice, TheHandComesSmoothlyAndThenRests)
{
  MouseWindow window;
  window.Mouse->Close();
  window.Mouse->SetSmoothing(0.012);
  window.Mouse->Open();
  window.Tick();
  window.Mouse->SetTarget(0.01, 0.0, 0.02);
  window.Hand.Scene->Step(12);
  const double after12 = window.Hand.Scene->GetHapticInterfacePoint()[0];
  EXPECT_NEAR(after12, 0.01 * (1.0 - std::exp(-1.0)), 1e-3) << "the time constant";
  window.Hand.Scene->Step(200);
  EXPECT_EQ(window.Hand.Scene->GetHapticInterfacePoint()[0], 0.01) << "not nearly, but there";
  const vtkIdType renders = window.Style->GetNumberOfRenders();
  window.Timer();
  window.Hand.Scene->Step(50);
  window.Timer();
  EXPECT_EQ(window.Style->GetNumberOfRenders(), renders) << "a hand at rest was drawn again";
}

TEST(MouseHapticDevice, WorksInParallelProjectionAndWithoutSceneOrInteractorDoesNothing)
{
  MouseWindow window;
  window.Renderer->GetActiveCamera()->ParallelProjectionOn();
  window.Send(vtkCommand::MouseMoveEvent, 30, 60);
  window.Tick();
  double display[2];
  window.Project(window.Hand.Scene->GetHapticInterfacePoint(), display);
  EXPECT_NEAR(display[0], 30.0, 1e-6);

  vtkNew<vtkMouseHapticDevice> alone;
  double before[3];
  alone->GetTarget(before);
  alone->MoveTo(3, 4);
  alone->Turn(1);
  alone->SetPressed(true);
  double after[3];
  alone->GetTarget(after);
  EXPECT_TRUE(std::equal(before, before + 3, after));
  EventCounter errors(alone, vtkCommand::ErrorEvent);
  alone->SetTarget(std::nan(""), 0.0, 0.0);
  EXPECT_EQ(errors.Count, 1);
}

TEST(InteractorStyleHaptic, TheHelpNamesItsKeysAndTheMouse)
{
  MouseWindow window;
  window.Press('?');
  vtkHapticOverlay* overlay = window.Style->GetView()->GetOverlay();
  EXPECT_TRUE(overlay->GetShowHelp());
  EXPECT_TRUE(window.Renderer->HasViewProp(overlay));
  for (const char* named : { "space", "wheel", "engage", "quit" })
  {
    EXPECT_NE(overlay->GetHelp().find(named), std::string::npos) << named;
  }
  window.Press('?');
  EXPECT_FALSE(overlay->GetShowHelp());
}
