#ifndef Haptics_ForceChannel_h
#define Haptics_ForceChannel_h

#include "haptics/Devices/MonitoredChannel.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace haptics
{
struct ForceLink;

/// @brief The servo thread's end of a ForceLink. The servo waits for the device's samples.
class VTKHAPTICSDEVICES_EXPORT ForceChannel : public MonitoredChannel
{
public:
  explicit ForceChannel(std::shared_ptr<ForceLink> link);
  ~ForceChannel() override;

  bool SetsPace() const noexcept override { return true; }
  bool WaitForSample(std::uint64_t timeout) noexcept override;
  void Settle(std::uint64_t timeout) noexcept override;

  /// True where Read() returned false because no sample came for 0.2 s. Any thread.
  bool HasStarved() const noexcept { return this->Starved.load(std::memory_order_acquire); }

protected:
  bool ReadDevice(double time, DeviceSample& sample) noexcept override;
  void WriteDevice(const std::array<double, 3>& force) noexcept override;
  void HaltDevice() noexcept override;

private:
  const std::shared_ptr<ForceLink> Link;
  std::atomic<bool> Starved{ false };

  // The servo thread's own.
  bool TookAnswer = false; // by WaitForSample()
  double Answered = 0.0;   // when the last new answer was read [s]
  bool IsFresh = false;    // the position is new enough for a force
  std::uint32_t OwnReleases = 0;
};
}

#endif
