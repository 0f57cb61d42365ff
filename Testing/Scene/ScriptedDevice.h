#ifndef Haptics_ScriptedDevice_h
#define Haptics_ScriptedDevice_h

#include "haptics/Devices/MonitoredChannel.h"
#include "vtkHapticDevice.h"

#include "vtkObjectFactory.h"

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

/// @brief A device whose reports and pace a test gives. Any servo may have it next, whatever became
/// of the last one.
class ScriptedDevice : public vtkHapticDevice
{
public:
  static ScriptedDevice* New() { VTK_STANDARD_NEW_BODY(ScriptedDevice); }
  vtkTypeMacro(ScriptedDevice, vtkHapticDevice);
  bool Open() override
  {
    this->BecomeReady(this->Hand);
    return true;
  }
  void Close() override { this->BecomeClosed(); }

  class Channel : public haptics::MonitoredChannel
  {
  public:
    std::atomic<double> Height{ 0.01 }; // [m]; NaN: broken
    std::atomic<int> Delay{ 0 };        // [ms]
    std::atomic<bool> IsSilent{ false };

  protected:
    bool ReadDevice(double, haptics::DeviceSample& sample) noexcept override
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(this->Delay));
      sample.Position = { 0.0, 0.0, this->Height };
      return !this->IsSilent;
    }
    void WriteDevice(const std::array<double, 3>&) noexcept override {}
  };
  std::shared_ptr<Channel> Hand = std::make_shared<Channel>();
};

#endif
