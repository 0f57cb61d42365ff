// Grips that cannot be, and those that end by something else than letting go.
#include "GripTestTools.h"

#include "vtkAssembly.h"
#include "vtkHapticReadings.h"
#include "vtkMatrix4x4.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{
/// Returns what `scene` says when it refuses to grip; fails the test where it does not.
std::string Refusal(vtkHapticScene* scene, int id)
{
  EventCounter errors(scene, vtkCommand::ErrorEvent);
  EXPECT_FALSE(scene->GetGrip()->TakeSurface(id));
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(scene->GetGrip()->GetSurface(), -1);
  return scene->GetErrorMessage();
}

bool Has(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}
}

TEST(GripBadInput, WhatCannotBeGrippedIsRefusedWithTheReason)
{
  Workbench bench;
  vtkNew<vtkAssembly> whole;
  vtkSmartPointer<vtkActor> cube = MakeCube();
  cube->SetPosition(0.0, 0.0, -0.3);
  whole->AddPart(cube);
  const int assembly = bench.Scene->AddSurface(whole);
  bench.Scene->Step(1);
  EXPECT_TRUE(Has(Refusal(bench.Scene, -1), "no surface"));
  EXPECT_TRUE(Has(Refusal(bench.Scene, 1000), "no surface"));
  EXPECT_TRUE(Has(Refusal(bench.Scene, assembly), "assembly"));
  EXPECT_TRUE(Has(Refusal(bench.Scene, bench.WallId), "actor"));
  {
    EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
    EXPECT_FALSE(bench.Scene->GetGrip()->Take());
    EXPECT_EQ(errors.Count, 1);
    EXPECT_TRUE(Has(bench.Scene->GetErrorMessage(), "nothing is touched"));
  }
  bench.Part->VisibilityOff();
  bench.Scene->Step(1);
  EXPECT_TRUE(Has(Refusal(bench.Scene, bench.PartId), "cannot be touched"));
  bench.Part->VisibilityOn();
  bench.Scene->Step(1);
  bench.Scene->SetClutched(true);
  EXPECT_TRUE(Has(Refusal(bench.Scene, bench.PartId), "no hand"));
  bench.Scene->SetClutched(false);
  bench.Scene->Release();
  EXPECT_TRUE(Has(Refusal(bench.Scene, bench.PartId), "no hand"));
  bench.Scene->GetGrip()->LetGo(); // does nothing
}

TEST(GripBadInput, GeometryIsRefusedToTheButtonOnce)
{
  Workbench bench;
  bench.Go(0.05, 0.05, 0.05);
  bench.Go(0.102, 0.05, 0.05);
  ASSERT_EQ(bench.Scene->GetTouchedSurface(), bench.WallId);
  EventCounter warnings(bench.Scene, vtkCommand::WarningEvent);
  for (int i = 0; i < 3; ++i)
  {
    bench.Device->SetButtons(1u << 2);
    bench.Scene->Step(1);
    bench.Device->SetButtons(0);
    bench.Scene->Step(1);
  }
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_TRUE(bench.Scene->GetTouching());
}

// The surface goes away, or the hand: it is let go of, reported once, and nothing moves any more.
TEST(GripBadInput, IsLetGoOfWhenSurfaceOrHandGo)
{
  using Trouble = std::function<void(Workbench&)>;
  const std::vector<std::pair<const char*, Trouble>> troubles{
    { "hidden", [](Workbench& b) { b.Part->VisibilityOff(); } },
    { "not pickable", [](Workbench& b) { b.Part->PickableOff(); } },
    { "removed", [](Workbench& b) { b.Scene->RemoveSurface(b.PartId); } },
    { "all removed", [](Workbench& b) { b.Scene->RemoveAllSurfaces(); } },
    { "clutched", [](Workbench& b) { b.Scene->SetClutched(true); } },
    { "clutched by its button", [](Workbench& b) { b.Device->SetButtons(1u << 1); } },
    { "released", [](Workbench& b) { b.Scene->Release(); } },
    { "no device", [](Workbench& b) { b.Scene->SetDevice(nullptr); } },
    { "device lost", [](Workbench& b) { b.Device->Close(); } },
  };
  for (const auto& [name, trouble] : troubles)
  {
    Workbench bench;
    ASSERT_TRUE(bench.PressAndGrip());
    bench.Go(0.003, 0.005, 0.03, 2);
    EventCounter letGo(bench.Scene, vtkHapticScene::LetGoEvent);
    EventCounter servoErrors(bench.Scene->GetServo(), vtkCommand::ErrorEvent);
    EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
    trouble(bench);
    if (bench.Scene->GetDevice() && bench.Device->IsOpen())
    {
      bench.Scene->Step(2);
    }
    else
    {
      bench.Scene->GetServo()->Step(2); // the scene would open the device again
    }
    bench.Scene->Update();
    EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), -1) << name;
    EXPECT_EQ(letGo.Count, 1) << name;
    EXPECT_EQ(bench.Force(), 0.0) << name;
    const Point place = bench.Place(bench.Part);
    EXPECT_NEAR(place[2], 0.01, Clearance) << name << ": where the hand has left it";

    // And the scene goes on: shown, there and open again the part is touched from its front.
    bench.Device->SetButtons(0);
    bench.Scene->SetClutched(false);
    bench.Scene->SetDevice(bench.Device);
    bench.Part->VisibilityOn();
    bench.Part->PickableOn();
    bench.Scene->AddSurface(bench.Part);
    bench.Go(0.0, 0.0, 0.05, 2);
    bench.Scene->SetWorkspaceTransform(vtkNew<vtkMatrix4x4>());
    bench.Go(0.0, 0.0, 0.05, 2);
    bench.Go(0.003, 0.005, 0.028, 1);
    EXPECT_NEAR(bench.GodObject()[2], 0.03, Clearance) << name;
    EXPECT_EQ(Length(bench.Place(bench.Part) - place), 0.0) << name;
  }
}

