#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSurfaces.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

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

TEST(HapticSceneWorkspace, FitsTheSurfacesAndHasTheSameForcesAtAnyScale)
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

namespace
{
constexpr double Radius = 0.03;

vtkSmartPointer<vtkPolyData> MakeSolidBall()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(Radius);
  ball->SetThetaResolution(60);
  ball->SetPhiResolution(60);
  ball->Update();
  return ball->GetOutput();
}

/// A hand with default safety, a millimetre or more deep in the top of a closed ball.
struct PressedBall
{
  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticScene> Scene;
  double Height = 0.04;
  double LargestStep = 0.0; ///< by which the force has grown in a tick [N]

  explicit PressedBall(double depth)
  {
    this->Scene->SetDevice(this->Device);
    this->Scene->AddSurface(MakeSolidBall());
    while (this->Height > Radius - depth)
    {
      this->Move(-1e-4);
    }
    for (int i = 0; i < 150; ++i)
    {
      this->Move(0.0);
    }
    EXPECT_NEAR(this->Force(), 500.0 * depth, 0.3);
    this->LargestStep = 0.0;
  }
  double Force() { return this->Scene->GetForce()[2]; }
  void Move(double step)
  {
    this->Height += step;
    const double before = this->Force();
    this->Device->SetPosition(0.0003, 0.0002, this->Height);
    this->Scene->Step(1);
    this->LargestStep = std::max(this->LargestStep, this->Force() - before);
    // Facets lie up to 0.3 % inside the ball.
    ASSERT_GT(vtkMath::Norm(this->Scene->GetGodObject()), 0.99 * Radius);
  }
  void Move(double step, int ticks)
  {
    for (int i = 0; i < ticks; ++i)
    {
      this->Move(step);
    }
  }
};

void Set(vtkHapticScene* scene, double scale, double z)
{
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i)
  {
    matrix->SetElement(i, i, scale);
  }
  matrix->SetElement(2, 3, z);
  scene->SetWorkspaceTransform(matrix);
}
}

//     o HIP after           whatever is done to the workspace, and while the hand presses on
//    _._  god-object
//   /   \  ball
TEST(HapticSceneWorkspace, NoChangeOfItLetsAPressingHandIn)
{
  const struct
  {
    const char* Name;
    std::function<void(vtkHapticScene*)> Change;
  } changes[] = {
    { "scaled up", [](vtkHapticScene* s) { s->ScaleWorkspace(1.25); } },
    { "scaled down", [](vtkHapticScene* s) { s->ScaleWorkspace(0.8); } },
    { "scaled by one", [](vtkHapticScene* s) { s->ScaleWorkspace(1.0); } },
    { "reset", [](vtkHapticScene* s) { s->ResetWorkspace(); } },
    { "fitted", [](vtkHapticScene* s) { s->FitWorkspace(); } },
    { "enlarged", [](vtkHapticScene* s) { Set(s, 1.02, 0.0); } },
    { "lowered", [](vtkHapticScene* s) { Set(s, 1.0, -0.005); } },
    { "lowered to the middle", [](vtkHapticScene* s) { Set(s, 1.0, -Radius); } },
    { "clutched", [](vtkHapticScene* s) { s->SetClutched(true), s->SetClutched(false); } },
  };
  for (const auto& change : changes)
  {
    for (const double speed : { 0.0, 0.001, 0.01, 0.1 })
    {
      SCOPED_TRACE(std::string(change.Name) + ", pressing on at " + std::to_string(speed) + " m/s");
      PressedBall hand(0.003);
      change.Change(hand.Scene);
      hand.Move(-0.001 * speed, 200);
      const double soft = 3.3 * 0.001 / 0.1;
      if (std::string(change.Name) != "clutched") // lets go at once
      {
        EXPECT_LE(hand.LargestStep, std::max(soft, 500.0 * 0.001 * speed * 1.5) + 1e-9);
      }
      EXPECT_STREQ(hand.Scene->GetErrorMessage(), "");
    }
  }
}

TEST(HapticSceneWorkspace, ScalingKeepsAContactAndItsForce)
{
  PressedBall hand(0.003);
  const double force = hand.Force();
  for (const double factor : { 1.25, 1.25, 0.5, 3.0, 0.1 })
  {
    ASSERT_TRUE(hand.Scene->ScaleWorkspace(factor));
    hand.Move(0.0, 20);
    EXPECT_NEAR(hand.Force(), force, 1e-6) << factor;
    EXPECT_TRUE(hand.Scene->GetTouching());
  }
  hand.Scene->ScaleWorkspace(8.0);
  EXPECT_LE(hand.LargestStep, 1e-6);
}

