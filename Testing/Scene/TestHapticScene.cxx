#include "SceneTestTools.h"
#include "WaitFor.h"

#include "vtkDataArray.h"
#include "vtkHapticReadings.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

TEST(HapticScene, HoldsTheGodObjectOnTheSurfaceAndPushesBack)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->SetStiffness(400.0);
  hand.MoveTo(0.01);
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_EQ(hand.Scene->GetTouchedSurface(), -1);
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);

  hand.MoveTo(-0.005);
  EXPECT_TRUE(hand.Scene->GetTouching());
  EXPECT_EQ(hand.Scene->GetTouchedSurface(), table);
  EXPECT_EQ(hand.Scene->GetTouchedCell(), 0);
  EXPECT_EQ(hand.Scene->GetHapticInterfacePoint()[2], -0.005);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
  EXPECT_NEAR(hand.Scene->GetPenetration(), 0.005, Clearance);
  EXPECT_NEAR(hand.Scene->GetForce()[2], 400.0 * 0.005, 400.0 * Clearance);
}

TEST(HapticScene, ReportsWhenContactBeginsAndEnds)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  EventCounter begins(hand.Scene, vtkHapticScene::ContactBeginEvent);
  EventCounter ends(hand.Scene, vtkHapticScene::ContactEndEvent);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  hand.MoveTo(-0.002);
  EXPECT_EQ(begins.Count, 1);
  EXPECT_EQ(ends.Count, 0);
  hand.MoveTo(0.01);
  EXPECT_EQ(begins.Count, 1);
  EXPECT_EQ(ends.Count, 1);
}

TEST(HapticScene, TouchesTheFirstOfSeveralSurfacesAndNamesIt)
{
  LedHand hand;
  const int lower = hand.Scene->AddSurface(MakeTable(-0.01));
  const int upper = hand.Scene->AddSurface(MakeTable(0.0));
  ASSERT_NE(lower, upper);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.02);
  EXPECT_EQ(hand.Scene->GetTouchedSurface(), upper);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
}

TEST(HapticScene, ARemovedSurfaceLetsTheGodObjectThrough)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  ASSERT_TRUE(hand.Scene->GetTouching());
  EXPECT_TRUE(hand.Scene->RemoveSurface(table));
  EXPECT_FALSE(hand.Scene->RemoveSurface(table));
  hand.Scene->Step(1);
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_EQ(hand.GodObjectHeight(), -0.005);
  EXPECT_NE(hand.Scene->AddSurface(MakeTable(0.0)), table) << "an id was given twice";
}

TEST(HapticScene, FollowsGeometryThatMoves)
{
  LedHand hand;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, 0.0);
  plane->SetPoint1(0.1, -0.1, 0.0);
  plane->SetPoint2(-0.1, 0.1, 0.0);
  hand.Scene->AddSurface(plane->GetOutputPort());
  hand.MoveTo(0.01);
  hand.MoveTo(-0.02);
  ASSERT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
  hand.MoveTo(0.01);
  plane->Push(-0.01);
  hand.MoveTo(-0.02);
  hand.Scene->Step(10); // it goes there over the time between two updates
  EXPECT_NEAR(hand.GodObjectHeight(), -0.01, Clearance);
}

TEST(HapticScene, KeepsWhatItTouchesWhenItsGeometryTurnsBadAndSaysWhyOnce)
{
  struct Case
  {
    const char* Name;
    void (*Spoil)(vtkPolyData*);
  };
  const Case cases[] = {
    { "without an area",
      [](vtkPolyData* p)
      {
        for (vtkIdType i = 0; i < p->GetNumberOfPoints(); ++i)
        {
          p->GetPoints()->SetPoint(i, 0.0, 0.0, 0.0);
        }
        p->GetPoints()->Modified();
      } },
    { "not finite",
      [](vtkPolyData* p)
      {
        p->GetPoints()->SetPoint(2, 0.1, std::nan(""), 0.0);
        p->GetPoints()->Modified();
      } },
    { "lines only",
      [](vtkPolyData* p)
      {
        p->SetLines(p->GetPolys());
        p->SetPolys(nullptr);
      } },
  };
  for (const Case& spoiled : cases)
  {
    SCOPED_TRACE(spoiled.Name);
    LedHand hand;
    vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
    const int id = hand.Scene->AddSurface(table);
    hand.MoveTo(0.01);
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    EventCounter reports(hand.Scene, vtkHapticScene::SurfaceErrorEvent);
    spoiled.Spoil(table);
    hand.MoveTo(-0.005);
    hand.MoveTo(-0.006);
    EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(id));
    EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
    EXPECT_EQ(errors.Count, 1);
    EXPECT_EQ(reports.Count, 1);
    EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("Surface 0"), std::string::npos)
      << hand.Scene->GetErrorMessage();
  }
}

