// The driver of Force Dimension's devices against a stub of libdrd.so with the same symbols.
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
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange();
      return this->Device->GetButtons() == 5;
    }));
  double q[4];
  this->Device->GetOrientation(q);
  EXPECT_NEAR(q[0], 0.7071, 1e-3);
  EXPECT_NEAR(q[2], 0.7071, 1e-3) << "up is y here";
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
  const std::string sdk = std::string(testing::TempDir()) + "/fdsdk";
  std::filesystem::create_directories(sdk + "/lib");
  std::ofstream(sdk + "/lib/libdrd.a") << "\n";
  setenv("FDSDK", sdk.c_str(), 1);
  this->Device->SetLibraryFile("");
  EXPECT_TRUE(Says(this->FaultOfOpening(), "only the static")) << this->Device->GetErrorMessage();
  unsetenv("FDSDK");
  std::filesystem::remove_all(sdk);
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
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "hangs"));
  this->Stub.Hangs = false;
  this->Push();
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
