// What a recording does when its file fails it.
#include "SceneTestTools.h"
#include "ServoTestTools.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticServo.h"
#include "vtkRecordedHapticDevice.h"

#include "vtkObjectFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
/// A name that no other test has, without a file.
std::string NewName()
{
  const std::string name = std::string("RecordingFaults") +
    ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".hrec";
  fs::remove(name);
  return name;
}

std::string Begin(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  std::string begin(8, ' ');
  file.read(begin.data(), 8);
  return begin;
}

vtkTypeInt64 TicksIn(const std::string& name)
{
  vtkNew<vtkRecordedHapticDevice> device;
  const EventCounter errors(device, vtkCommand::ErrorEvent);
  const EventCounter warnings(device, vtkCommand::WarningEvent);
  device->SetFileName(name);
  if (!device->Open())
  {
    return 0;
  }
  EXPECT_EQ(device->GetNote(), "") << "ends with a whole tick";
  return device->GetNumberOfTicks();
}

/// Records with a real servo until `fault` has done its work and the scene reports it, and compares
/// what the scene says with the file.
void ExpectReport(
  const std::string& name, const std::function<void()>& fault, const std::string& words)
{
  LedHand hand;
  vtkHapticServo* servo = hand.Scene->GetServo();
  servo->SetRecordingFileName(name);
  hand.Device->SetPosition(0.0, 0.0, 0.01);
  const EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  ASSERT_TRUE(hand.EngagePatiently()) << hand.Scene->GetErrorMessage();
  hand.AwaitTicks(200);
  fault();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (errors.Count == 0 && std::chrono::steady_clock::now() < end)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    hand.Scene->Update();
  }
  EXPECT_EQ(errors.Count, 1);
  const std::string message = hand.Scene->GetErrorMessage();
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_NE(message.find(name), std::string::npos) << message;
  EXPECT_TRUE(hand.Scene->IsEngaged()) << "the servo goes on";
  hand.AwaitTicks(50);
  hand.Scene->Release();
  EXPECT_EQ(errors.Count, 1) << "once";
  EXPECT_EQ(servo->GetNumberOfRecordedTicks() + servo->GetNumberOfUnrecordedTicks(),
    servo->GetNumberOfTicks());
  EXPECT_GT(servo->GetNumberOfUnrecordedTicks(), 0);
  EXPECT_EQ(servo->GetNumberOfRecordedTicks(), TicksIn(name));
}

