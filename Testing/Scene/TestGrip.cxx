// What the hand grips goes where the hand goes, and is touched again when it is let go.
#include "GripTestTools.h"
#include "TraceComparison.h"

#include "vtkAssembly.h"
#include "vtkDataArray.h"
#include "vtkHapticProbe.h"
#include "vtkHapticSurfaces.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace
{
constexpr unsigned int GripButton = 1u << 2;

/// Writes down what is gripped and let go of.
class Diary
{
public:
  explicit Diary(vtkHapticScene* scene)
    : Scene(scene)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long event, void* self, void* data)
      {
        static_cast<Diary*>(self)->Events +=
          (event == vtkHapticScene::GripEvent ? " grip" : " letgo") +
          std::to_string(*static_cast<int*>(data));
      });
    scene->AddObserver(vtkHapticScene::GripEvent, this->Command);
    scene->AddObserver(vtkHapticScene::LetGoEvent, this->Command);
  }
  ~Diary() { this->Scene->RemoveObserver(this->Command); }
  std::string Events;

private:
  vtkSmartPointer<vtkHapticScene> Scene;
  vtkNew<vtkCallbackCommand> Command;
};

vtkSmartPointer<vtkMatrix4x4> SomeMatrix(double scale)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(0.01, -0.02, 0.03);
  transform->RotateWXYZ(40.0, 1.0, 2.0, -1.0);
  transform->Scale(scale, 1.2 * scale, 0.9 * scale);
  vtkNew<vtkMatrix4x4> matrix;
  transform->GetMatrix(matrix);
  return matrix;
}
}

TEST(Grip, TheActorMovesByWhatTheGodObjectMoves)
{
  Workbench bench;
  bench.Go(0.003, 0.005, 0.018);
  const Point held = bench.GodObject();
  ASSERT_NEAR(held[2], 0.02, Clearance);
  ASSERT_TRUE(bench.Scene->GetGrip()->Take());
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), bench.PartId);
  EXPECT_EQ(Length(bench.Place(bench.Part)), 0.0) << "not before the servo has let the hand in";
  for (int i = 1; i <= 50; ++i)
  {
    bench.Go(0.003 - 0.001 * i, 0.005 + 0.002 * i, 0.018 + 0.0005 * i * i, 16);
    const Point moved = bench.GodObject() - held;
    ASSERT_LE(Length(bench.Place(bench.Part) - moved), 1e-9) << i;
    ASSERT_EQ(bench.Force(), 0.0) << "there is no force in free space";
  }
  EXPECT_GT(Length(bench.Place(bench.Part)), 0.1);
}

