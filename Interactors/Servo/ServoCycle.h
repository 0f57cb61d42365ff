#ifndef Haptics_ServoCycle_h
#define Haptics_ServoCycle_h

#include "haptics/Devices/LatestValue.h"
#include "haptics/Material/ForceModel.h"
#include "haptics/Math/WorkspaceTransform.h"
#include "haptics/Servo/ForceGuard.h"
#include "haptics/Servo/GodObjectExchange.h"
#include "haptics/Servo/RingBuffer.h"
#include "haptics/Tick/ContactTick.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticsServoModule.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace haptics
{
class DeviceChannel;

/// What a servo is doing, or why it asks for no force any more.
enum class ServoState
{
  Stopped,         ///< not started, or stopped on request
  Running,         ///< ticking on its own thread
  Stepping,        ///< ticking in virtual time on the caller's thread
  DeviceLost,      ///< the device did not answer
  InvalidPosition, ///< the device reported a position that is not finite
  InvalidForce,    ///< the god-object's displacement is not finite in the device frame
  Stalled,         ///< two ticks were too far apart
  Overrun,         ///< too many deadlines were missed
  Interrupted      ///< the process was asked to end, or ended
};

/// What the GUI thread may change between two ticks.
struct ServoSettings
{
  WorkspaceTransform DeviceToWorld;
  ForceModel Force; ///< the device's limits already applied
  SafetySettings Safety;
  std::uint64_t Placements = 0; ///< whenever it changes the god-object starts anew at the HIP
  bool IsClutched = false;      ///< the god-object stays, wherever the device goes; no force
  int SubstepLimit = GodObject::DefaultSubstepLimit; ///< of the god-object
  double TipRadius = 0.0; ///< [m], device frame, see GodObject::SetTipRadius()
};

/// @brief One servo tick: position in, god-object, force out. Knows nothing of time or threads.
///
///     Read -> device to world -> GodObject::Advance -> ContactTick -> ForceGuard -> Write
///
/// The first group of methods is the GUI thread's, the second the servo thread's; both may run at
/// once, and none of the second allocates, locks or logs. Any fault asks for zero force in the same
/// tick.
class VTKHAPTICSSERVO_EXPORT ServoCycle
{
public:
  /// Keeps up to `records` ticks that were not yet drained.
  explicit ServoCycle(std::size_t records);
  ~ServoCycle();
  ServoCycle(const ServoCycle&) = delete;
  ServoCycle& operator=(const ServoCycle&) = delete;

  ///@{
  /// GUI thread, at any time.
  void Configure(const ServoSettings& settings) { this->NextSettings.Publish(settings); }
  GodObjectExchange& GetExchange() { return this->Exchange; }
  /// Takes the latest record; true where there is a newer one than at the last call.
  bool UpdateLatest() { return this->Latest.Update(); }
  const TickRecord& GetLatest() const { return this->Latest.Get(); }
  /// Appends the records since the last call, oldest first, and returns their number.
  std::size_t Drain(std::vector<TickRecord>& records);
  /// Records that were lost since Begin() because nobody drained them.
  std::uint64_t GetNumberOfLostRecords() const
  {
    return this->LostRecords.load(std::memory_order_relaxed);
  }
  /// Any thread.
  ServoState GetState() const { return this->State.load(std::memory_order_acquire); }
  /// The device of this run. GUI thread, between Begin() and the next one; servo thread.
  DeviceChannel& GetChannel() const { return *this->Channel; }
  ///@}

  /// Readies the next run with a device and forgets the records of the last. GUI thread, while no
  /// servo thread runs.
  void Begin(std::shared_ptr<DeviceChannel> channel, ServoState state);

  ///@{
  /// Servo thread.
  /// Runs a tick at `time` [s] since the start. False: a fault; no force is asked for, GetState()
  /// says which, and the run is over.
  bool Tick(double time) noexcept;
  /// Asks for zero force, and waits until the device has got it, at most 30 ms.
  void Suspend() noexcept;
  /// Goes on after Suspend(), or a watchdog has halted the device: the force grows softly from
  /// zero.
  void Resume() noexcept;
  /// Ends the run: asks for zero force, becomes `state`, and waits until the device has got the
  /// zero, at most 30 ms; Tick() does so at a fault.
  void End(ServoState state) noexcept;
  ///@}

private:
  void Record(const NumberedGodObject& god, const Vec3& force) noexcept;

  GodObjectExchange Exchange;
  LatestValue<ServoSettings> NextSettings;
  LatestValue<TickRecord> Latest;
  RingBuffer<TickRecord> Records;
  std::atomic<std::uint64_t> LostRecords{ 0 };
  std::atomic<ServoState> State{ ServoState::Stopped };

  // The servo thread's own.
  std::shared_ptr<DeviceChannel> Channel;
  TickRecord Now;
  ContactTick Contacts;
  ForceGuard Guard;
  bool IsFirst = true;
  bool WasClutched = false;
  WorkspaceTransform DeviceToWorld; // of the last tick
  std::uint64_t Placements = 0;
  std::uint32_t DevicePlacements = 0;
  std::uint32_t Releases = 0; // of the device
};
}

#endif
