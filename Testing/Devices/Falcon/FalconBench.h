#ifndef Haptics_FalconBench_h
#define Haptics_FalconBench_h

#include "UsbFs.h"
#include "haptics/Devices/DeviceChannel.h"
#include "vtkFalconHapticDevice.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// @brief A VTK device and the script that it meets, for tests.
class FalconBench : public testing::Test
{
protected:
  FalconBench()
  {
    this->Watch(this->Device, this->Events);
    this->Device->SetGuardianProgram(""); // it knows the machine's own bus only
  }

  void SetUp() override
  {
    if (!UsbFs::IsPossible())
    {
      GTEST_SKIP() << "There are no pseudo-terminals here: mount devpts at /dev/pts.";
    }
  }

  /// Notes states and errors of a device, and keeps errors from the test's output.
  struct Log
  {
    std::vector<std::string> States;
    std::vector<double> Progress;
    int Arrivals = 0;
    int Errors = 0;
  };
  void Watch(vtkFalconHapticDevice* device, Log& log)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&log);
    command->SetCallback(
      [](vtkObject* caller, unsigned long event, void* client, void* data)
      {
        auto* device = static_cast<vtkFalconHapticDevice*>(caller);
        auto* log = static_cast<Log*>(client);
        switch (event)
        {
          case vtkHapticDevice::StateChangedEvent:
            log->States.emplace_back(device->GetStateAsString());
            break;
          case vtkFalconHapticDevice::DeviceArrivedEvent:
            ++log->Arrivals;
            break;
          case vtkCommand::ProgressEvent:
            log->Progress.push_back(*static_cast<double*>(data));
            break;
          case vtkCommand::ErrorEvent:
            ++log->Errors;
            break;
          default:
            break;
        }
      });
    device->AddObserver(vtkCommand::AnyEvent, command);
  }

  /// The time that Run() ticks by [s]; a channel takes a smaller one for a servo started anew.
  static double Now()
  {
    return std::chrono::duration<double>(FalconModel::Clock::now().time_since_epoch()).count();
  }

  /// Updates, and ticks as a servo would with this force [N], until `done` or 5 s are over.
  template <typename Done>
  bool Run(Done done, const std::array<double, 3>& force = {})
  {
    const auto end = FalconModel::Clock::now() + std::chrono::seconds(5);
    while (FalconModel::Clock::now() < end)
    {
      this->Device->Update();
      const auto channel = this->Device->GetChannel();
      haptics::DeviceSample sample;
      if (channel && channel->Read(Now(), sample))
      {
        channel->Write(force);
      }
      if (done())
      {
        return true;
      }
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    return false;
  }
  bool RunUntil(int state, const std::array<double, 3>& force = {})
  {
    return this->Run([&] { return this->Device->GetState() == state; }, force);
  }
  ::testing::AssertionResult BecomesReady()
  {
    this->Device->Open();
    return this->RunUntil(vtkHapticDevice::Ready) ? testing::AssertionSuccess()
                                                  : testing::AssertionFailure()
        << this->Device->GetStateAsString() << ": " << this->Device->GetStatusMessage();
  }

  /// The same of a device that nobody homes (FalconModel::HomesAfter) until it has been seen to
  /// wait for that: a state that passes between two updates is not noted.
  ::testing::AssertionResult IsHomedAndBecomesReady()
  {
    this->Device->Open();
    const bool isSeen = this->RunUntil(vtkHapticDevice::Homing);
    this->Bus.With(1, [](FalconModel& model) { model.HomesAfter = FalconModel().HomesAfter; });
    return isSeen && this->RunUntil(vtkHapticDevice::Ready) ? testing::AssertionSuccess()
                                                            : testing::AssertionFailure()
        << this->Device->GetStateAsString() << ": " << this->Device->GetStatusMessage();
  }

  /// The fault that the device ended with says `words`; after `remedy`, which they name, it opens
  /// and says nothing more.
  void ExpectRemedy(const std::string& words, const std::function<void()>& remedy)
  {
    ASSERT_TRUE(this->RunUntil(vtkHapticDevice::Faulted, { 0.0, 0.0, 1.0 })) << words;
    const std::string said = this->Device->GetErrorMessage();
    EXPECT_NE(said.find(words), std::string::npos) << '"' << words << "\" is not in: " << said;
    remedy();
    EXPECT_TRUE(this->BecomesReady()) << words;
    EXPECT_STREQ(this->Device->GetErrorMessage(), "") << words;
  }

  /// What the device with a port number got.
  haptics::FalconCommand LastCommand(int port = 1)
  {
    return this->Bus.With(port, [](FalconModel& model) { return model.Commands.back(); });
  }
  bool GotForce(int port = 1)
  {
    return this->Bus.With(port,
      [](FalconModel& model)
      {
        for (const haptics::FalconCommand& command : model.Commands)
        {
          if (command.Torques != std::array<std::int16_t, 3>{})
          {
            return true;
          }
        }
        return false;
      });
  }
  /// Lets the device do what a line says, counted from the next packet.
  void PlayFromHere(Act act, int port = 1)
  {
    this->Bus.With(port,
      [act](FalconModel& model) mutable
      {
        act.Nth += model.Served;
        model.Script = { act };
      });
  }
  bool EndsWithoutForce(int port = 1)
  {
    return this->LastCommand(port).Torques == std::array<std::int16_t, 3>{};
  }

  UsbFs Bus; // before libusb is used, and gone after it
  vtkNew<vtkFalconHapticDevice> Device;
  Log Events;
};

#endif