// Whatever stands above its position: own scale and turn, a user matrix or transform, assemblies.
TEST(Grip, TheActorMovesSoWhateverItsMatrixIsMadeOf)
{
  vtkNew<vtkTransform> userTransform;
  userTransform->SetMatrix(SomeMatrix(1.1));
  const std::vector<std::function<void(vtkActor*)>> makers{ [](vtkActor* actor)
    {
      actor->SetOrigin(0.01, 0.02, 0.005);
      actor->RotateX(30.0);
      actor->SetScale(1.3, 0.8, 1.1);
    },
    [](vtkActor* actor) { actor->SetUserMatrix(SomeMatrix(0.9)); },
    [&](vtkActor* actor)
    {
      actor->SetUserTransform(userTransform);
      actor->RotateY(-20.0);
      actor->SetScale(-1.0, 1.0, 1.0); // a mirror
    } };
  for (std::size_t i = 0; i < 2 * makers.size(); ++i)
  {
    Workbench bench;
    makers[i / 2](bench.Part);
    vtkNew<vtkAssembly> arm;
    vtkNew<vtkAssembly> robot;
    const bool isAssembled = i % 2 == 1;
    if (isAssembled)
    {
      bench.Scene->RemoveSurface(bench.PartId);
      arm->AddPart(bench.Part);
      arm->SetUserMatrix(SomeMatrix(1.1));
      robot->AddPart(arm);
      robot->SetPosition(0.01, 0.0, -0.02);
      robot->RotateZ(15.0);
      bench.Scene->AddSurface(robot);
    }
    // From far to the middle of the part, which the hand meets somewhere.
    const double* bounds = isAssembled ? robot->GetBounds() : bench.Part->GetBounds();
    const Point middle{ { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) } };
    bench.Go(middle[0], middle[1], middle[2] + 0.2);
    bench.Scene->Step(100);
    bench.Go(middle[0], middle[1], middle[2] + 0.01);
    ASSERT_TRUE(bench.Scene->GetTouching()) << i;
    const Point held = bench.GodObject();
    const Point start = bench.Place(bench.Part);
    const int id = bench.Scene->GetTouchedSurface();
    EXPECT_EQ(bench.Scene->GetSurfaceActor(id), bench.Part.Get());
    ASSERT_TRUE(bench.Scene->GetGrip()->Take()) << bench.Scene->GetErrorMessage();
    bench.Go(middle[0] + 0.02, middle[1] - 0.03, middle[2] + 0.05, 16);
    EXPECT_GT(Length(bench.Place(bench.Part) - start), 0.01);
    bench.Scene->Update();
    EXPECT_FALSE(bench.Scene->Update()) << "rounding moves no picture";

    // Let go, the hand is where it was on the part, also where something else has moved it just
    // before: it lifts off freely, and finds the part as far away as it was.
    robot->AddPosition(0.0, 0.05, 0.02);
    arm->AddPosition(0.03, 0.0, 0.0);
    bench.Scene->GetGrip()->LetGo();
    bench.Scene->Step(16);
    EXPECT_LT(bench.Force(), 1e-6) << i;
    bench.Go(middle[0] + 0.02, middle[1] - 0.03, middle[2] + 0.05 + 0.1, 16);
    EXPECT_FALSE(bench.Scene->GetTouching()) << i;
    const Point by = Point{ { middle[0] + 0.02, middle[1] - 0.03, middle[2] + 0.05 } } - held;
    bench.Go(middle[0] + by[0], middle[1] + by[1], middle[2] + by[2] + 0.2);
    bench.Go(middle[0] + by[0], middle[1] + by[1], middle[2] + by[2] + 0.01);
    EXPECT_LT(Length(bench.GodObject() - held - by), 1e-9) << i;
    EXPECT_EQ(bench.Scene->GetTouchedSurface(), id);
  }
}

//      .-----o|x    the point in the hand is held by the wall, and the part with it
TEST(Grip, AWallHoldsHandAndPartBack)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  for (int i = 0; i <= 20; ++i)
  {
    bench.Go(0.003 + 0.005 * i, 0.005, 0.018, 16);
  }
  bench.Scene->Update();
  EXPECT_EQ(bench.Scene->GetTouchedSurface(), bench.WallId);
  EXPECT_NEAR(bench.GodObject()[0], 0.1, Clearance);
  EXPECT_NEAR(bench.Scene->GetForce()[0], -500.0 * 0.003, 1e-3) << "the wall's own";
  EXPECT_NEAR(bench.Force(), 500.0 * 0.003, 1e-3);
  EXPECT_NEAR(bench.Place(bench.Part)[0], 0.1 - 0.003, Clearance);
  EXPECT_NEAR(bench.Place(bench.Part)[2], -0.002, Clearance) << "it has come to the hand";

  // Let go there: both hold it now, and nothing of that pushes but the wall.
  bench.Scene->GetGrip()->LetGo();
  bench.Scene->Step(50);
  EXPECT_NEAR(bench.Force(), 500.0 * 0.003, 1e-3);
  EXPECT_FALSE(bench.IsInside());
  bench.Go(0.103, 0.005, 0.017, 1);
  EXPECT_NEAR(bench.Scene->GetForce()[2], 500.0 * 0.001, 1e-3) << "the part's top is back";
}

