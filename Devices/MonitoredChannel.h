#ifndef Haptics_MonitoredChannel_h
#define Haptics_MonitoredChannel_h

#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/LatestValue.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>

namespace haptics
{
/// What went through a channel last.
struct DeviceSnapshot
{
  double Time = 0.0;                ///< [s], as the servo counts it
  std::array<double, 3> Position{}; ///< HIP, device frame [m]
  std::array<double, 3> Force{};    ///< asked for, device frame [N]
  std::uint32_t Buttons = 0;        ///< bit i is set while button i is held
};

/// @brief A channel that can be watched from the GUI thread and that outlives its device safely.
///
/// Devices derive from it and give ReadDevice() and WriteDevice(), both called from the servo
/// thread alone under the rules of DeviceChannel.
class VTKHAPTICSDEVICES_EXPORT MonitoredChannel : public DeviceChannel
{
public:
  bool Read(double time, DeviceSample& sample) noexcept final
  {
    if (this->Shut.load(std::memory_order_acquire))
    {
      return false;
    }
    if (!this->ReadDevice(time, sample))
    {
      this->Lost.store(true, std::memory_order_release);
      return false;
    }
    this->Last.Time = time;
    this->Last.Position = sample.Position;
    this->Last.Buttons = sample.Buttons;
    return true;
  }

  void Write(const std::array<double, 3>& force) noexcept final
  {
    const bool halted = this->Halted.load(std::memory_order_acquire);
    const std::array<double, 3> asked = halted ? std::array<double, 3>{} : force;
    if (!this->Shut.load(std::memory_order_acquire))
    {
      this->WriteDevice(asked);
    }
    this->Last.Force = asked;
    this->Snapshots.Publish(this->Last);
  }

  void Halt() noexcept final
  {
    this->Halted.store(true, std::memory_order_release);
    this->HaltDevice();
  }
  void Resume() noexcept final { this->Halted.store(false, std::memory_order_release); }

  /// From here on Read() returns false and no force reaches the device. GUI thread.
  void Close() noexcept { this->Shut.store(true, std::memory_order_release); }
  /// True once the device has failed to answer. Any thread.
  bool IsLost() const noexcept { return this->Lost.load(std::memory_order_acquire); }
  /// True between Halt() and Resume(). Any thread.
  bool IsHalted() const noexcept { return this->Halted.load(std::memory_order_acquire); }
  /// What went through last, without force while halted; zeros before the first tick. GUI thread.
  DeviceSnapshot Latest() noexcept
  {
    this->Snapshots.Update();
    DeviceSnapshot latest = this->Snapshots.Get();
    if (this->IsHalted())
    {
      latest.Force = {};
    }
    return latest;
  }

protected:
  virtual bool ReadDevice(double time, DeviceSample& sample) noexcept = 0;
  virtual void WriteDevice(const std::array<double, 3>& force) noexcept = 0;
  /// For devices that hold a force by themselves: let go of it now, without the servo thread.
  /// Called from a watchdog's thread, at the same time as any other method.
  virtual void HaltDevice() noexcept {}

private:
  std::atomic<bool> Shut{ false };
  std::atomic<bool> Lost{ false };
  std::atomic<bool> Halted{ false };
  DeviceSnapshot Last; // the servo thread's
  LatestValue<DeviceSnapshot> Snapshots;
};
}

#endif
