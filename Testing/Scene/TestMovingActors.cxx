#include "SceneTestTools.h"
#include "TraceComparison.h"
#include "haptics/Tick/TickRecord.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkElevationFilter.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticSurfaces.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace
{
/// A table that an actor shows, and a hand above its middle.
struct TableActor : LedHand
{
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  int Id = -1;

  explicit TableActor(vtkPolyData* geometry = nullptr)
  {
    vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
    this->Mapper->SetInputData(geometry ? geometry : table.Get());
    this->Actor->SetMapper(this->Mapper);
    this->Id = this->Scene->AddSurface(this->Actor);
    this->MoveTo(0.01);
  }
  std::uint64_t Generation() { return this->Scene->GetServo()->GetLatestRecord().Generation; }
};

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
}

TEST(MovingActors, OneThatIsDraggedBuildsAndPublishesNothing)
{
  TableActor hand;
  const auto snapshot = hand.Scene->GetSurfaceFilter(hand.Id)->GetSurface();
  const std::uint64_t generation = hand.Generation();
  for (int i = 0; i < 50; ++i)
  {
    hand.Actor->AddPosition(0.0001, 0.0, 0.0002);
    hand.Actor->RotateZ(1.0);
    hand.Scene->Step(16);
  }
  EXPECT_EQ(hand.Scene->GetSurfaceFilter(hand.Id)->GetSurface(), snapshot);
  EXPECT_EQ(hand.Generation(), generation) << "no other god-object";
  hand.MoveTo(0.005);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.01, Clearance) << "50 times 0.2 mm";
}

//       hand held at 0 ---------o
//                               :
//       table  ---------------------------   rises 30 mm/s, updated 30 times a second
TEST(MovingActors, ARisingTableGivesAForceWithoutSteps)
{
  TableActor hand;
  hand.Actor->SetPosition(0.0, 0.0, -0.003);
  hand.MoveTo(0.01);
  hand.MoveTo(0.0);
  hand.Scene->StartRecording();
  for (int i = 0; i < 16; ++i)
  {
    hand.Actor->AddPosition(0.0, 0.0, 0.03 / 30.0);
    hand.Scene->Step(i % 3 == 2 ? 34 : 33);
  }
  EXPECT_TRUE(hand.Scene->GetTouching());
  EXPECT_NEAR(hand.GodObjectHeight(), 0.013, 0.0011) << "the hand is pushed, an update behind";
  EXPECT_LE(haptics::testing::LargestForceStep(hand.Scene->GetTrace()), 0.05);
}

TEST(MovingActors, AnUpdateThatComesLateFindsTheTableWaiting)
{
  TableActor hand;
  hand.MoveTo(-0.001);
  for (int i = 0; i < 5; ++i)
  {
    hand.Actor->AddPosition(0.0, 0.0, 0.001);
    hand.Scene->Step(33);
  }
  hand.Scene->Step(200);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.005, Clearance) << "not beyond where it was sent";
}

TEST(MovingActors, ScaleIsBakedOnceAndTurningItCostsNothing)
{
  TableActor hand;
  hand.Actor->SetScale(2.0, 1.0, 3.0);
  hand.Scene->Step(1);
  const std::uint64_t generation = hand.Generation();
  for (int i = 0; i < 20; ++i)
  {
    hand.Actor->RotateX(0.1);
    hand.Actor->RotateZ(1.0);
    hand.Actor->AddPosition(0.001, 0.0, 0.0);
    hand.Scene->Step(16);
  }
  EXPECT_EQ(hand.Generation(), generation);
  hand.Actor->SetScale(2.0, 1.1, 3.0);
  hand.Scene->Step(2);
  EXPECT_GT(hand.Generation(), generation) << "another shape";
  EXPECT_EQ(hand.Scene->GetSurfaceFilter(hand.Id)->GetNumberOfBuilds(), 1) << "but cleaned once";
}

