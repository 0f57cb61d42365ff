#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticSurfaces.h"
#include "vtkHapticView.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* geometry)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(geometry);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}
}

TEST(HapticSceneActors, AnActorIsASurfaceOnce)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  const int id = hand.Scene->AddSurface(actor);
  EXPECT_EQ(hand.Scene->AddSurface(actor), id);
  EXPECT_EQ(hand.Scene->GetNumberOfSurfaces(), 1);
  EXPECT_EQ(hand.Scene->GetSurfaceActor(id), actor);
  EXPECT_TRUE(hand.Scene->RemoveSurface(actor));
  EXPECT_EQ(hand.Scene->GetNumberOfSurfaces(), 0);
}

TEST(HapticSceneActors, FollowsTheActorsMatrix)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  const int id = hand.Scene->AddSurface(actor);
  actor->SetPosition(0.0, 0.0, -0.01);
  actor->SetScale(1.0, 3.0, 1.0);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.02);
  EXPECT_NEAR(hand.GodObjectHeight(), -0.01, 5 * Clearance) << "scaled, and its crack width too";
  hand.MoveTo(0.01);
  actor->SetPosition(0.0, 0.0, -0.005);
  hand.MoveTo(-0.02);
  hand.Scene->Step(10); // it gets there over the time between two updates
  EXPECT_NEAR(hand.GodObjectHeight(), -0.005, 5 * Clearance);
  EXPECT_EQ(hand.Scene->GetSurfaceFilter(id)->GetNumberOfBuilds(), 1)
    << "a moved actor must not clean its geometry again";
}

TEST(HapticSceneActors, AMirroredSolidKeepsItsOutside)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  const int id = hand.Scene->AddSurface(actor);
  hand.Scene->GetSurfaceFilter(id)->SetSideToFront();
  actor->SetScale(-1.0, 1.0, 1.0);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  EXPECT_TRUE(hand.Scene->GetTouching()) << "the front still faces up";
}

TEST(HapticSceneActors, AMatrixThatFlattensIsAnErrorAndTheLastSurfaceStays)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  hand.Scene->AddSurface(actor);
  hand.MoveTo(0.01);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  vtkNew<vtkMatrix4x4> flat;
  flat->SetElement(0, 0, 0.0);
  actor->SetUserMatrix(flat);
  hand.MoveTo(-0.005);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, Clearance);
}

TEST(HapticSceneActors, HiddenOrUnpickableIsNotTouched)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  hand.Scene->AddSurface(actor);
  hand.MoveTo(0.01);
  actor->VisibilityOff();
  hand.MoveTo(-0.005);
  EXPECT_FALSE(hand.Scene->GetTouching());
  hand.MoveTo(0.01);
  actor->VisibilityOn();
  actor->PickableOff();
  hand.MoveTo(-0.005);
  EXPECT_FALSE(hand.Scene->GetTouching());
  hand.MoveTo(0.01);
  actor->PickableOn();
  hand.MoveTo(-0.005);
  EXPECT_TRUE(hand.Scene->GetTouching());
}

TEST(HapticSceneActors, AnotherColourRebuildsNothing)
{
  LedHand hand;
  vtkSmartPointer<vtkActor> actor = MakeActor(MakeTable(0.0));
  const int id = hand.Scene->AddSurface(actor);
  hand.MoveTo(0.01);
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  EXPECT_FALSE(hand.Scene->Update());
  EXPECT_EQ(hand.Scene->GetSurfaceFilter(id)->GetNumberOfBuilds(), 1);
}

