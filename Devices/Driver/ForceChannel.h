#ifndef Haptics_ForceChannel_h
#define Haptics_ForceChannel_h

#include "haptics/Devices/Driver/ForceLink.h"
#include "haptics/Devices/LinkedChannel.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>
#include <memory>

namespace haptics
{
/// The servo thread's end of a ForceLink.
class VTKHAPTICSDEVICES_EXPORT ForceChannel : public LinkedChannel<ForceLink>
{
public:
  explicit ForceChannel(std::shared_ptr<ForceLink> link);
  ~ForceChannel() override;

  /// True where Read() returned false because no sample came for 0.2 s. Any thread.
  bool HasStarved() const noexcept { return this->Starved.load(std::memory_order_acquire); }

protected:
  bool ReadDevice(double time, DeviceSample& sample) noexcept override;
  void WriteDevice(const std::array<double, 3>& force) noexcept override;

private:
  std::atomic<bool> Starved{ false };
  bool HasForce = false; // the servo thread's own
};
}

#endif
