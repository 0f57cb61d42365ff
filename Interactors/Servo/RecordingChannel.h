#ifndef Haptics_RecordingChannel_h
#define Haptics_RecordingChannel_h

#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/ProcessOwner.h"
#include "haptics/Devices/Recorded/DeviceRecording.h"
#include "haptics/Servo/RingBuffer.h"
#include "vtkHapticsServoModule.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace haptics
{
/// @brief Stands between a servo and a device and records every tick to a file.
///
///     servo --Read, Write--> RecordingChannel --> device
///                                 |  ring of 16,384 ticks, wait-free
///                                 v
///                           a thread of its own --> file, every 10 ms
///
/// The servo thread never writes a file and never waits. Ticks that come while the ring is full
/// (a disk that takes no data for 16 s at 1 kHz) are counted and left out. Where the file takes no
/// more, or was deleted, replaced or cut off by others, recording ends: ticks that are not in the
/// file, or not any more, count as lost. After Finish() each tick is either written or lost.
class VTKHAPTICSSERVO_EXPORT RecordingChannel : public DeviceChannel
{
public:
  explicit RecordingChannel(std::shared_ptr<DeviceChannel> device);
  /// Finishes.
  ~RecordingChannel() override;

  ///@{
  /// GUI thread. Start() makes the file and the thread; false with the cause in `error`. Finish()
  /// writes what is left, once no servo uses the channel any more; false with the cause in `error`
  /// where anything could not be written since Start(). The channel goes on without recording.
  bool Start(const std::string& fileName, const RecordingHeader& header, std::string& error);
  bool Finish(std::string& error);
  /// False in a child of fork(), where it is not to be finished nor destroyed: the thread and the
  /// file are its parent's.
  bool IsHere() const { return this->Owner.IsHere(); }
  ///@}
  ///@{
  /// Why ticks were lost; empty while none were. GUI thread.
  std::string GetFailure() const;
  /// For a servo in virtual time, which ticks faster than a disk writes: waits until at least half
  /// of the ring is free, or nothing is written any more. The servo's thread, before a tick.
  void WaitForRoom() const;
  ///@}
  ///@{
  /// Ticks that are in the file, and ticks that are not. Any thread.
  std::uint64_t GetNumberOfTicks() const noexcept { return this->Written.load(); }
  std::uint64_t GetNumberOfLostTicks() const noexcept { return this->LostTicks.load(); }
  ///@}

  bool Read(double time, DeviceSample& sample) noexcept override;
  void Write(const std::array<double, 3>& force) noexcept override;
  void Settle(std::uint64_t timeout) noexcept override { this->Device->Settle(timeout); }
  bool SetsPace() const noexcept override { return this->Device->SetsPace(); }
  bool WaitForSample(std::uint64_t timeout) noexcept override
  {
    return this->Device->WaitForSample(timeout);
  }
  bool NextTime(double& time) noexcept override { return this->Device->NextTime(time); }
  void Restart() noexcept override { this->Device->Restart(); }
  void Halt() noexcept override { this->Device->Halt(); }
  void Resume() noexcept override { this->Device->Resume(); }

private:
  void Run();
  void Drain();

  const std::shared_ptr<DeviceChannel> Device;
  RingBuffer<RecordedTick> Ring;
  std::atomic<std::uint64_t> Written{ 0 };
  std::atomic<std::uint64_t> LostTicks{ 0 };
  std::atomic<std::uint64_t> Overflows{ 0 }; // those of LostTicks that found the ring full
  std::atomic<std::uint64_t> Pushed{ 0 };    // into the ring
  std::atomic<std::uint64_t> Drained{ 0 };   // of those
  std::atomic<bool> HasFailed{ false };      // Error is there, and does not change any more

  // The servo thread's own.
  RecordedTick Now;
  bool HasSample = false;
  std::uint64_t NextTick = 0;

  // The writing thread's own, while it runs.
  RecordingWriter File;
  std::vector<RecordedTick> Ticks;
  std::string Error;

  const ProcessOwner Owner;
  std::mutex Mutex;
  std::condition_variable Ending;
  bool End = false;
  std::thread Thread;
};
}

#endif