TEST(HapticSceneActors, AnActorWithoutMapperOrInputIsAnErrorTillItHasOne)
{
  LedHand hand;
  vtkNew<vtkActor> actor;
  const int id = hand.Scene->AddSurface(actor);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.MoveTo(0.01);
  EXPECT_EQ(errors.Count, 1);
  hand.MoveTo(0.011);
  EXPECT_EQ(errors.Count, 1) << "reported once";
  vtkNew<vtkPolyDataMapper> mapper;
  actor->SetMapper(mapper);
  hand.MoveTo(0.01);
  EXPECT_EQ(errors.Count, 2) << "the mapper has no input";
  mapper->SetInputData(MakeTable(0.0));
  hand.MoveTo(0.011);
  EXPECT_EQ(errors.Count, 2);
  EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(id));
}

TEST(HapticSceneActors, TheGodObjectActorShowsTheStateAndStaysOutOfBoundsAndPicks)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkHapticView> view;
  view->SetScene(hand.Scene);
  vtkGodObjectActor* shown = view->GetGodObjectActor();
  hand.MoveTo(0.01);
  hand.MoveTo(-0.005);
  EXPECT_TRUE(shown->GetTouching());
  EXPECT_EQ(shown->GetHapticInterfacePoint()[2], -0.005);
  EXPECT_EQ(shown->GetGodObject()[2], hand.GodObjectHeight());
  EXPECT_EQ(shown->GetForce()[2], hand.Scene->GetForce()[2]);
  EXPECT_FALSE(shown->GetUseBounds());
  EXPECT_FALSE(shown->GetPickable());
}

TEST(GodObjectActor, RefusesWhatIsNotFinite)
{
  vtkNew<vtkGodObjectActor> actor;
  EventCounter errors(actor, vtkCommand::ErrorEvent);
  actor->SetGodObject(1.0, 2.0, 3.0);
  actor->SetGodObject(std::nan(""), 0.0, 0.0);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(actor->GetGodObject()[0], 1.0);
}

namespace
{
/// A ball of radius 0.05 around the origin under a hand, of which a plane of the mapper shows a
/// part.
struct CutBall
{
  LedHand Hand;
  vtkNew<vtkSphereSource> Ball;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkPlane> Plane;
  int Id = -1;

