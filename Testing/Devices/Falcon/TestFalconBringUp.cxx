#include "FalconBench.h"

#include <algorithm>
#include <cstdio>
#include <fstream>

#include <sys/stat.h>

namespace
{
/// A firmware file that is gone with the test.
class FirmwareFile
{
public:
  explicit FirmwareFile(std::size_t size)
    : Path(testing::TempDir() + "falcon-" + std::to_string(getpid()) + ".bin")
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      this->Bytes.push_back(static_cast<std::uint8_t>(i * 7 + i / 256));
    }
    std::ofstream(this->Path, std::ios::binary)
      .write(reinterpret_cast<const char*>(this->Bytes.data()),
        static_cast<std::streamsize>(this->Bytes.size()));
  }
  ~FirmwareFile() { std::remove(this->Path.c_str()); }
  const std::string Path;
  std::vector<std::uint8_t> Bytes;
};

using FalconBringUp = FalconBench;
using Text = std::string;

bool Contains(const Text& text, const Text& part)
{
  return text.find(part) != Text::npos;
}

FalconModel WithoutFirmware(const FirmwareFile& file, std::vector<Act> script = {})
{
  FalconModel model;
  model.Loaded = false;
  model.Image = file.Bytes;
  model.Script = std::move(script);
  return model;
}

TEST_F(FalconBringUp, GoesThroughItsStatesAndHomes)
{
  FalconModel unhomed;
  unhomed.HomesAfter = -1;
  this->Bus.Plug(1, unhomed);
  ASSERT_TRUE(this->IsHomedAndBecomesReady());
  EXPECT_EQ(this->Events.States, (std::vector<Text>{ "Opening", "Homing", "Ready" }));
  EXPECT_EQ(this->Events.Errors, 0);
  EXPECT_TRUE(this->Bus.IsDriverDetached()) << "the serial driver holds the interface at first";
  this->Bus.With(1,
    [](FalconModel& model)
    {
      // Purge twice, 1 ms latency, 1.5 Mbaud, purge twice.
      const std::vector<std::array<int, 2>> open{ { 0, 1 }, { 0, 2 }, { 9, 1 }, { 3, 2 }, { 0, 1 },
        { 0, 2 } };
      EXPECT_EQ(model.Controls, open);
      for (const haptics::FalconCommand& command : model.Commands)
      {
        EXPECT_TRUE(command.Home) << "the origin is lost where one packet lacks it";
        EXPECT_EQ(command.Torques, (std::array<std::int16_t, 3>{}));
      }
      EXPECT_EQ(model.BadPackets, 0);
    });
}

TEST_F(FalconBringUp, NeverBlocksTheCaller)
{
  FalconModel model;
  model.HomesAfter = -1;
  this->Bus.Plug(1, model);
  const auto start = FalconModel::Clock::now();
  this->Device->Open();
  this->Device->Update();
  this->Device->Close();
  EXPECT_LT(FalconModel::Clock::now() - start, std::chrono::milliseconds(20));
}

TEST_F(FalconBringUp, WaitsForAHandToHomeItAndSaysSo)
{
  FalconModel model;
  model.HomesAfter = -1;
  this->Bus.Plug(1, model);
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Homing)) << this->Device->GetStatusMessage();
  EXPECT_TRUE(Contains(this->Device->GetStatusMessage(), "0 of 3 legs done: pull the grip"))
    << this->Device->GetStatusMessage();
  EXPECT_FALSE(this->Device->GetChannel()) << "no servo before the origin is known";
  ASSERT_TRUE(this->Run([&] { return this->Device->GetNumberOfExchanges() > 10; }));
  EXPECT_EQ(this->LastCommand().Leds, haptics::FalconLedRed);
  this->Bus.With(1, [](FalconModel& model) { model.HomesAfter = 1; });
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Ready));
  ASSERT_TRUE(this->Run([&] { return this->LastCommand().Leds == haptics::FalconLedGreen; }));
  this->Device->SetLeds(vtkFalconHapticDevice::BlueLed);
  EXPECT_TRUE(this->Run([&] { return this->LastCommand().Leds == haptics::FalconLedBlue; }));
}

