#ifndef Haptics_RunRecorder_h
#define Haptics_RunRecorder_h

#include "haptics/Servo/RecordingChannel.h"

#include <cstdint>
#include <memory>
#include <string>

class vtkHapticDevice;

namespace haptics
{
/// @brief Records the runs of a servo, each to a file. GUI thread, but for WaitForRoom().
class RunRecorder
{
public:
  /// Begins a run that is not recorded.
  void Clear();
  /// Begins one that is: what stands between the servo and the device's channel from now on. Null,
  /// with what to do in `error`, where the file cannot be recorded to.
  std::shared_ptr<DeviceChannel> Start(const std::string& file, vtkHapticDevice* device,
    double rate, std::shared_ptr<DeviceChannel> channel, std::string& error);
  /// Ends the run's file. In a child of fork() that is its parent's, and stays open.
  void Finish();
  /// Why ticks were lost: once for each run, else empty.
  std::string TakeFailure();

  /// For a servo in virtual time, see RecordingChannel::WaitForRoom(). Its thread.
  void WaitForRoom() const
  {
    if (this->Channel)
    {
      this->Channel->WaitForRoom();
    }
  }
  ///@{
  /// Ticks of this run or the last one that are in the file, and that are not.
  std::uint64_t GetNumberOfTicks() const
  {
    return this->Channel ? this->Channel->GetNumberOfTicks() : this->Ticks;
  }
  std::uint64_t GetNumberOfLostTicks() const
  {
    return this->Channel ? this->Channel->GetNumberOfLostTicks() : this->LostTicks;
  }
  ///@}

private:
  std::shared_ptr<RecordingChannel> Channel; // null while nothing is recorded
  std::string Failure;                       // of the file that was ended last
  bool IsFailureTaken = false;
  std::uint64_t Ticks = 0;
  std::uint64_t LostTicks = 0;
};
}

#endif
