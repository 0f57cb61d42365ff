#ifndef Haptics_EmergencyStop_h
#define Haptics_EmergencyStop_h

#include "vtkHapticsServoModule.h"

#include <cstdint>

namespace haptics
{
class ServoCycle;

/// @brief No force is left in a hand when the process ends.
///
/// At SIGINT, SIGTERM, SIGHUP and SIGQUIT, at exit() and at std::terminate() (an exception that
/// nobody caught) every running servo asks for zero force and ends as ServoState::Interrupted. The
/// process waits until the devices have got that (DeviceChannel::Settle), at most a quarter of a
/// second, and then goes on as it would have: whatever handled the signal before still does
/// (Python's KeyboardInterrupt, for one), and where nothing did the process dies of it. A signal
/// that is ignored stays so.
///
/// So it is at abort(), quick_exit() and the other signals whose default ends a process (SIGPIPE,
/// SIGXFSZ, SIGALRM, SIGUSR1 ...), where the program has no handler of its own for them. Ctrl+Z
/// (SIGTSTP), SIGTTIN and SIGTTOU take the force away before the process stops; when it goes on the
/// force comes back softly.
///
/// SIGKILL, SIGSTOP, _exit(), a crash (SIGSEGV) and a machine that stops cannot be caught: there a
/// device must time out by itself.
///
/// A window ends in order at SIGINT (Ctrl-C): while something calls CountInterrupts() again and
/// again, a process that has no handler of its own for SIGINT does not die of it. The next SIGINT
/// does end it where that one was not heard.
class VTKHAPTICSSERVO_EXPORT EmergencyStop
{
public:
  /// Takes the process's signals, exit and terminate. To be called at each start of a servo, since
  /// others may have put their handlers in place since. GUI thread.
  static void Install();
  /// Takes the signals again where a handler has taken the place of this one, and calls that one
  /// from then on: Jupyter sets its own before each cell. A running servo's watchdog calls it again
  /// and again. Any thread but the servo's.
  static void KeepSignals();

  /// How often SIGINT has come since the first Install(). Who sees it grow ends its event loop. GUI
  /// thread; it listens for a second after each call.
  static std::uint32_t CountInterrupts() noexcept;
  /// The same for an event loop that begins: without those of the last second that
  /// CountInterrupts() has not returned. They came while the program was on its way into the loop,
  /// and are its end.
  static std::uint32_t CountInterruptsBeforeLoop() noexcept;

  ///@{
  /// A servo thread holds one while it runs `cycle`. Servo thread, wait-free.
  explicit EmergencyStop(ServoCycle& cycle) noexcept;
  ~EmergencyStop();
  EmergencyStop(const EmergencyStop&) = delete;
  EmergencyStop& operator=(const EmergencyStop&) = delete;
  /// True once the process is about to end: ask for zero force and end.
  bool IsRequested() const noexcept;
  /// True while the process is about to stop, or stopped: ask for zero force, then Hold().
  static bool IsSuspended() noexcept;
  /// The device has the zero: returns once the process goes on, or is about to end.
  void Hold() const noexcept;
  ///@}

private:
  std::uint32_t RequestsBefore;
};
}

#endif