TEST_F(FalconBringUp, LoadsTheFirmwareWithEveryEchoCompared)
{
  const FirmwareFile file(3000);
  FalconModel unhomed = WithoutFirmware(file, { { At::Upload, 0, Do::Late, Always } });
  unhomed.HomesAfter = -1;
  this->Bus.Plug(1, unhomed);
  this->Device->SetFirmwareFile(file.Path.c_str());
  ASSERT_TRUE(this->IsHomedAndBecomesReady());
  EXPECT_EQ(
    this->Events.States, (std::vector<Text>{ "Opening", "LoadingFirmware", "Homing", "Ready" }));
  EXPECT_EQ(this->Device->GetFirmwareProgress(), 1.0);
  EXPECT_GE(this->Events.Progress.size(), 2u);
  EXPECT_TRUE(std::is_sorted(this->Events.Progress.begin(), this->Events.Progress.end()));
  this->Bus.With(1,
    [&](FalconModel& model)
    {
      EXPECT_EQ(model.Firmware, file.Bytes);
      EXPECT_EQ(model.Uploads, 1);
      const std::vector<std::array<int, 2>> boot{ { 0, 1 }, { 0, 2 }, { 9, 16 }, { 3, 0x4138 },
        { 4, 8 }, { 2, 0 }, { 1, 0x0200 }, { 1, 0x0100 }, { 1, 0x0101 }, { 1, 0x0100 },
        { 3, 0x0015 }, { 0, 1 }, { 0, 2 }, { 9, 1 }, { 3, 2 }, { 0, 1 }, { 0, 2 } };
      ASSERT_EQ(model.Controls.size(), 6 + boot.size());
      EXPECT_TRUE(std::equal(boot.begin(), boot.end(), model.Controls.begin() + 6));
    });
}

TEST_F(FalconBringUp, TriesAgainWhereAnEchoWasDamagedOnce)
{
  const FirmwareFile file(500);
  this->Bus.Plug(1, WithoutFirmware(file, { { At::Upload, 3, Do::Garble } }));
  this->Device->SetFirmwareFile(file.Path.c_str());
  ASSERT_TRUE(this->BecomesReady());
  this->Bus.With(1, [](FalconModel& model) { EXPECT_EQ(model.Uploads, 2); });
}

TEST_F(FalconBringUp, TakesEchoesInPieces)
{
  const FirmwareFile file(500);
  this->Bus.Plug(1, WithoutFirmware(file, { { At::Upload, 0, Do::Split, Always } }));
  this->Device->SetFirmwareFile(file.Path.c_str());
  EXPECT_TRUE(this->BecomesReady());
}

/// Bring-ups that fail: what the device does, and what the user reads.
struct Failure
{
  const char* Name;
  std::vector<Act> Script;
  bool GivesFile;
  const char* Message;
};

void PrintTo(const Failure& failure, std::ostream* os)
{
  *os << failure.Name;
}

class FalconUploadFailure
  : public FalconBench
  , public testing::WithParamInterface<Failure>
{
};

TEST_P(FalconUploadFailure, IsReportedToTheUser)
{
  const FirmwareFile file(500);
  this->Bus.Plug(1, WithoutFirmware(file, this->GetParam().Script));
  if (this->GetParam().GivesFile)
  {
    this->Device->SetFirmwareFile(file.Path.c_str());
  }
  EXPECT_FALSE(this->Device->Open());
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted)) << this->Device->GetStatusMessage();
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), this->GetParam().Message))
    << this->Device->GetErrorMessage();
  EXPECT_GE(this->Events.Errors, 1);
  EXPECT_TRUE(this->Run([&] { return !this->Bus.IsClaimed(1); })) << "others may try";
}

