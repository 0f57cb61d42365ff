// What happens to a scene while a hand presses on it: no crash, no stale force, a message that says
// what is wrong.
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataGeometryFilter.h"
#include "vtkGeometryFilter.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProbe.h"
#include "vtkHapticSurfaces.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace
{
/// A hand that presses 5 mm into a table, and what its device is asked for.
struct PressingHand : LedHand
{
  vtkSmartPointer<vtkPolyData> Table = MakeTable(0.0);
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;

  PressingHand()
  {
    this->Mapper->SetInputData(this->Table);
    this->Actor->SetMapper(this->Mapper);
    this->Scene->AddSurface(this->Actor);
    this->MoveTo(0.01);
    this->MoveTo(-0.005);
    EXPECT_TRUE(this->Scene->GetTouching());
  }
  /// The next tick's, as the scene reports it and as the device got it [N].
  double NextForce()
  {
    this->Scene->Step(1);
    double asked[3];
    this->Device->GetForce(asked);
    EXPECT_EQ(asked[2], this->Scene->GetForce()[2]);
    return asked[2];
  }
};

constexpr double Pressed = 500.0 * 0.005; // [N]
constexpr double Near = 500.0 * 2.0 * Clearance;

vtkSmartPointer<vtkPolyData> MakeTriangle(const double corners[3][3])
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(3);
  for (int i = 0; i < 3; ++i)
  {
    cells->InsertCellPoint(points->InsertNextPoint(corners[i]));
  }
  auto triangle = vtkSmartPointer<vtkPolyData>::New();
  triangle->SetPoints(points);
  triangle->SetPolys(cells);
  return triangle;
}
}

TEST(HapticSceneBadInput, ASurfaceTakenAwayWhileTouchedHoldsNoMore)
{
  const std::function<void(PressingHand&)> ways[] = {
    [](PressingHand& hand) { hand.Scene->RemoveSurface(hand.Actor); },
    [](PressingHand& hand) { hand.Scene->RemoveAllSurfaces(); },
    [](PressingHand& hand) { hand.Actor->VisibilityOff(); },
    [](PressingHand& hand) { hand.Actor->PickableOff(); },
    [](PressingHand& hand) { hand.Actor->SetPosition(1.0, 0.0, 0.0); },
    [](PressingHand& hand) { hand.Mapper->SetInputData(MakeTable(-1.0)); },
  };
  for (const auto& way : ways)
  {
    PressingHand hand;
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    EventCounter ends(hand.Scene, vtkHapticScene::ContactEndEvent);
    way(hand);
    const auto index = &way - ways;
    EXPECT_EQ(hand.NextForce(), 0.0) << "way " << index;
    EXPECT_FALSE(hand.Scene->GetTouching()) << "way " << index;
    EXPECT_EQ(hand.Scene->GetProbe()->GetSurface(), -1) << "way " << index;
    EXPECT_EQ(ends.Count, 1) << "way " << index;
    EXPECT_EQ(errors.Count, index >= 4 ? 1 : 0)
      << "only a metre in a tick is reported; way " << index;
  }
}

TEST(HapticSceneBadInput, TheFilterThatIsAdvisedMakesOtherDataTouchable)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, sphere->GetOutput());
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  vtkNew<vtkCompositeDataGeometryFilter> ofBlocks;
  vtkNew<vtkGeometryFilter> ofImage;
  const struct
  {
    vtkDataObject* Data;
    vtkPolyDataAlgorithm* Remedy;
  } kinds[] = { { blocks, ofBlocks }, { image, ofImage } };
  for (const auto& kind : kinds)
  {
    vtkNew<vtkTrivialProducer> source;
    source->SetOutput(kind.Data);
    vtkNew<vtkHapticScene> scene;
    EventCounter errors(scene, vtkCommand::ErrorEvent);
    scene->AddSurface(source->GetOutputPort());
    scene->Update();
    EXPECT_EQ(errors.Count, 1);
    const std::string advice = std::string("put a ") + kind.Remedy->GetClassName() + " before it";
    EXPECT_NE(std::string(scene->GetErrorMessage()).find(advice), std::string::npos)
      << scene->GetErrorMessage();

    kind.Remedy->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkHapticScene> advised;
    EventCounter none(advised, vtkCommand::ErrorEvent);
    advised->AddSurface(kind.Remedy->GetOutputPort());
    advised->Update();
    EXPECT_EQ(none.Count, 0);
    EXPECT_STREQ(advised->GetErrorMessage(), "");
  }
}