// Where the device is in the air then, the hand is too, and outside where it is in a solid.
TEST(HapticSceneWorkspace, AFreeHandGoesAlongButNotIntoASolid)
{
  for (const bool isInside : { false, true })
  {
    LedHand hand;
    hand.Scene->AddSurface(MakeSolidBall());
    hand.MoveTo(0.05);
    Set(hand.Scene, 1.0, isInside ? -0.05 : -0.1); // 0.0 or, past the ball, -0.05
    hand.Scene->Step(1);
    EXPECT_EQ(hand.Scene->GetTouching(), isInside);
    EXPECT_GT(vtkMath::Norm(hand.Scene->GetGodObject()), 0.99 * Radius);
    EXPECT_NEAR(hand.GodObjectHeight(), isInside ? 0.0 : -0.05, 0.002);
  }
}

//   ######  a slot of a millimetre between two blocks: clutched there, moved on and let go
//      o
//   ######
TEST(HapticSceneWorkspace, TheClutchReleasesInANarrowSlotOutsideOfBothBlocks)
{
  for (const double way : { -0.01, -0.002, 0.0, 0.002, 0.01 })
  {
    LedHand hand;
    for (const double z : { -0.01, 0.011 })
    {
      vtkNew<vtkCubeSource> block;
      block->SetXLength(0.04);
      block->SetYLength(0.04);
      block->SetZLength(0.02);
      block->SetCenter(0.0, 0.0, z);
      block->Update();
      hand.Scene->AddSurface(block->GetOutput());
    }
    const auto go = [&](double x, double z)
    {
      hand.Device->SetPosition(x, 0.002, z);
      hand.Scene->Step(1);
    };
    for (int i = 0; i <= 100; ++i)
    {
      go(0.03 - 0.0003 * i, 0.0005);
    }
    go(0.0, -0.0005);
    ASSERT_TRUE(hand.Scene->GetTouching());
    hand.Scene->SetClutched(true);
    for (int i = 0; i < 30; ++i)
    {
      go(0.0, -0.0005 + way);
    }
    hand.Scene->SetClutched(false);
    for (int i = 0; i < 100; ++i)
    {
      go(0.0, -0.0005 + way - 1e-5 * i);
      ASSERT_GT(hand.GodObjectHeight(), 0.0);
      ASSERT_LT(hand.GodObjectHeight(), 0.001);
    }
    EXPECT_NEAR(hand.Scene->GetForce()[2], 500.0 * 99e-5, 2e-3) << "pressed again, from there";
  }
}

TEST(HapticSceneWorkspace, SurfacesThatMovePushAClutchedHandAlong)
{
  LedHand hand;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeSolidBall());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  hand.Scene->AddSurface(actor);
  hand.MoveTo(0.05);
  hand.Scene->SetClutched(true);
  for (int i = 1; i <= 300; ++i)
  {
    actor->SetPosition(0.01, 0.02, 0.0001 * i);
    hand.Scene->Step(1);
    ASSERT_FALSE(hand.Scene->GetTouching());
    ASSERT_EQ(hand.Scene->GetForce()[2], 0.0);
  }
  hand.Scene->Step(100);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.03 + Radius, 1e-3);
  hand.Scene->SetClutched(false);
  hand.Scene->Step(10);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.03 + Radius, 1e-3) << "and it is not inside after that";
}

// A running servo: the hand sinks at 0.3 m/s while the clutch is let go or the workspace scaled.
TEST(HapticSceneWorkspace, ARunningHandThatSinksIsNotLetIn)
{
  using Change = std::function<void(vtkHapticScene*)>;
  const Change changes[] = {
    [](vtkHapticScene* s) { s->SetClutched(false); },
    [](vtkHapticScene* s) { s->SetClutched(false), s->ScaleWorkspace(1.25); },
    [](vtkHapticScene* s) { s->ResetWorkspace(); },
  };
  for (const Change& change : changes)
  {
    for (int run = 0; run < 4; ++run)
    {
      vtkNew<vtkSimulatedHapticDevice> device;
      vtkNew<vtkHapticScene> scene;
      scene->SetDevice(device);
      scene->AddSurface(MakeSolidBall());
      vtkNew<vtkPolyData> path;
      vtkNew<vtkPoints> points;
      vtkNew<vtkDoubleArray> times;
      times->SetName("Time");
      const double way[][2] = { { 0.0, 0.04 }, { 0.2, 0.029 }, { 0.4, 0.029 }, { 0.9, -0.12 } };
      for (const auto& corner : way)
      {
        times->InsertNextValue(corner[0]);
        points->InsertNextPoint(0.0003, 0.0002, corner[1]);
      }
      path->SetPoints(points);
      path->GetPointData()->AddArray(times);
      device->SetPath(path);
      device->SetMotionToPolyline();
      ASSERT_TRUE(scene->Engage()) << scene->GetErrorMessage();
      const auto runUntil = [&](double time)
      {
        while (scene->GetServo()->GetReadings()->GetTime() < time && scene->IsEngaged())
        {
          scene->Update();
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
      };
      runUntil(0.3);
      scene->SetClutched(true);
      runUntil(0.45 + 0.003 * run);
      change(scene);
      for (int i = 0; i < 6; ++i)
      {
        runUntil(scene->GetServo()->GetReadings()->GetTime() + 0.01);
        scene->Update();
        EXPECT_GT(vtkMath::Norm(scene->GetGodObject()), 0.99 * Radius);
      }
      scene->Release();
    }
  }
}

namespace
{
/// What a subject has warned of, kept out of the output.
class Warnings
{
public:
  explicit Warnings(vtkObject* subject)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<Warnings*>(self)->Texts.emplace_back(static_cast<const char*>(text)); });
    subject->AddObserver(vtkCommand::WarningEvent, this->Command);
  }
  std::vector<std::string> Texts;

