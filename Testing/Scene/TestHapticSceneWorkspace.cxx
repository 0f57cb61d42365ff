#include "SceneTestTools.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"

#include <gtest/gtest.h>

namespace
{
void ExpectPoint(vtkMatrix4x4* matrix, const double from[3], const double to[3])
{
  const double point[4] = { from[0], from[1], from[2], 1.0 };
  double mapped[4];
  matrix->MultiplyPoint(point, mapped);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(mapped[i], to[i], 1e-9) << "coordinate " << i; // sizes are about 1
  }
}
}

TEST(HapticSceneWorkspace, WithoutACameraTheAxesAreTheWorlds)
{
  LedHand hand;
  hand.Device->SetWorkspaceBounds(-0.1, 0.1, -0.1, 0.1, -0.1, 0.1);
  const double bounds[6] = { 1.0, 3.0, 1.0, 2.0, 0.0, 0.5 };
  ASSERT_TRUE(hand.Scene->FitWorkspace(bounds));
  vtkMatrix4x4* matrix = hand.Scene->GetWorkspaceTransform();
  const double middle[3] = { 0.0, 0.0, 0.0 };
  const double boundsMiddle[3] = { 2.0, 1.5, 0.25 };
  ExpectPoint(matrix, middle, boundsMiddle);
  const double right[3] = { 0.1, 0.0, 0.0 };
  const double boundsRight[3] = { 3.0, 1.5, 0.25 };
  ExpectPoint(matrix, right, boundsRight);
}

TEST(HapticSceneWorkspace, WithACameraTheDevicesZComesTowardsTheViewer)
{
  LedHand hand;
  hand.Device->SetWorkspaceBounds(-0.1, 0.1, -0.1, 0.1, -0.1, 0.1);
  vtkNew<vtkCamera> camera; // looks along +x, z up: its right is -y
  camera->SetPosition(-5.0, 0.0, 0.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  ASSERT_TRUE(hand.Scene->FitWorkspace(bounds, camera));
  vtkMatrix4x4* matrix = hand.Scene->GetWorkspaceTransform();
  const double towards[3] = { 0.0, 0.0, 0.1 };
  const double towardsViewer[3] = { -1.0, 0.0, 0.0 };
  ExpectPoint(matrix, towards, towardsViewer);
  const double right[3] = { 0.1, 0.0, 0.0 };
  const double cameraRight[3] = { 0.0, -1.0, 0.0 };
  ExpectPoint(matrix, right, cameraRight);
  const double up[3] = { 0.0, 0.1, 0.0 };
  const double cameraUp[3] = { 0.0, 0.0, 1.0 };
  ExpectPoint(matrix, up, cameraUp);
}

TEST(HapticSceneWorkspace, FitsTheSurfacesAndFeelsAlikeAtAnyScale)
{
  double force[2];
  int run = 0;
  for (const double size : { 0.003, 30000.0 })
  {
    LedHand hand;
    vtkSmartPointer<vtkPolyData> table = MakeTable(0.0);
    for (vtkIdType i = 0; i < table->GetNumberOfPoints(); ++i)
    {
      double point[3];
      table->GetPoint(i, point);
      table->GetPoints()->SetPoint(i, size * point[0], size * point[1], size * point[2]);
    }
    hand.Scene->AddSurface(table);
    ASSERT_TRUE(hand.Scene->FitWorkspace());
    hand.MoveTo(0.01);
    hand.MoveTo(-0.004);
    EXPECT_TRUE(hand.Scene->GetTouching());
    force[run++] = hand.Scene->GetForce()[2];
  }
  EXPECT_NEAR(force[0], 500.0 * 0.004, 500.0 * Clearance);
  EXPECT_NEAR(force[1], force[0], 500.0 * Clearance);
}

TEST(HapticSceneWorkspace, RefusesWhatIsNoSimilarityAndKeepsTheLast)
{
  LedHand hand;
  vtkNew<vtkMatrix4x4> good;
  good->SetElement(0, 3, 7.0);
  ASSERT_TRUE(hand.Scene->SetWorkspaceTransform(good));
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  int refused = 0;
  for (const double element : { 2.0, -1.0, 0.0, std::nan("") })
  {
    vtkNew<vtkMatrix4x4> bad; // stretched, mirrored, flattened, not finite
    bad->SetElement(0, 0, element);
    EXPECT_FALSE(hand.Scene->SetWorkspaceTransform(bad)) << element;
    EXPECT_EQ(errors.Count, ++refused);
  }
  EXPECT_EQ(hand.Scene->GetWorkspaceTransform()->GetElement(0, 3), 7.0);
}

TEST(HapticSceneWorkspace, FittingNothingIsAnError)
{
  LedHand hand;
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(hand.Scene->FitWorkspace());
  const double point[6] = { 1.0, 1.0, 1.0, 1.0, 1.0, 1.0 };
  EXPECT_FALSE(hand.Scene->FitWorkspace(point));
  EXPECT_EQ(errors.Count, 2);
}

TEST(HapticSceneWorkspace, IsFittedToTheViewWhenItIsEngagedUnlessItWasChosen)
{
  vtkNew<vtkCamera> camera; // looks down on the table
  for (const bool chosen : { false, true })
  {
    LedHand hand;
    hand.Device->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    hand.Scene->AddSurface(MakeTable(0.0));
    vtkNew<vtkMatrix4x4> own;
    own->SetElement(0, 3, 0.01);
    if (chosen)
    {
      ASSERT_TRUE(hand.Scene->SetWorkspaceTransform(own));
    }
    ASSERT_TRUE(hand.Scene->EngageInView(camera));
    vtkMatrix4x4* matrix = hand.Scene->GetWorkspaceTransform();
    EXPECT_NEAR(matrix->GetElement(0, 0), chosen ? 1.0 : 2.0, 1e-6) << "0.2 m, float32, from 0.1 m";
    EXPECT_EQ(matrix->GetElement(0, 3), chosen ? 0.01 : 0.0);
    hand.Scene->Release();
  }
}

TEST(HapticSceneWorkspace, EngagesInAViewWithNothingToTouchYet)
{
  LedHand hand;
  vtkNew<vtkCamera> camera;
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  EXPECT_TRUE(hand.Scene->EngageInView(camera));
  EXPECT_EQ(errors.Count, 0);
  EXPECT_TRUE(hand.Scene->GetWorkspaceTransform()->IsIdentity());
}

TEST(HapticSceneWorkspace, ResetUndoesScalingAndClutching)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkMatrix4x4> home;
  home->SetElement(2, 3, 0.01);
  ASSERT_TRUE(hand.Scene->SetWorkspaceTransform(home));
  hand.MoveTo(0.01);
  ASSERT_TRUE(hand.Scene->ScaleWorkspace(3.0));
  hand.Scene->SetClutched(true);
  hand.MoveTo(0.05);
  hand.Scene->SetClutched(false);
  hand.Scene->SetClutched(true);
  ASSERT_NE(hand.Scene->GetWorkspaceTransform()->GetElement(2, 3), 0.01);
  hand.Scene->ResetWorkspace();
  EXPECT_FALSE(hand.Scene->GetClutched());
  for (int i = 0; i < 16; ++i)
  {
    EXPECT_EQ(hand.Scene->GetWorkspaceTransform()->GetData()[i], home->GetData()[i]) << i;
  }
}
