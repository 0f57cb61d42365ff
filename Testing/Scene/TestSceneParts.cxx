// The objects that a scene hands out: each by itself, with its scene, and after it.
#include "GripTestTools.h"

#include "vtkHapticGrip.h"
#include "vtkHapticTraceRecorder.h"
#include "vtkHapticWorkspace.h"
#include "vtkMatrix4x4.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <string>

namespace
{
constexpr double Box[6] = { -1.0, 1.0, -2.0, 2.0, -3.0, 3.0 };

std::string Text(vtkObject* object)
{
  std::ostringstream text;
  object->Print(text);
  return text.str();
}
}

TEST(SceneParts, AWorkspaceByItselfKeepsItsTransform)
{
  vtkNew<vtkHapticWorkspace> workspace;
  EXPECT_FALSE(workspace->GetChosen());
  EXPECT_EQ(workspace->GetScale(), 1.0);
  vtkNew<vtkMatrix4x4> doubled;
  doubled->SetElement(0, 0, 2.0);
  doubled->SetElement(1, 1, 2.0);
  doubled->SetElement(2, 2, 2.0);
  doubled->SetElement(0, 3, 0.5);
  EXPECT_TRUE(workspace->SetTransform(doubled));
  EXPECT_TRUE(workspace->GetChosen());
  EXPECT_TRUE(workspace->Scale(3.0));
  EXPECT_DOUBLE_EQ(workspace->GetScale(), 6.0);
  EXPECT_EQ(workspace->GetTransform()->GetElement(0, 3), 0.5) << "about the device's origin";
  workspace->SetClutched(true);
  workspace->Reset();
  EXPECT_FALSE(workspace->GetClutched());
  EXPECT_DOUBLE_EQ(workspace->GetScale(), 2.0) << "as it was set";

  EventCounter errors(workspace, vtkCommand::ErrorEvent);
  EXPECT_FALSE(workspace->Fit(Box));
  EXPECT_NE(std::string(workspace->GetErrorMessage()).find("SetDevice()"), std::string::npos);
  EXPECT_FALSE(workspace->SetTransform(nullptr));
  for (const double factor : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_FALSE(workspace->Scale(factor));
  }
  EXPECT_EQ(errors.Count, 5);
  EXPECT_TRUE(workspace->Scale(1.0));
  EXPECT_STREQ(workspace->GetErrorMessage(), "") << "after a call that succeeded";
}

TEST(SceneParts, TheWorkspaceOfASceneMovesItsServo)
{
  LedHand hand;
  hand.MoveTo(0.5);
  EXPECT_TRUE(hand.Scene->GetWorkspace()->Fit(Box));
  vtkNew<vtkMatrix4x4> servo;
  hand.Scene->GetServo()->GetWorkspaceTransform(servo);
  EXPECT_DOUBLE_EQ(servo->GetElement(1, 1), hand.Scene->GetWorkspace()->GetScale());
  EXPECT_EQ(servo->GetElement(1, 1), hand.Scene->GetWorkspaceTransform()->GetElement(1, 1));
  const vtkMTimeType before = hand.Scene->GetMTime();
  EXPECT_TRUE(hand.Scene->GetWorkspace()->Scale(2.0));
  EXPECT_GT(hand.Scene->GetMTime(), before) << "who follows the scene has to look";
}

TEST(SceneParts, WhatAPartReportsIsReportedByTheSceneToo)
{
  Workbench bench;
  EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(bench.Scene->GetWorkspace()->Scale(0.0));
  EXPECT_EQ(errors.Count, 1);
  EXPECT_STREQ(bench.Scene->GetErrorMessage(), bench.Scene->GetWorkspace()->GetErrorMessage());
  EXPECT_FALSE(bench.Scene->GetGrip()->TakeSurface(77));
  EXPECT_EQ(errors.Count, 2);
  EXPECT_STREQ(bench.Scene->GetErrorMessage(), bench.Scene->GetGrip()->GetErrorMessage());
  EXPECT_NE(std::string(bench.Scene->GetErrorMessage()).find("77"), std::string::npos);
  EXPECT_TRUE(bench.Scene->ScaleWorkspace(1.0));
  EXPECT_STREQ(bench.Scene->GetErrorMessage(), "") << "after a call that succeeded";
}

TEST(SceneParts, AGripByItselfFindsNothing)
{
  vtkNew<vtkHapticGrip> grip;
  EventCounter errors(grip, vtkCommand::ErrorEvent);
  EXPECT_FALSE(grip->Take());
  EXPECT_FALSE(grip->TakeSurface(0));
  EXPECT_EQ(errors.Count, 2);
  grip->LetGo();
  EXPECT_EQ(grip->GetSurface(), -1);
}

TEST(SceneParts, SettingWhetherATraceIsRecordedIsNoNewTrace)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkHapticTraceRecorder* recorder = hand.Scene->GetTraceRecorder();
  hand.MoveTo(0.01); // this tick is not recorded
  recorder->SetRecording(true);
  hand.MoveTo(0.01);
  recorder->SetRecording(true);
  hand.MoveTo(-0.01);
  recorder->SetRecording(false);
  recorder->SetRecording(false);
  hand.MoveTo(-0.01); // nor is this
  EXPECT_EQ(recorder->GetNumberOfTicks(), 2);
  EXPECT_EQ(recorder->GetTrace(), hand.Scene->GetTrace());
  EXPECT_EQ(recorder->GetTrace()->GetNumberOfPoints(), 2);
  recorder->Start();
  EXPECT_EQ(recorder->GetNumberOfTicks(), 0) << "another trace";
}

TEST(SceneParts, PartsThatOutliveTheirSceneAreSafe)
{
  vtkSmartPointer<vtkHapticWorkspace> workspace;
  vtkSmartPointer<vtkHapticGrip> grip;
  vtkSmartPointer<vtkHapticTraceRecorder> recorder;
  vtkSmartPointer<vtkActor> part;
  {
    Workbench bench;
    workspace = bench.Scene->GetWorkspace();
    grip = bench.Scene->GetGrip();
    recorder = bench.Scene->GetTraceRecorder();
    part = bench.Part;
    recorder->Start();
    ASSERT_TRUE(bench.PressAndGrip());
    EXPECT_EQ(grip->GetSurface(), bench.PartId);
  }
  EXPECT_EQ(grip->GetSurface(), -1);
  grip->LetGo();
  EventCounter errors(grip, vtkCommand::ErrorEvent);
  EXPECT_FALSE(grip->TakeSurface(0));
  EXPECT_FALSE(grip->Take());
  EXPECT_EQ(errors.Count, 2);
  workspace->SetClutched(true);
  EXPECT_TRUE(workspace->Scale(2.0));
  EXPECT_TRUE(workspace->Fit(Box)) << "its servo still has the device";
  workspace->Reset();
  recorder->Stop();
  EXPECT_GT(recorder->GetTrace()->GetNumberOfPoints(), 0) << "what was recorded is still there";
  for (vtkObject* object : { static_cast<vtkObject*>(workspace), static_cast<vtkObject*>(grip),
         static_cast<vtkObject*>(recorder) })
  {
    EXPECT_FALSE(Text(object).empty());
  }
}
