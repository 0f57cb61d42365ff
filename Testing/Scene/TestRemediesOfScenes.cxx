// What messages about surfaces, scenes and runs of a servo advise is done, and the fault is gone.
#include "../TemporaryFolder.h"
#include "RemedyTestTools.h"
#include "SceneTestTools.h"
#include "ScriptedDevice.h"

#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataGeometryFilter.h"
#include "vtkGeometryFilter.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticProbe.h"
#include "vtkHapticWorkspace.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkMatrix4x4.h"
#include "vtkMouseHapticDevice.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkRecordedHapticDevice.h"
#include "vtkSharedHapticDevice.h"
#include "vtkTable.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <csignal>
#include <filesystem>
#include <limits>
#include <memory>

namespace
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

vtkSmartPointer<vtkTrivialProducer> MakeSource(vtkDataObject* data)
{
  auto source = vtkSmartPointer<vtkTrivialProducer>::New();
  source->SetOutput(data);
  return source;
}

/// The table, `scale` times as large and this far away.
vtkSmartPointer<vtkPolyData> MakeScaledTable(double scale, double x, double y)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(x, y, 0.0);
  transform->Scale(scale, scale, scale);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetTransform(transform);
  filter->SetInputData(MakeTable(0.0));
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> MakePath()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.01, 0.02, 0.01);
  points->InsertNextPoint(0.01, 0.02, -0.001);
  auto path = vtkSmartPointer<vtkPolyData>::New();
  path->SetPoints(points);
  return path;
}

/// The hand goes down; whether it meets something.
bool Touches(LedHand& hand)
{
  hand.MoveTo(0.01);
  hand.MoveTo(-0.001);
  return hand.Scene->GetTouching();
}
}

TEST(Remedies, OfWhatIsNoSurfaceYet)
{
  LedHand hand;
  vtkHapticScene* const scene = hand.Scene;
  const auto update = [&] { scene->Update(); };
  int id = -1;
  const auto add = [&](vtkAlgorithmOutput* port)
  {
    scene->RemoveSurface(id);
    id = scene->AddSurface(port);
  };

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeTable(0.0));
  const auto multiblock = MakeSource(blocks);
  vtkNew<vtkCompositeDataGeometryFilter> ofBlocks;
  ofBlocks->SetInputConnection(multiblock->GetOutputPort());
  add(multiblock->GetOutputPort());
  ExpectRemedy(scene, "put a vtkCompositeDataGeometryFilter before it", update,
    [&] { add(ofBlocks->GetOutputPort()); });
  EXPECT_TRUE(Touches(hand));

  vtkNew<vtkAppendFilter> grid;
  grid->AddInputData(MakeTable(0.0));
  vtkNew<vtkGeometryFilter> ofGrid;
  ofGrid->SetInputConnection(grid->GetOutputPort());
  hand.MoveTo(0.01);
  add(grid->GetOutputPort());
  ExpectRemedy(
    scene, "put a vtkGeometryFilter before it", update, [&] { add(ofGrid->GetOutputPort()); });
  EXPECT_TRUE(Touches(hand));

  const auto table = MakeSource(vtkSmartPointer<vtkTable>::New());
  const auto surface = MakeSource(MakeTable(0.0));
  hand.MoveTo(0.01);
  add(table->GetOutputPort());
  ExpectRemedy(
    scene, "connect a source of a surface", update, [&] { add(surface->GetOutputPort()); });
  EXPECT_TRUE(Touches(hand));
}

