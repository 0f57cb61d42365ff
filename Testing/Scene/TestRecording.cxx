#include "ServoTestTools.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"
#include "vtkRecordedHapticDevice.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

using haptics::TickRecord;

namespace
{
/// A roof of two slopes; the ridge lies along y at z = 0 and the slopes fall by a quarter.
///
///            ridge
///          __/\__
///       __/      \__
std::shared_ptr<const haptics::TriangleSurface> MakeRoof()
{
  haptics::TriangleMesh mesh;
  mesh.Points = { { -1.0, -1.0, -0.25 }, { 0.0, -1.0, 0.0 }, { 1.0, -1.0, -0.25 },
    { -1.0, 1.0, -0.25 }, { 0.0, 1.0, 0.0 }, { 1.0, 1.0, -0.25 } };
  mesh.Triangles = { { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 } };
  haptics::SurfaceOptions options;
  options.TouchedSide = haptics::Side::Front;
  std::string error;
  return haptics::TriangleSurface::Build(std::move(mesh), options, error);
}

/// A Touch in a hand that strokes to and fro over the roof's ridge.
void StrokeTheRoof(vtkSimulatedHapticDevice* device)
{
  device->SetPreset(vtkSimulatedHapticDevice::Touch);
  device->SetHandStiffness(300.0);
  device->SetMotionToStroke();
  device->SetStrokeBounds(-0.02, 0.02, -0.02, 0.02, 0.0, 0.0);
  device->SetStrokePattern(vtkSimulatedHapticDevice::Lissajous);
  device->SetNumberOfStrokes(3);
  device->SetPressDepth(0.008);
  device->SetStrokeClearance(0.002);
  device->SetSpeed(0.3);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
}

/// The ticks of a playback on the roof.
std::vector<TickRecord> PlayBack(const std::string& fileName)
{
  vtkNew<vtkRecordedHapticDevice> device;
  vtkNew<vtkHapticServo> servo;
  std::vector<TickRecord> records;
  device->SetFileName(fileName);
  EXPECT_TRUE(device->Open()) << device->GetErrorMessage();
  servo->SetDevice(device);
  servo->PublishGodObject(MakeGodObject(MakeRoof()));
  const int ticks = static_cast<int>(device->GetNumberOfTicks());
  EXPECT_EQ(servo->Step(ticks), ticks);
  servo->DrainRecords(records);
  return records;
}

/// Counts a servo's errors, and keeps them out of the output.
class ErrorCount
{
public:
  explicit ErrorCount(vtkHapticServo* servo)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void*)
      { ++static_cast<ErrorCount*>(self)->Count; });
    servo->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }

  int Count = 0;

private:
  vtkNew<vtkCallbackCommand> Command;
};

/// FNV-1a of the forces in nanonewtons, so that the last bits of a C library's square root are not
/// asked about.
std::uint64_t HashOfForces(const std::vector<TickRecord>& records)
{
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const TickRecord& record : records)
  {
    for (const double force : record.Force)
    {
      auto value = static_cast<std::uint64_t>(std::llround(force * 1e9));
      for (int byte = 0; byte < 8; ++byte, value >>= 8)
      {
        hash = (hash ^ (value & 0xffU)) * 0x100000001b3U;
      }
    }
  }
  return hash;
}