TEST(RecordingFaults, AFullDiskIsReportedAtOnceAndEveryTickCounted)
{
  const std::string name = NewName();
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit limit{ 50001, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  ExpectReport(
    name, [] {}, "ends after 445 ticks");
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(TicksIn(name), 445) << "(50001 - 108) / 112";
}

TEST(RecordingFaults, ADeletedFileIsReported)
{
  const std::string name = NewName();
  ExpectReport(
    name, [&] { fs::remove(name); }, "deleted or moved away");
}

TEST(RecordingFaults, AProgramThatIsKilledLeavesWhatItHadRecorded)
{
  const std::string name = NewName();
  int channel[2];
  ASSERT_EQ(pipe(channel), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    LedHand hand;
    vtkHapticServo* servo = hand.Scene->GetServo();
    servo->SetRecordingFileName(name);
    hand.Device->SetPosition(0.0, 0.0, 0.01);
    if (!hand.EngagePatiently())
    {
      _exit(1);
    }
    vtkTypeInt64 recorded = 0;
    while ((recorded = servo->GetNumberOfRecordedTicks()) < 300)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (write(channel[1], &recorded, sizeof(recorded)) == sizeof(recorded))
    {
      raise(SIGKILL);
    }
    _exit(2);
  }
  close(channel[1]);
  vtkTypeInt64 recorded = 0;
  EXPECT_EQ(read(channel[0], &recorded, sizeof(recorded)), ssize_t(sizeof(recorded)));
  close(channel[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
  vtkNew<vtkRecordedHapticDevice> device;
  device->SetFileName(name);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_GE(device->GetNumberOfTicks(), recorded);
}

TEST(RecordingFaults, AReplacedFileIsReportedAndTheOtherOneIsLeft)
{
  const std::string name = NewName();
  ExpectReport(
    name,
    [&]
    {
      std::ofstream("RecordingFaults.other") << "solid of another program";
      fs::rename("RecordingFaults.other", name);
    },
    "was replaced");
  EXPECT_EQ(Begin(name), "solid of");
}

TEST(RecordingFaults, ATruncatedFileIsReportedAndCountedByWhatIsLeft)
{
  const std::string name = NewName();
  ExpectReport(
    name, [&] { fs::resize_file(name, 0); }, "changed by another program");
  ExpectReport(
    name, [&] { fs::resize_file(name, 108 + 7 * 112); }, "changed by another program");
  EXPECT_EQ(TicksIn(name), 7);
}

TEST(RecordingFaults, TwoScenesNeverShareAFile)
{
  const std::string name = NewName();
  fs::create_symlink(name, name + ".link");
  LedHand first;
  LedHand second;
  first.Scene->GetServo()->SetRecordingFileName(name);
  ASSERT_TRUE(first.EngagePatiently());
  first.AwaitTicks(100);
  for (const std::string& other : { name, "./" + name, name + ".link" })
  {
    second.Scene->GetServo()->SetRecordingFileName(other);
    const EventCounter errors(second.Scene, vtkCommand::ErrorEvent);
    EXPECT_FALSE(second.Scene->Engage());
    EXPECT_EQ(errors.Count, 1);
    EXPECT_NE(
      std::string(second.Scene->GetErrorMessage()).find("being written already"), std::string::npos)
      << second.Scene->GetErrorMessage();
  }
  first.Scene->Release();
  fs::remove(name + ".link");
  EXPECT_EQ(first.Scene->GetServo()->GetNumberOfUnrecordedTicks(), 0);
  EXPECT_EQ(TicksIn(name), first.Scene->GetServo()->GetNumberOfTicks());
  second.Scene->GetServo()->SetRecordingFileName(name);
  EXPECT_EQ(second.Scene->Step(10), 10) << "the name is free again";
}

TEST(RecordingFaults, AFifoIsRefusedWithoutWaiting)
{
  const std::string name = NewName();
  ASSERT_EQ(mkfifo(name.c_str(), 0600), 0);
  LedHand hand;
  const EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Scene->GetServo()->SetRecordingFileName(name);
  EXPECT_FALSE(hand.Scene->Engage());
  EXPECT_EQ(hand.Scene->Step(1), 0);
  EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("no regular file"), std::string::npos)
    << hand.Scene->GetErrorMessage();
  vtkNew<vtkRecordedHapticDevice> played;
  const EventCounter refusals(played, vtkCommand::ErrorEvent);
  for (const std::string& file : { name, std::string("/dev/zero"), std::string("/") })
  {
    played->SetFileName(file);
    EXPECT_FALSE(played->Open());
    EXPECT_NE(std::string(played->GetErrorMessage()).find("no regular file"), std::string::npos)
      << played->GetErrorMessage();
  }
  fs::remove(name);
}

TEST(RecordingFaults, WhatIsNoRecordingIsNotReplaced)
{
  const std::string name = NewName();
  std::ofstream(name) << "<VTKFile type=\"PolyData\"/>";
  LedHand hand;
  const EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  hand.Scene->GetServo()->SetRecordingFileName(name);
  EXPECT_EQ(hand.Scene->Step(1), 0);
  EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("is no recording"), std::string::npos)
    << hand.Scene->GetErrorMessage();
  EXPECT_EQ(Begin(name), "<VTKFile");
  std::ofstream(name, std::ios::trunc).close(); // an empty one holds nothing to be lost
  EXPECT_EQ(hand.Scene->Step(1), 1);
}

TEST(RecordingFaults, AnOldRecordingStaysWhereTheNewOneCannotBegin)
{
  const std::string name = NewName();
  LedHand hand;
  hand.Scene->GetServo()->SetRecordingFileName(name);
  ASSERT_EQ(hand.Scene->Step(100), 100);
  hand.Scene->Release();
  const EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit limit{ 50, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  EXPECT_FALSE(hand.Scene->Engage());
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(TicksIn(name), 100);
}

TEST(RecordingFaults, VirtualTimeWaitsForTheDiskAndLosesNothing)
{
  const std::string name = NewName();
  LedHand hand;
  vtkHapticServo* servo = hand.Scene->GetServo();
  servo->SetRecordingFileName(name);
  ASSERT_TRUE(hand.Device->Open());
  ASSERT_EQ(servo->Step(100000), 100000);
  servo->Stop();
  EXPECT_EQ(servo->GetNumberOfUnrecordedTicks(), 0);
  EXPECT_EQ(TicksIn(name), 100000);
  fs::remove(name);
}

/// A hand that is put down elsewhere, lets go of its force, and becomes late: as a mouse and a
/// Falcon do.
class WhimsicalDevice : public vtkHapticDevice
{
public:
  static WhimsicalDevice* New();
  vtkTypeMacro(WhimsicalDevice, vtkHapticDevice);
  bool Open() override
  {
    this->BecomeReady(std::make_shared<Channel>());
    return true;
  }
  void Close() override { this->BecomeClosed(); }

private:
  WhimsicalDevice()
  {
    this->MaximumForce = 3.0;
    this->MaximumStiffness = 1000.0;
    this->Damping = 2.0;
  }
  class Channel : public haptics::MonitoredChannel
  {
    bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
    {
      const int tick = static_cast<int>(std::lround(1000.0 * time));
      sample.Position = { 1e-5 * (tick % 200), 0.0, -0.001 };
      // Every 100 ms it is put down below the plane and above it in turns.
      sample.Placements = 1 + static_cast<std::uint32_t>(tick / 100);
      sample.Place = { 0.0, 0.0, (tick / 100) % 3 == 2 ? -0.002 : 0.01 };
      sample.Releases = static_cast<std::uint32_t>(tick / 70);
      sample.Latency = tick > 500 ? 0.008 : 0.0;
      return true;
    }
    void WriteDevice(const std::array<double, 3>&) noexcept override {}
  };
};
vtkStandardNewMacro(WhimsicalDevice);

std::vector<haptics::TickRecord> StepOverAPlane(
  vtkHapticDevice* device, const std::string& recording, int ticks)
{
  vtkNew<vtkHapticServo> servo;
  std::vector<haptics::TickRecord> records;
  servo->SetDevice(device);
  servo->SetStiffness(700.0);
  servo->SetRecordingFileName(recording);
  servo->PublishGodObject(MakeGodObject(MakePlane()));
  EXPECT_EQ(servo->Step(ticks), ticks) << servo->GetErrorMessage();
  servo->Stop();
  servo->DrainRecords(records);
  return records;
}

TEST(RecordingFaults, PlacementsReleasesAndLatencyAreReplayed)
{
  const std::string name = NewName();
  vtkNew<WhimsicalDevice> hand;
  ASSERT_TRUE(hand->Open());
  const auto ticks = StepOverAPlane(hand, name, 1000);
  vtkNew<vtkRecordedHapticDevice> recorded;
  recorded->SetFileName(name);
  ASSERT_TRUE(recorded->Open()) << recorded->GetErrorMessage();
  const auto replayed = StepOverAPlane(recorded, "", 1000);
  ASSERT_EQ(ticks.size(), 1000u);
  ASSERT_EQ(replayed.size(), 1000u);
  std::size_t pushing = 0;
  std::size_t through = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i)
  {
    ASSERT_EQ(replayed[i].Force, ticks[i].Force) << "tick " << i;
    ASSERT_EQ(replayed[i].Position, ticks[i].Position) << "tick " << i;
    ASSERT_EQ(replayed[i].Stiffness, ticks[i].Stiffness) << "tick " << i;
    pushing += ticks[i].Force[2] > 0.1;
    through += ticks[i].Position[2] < 0.0;
  }
  EXPECT_GT(pushing, 200u);
  EXPECT_GT(through, 200u) << "was put down below";
  EXPECT_NEAR(ticks.back().Stiffness, 0.9 * 2.0 / (0.0005 + 0.008), 0.1) << "by the latency";
}
}