// clang-format off
const Failure Failures[] = {
  { "NoFile", {}, false, "no firmware loaded. Set FirmwareFile" },
  { "WrongEcho", { { At::Upload, 3, Do::Garble, Always } }, true, "echoed its firmware wrongly at byte " },
  { "EchoStops", { { At::Upload, 0, Do::Silence, Always } }, true, "stopped echoing its firmware at byte 0." },
  { "Stall", { { At::Upload, 2, Do::Stall } }, true, "stall) while reading the firmware's echo" },
  { "WriteStall", { { At::Upload, 2, Do::StallWrite } }, true, "stall) while sending the firmware" },
  { "IoError", { { At::Upload, 2, Do::IoError } }, true, "I/O error) while reading the firmware's echo" },
  { "Unplugged", { { At::Upload, 2, Do::Unplug } }, true, "was unplugged while reading the firmware's echo" },
  { "ControlStall", { { At::Control, 8, Do::Stall } }, true, "stall) while setting up its serial chip (request 9, value 16)" },
  { "FirstControlFails", { { At::Control, 0, Do::IoError } }, true, "I/O error) while setting up its serial chip (request 0" },
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(All, FalconUploadFailure, testing::ValuesIn(Failures),
  [](const testing::TestParamInfo<Failure>& info) { return std::string(info.param.Name); });

TEST_F(FalconBringUp, SaysThatAFileThatDoesNotRunMayBeTheWrongOne)
{
  const FirmwareFile file(500);
  FalconModel model = WithoutFirmware(file);
  model.Image.push_back(0);
  this->Bus.Plug(1, model);
  this->Device->SetFirmwareFile(file.Path.c_str());
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), "but does not run it. Is it the image"))
    << this->Device->GetErrorMessage();
  this->Bus.With(1, [](FalconModel& model) { EXPECT_EQ(model.Uploads, 3); });
}

TEST_F(FalconBringUp, NamesAFileThatCannotBeReadOrIsNone)
{
  const FirmwareFile empty(0);
  this->Bus.Plug(1, WithoutFirmware(empty));
  this->Device->SetFirmwareFile("/nowhere/falcon.bin");
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  EXPECT_TRUE(
    Contains(this->Device->GetErrorMessage(), "/nowhere/falcon.bin cannot be opened: No such file"))
    << this->Device->GetErrorMessage();
  this->Device->SetFirmwareFile(empty.Path.c_str());
  this->Device->Open();
  ASSERT_TRUE(this->Run(
    [&] { return Contains(this->Device->GetErrorMessage(), "is no firmware image: it holds 0"); }))
    << this->Device->GetErrorMessage();
  const FirmwareFile large((1 << 20) + 1); // in place of the empty one
  this->Device->Open();
  ASSERT_TRUE(this->Run(
    [&] { return Contains(this->Device->GetErrorMessage(), "it holds more than 1048576 bytes"); }))
    << this->Device->GetErrorMessage();
}

TEST_F(FalconBringUp, NeverWaitsForAFirmwareFileThatIsAFifoOrEndless)
{
  const FirmwareFile file(500);
  const std::string fifo = file.Path + ".fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0); // nobody will ever write it
  this->Bus.Plug(1, WithoutFirmware(file));
  for (const std::string& path : { fifo, std::string("/dev/zero") })
  {
    this->Device->SetFirmwareFile(path.c_str());
    this->Device->Open();
    ASSERT_TRUE(
      this->Run([&] { return Contains(this->Device->GetErrorMessage(), "no regular file"); }))
      << this->Device->GetErrorMessage();
    EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), path));
    this->Device->Close();
  }
  std::remove(fifo.c_str());
}

TEST_F(FalconBringUp, MayBeClosedInTheMiddleOfAnUploadAndOpenedAgain)
{
  const FirmwareFile file(3000);
  this->Bus.Plug(1, WithoutFirmware(file, { { At::Upload, 0, Do::Late, Always } }));
  this->Device->SetFirmwareFile(file.Path.c_str());
  this->Device->Open();
  ASSERT_TRUE(this->Run([&] { return this->Device->GetFirmwareProgress() > 0.0; }));
  this->Device->Close();
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Closed);
  ASSERT_TRUE(this->BecomesReady());
  this->Bus.With(1, [&](FalconModel& model) { EXPECT_EQ(model.Firmware, file.Bytes); });
}

TEST_F(FalconBringUp, SaysThatNoneIsPluggedIn)
{
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), "No Novint Falcon is plugged in"))
    << this->Device->GetErrorMessage();
}

TEST_F(FalconBringUp, SaysWhichUdevRuleToAddWherePermissionIsMissing)
{
  this->Bus.Plug(1, FalconModel());
  this->Bus.DenyOpening(true);
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  const Text message = this->Device->GetErrorMessage();
  EXPECT_TRUE(Contains(message, "/etc/udev/rules.d/60-novint-falcon.rules")) << message;
  std::ifstream rules(HAPTICS_UDEV_RULES);
  Text line;
  while (std::getline(rules, line) && line[0] == '#')
  {
  }
  ASSERT_FALSE(line.empty()) << HAPTICS_UDEV_RULES;
  EXPECT_TRUE(Contains(message, line)) << "the message and the installed rule must agree\n"
                                       << message;
  this->Bus.DenyOpening(false);
  EXPECT_TRUE(this->BecomesReady()) << "once the rule is there";
}