TEST(MovingActors, ProbeRayHighlightAndWorkspaceGoWithTheActor)
{
  vtkNew<vtkElevationFilter> colours;
  colours->SetInputData(MakeTable(0.0));
  colours->SetLowPoint(-0.1, 0.0, 0.0);
  colours->SetHighPoint(0.1, 0.0, 0.0);
  colours->Update();
  TableActor hand(vtkPolyData::SafeDownCast(colours->GetOutput()));
  // A quarter turn about z, which takes x to y, and up, around the hand.
  hand.Actor->RotateZ(90.0);
  hand.Actor->SetPosition(0.05, 0.0, 0.3);
  for (const double x : { 0.3, 0.02 })
  {
    hand.Device->SetPosition(x, 0.03, hand.Scene->GetHapticInterfacePoint()[2]);
    hand.Scene->Step(100);
    hand.Device->SetPosition(x, 0.03, 0.31);
    hand.Scene->Step(100);
  }
  hand.Device->SetPosition(0.02, 0.03, 0.299);
  hand.Scene->Step(10);
  ASSERT_TRUE(hand.Scene->GetTouching());
  vtkHapticProbe* probe = hand.Scene->GetProbe();
  EXPECT_NEAR(probe->GetValue("Elevation"), (0.03 + 0.1) / 0.2, 1e-5);
  EXPECT_NEAR(probe->GetPosition()[0], 0.02, 1e-9);
  EXPECT_NEAR(probe->GetPosition()[1], 0.03, 1e-9);
  EXPECT_NEAR(probe->GetPosition()[2], 0.3, 1e-9);
  EXPECT_NEAR(probe->GetNormal()[2], 1.0, 1e-9);

  const double from[3] = { 0.14, 0.09, 1.0 };
  const double down[3] = { 0.0, 0.0, -1.0 };
  double hit[3];
  ASSERT_TRUE(hand.Scene->IntersectRay(from, down, hit)) << "0.14 is over the moved table only";
  EXPECT_NEAR(hit[2], 0.3, 1e-9);

  ASSERT_TRUE(hand.Scene->FitWorkspace());
  EXPECT_NEAR(hand.Scene->GetWorkspaceTransform()->GetElement(0, 3), 0.05, 1e-6);
}

TEST(MovingActors, TheWayBetweenLandmarksIsThatOfTheSurfaceWhereverItWasTakenMeanwhile)
{
  TableActor hand;
  hand.MoveTo(-0.001);
  ASSERT_EQ(hand.Scene->DropLandmark(), 0); // at (0.01, 0.02)
  hand.MoveTo(0.01);
  hand.Actor->SetPosition(0.0, 0.0, 0.1);
  hand.Device->SetPosition(0.05, 0.02, 0.11);
  hand.Scene->Step(200);
  hand.Device->SetPosition(0.05, 0.02, 0.099);
  hand.Scene->Step(1);
  ASSERT_EQ(hand.Scene->DropLandmark(), 1);
  vtkNew<vtkPolyData> way;
  EXPECT_NEAR(hand.Scene->GetLandmarks()->GetGeodesicDistance(0, 1, way), 0.04, 1e-9);
  EXPECT_NEAR(way->GetPoint(0)[2], 0.1, 1e-6) << "shown where the surface was at last";
}

