#include "../EventCounter.h"
#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/Devices/Recorded/DeviceRecording.h"
#include "vtkRecordedHapticDevice.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

using haptics::ReadRecording;
using haptics::RecordedTick;
using haptics::Recording;
using haptics::RecordingHeader;
using haptics::RecordingWriter;

namespace
{
constexpr std::size_t HeaderSize = 108;
constexpr std::size_t RecordSize = 112;

/// Three ticks, with numbers that do not survive a detour through text.
std::vector<RecordedTick> MakeTicks()
{
  std::vector<RecordedTick> ticks(3);
  for (std::size_t i = 0; i < ticks.size(); ++i)
  {
    ticks[i].Tick = i;
    ticks[i].Time = 0.001 * static_cast<double>(i) / 3.0;
    ticks[i].Position = { 0.1 / 3.0, -0.0, std::numeric_limits<double>::denorm_min() };
    ticks[i].Force = { 1e-300, std::nan(""), 2.0 / 3.0 };
    ticks[i].Buttons = 0x80000001U + static_cast<std::uint32_t>(i);
    ticks[i].Placements = 7 + static_cast<std::uint32_t>(i);
    ticks[i].Place = { -0.2 / 3.0, 1e300, -0.0 };
    ticks[i].Releases = 0xffffffffU;
    ticks[i].Latency = 0.01 / 3.0;
  }
  return ticks;
}

/// Tests run at the same time: each has a file of its own.
std::string FileOfThisTest()
{
  return std::string("DeviceRecording") +
    ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".haptic";
}

RecordingHeader MakeHeader()
{
  RecordingHeader header;
  header.Rate = 1000.0;
  header.MaximumForce = 3.3;
  header.Damping = 0.35;
  header.WorkspaceBounds = { -1.0, 1.0, -2.0, 2.0, -3.0, 3.0 };
  header.NumberOfButtons = 2;
  return header;
}

std::string WriteTicks(
  const std::vector<RecordedTick>& ticks, const RecordingHeader& header = MakeHeader())
{
  const std::string name = FileOfThisTest();
  RecordingWriter writer;
  std::string error;
  EXPECT_TRUE(writer.Open(name, header, error)) << error;
  EXPECT_TRUE(writer.Write(ticks, error)) << error;
  EXPECT_TRUE(writer.Close(error)) << error;
  return name;
}

std::string Contents(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void Replace(const std::string& name, const std::string& contents)
{
  std::ofstream(name, std::ios::binary) << contents;
}

TEST(DeviceRecording, ComesBackBitForBit)
{
  const std::vector<RecordedTick> ticks = MakeTicks();
  Recording read;
  std::string error;
  ASSERT_TRUE(ReadRecording(WriteTicks(ticks), read, error)) << error;
  EXPECT_EQ(read.Note, "");
  EXPECT_EQ(read.Header.MaximumForce, 3.3);
  EXPECT_EQ(read.Header.WorkspaceBounds[5], 3.0);
  EXPECT_EQ(read.Header.NumberOfButtons, 2u);
  ASSERT_EQ(read.Ticks.size(), ticks.size());
  for (std::size_t i = 0; i < ticks.size(); ++i)
  {
    EXPECT_EQ(read.Ticks[i].Tick, ticks[i].Tick);
    EXPECT_EQ(read.Ticks[i].Time, ticks[i].Time);
    EXPECT_EQ(std::memcmp(&read.Ticks[i].Position, &ticks[i].Position, 24), 0);
    EXPECT_EQ(std::memcmp(&read.Ticks[i].Force, &ticks[i].Force, 24), 0);
    EXPECT_EQ(read.Ticks[i].Buttons, ticks[i].Buttons);
    EXPECT_EQ(read.Ticks[i].Placements, ticks[i].Placements);
    EXPECT_EQ(std::memcmp(&read.Ticks[i].Place, &ticks[i].Place, 24), 0);
    EXPECT_EQ(read.Ticks[i].Releases, ticks[i].Releases);
    EXPECT_EQ(read.Ticks[i].Latency, ticks[i].Latency);
  }
}

TEST(DeviceRecording, OfBeforeThereWerePlacementsIsReadWithoutThem)
{
  // Written byte by byte by the version that had records of 72 bytes.
  const char* source = std::getenv("HAPTICS_SOURCE_DIR");
  ASSERT_TRUE(source) << "set by ctest: the source folder";
  const std::string name = std::string(source) + "/Testing/Data/StrokeTheRoof.haptic";
  ASSERT_EQ(Contents(name).size(), HeaderSize + 1000 * 72);
  Recording read;
  std::string error;
  ASSERT_TRUE(ReadRecording(name, read, error)) << error;
  ASSERT_EQ(read.Ticks.size(), 1000u);
  EXPECT_EQ(read.Note, "");
  EXPECT_EQ(read.Ticks.back().Tick, 999u);
  EXPECT_EQ(read.Ticks.back().Placements, 0u);
  EXPECT_EQ(read.Ticks.back().Releases, 0u);
  EXPECT_EQ(read.Ticks.back().Latency, 0.0);
}

TEST(DeviceRecording, OfEachVersionIsRead)
{
  const char* source = std::getenv("HAPTICS_SOURCE_DIR");
  ASSERT_TRUE(source) << "set by ctest: the source folder";
  int versions = 0;
  for (const auto& entry :
    std::filesystem::directory_iterator(std::string(source) + "/Testing/Formats"))
  {
    if (!entry.is_directory())
    {
      continue;
    }
    const std::string name = (entry.path() / "stroke.haptic").string();
    Recording read;
    std::string error;
    ASSERT_TRUE(ReadRecording(name, read, error)) << name << ": " << error;
    EXPECT_EQ(read.Note, "") << name;
    ASSERT_EQ(read.Ticks.size(), 500u) << name;
    EXPECT_EQ(read.Header.Rate, 1000.0) << name;
    EXPECT_EQ(read.Ticks.back().Tick, 499u) << name;
    double largest = 0.0;
    for (const RecordedTick& tick : read.Ticks)
    {
      largest = std::max(largest, std::hypot(tick.Force[0], tick.Force[1], tick.Force[2]));
    }
    EXPECT_GT(largest, 0.1) << name;
    ++versions;
  }
  EXPECT_GE(versions, 1);
}

TEST(DeviceRecording, CutOffAnywhereReadsToTheLastWholeTickAndSaysSo)
{
  const std::string name = WriteTicks(MakeTicks());
  const std::string whole = Contents(name);
  ASSERT_EQ(whole.size(), HeaderSize + 3 * RecordSize);
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    Replace(name, whole.substr(0, size));
    Recording read;
    std::string error;
    const std::size_t wholeTicks = size < HeaderSize ? 0 : (size - HeaderSize) / RecordSize;
    ASSERT_EQ(ReadRecording(name, read, error), wholeTicks > 0) << size << " bytes";
    ASSERT_EQ(read.Ticks.size(), wholeTicks) << size << " bytes";
    ASSERT_EQ(error.empty(), wholeTicks > 0);
    const bool isBetween = (size - HeaderSize) % RecordSize != 0;
    ASSERT_EQ(read.Note.find("cut off") != std::string::npos, wholeTicks > 0 && isBetween);
  }
}

TEST(DeviceRecording, ReadsUpToAFlippedBit)
{
  const std::string name = WriteTicks(MakeTicks());
  const std::string whole = Contents(name);
  for (std::size_t at = 0; at < whole.size(); ++at)
  {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    Replace(name, damaged);
    Recording read;
    std::string error;
    const std::size_t wholeTicks = at < HeaderSize ? 0 : (at - HeaderSize) / RecordSize;
    ASSERT_EQ(ReadRecording(name, read, error), wholeTicks > 0) << "byte " << at;
    ASSERT_EQ(read.Ticks.size(), wholeTicks) << "byte " << at;
    ASSERT_EQ(read.Note.find("damaged") != std::string::npos, wholeTicks > 0) << "byte " << at;
  }
}

TEST(DeviceRecording, RefusesOtherFilesAndSaysWhy)
{
  Recording read;
  std::string error;
  EXPECT_FALSE(ReadRecording("no-such-file.haptic", read, error));
  EXPECT_NE(error.find("no-such-file.haptic"), std::string::npos);
  Replace(FileOfThisTest(), "solid of an STL file, longer than the magic number");
  EXPECT_FALSE(ReadRecording(FileOfThisTest(), read, error));
  EXPECT_NE(error.find("is none"), std::string::npos) << error;
  RecordingWriter writer;
  EXPECT_FALSE(writer.Open("no-such-folder/a.haptic", {}, error));
  EXPECT_NE(error.find("no-such-folder"), std::string::npos) << error;
}

TEST(DeviceRecording, RefusesTimesThatDoNotGoOn)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double time : { nan, infinity, -1.0, 0.0 }) // the tick before was at 0 s
  {
    std::vector<RecordedTick> ticks = MakeTicks();
    ticks[1].Time = time;
    Recording read;
    std::string error;
    EXPECT_FALSE(ReadRecording(WriteTicks(ticks), read, error)) << time;
    EXPECT_NE(error.find("tick 1 at " + std::to_string(time)), std::string::npos) << error;
  }
  for (const double time : { nan, -infinity })
  {
    std::vector<RecordedTick> ticks = MakeTicks();
    ticks[0].Time = time;
    Recording read;
    std::string error;
    EXPECT_FALSE(ReadRecording(WriteTicks(ticks), read, error)) << time;
    EXPECT_NE(error.find("comes first"), std::string::npos) << error;
  }
  std::vector<RecordedTick> ticks = MakeTicks();
  ticks[2].Tick = 1;
  Recording read;
  std::string error;
  EXPECT_FALSE(ReadRecording(WriteTicks(ticks), read, error)) << "two ticks of one number";
}

