#ifndef Haptics_DriverThread_h
#define Haptics_DriverThread_h

#include "haptics/Devices/Driver/DeviceDriver.h"
#include "haptics/Devices/ProcessOwner.h"

#include <memory>
#include <thread>

namespace haptics
{
/// @brief Brings one device up and exchanges with it, on a thread of its own.
///
///     Opening -> Homing (where it has to be calibrated) -> Ready
///        \___________\______________________________________\____-> Faulted
///
/// The thread begins with the object. Whatever the reason for which a device is let go of, its
/// driver's Close() has left it without force before the reason is reported.
class DriverThread
{
public:
  /// Forces are shortened to `forceLimit` [N], or to what the device reports where that is less. A
  /// device that faulted is brought up again every half second where `reconnects`. Throws
  /// std::system_error where the system gives no thread.
  DriverThread(std::unique_ptr<DeviceDriver> driver, double forceLimit, bool reconnects);
  /// Stops, and waits for it: some milliseconds, at most 100 and what a vendor's library takes. One
  /// that does not return for 2 s is given up, with its thread. In a child of fork() the device is
  /// left to its parent.
  ~DriverThread();
  DriverThread(const DriverThread&) = delete;
  DriverThread& operator=(const DriverThread&) = delete;

  /// Has the thread let go of the device. Does not wait. Any thread.
  void RequestStop();
  /// Any thread but the servo.
  DriverStatus GetStatus() const;

private:
  class Session;
  const std::shared_ptr<Session> Work; ///< outlives a thread that was given up
  const ProcessOwner Owner;
  std::thread Thread; // last: everything is there when it begins
};
}

#endif
