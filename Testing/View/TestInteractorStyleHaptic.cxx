#include "StyleTestTools.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkMatrix4x4.h"
#include "vtkMouseHapticDevice.h"
#include "vtkPolyDataMapper.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <vector>

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
  EXPECT_TRUE(window.Style->GetView()->GetGodObjectActor()->GetShowTrail());
}

TEST(InteractorStyleHaptic, KeysFitScaleAndResetTheWorkspace)
{
  Window window;
  const auto scale = [&window]()
  { return window.Hand.Scene->GetWorkspaceTransform()->GetElement(0, 0); };
  window.Press('h');
  const double fitted = scale();
  EXPECT_NE(fitted, 1.0) << "fitted to the table when it is first engaged";
  window.Press('+');
  EXPECT_NEAR(scale(), 1.25 * fitted, 1e-9);
  window.Press('0');
  EXPECT_EQ(scale(), fitted);
  window.Press('h');
  vtkNew<vtkMatrix4x4> own;
  ASSERT_TRUE(window.Hand.Scene->SetWorkspaceTransform(own));
  window.Press('h');
  EXPECT_EQ(scale(), 1.0) << "the scene's own choice is kept";
  window.Press('v');
  EXPECT_EQ(scale(), fitted) << "as the camera sees it";
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

TEST(InteractorStyleHaptic, AWindowClosedOrDestroyedInContactLeavesNoForce)
{
  Window other; // an X server without clients may start anew, and refuse meanwhile
  for (const bool destroyed : { false, true })
  {
    vtkSmartPointer<vtkSimulatedHapticDevice> device;
    {
      Window window;
      device = window.Hand.Device;
      window.Hand.MoveTo(-0.005);
      ASSERT_TRUE(window.Hand.Scene->GetTouching());
      window.Hand.Scene->Release();
      ASSERT_TRUE(window.Hand.Scene->Engage());
      for (int i = 0; i < 200 && !window.Hand.Scene->GetTouching(); ++i)
      {
        window.Hand.Device->SetPosition(0.01, 0.02, i < 20 ? 0.005 : -0.005);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        window.Timer();
      }
      ASSERT_TRUE(window.Hand.Scene->GetTouching());
      if (!destroyed)
      {
        window.Interactor->InvokeEvent(vtkCommand::ExitEvent);
        EXPECT_FALSE(window.Hand.Scene->IsEngaged());
        EXPECT_FALSE(window.Hand.Scene->GetTouching());
      }
    }
    double force[3];
    device->Update();
    device->GetForce(force);
    EXPECT_EQ(std::abs(force[0]) + std::abs(force[1]) + std::abs(force[2]), 0.0)
      << (destroyed ? "destroyed" : "closed");
  }
}

TEST(InteractorStyleHaptic, TwoStylesOnOneDeviceAreRefusedWithTheReason)
{
  Window first;
  Window second;
  second.Hand.Scene->SetDevice(first.Hand.Device);
  first.Hand.Scene->Release();
  first.Press('h');
  ASSERT_TRUE(first.Hand.Scene->IsEngaged());
  EventCounter errors(second.Hand.Scene->GetServo(), vtkCommand::ErrorEvent);
  second.Press('h');
  EXPECT_FALSE(second.Hand.Scene->IsEngaged());
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(
    std::string(second.Hand.Scene->GetErrorMessage()).find("in use by another"), std::string::npos);
  first.Press('h');
  second.Press('h');
  EXPECT_TRUE(second.Hand.Scene->IsEngaged()) << "once it is free";
}

TEST(HapticOverlay, ReadsOutHowFarTheLastTwoLandmarksAreApart)
{
  LedHand hand;
  vtkNew<vtkHapticView> view;
  view->SetScene(hand.Scene);
  vtkHapticOverlay* overlay = view->GetOverlay();
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  hand.Scene->DropLandmark();
  hand.Scene->Step(1);
  const auto lastLine = [&]
  {
    const std::string text = overlay->GetReadout();
    return text.substr(text.rfind('\n') + 1);
  };
  EXPECT_EQ(lastLine(), "landmark 1");
  hand.Device->SetPosition(0.01, -0.02, -0.001);
  hand.Scene->Step(1);
  hand.Scene->DropLandmark();
  hand.Scene->GetWorkspace()->SetUnitLength(1.0);
  hand.Scene->Step(1);
  EXPECT_EQ(lastLine(), "landmark 2: 0.04 m from 1");
  hand.MoveTo(0.01);
  EXPECT_EQ(overlay->GetReadout(), "landmark 2: 0.04 m from 1") << "in free space too";
  hand.Scene->GetLandmarks()->RemoveAll();
  hand.MoveTo(0.01);
  EXPECT_EQ(overlay->GetReadout(), "");
}

TEST(HapticView, BarArrowRingAndColoursEndAtTheLargestForceThatTheHandCanMeet)
{
  LedHand hand;
  vtkNew<vtkHapticView> view;
  vtkGodObjectActor* actor = view->GetGodObjectActor();
  view->SetScene(hand.Scene);
  vtkHapticOverlay* overlay = view->GetOverlay();
  const auto expect = [&](double force)
  {
    EXPECT_EQ(overlay->GetMaximumForce(), force);
    EXPECT_EQ(actor->GetReferenceForce(), force);
    EXPECT_EQ(actor->GetForceColors()->GetRange()[1], force);
  };
  hand.MoveTo(0.01);
  expect(hand.Device->GetMaximumForce());
  hand.Scene->Update();
  EXPECT_FALSE(hand.Scene->Update()) << "a hand at rest";
  hand.Scene->GetServo()->SetMaximumForce(1.5);
  expect(1.5); // at once, and drawn
  EXPECT_TRUE(hand.Scene->Update());
  EXPECT_FALSE(hand.Scene->Update());
  hand.Scene->SetTipRadius(0.001);
  EXPECT_TRUE(hand.Scene->Update() || hand.Scene->Update()) << "which has room, or not yet";
  hand.Scene->SetTipRadius(0.0);
  hand.MoveTo(0.011);
  expect(1.5);
  actor->SetReferenceForce(0.7); // by a program for a picture of its own
  hand.MoveTo(0.012);
  EXPECT_EQ(actor->GetReferenceForce(), 0.7);
  vtkNew<vtkMouseHapticDevice> mouse;
  hand.Scene->GetServo()->SetMaximumForce(VTK_DOUBLE_MAX);
  hand.Scene->SetDevice(mouse);
  hand.Scene->Step(1);
  expect(mouse->GetMaximumForce());
  hand.Scene->GetServo()->SetMaximumForce(0.0); // no force at all: a scale that can be drawn
  hand.Scene->Step(1);
  expect(3.3);
}

TEST(HapticOverlay, ReadsOutWhichSurfaceIsTouchedAndWhyThereIsNoForce)
{
  LedHand hand;
  vtkNew<vtkHapticView> view;
  view->SetScene(hand.Scene);
  vtkHapticOverlay* overlay = view->GetOverlay();
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> lid;
  lid->SetMapper(mapper);
  lid->SetPosition(0.0, 0.0, 0.02);
  hand.Scene->AddSurface(lid);
  hand.MoveTo(0.01);
  EXPECT_EQ(overlay->GetReadout(), "");
  hand.MoveTo(-0.001);
  EXPECT_EQ(overlay->GetReadout().rfind("surface 0   cell 0", 0), 0U) << overlay->GetReadout();
  hand.Scene->GetSurfaces()->SetName(table, "table");
  hand.MoveTo(-0.0011);
  EXPECT_EQ(overlay->GetReadout().rfind("table   cell 0", 0), 0U) << overlay->GetReadout();
  lid->SetPosition(0.0, 0.0, -0.003); // through the table
  hand.Scene->Step(100);
  EXPECT_EQ(overlay->GetReadout(), "surfaces leave no room here: no force");
}

namespace
{
/// Whether the rightmost columns of a window's picture are as empty as its upper right corner.
bool IsRightEdgeEmpty(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(size[0] - 4, 0, size[0] - 1, size[1] - 1, 0, pixels);
  const vtkIdType last = pixels->GetNumberOfTuples() - 1;
  for (vtkIdType pixel = 0; pixel < last; ++pixel)
  {
    for (int color = 0; color < 3; ++color)
    {
      if (pixels->GetComponent(pixel, color) != pixels->GetComponent(last, color))
      {
        return false;
      }
    }
  }
  return true;
}

/// An overlay alone in a window off screen.
struct OverlayWindow
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkHapticOverlay> Overlay;

  OverlayWindow(int width, int height)
  {
    this->Renderer->AddViewProp(this->Overlay);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Window->AddRenderer(this->Renderer);
  }
};
}