// Whatever the hand does while it is let go: no step of the force beyond the limits, no leak.
TEST(Grip, LettingGoOfAMovingPartIsSoftAndNeverLeaks)
{
  for (const double speed : { -0.0005, -0.0001, 0.0, 0.0002 }) // a tick, into the part or out of it
  {
    Workbench bench(false);
    bench.Scene->Step(200);
    bench.Scene->StartRecording();
    ASSERT_TRUE(bench.PressAndGrip());
    double z = 0.018;
    for (int tick = 0; tick < 200; ++tick)
    {
      z += speed;
      bench.Device->SetPosition(0.003, 0.005, z);
      if (tick == 110)
      {
        bench.Scene->GetGrip()->LetGo();
        EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1);
      }
      bench.Scene->Step(1); // its first tick is the first one in the new place
      if (tick >= 110)
      {
        ASSERT_FALSE(bench.IsInside()) << speed << ", tick " << tick;
        ASSERT_EQ(bench.Scene->GetTouching(), speed < 0.0) << speed;
      }
    }
    EXPECT_LE(haptics::testing::LargestForceStep(bench.Scene->GetTrace()), 1.0 + 1e-9)
      << "N, the slew limit";
    EXPECT_EQ(bench.Scene->GetTrace()->GetNumberOfPoints(), 201) << "every tick is in the trace";
  }
}

TEST(Grip, AButtonGripsWhileItIsHeld)
{
  Workbench bench;
  Diary diary(bench.Scene);
  EXPECT_EQ(bench.Scene->GetGrip()->GetButton(), 2);
  bench.Device->SetButtons(GripButton);
  bench.Go(0.003, 0.005, 0.025);
  bench.Go(0.003, 0.005, 0.018);
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1) << "pressed in the air it grips nothing";
  bench.Device->SetButtons(0);
  bench.Scene->Step(1);
  bench.Device->SetButtons(GripButton);
  bench.Scene->Step(2);
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), bench.PartId);
  bench.Go(0.003, 0.005, 0.048, 2);
  bench.Device->SetButtons(0);
  bench.Scene->Step(2);
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1);
  EXPECT_NEAR(bench.Place(bench.Part)[2], 0.028, Clearance);
  bench.Go(0.003, 0.005, 0.047);
  EXPECT_EQ(bench.Scene->GetTouchedSurface(), bench.PartId) << "touched again";
  const std::string id = std::to_string(bench.PartId);
  EXPECT_EQ(diary.Events, " grip" + id + " letgo" + id);

  for (const int button : { -1, 3 })
  {
    bench.Scene->GetGrip()->SetButton(button);
    bench.Device->SetButtons(GripButton);
    bench.Scene->Step(1);
    EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1);
    bench.Device->SetButtons(0);
    bench.Scene->Step(1);
  }
  bench.Device->SetButtons(1u << 3);
  bench.Scene->Step(1);
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), bench.PartId);
}

TEST(Grip, WhatIsGrippedIsNotInTheWay)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  EXPECT_FALSE(bench.Scene->GetSurfaces()->IsTouchable(bench.PartId));
  const double from[3] = { 0.0, 0.0, 1.0 };
  const double down[3] = { 0.0, 0.0, -1.0 };
  double hit[3];
  EXPECT_FALSE(bench.Scene->IntersectRay(from, down, hit)) << "the mouse's hand would press on it";
  bench.Scene->GetGrip()->LetGo();
  EXPECT_TRUE(bench.Scene->IntersectRay(from, down, hit));
  EXPECT_TRUE(bench.Scene->GetSurfaces()->IsTouchable(bench.PartId));
}

TEST(Grip, OneThatIsNotTouchedIsMovedToo)
{
  Workbench bench;
  bench.Go(0.003, 0.005, 0.05);
  ASSERT_TRUE(bench.Scene->GetGrip()->TakeSurface(bench.PartId));
  EXPECT_TRUE(bench.Scene->GetGrip()->TakeSurface(bench.PartId)) << "it is";
  bench.Go(0.003, 0.005, 0.0, 2);
  bench.Scene->Update();
  EXPECT_NEAR(bench.Place(bench.Part)[2], -0.05, 1e-9);
  bench.Scene->GetGrip()->LetGo();
  bench.Go(0.003, 0.005, -0.04, 2);
  EXPECT_NEAR(bench.GodObject()[2], -0.03, Clearance)
    << "its top is 30 mm below where the hand was";
}