/// Moved, turned, scaled, mirrored back, deformed: a landmark stays on its point of the material.
TEST(MovingActors, LandmarksStayOnTheSurface)
{
  TableActor hand;
  hand.MoveTo(-0.001);
  vtkHapticLandmarks* const marks = hand.Scene->GetLandmarks();
  ASSERT_EQ(hand.Scene->DropLandmark(), 0); // at (0.01, 0.02)
  hand.Device->SetPosition(0.05, 0.02, -0.001);
  hand.Scene->Step(1);
  ASSERT_EQ(hand.Scene->DropLandmark(), 1);
  hand.MoveTo(0.05);
  double dropped[3];
  double p[3];
  marks->GetPosition(0, dropped);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_TRUE(std::equal(p, p + 3, dropped)) << "nothing has changed, to the last bit";

  hand.Actor->SetPosition(0.0, 0.0, 0.01);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[2], 0.01, 1e-9);
  hand.Actor->RotateZ(90.0);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[0], -0.02, 1e-9);
  EXPECT_NEAR(p[1], 0.01, 1e-9);
  EXPECT_NEAR(marks->GetStraightDistance(0, 1), 0.04, 1e-9);
  hand.Actor->SetScale(2.0);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[0], -0.04, 1e-9);
  EXPECT_NEAR(marks->GetStraightDistance(0, 1), 0.08, 1e-9);
  EXPECT_NEAR(marks->GetGeodesicDistance(0, 1), 0.08, 1e-9) << "along the surface as it is";
  EXPECT_NEAR(marks->GetOutput()->GetPoint(0)[0], -0.04, 1e-9);
  vtkDataArray* const distances =
    marks->GetOutput()->GetPointData()->GetArray("DistanceToPrevious");
  EXPECT_TRUE(std::isnan(distances->GetTuple1(0)));
  EXPECT_NEAR(distances->GetTuple1(1), 0.08, 1e-9);
  EXPECT_NEAR(
    marks->GetOutput()->GetPointData()->GetArray("Normal")->GetComponent(0, 2), 1.0, 1e-9);

  hand.Actor->VisibilityOff();
  hand.Actor->SetPosition(0.0, 0.0, 0.3);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[2], 0.01, 1e-9) << "what is hidden is nowhere";
  hand.Actor->VisibilityOn();
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[2], 0.3, 1e-9);
  hand.Scene->RemoveSurface(hand.Actor);
  hand.Scene->Update();
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[2], 0.3, 1e-9) << "where it was last";
}

TEST(MovingActors, LandmarksStayOnASurfaceThatDeformsAndWhereItsCellsChange)
{
  LedHand hand;
  auto table = MakeTable(0.0);
  hand.Scene->AddSurface(table);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  vtkHapticLandmarks* const marks = hand.Scene->GetLandmarks();
  ASSERT_EQ(hand.Scene->DropLandmark(), 0); // at (0.01, 0.02)
  hand.MoveTo(0.05);
  for (int step = 1; step <= 5; ++step)
  {
    for (vtkIdType k = 0; k < 4; ++k) // it tilts: z = 0.1 x
    {
      double q[3];
      table->GetPoint(k, q);
      table->GetPoints()->SetPoint(k, q[0], q[1], 0.02 * step * q[0]);
    }
    table->GetPoints()->Modified();
    table->Modified();
    hand.MoveTo(0.05);
  }
  hand.Scene->Step(300);
  double p[3];
  marks->GetPosition(0, p);
  EXPECT_NEAR(p[0], 0.01, 1e-7);
  EXPECT_NEAR(p[1], 0.02, 1e-7);
  EXPECT_NEAR(p[2], 0.001, 1e-7);
  const double expected = std::cos(std::atan(0.1));
  EXPECT_NEAR(
    marks->GetOutput()->GetPointData()->GetArray("Normal")->GetComponent(0, 2), expected, 1e-6);

  auto higher = MakeTable(0.2);
  vtkNew<vtkCellArray> half; // other cells
  const vtkIdType corners[3] = { 0, 1, 3 };
  half->InsertNextCell(3, corners);
  table->SetPoints(higher->GetPoints());
  table->SetPolys(half);
  hand.MoveTo(0.3);
  hand.Scene->Step(10);
  double after[3];
  marks->GetPosition(0, after);
  EXPECT_TRUE(std::equal(p, p + 3, after)) << "where it was last";
  table->SetPolys(vtkSmartPointer<vtkCellArray>::New());
  table->SetPoints(vtkSmartPointer<vtkPoints>::New());
  hand.MoveTo(0.3);
  marks->GetPosition(0, after);
  EXPECT_TRUE(std::equal(p, p + 3, after));
}