TEST(GripBadInput, APartThatItsAssemblyDropsIsLetGoOf)
{
  LedHand hand;
  vtkNew<vtkAssembly> whole;
  vtkSmartPointer<vtkActor> cube = MakeCube();
  whole->AddPart(cube);
  whole->SetPosition(0.0, 0.01, -0.02); // under the hand at y = 0.02, and not with its edge
  hand.Scene->AddSurface(whole);
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  ASSERT_TRUE(hand.Scene->GetGrip()->Take());
  hand.MoveTo(0.01);
  hand.Scene->Update();
  EXPECT_NEAR(cube->GetPosition()[2], 0.01, Clearance);
  whole->RemovePart(cube);
  hand.MoveTo(0.03);
  EXPECT_EQ(hand.Scene->GetGrip()->GetSurface(), -1);
  EXPECT_NEAR(cube->GetPosition()[2], 0.01, Clearance);
}

// Other points, other cells, nothing at all: it is carried on, and the hand stays outside.
TEST(GripBadInput, AGeometryThatChangesMeanwhileIsTouchedWhenItIsLetGo)
{
  for (const bool before : { true, false }) // its end, or with it
  {
    Workbench bench;
    auto* mapper = vtkPolyDataMapper::SafeDownCast(bench.Part->GetMapper());
    ASSERT_TRUE(bench.PressAndGrip());
    bench.Go(0.003, 0.005, 0.048, 2);
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(0.03); // over the point that is gripped, at 0.02
    ball->SetThetaResolution(60);
    ball->SetPhiResolution(61);
    mapper->SetInputConnection(ball->GetOutputPort());
    if (before)
    {
      bench.Scene->Step(2);
      EXPECT_EQ(bench.Force(), 0.0);
    }
    EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), bench.PartId);
    bench.Scene->GetGrip()->LetGo();
    bench.Scene->Step(2);
    EXPECT_TRUE(bench.Scene->GetTouching());
    const Point p = bench.GodObject() - bench.Place(bench.Part);
    EXPECT_NEAR(Length(p), 0.03, 1e-4) << "it was swallowed, and is put outside";

    bench.Go(0.003, 0.005, 0.09);
    bench.Go(0.003, 0.005, 0.056);
    ASSERT_TRUE(bench.Scene->GetGrip()->Take());
    EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
    bench.Part->SetMapper(nullptr);
    bench.Go(0.003, 0.005, 0.08, 2);
    EXPECT_EQ(errors.Count, 1) << "the last good one stays";
    EXPECT_EQ(bench.Scene->GetGrip()->GetSurface(), bench.PartId);
    bench.Scene->GetGrip()->LetGo();
    bench.Go(0.003, 0.005, 0.079, 2);
  }
}

// A beating ball is carried about: other points at each update, the same cells.
TEST(GripBadInput, APartThatDeformsMeanwhileIsNeverEntered)
{
  Workbench bench;
  bench.Part->VisibilityOff();
  vtkNew<vtkSphereSource> source;
  source->SetRadius(0.02);
  source->SetThetaResolution(40);
  source->SetPhiResolution(41);
  source->Update();
  vtkNew<vtkPolyData> ball;
  ball->DeepCopy(source->GetOutput());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const int id = bench.Scene->AddSurface(actor);
  double radius = 0.02;
  double before = radius;
  int update = 0;
  const auto beat = [&]()
  {
    before = radius;
    radius = 0.02 + 0.004 * std::sin(0.5 * ++update);
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
    {
      double p[3];
      source->GetOutput()->GetPoint(i, p);
      points->InsertNextPoint(50.0 * radius * p[0], 50.0 * radius * p[1], 50.0 * radius * p[2]);
    }
    ball->SetPoints(points);
  };
  Point middle{};
  int gripped = 0;
  for (int round = 0; round < 12; ++round)
  {
    const double push = round % 3 == 0 ? 0.0 : 0.004; // into the ball while it is let go
    for (int i = 0; i < 10; ++i)
    {
      beat();
      bench.Go(middle[0], middle[1] + 0.001, middle[2] + (i < 4 ? 0.03 : 0.012), 16);
      middle = bench.Place(actor);
      ASSERT_GT(Length(bench.GodObject() - middle), 0.99 * std::min(before, radius)) << round;
    }
    ASSERT_EQ(bench.Scene->GetTouchedSurface(), id);
    ASSERT_TRUE(bench.Scene->GetGrip()->Take());
    for (int i = 1; i <= 6; ++i)
    {
      beat();
      const Point hip = bench.GodObject();
      bench.Go(hip[0] - 0.003, hip[1], hip[2] + (round % 2 ? 0.004 : -0.004) - push, 16);
      gripped += bench.Scene->GetGrip()->GetSurface() == id ? 1 : 0;
    }
    bench.Scene->GetGrip()->LetGo();
    middle = bench.Place(actor);
    for (int i = 0; i < 16; ++i)
    {
      bench.Scene->Step(1);
      ASSERT_GT(Length(bench.GodObject() - middle), 0.99 * std::min(before, radius)) << round;
      ASSERT_FALSE(bench.Scene->GetServo()->GetReadings()->GetSqueezed());
    }
  }
  EXPECT_EQ(gripped, 72);
}

