// A scene whose surface comes in patches.
#include "../Filters/InPieces.h"
#include "SceneTestTools.h"
#include "TraceComparison.h"
#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Filters/SurfaceCleaner.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticPatchAlgorithm.h"
#include "vtkHapticPatchSource.h"
#include "vtkHapticReadings.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <iostream>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using haptics::testing::LargestDifference;
using haptics::testing::LargestDistance;
using haptics::testing::LargestForceStep;

namespace
{
/// Strokes over a ball of 50 mm at 0.2 m/s, 3 mm deep; the trace.
vtkSmartPointer<vtkPolyData> Stroke(vtkHapticScene* scene, std::string* limits = nullptr)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  device->SetPosition(0.0, 0.0, 0.06);
  scene->Step(50);
  scene->StartRecording();
  for (int i = 0; i < 200; ++i)
  {
    const double angle = 0.016 * i / 0.05 * 0.2;
    const double radius = i < 50 ? 0.06 - 0.013 * i / 50.0 : 0.047;
    device->SetPosition(radius * std::sin(angle), 0.0, radius * std::cos(angle));
    scene->Step(16);
    if (limits)
    {
      *limits += scene->GetServo()->GetReadings()->DescribeForceLimits();
    }
  }
  scene->StopRecording();
  auto trace = vtkSmartPointer<vtkPolyData>::New();
  trace->DeepCopy(scene->GetTrace());
  return trace;
}
}

TEST(PatchScene, IsTouchedAsTheWholeSurface)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  ball->SetThetaResolution(160);
  ball->SetPhiResolution(160);
  ball->SetGenerateNormals(false);
  vtkNew<vtkHapticScene> whole;
  whole->AddSurface(ball->GetOutputPort());
  const auto expected = Stroke(whole);

  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(ball->GetOutputPort());
  source->SetPatchRadius(0.01);
  vtkNew<vtkHapticScene> scene;
  const int id = scene->AddSurface(source->GetOutputPort());
  std::string limits;
  const auto found = Stroke(scene, &limits);
  EXPECT_EQ(id, 0);
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
  EXPECT_EQ(limits.find("waiting for data"), std::string::npos);
  // A patch, and not all of it: 51,000 triangles.
  EXPECT_LT(source->GetOutput()->GetNumberOfPolys(), 10000);
  EXPECT_GT(source->GetOutput()->GetNumberOfPolys(), 100);

  ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
  EXPECT_LT(LargestDistance(found, expected), 1e-12);
  vtkDataArray* const constraints = found->GetPointData()->GetArray("ActiveConstraints");
  int touching = 0;
  for (vtkIdType i = 0; i < constraints->GetNumberOfTuples(); ++i)
  {
    touching += constraints->GetComponent(i, 0) > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 2000);
  for (const char* const name : { "Force", "OriginalCellId", "BarycentricWeights" })
  {
    vtkDataArray* const array = found->GetPointData()->GetArray(name);
    EXPECT_LT(LargestDifference(array, expected->GetPointData()->GetArray(name)), 1e-9) << name;
  }
}