TEST(Grip, AnotherOneIsTakenInItsStead)
{
  Workbench bench;
  vtkSmartPointer<vtkActor> other = MakeCube();
  other->SetPosition(0.0, 0.0, -0.1);
  const int id = bench.Scene->AddSurface(other);
  bench.Scene->Step(1);
  Diary diary(bench.Scene);
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Go(0.003, 0.005, 0.03, 2);
  ASSERT_TRUE(bench.Scene->GetGrip()->TakeSurface(id));
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), id);
  const double before = bench.Place(bench.Part)[2];
  bench.Go(0.003, 0.005, 0.04, 2);
  bench.Scene->Update();
  EXPECT_EQ(bench.Place(bench.Part)[2], before);
  EXPECT_NEAR(bench.Place(other)[2], -0.1 + 0.01, 1e-9);
  EXPECT_EQ(diary.Events,
    " grip" + std::to_string(bench.PartId) + " letgo" + std::to_string(bench.PartId) + " grip" +
      std::to_string(id));
}

// The servo is one update behind an actor that something else moves: where the hand holds it is
// where the hand has it.
TEST(Grip, APartThatIsOnItsWayIsHeldWhereTheHandHasIt)
{
  Workbench bench;
  bench.Go(0.003, 0.005, 0.018);
  bench.Scene->Step(32);
  bench.Part->AddPosition(0.0, 0.0, 0.016);
  bench.Scene->Step(5); // of 33 on its way
  EXPECT_LT(bench.GodObject()[2], 0.025);
  ASSERT_TRUE(bench.Scene->GetGrip()->Take());
  bench.Go(0.003, 0.005, 0.05, 16);
  EXPECT_NEAR(bench.Place(bench.Part)[2], 0.03, Clearance) << "its top is in the hand";
  bench.Scene->GetGrip()->LetGo();
  bench.Scene->Step(50);
  EXPECT_LT(bench.Force(), 1e-6);
  EXPECT_FALSE(bench.IsInside());
}

// An actor that something else moves meanwhile comes back to the hand; at its release too.
TEST(Grip, ThePointInTheHandStaysThere)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Scene->Step(2);
  bench.Part->RotateZ(30.0);
  bench.Part->AddPosition(0.01, 0.0, 0.2);
  bench.Scene->Update();
  bench.Scene->GetGrip()->LetGo();
  bench.Go(0.003, 0.005, 0.017);
  EXPECT_NEAR(bench.GodObject()[2], 0.018, Clearance);
  EXPECT_NEAR(bench.Force(), 500.0 * 0.001, 1e-3);
}

TEST(Grip, SetBackWhereItCameFromItPushesNoHand)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Go(0.003, 0.005, 0.218, 2);
  bench.Scene->GetGrip()->LetGo();
  bench.Part->SetPosition(0.0, 0.0, 0.0); // undone
  bench.Scene->Step(100);
  EXPECT_FALSE(bench.Scene->GetTouching());
  bench.Go(0.003, 0.005, 0.018);
  EXPECT_NEAR(bench.GodObject()[2], 0.02, Clearance);

  // And so far that the hand, which is on it, cannot be taken along: as any actor moved so far.
  ASSERT_TRUE(bench.Scene->GetGrip()->Take());
  bench.Go(0.003, 0.005, -1.98, 2);
  bench.Scene->GetGrip()->LetGo();
  EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
  bench.Part->SetPosition(0.0, 0.0, 0.0);
  bench.Scene->Step(1);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(bench.Force(), 0.0);
}