  CutBall()
  {
    this->Ball->SetRadius(0.05);
    this->Ball->SetThetaResolution(32);
    this->Ball->SetPhiResolution(32);
    this->Mapper->SetInputConnection(this->Ball->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Id = this->Hand.Scene->AddSurface(this->Actor);
    this->Plane->SetNormal(0.0, 0.0, -1.0); // keeps what is below
    this->Mapper->AddClippingPlane(this->Plane);
  }
  /// Whether something is there, met from above or from below at x = 0.01, y = 0.02.
  bool IsThere(double fromHeight)
  {
    const double from[3] = { 0.01, 0.02, fromHeight };
    const double direction[3] = { 0.0, 0.0, -fromHeight };
    this->Hand.Scene->Update();
    return this->Hand.Scene->IntersectRay(from, direction, this->Hit);
  }
  int Builds() { return this->Hand.Scene->GetSurfaceFilter(this->Id)->GetNumberOfBuilds(); }

  double Hit[3] = {};
  const double Height = std::sqrt(0.05 * 0.05 - 0.01 * 0.01 - 0.02 * 0.02); ///< of the ball there
};
}

TEST(HapticSceneActors, WhatAClippingPlaneCutsAwayIsNotTouched)
{
  CutBall cut;
  cut.Hand.MoveTo(0.06);
  cut.Hand.MoveTo(0.02); // where the upper half would be
  EXPECT_FALSE(cut.Hand.Scene->GetTouching());
  cut.Hand.MoveTo(0.0);
  cut.Hand.MoveTo(-0.048); // onto the bowl, from inside
  EXPECT_TRUE(cut.Hand.Scene->GetTouching());
  const double* at = cut.Hand.Scene->GetGodObject();
  EXPECT_NEAR(std::hypot(at[0], at[1], at[2]), 0.05, 1e-3) << "but for the facets";
}

TEST(HapticSceneActors, APlaneThatMovesOrGoesGivesBackWhatItCut)
{
  CutBall cut;
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_LT(cut.Hit[2], 0.0) << "the upper half is cut away";
  const int builds = cut.Builds();
  cut.Hand.Scene->Update();
  EXPECT_EQ(cut.Builds(), builds) << "nothing has changed";

  cut.Plane->SetOrigin(0.0, 0.0, 0.06);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_NEAR(cut.Hit[2], cut.Height, 5e-4);
  cut.Plane->SetOrigin(0.0, 0.0, 0.01);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_LT(cut.Hit[2], 0.0);
  cut.Mapper->RemoveAllClippingPlanes();
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_NEAR(cut.Hit[2], cut.Height, 5e-4);
}

TEST(HapticSceneActors, ClippingPlanesStayWhereTheyAreWhileTheActorMoves)
{
  CutBall cut;
  cut.Actor->SetScale(1.0, 1.0, 2.0);
  cut.Actor->SetPosition(0.0, 0.0, 0.02);
  cut.Actor->RotateZ(30.0);
  cut.Plane->SetOrigin(0.0, 0.0, 0.115); // its top is at 0.12
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_NEAR(cut.Hit[2], 0.02 + 2.0 * cut.Height, 1e-3) << "this far from the axis it is lower";
  cut.Actor->SetPosition(0.0, 0.0, 0.05);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_LT(cut.Hit[2], 0.0) << "the ray goes in through the hole";
  cut.Actor->SetOrientation(180.0, 0.0, 0.0);
  cut.Actor->SetPosition(0.0, 0.0, -0.02);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_GT(cut.Hit[2], 0.0) << "the plane is not turned with it";
}

TEST(HapticSceneActors, PlanesThatCutAllAwayLeaveNothingAndAreNoError)
{
  CutBall cut;
  EventCounter errors(cut.Hand.Scene, vtkCommand::ErrorEvent);
  vtkNew<vtkPlane> opposite;
  opposite->SetOrigin(0.0, 0.0, 0.01);
  cut.Mapper->AddClippingPlane(opposite);
  EXPECT_FALSE(cut.IsThere(1.0)) << "from the start";
  EXPECT_FALSE(cut.Hand.Scene->GetSurfaces()->IsTouchable(cut.Id));
  opposite->SetOrigin(0.0, 0.0, -0.045);
  EXPECT_TRUE(cut.IsThere(1.0)) << "a ring is left";
  opposite->SetOrigin(0.0, 0.0, 0.01);
  EXPECT_FALSE(cut.IsThere(1.0));
  cut.Hand.MoveTo(0.06);
  cut.Hand.MoveTo(0.02);
  EXPECT_FALSE(cut.Hand.Scene->GetTouching());
  EXPECT_EQ(errors.Count, 0);
}

TEST(HapticSceneActors, CellsOfAClippedSurfaceAreThoseOfTheGeometryGiven)
{
  CutBall cut;
  cut.Hand.MoveTo(0.0);
  cut.Hand.MoveTo(-0.048);
  ASSERT_TRUE(cut.Hand.Scene->GetTouching());
  vtkPolyData* ball = cut.Ball->GetOutput();
  double bounds[6];
  ball->GetCellBounds(cut.Hand.Scene->GetTouchedCell(), bounds);
  const double* at = cut.Hand.Scene->GetGodObject();
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_GE(at[axis], bounds[2 * axis] - Clearance);
    EXPECT_LE(at[axis], bounds[2 * axis + 1] + Clearance);
  }
}

TEST(HapticSceneActors, APartOfAnAssemblyIsClippedToo)
{
  CutBall cut;
  cut.Hand.Scene->RemoveAllSurfaces();
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(cut.Actor);
  cut.Hand.Scene->AddSurface(assembly);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_LT(cut.Hit[2], 0.0);
  assembly->SetPosition(0.0, 0.0, -0.1);
  ASSERT_TRUE(cut.IsThere(1.0));
  EXPECT_NEAR(cut.Hit[2], -0.1 + cut.Height, 5e-4) << "all of it is below the plane";
}