TEST(HapticScene, ASurfaceThatWasNeverGoodIsFreeSpaceUntilItIs)
{
  LedHand hand;
  vtkNew<vtkPolyData> table;
  table->SetPoints(MakeTable(0.0)->GetPoints()); // and no cells
  const int id = hand.Scene->AddSurface(table);
  {
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    hand.MoveTo(0.01);
    EXPECT_EQ(errors.Count, 1);
  }
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsTouchable(id));
  table->DeepCopy(MakeTable(0.0));
  hand.MoveTo(-0.005);
  EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(id));
  EXPECT_TRUE(hand.Scene->GetTouching());
}

TEST(HapticScene, RefusesMissingThings)
{
  vtkNew<vtkHapticScene> scene;
  EventCounter errors(scene, vtkCommand::ErrorEvent);
  EXPECT_EQ(scene->AddSurface(static_cast<vtkPolyData*>(nullptr)), -1);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_FALSE(scene->Engage()) << "there is no device";
  EXPECT_EQ(errors.Count, 2);
  EXPECT_NE(std::string(scene->GetErrorMessage()).find("SetDevice"), std::string::npos);
  EXPECT_EQ(scene->Step(0), 0);
  EXPECT_EQ(errors.Count, 3);
}

TEST(HapticScene, UpdateReturnsWhetherAnythingChanged)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  EXPECT_TRUE(hand.Scene->Update()) << "a surface came";
  EXPECT_FALSE(hand.Scene->Update());
  hand.MoveTo(0.01);
  EXPECT_FALSE(hand.Scene->Update()) << "Step() has taken it in";
  hand.Scene->RemoveAllSurfaces();
  EXPECT_TRUE(hand.Scene->Update());
  EXPECT_FALSE(hand.Scene->Update());
}

// At rest the god-object goes to and fro by a last digit on some planes: no picture shows that.
TEST(HapticScene, AHandAtRestChangesNothing)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int changes = 0;
  for (int i = 0; i < 100; ++i)
  {
    LedHand hand;
    vtkNew<vtkPlaneSource> plane;
    plane->SetNormal(0.5 * uniform(random), 0.5 * uniform(random), 1.0);
    plane->SetCenter(uniform(random), uniform(random), uniform(random));
    plane->Update();
    hand.Scene->AddSurface(plane->GetOutput());
    const double* center = plane->GetCenter();
    const double x = center[0] + 0.1 * uniform(random);
    const double y = center[1] + 0.1 * uniform(random);
    hand.Device->SetPosition(x, y, center[2] + 0.2);
    hand.Scene->Step(1);
    hand.Device->SetPosition(x, y, center[2] - 0.2);
    hand.Scene->Step(50);
    ASSERT_TRUE(hand.Scene->GetTouching()) << i;
    const std::vector<double> before(hand.Scene->GetGodObject(), hand.Scene->GetGodObject() + 3);
    for (int tick = 0; tick < 20; ++tick)
    {
      hand.Scene->Step(1);
      changes += !std::equal(before.begin(), before.end(), hand.Scene->GetGodObject());
    }
  }
  EXPECT_EQ(changes, 0);
}

TEST(HapticScene, AHandThatCreepsIsFollowed)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(-0.005);
  for (int i = 1; i <= 10000; ++i)
  {
    const double height = -0.005 - 1e-14 * i;
    hand.MoveTo(height);
    ASSERT_NEAR(hand.Scene->GetHapticInterfacePoint()[2], height, 1.1e-12);
  }
}

