// The side of each cell of a scene's surface, from its data array to the force on the hand.
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSurfaces.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

namespace
{
constexpr int Sides = vtkGodObjectFilter::SIDE_ARRAY;
constexpr int AtCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// A table in z = height, of 4 by 4 cells, touched from its front where x < 0, and from both sides
/// elsewhere; its arrays and points are new each time.
vtkSmartPointer<vtkPolyData> MakeHalfAndHalf(double height = 0.0)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, height);
  plane->SetPoint1(0.1, -0.1, height);
  plane->SetPoint2(-0.1, 0.1, height);
  plane->SetResolution(4, 4);
  plane->Update();
  vtkSmartPointer<vtkPolyData> table = plane->GetOutput();
  vtkNew<vtkDoubleArray> sides;
  sides->SetName("sides");
  for (vtkIdType i = 0; i < table->GetNumberOfCells(); ++i)
  {
    sides->InsertNextValue(i % 4 < 2 ? vtkGodObjectFilter::FRONT : vtkGodObjectFilter::BOTH);
  }
  table->GetCellData()->AddArray(sides);
  return table;
}

/// Whether the hand is held on its way from below through (x, 0.02, 0).
bool IsHeldFromBelow(LedHand& hand, double x)
{
  hand.Device->SetPosition(x, 0.02, 0.05); // over it, around the rim and below
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.15, 0.02, 0.05);
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.15, 0.02, -0.02);
  hand.Scene->Step(1);
  hand.Device->SetPosition(x, 0.02, -0.02);
  hand.Scene->Step(1);
  EXPECT_FALSE(hand.Scene->GetTouching());
  hand.Device->SetPosition(x, 0.02, 0.002);
  hand.Scene->Step(1);
  return hand.Scene->GetTouching();
}
}

TEST(SceneSides, ComeFromAnArray)
{
  LedHand hand;
  const int table = hand.Scene->AddSurface(MakeHalfAndHalf());
  EXPECT_TRUE(IsHeldFromBelow(hand, -0.03)) << "Automatic, of an open surface";
  EXPECT_TRUE(hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides"));
  EXPECT_FALSE(IsHeldFromBelow(hand, -0.03));
  EXPECT_TRUE(IsHeldFromBelow(hand, 0.03));
  EXPECT_EQ(hand.Scene->GetSurfaceFilter(table)->GetTouchedSide(), vtkGodObjectFilter::MIXED_SIDES);

  // What the mouse picks is what can be touched.
  double hit[3];
  const double left[3] = { -0.03, 0.02, -1.0 };
  const double right[3] = { 0.03, 0.02, -1.0 };
  const double up[3] = { 0.0, 0.0, 1.0 };
  EXPECT_FALSE(hand.Scene->IntersectRay(left, up, hit));
  EXPECT_TRUE(hand.Scene->IntersectRay(right, up, hit));
}

// A mirror exchanges left and right, and what faces up faces up.
TEST(SceneSides, StayWithTheirCellsWhereTheActorIsMirroredAndSqueezed)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeHalfAndHalf());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(-1.0, 1.3, 2.0);
  LedHand hand;
  const int table = hand.Scene->AddSurface(actor);
  hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides");
  EXPECT_TRUE(IsHeldFromBelow(hand, -0.03));
  EXPECT_FALSE(IsHeldFromBelow(hand, 0.03));
}

TEST(SceneSides, AreTakenInOnAnotherThread)
{
  LedHand hand;
  hand.Scene->GetSurfaces()->BackgroundBuildingOn();
  const int table = hand.Scene->AddSurface(MakeHalfAndHalf());
  hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides");
  hand.Scene->Update();
  while (hand.Scene->GetSurfaces()->IsBuilding())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hand.Scene->Update();
  }
  EXPECT_FALSE(IsHeldFromBelow(hand, -0.03));
  EXPECT_TRUE(IsHeldFromBelow(hand, 0.03));
}

// Time steps with arrays of their own, of the same values: the surface goes on deforming.
TEST(SceneSides, OfASurfaceThatDeformsBuildNothing)
{
  LedHand hand;
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(MakeHalfAndHalf());
  const int table = hand.Scene->AddSurface(producer->GetOutputPort());
  hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides");
  vtkGodObjectFilter* filter = hand.Scene->GetSurfaceFilter(table);
  ASSERT_TRUE(IsHeldFromBelow(hand, 0.03));
  for (int step = 1; step <= 5; ++step)
  {
    producer->SetOutput(MakeHalfAndHalf(-0.001 * step));
    hand.Scene->Step(33);
    EXPECT_TRUE(hand.Scene->GetTouching()) << "down with the surface";
  }
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
  vtkSmartPointer<vtkPolyData> other = MakeHalfAndHalf(-0.005);
  other->GetCellData()->GetArray("sides")->Fill(vtkGodObjectFilter::BOTH);
  producer->SetOutput(other);
  hand.Scene->Step(33);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2) << "other sides are another surface";
  EXPECT_TRUE(hand.Scene->GetTouching());
}

// An array that vanishes under the hand: one error, the surface's own side, and no jump of the hand
// that this side holds too.
TEST(SceneSides, NothingJumpsWhereTheArrayVanishes)
{
  for (const bool fromAbove : { true, false })
  {
    LedHand hand;
    vtkSmartPointer<vtkPolyData> geometry = MakeHalfAndHalf();
    const int table = hand.Scene->AddSurface(geometry);
    hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides");
    if (fromAbove)
    {
      hand.Device->SetPosition(0.03, 0.02, 0.01);
      hand.Scene->Step(1);
      hand.Device->SetPosition(0.03, 0.02, -0.002);
      hand.Scene->Step(1);
    }
    else
    {
      ASSERT_TRUE(IsHeldFromBelow(hand, 0.03));
    }
    double before[3];
    hand.Scene->GetForce(before);
    ASSERT_NEAR(
      std::abs(before[2]), 0.002 * hand.Scene->GetServo()->GetReadings()->GetStiffness(), 1e-3);
    EventCounter errors(hand.Scene, vtkHapticScene::SurfaceErrorEvent);
    EventCounter quiet(hand.Scene, vtkCommand::ErrorEvent);
    geometry->GetCellData()->RemoveArray("sides");
    geometry->Modified();
    for (int tick = 0; tick < 50; ++tick)
    {
      hand.Scene->Step(1);
      double force[3];
      hand.Scene->GetForce(force);
      ASSERT_NEAR(force[2], before[2], 1e-9) << "tick " << tick;
    }
    EXPECT_EQ(errors.Count, 1);
    EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("no array sides for the side"),
      std::string::npos)
      << hand.Scene->GetErrorMessage();
  }
}

TEST(SceneSides, ThatAreNoneAreReportedWithTheSurface)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> geometry = MakeHalfAndHalf();
  geometry->GetCellData()->GetArray("sides")->SetComponent(7, 0, 12.0);
  EventCounter errors(hand.Scene, vtkHapticScene::SurfaceErrorEvent);
  EventCounter quiet(hand.Scene, vtkCommand::ErrorEvent);
  const int table = hand.Scene->AddSurface(geometry);
  hand.Scene->SetSurfacePropertyArray(table, Sides, AtCells, "sides");
  hand.Scene->Step(10);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("cell 7 with 12"), std::string::npos)
    << hand.Scene->GetErrorMessage();
  EXPECT_FALSE(IsHeldFromBelow(hand, -0.03));
  EXPECT_TRUE(IsHeldFromBelow(hand, 0.03));
}
