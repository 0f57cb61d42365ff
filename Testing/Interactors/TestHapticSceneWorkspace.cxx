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