TEST(HapticScene, TheTraceHasOnePointATickWithItsArrays)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.Scene->StartRecording();
  hand.MoveTo(0.005);
  hand.MoveTo(-0.004);
  hand.Scene->StopRecording();
  hand.MoveTo(-0.005);

  vtkPolyData* trace = hand.Scene->GetTrace();
  ASSERT_EQ(trace->GetNumberOfPoints(), 2);
  ASSERT_EQ(trace->GetNumberOfLines(), 1);
  const auto value = [&](const char* name, int point, int component)
  {
    vtkDataArray* array = trace->GetPointData()->GetArray(name);
    return array ? array->GetComponent(point, component) : std::nan("");
  };
  EXPECT_NEAR(value("Time", 1, 0) - value("Time", 0, 0), 0.001, 1e-12);
  EXPECT_EQ(value("HapticInterfacePoint", 1, 2), -0.004);
  EXPECT_EQ(value("ActiveConstraints", 0, 0), 0);
  EXPECT_EQ(value("ActiveConstraints", 1, 0), 1);
  EXPECT_EQ(value("Surface", 0, 0), -1);
  EXPECT_EQ(value("Surface", 1, 0), table);
  EXPECT_EQ(value("OriginalCellId", 0, 0), -1);
  EXPECT_EQ(value("OriginalCellId", 1, 0), 0);
  EXPECT_NEAR(value("Penetration", 1, 0), 0.004, Clearance);
  EXPECT_NEAR(value("Force", 1, 2), 500.0 * 0.004, 500.0 * Clearance);
  EXPECT_EQ(hand.Scene->GetTraceRecorder()->GetNumberOfLostTicks(), 0);
}

TEST(HapticScene, LongRunsInVirtualTimeLoseNoTick)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Scene->StartRecording();
  EXPECT_EQ(hand.Scene->Step(40000), 40000);
  EXPECT_EQ(hand.Scene->GetTrace()->GetNumberOfPoints(), 40000);
  EXPECT_EQ(hand.Scene->GetTraceRecorder()->GetNumberOfLostTicks(), 0);
}

TEST(HapticScene, AFullTraceStopsRecordingWithAWarning)
{
  LedHand hand;
  hand.Scene->GetTraceRecorder()->SetMaximumTicks(5);
  EventCounter warnings(hand.Scene, vtkCommand::WarningEvent);
  hand.Scene->StartRecording();
  hand.Scene->Step(20);
  EXPECT_FALSE(hand.Scene->GetTraceRecorder()->GetRecording());
  EXPECT_EQ(hand.Scene->GetTrace()->GetNumberOfPoints(), 5);
  EXPECT_EQ(warnings.Count, 1);
}

TEST(HapticScene, EngagedItTouchesInRealTimeAndReleasedItAsksForNoForce)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  ASSERT_TRUE(hand.EngagePatiently());
  EXPECT_EQ(hand.Scene->Step(1), 0) << "Step() must not run while the servo thread does";
  hand.Device->SetPosition(0.0, 0.0, 0.005);
  const auto wait = [&](const auto& condition)
  { return WaitFor(condition, [&hand] { hand.Scene->Update(); }); };
  EXPECT_TRUE(wait([&] { return hand.Scene->GetHapticInterfacePoint()[2] == 0.005; }));
  hand.Device->SetPosition(0.0, 0.0, -0.005);
  EXPECT_TRUE(wait([&] { return hand.Scene->GetTouching(); }));
  EXPECT_GT(hand.Scene->GetForce()[2], 0.0);

  hand.Scene->Release();
  EXPECT_FALSE(hand.Scene->IsEngaged());
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
  double asked[3];
  hand.Device->GetForce(asked);
  EXPECT_EQ(asked[2], 0.0);
}

TEST(HapticScene, ADeviceThatGoesAwayReleasesTheSceneAndSaysSo)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  ASSERT_TRUE(hand.Scene->Engage());
  EventCounter faults(hand.Scene, vtkHapticScene::FaultEvent);
  EventCounter errors(hand.Scene->GetServo(), vtkCommand::ErrorEvent);
  hand.Device->Close();
  for (int i = 0; i < 2000 && hand.Scene->IsEngaged(); ++i) // 10 s at most
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    hand.Scene->Update();
  }
  EXPECT_FALSE(hand.Scene->IsEngaged());
  EXPECT_EQ(faults.Count, 1);
  EXPECT_STRNE(hand.Scene->GetErrorMessage(), "");
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
}

