// Devices by the names that users give them.
#include "haptics/Devices/DeviceRegistry.h"
#include "vtkFalconHapticDevice.h"
#include "vtkNew.h"
#include "vtkSimulatedHapticDevice.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkHapticDevice> Create(const char* name)
{
  return vtkSmartPointer<vtkHapticDevice>::Take(vtkHapticDevice::CreateByName(name));
}

TEST(DeviceNames, EveryKnownNameMakesADevice)
{
  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> titles;
  vtkHapticDevice::GetKnownNames(names, titles);
  ASSERT_GE(names->GetNumberOfValues(), 2);
  EXPECT_EQ(names->GetNumberOfValues(), titles->GetNumberOfValues());
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    EXPECT_NE(Create(names->GetValue(i).c_str()), nullptr) << names->GetValue(i);
    EXPECT_EQ(vtkHapticDevice::GetNameProblem(names->GetValue(i).c_str()), "");
    EXPECT_FALSE(titles->GetValue(i).empty());
  }
}

TEST(DeviceNames, AnIdChoosesOneOfAKind)
{
  const auto falcon = Create("falcon:2");
  ASSERT_TRUE(falcon);
  EXPECT_EQ(vtkFalconHapticDevice::SafeDownCast(falcon)->GetDeviceIndex(), 2);
  EXPECT_STREQ(falcon->GetDeviceId(), "2");
  EXPECT_TRUE(Create("simulated")->IsA("vtkSimulatedHapticDevice"));
}

TEST(DeviceNames, WhatIsNoneIsExplainedWithThoseThatThereAre)
{
  for (const char* name : { "phantom", "", "Falcon", "falcon:x", "falcon:99", "simulated:1" })
  {
    EXPECT_EQ(Create(name), nullptr) << name;
    EXPECT_NE(vtkHapticDevice::GetNameProblem(name), "") << name;
  }
  EXPECT_EQ(Create(nullptr), nullptr);
  EXPECT_NE(vtkHapticDevice::GetNameProblem("phantom").find("falcon, "), std::string::npos);
  EXPECT_NE(vtkHapticDevice::GetNameProblem("falcon:x").find("no id"), std::string::npos);
}

TEST(DeviceNames, AllAreListedWithTheirStates)
{
  vtkNew<vtkStringArray> known;
  vtkNew<vtkStringArray> titles;
  vtkHapticDevice::GetKnownNames(known, titles);
  vtkNew<vtkStringArray> names;
  vtkNew<vtkStringArray> states;
  vtkHapticDevice::ListDevices(names, states);
  EXPECT_GE(names->GetNumberOfValues(), known->GetNumberOfValues());
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(vtkHapticDevice::GetNameProblem(names->GetValue(i).c_str()), "");
    EXPECT_FALSE(states->GetValue(i).empty()) << names->GetValue(i);
  }
}

TEST(DeviceNames, ADeviceOfOnesOwnIsKnownAsLongAsItIsRegistered)
{
  {
    const haptics::DeviceRegistration registration(
      "pen", "A pen", []() -> vtkHapticDevice* { return vtkSimulatedHapticDevice::New(); });
    EXPECT_TRUE(Create("pen"));
  }
  EXPECT_FALSE(Create("pen"));
}
}
