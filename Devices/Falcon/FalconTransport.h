#ifndef Haptics_FalconTransport_h
#define Haptics_FalconTransport_h

#include "haptics/Devices/DevicePhase.h"
#include "haptics/Devices/Falcon/FalconLink.h"
#include "haptics/Devices/ProcessOwner.h"
#include "vtkHapticsDevicesModule.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace haptics
{
class FalconExchange;
class FalconUsb;

/// How a Falcon is brought up.
struct FalconSettings
{
  int DeviceIndex = 0;          ///< which of those plugged in, counted by their place
  std::string FirmwareFile;     ///< needed only where the device has none loaded
  bool OpenOnArrival = false;   ///< bring it up again whenever one is plugged in
  std::string Guardian;         ///< the program of FalconGuardian; empty for none
  double CommandTimeout = 0.02; ///< [s] after which a torque that nobody renewed is withdrawn
};

/// What a Falcon's thread reports.
struct FalconStatus
{
  DevicePhase Phase = DevicePhase::Opening;
  std::string Text;          ///< in a sentence: what goes on, what is wrong, what to do
  double Progress = 0.0;     ///< of the firmware upload, 0 to 1
  unsigned int Arrivals = 0; ///< Falcons seen plugged in so far
  bool RealTime = false;     ///< whether the thread got real-time priority
  /// What the servo talks through; another one each time the device is brought up.
  std::shared_ptr<FalconLink> Link = std::make_shared<FalconLink>();
};

/// @brief Brings one Falcon up and exchanges packets with it at 1 kHz, on a thread of its own.
///
///     Opening -> LoadingFirmware (where none is loaded) -> Homing -> Ready
///        \______________\___________________________________\________\____-> Faulted
///
/// The thread begins with the object. Each exchange sends the servo's latest torques and publishes
/// the reply, through a FalconLink. Torques are clamped together, so that the force keeps its
/// direction. They are zero until the device is ready, in an exchange after one that failed, when
/// nobody renewed them for CommandTimeout, and in the last packet of all, whatever the reason for
/// which the device is let go.
class VTKHAPTICSDEVICES_EXPORT FalconTransport
{
public:
  explicit FalconTransport(const FalconSettings& settings);
  /// Stops, and waits for it: some milliseconds, at most about 100. In a child of fork() it leaves
  /// the device to its parent.
  ~FalconTransport();
  FalconTransport(const FalconTransport&) = delete;
  FalconTransport& operator=(const FalconTransport&) = delete;

  /// Has the thread send zero torque and let go of the device. Does not wait. Any thread.
  void RequestStop() { this->Stop.store(true, std::memory_order_relaxed); }
  /// Any thread but the servo.
  FalconStatus GetStatus() const;

private:
  void Run();
  void RunSessions();
  void Session(FalconUsb& usb);
  void BringUp(FalconUsb& usb, FalconExchange& exchange);
  void Upload(FalconUsb& usb, FalconExchange& exchange);
  template <typename Change>
  void ChangeStatus(Change change);
  void Report(DevicePhase phase, const std::string& text);

  const FalconSettings Settings;
  std::atomic<bool> Stop{ false };
  mutable std::mutex StatusMutex;
  FalconStatus Status;
  const ProcessOwner Owner;
  std::thread Thread; // last: everything is there when it begins
};
}

#endif
