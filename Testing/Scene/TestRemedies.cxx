// What a message advises is done, and the fault is gone: the call that failed says nothing more.
#include "RemedyTestTools.h"
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkDoubleArray.h"
#include "vtkGodObjectActor.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticGrip.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProbe.h"
#include "vtkHapticProperties.h"
#include "vtkHapticSurfaces.h"
#include "vtkHapticTraceRecorder.h"
#include "vtkHapticWorkspace.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkRecordedHapticDevice.h"
#include "vtkSharedHapticDevice.h"
#include "vtkVolume.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <string>

namespace
{
vtkSmartPointer<vtkPolyData> MakePath(std::initializer_list<double> heights)
{
  vtkNew<vtkPoints> points;
  for (const double height : heights)
  {
    points->InsertNextPoint(0.01, 0.02, height);
  }
  auto path = vtkSmartPointer<vtkPolyData>::New();
  path->SetPoints(points);
  return path;
}

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
}

TEST(Remedies, OfTheSimulatedDevice)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  const auto open = [&]
  {
    device->Close();
    device->Open();
  };
  device->SetMotionToPolyline();
  const std::string none = "Call SetPath() with one before Open()";
  ExpectRemedy(device, none, open, [&] { device->SetPath(MakePath({ 0.0, 0.1 })); });
  device->SetMotionToSpline();
  device->SetPath(MakePath({ 0.1, 0.1 }));
  const std::string different = "Add points, or use Polyline";
  ExpectRemedy(device, different, open, [&] { device->SetPath(MakePath({ 0.1, 0.1, 0.2 })); });
  device->SetPath(MakePath({ 0.1, 0.1 }));
  ExpectRemedy(device, different, open, [&] { device->SetMotionToPolyline(); });
  const auto broken = MakePath({ 0.1, NotANumber, 0.2 });
  device->SetPath(broken);
  ExpectRemedy(device, "not finite. Remove or mend it", open,
    [&] { broken->GetPoints()->SetPoint(1, 0.0, 0.0, 0.15); });
  vtkNew<vtkDoubleArray> times;
  times->SetName("Time");
  times->InsertNextValue(0.0);
  const auto timed = MakePath({ 0.1, 0.2 });
  timed->GetPointData()->AddArray(times);
  device->SetPath(timed);
  ExpectRemedy(device, "It must have one for each", open, [&] { times->InsertNextValue(1.0); });
  device->SetSpeed(NotANumber);
  device->SetPath(MakePath({ 0.1, 0.2 }));
  device->SetMass(NotANumber);
  device->SetSpeed(0.1);
  ExpectRemedy(device, "is not a number. Set it, then open", open, [&] { device->SetMass(0.1); });
  int preset = 7;
  ExpectRemedy(
    device, "give Touch, Omni", [&] { device->SetPreset(preset); }, [&] { preset = device->Omni; });
  double x = NotANumber;
  ExpectRemedy(
    device, "not finite", [&] { device->SetPosition(x, 0.0, 0.0); }, [&] { x = 0.0; });
}

TEST(Remedies, OfTheSharedDevice)
{
  vtkNew<vtkSharedHapticDevice> device;
  vtkNew<vtkDoubleArray> values;
  ExpectRemedy(
    device, "are needed", [&] { device->SetSharedArray(values); },
    [&]
    {
      values->SetNumberOfValues(64);
      values->Fill(0.0);
    });
  device->Open();
  if (device->GetState() == vtkHapticDevice::Closed)
  {
    GTEST_SKIP() << device->GetErrorMessage();
  }
  ExpectRemedy(
    device, "Call Close() first", [&] { device->SetSharedArray(values); },
    [&] { device->Close(); });
}

TEST(Remedies, OfTheServo)
{
  vtkNew<vtkHapticServo> servo;
  vtkNew<vtkSimulatedHapticDevice> device;
  const auto step = [&] { servo->Step(1); };
  ExpectRemedy(servo, "Call SetDevice() first", step,
    [&]
    {
      device->Open();
      servo->SetDevice(device);
    });
  servo->Stop();
  device->Close();
  ExpectRemedy(servo, "Call its Open() first", step, [&] { device->Open(); });
  vtkNew<vtkHapticServo> other;
  other->SetDevice(device);
  const auto stepOther = [&] { other->Step(1); };
  ExpectRemedy(other, "Release that one first", stepOther, [&] { servo->Stop(); });
  other->Stop();
  servo->Step(1);
  vtkNew<vtkSimulatedHapticDevice> own;
  ExpectRemedy(other, "give each a device of its own", stepOther,
    [&]
    {
      own->Open();
      other->SetDevice(own);
    });
  servo->Stop();
  servo->SetStallLimit(60.0);
  servo->GetSafety()->LoosenMissedTickShare(60.0);
  servo->GetSafety()->LoosenWatchdogTime(1.0);
  ASSERT_TRUE(servo->Start());
  ExpectRemedy(servo, "Call Stop() before Step()", step, [&] { servo->Stop(); });
}

