// The driver of 3D Systems' devices against a stub of libHD.so with the same symbols.
#include "../../TemporaryFolder.h"
#include "DriverTest.h"
#include "StubBench.h"
#include "StubHd.h"
#include "vtkOpenHapticsDevice.h"
#include "vtkStringArray.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
class OpenHapticsBench : public StubBench<vtkOpenHapticsDevice, StubHdState>
{
public:
  OpenHapticsBench()
    : StubBench(HAPTICS_STUB_HD, "StubHdUse")
  {
  }

  void MoveTo(const Vec& position) override
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->State->Position[i] = 1000.0 * position[i];
    }
  }
  Vec GetForce() const override
  {
    return { this->State->Force[0], this->State->Force[1], this->State->Force[2] };
  }
};

class OpenHaptics : public DriverTest<vtkOpenHapticsDevice>
{
protected:
  OpenHaptics()
  {
    UseState(HAPTICS_STUB_HD, "StubHdUse", &this->Stub);
    this->Device->SetLibraryFile(HAPTICS_STUB_HD);
  }
  ~OpenHaptics() override { this->Device->Close(); } // before Stub ends

  void Push()
  {
    this->PushUntil([this] { return this->Stub.Force[1] > 0.9; });
  }

  StubHdState Stub;
};

TEST_F(OpenHaptics, LimitsAreThoseThatTheDeviceReports)
{
  this->Device->SetForceLimit(50.0);
  ASSERT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_DOUBLE_EQ(this->Device->GetMaximumForce(), 3.3);
  EXPECT_DOUBLE_EQ(this->Device->GetMaximumStiffness(), 500.0);
  EXPECT_DOUBLE_EQ(this->Device->GetWorkspaceBounds()[3], 0.205);
  EXPECT_STREQ(this->Device->GetModelName(), "Touch 00042");
  this->Device->Close();
  this->Device->SetForceLimit(0.5);
  ASSERT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_DOUBLE_EQ(this->Device->GetMaximumForce(), 0.5);
}

TEST_F(OpenHaptics, ADeviceThatReportsNoLimitsGetsThoseOfATouch)
{
  this->Stub.KnowsLimits = false;
  this->Device->SetForceLimit(50.0);
  ASSERT_TRUE(WaitUntilOpen(this->Device)) << this->Device->GetErrorMessage();
  EXPECT_DOUBLE_EQ(this->Device->GetMaximumForce(), 3.3);
  EXPECT_DOUBLE_EQ(this->Device->GetWorkspaceBounds()[1], 0.08);
}

TEST_F(OpenHaptics, TheDeviceIsAskedForByItsName)
{
  this->Device->SetDeviceId("Left");
  this->Stub.Buttons = 2;
  this->Push();
  EXPECT_STREQ(this->Stub.Name, "Left");
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange();
      return this->Device->GetButtons() == 2;
    }));
}

TEST_F(OpenHaptics, AMissingLibraryIsSaidWithWhatToInstall)
{
  this->Device->SetLibraryFile("libNoSuchHD.so");
  EXPECT_FALSE(WaitUntilOpen(this->Device));
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "cannot be loaded"));
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "Install 3D Systems' OpenHaptics"));
}

TEST_F(OpenHaptics, ALibraryWithoutAFunctionIsSaid)
{
  this->Device->SetLibraryFile(HAPTICS_STUB_HD_OLD);
  EXPECT_FALSE(WaitUntilOpen(this->Device));
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "no function hdStopScheduler"));
}

TEST_F(OpenHaptics, WhatKeepsItFromOpeningIsSaid)
{
  for (const auto& [code, words] :
    { std::pair{ 0x0300u, "Check its cables" }, { 0x0302u, "GTDD_HOME" },
      { 0x0301u, "in use by another program" }, { 0x0600u, "no valid licence" },
      { 0x0304u, "scheduler does not run" }, { 0x0102u, "stub error" } })
  {
    this->Stub.InitError = code;
    EXPECT_FALSE(WaitUntilOpen(this->Device));
    EXPECT_TRUE(Says(this->Device->GetErrorMessage(), words)) << this->Device->GetErrorMessage();
    EXPECT_FALSE(this->Stub.IsForceEnabled);
  }
}

TEST_F(OpenHaptics, FaultsOfTheMotorsEndItWithoutForce)
{
  for (const auto& [code, words] :
    { std::pair{ 0x0200u, "motors are warm" }, { 0x0201u, "more force" },
      { 0x0203u, "faster than" }, { 0x0204u, "amplifiers" }, { 0x0302u, "cannot be reached" } })
  {
    this->Push();
    this->Stub.FrameError = code;
    EXPECT_TRUE(Says(this->LossOf(), words)) << this->Device->GetErrorMessage();
    EXPECT_EQ(this->Stub.Force[1], 0.0);
    EXPECT_FALSE(this->Stub.IsOpen);
  }
}

