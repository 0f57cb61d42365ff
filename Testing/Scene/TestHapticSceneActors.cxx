#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticView.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

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
  EXPECT_EQ(errors.Count, 1) << "told once";
  vtkNew<vtkPolyDataMapper> mapper;
  actor->SetMapper(mapper);
  hand.MoveTo(0.01);
  EXPECT_EQ(errors.Count, 2) << "the mapper has no input";
  mapper->SetInputData(MakeTable(0.0));
  hand.MoveTo(0.011);
  EXPECT_EQ(errors.Count, 2);
  EXPECT_TRUE(hand.Scene->IsSurfaceTouchable(id));
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
