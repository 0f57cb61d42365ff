#ifndef Haptics_DeviceChannel_h
#define Haptics_DeviceChannel_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// What a device reports in one servo tick.
struct DeviceSample
{
  std::array<double, 3> Position{}; ///< HIP, device frame [m]
  std::uint32_t Buttons = 0;        ///< bit i is set while button i is held
  /// Whenever it changes the hand was put down somewhere else, as a mouse can do it and no hand
  /// that is held: the god-object starts anew at Place and goes from there to Position.
  std::uint32_t Placements = 0;
  std::array<double, 3> Place{}; ///< device frame [m]
  /// Whenever it changes the device has let go of the last force by itself, as after a reply that
  /// was lost: the next one grows softly from zero.
  std::uint32_t Releases = 0;
  /// From the force asked for to the hand, as measured now [s]; counts where it is above what the
  /// device states.
  double Latency = 0.0;
};

/// @brief The servo thread's end of a device: plain, wait-free, no vtkObject.
///
/// A vtkHapticDevice makes one when it opens. Read(), Write() and Notice() come in this order, once
/// a tick, from the servo thread alone. None allocates, locks or logs.
class VTKHAPTICSDEVICES_EXPORT DeviceChannel
{
public:
  virtual ~DeviceChannel() = default;

  /// Reads the device at `time` [s] since the servo started, which only ever grows. False: the
  /// device is lost or closed; then the sample is meaningless and the servo asks for no force.
  virtual bool Read(double time, DeviceSample& sample) noexcept = 0;

  /// Asks for a force in the device frame [N], to be held until the next one.
  virtual void Write(const std::array<double, 3>& force) noexcept = 0;

  /// For a hand that is simulated and sees more than its force: the way from the HIP to the
  /// god-object in this tick, device frame [m]; 0 in free space and while clutched. After Write().
  virtual void Notice(const std::array<double, 3>& displacement) noexcept { (void)displacement; }

  /// For a device that gets a force later than Write() returns: sleeps until what was written last
  /// has reached it or cannot any more, at most `timeout` [ns]. A run that has ended is followed by
  /// it, so that a process that goes on to end leaves no force. The servo thread alone.
  virtual void Settle(std::uint64_t timeout) noexcept { (void)timeout; }

  /// True where the device sets the pace: its servo waits for samples, not for a clock.
  virtual bool SetsPace() const noexcept { return false; }
  /// For a device that sets the pace: sleeps until there is a sample that Read() has not given
  /// yet, at most `timeout` [ns]. False where none came. The servo thread alone.
  virtual bool WaitForSample(std::uint64_t timeout) noexcept
  {
    (void)timeout;
    return false;
  }
  /// For a device that has its own time, as a recording has: the time [s] of the sample that comes
  /// next, for servos that run in virtual time. False where it has none. The servo thread alone.
  virtual bool NextTime(double& time) noexcept
  {
    (void)time;
    return false;
  }

  ///@{
  /// Takes the channel for one servo, which is what the calls above rely on, until Unclaim(). False
  /// where another one has it. Any thread but the servo's.
  bool Claim() noexcept { return !this->Claimed.exchange(true, std::memory_order_acq_rel); }
  void Unclaim() noexcept { this->Claimed.store(false, std::memory_order_release); }
  ///@}

  /// A servo begins a run: its time starts at 0 again. GUI thread, before the servo thread starts.
  virtual void Restart() noexcept {}

  ///@{
  /// No force from now on, whatever is written, until Resume(): the servo hangs and cannot write
  /// itself. Halt() is called from a watchdog's thread at any time, Resume() from the servo thread.
  virtual void Halt() noexcept {}
  virtual void Resume() noexcept {}
  ///@}

private:
  std::atomic<bool> Claimed{ false };
};
}

#endif