// A dropped frame: the scene is updated late, or ticks are lost because it was.
TEST(Grip, IsReportedBeforeTheActorMovesAndItsContactStaysToBeProbed)
{
  Workbench bench;
  bench.Go(0.003, 0.005, 0.018);
  Point there{ { -1.0, -1.0, -1.0 } };
  const auto note = [&] { bench.Part->GetPosition(there.data()); };
  vtkNew<vtkCallbackCommand> command;
  std::function<void()> callback = note;
  command->SetClientData(&callback);
  command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { (*static_cast<std::function<void()>*>(data))(); });
  bench.Scene->AddObserver(vtkHapticScene::GripEvent, command);
  ASSERT_TRUE(bench.EngagePatiently()) << bench.Scene->GetErrorMessage();
  while (!bench.Scene->GetTouching() && bench.Scene->IsEngaged())
  {
    bench.Device->SetPosition(
      0.003, 0.005, bench.Scene->GetHapticInterfacePoint()[2] > 0.025 ? 0.018 : 0.03);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    bench.Scene->Update();
  }
  ASSERT_TRUE(bench.Scene->GetGrip()->Take()) << bench.Scene->GetErrorMessage();
  EXPECT_TRUE(bench.Scene->GetProbe()->GetTouching());
  bench.Device->SetPosition(0.013, 0.005, 0.018);
  bench.AwaitTicks(30);
  bench.Scene->Update();
  EXPECT_EQ(there, (Point{ { 0.0, 0.0, 0.0 } })) << "so that it can be put back";
  EXPECT_GT(bench.Part->GetPosition()[0], 0.005);
}

TEST(Grip, IsRefusedOnAnActorThatWasHiddenMeanwhile)
{
  Workbench bench;
  bench.Go(0.003, 0.005, 0.018);
  Diary diary(bench.Scene);
  bench.Part->VisibilityOff();
  {
    EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
    EXPECT_FALSE(bench.Scene->GetGrip()->TakeSurface(bench.PartId));
    EXPECT_EQ(errors.Count, 1);
  }
  bench.Scene->Step(1);
  EXPECT_EQ(diary.Events, "");
}

TEST(Grip, EndsWithTheStepping)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Scene->Step(5);
  Point before;
  bench.Part->GetPosition(before.data());
  bench.Device->SetPosition(0.05, 0.005, 0.03);
  ASSERT_TRUE(bench.EngagePatiently());
  EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1);
  bench.AwaitTicks(20);
  bench.Scene->Update();
  Point after;
  bench.Part->GetPosition(after.data());
  EXPECT_EQ(before, after);
}

TEST(Grip, FollowsInRealTime)
{
  Workbench bench;
  bench.Scene->Release();
  const auto waitUntil = [&](const std::function<bool()>& holds)
  {
    for (int i = 0; i < 1000 && !holds(); ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      bench.Scene->Update();
    }
    return holds();
  };
  bench.Device->SetPosition(0.003, 0.005, 0.03);
  ASSERT_TRUE(bench.EngagePatiently());
  bench.AwaitTicks(); // the god-object starts above the part, and not in it
  bench.Device->SetPosition(0.003, 0.005, 0.018);
  ASSERT_TRUE(waitUntil([&] { return bench.Scene->GetTouching(); }));
  bench.Device->SetButtons(GripButton);
  ASSERT_TRUE(waitUntil([&] { return bench.Scene->GetGrip()->GetSurface() == bench.PartId; }));
  bench.Device->SetPosition(0.003, 0.005, 0.048);
  EXPECT_TRUE(waitUntil([&] { return std::abs(bench.Place(bench.Part)[2] - 0.028) < 1e-6; }));
  bench.Device->SetButtons(0);
  ASSERT_TRUE(waitUntil([&] { return bench.Scene->GetGrip()->GetSurface() == -1; }));
  bench.Device->SetPosition(0.003, 0.005, 0.045);
  EXPECT_TRUE(waitUntil([&] { return bench.Scene->GetTouching(); }));
  EXPECT_NEAR(bench.GodObject()[2], 0.048, 1e-6);
  bench.Scene->Release();
}
