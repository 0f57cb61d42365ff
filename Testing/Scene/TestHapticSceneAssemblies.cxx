// A table that hangs in an arm, which hangs in a robot; each has a place of its own:
//
//   robot (z + 0.1) -- arm (z + 0.01) -- table (z + 0.001)
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkHapticProbe.h"
#include "vtkHapticSurfaces.h"
#include "vtkPolyDataMapper.h"

#include <gtest/gtest.h>

namespace
{
struct Robot
{
  vtkNew<vtkAssembly> Whole;
  vtkNew<vtkAssembly> Arm;
  vtkNew<vtkActor> Table;

  Robot()
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(MakeTable(0.0));
    this->Table->SetMapper(mapper);
    this->Table->SetPosition(0.0, 0.0, 0.001);
    this->Arm->SetPosition(0.0, 0.0, 0.01);
    this->Whole->SetPosition(0.0, 0.0, 0.1);
    this->Arm->AddPart(this->Table);
    this->Whole->AddPart(this->Arm);
  }
};

/// Where a hand from above is held, or -0.3 where it is not. The hand is above again then.
double PressDown(LedHand& hand)
{
  hand.MoveTo(0.3);
  hand.Scene->Step(100); // what was moved gets there at 5 m/s at most
  hand.MoveTo(-0.3);
  const double height = hand.GodObjectHeight();
  hand.MoveTo(0.3);
  return height;
}
}

TEST(HapticSceneAssemblies, APartIsTouchedWhereTheAssemblyHasIt)
{
  LedHand hand;
  Robot robot;
  const int whole = hand.Scene->AddSurface(robot.Whole);
  EXPECT_EQ(hand.Scene->AddSurface(robot.Whole), whole) << "once";
  EXPECT_NEAR(PressDown(hand), 0.111, Clearance);
  EXPECT_EQ(hand.Scene->GetNumberOfSurfaces(), 1);
  hand.MoveTo(0.1);
  const int part = hand.Scene->GetProbe()->GetSurface();
  EXPECT_NE(part, whole);
  EXPECT_EQ(hand.Scene->GetSurfaceActor(part), robot.Table.Get());
  EXPECT_EQ(hand.Scene->GetSurfaces()->GetAssembly(part), robot.Whole.Get());
  EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(whole));
}

TEST(HapticSceneAssemblies, EveryLevelIsFollowedLive)
{
  LedHand hand;
  Robot robot;
  hand.Scene->AddSurface(robot.Whole);
  EXPECT_NEAR(PressDown(hand), 0.111, Clearance);
  robot.Whole->SetPosition(0.0, 0.0, 0.2);
  EXPECT_NEAR(PressDown(hand), 0.211, Clearance);
  robot.Arm->SetPosition(0.0, 0.0, 0.02);
  EXPECT_NEAR(PressDown(hand), 0.221, Clearance);
  robot.Table->SetPosition(0.0, 0.0, 0.002);
  EXPECT_NEAR(PressDown(hand), 0.222, Clearance);
  robot.Arm->VisibilityOff();
  EXPECT_EQ(PressDown(hand), -0.3) << "hidden with its arm";
  robot.Arm->VisibilityOn();
  robot.Whole->PickableOff();
  EXPECT_EQ(PressDown(hand), -0.3);
  robot.Whole->PickableOn();
  EXPECT_NEAR(PressDown(hand), 0.222, Clearance);
}

TEST(HapticSceneAssemblies, PartsComeAndGoAndOneActorMayHangTwice)
{
  LedHand hand;
  Robot robot;
  hand.Scene->AddSurface(robot.Whole);
  vtkNew<vtkAssembly> second;
  second->SetPosition(0.0, 0.0, 0.05);
  second->AddPart(robot.Table);
  robot.Whole->AddPart(second);
  EXPECT_NEAR(PressDown(hand), 0.151, Clearance) << "the upper one of the two";
  EXPECT_EQ(hand.Scene->GetNumberOfSurfaces(), 2);
  robot.Whole->RemovePart(second);
  EXPECT_NEAR(PressDown(hand), 0.111, Clearance);
  EXPECT_EQ(hand.Scene->GetNumberOfSurfaces(), 1);
}

TEST(HapticSceneAssemblies, IsRemovedAsAWhole)
{
  LedHand hand;
  Robot robot;
  const int whole = hand.Scene->AddSurface(robot.Whole);
  hand.Scene->Update();
  const int part = hand.Scene->GetSurfaces()->GetId(0);
  EXPECT_FALSE(hand.Scene->RemoveSurface(part)) << "it would come back";
  EXPECT_TRUE(hand.Scene->RemoveSurface(robot.Whole));
  EXPECT_FALSE(hand.Scene->RemoveSurface(whole));
  EXPECT_EQ(PressDown(hand), -0.3);
  hand.Scene->AddSurface(robot.Whole);
  EXPECT_NEAR(PressDown(hand), 0.111, Clearance);
  hand.Scene->RemoveAllSurfaces();
  EXPECT_EQ(PressDown(hand), -0.3);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EXPECT_EQ(hand.Scene->AddSurface(static_cast<vtkAssembly*>(nullptr)), -1);
  EXPECT_EQ(errors.Count, 1);
}

TEST(HapticSceneAssemblies, AnEmptyAssemblyIsNothingToTouch)
{
  LedHand hand;
  vtkNew<vtkAssembly> empty;
  const int whole = hand.Scene->AddSurface(empty);
  EXPECT_EQ(PressDown(hand), -0.3);
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsTouchable(whole));
}