TEST(Remedies, OfSettings)
{
  LedHand hand;
  vtkHapticServo* const servo = hand.Scene->GetServo();
  vtkHapticSafety* const safety = servo->GetSafety();
  double value = NotANumber;
  const auto sane = [&] { value = 1.0; };
  const auto expect = [&](vtkObject* reporter, const std::string& words, double bad,
                        const std::function<void()>& call)
  {
    value = bad;
    ExpectRemedy(reporter, words, call, sane);
  };
  expect(servo, "must be a number", NotANumber, [&] { servo->SetRate(value * 1000.0); });
  expect(servo, "must be a number", NotANumber, [&] { servo->SetStallLimit(value); });
  expect(servo, "not below 0 N/m", -1.0, [&] { servo->SetStiffness(value); });
  expect(servo, "must not be below 0 N", -1.0, [&] { servo->SetMaximumForce(value); });
  expect(safety, "between 0 and", -1.0, [&] { safety->SetContactDamping(value); });
  bool loosen = false;
  ExpectRemedy(
    safety, "Call Loosen",
    [&] { loosen ? safety->LoosenSlewLimit(5e4) : safety->SetSlewLimit(5e4); },
    [&] { loosen = true; });
  vtkNew<vtkHapticProperties> properties;
  expect(properties, "has to be from", -1.0, [&] { properties->SetStaticFriction(value); });
  expect(properties, "has to be within", -1.0,
    [&] { properties->SetRange(vtkHapticProperties::STATIC_FRICTION, 0.0, value); });
  expect(properties, "they go from 0 to", 99.0,
    [&] { properties->SetConstant(static_cast<int>(value), 0.5); });
  expect(properties, "a depth above 0 m", -1.0,
    [&] { properties->SetForceProfileToButton(500.0, value, 0.5); });
  vtkNew<vtkHapticOverlay> overlay;
  expect(overlay, "Give its strength, finite and >= 0", -1.0, [&] { overlay->SetForce(value); });
  expect(overlay, "Give a finite force > 0", 0.0, [&] { overlay->SetMaximumForce(value); });
  vtkNew<vtkGodObjectActor> actor;
  expect(actor, "is not finite; the last one stays. Check where it comes from", NotANumber,
    [&] { actor->SetGodObject(value, 0.0, 0.0); });
  expect(actor, "Size has to be a number from", NotANumber, [&] { actor->SetSize(value); });
  actor->ShowTrailOn();
  expect(actor, "is not finite; it was left out", NotANumber,
    [&]
    {
      const double point[3] = { value, 0.0, 0.0 };
      actor->AddTrailPoint(point, true);
    });
  vtkHapticLandmarks* const marks = hand.Scene->GetLandmarks();
  expect(marks, "or 0 where it is not known", -1.0, [&] { marks->SetUnitLength(value); });
}

TEST(Remedies, OfGripsAndLandmarks)
{
  LedHand hand;
  vtkHapticGrip* const grip = hand.Scene->GetGrip();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const auto press = [&]
  {
    hand.MoveTo(0.01);
    hand.MoveTo(-0.001);
  };
  const int first = hand.Scene->AddSurface(MakeTable(0.0));
  vtkHapticLandmarks* const marks = hand.Scene->GetLandmarks();
  const auto drop = [&] { marks->Drop(hand.Scene->GetProbe()); };
  ExpectRemedy(marks, "Touch a surface first", drop, press);
  ExpectRemedy(
    grip, "Add it as a vtkActor", [&] { grip->Take(); },
    [&]
    {
      hand.MoveTo(0.01);
      hand.Scene->RemoveSurface(first);
      hand.Scene->AddSurface(actor);
      press();
    });
  grip->LetGo();
  drop();
  const int last = marks->GetNumberOfLandmarks() - 1;
  int from = 0;
  ExpectRemedy(
    marks, "Drop them anew", [&] { marks->GetGeodesicDistance(from, last); },
    [&]
    {
      drop();
      from = last + 1;
    });
  int number = 99;
  ExpectRemedy(
    marks, "counted from 0", [&] { marks->GetLabel(0), marks->SetLabel(number, "a"); },
    [&] { number = 0; });
  vtkNew<vtkPolyData> record;
  ExpectRemedy(
    marks, "Give what GetRecord() makes", [&] { marks->Add(record); },
    [&] { marks->GetRecord(0, record); });
  hand.MoveTo(0.01);
  ExpectRemedy(
    grip, "Touch a surface first", [&] { grip->Take(); }, press);
  grip->LetGo();
  actor->VisibilityOff();
  const int shown = hand.Scene->GetSurfaces()->GetId(0);
  ExpectRemedy(
    grip, "Show it first", [&] { grip->TakeSurface(shown); },
    [&]
    {
      actor->VisibilityOn();
      press();
    });
  vtkNew<vtkHapticGrip> loose;
  Messages none(loose);
  EXPECT_FALSE(loose->TakeSurface(shown));
  EXPECT_NE(none.Text.find("Use what vtkHapticScene::GetGrip() returns"), std::string::npos);
}