TEST(Remedies, OfActors)
{
  LedHand hand;
  vtkHapticScene* const scene = hand.Scene;
  const auto update = [&] { scene->Update(); };
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> bare;
  const int first = scene->AddSurface(bare);
  ExpectRemedy(scene, "has no mapper; give it one", update, [&] { bare->SetMapper(mapper); });
  EXPECT_TRUE(Touches(hand));
  hand.MoveTo(0.01);
  scene->RemoveSurface(first);

  vtkNew<vtkPolyDataMapper> empty;
  vtkNew<vtkActor> actor;
  actor->SetMapper(empty);
  scene->AddSurface(actor);
  ExpectRemedy(scene, "mapper has no input; give it some", update,
    [&] { empty->SetInputData(MakeTable(0.0)); });
  EXPECT_TRUE(Touches(hand));
  hand.MoveTo(0.01);

  const std::string flat = "or is not finite; check its scale and user matrix";
  actor->SetScale(1.0, 1.0, 0.0);
  ExpectRemedy(scene, flat, update, [&] { actor->SetScale(1.0); });
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(0, 0, NotANumber);
  actor->SetUserMatrix(matrix);
  ExpectRemedy(scene, flat, update, [&] { matrix->Identity(), actor->Modified(); });
  EXPECT_TRUE(Touches(hand));
  hand.MoveTo(0.01);

  double height = 0.0;
  double step = 2.0;
  const auto move = [&]
  {
    height += step;
    actor->SetPosition(0.0, 0.0, height);
    scene->Step(1);
    scene->Step(1000); // it rests
  };
  const std::string far = "Move it in smaller steps, or let the device reach farther";
  ExpectRemedy(scene, far, move, [&] { step = 0.2; });
  step = 2.0;
  ExpectRemedy(scene, far, move, [&] { scene->ScaleWorkspace(10.0); });
}

TEST(Remedies, OfCallsOfAScene)
{
  LedHand hand;
  vtkHapticScene* const scene = hand.Scene;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeTable(0.0));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const double bounds[6] = { -0.1, 0.1, -0.1, 0.1, 0.0, 0.0 };

  ExpectRemedy(
    scene, "the scene has no surface that can be touched. Add one", [&] { scene->FitWorkspace(); },
    [&] { scene->AddSurface(MakeTable(0.0)); });
  vtkProp3D* prop = nullptr;
  ExpectRemedy(
    scene, "There is no actor or assembly to add as a surface. Give one",
    [&] { scene->AddSurface(prop); }, [&] { prop = actor; });
  vtkAlgorithmOutput* port = nullptr;
  const auto source = MakeSource(MakeTable(-0.05));
  ExpectRemedy(
    scene, "There is no output port to add as a surface. Give one",
    [&] { scene->AddSurface(port); }, [&] { port = source->GetOutputPort(); });
  int ticks = 0;
  ExpectRemedy(
    scene, "Give 1 or more ticks", [&] { scene->Step(ticks); }, [&] { ticks = 1; });
  ASSERT_TRUE(hand.EngagePatiently());
  ExpectRemedy(
    scene, "Call Release() first", [&] { scene->Step(1); }, [&] { scene->Release(); });

  vtkHapticWorkspace* const workspace = scene->GetWorkspace();
  double factor = 0.0;
  ExpectRemedy(
    workspace, "Give a finite factor > 0", [&] { workspace->Scale(factor); },
    [&] { factor = 2.0; });
  vtkNew<vtkMatrix4x4> matrix;
  vtkMatrix4x4* given = nullptr;
  const auto set = [&] { workspace->SetTransform(given); };
  ExpectRemedy(
    workspace, "take as the workspace transform. Give one", set, [&] { given = matrix; });
  matrix->SetElement(0, 0, -1.0);
  ExpectRemedy(workspace, "It must rotate, scale and translate", set,
    [&]
    {
      vtkNew<vtkTransform> transform;
      transform->RotateWXYZ(30.0, 1.0, 2.0, 3.0);
      transform->Scale(3.0, 3.0, 3.0);
      transform->Translate(1.0, 2.0, 3.0);
      matrix->DeepCopy(transform->GetMatrix());
    });
  matrix->Identity();
  matrix->SetElement(0, 0, 2.0);
  ExpectRemedy(workspace, "Scale all three alike and keep them at right angles", set,
    [&] { matrix->SetElement(1, 1, 2.0), matrix->SetElement(2, 2, 2.0); });
  workspace->Fit(bounds, nullptr);
}

TEST(Remedies, OfSurfacesThatAreNotMetres)
{
  for (const bool byUnit : { true, false })
  {
    LedHand hand;
    vtkSmartPointer<vtkPolyData> table = MakeScaledTable(1000.0, 0.0, 0.0); // in millimetres
    hand.Scene->AddSurface(table);
    ExpectRemedy(
      hand.Scene, "Call FitWorkspace() or EngageInView() to lay the workspace over the surfaces",
      [&]
      {
        table->Modified();
        hand.Scene->Step(1);
      },
      [&] {
        byUnit ? hand.Scene->GetWorkspace()->SetUnitLength(0.001)
               : (void)hand.Scene->FitWorkspace();
      });
    hand.Device->SetPosition(0.0, 0.0, 0.02);
    hand.Scene->Step(1);
    hand.Device->SetPosition(0.0, 0.0, -0.02);
    hand.Scene->Step(1);
    EXPECT_TRUE(hand.Scene->GetTouching()) << byUnit;
  }
}

