#ifndef EmergencyStop_h
#define EmergencyStop_h

#include "vtkHapticsInteractorsModule.h"

#include <cstdint>

namespace haptics
{
class ServoCycle;

/// @brief No force is left in a hand when the process ends.
///
/// At SIGINT, SIGTERM, SIGHUP and SIGQUIT, at exit() and at std::terminate() (an exception that
/// nobody caught) every running servo asks for zero force and ends as ServoState::Interrupted; the
/// process waits for that, at most a quarter of a second, and then goes on as it would have:
/// whatever handled the signal before still does (Python's KeyboardInterrupt, for one), and where
/// nothing did the process dies of it. A signal that is ignored stays so. SIGKILL and a crash of
/// the machine cannot be caught: devices time out by themselves.
class VTKHAPTICSINTERACTORS_EXPORT EmergencyStop
{
public:
  /// Takes the process's signals, exit and terminate. To be called at each start of a servo, since
  /// others may have put their handlers in place since. GUI thread.
  static void Install();

  /// For every thread of ours: it must not be the one that a signal interrupts. POSIX only.
  static void LeaveSignalsToOtherThreads() noexcept;

  ///@{
  /// A servo thread holds one while it runs `cycle`. Servo thread, wait-free.
  explicit EmergencyStop(ServoCycle& cycle) noexcept;
  ~EmergencyStop();
  EmergencyStop(const EmergencyStop&) = delete;
  EmergencyStop& operator=(const EmergencyStop&) = delete;
  /// True once the process is about to end: ask for zero force and end.
  bool IsRequested() const noexcept;
  ///@}

private:
  std::uint32_t RequestsBefore;
};
}

#endif