private:
  vtkNew<vtkCallbackCommand> Command;
};

/// A ball of 100 mm under a hand that reaches over 0.2 m, where nobody has said what a unit is.
struct BallInMillimetres
{
  LedHand Hand;
  vtkNew<vtkSphereSource> Ball;
  int Id;

  BallInMillimetres()
  {
    this->Hand.Device->SetWorkspaceBounds(-0.1, 0.1, -0.1, 0.1, -0.1, 0.1);
    this->Ball->SetRadius(50.0);
    this->Id = this->Hand.Scene->AddSurface(this->Ball->GetOutputPort());
    this->Hand.Scene->GetSurfaces()->SetName(this->Id, "ball.stl");
  }
};
}

TEST(HapticSceneWorkspace, ASurfaceFarLargerThanTheDeviceReachesIsReportedOnce)
{
  BallInMillimetres scene;
  Warnings warnings(scene.Hand.Scene);
  scene.Hand.Scene->Update(); // the workspace may be set yet
  EXPECT_TRUE(warnings.Texts.empty());
  scene.Hand.Scene->Step(1);
  scene.Hand.Scene->Step(1);
  ASSERT_TRUE(scene.Hand.EngagePatiently());
  scene.Hand.Scene->Update();
  scene.Hand.Scene->Release();
  ASSERT_EQ(warnings.Texts.size(), 1U);
  for (const char* words : { "Surface 0 (ball.stl) ", "FitWorkspace()", "EngageInView()" })
  {
    EXPECT_NE(warnings.Texts[0].find(words), std::string::npos) << warnings.Texts[0];
  }
  scene.Ball->SetRadius(0.05);
  scene.Hand.Scene->Step(1);
  scene.Ball->SetRadius(50.0);
  scene.Hand.Scene->Step(1);
  EXPECT_EQ(warnings.Texts.size(), 2U) << "it was right meanwhile";
}

TEST(HapticSceneWorkspace, EachRemedyForALargeSurfaceHelps)
{
  const std::vector<std::function<void(vtkHapticScene*)>> remedies = {
    [](vtkHapticScene* scene) { scene->FitWorkspace(); },
    [](vtkHapticScene* scene)
    {
      vtkNew<vtkCamera> camera;
      scene->EngageInView(camera);
      scene->Release();
    },
    [](vtkHapticScene* scene)
    {
      vtkNew<vtkMatrix4x4> millimetres;
      for (int i = 0; i < 3; ++i)
      {
        millimetres->SetElement(i, i, 1000.0);
      }
      scene->SetWorkspaceTransform(millimetres);
    },
    [](vtkHapticScene* scene) { scene->ScaleWorkspace(1000.0); },
    [](vtkHapticScene* scene) { scene->GetWorkspace()->SetUnitLength(0.001); },
  };
  for (const auto& remedy : remedies)
  {
    BallInMillimetres scene;
    Warnings warnings(scene.Hand.Scene);
    remedy(scene.Hand.Scene);
    scene.Hand.Scene->Step(1);
    EXPECT_TRUE(warnings.Texts.empty()) << warnings.Texts[0];
  }
}

TEST(HapticSceneWorkspace, ASurfaceThatTheDeviceCanExploreIsNotReported)
{
  BallInMillimetres scene;
  Warnings warnings(scene.Hand.Scene);
  scene.Ball->SetRadius(1.0);
  scene.Hand.Scene->Step(1);
  EXPECT_TRUE(warnings.Texts.empty());
}