/// A straight way down to a height, 100 mm a second.
vtkSmartPointer<vtkPolyData> MakeWayDown(double x, double height)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, 0.0, 0.01);
  points->InsertNextPoint(x, 0.0, height);
  auto way = vtkSmartPointer<vtkPolyData>::New();
  way->SetPoints(points);
  return way;
}

TEST(HapticScene, AnotherPathIsFollowedFromTheNextStepOn)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.Device->SetMotionToPolyline();
  hand.Device->SetSpeed(0.1);
  hand.Scene->StartRecording();
  for (const double depth : { 0.001, 0.002, 0.0005 })
  {
    hand.Device->SetPath(MakeWayDown(depth, -depth));
    EXPECT_EQ(hand.Scene->Step(300), 300) << hand.Scene->GetErrorMessage();
    EXPECT_NEAR(hand.Scene->GetHapticInterfacePoint()[0], depth, 1e-9) << "it follows the new one";
    EXPECT_NEAR(hand.Scene->GetForce()[2], 500.0 * depth, 500.0 * Clearance);
    EXPECT_NEAR(hand.Scene->GetServo()->GetReadings()->GetTime(), 0.299, 1e-9) << "from its start";
  }
  EXPECT_EQ(hand.Scene->GetTrace()->GetNumberOfPoints(), 900);

  vtkPolyData* path = hand.Device->GetPath(); // changed in place
  path->GetPoints()->SetPoint(1, 0.0005, 0.0, -0.001);
  path->GetPoints()->Modified();
  EXPECT_EQ(hand.Scene->Step(300), 300);
  EXPECT_NEAR(hand.Scene->GetForce()[2], 500.0 * 0.001, 500.0 * Clearance);
  EXPECT_EQ(hand.Scene->Step(1), 1);
  EXPECT_NEAR(hand.Scene->GetServo()->GetReadings()->GetTime(), 0.3, 1e-9)
    << "nothing has changed: it goes on";
}

TEST(HapticScene, ADeviceThatWasClosedAndOpenedIsSteppedOn)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  hand.MoveTo(0.01);
  hand.Device->Close();
  ASSERT_TRUE(hand.Device->Open());
  EXPECT_EQ(hand.Scene->Step(10), 10) << hand.Scene->GetErrorMessage();
  hand.Device->Close();
  EXPECT_EQ(hand.Scene->Step(10), 10) << "the scene opens it";
  EXPECT_STREQ(hand.Scene->GetErrorMessage(), "");
}

TEST(HapticScene, WhatItsServoReportsIsAnErrorOfTheSceneToo)
{
  LedHand hand;
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Scene->SetStiffness(-1.0);
  EXPECT_EQ(errors.Count, 1);
  ASSERT_TRUE(hand.Scene->Engage());
  hand.Device->Close();
  for (int i = 0; i < 2000 && hand.Scene->IsEngaged(); ++i) // 10 s at most
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    hand.Scene->Update();
  }
  EXPECT_EQ(errors.Count, 2) << "the loss of the device";
}

TEST(HapticScene, AMessageIsGoneAfterASuccess)
{
  vtkNew<vtkHapticScene> scene;
  EventCounter errors(scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(scene->Engage());
  EXPECT_EQ(scene->Step(1), 0);
  EXPECT_FALSE(scene->FitWorkspace());
  EXPECT_EQ(errors.Count, 3);
  EXPECT_STRNE(scene->GetErrorMessage(), "");
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  EXPECT_EQ(scene->Step(1), 1);
  EXPECT_STREQ(scene->GetErrorMessage(), "");
  EXPECT_EQ(scene->Step(0), 0);
  EXPECT_STRNE(scene->GetErrorMessage(), "");
  EXPECT_TRUE(scene->Engage());
  EXPECT_STREQ(scene->GetErrorMessage(), "");
  EXPECT_EQ(scene->Step(1), 0);
  EXPECT_NE(std::string(scene->GetErrorMessage()).find("Release()"), std::string::npos)
    << "what helps is a method of the object that was called: " << scene->GetErrorMessage();
  scene->Release();
}