TEST(GripBadInput, AMatrixThatIsNoGoodMeanwhileMovesNothing)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkMatrix4x4> flat;
  flat->SetElement(0, 0, 0.0);
  vtkNew<vtkMatrix4x4> nowhere;
  nowhere->SetElement(1, 3, NaN);
  const std::vector<std::function<void(vtkActor*)>> troubles{ [&](vtkActor* a)
    { a->SetUserMatrix(flat); },
    [&](vtkActor* a) { a->SetUserMatrix(nowhere); }, [](vtkActor* a) { a->SetScale(0.0); },
    [](vtkActor* a) { a->SetScale(1.0, NaN, 1.0); } };
  for (std::size_t i = 0; i < troubles.size(); ++i)
  {
    Workbench bench;
    ASSERT_TRUE(bench.PressAndGrip());
    bench.Go(0.003, 0.005, 0.03, 2);
    const Point place = bench.Place(bench.Part);
    troubles[i](bench.Part);
    EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
    bench.Go(0.003, 0.005, 0.05, 5);
    bench.Go(0.003, 0.005, 0.06, 5);
    EXPECT_EQ(errors.Count, 1) << i;
    EXPECT_EQ(Length(bench.Place(bench.Part) - place), 0.0) << i;
    bench.Part->SetUserMatrix(nullptr);
    bench.Part->SetScale(1.0);
    bench.Scene->Update();
    EXPECT_NEAR(bench.Place(bench.Part)[2], 0.04, Clearance) << i << ": it comes to the hand again";
    bench.Scene->GetGrip()->LetGo();
    bench.Go(0.003, 0.005, 0.059);
    EXPECT_NEAR(bench.GodObject()[2], 0.06, Clearance);
  }
}

// The workspace is scaled about the hand and reset under it: the part goes with the hand.
TEST(GripBadInput, TheWorkspaceMayChangeMeanwhile)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Go(0.003, 0.005, 0.04, 2);
  ASSERT_TRUE(bench.Scene->ScaleWorkspace(2.0));
  bench.Scene->Step(2);
  bench.Go(0.003, 0.005, 0.045, 2);
  bench.Scene->Update();
  EXPECT_NEAR(bench.Place(bench.Part)[2], 0.05 - 0.02, 1e-6);
  EventCounter errors(bench.Scene, vtkCommand::ErrorEvent);
  vtkNew<vtkMatrix4x4> far;
  far->SetElement(0, 3, 3.0);
  bench.Scene->SetWorkspaceTransform(far);
  bench.Scene->Step(2);
  EXPECT_NEAR(bench.Place(bench.Part)[0], 3.0, 1e-6);
  bench.Scene->SetWorkspaceTransform(vtkNew<vtkMatrix4x4>());
  bench.Scene->Step(2);
  EXPECT_EQ(errors.Count, 0) << "too fast for a surface, not for the hand that has it";
  bench.Scene->GetGrip()->LetGo();
  bench.Scene->Step(2);
  EXPECT_NEAR(bench.Place(bench.Part)[2], 0.045 - 0.02, 1e-6);
  bench.Go(0.003, 0.005, 0.044);
  EXPECT_NEAR(bench.GodObject()[2], 0.045, Clearance);
}

// The clutch takes the hand back to what it has let go of, from outside.
TEST(GripBadInput, TheClutchTakesTheHandBackToThePart)
{
  Workbench bench;
  ASSERT_TRUE(bench.PressAndGrip());
  bench.Go(0.003, 0.005, 0.04, 2);
  bench.Scene->SetClutched(true);
  bench.Go(0.01, -0.01, 0.0, 20);
  bench.Scene->SetClutched(false);
  bench.Scene->Step(2);
  EXPECT_NEAR(bench.GodObject()[2], 0.04, Clearance);
  bench.Go(0.01, -0.01, -0.003, 2);
  EXPECT_NEAR(bench.GodObject()[2], 0.04, Clearance);
  EXPECT_EQ(bench.Scene->GetTouchedSurface(), bench.PartId);
}