TEST(MovingActors, RestingOnATableThatMovesIsNoSlide)
{
  TableActor hand;
  hand.MoveTo(-0.001);
  hand.Scene->Step(1);
  EventCounter slides(hand.Scene, vtkHapticScene::ContactSlideEvent);
  hand.Scene->Step(1);
  EXPECT_EQ(slides.Count, 0);
  hand.Actor->AddPosition(0.0, 0.0, 0.001);
  hand.Scene->Step(50);
  EXPECT_EQ(slides.Count, 0);
  hand.Actor->AddPosition(0.001, 0.0, 0.0);
  hand.Scene->Step(50);
  EXPECT_EQ(slides.Count, 1) << "it was drawn away sideways under the hand";
}

TEST(MovingActors, ABadMatrixIsReportedOnceAndTheTableStaysWhereItWas)
{
  TableActor hand;
  hand.Actor->SetPosition(0.0, 0.0, 0.001);
  hand.Scene->Step(50);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  for (int i = 0; i < 3; ++i)
  {
    hand.Actor->SetPosition(0.0, NaN, 0.01 * i);
    hand.Scene->Step(10);
  }
  EXPECT_EQ(errors.Count, 1);
  hand.Actor->SetPosition(0.0, 0.0, 0.001);
  hand.Scene->Step(10);
  for (int i = 0; i < 3; ++i)
  {
    hand.Actor->SetScale(1.0, 0.0, 1.0 + i); // vtkProp3D takes a scale of zero
    hand.Scene->Step(10);
  }
  EXPECT_EQ(errors.Count, 2) << hand.Scene->GetErrorMessage();
  hand.MoveTo(-0.001);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.001, Clearance);
}

TEST(MovingActors, OneThatComesBackFromAScaleOfZeroIsTouched)
{
  LedHand hand;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(0.0);
  const int id = hand.Scene->AddSurface(actor);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.MoveTo(0.01);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsTouchable(id));
  actor->SetScale(1.0);
  hand.MoveTo(0.01);
  EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(id));
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsOutdated(id)) << "it is where it is shown";
}

TEST(MovingActors, OneThatComesBackInAnotherSizeIsUpToDate)
{
  TableActor hand;
  const int id = hand.Scene->GetSurfaces()->GetId(0);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  for (const double size : { 2.0, 0.5 })
  {
    hand.Actor->SetScale(0.0);
    hand.Scene->Step(10);
    EXPECT_TRUE(hand.Scene->GetSurfaces()->IsOutdated(id)) << "what was touched before stays";
    hand.Actor->SetScale(size); // is baked
    hand.Scene->Step(10);
    EXPECT_FALSE(hand.Scene->GetSurfaces()->IsOutdated(id));
  }
  EXPECT_EQ(errors.Count, 2) << "once for each time";
}

TEST(MovingActors, OneThatMovesWhileItIsHiddenPushesNothingWhenItComesBack)
{
  TableActor hand;
  hand.Actor->VisibilityOff();
  hand.Scene->Step(10);
  hand.Actor->SetPosition(0.0, 0.0, 0.02); // past the hand at 0.01
  hand.Scene->Step(10);
  hand.Actor->VisibilityOn();
  hand.Scene->Step(100);
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_NEAR(hand.GodObjectHeight(), 0.01, 1e-12);
}

TEST(MovingActors, OneThatIsFasterThanAHandIsPutThereWithAMessageAndNoForce)
{
  TableActor hand;
  hand.MoveTo(-0.001);
  ASSERT_TRUE(hand.Scene->GetTouching());
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Actor->SetPosition(0.0, 0.0, 2.0);
  hand.Scene->Step(1);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(std::string(hand.Scene->GetErrorMessage()),
    "Surface 0: It was moved by 2 m in the hand from one update to the next, where a hand can be "
    "pushed by 0.5 m at most (5 m/s for 0.1 s). It was put in its new place at once and has pushed "
    "nothing. Move it in smaller steps, or let the device reach farther (ScaleWorkspace).");
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_EQ(vtkMath::Norm(hand.Scene->GetForce()), 0.0);
}
