#ifndef Haptics_DriverTest_h
#define Haptics_DriverTest_h

#include "DriverBench.h"
#include "haptics/Devices/DeviceChannel.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

/// The fault that a device ended with says `words`; after `remedy`, which they name, it opens and
/// says nothing more.
inline void ExpectRemedyOf(
  vtkDriverHapticDevice* device, const std::string& words, const std::function<void()>& remedy)
{
  EXPECT_EQ(device->GetState(), vtkHapticDevice::Faulted) << words;
  EXPECT_TRUE(Says(device->GetErrorMessage(), words)) << device->GetErrorMessage();
  remedy();
  EXPECT_TRUE(WaitUntilOpen(device)) << words << ": " << device->GetErrorMessage();
  EXPECT_STREQ(device->GetErrorMessage(), "") << words;
}

/// Drives one device as a servo does, tick by tick.
template <class DeviceType>
class DriverTest : public testing::Test
{
protected:
  /// One tick, with 1 N up; whether the device is there.
  bool Exchange()
  {
    haptics::DeviceSample sample;
    if (!this->Channel)
    {
      return false; // it did not open, which is a failure already
    }
    this->Channel->WaitForSample(4000000);
    this->Time += 0.001;
    const bool isThere = this->Channel->Read(this->Time, sample);
    this->Channel->Write({ 0.0, isThere ? 1.0 : 0.0, 0.0 });
    return isThere;
  }
  /// Opens the device and goes on until its hardware has the force.
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
  /// Goes on until buttons 0 and 2 are held, with the grip turned by a quarter about y, which is
  /// up.
  void ExpectHeldAndTurned()
  {
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

  /// As ExpectRemedyOf(), of a fault that opening ends with.
  void ExpectRemedyOfOpening(const std::string& words, const std::function<void()>& remedy)
  {
    this->Device->Close();
    this->FaultOfOpening();
    ExpectRemedyOf(this->Device, words, remedy);
    this->Device->Close();
  }
  /// As ExpectRemedyOf(), of a device that is lost once it is in use.
  void ExpectRemedyOfLoss(const std::string& words, const std::function<void()>& remedy)
  {
    this->LossOf();
    ExpectRemedyOf(this->Device, words, remedy);
    this->Device->Close();
  }

  /// While it opens the device waits and says `words`; after `remedy` it opens.
  void ExpectRemedyOfWaiting(const std::string& words, const std::function<void()>& remedy)
  {
    this->Device->Open();
    EXPECT_TRUE(WaitFor(
      [&]
      {
        this->Device->Update();
        return Says(this->Device->GetStatusMessage(), words);
      }))
      << words << ": " << this->Device->GetStatusMessage();
    EXPECT_FALSE(this->Device->IsOpen()) << words;
    remedy();
    EXPECT_TRUE(WaitUntilOpen(this->Device)) << words << ": " << this->Device->GetErrorMessage();
    this->Device->Close();
  }

  vtkNew<DeviceType> Device;
  std::shared_ptr<haptics::DeviceChannel> Channel;
  double Time = 0.0;
};

#endif