TEST(Recording, OfARealServoGivesTheSameForcesBitForBit)
{
  const std::string name = "TestRecording.haptic";
  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticServo> servo;
  StrokeTheRoof(device);
  servo->SetDevice(device);
  servo->PublishGodObject(MakeGodObject(MakeRoof()));
  servo->SetRecordingFileName(name);
  servo->SetStallLimit(60.0); // a busy machine is no fault in a test
  servo->GetSafety()->LoosenMissedTickShare(60.0);
  servo->GetSafety()->LoosenWatchdogTime(1.0);
  ASSERT_TRUE(servo->Start()) << servo->GetErrorMessage();
  while (servo->GetNumberOfTicks() < 500 && servo->IsRunning())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    servo->Update();
  }
  servo->Stop();
  EXPECT_EQ(servo->GetNumberOfUnrecordedTicks(), 0);
  ASSERT_EQ(servo->GetNumberOfRecordedTicks(), servo->GetNumberOfTicks());

  vtkNew<vtkRecordedHapticDevice> recorded;
  recorded->SetFileName(name);
  ASSERT_TRUE(recorded->Open()) << recorded->GetErrorMessage();
  EXPECT_EQ(recorded->GetNote(), "");
  const std::vector<TickRecord> replayed = PlayBack(name);
  ASSERT_EQ(replayed.size(), static_cast<std::size_t>(recorded->GetNumberOfTicks()));
  std::size_t touching = 0;
  for (std::size_t i = 0; i < replayed.size(); ++i)
  {
    double time;
    haptics::Vec3 position;
    haptics::Vec3 force;
    ASSERT_TRUE(
      recorded->GetTick(static_cast<vtkTypeInt64>(i), time, position.data(), force.data()));
    ASSERT_EQ(replayed[i].Time, time);
    ASSERT_EQ(replayed[i].DevicePosition, position);
    ASSERT_EQ(replayed[i].Force, force) << "tick " << i;
    touching += replayed[i].NumberOfConstraints > 0;
  }
  EXPECT_GT(touching, replayed.size() / 2);
}

TEST(Recording, IsNotWrittenOverWhileItIsPlayed)
{
  const std::string file = "kept.hrec";
  vtkNew<vtkSimulatedHapticDevice> hand;
  vtkNew<vtkHapticServo> servo;
  ASSERT_TRUE(hand->Open());
  servo->SetDevice(hand);
  servo->SetRecordingFileName(file.c_str());
  ASSERT_EQ(servo->Step(100), 100);
  servo->Stop();
  vtkNew<vtkRecordedHapticDevice> played;
  played->SetFileName(file);
  ASSERT_TRUE(played->Open()) << played->GetErrorMessage();
  servo->SetDevice(played);
  servo->SetRecordingFileName("./kept.hrec");
  const ErrorCount errors(servo);
  EXPECT_EQ(servo->Step(10), 0);
  EXPECT_NE(std::string(servo->GetErrorMessage()).find("is being played"), std::string::npos);
  servo->SetRecordingFileName("");
  EXPECT_EQ(servo->Step(100), 100) << "it is whole";
  std::remove(file.c_str());
}

TEST(Recording, GoldenOnesForcesAreWhatTheyHaveAlwaysBeen)
{
  // Made by StrokeTheRoof() at a thousand steps of virtual time. A change of the hash is a change
  // of the forces on every hand: accept it only if that is what was meant.
  const char* source = std::getenv("HAPTICS_SOURCE_DIR");
  ASSERT_TRUE(source) << "set by ctest: the source folder";
  const std::vector<TickRecord> records =
    PlayBack(std::string(source) + "/Testing/Data/StrokeTheRoof.haptic");
  ASSERT_EQ(records.size(), 1000u);
  double largest = 0.0;
  for (const TickRecord& record : records)
  {
    largest = std::max(largest, std::hypot(record.Force[0], record.Force[1], record.Force[2]));
  }
  EXPECT_GT(largest, 0.5);
  EXPECT_EQ(HashOfForces(records), 0x5e3fbb692795667au);
}

TEST(Recording, OnAFullDiskIsAnErrorAndTheServoGoesOn)
{
  vtkNew<vtkSimulatedHapticDevice> device;
  vtkNew<vtkHapticServo> servo;
  const ErrorCount errors(servo);
  StrokeTheRoof(device);
  servo->SetDevice(device);
  servo->SetRecordingFileName("no-such-folder/a.haptic");
  EXPECT_EQ(servo->Step(1), 0);
  EXPECT_NE(std::string(servo->GetErrorMessage()).find("no-such-folder"), std::string::npos);
  EXPECT_EQ(errors.Count, 1);

  servo->SetRecordingFileName("/dev/full"); // takes nothing, as a full disk
  EXPECT_EQ(servo->Step(1), 0) << "the header cannot be written";
  EXPECT_NE(std::string(servo->GetErrorMessage()).find("/dev/full"), std::string::npos);
  EXPECT_EQ(errors.Count, 2);

  servo->SetRecordingFileName("");
  EXPECT_EQ(servo->Step(10), 10);
}
}