TEST(HapticSceneWorkspace, ASurfaceFarSmallerThanTheDeviceReachesIsReportedOnce)
{
  BallInMillimetres scene;
  scene.Ball->SetRadius(0.0005); // of 0.2 m
  Warnings warnings(scene.Hand.Scene);
  scene.Hand.Scene->Step(1);
  scene.Hand.Scene->Step(1);
  ASSERT_EQ(warnings.Texts.size(), 1U);
  EXPECT_NE(warnings.Texts[0].find("FitWorkspace()"), std::string::npos) << warnings.Texts[0];
  scene.Hand.Scene->FitWorkspace(); // the remedy
  scene.Hand.Scene->Step(1);
  EXPECT_EQ(warnings.Texts.size(), 1U);
}

TEST(HapticSceneWorkspace, ASmallSurfaceNextToALargeOneIsNotReported)
{
  BallInMillimetres scene;
  scene.Ball->SetRadius(0.0005);
  scene.Hand.Scene->AddSurface(MakeTable(0.0));
  Warnings warnings(scene.Hand.Scene);
  scene.Hand.Scene->Step(1);
  EXPECT_TRUE(warnings.Texts.empty()) << warnings.Texts[0];
}

TEST(HapticSceneWorkspace, TheUnitGivesSurfacesTheirTrueSizeInTheHand)
{
  BallInMillimetres scene;
  scene.Hand.Scene->GetWorkspace()->SetUnitLength(0.001);
  EXPECT_EQ(scene.Hand.Scene->GetWorkspace()->GetUnitLength(), 0.001);
  scene.Hand.Device->SetPosition(0.0, 0.0, 0.06);
  scene.Hand.Scene->Step(1);
  scene.Hand.Device->SetPosition(0.0, 0.0, 0.048);
  scene.Hand.Scene->Step(1);
  // The ball has few facets; the hand meets one that is not level.
  EXPECT_NEAR(scene.Hand.Scene->GetPenetration(), 2.0, 0.1);
  EXPECT_NEAR(scene.Hand.Scene->GetForce()[2], 1.0, 0.1) << "of 500 N/m, 2 mm deep";

  scene.Hand.Scene->ResetWorkspace();
  EXPECT_NEAR(scene.Hand.Scene->GetWorkspace()->GetScale(), 1000.0, 1e-9);
  vtkNew<vtkMatrix4x4> chosen;
  scene.Hand.Scene->SetWorkspaceTransform(chosen);
  scene.Hand.Scene->GetWorkspace()->SetUnitLength(0.01);
  EXPECT_EQ(scene.Hand.Scene->GetWorkspace()->GetScale(), 1.0) << "what was set stays";
}

TEST(HapticSceneWorkspace, UnitsThatAreNoneAreErrorsAndNothingJumps)
{
  BallInMillimetres scene;
  scene.Hand.Scene->GetWorkspace()->SetUnitLength(0.001);
  scene.Hand.Device->SetPosition(0.0, 0.0, 0.06);
  scene.Hand.Scene->Step(1);
  scene.Hand.Device->SetPosition(0.0, 0.0, 0.048);
  scene.Hand.Scene->Step(1);
  const double before = scene.Hand.Scene->GetForce()[2];
  for (const double bad : { -0.001, std::nan(""), std::numeric_limits<double>::infinity(), 1e-200 })
  {
    EventCounter errors(scene.Hand.Scene, vtkCommand::ErrorEvent);
    scene.Hand.Scene->GetWorkspace()->SetUnitLength(bad);
    EXPECT_EQ(errors.Count, 1) << bad;
    EXPECT_NE(
      std::string(scene.Hand.Scene->GetErrorMessage()).find("UnitLength"), std::string::npos)
      << scene.Hand.Scene->GetErrorMessage();
    EXPECT_EQ(scene.Hand.Scene->GetWorkspace()->GetUnitLength(), 0.001);
    scene.Hand.Scene->Step(1);
    EXPECT_EQ(scene.Hand.Scene->GetForce()[2], before) << bad;
  }
  // Not known: metres again, by the law of every change of the workspace. The ball is 100 m then,
  // and a hand that was outside of it does not land inside.
  scene.Hand.Scene->GetWorkspace()->SetUnitLength(0.0);
  EXPECT_STREQ(scene.Hand.Scene->GetErrorMessage(), "");
  scene.Hand.Scene->Step(100);
  const double* const god = scene.Hand.Scene->GetGodObject();
  EXPECT_GT(std::hypot(god[0], god[1], god[2]), 45.0) << "of 50; few facets";
}
