#ifndef Haptics_FalconGuardian_h
#define Haptics_FalconGuardian_h

#include "vtkHapticsDevicesModule.h"

#include <string>

namespace haptics
{
/// @brief A process that takes a Falcon's torque away where the one that drives it cannot any more.
///
///     this process --"it pushes", "it does not"--> guardian --zero packet--> Falcon
///                      one byte each time                     when this process has ended, or was
///                                                             stopped, while it pushes
///
/// For what no program can catch: SIGKILL, SIGSTOP, a crash, _exit(). Looks every 20 ms while the
/// device pushes, and sleeps else. Takes the device from the stopped process, which afterwards
/// finds it lost. For the thread of a FalconUsb, but for Find().
class VTKHAPTICSDEVICES_EXPORT FalconGuardian
{
public:
  FalconGuardian() = default;
  ~FalconGuardian() { this->Stop(); }
  FalconGuardian(const FalconGuardian&) = delete;
  FalconGuardian& operator=(const FalconGuardian&) = delete;

  /// The program that belongs to this library, empty where it is not installed.
  static std::string Find();

  /// Starts a program for a device, /dev/bus/usb/BUS/NUMBER. False where it cannot be started.
  bool Start(const std::string& program, const std::string& deviceFile);
  /// Sends it away.
  void Stop();
  /// True before a packet with torque goes out; false once the reply to one without has come. A
  /// system call where that changes, which never waits.
  void SetPushes(bool pushes) noexcept;

private:
  void Send(char sign) noexcept;

  int Socket = -1;
  long Process = 0;
  bool Pushes = false;
};
}

#endif