/// Cells with sides of their own keep them in a patch: what is Automatic is what the whole is.
TEST(PatchScene, CellsHaveTheirOwnSides)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  ball->SetThetaResolution(80);
  ball->SetPhiResolution(80);
  ball->Update();
  vtkNew<vtkPolyData> sided;
  sided->ShallowCopy(ball->GetOutput());
  vtkNew<vtkIntArray> sides;
  sides->SetName("side");
  for (vtkIdType i = 0; i < sided->GetNumberOfCells(); ++i)
  {
    double bounds[6];
    sided->GetCellBounds(i, bounds);
    // Both above, Automatic below: Front, as the whole is closed, which a patch is not.
    sides->InsertNextValue(bounds[4] > 0.0 ? 1 : 2);
  }
  sided->GetCellData()->AddArray(sides);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(sided);

  for (const bool isInPatches : { false, true })
  {
    SCOPED_TRACE(isInPatches ? "in patches" : "whole");
    vtkNew<vtkHapticPatchSource> source;
    source->SetSurfaceConnection(producer->GetOutputPort());
    source->SetPatchRadius(0.01);
    vtkNew<vtkHapticScene> scene;
    const int id =
      scene->AddSurface(isInPatches ? source->GetOutputPort() : producer->GetOutputPort());
    scene->GetSurfaceFilter(id)->SetInputArrayToProcess(
      vtkGodObjectFilter::SIDE_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "side");
    vtkNew<vtkSimulatedHapticDevice> device;
    scene->SetDevice(device);
    const auto goFromInsideTo = [&](double height)
    {
      scene->Release();
      device->SetPosition(0.0, 0.0, 0.0);
      scene->Step(20);
      for (int i = 1; i <= 60; ++i)
      {
        device->SetPosition(0.001, 0.0, height * i / 60.0);
        scene->Step(10);
      }
      return scene->GetGodObject()[2];
    };
    EXPECT_NEAR(goFromInsideTo(0.06), 0.05, 2e-4) << "held from the inside";
    EXPECT_NEAR(goFromInsideTo(-0.06), -0.06, 1e-9) << "out through what has a front only";
    EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
  }
}

/// What the mouse points at may be far from the hand.
TEST(PatchScene, RaysMeetWhatIsNotInThePatch)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  ball->SetThetaResolution(100);
  ball->SetPhiResolution(100);
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(ball->GetOutputPort());
  source->SetPatchRadius(0.005);
  vtkNew<vtkHapticScene> whole;
  whole->AddSurface(ball->GetOutputPort());
  whole->Update();
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(source->GetOutputPort());
  scene->Update();
  int hits = 0;
  for (int i = 0; i < 300; ++i)
  {
    const double from[3] = { 0.06 * std::sin(0.1 * i), 0.05 * std::cos(0.07 * i), 1.0 };
    const double direction[3] = { 0.02 * std::cos(0.3 * i), 0.01, -2.0 };
    double expected[3] = { 0.0, 0.0, 0.0 };
    double found[3] = { 0.0, 0.0, 0.0 };
    const bool isHit = whole->IntersectRay(from, direction, expected);
    ASSERT_EQ(scene->IntersectRay(from, direction, found), isHit) << i;
    EXPECT_LT(vtkMath::Distance2BetweenPoints(found, expected), 1e-24) << i;
    hits += isHit ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(hits, 290);
  EXPECT_LT(source->GetNumberOfReads(), 10) << "it stays in memory";
}

/// Gives a ball in four pieces, a quarter each; says on which threads it was read, and waits there
/// for as long as it is closed.
class SlowPieces : public InPieces<vtkPolyDataAlgorithm>
{
public:
  static SlowPieces* New();
  vtkTypeMacro(SlowPieces, InPieces);

  static constexpr int NumberOfPieces = 4;
  const std::thread::id Owner = std::this_thread::get_id();
  std::atomic<int> ReadsByOwner{ 0 };
  std::atomic<int> ReadsByOthers{ 0 };
  /// Of all threads but the owner's.
  void Close(bool isClosed)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->IsClosed = isClosed;
    this->HasOpened.notify_all();
  }

protected:
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    if (std::this_thread::get_id() == this->Owner)
    {
      ++this->ReadsByOwner;
    }
    else
    {
      ++this->ReadsByOthers;
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->HasOpened.wait(lock, [this] { return !this->IsClosed; });
    }
    vtkNew<vtkSphereSource> quarter;
    quarter->SetRadius(0.05);
    quarter->SetThetaResolution(40);
    quarter->SetPhiResolution(160);
    quarter->SetGenerateNormals(false);
    quarter->SetStartTheta(90.0 * PieceOf(out));
    quarter->SetEndTheta(90.0 * (PieceOf(out) + 1));
    quarter->Update();
    vtkPolyData::GetData(out)->ShallowCopy(quarter->GetOutput());
    return 1;
  }