TEST(HapticOverlay, AllBoxesBeginInOneColumnAndHaveRoomAroundTheirText)
{
  const int size[2] = { 900, 400 };
  OverlayWindow shown(size[0], size[1]);
  shown.Renderer->SetBackground(0.0, 0.5, 0.0);
  shown.Overlay->SetHint("short\n(the longest line of a text, which ends in this)\nshort");
  shown.Overlay->SetStatus("|touching|");
  shown.Overlay->SetReadout("table   cell 0\n0.1, -0.1, 0.2");
  shown.Window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  shown.Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  std::set<int> begins;
  for (int y = 0; y < size[1]; ++y)
  {
    int first = -1;
    int last = -1;
    int lastLetter = -1;
    for (int x = 0; x < size[0]; ++x)
    {
      const vtkIdType pixel = static_cast<vtkIdType>(y) * size[0] + x;
      if (pixels->GetComponent(pixel, 1) != pixels->GetComponent(size[0] - 1, 1))
      {
        first = first < 0 ? x : first;
        last = x;
        lastLetter = pixels->GetComponent(pixel, 0) > 150.0 ? x : lastLetter;
      }
    }
    if (first >= 0)
    {
      begins.insert(first);
      EXPECT_GE(last - lastLetter, 6) << "in the row " << y;
    }
  }
  EXPECT_EQ(begins.size(), 1U);
}