TEST(Remedies, OfTheScene)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticScene> scene;
  vtkNew<vtkMatrix4x4> identity;
  vtkSmartPointer<vtkPolyData> table;
  vtkMatrix4x4* matrix = nullptr;
  scene->AddSurface(MakeTable(0.0));
  vtkHapticWorkspace* const workspace = scene->GetWorkspace();
  const double bounds[6] = { -0.1, 0.1, -0.1, 0.1, 0.0, 0.0 };
  ExpectRemedy(
    workspace, "Call the scene's SetDevice() first", [&] { workspace->Fit(bounds, nullptr); },
    [&] { scene->SetDevice(device); });
  ExpectRemedy(
    scene, "no geometry to add as a surface. Give a vtkPolyData", [&] { scene->AddSurface(table); },
    [&] { table = MakeTable(-0.05); });
  ExpectRemedy(
    workspace, "no matrix to take", [&] { workspace->SetTransform(matrix); },
    [&] { matrix = identity; });
  vtkNew<vtkVolume> volume;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(-0.06));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProp3D* prop = volume;
  ExpectRemedy(
    scene, "Give a vtkActor or a vtkAssembly", [&] { scene->AddSurface(prop); },
    [&] { prop = actor; });
}

TEST(Remedies, OfTheTraceRecorder)
{
  LedHand hand;
  auto table = MakeTable(0.0);
  vtkNew<vtkDoubleArray> heat;
  heat->SetName("Heat");
  heat->SetNumberOfValues(4);
  heat->Fill(1.0);
  table->GetPointData()->AddArray(heat);
  hand.Scene->AddSurface(table);
  vtkHapticTraceRecorder* const recorder = hand.Scene->GetTraceRecorder();
  recorder->SetMaximumTicks(5);
  const auto record = [&]
  {
    recorder->SetRecording(true);
    for (int tick = 0; tick < 10; ++tick)
    {
      hand.MoveTo(tick < 2 ? 0.01 : -0.001);
    }
    recorder->SetRecording(false);
    hand.MoveTo(0.01);
  };
  ExpectRemedy(recorder, "Raise MaximumTicks", record, [&] { recorder->SetMaximumTicks(100); });
  recorder->AddSurfaceArray("heat");
  ExpectRemedy(recorder, "Check the name, and see what a probe lists", record,
    [&]
    {
      hand.MoveTo(-0.001);
      EXPECT_NE(std::string(hand.Scene->GetProbe()->GetText()).find("Heat"), std::string::npos);
      recorder->ClearSurfaceArrays();
      recorder->AddSurfaceArray("Heat");
    });
}

TEST(Remedies, OfFilters)
{
  vtkNew<vtkGodObjectFilter> filter;
  const auto update = [&]
  {
    filter->Modified();
    filter->Update();
  };
  filter->SetInputData(MakePath({ 0.0 }));
  ExpectRemedy(filter, "Give it a surface", update, [&] { filter->SetInputData(MakeTable(0.0)); });
  auto broken = MakeTable(0.0);
  broken->GetPoints()->SetPoint(2, NotANumber, 0.0, 0.0);
  filter->SetInputData(broken);
  ExpectRemedy(
    filter, "Remove the cells that", update, [&] { filter->SetInputData(MakeTable(0.0)); });

  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(1, MakeTable(0.0));
  vtkSmartPointer<vtkPolyData> path = MakePath({});
  const auto run = [&]
  {
    trace->SetInputData(0, path);
    trace->Update();
  };
  ExpectRemedy(trace, "Give it a vtkPolyData whose points", run,
    [&] {
      path = MakePath({ 0.01, -0.01 });
    });
  path = MakePath({ 0.01, NotANumber, -0.01 });
  ExpectRemedy(trace, "Remove it, or mend the source of port 0", run,
    [&] {
      path = MakePath({ 0.01, -0.01 });
    });
  vtkNew<vtkGodObjectTrace> table;
  table->SetInputData(0, path);
  table->SetInputData(1, MakeTable(0.0));
  ExpectRemedy(
    table, "Call Update() first", [&] { table->WriteCSV("TestRemedies.csv"); },
    [&] { table->Update(); });
  std::remove("TestRemedies.csv");
}

TEST(Remedies, OfRecordings)
{
  const std::string name = "TestRemedies.haptic";
  LedHand hand;
  vtkHapticServo* const servo = hand.Scene->GetServo();
  servo->SetRecordingFileName(name.c_str());
  hand.Scene->Step(20);
  hand.Scene->Release();
  servo->SetRecordingFileName("");
  vtkNew<vtkRecordedHapticDevice> recorded;
  recorded->SetFileName(name.c_str());
  vtkNew<vtkHapticServo> player;
  player->SetDevice(recorded);
  ASSERT_TRUE(recorded->Open()) << recorded->GetErrorMessage();
  player->SetRecordingFileName(name.c_str());
  ExpectRemedy(
    player, "Give another RecordingFileName, or an empty one", [&] { player->Step(1); },
    [&] { player->SetRecordingFileName(""); });
  player->Stop();
  std::remove(name.c_str());
}