private:
  std::mutex Mutex;
  std::condition_variable HasOpened;
  bool IsClosed = false;
};
vtkStandardNewMacro(SlowPieces);

/// Adds patches of them to a scene, where both read and build in the background.
void AddInBackground(vtkHapticScene* scene, vtkHapticPatchSource* source, SlowPieces* pieces)
{
  source->SetSurfaceConnection(pieces->GetOutputPort());
  source->SetNumberOfPieces(SlowPieces::NumberOfPieces);
  source->SetPiecesInMemory(1);
  source->SetPatchRadius(0.005);
  source->ReadInBackgroundOn();
  scene->GetSurfaces()->BackgroundBuildingOn();
  scene->AddSurface(source->GetOutputPort());
}

/// The hand goes on, and so does who updates the scene, while a piece is read.
TEST(PatchScene, PiecesAreReadInTheBackground)
{
  vtkNew<SlowPieces> pieces;
  vtkNew<vtkHapticPatchSource> source;
  vtkNew<vtkHapticScene> scene;
  AddInBackground(scene, source, pieces);
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  const auto goTo = [&](double angle, double radius)
  {
    device->SetPosition(radius * std::cos(angle), radius * std::sin(angle), 0.01);
    scene->Step(16);
  };
  const auto isWaiting = [&]
  { return scene->GetServo()->GetReadings()->DescribeForceLimits() == "waiting for data"; };
  // Until all that is needed there has come.
  const auto settle = [&](double angle, double radius)
  {
    do
    {
      goTo(angle, radius);
      source->FinishReading();
    } while (isWaiting() || scene->GetSurfaces()->IsBuilding());
  };
  settle(0.3, 0.06);
  settle(0.3, 0.048);
  EXPECT_TRUE(scene->GetTouching());
  const int first = pieces->ReadsByOwner;
  EXPECT_GE(first, 2 * SlowPieces::NumberOfPieces) << "the survey, which waits";
  pieces->Close(true);
  // Around the ball, into pieces that nobody has read yet.
  int waits = 0;
  for (double angle = 0.3; angle < 2.0; angle += 0.01)
  {
    goTo(angle, 0.048);
    waits += isWaiting() ? 1 : 0;
  }
  EXPECT_TRUE(source->IsReading());
  EXPECT_GT(waits, 50) << "it is held where it is known";
  EXPECT_LT(scene->GetGodObject()[1], 0.045);
  pieces->Close(false);
  settle(2.0, 0.048);
  goTo(2.0, 0.048);
  EXPECT_TRUE(scene->GetTouching());
  EXPECT_NEAR(std::hypot(scene->GetGodObject()[0] - 0.05 * std::cos(2.0),
                scene->GetGodObject()[1] - 0.05 * std::sin(2.0)),
    0.0, 0.003)
    << "it has caught up";
  EXPECT_EQ(pieces->ReadsByOwner, first) << "none was read by who updates the scene";
  EXPECT_GT(pieces->ReadsByOthers, 0);
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
}