TEST(Remedies, OfInputsOfFilters)
{
  vtkNew<vtkGodObjectFilter> filter;
  const auto update = [&]
  {
    filter->Modified();
    filter->Update();
  };
  const auto refill = [&] { filter->SetInputData(MakeTable(0.0)); };
  auto beyond = MakeTable(0.0);
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 77 });
  beyond->SetPolys(cells);
  filter->SetInputData(beyond);
  ExpectRemedy(filter, "Repair the cell array of the source", update,
    [&]
    {
      cells->Reset();
      cells->InsertNextCell({ 0, 1, 2 });
      beyond->Modified();
    });
  auto point = MakeTable(0.0);
  for (vtkIdType i = 0; i < point->GetNumberOfPoints(); ++i)
  {
    point->GetPoints()->SetPoint(i, 1.0, 2.0, 3.0);
  }
  filter->SetInputData(point);
  const std::string areas = "Check the coordinates of the source, and the merge tolerance";
  ExpectRemedy(filter, areas, update, refill);
  filter->SetMergeTolerance(0.1); // of the diagonal
  auto small = MakeTable(0.0);
  small->GetPoints()->SetPoint(1, -0.099, -0.1, 0.0);
  small->GetPoints()->SetPoint(3, -0.099, 0.1, 0.0);
  filter->SetInputData(small);
  ExpectRemedy(filter, areas, update, [&] { filter->SetMergeTolerance(0.0); });

  filter->SetMergeTolerance(0.0);
  refill();
  filter->SetEngineToExact();
  {
    const Messages messages(filter);
    filter->Update();
  }
  if (!filter->GetSurface()) // a build without that engine, which alone is under the GPL
  {
    ExpectRemedy(filter, "Check the input and this filter's properties", update,
      [&] { filter->SetEngineToAutomatic(); });
  }
  filter->SetEngineToAutomatic();

  // A sheet of squares of 1 cm in UTM's coordinates.
  vtkNew<vtkPlaneSource> fine;
  fine->SetPoint1(0.2, 0.0, 0.0);
  fine->SetPoint2(0.0, 0.2, 0.0);
  fine->SetResolution(20, 20);
  fine->Update();
  vtkNew<vtkTransform> far;
  far->Translate(540000.0, 5094000.0, 0.0);
  vtkNew<vtkTransformPolyDataFilter> placed;
  placed->SetTransform(far);
  placed->SetInputData(fine->GetOutput());
  for (const bool byPrecision : { true, false })
  {
    placed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
    placed->Update();
    filter->SetInputData(placed->GetOutput());
    ExpectRemedy(filter, "Read the points as float64, or subtract an offset where they still are",
      update,
      [&]
      {
        if (byPrecision)
        {
          placed->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
          placed->Update();
          filter->SetInputData(placed->GetOutput());
        }
        else
        {
          filter->SetInputData(fine->GetOutput());
        }
      });
  }
}