TEST_F(OpenHaptics, WhatMessagesAdviseEndsTheFault)
{
  const auto isMended = [this] { this->Stub.InitError = 0; };
  this->Stub.InitError = 0x0300;
  this->ExpectRemedyOfOpening("Check its cables; run the maker's Touch_Setup", isMended);
  this->Stub.InitError = 0x0301;
  this->ExpectRemedyOfOpening("Close that one, then open it again", isMended);
  this->Stub.InitError = 0x0304;
  this->ExpectRemedyOfOpening("end other programs that use it, then open the device", isMended);
  this->Stub.InitError = 0x0600;
  this->ExpectRemedyOfOpening("Install the licence with the maker's licence manager", isMended);
  this->Stub.InitError = 0x0102;
  this->ExpectRemedyOfOpening("Open the device again", isMended);
  this->Device->SetLibraryFile("libNoSuchHD.so");
  this->ExpectRemedyOfOpening(
    "Install 3D Systems' OpenHaptics and its Touch device driver, or set LibraryFile",
    [this] { this->Device->SetLibraryFile(HAPTICS_STUB_HD); });

  this->Stub.Calibration = 0x5002;
  this->ExpectRemedyOfWaiting("put the stylus into the inkwell until this goes away",
    [this] { this->Stub.Calibration = 0x5001; });
  this->Stub.Style = 1;
  this->Stub.Calibration = 0x5001;
  this->ExpectRemedyOfWaiting(
    "hold the arm in its reset position, all links at right angles, and open "
    "it with ResetEncoders on",
    [this]
    {
      this->Device->Close();
      this->Device->ResetEncodersOn();
    });

  const auto rests = [] {}; // its error is reported once
  const auto isGentler = [this] { this->Device->SetForceLimit(0.5); };
  const auto fails = [this](unsigned int code)
  {
    this->Push();
    this->Stub.FrameError = code;
  };
  fails(0x0200);
  this->ExpectRemedyOfLoss("Let it rest for some minutes, use a smaller ForceLimit", rests);
  fails(0x0203);
  this->ExpectRemedyOfLoss("Hold it more firmly, use a smaller stiffness, then open it", rests);
  fails(0x0204);
  this->ExpectRemedyOfLoss("Switch it off and on, then open it again", rests);
  fails(0x0201);
  this->ExpectRemedyOfLoss("Use a smaller ForceLimit, then open it again", isGentler);
  this->Device->SetForceLimit(3.3);
  this->Push();
  this->Stub.Position[0] = std::numeric_limits<double>::quiet_NaN();
  this->ExpectRemedyOfLoss("Calibrate it with the maker's program, then open it again",
    [this] { this->Stub.Position[0] = 0.0; });
  this->Push();
  this->Stub.IsStalled = true;
  this->ExpectRemedyOfLoss(
    "Check the cable, then open the device again", [this] { this->Stub.IsStalled = false; });

  this->Push();
  vtkNew<vtkOpenHapticsDevice> second;
  second->SetLibraryFile(HAPTICS_STUB_HD);
  EXPECT_FALSE(WaitUntilOpen(second));
  ExpectRemedyOf(second, "Close that one, then open this", [this] { this->Device->Close(); });
}

TEST_F(OpenHaptics, ASchedulerThatStopsCallingIsSaid)
{
  this->Push();
  this->Stub.IsStalled = true;
  EXPECT_TRUE(Says(this->LossOf(), "has not called for 0.2 s"));
}

TEST_F(OpenHaptics, APositionThatIsNoNumberEndsItWithoutForce)
{
  this->Push();
  this->Stub.Position[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Says(this->LossOf(), "cannot be"));
  EXPECT_EQ(this->Stub.Force[1], 0.0);
}

TEST_F(OpenHaptics, ItWaitsForTheInkwellAndSaysSo)
{
  this->Stub.Calibration = 0x5002;
  this->Device->Open();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return Says(this->Device->GetStatusMessage(), "put the stylus into the inkwell");
    }));
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Homing);
  this->Stub.Calibration = 0x5001; // the stylus is in it
  EXPECT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_EQ(this->Stub.UpdatedWith, 4u);
}

TEST_F(OpenHaptics, EncodersAreResetOnlyWhenAsked)
{
  this->Stub.Style = 1;
  this->Stub.Calibration = 0x5001;
  this->Device->Open();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return Says(this->Device->GetStatusMessage(),
        "hold the arm in its reset position, all links at right angles, and open it with "
        "ResetEncoders on");
    }));
  EXPECT_EQ(this->Stub.UpdatedWith, 0u);
  this->Device->Close();
  this->Device->ResetEncodersOn();
  EXPECT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_EQ(this->Stub.UpdatedWith, 1u);
}

TEST_F(OpenHaptics, ASecondObjectGetsTheErrorThatThereIsOneDeviceAProgram)
{
  this->Push();
  vtkNew<vtkOpenHapticsDevice> second;
  second->SetLibraryFile(HAPTICS_STUB_HD);
  EXPECT_FALSE(WaitUntilOpen(second));
  EXPECT_TRUE(Says(second->GetErrorMessage(), "Another device object"));
  EXPECT_TRUE(this->Exchange());
}

TEST_F(OpenHaptics, WhatWasSetUpIsListed)
{
  const TemporaryFolder home;
  vtkNew<vtkStringArray> ids;
  vtkNew<vtkStringArray> states;
  const auto list = [&]
  {
    ids->Initialize();
    states->Initialize();
    this->Device->FindDevices(ids, states);
    return std::string(states->GetValue(0));
  };
  unsetenv("GTDD_HOME");
  const auto ExpectRemedyOfList = [&](const char* words, const std::function<void()>& remedy)
  {
    const std::string before = list();
    EXPECT_TRUE(Says(before, words)) << before;
    remedy();
    const std::string after = list();
    EXPECT_FALSE(Says(after, words)) << after;
  };
  ExpectRemedyOfList("run the maker's Touch_Setup, and set GTDD_HOME to where it writes",
    [&]
    {
      std::filesystem::create_directory(home.File("config"));
      std::ofstream(home.File("config/Left Device.config")) << "\n";
      setenv("GTDD_HOME", home.Path.c_str(), 1);
    });
  ASSERT_EQ(ids->GetNumberOfValues(), 1);
  EXPECT_EQ(ids->GetValue(0), "Left Device");
  unsetenv("GTDD_HOME");
}
}

std::unique_ptr<DriverBench> MakeOpenHapticsBench()
{
  return std::make_unique<OpenHapticsBench>();
}