/// A wall pushes the hand along a ball to where no patch reaches yet: no lack of room.
TEST(PatchScene, WhatIsPushedBeyondThePatchWaitsForData)
{
  vtkNew<SlowPieces> pieces;
  vtkNew<vtkHapticPatchSource> source;
  vtkNew<vtkHapticScene> scene;
  AddInBackground(scene, source, pieces);
  vtkNew<vtkPlaneSource> plane; // through the ball's axis
  plane->SetOrigin(0.03, 0.0, -0.03);
  plane->SetPoint1(0.09, 0.0, -0.03);
  plane->SetPoint2(0.03, 0.0, 0.03);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> wall;
  wall->SetMapper(mapper);
  scene->AddSurface(wall);
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  vtkHapticReadings* const readings = scene->GetServo()->GetReadings();
  const auto look = [&](double wallsAngle)
  {
    wall->SetOrientation(0.0, 0.0, vtkMath::DegreesFromRadians(wallsAngle));
    scene->Step(16);
    EXPECT_FALSE(readings->GetSqueezed()) << wallsAngle;
    return readings->DescribeForceLimits() == "waiting for data";
  };
  constexpr double HandsAngle = 1.35; // in the first quarter
  device->SetPosition(0.06 * std::cos(HandsAngle), 0.06 * std::sin(HandsAngle), 0.01);
  do
  {
    look(HandsAngle - 0.1);
    source->FinishReading();
  } while (scene->GetSurfaces()->IsBuilding() || look(HandsAngle - 0.1));
  pieces->Close(true);
  EventCounter squeezes(scene, vtkHapticScene::SqueezeEvent);
  double angle = HandsAngle - 0.1;
  for (; angle < HandsAngle + 0.5; angle += 0.02)
  {
    look(angle);
  }
  ASSERT_TRUE(source->IsReading());
  EXPECT_TRUE(look(angle));
  EXPECT_EQ(scene->GetForce()[1], 0.0);
  pieces->Close(false);
  int looks = 0;
  while (look(angle) || scene->GetSurfaces()->IsBuilding())
  {
    source->FinishReading();
    ASSERT_LT(++looks, 100) << "it asks for what is there";
  }
  look(angle);
  EXPECT_TRUE(scene->GetTouching());
  const double along = 0.06 * std::cos(angle - HandsAngle); // where the wall is nearest to the hand
  EXPECT_NEAR(scene->GetGodObject()[0], along * std::cos(angle), 1e-6);
  EXPECT_NEAR(scene->GetGodObject()[1], along * std::sin(angle), 1e-6);
  EXPECT_EQ(squeezes.Count, 0);
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
}

/// Where the ball below jumps [m].
constexpr std::array<double, 10> Ways{ 0.003, 0.01, 0.0, 0.03, 0.06, -0.02, 0.0, 0.09, 0.0, 0.045 };

/// Steps a scene over a ball that jumps far, to where the hand is inside of it, and back, as an
/// animation does that is scrubbed; where the god-object is after each.
std::vector<std::array<double, 3>> Scrub(
  vtkAlgorithm* surface, const std::function<void(double)>& move, vtkActor* actor = nullptr)
{
  vtkNew<vtkHapticScene> scene;
  if (actor)
  {
    actor->GetMapper()->SetInputConnection(surface->GetOutputPort());
    scene->AddSurface(actor);
  }
  else
  {
    scene->AddSurface(surface->GetOutputPort());
  }
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  move(0.0);
  device->SetPosition(0.0, 0.001, 0.055); // free, near what is touched
  scene->Step(100);
  std::vector<std::array<double, 3>> places;
  for (const double way : Ways)
  {
    move(way);
    for (int look = 0; look < 10; ++look)
    {
      scene->Step(16);
    }
    std::array<double, 3> place;
    scene->GetGodObject(place.data());
    places.push_back(place);
  }
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
  return places;
}