TEST(Remedies, OfTraces)
{
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(0, MakePath());
  const auto run = [&]
  {
    trace->Modified();
    trace->Update();
  };
  ExpectRemedy(trace, "port 1 has no input. Connect a vtkPolyData with polygons or strips", run,
    [&] { trace->SetInputData(1, MakeTable(0.0)); });
  auto broken = MakeTable(0.0);
  broken->GetPoints()->SetPoint(2, NotANumber, 0.0, 0.0);
  vtkNew<vtkGodObjectFilter> filter;
  Messages others(filter);
  filter->SetInputData(broken);
  trace->SetInputConnection(1, filter->GetOutputPort());
  ExpectRemedy(trace, "Mend what that filter reports", run,
    [&] { filter->SetInputData(MakeTable(0.0)); }); // "Remove the cells that use it"

  const auto large = MakeScaledTable(1000.0, 0.0, 0.0);
  for (const bool byUnit : { true, false })
  {
    vtkNew<vtkGodObjectTrace> ofLarge;
    ofLarge->SetInputData(0, MakePath());
    ofLarge->SetInputData(1, large);
    ExpectRemedy(
      ofLarge,
      "Give the length of a world unit where that is not 1 m, SetUnitLength(0.001) for "
      "millimetres, or the metres in the hand for one, ",
      [&]
      {
        ofLarge->Modified();
        ofLarge->Update();
      },
      [&] { byUnit ? ofLarge->SetUnitLength(0.001) : ofLarge->SetWorldToDeviceScale(0.0005); });
  }
  vtkNew<vtkGodObjectTrace> thick;
  thick->SetInputData(0, MakePath());
  thick->SetInputData(1, MakeTable(0.0));
  thick->SetTipRadius(1.0);
  ExpectRemedy(
    thick, "Give SetTipRadius() at most ",
    [&]
    {
      thick->Modified();
      thick->Update();
    },
    [&] { thick->SetTipRadius(0.001); });
  vtkNew<vtkGodObjectTrace> small;
  small->SetInputData(0, MakePath());
  small->SetInputData(1, large);
  small->SetUnitLength(1e-9);
  ExpectRemedy(
    small, "Give the metres in the hand for one world unit, ",
    [&]
    {
      small->Modified();
      small->Update();
    },
    [&] { small->SetWorldToDeviceScale(0.0005); });
}

namespace
{
class RunsOfAServo : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Device->Open();
    this->Servo->SetDevice(this->Device);
    this->BearABusyMachine();
    this->Start();
  }
  void BearABusyMachine()
  {
    this->Servo->SetStallLimit(60.0);
    this->Servo->GetSafety()->LoosenMissedTickShare(60.0);
    this->Servo->GetSafety()->LoosenWatchdogTime(1.0);
  }
  void Start()
  {
    ASSERT_TRUE(this->Servo->Start()) << this->Servo->GetErrorMessage();
    const vtkTypeInt64 enough = this->Servo->GetNumberOfTicks() + 20;
    this->Wait([&] { return this->Servo->GetNumberOfTicks() >= enough; });
  }
  template <class Condition>
  void Wait(Condition condition)
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition() && std::chrono::steady_clock::now() < end)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(condition());
  }
  /// The run ends by what was done before; after `remedy` another one goes on.
  void ExpectEndsUntil(const std::string& words, const std::function<void()>& remedy)
  {
    this->Wait([&] { return !this->Servo->IsRunning(); });
    ExpectRemedy(
      this->Servo, words, [&] { this->Servo->Update(); },
      [&]
      {
        remedy();
        this->Start();
      });
    EXPECT_TRUE(this->Servo->IsRunning());
    EXPECT_STREQ(this->Servo->GetErrorMessage(), "");
    this->Servo->Stop();
  }

  vtkNew<ScriptedDevice> Device;
  vtkNew<vtkHapticServo> Servo;
};
}

TEST_F(RunsOfAServo, WhoseDeviceIsClosedGoOnOnceItIsOpen)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  device->Open();
  this->Servo->Stop();
  this->Servo->SetDevice(device);
  this->Start();
  device->Close();
  this->ExpectEndsUntil("Open the device and start again", [&] { device->Open(); });
}

TEST(Remedies, OfADeviceThatStopsAnswering)
{
  vtkNew<ScriptedDevice> device;
  device->Open();
  device->Hand->IsSilent = true;
  haptics::DeviceSample sample;
  EXPECT_FALSE(device->Hand->Read(0.0, sample));
  ExpectRemedy(
    device, "Check its cable and power, then open it again", [&] { device->Update(); },
    [&]
    {
      device->Hand = std::make_shared<ScriptedDevice::Channel>();
      device->Open();
    });
  EXPECT_TRUE(device->IsOpen());
}

TEST_F(RunsOfAServo, WhosePositionsAreNotFiniteGoOnOnceTheyAre)
{
  this->Device->Hand->Height = NotANumber;
  this->ExpectEndsUntil("Check the device's calibration and start again",
    [this] { this->Device->Hand->Height = 0.01; });
}

TEST_F(RunsOfAServo, ThatStalledGoOnOnAMachineThatIsRelieved)
{
  this->Servo->Stop();
  this->Servo->SetStallLimit(0.1);
  this->Start();
  this->Device->Hand->Delay = 400;
  this->ExpectEndsUntil("Relieve the machine or give the servo real-time priority, and start again",
    [this]
    {
      this->Device->Hand->Delay = 0;
      this->BearABusyMachine();
    });
}