TEST(HapticSceneBadInput, ASurfaceSpoiltWhileTouchedStaysAsItWasAndSaysWhy)
{
  struct Way
  {
    const char* Message;
    std::function<void(PressingHand&)> Spoil;
  };
  const Way ways[] = {
    { "mapper", [](PressingHand& hand) { hand.Actor->SetMapper(nullptr); } },
    { "no input", [](PressingHand& hand) { hand.Mapper->RemoveAllInputs(); } },
    { "no polygon",
      [](PressingHand& hand)
      {
        hand.Table->SetLines(hand.Table->GetPolys());
        hand.Table->SetPolys(nullptr);
      } },
    { "flattens", [](PressingHand& hand) { hand.Actor->SetScale(1.0, 1.0, 0.0); } },
    { "flattens", [](PressingHand& hand) { hand.Actor->SetScale(0.0); } },
    { "not finite", [](PressingHand& hand) { hand.Actor->SetPosition(0.0, std::nan(""), 0.0); } },
    { "finite",
      [](PressingHand& hand)
      {
        hand.Table->GetPoints()->SetPoint(0, 0.0, 0.0, std::nan(""));
        hand.Table->GetPoints()->Modified();
        hand.Table->Modified();
      } },
  };
  for (const Way& way : ways)
  {
    PressingHand hand;
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    EventCounter reports(hand.Scene, vtkHapticScene::SurfaceErrorEvent);
    way.Spoil(hand);
    const auto index = &way - ways;
    EXPECT_NEAR(hand.NextForce(), Pressed, Near) << "way " << index;
    hand.NextForce();
    EXPECT_EQ(reports.Count, 1) << "once, way " << index;
    EXPECT_EQ(errors.Count, 1) << "way " << index;
    const std::string message = hand.Scene->GetErrorMessage();
    EXPECT_NE(message.find("Surface 0: "), std::string::npos) << message;
    EXPECT_NE(message.find(way.Message), std::string::npos) << message;
    EXPECT_NE(message.find("stays in force"), std::string::npos) << message;
    hand.MoveTo(0.01);
    EXPECT_EQ(hand.Scene->GetForce()[2], 0.0) << "way " << index;
  }
}

TEST(HapticSceneBadInput, FlatAndSinglePointSurfacesAreErrorsAndNothingHolds)
{
  const double line[3][3] = { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } };
  const double point[3][3] = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };
  vtkNew<vtkPolyData> lone;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.01, 0.02, 0.0);
  lone->SetPoints(points);
  for (const vtkSmartPointer<vtkPolyData>& surface :
    { MakeTriangle(line), MakeTriangle(point), vtkSmartPointer<vtkPolyData>(lone) })
  {
    LedHand hand;
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    const int id = hand.Scene->AddSurface(surface);
    hand.MoveTo(0.01);
    hand.MoveTo(-0.005);
    hand.MoveTo(0.0);
    EXPECT_EQ(errors.Count, 1);
    EXPECT_NE(
      std::string(hand.Scene->GetErrorMessage()).find("It cannot be touched."), std::string::npos)
      << hand.Scene->GetErrorMessage();
    EXPECT_FALSE(hand.Scene->GetSurfaces()->IsTouchable(id));
    EXPECT_FALSE(hand.Scene->GetTouching());
    EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
    EXPECT_FALSE(hand.Scene->FitWorkspace()) << "there is nothing to fit";
  }
}

TEST(HapticSceneBadInput, AnObserverThatThrowsLeavesTheSceneWhole)
{
  LedHand hand;
  hand.Scene->AddSurface(MakeTable(0.0));
  vtkNew<vtkCallbackCommand> thrower;
  thrower->SetCallback([](vtkObject*, unsigned long, void*, void*)
    { throw std::runtime_error("the observer's own fault"); });
  hand.Scene->AddObserver(vtkHapticScene::ContactBeginEvent, thrower);
  hand.MoveTo(0.01);
  EXPECT_THROW(hand.MoveTo(-0.005), std::runtime_error);
  EXPECT_TRUE(hand.Scene->GetTouching());
  EXPECT_NEAR(hand.Scene->GetForce()[2], Pressed, Near);
  hand.MoveTo(0.01);
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
  EXPECT_THROW(hand.MoveTo(-0.005), std::runtime_error) << "events still come";
  hand.Scene->Release();
  double asked[3];
  hand.Device->GetForce(asked);
  EXPECT_EQ(asked[2], 0.0);
}

TEST(HapticSceneBadInput, OneDeviceServesOneSceneAtATime)
{
  LedHand first;
  vtkNew<vtkHapticScene> second;
  second->SetDevice(first.Device);
  ASSERT_TRUE(first.Scene->Engage());
  EventCounter errors(second->GetServo(), vtkCommand::ErrorEvent);
  EXPECT_FALSE(second->Engage());
  EXPECT_EQ(second->Step(1), 0);
  EXPECT_EQ(errors.Count, 2);
  EXPECT_NE(std::string(second->GetErrorMessage()).find("in use by another"), std::string::npos)
    << second->GetErrorMessage();
  EXPECT_TRUE(first.Scene->IsEngaged()) << "who has it keeps it";
  first.Scene->Release();
  EXPECT_TRUE(second->Engage());
  second->Release();
}

