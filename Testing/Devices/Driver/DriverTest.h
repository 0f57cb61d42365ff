#ifndef Haptics_DriverTest_h
#define Haptics_DriverTest_h

#include "DriverBench.h"
#include "haptics/Devices/DeviceChannel.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

/// Drives one device as a servo does, tick by tick.
template <class DeviceType>
class DriverTest : public testing::Test
{
protected:
  /// One tick, with 1 N up; whether the device is there.
  bool Exchange()
  {
    haptics::DeviceSample sample;
    this->Channel->WaitForSample(4000000);
    this->Time += 0.001;
    const bool isThere = this->Channel->Read(this->Time, sample);
    this->Channel->Write({ 0.0, isThere ? 1.0 : 0.0, 0.0 });
    return isThere;
  }
  /// Opens the device and goes on until its hardware feels the force.
  void PushUntil(const std::function<bool()>& isFelt)
  {
    ASSERT_TRUE(WaitUntilOpen(this->Device)) << this->Device->GetErrorMessage();
    this->Channel = this->Device->GetChannel();
    this->Time = 0.0;
    ASSERT_TRUE(WaitFor(
      [&]
      {
        this->Exchange();
        return isFelt();
      }));
  }
  /// The fault that opening ends with.
  std::string FaultOfOpening()
  {
    EXPECT_FALSE(WaitUntilOpen(this->Device));
    return this->Device->GetErrorMessage();
  }
  /// Goes on until the device is lost; why.
  std::string LossOf()
  {
    EXPECT_TRUE(WaitFor([this] { return !this->Exchange(); }));
    EXPECT_TRUE(WaitForFault(this->Device));
    return this->Device->GetErrorMessage();
  }

  vtkNew<DeviceType> Device;
  std::shared_ptr<haptics::DeviceChannel> Channel;
  double Time = 0.0;
};

#endif