/// A surface that has gone past the god-object in one step has it where whole delivery has it.
TEST(PatchScene, AFarJumpInTimeLeavesNobodyInside)
{
  for (const bool hasActor : { false, true })
  {
    SCOPED_TRACE(hasActor ? "with an actor's matrix" : "geometry");
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(0.05);
    ball->SetThetaResolution(120);
    ball->SetPhiResolution(120);
    ball->SetGenerateNormals(false);
    // Along no symmetry, so that there is one nearest place.
    const auto move = [&](double way) { ball->SetCenter(0.13 * way, 0.07 * way, way); };
    vtkNew<vtkHapticPatchSource> source;
    source->SetSurfaceConnection(ball->GetOutputPort());
    source->SetPatchRadius(0.005);
    vtkNew<vtkActor> whole;
    vtkNew<vtkActor> inPatches;
    for (vtkActor* const actor : { whole.Get(), inPatches.Get() })
    {
      vtkNew<vtkPolyDataMapper> mapper;
      actor->SetMapper(mapper);
      actor->RotateX(20.0);
      actor->RotateZ(50.0);
      actor->SetScale(hasActor ? 0.98 : 1.0);
    }
    const auto expected = Scrub(ball, move, hasActor ? whole.Get() : nullptr);
    const auto found = Scrub(source, move, hasActor ? inPatches.Get() : nullptr);
    vtkNew<vtkTransform> place;
    place->SetMatrix(hasActor ? whole->GetMatrix() : place->GetMatrix());
    const double radius = hasActor ? 0.98 * 0.05 : 0.05;
    for (std::size_t i = 0; i < Ways.size(); ++i)
    {
      SCOPED_TRACE(i);
      move(Ways[i]);
      double centre[3];
      place->TransformPoint(ball->GetCenter(), centre);
      const auto heightOf = [&](const std::array<double, 3>& p)
      { return std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), centre)) - radius; };
      EXPECT_GT(heightOf(found[i]), -2e-5) << "it is outside, to within the chords of facets";
      EXPECT_NEAR(heightOf(found[i]), heightOf(expected[i]), 2e-5);
      // Over facets the way decides where a hand that presses 20 mm deep comes to rest, and this
      // one waited for the data on its way.
      const double off =
        std::sqrt(vtkMath::Distance2BetweenPoints(expected[i].data(), found[i].data()));
      EXPECT_LT(off, Ways[i] < 0.02 ? 2e-4 : 3e-3);
    }
  }
}

namespace
{
/// A ball that breathes: the same cells in each shape.
vtkSmartPointer<vtkPolyData> MakeBall(double radius)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(120);
  ball->SetPhiResolution(120);
  ball->SetRadius(1.0);
  ball->SetGenerateNormals(false);
  ball->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  ball->Update();
  auto scaled = vtkSmartPointer<vtkPolyData>::New();
  scaled->DeepCopy(ball->GetOutput());
  for (vtkIdType i = 0; i < scaled->GetNumberOfPoints(); ++i)
  {
    double p[3];
    scaled->GetPoint(i, p);
    scaled->GetPoints()->SetPoint(i, radius * p[0], radius * p[1], radius * p[2]);
  }
  return scaled;
}

/// Gives it in patches, as the ranks of a server do.
class BreathingPatches : public vtkHapticPatchAlgorithm
{
public:
  static BreathingPatches* New();
  vtkTypeMacro(BreathingPatches, vtkHapticPatchAlgorithm);

  bool SaysWhereFrom = true; ///< and not, as where the cells are others
  /// What the next so many crops find in its place, one after another: as where the ranks of a
  /// server have gone on since they were asked what there is.
  std::vector<vtkSmartPointer<vtkPolyData>> Overtaking;
  void SetShape(vtkPolyData* shape)
  {
    this->Shape = shape;
    this->IsSurveyed = false;
    this->Modified();
  }
  bool Survey() override
  {
    if (std::exchange(this->IsSurveyed, true))
    {
      return true;
    }
    std::string error;
    haptics::PartBox box;
    EXPECT_TRUE(haptics::MeasureUsedPoints(this->Shape, box.Low, box.High, error)) << error;
    const haptics::CleaningFrame frame = haptics::FrameOf(box);
    haptics::CleaningOptions options;
    options.Frame = &frame;
    haptics::CleanedMesh cleaned;
    haptics::CleanSurface(this->Shape, options, {}, cleaned, error);
    haptics::SurfaceCensus census;
    census.Add(cleaned, frame, {});
    haptics::PatchRecord record = census.Finish(box);
    this->Starts = this->SaysWhereFrom ? this->TouchedPoints : nullptr;
    record.Whole.Before = this->Starts ? this->TouchedVersion : 0;
    for (vtkIdType i = 0; this->Starts && i < this->Starts->GetNumberOfPoints(); ++i)
    {
      double way = std::sqrt(
        vtkMath::Distance2BetweenPoints(this->Starts->GetPoint(i), this->Shape->GetPoint(i)));
      record.Whole.LongestWay = std::max(record.Whole.LongestWay, way);
    }
    this->SetWhole(record, box, this->Shape);
    return true;
  }

protected:
  bool Crop(const haptics::PatchRegion& region, Use use,
    std::vector<vtkSmartPointer<vtkPolyData>>& parts) override
  {
    if (!this->Overtaking.empty())
    {
      this->Shape = this->Overtaking.front();
      this->Overtaking.erase(this->Overtaking.begin());
      this->IsSurveyed = false;
      this->Survey();
    }
    parts = { haptics::CropPart(this->Shape, region, {}, nullptr, this->Starts) };
    if (use == Use::Touch)
    {
      this->TouchedVersion = this->GetVersion();
      this->TouchedPoints = this->Shape->GetPoints();
    }
    return true;
  }
  bool CropNearest(
    const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts) override
  {
    double distance = HUGE_VAL;
    parts = { haptics::CropNearest(this->Shape, place, distance) };
    return true;
  }

private:
  vtkSmartPointer<vtkPolyData> Shape;
  vtkSmartPointer<vtkPoints> Starts;
  vtkSmartPointer<vtkPoints> TouchedPoints;
  vtkTypeUInt64 TouchedVersion = 0;
  bool IsSurveyed = false;
};
vtkStandardNewMacro(BreathingPatches);

