// The driver of Force Dimension's devices against a stub of libdrd.so with the same symbols.
#include "../../TemporaryFolder.h"
#include "DriverTest.h"
#include "StubBench.h"
#include "StubDhd.h"
#include "vtkForceDimensionHapticDevice.h"
#include "vtkStringArray.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
class ForceDimensionBench : public StubBench<vtkForceDimensionHapticDevice, StubDhdState>
{
public:
  ForceDimensionBench()
    : StubBench(HAPTICS_STUB_DRD, "StubDhdUse")
  {
  }

  // The vendor's x goes towards the user, y right, z up.
  void MoveTo(const Vec& position) override
  {
    this->State->Position[0] = position[2];
    this->State->Position[1] = position[0];
    this->State->Position[2] = position[1];
  }
  Vec GetForce() const override
  {
    return { this->State->Force[1], this->State->Force[2], this->State->Force[0] };
  }
};

class ForceDimension : public DriverTest<vtkForceDimensionHapticDevice>
{
protected:
  ForceDimension()
  {
    UseState(HAPTICS_STUB_DRD, "StubDhdUse", &this->Stub);
    this->Device->SetLibraryFile(HAPTICS_STUB_DRD);
  }
  ~ForceDimension() override { this->Device->Close(); } // before Stub ends

  void Push()
  {
    this->PushUntil([this] { return this->Stub.Force[2] > 0.9; });
  }

  StubDhdState Stub;
};

TEST_F(ForceDimension, ButtonsAndWristAreReportedAndTheVendorsRegulationStops)
{
  this->Stub.Buttons = 5;
  this->Push();
  EXPECT_FALSE(this->Stub.IsRegulating);
  EXPECT_EQ(this->Stub.AutoInitializations, 0);
  this->ExpectHeldAndTurned();
  EXPECT_STREQ(this->Device->GetModelName(), "omega.3 1234");
}

TEST_F(ForceDimension, SaturatedMotorsAreNoFault)
{
  this->Stub.IsSaturated = true;
  this->Push();
}

TEST_F(ForceDimension, TheArmMovesOnlyWhenAsked)
{
  this->Stub.IsInitialized = false;
  this->Device->Open();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return Says(this->Device->GetStatusMessage(), "AutoInitialize");
    }));
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Homing);
  EXPECT_EQ(this->Stub.AutoInitializations, 0);
  this->Stub.IsInitialized = true; // by hand
  EXPECT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_EQ(this->Stub.AutoInitializations, 0);
  this->Device->Close();
  this->Stub.IsInitialized = false;
  this->Device->AutoInitializeOn();
  EXPECT_TRUE(WaitUntilOpen(this->Device));
  EXPECT_EQ(this->Stub.AutoInitializations, 1);
}

TEST_F(ForceDimension, AnInitialisationThatFailsIsSaid)
{
  this->Stub.IsInitialized = false;
  this->Stub.FailsToInitialize = true;
  this->Device->AutoInitializeOn();
  EXPECT_TRUE(Says(this->FaultOfOpening(), "to initialise the device (timeout)"));
  EXPECT_FALSE(this->Stub.IsOpen);
}

TEST_F(ForceDimension, WhatKeepsItFromOpeningIsSaid)
{
  this->Stub.Count = 0;
  EXPECT_TRUE(Says(this->FaultOfOpening(), "finds no device"));
  this->Stub.Count = 1;
  this->Device->SetDeviceId("2");
  EXPECT_TRUE(Says(this->FaultOfOpening(), "no Force Dimension device number 2: 1 plugged in"));
  this->Device->SetDeviceId("");
  this->Stub.MayOpen = false;
  EXPECT_TRUE(Says(this->FaultOfOpening(), "already in use"));
  this->Stub.MayOpen = true;
  this->Stub.IsSupported = false;
  EXPECT_TRUE(Says(this->FaultOfOpening(), "supports this device"));
  EXPECT_FALSE(this->Stub.IsOpen);
}

TEST_F(ForceDimension, AMissingOrOldLibraryIsSaid)
{
  this->Device->SetLibraryFile("/nowhere/libdrd.so");
  EXPECT_TRUE(Says(this->FaultOfOpening(), "set FDSDK"));
  this->Device->SetLibraryFile(HAPTICS_STUB_DRD_OLD);
  EXPECT_TRUE(Says(this->FaultOfOpening(), "no function drdStop"));
}

TEST_F(ForceDimension, AnOldVersionIsSaid)
{
  this->Stub.Major = 2;
  EXPECT_TRUE(Says(this->FaultOfOpening(), "version 2.0, which is too old"));
}

TEST_F(ForceDimension, AStaticLibraryAloneIsSaid)
{
  const TemporaryFolder sdk;
  std::filesystem::create_directory(sdk.File("lib"));
  std::ofstream(sdk.File("lib/libdrd.a")) << "\n";
  setenv("FDSDK", sdk.Path.c_str(), 1);
  this->Device->SetLibraryFile("");
  EXPECT_TRUE(Says(this->FaultOfOpening(), "only the static")) << this->Device->GetErrorMessage();
  unsetenv("FDSDK");
}

