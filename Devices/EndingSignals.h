#ifndef Haptics_EndingSignals_h
#define Haptics_EndingSignals_h

#ifdef __unix__
#include <array>
#include <csignal>

namespace haptics
{
/// The signals that ask a process to end.
constexpr std::array<int, 4> EndingSignals{ SIGINT, SIGTERM, SIGHUP, SIGQUIT };
/// Those that end a process which has no handler of its own for them. (SIGABRT as well, which is
/// not here: whoever calls abort() cannot leave it to another thread.)
constexpr std::array FatalSignals{
  SIGPIPE, SIGXFSZ, SIGALRM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU, SIGIO
#ifdef SIGPWR
  ,
  SIGPWR
#endif
};
/// Those of a crash. Never blocked: a thread that crashes then is killed at once.
inline constexpr std::array CrashSignals{ SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS };
/// Those that stop such a process: Ctrl+Z, and a job in the background that asks its terminal.
constexpr std::array StoppingSignals{ SIGTSTP, SIGTTIN, SIGTTOU };

/// For every thread that takes part in taking the force from a hand: the handler of such a signal
/// waits for that, so it must not interrupt one of them. Called first in the thread. (What such a
/// thread writes to a full pipe or file then fails, and does not end the process.)
inline void LeaveEndingSignalsToOtherThreads() noexcept
{
  sigset_t signals;
  sigemptyset(&signals);
  const auto add = [&signals](const auto& list)
  {
    for (const int signal : list)
    {
      sigaddset(&signals, signal);
    }
  };
  add(EndingSignals);
  add(FatalSignals);
  add(StoppingSignals);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}
}
#else
namespace haptics
{
inline void LeaveEndingSignalsToOtherThreads() noexcept {}
}
#endif

#endif