TEST_F(FalconBringUp, SaysThatAnotherProgramHoldsIt)
{
  this->Bus.Plug(1, FalconModel());
  this->Bus.ClaimByOther(true);
  this->Device->Open();
  ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted));
  EXPECT_TRUE(Contains(this->Device->GetErrorMessage(), "is in use by another program"))
    << this->Device->GetErrorMessage();
}

TEST_F(FalconBringUp, WhatMessagesAdviseEndsTheFault)
{
  const FirmwareFile file(500);
  const auto plug = [&](std::vector<Act> script = {})
  {
    this->Device->Close();
    this->Bus.Unplug(1);
    this->Bus.Plug(1, WithoutFirmware(file, std::move(script)));
  };
  const auto open = [&](const Text& firmware)
  {
    this->Device->SetFirmwareFile(firmware.c_str());
    this->Device->Open();
  };
  const auto give = [&] { this->Device->SetFirmwareFile(file.Path.c_str()); };
  this->Device->Open();
  this->ExpectRemedy("Connect its USB cable and its power supply, and open it again",
    [&] { this->Bus.Plug(1, FalconModel()); });
  this->Device->Close();
  this->Device->SetDeviceIndex(3);
  this->Device->Open();
  this->ExpectRemedy("plugged in, counted from 0. Set another DeviceIndex",
    [&] { this->Device->SetDeviceIndex(0); });

  plug();
  open("");
  this->ExpectRemedy(
    "Set FirmwareFile to the image that came with the device, then open it again", give);
  for (const char* wrong : { "/nowhere/falcon.bin", "/dev/zero" })
  {
    plug();
    open(wrong);
    this->ExpectRemedy("Set FirmwareFile to the image that came with the device.", give);
  }
  plug({ { At::Upload, 0, Do::Silence, Always } });
  open(file.Path);
  this->ExpectRemedy(
    "Unplug it and its power supply, connect both again, and open it again", [&] { plug(); });
  plug({ { At::Upload, 3, Do::Garble, Always } });
  open(file.Path);
  this->ExpectRemedy("Check the cable, leave out hubs, and open it again", [&] { plug(); });

  this->Device->Close();
  this->Bus.ClaimByOther(true);
  this->Device->Open();
  this->ExpectRemedy("is in use by another program or another device object. Close it there",
    [&] { this->Bus.ClaimByOther(false); });
  this->Device->Close();
  this->Bus.DenyOpening(true);
  this->Device->Open();
  this->ExpectRemedy("Put this line into /etc/udev/rules.d/60-novint-falcon.rules, run `udevadm "
                     "control --reload` as root and plug the device in again",
    [&]
    {
      this->Bus.DenyOpening(false); // as the rule does
      plug();
    });
}

TEST_F(FalconBringUp, KeepsTwoDevicesApart)
{
  FalconModel model;
  model.Buttons = 1;
  this->Bus.Plug(1, model);
  model.Buttons = 2;
  this->Bus.Plug(2, model);
  vtkNew<vtkFalconHapticDevice> second;
  Log log;
  this->Watch(second, log);
  second->SetDeviceIndex(1);
  second->Open();
  ASSERT_TRUE(this->BecomesReady());
  ASSERT_TRUE(this->Run(
    [&]
    {
      second->Update();
      return second->IsOpen();
    }))
    << second->GetStatusMessage();
  haptics::DeviceSample sample;
  ASSERT_TRUE(this->Device->GetChannel()->Read(Now(), sample));
  EXPECT_EQ(sample.Buttons, 1u);
  ASSERT_TRUE(second->GetChannel()->Read(0.0, sample));
  EXPECT_EQ(sample.Buttons, 2u);
  this->Bus.Unplug(2);
  EXPECT_TRUE(this->Run(
    [&]
    {
      second->Update();
      return second->GetState() == vtkHapticDevice::Faulted;
    }));
  EXPECT_TRUE(this->Device->IsOpen())
    << "the other one goes on: " << this->Device->GetStatusMessage();

  vtkNew<vtkFalconHapticDevice> third;
  this->Watch(third, log);
  third->Open();
  EXPECT_TRUE(this->Run(
    [&]
    {
      third->Update();
      return Contains(third->GetErrorMessage(), "in use");
    }))
    << third->GetErrorMessage();
}
}