TEST_F(ForceDimension, ADeviceThatIsUnpluggedIsSaid)
{
  this->Push();
  this->Stub.FailsToRead = true;
  EXPECT_TRUE(Says(this->LossOf(), "to read the position (communication error)"));
  EXPECT_EQ(this->Stub.Force[2], 0.0) << "it still listened";
  this->Stub.FailsToRead = false;
  this->Push();
  this->Stub.FailsToSetForce = true;
  EXPECT_TRUE(Says(this->LossOf(), "to send a force"));
  EXPECT_FALSE(this->Stub.IsForceEnabled);
}

TEST_F(ForceDimension, APositionThatIsNoNumberEndsItWithoutForce)
{
  this->Push();
  this->Stub.Position[1] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(Says(this->LossOf(), "cannot be"));
  EXPECT_EQ(this->Stub.Force[2], 0.0);
}

TEST_F(ForceDimension, ALibraryThatHangsEndsTheServoAndNotTheProgram)
{
  this->Push();
  this->Stub.Hangs = true;
  EXPECT_TRUE(WaitFor([this] { return !this->Exchange(); }));
  EXPECT_TRUE(WaitForFault(this->Device));
  ExpectRemedyOf(this->Device,
    "Relieve the machine or start that software anew, then open the device again",
    [this] { this->Stub.Hangs = false; });
  this->Device->Close();
  this->Push();
}

TEST_F(ForceDimension, WhatMessagesAdviseEndsTheFault)
{
  this->Stub.Count = 0;
  this->ExpectRemedyOfOpening(
    "Connect its USB cable and its power supply", [this] { this->Stub.Count = 1; });
  this->Stub.Major = 2;
  this->ExpectRemedyOfOpening(
    "which is too old. Install version 3", [this] { this->Stub.Major = 3; });
  this->Stub.IsInitialized = false;
  this->ExpectRemedyOfWaiting(
    "move the arm through all of its range by hand (a Falcon: pull it out, "
    "push it in); or keep clear of it and open it with AutoInitialize on",
    [this] { this->Stub.IsInitialized = true; });
  this->Stub.IsInitialized = false;
  this->ExpectRemedyOfWaiting("or keep clear of it and open it with AutoInitialize on",
    [this]
    {
      this->Device->Close();
      this->Device->AutoInitializeOn();
    });
  this->Stub.IsInitialized = false;
  this->Stub.FailsToInitialize = true;
  this->ExpectRemedyOfOpening("Check the device's cable, power and emergency stop, then open it",
    [this] { this->Stub.FailsToInitialize = false; });
  this->Push();
  this->Stub.Position[1] = std::numeric_limits<double>::infinity();
  this->ExpectRemedyOfLoss("Initialise it with the vendor's program, then open it again",
    [this] { this->Stub.Position[1] = 0.0; });
}

TEST_F(ForceDimension, ItOpensWithTheLibraryWhereItsMessagesSay)
{
  const TemporaryFolder sdk;
  std::filesystem::create_directory(sdk.File("lib"));
  const auto install = [&](const char* name)
  { std::filesystem::copy_file(HAPTICS_STUB_DRD, sdk.File("lib/") + name); };
  // A copy of the stub has a state of its own, in which one device is plugged in.
  this->Device->SetLibraryFile("");
  std::ofstream(sdk.File("lib/libdrd.a")) << "\n";
  setenv("FDSDK", sdk.Path.c_str(), 1);
  this->ExpectRemedyOfOpening("copy libdrd.so.3 from Force Dimension's SDK to the same folder",
    [&] { install("libdrd.so.3"); });
  std::filesystem::remove(sdk.File("lib/libdrd.so.3"));
  std::filesystem::remove(sdk.File("lib/libdrd.a"));
  unsetenv("FDSDK");
  this->ExpectRemedyOfOpening(
    "Install Force Dimension's SDK, version 3, and set FDSDK to its folder, or set LibraryFile",
    [&]
    {
      install("libdrd.so");
      setenv("FDSDK", sdk.Path.c_str(), 1);
    });
  unsetenv("FDSDK");
  this->ExpectRemedyOfOpening(
    "or set LibraryFile to its libdrd.so", [&] { this->Device->SetLibraryFile(HAPTICS_STUB_DRD); });
}

TEST_F(ForceDimension, IndicesAreItsIds)
{
  EXPECT_TRUE(this->Device->SetDeviceId("3"));
  for (const char* id : { "x", "-1", "16", "1.5", "123456789012" })
  {
    EXPECT_FALSE(this->Device->SetDeviceId(id)) << id;
  }
  EXPECT_STREQ(this->Device->GetDeviceId(), "3");
  this->Stub.Count = 2;
  vtkNew<vtkStringArray> ids;
  vtkNew<vtkStringArray> states;
  this->Device->FindDevices(ids, states);
  ASSERT_EQ(ids->GetNumberOfValues(), 2);
  EXPECT_EQ(ids->GetValue(1), "1");
}
}

std::unique_ptr<DriverBench> MakeForceDimensionBench()
{
  return std::make_unique<ForceDimensionBench>();
}