/// A hand goes round on the ball, 3 mm deep, while that breathes, a shape every 33 ms.
vtkSmartPointer<vtkPolyData> StrokeWhileItBreathes(
  vtkAlgorithmOutput* surface, const std::function<void(vtkPolyData*)>& show)
{
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(surface);
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  scene->StartRecording();
  for (int i = 0; i < 60; ++i)
  {
    show(MakeBall(0.05 + 0.0025 * std::sin(0.9 * std::max(0, i - 20))));
    for (int look = 0; look < 3; ++look)
    {
      const double angle = 0.04 * (i + look / 3.0);
      const double radius = std::max(0.047, 0.06 - 0.002 * i);
      device->SetPosition(
        radius * std::cos(angle), radius * std::sin(angle), 0.1 * radius * std::sin(0.3 * i));
      scene->Step(11);
    }
  }
  scene->StopRecording();
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
  auto trace = vtkSmartPointer<vtkPolyData>::New();
  trace->DeepCopy(scene->GetTrace());
  return trace;
}
}

/// Patches of a surface that deforms do so as the whole does: no force steps where one follows
/// another, and the god-object is where it is on the whole.
TEST(PatchScene, DeformsAsTheWholeSurface)
{
  vtkNew<vtkTrivialProducer> whole;
  whole->SetOutput(MakeBall(0.05));
  const auto expected = StrokeWhileItBreathes(
    whole->GetOutputPort(), [&](vtkPolyData* shape) { whole->SetOutput(shape); });
  vtkNew<BreathingPatches> patches;
  patches->SetPatchRadius(0.01);
  const auto found = StrokeWhileItBreathes(
    patches->GetOutputPort(), [&](vtkPolyData* shape) { patches->SetShape(shape); });
  EXPECT_LT(patches->GetOutput()->GetNumberOfPolys(), 6000) << "of 28,560";

  constexpr vtkIdType IsDown = 700; // so many ticks later the hand is
  const double wholeStep = LargestForceStep(expected, IsDown);
  const double patchStep = LargestForceStep(found, IsDown);
  EXPECT_GT(wholeStep, 0.0);
  EXPECT_LT(patchStep, 1.1 * wholeStep);
  std::cout << "largest steps [N]: whole " << wholeStep << ", in patches " << patchStep
            << ", largest distance " << LargestDistance(found, expected) << "\n";
  EXPECT_LT(LargestDistance(found, expected), 1e-9);
}