TEST_F(RunsOfAServo, ThatMissDeadlinesGoOnAtALowerRate)
{
  this->Servo->Stop();
  this->Servo->GetSafety()->SetMissedTickShare(0.5);
  this->Start();
  this->Device->Hand->Delay = 10;
  this->ExpectEndsUntil("Relieve the machine, lower Rate or give the servo real-time priority",
    [this] { this->Servo->SetRate(20.0); });
}

TEST_F(RunsOfAServo, OfAProcessThatGoesOnAfterASignalAreStartedAgain)
{
  this->Servo->Stop();
  const auto before = std::signal(SIGTERM, [](int) {}); // the program does not end
  this->Start();
  std::raise(SIGTERM);
  this->Wait([&] { return !this->Servo->IsRunning(); });
  this->Servo->Update();
  const std::string said = this->Servo->GetErrorMessage();
  EXPECT_NE(said.find("Start again if the process goes on"), std::string::npos) << said;
  this->Start();
  EXPECT_STREQ(this->Servo->GetErrorMessage(), "");
  this->Servo->Stop();
  std::signal(SIGTERM, before);
}

TEST(Remedies, OfASharedDeviceThatFallsSilent)
{
  vtkNew<vtkSharedHapticDevice> device;
  const double position[3] = { 0.0, 0.0, 0.01 };
  double force[3];
  const auto open = [&]
  {
    device->Close();
    device->Open();
    device->Exchange(position, 0, force);
    device->Update();
  };
  open();
  ASSERT_TRUE(device->IsOpen());
  vtkNew<vtkHapticServo> servo;
  Messages ofServo(servo);
  servo->SetDevice(device);
  const auto run = [&]
  {
    open();
    servo->Step(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
    servo->Step(1);
    device->Update();
    servo->Stop();
  };
  ExpectRemedy(device, "or raise Timeout, and open the device again", run,
    [&]
    {
      device->Close();
      device->SetTimeout(10.0);
    });
  device->Close();
  device->SetTimeout(0.02);
  bool isLost = true;
  ExpectRemedy(
    device, "See to that program",
    [&]
    {
      open();
      servo->Step(1);
      isLost ? device->Lose() : device->Exchange(position, 0, force);
      servo->Step(1);
      device->Update();
      servo->Stop();
    },
    [&] { isLost = false; });
}

TEST(Remedies, OfRecordedDevices)
{
  const TemporaryFolder folder;
  const std::string name = folder.File("recording.haptic");
  LedHand hand;
  hand.Scene->GetServo()->SetRecordingFileName(name.c_str());
  hand.Scene->Step(20);
  hand.Scene->Release();
  vtkNew<vtkRecordedHapticDevice> recorded;
  recorded->SetFileName(folder.Path.c_str());
  ExpectRemedy(
    recorded, "Give a file that a servo has recorded",
    [&]
    {
      recorded->Close();
      recorded->Open();
    },
    [&] { recorded->SetFileName(name.c_str()); });
  EXPECT_TRUE(recorded->IsOpen());

  const std::string shared = folder.File("shared.haptic");
  vtkHapticServo* const servo = hand.Scene->GetServo();
  servo->SetRecordingFileName(shared.c_str());
  const auto record = [&]
  {
    servo->Step(20);
    std::filesystem::remove(shared); // another program's use of that name
    servo->Step(2000);
    servo->Stop();
  };
  ExpectRemedy(servo, "Choose a name that no other program uses", record,
    [&] { servo->SetRecordingFileName(name.c_str()); });
  servo->SetRecordingFileName("");
}

TEST(Remedies, OfTheMouseAndTheStyle)
{
  vtkNew<vtkMouseHapticDevice> mouse;
  double x = NotANumber;
  ExpectRemedy(
    mouse, "Check the camera and the workspace transform", [&] { mouse->SetTarget(x, 0.0, 0.0); },
    [&] { x = 0.01; });
  vtkNew<vtkInteractorStyleHaptic> style;
  double rate = NotANumber;
  const auto set = [&] { style->SetMaximumFrameRate(rate); };
  ExpectRemedy(style, "Give 1 to 240", set, [&] { rate = 1.0; });
  rate = NotANumber;
  ExpectRemedy(style, "Give 1 to 240", set, [&] { rate = 240.0; });
}