TEST(DeviceRecording, RefusesAHeaderThatNoServoCanRunWith)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<RecordingHeader> headers(6, MakeHeader());
  headers[0].Rate = 0.0;
  headers[1].Rate = nan;
  headers[2].MaximumForce = nan;
  headers[3].MaximumStiffness = -1.0;
  headers[4].Damping = -1.0;
  headers[5].Latency = nan;
  for (const RecordingHeader& header : headers)
  {
    Recording read;
    std::string error;
    EXPECT_FALSE(ReadRecording(WriteTicks(MakeTicks(), header), read, error));
    EXPECT_NE(error.find("its rate must be"), std::string::npos) << error;
  }
}

TEST(RecordedHapticDevice, IsWhereTheHandWasAndStaysAtTheEnd)
{
  std::vector<RecordedTick> ticks(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    ticks[i].Tick = i;
    ticks[i].Time = 0.0013 * static_cast<double>(i); // no regular servo's times
    ticks[i].Position = { static_cast<double>(i), 0.0, 0.0 };
  }
  vtkNew<vtkRecordedHapticDevice> device;
  device->SetFileName(WriteTicks(ticks));
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_EQ(device->GetNumberOfTicks(), 3);
  EXPECT_NEAR(device->GetDuration(), 0.0026, 1e-12);
  EXPECT_EQ(device->GetMaximumForce(), 3.3);
  EXPECT_EQ(device->GetNote(), "");
  const auto channel = device->GetChannel();
  haptics::DeviceSample sample;
  for (int run = 0; run < 2; ++run)
  {
    channel->Restart();
    const double expected[] = { 0.0, 0.0, 1.0, 2.0, 2.0 };
    for (int tick = 0; tick < 5; ++tick)
    {
      ASSERT_TRUE(channel->Read(0.001 * tick, sample));
      EXPECT_EQ(sample.Position[0], expected[tick]) << "tick " << tick;
    }
  }
  channel->Restart();
  double last = -1.0;
  for (int tick = 0; tick < 5; ++tick)
  {
    double time = 0.0;
    ASSERT_TRUE(channel->NextTime(time));
    EXPECT_GT(time, last);
    last = time;
    ASSERT_TRUE(channel->Read(time, sample));
    EXPECT_EQ(sample.Position[0], std::min(tick, 2)) << "tick " << tick;
  }
}