/// A patch is of one version, with what belongs to the whole of that; until there is one the last
/// one stays, and it is asked for again, also where the hand rests.
TEST(PatchScene, AVersionMayOvertakeTheQuestionForAPatch)
{
  for (const std::size_t versions : { 1U, 2U, 3U, 9U })
  {
    vtkNew<BreathingPatches> patches;
    patches->SaysWhereFrom = false;
    patches->SetPatchRadius(0.01);
    patches->SetShape(MakeBall(0.05));
    vtkNew<vtkHapticScene> scene;
    scene->AddSurface(patches->GetOutputPort());
    vtkNew<vtkSimulatedHapticDevice> device;
    scene->SetDevice(device);
    device->SetPosition(0.055, 0.0, 0.001);
    scene->Step(100);
    device->SetPosition(0.048, 0.0, 0.001);
    scene->Step(200);
    ASSERT_TRUE(scene->GetTouching());
    patches->SetShape(MakeBall(0.0502));
    double radius = 0.0502;
    for (std::size_t i = 0; i < versions; ++i)
    {
      radius += 0.0001;
      patches->Overtaking.push_back(MakeBall(radius));
    }
    for (int look = 0; look < 500; ++look)
    {
      scene->Step(16);
      ASSERT_EQ(std::string(scene->GetErrorMessage()), "") << versions << ", look " << look;
      ASSERT_TRUE(scene->GetTouching()) << versions << ", look " << look;
    }
    EXPECT_TRUE(patches->Overtaking.empty()) << versions;
    EXPECT_NEAR(scene->GetGodObject()[0], radius, 4e-5) << versions << ": the facets are chords";
  }
}

TEST(PatchScene, SaysThatItWaitsForData)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  ball->SetThetaResolution(200);
  ball->SetPhiResolution(200);
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(ball->GetOutputPort());
  source->SetPatchRadius(0.005);
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(source->GetOutputPort());
  vtkNew<vtkSimulatedHapticDevice> device;
  scene->SetDevice(device);
  device->SetPosition(0.0, 0.0, 0.055);
  scene->Step(20);
  scene->Step(20);
  // So far at once that no patch can have been there.
  device->SetPosition(0.0, 0.1, 0.055);
  scene->Step(1);
  EXPECT_EQ(scene->GetServo()->GetReadings()->DescribeForceLimits(), "waiting for data");
  EXPECT_EQ(scene->GetForce()[2], 0.0);
  scene->Step(400);
  EXPECT_EQ(scene->GetServo()->GetReadings()->DescribeForceLimits(), "");
  EXPECT_NEAR(scene->GetGodObject()[1], 0.1, 1e-6) << "and goes on when they are there";
}

TEST(PatchScene, SaysWhyPiecesCannotBeTouched)
{
  vtkNew<vtkHapticPatchSource> source; // of nothing
  vtkNew<vtkHapticScene> scene;
  scene->AddSurface(source->GetOutputPort());
  source->GlobalWarningDisplayOff();
  scene->Update();
  source->GlobalWarningDisplayOn();
  EXPECT_NE(
    std::string(scene->GetErrorMessage()).find("vtkHapticPatchSource reports"), std::string::npos)
    << scene->GetErrorMessage();
}

/// A source that waits, as for a server, may let a timer's event in, which updates the scene.
TEST(PatchScene, AnUpdateWithinAnUpdateDoesNothing)
{
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkHapticScene> scene;
  const int id = scene->AddSurface(ball->GetOutputPort());
  int calls = 0;
  vtkNew<vtkCallbackCommand> timer;
  std::function<void()> update = [&]
  {
    ++calls;
    EXPECT_FALSE(scene->Update()) << "it has begun";
  };
  timer->SetClientData(&update);
  timer->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { (*static_cast<std::function<void()>*>(data))(); });
  ball->AddObserver(vtkCommand::StartEvent, timer);
  EXPECT_TRUE(scene->Update());
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(scene->GetSurfaces()->IsTouchable(id));
  EXPECT_EQ(std::string(scene->GetErrorMessage()), "");
}