TEST(HapticOverlay, NoTextLiesOverAnother)
{
  OverlayWindow shown(400, 300);
  const auto picture =
    [&](const std::string& readout, const std::string& help, const std::string& hint)
  {
    shown.Overlay->SetReadout(readout);
    shown.Overlay->SetHelp(help);
    shown.Overlay->SetShowHelp(!help.empty());
    shown.Overlay->SetHint(hint);
    shown.Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    shown.Window->GetPixelData(
      0, 0, shown.Window->GetSize()[0] - 1, shown.Window->GetSize()[1] - 1, 0, pixels);
    return std::vector<unsigned char>(
      pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  };
  shown.Overlay->SetStatus("touching");
  const std::string readout = "table   cell 0\n0.1, -0.1, 0.2\nSulc 1\nCurvature 2";
  const std::string line = "space held   press; move to stroke";
  std::string keys = line;
  for (int i = 0; i < 18; ++i) // as many as the help has
  {
    keys += "\n" + line;
  }
  for (const auto& size : { std::array<int, 2>{ 400, 300 }, { 600, 250 }, { 1200, 800 } })
  {
    shown.Window->SetSize(size[0], size[1]);
    const bool hasRoom = size[1] == 800;
    EXPECT_EQ(picture(readout, keys, "") != picture("", keys, ""), hasRoom)
      << size[1] << " pixels: the read-out goes for the help that is asked for";
    EXPECT_EQ(picture(readout, "", keys) != picture(readout, "", ""), hasRoom)
      << size[1] << " pixels: the hint goes for the read-out";
    EXPECT_NE(picture(readout, "", line), picture(readout, "", "")) << "room for a line";
    EXPECT_NE(picture(readout, "", line), picture("", "", line)) << "room for a line";
  }
}

TEST(HapticOverlay, NoTextIsCutOffInANarrowView)
{
  // A line of keys as in the help, a long message, and the data of an array.
  const std::string line = "space held   press; move to stroke (or Shift + left button)";
  using Show = void (*)(vtkHapticOverlay*, const std::string&);
  const Show shows[] = { [](vtkHapticOverlay* overlay, const std::string& text)
    { overlay->SetHint(text); },
    [](vtkHapticOverlay* overlay, const std::string& text) { overlay->SetStatus(text); },
    [](vtkHapticOverlay* overlay, const std::string& text) { overlay->SetReadout(text); } };
  for (const Show show : shows)
  {
    OverlayWindow shown(270, 400);
    shown.Window->Render();
    ASSERT_TRUE(IsRightEdgeEmpty(shown.Window)) << "the bar";
    show(shown.Overlay, line);
    shown.Window->Render();
    EXPECT_TRUE(IsRightEdgeEmpty(shown.Window)) << "in a font that is small enough";
    for (int width = 280; width < 600; width += 20)
    {
      shown.Window->SetSize(width, 400);
      shown.Window->Render();
      EXPECT_TRUE(IsRightEdgeEmpty(shown.Window)) << width << " pixels";
    }
    show(shown.Overlay, line + "\n" + line);
    shown.Window->SetSize(900, 400);
    shown.Window->Render();
    EXPECT_TRUE(IsRightEdgeEmpty(shown.Window)) << "with room";
  }
}