TEST(RecordedHapticDevice, ReportsACutOffAndTicksThatWereLost)
{
  std::vector<RecordedTick> ticks = MakeTicks();
  ticks[1].Tick = 5;
  const std::string name = WriteTicks(ticks);
  const std::string whole = Contents(name);
  Replace(name, whole.substr(0, whole.size() - 1));
  vtkNew<vtkRecordedHapticDevice> device;
  EventCounter warnings(device, vtkCommand::WarningEvent);
  device->SetFileName(name);
  ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
  EXPECT_EQ(warnings.Count, 1);
  EXPECT_EQ(device->GetNumberOfTicks(), 2);
  EXPECT_NE(device->GetNote().find("cut off"), std::string::npos) << device->GetNote();
  EXPECT_NE(device->GetNote().find("4 ticks"), std::string::npos) << device->GetNote();
}

TEST(RecordedHapticDevice, StaysClosedWithoutARecording)
{
  vtkNew<vtkRecordedHapticDevice> device;
  EventCounter errors(device, vtkCommand::ErrorEvent);
  device->SetFileName("no-such-file.haptic");
  EXPECT_FALSE(device->Open());
  EXPECT_EQ(errors.Count, 1);
  EXPECT_EQ(device->GetState(), vtkHapticDevice::Closed);
  EXPECT_NE(std::string(device->GetErrorMessage()).find("no-such-file"), std::string::npos);
}
}
