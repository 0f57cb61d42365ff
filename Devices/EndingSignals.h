#ifndef Haptics_EndingSignals_h
#define Haptics_EndingSignals_h

#ifdef __unix__
#include <array>
#include <csignal>

namespace haptics
{
/// The signals that ask a process to end.
constexpr std::array<int, 4> EndingSignals{ SIGINT, SIGTERM, SIGHUP, SIGQUIT };

/// For every thread that takes part in taking the force from a hand: the handler of such a signal
/// waits for that, so it must not interrupt one of them. Called first in the thread.
inline void LeaveEndingSignalsToOtherThreads() noexcept
{
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : EndingSignals)
  {
    sigaddset(&signals, signal);
  }
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