TEST(HapticSceneBadInput, ReleaseLetsGoOfAForceInVirtualTimeToo)
{
  PressingHand hand;
  hand.Scene->Release();
  double asked[3];
  hand.Device->GetForce(asked);
  EXPECT_EQ(asked[2], 0.0);
  EXPECT_EQ(hand.Scene->GetForce()[2], 0.0);
  EXPECT_FALSE(hand.Scene->GetTouching());
}

TEST(HapticSceneBadInput, AFilterMayOutliveItsSurfaceAndFail)
{
  vtkSmartPointer<vtkGodObjectFilter> filter;
  {
    LedHand hand;
    filter = hand.Scene->GetSurfaceFilter(hand.Scene->AddSurface(MakeTable(0.0)));
    hand.Scene->Step(1);
  }
  EXPECT_FALSE(filter->HasObserver(vtkCommand::ErrorEvent)) << "it would call who is gone";
  EventCounter errors(filter, vtkCommand::ErrorEvent);
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  vtkNew<vtkPolyData> withoutPolygons;
  withoutPolygons->SetPoints(points);
  filter->SetInputData(withoutPolygons);
  filter->Update();
  EXPECT_EQ(errors.Count, 1);
}

/// Each call fails with a message, does what that says, and succeeds with none.
TEST(HapticSceneBadInput, WhatAMessageAdvisesHelps)
{
  struct Advice
  {
    const char* Words;
    std::function<bool(vtkHapticScene*)> Call;
    std::function<void(LedHand&)> Follow;
  };
  const auto setScale = [](vtkHapticScene* scene, double x, double y)
  {
    vtkNew<vtkMatrix4x4> matrix;
    matrix->SetElement(0, 0, x);
    matrix->SetElement(1, 1, y);
    return scene->SetWorkspaceTransform(matrix);
  };
  int ticks = 0;
  double scale = 0.0;
  double mirror = -1.0;
  const Advice cases[] = {
    { "Give 1 or more ticks", [&](vtkHapticScene* scene) { return scene->Step(ticks) == 1; },
      [&](LedHand&) { ticks = 1; } },
    { "Call Release() first", [](vtkHapticScene* scene) { return scene->Step(1) == 1; },
      [](LedHand& hand) { hand.Scene->Release(); } },
    { "Call SetDevice() first", [](vtkHapticScene* scene) { return scene->Step(1) == 1; },
      [](LedHand& hand) { hand.Scene->SetDevice(hand.Device); } },
    { "no surface that can be touched. Add one",
      [](vtkHapticScene* scene) { return scene->FitWorkspace(); },
      [](LedHand& hand) { hand.Scene->AddSurface(MakeTable(0.0)); } },
    { "Touch a surface first", [](vtkHapticScene* scene) { return scene->DropLandmark() == 0; },
      [](LedHand& hand)
      {
        hand.Scene->AddSurface(MakeTable(0.0));
        hand.MoveTo(0.01);
        hand.MoveTo(-0.001);
      } },
    { "Give a finite factor > 0",
      [&](vtkHapticScene* scene) { return scene->ScaleWorkspace(scale); },
      [&](LedHand&) { scale = 2.0; } },
    { "The last one stays", [&](vtkHapticScene* scene) { return setScale(scene, mirror, 1.0); },
      [&](LedHand&) { mirror = 1.0; } },
  };
  for (const Advice& advice : cases)
  {
    const std::string words = advice.Words;
    LedHand hand;
    if (words == "Call Release() first")
    {
      ASSERT_TRUE(hand.EngagePatiently()) << hand.Scene->GetErrorMessage();
    }
    if (words == "Call SetDevice() first")
    {
      hand.Scene->SetDevice(nullptr);
    }
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    EXPECT_FALSE(advice.Call(hand.Scene)) << words;
    EXPECT_EQ(errors.Count, 1) << words;
    const std::string message = hand.Scene->GetErrorMessage();
    EXPECT_NE(message.find(words), std::string::npos) << words << " is not in: " << message;
    advice.Follow(hand);
    EXPECT_TRUE(advice.Call(hand.Scene)) << words << ": " << hand.Scene->GetErrorMessage();
    EXPECT_EQ(errors.Count, 1) << words;
    EXPECT_STREQ(hand.Scene->GetErrorMessage(), "") << words;
  }
}
