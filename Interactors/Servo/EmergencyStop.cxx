#include "haptics/Servo/EmergencyStop.h"

#include "haptics/Devices/EndingSignals.h"
#include "haptics/Servo/ServoCycle.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#ifdef __unix__
#include <cerrno>
#include <csignal>
#include <ctime>
#include <pthread.h>
#endif

namespace haptics
{
namespace
{
// Plain atomics: a signal handler may touch nothing else.
std::atomic<std::uint32_t> Requests{ 0 };
std::atomic<int> RunningServos{ 0 };
std::atomic<int> Suspensions{ 0 }; // handlers that stop the process
std::atomic<int> HeldServos{ 0 };  // servos that have taken their force away for that
static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "used in signal handlers");

// What a signal handler knows of its thread.
struct ThreadState
{
  ServoCycle* Cycle = nullptr; ///< that this thread runs; null in all but servo threads
  /// How often it is in HandleSignal(): twice where a handler that came later calls the one that it
  /// has replaced, which was ours.
  int Depth = 0;
  bool IsHeard = false; ///< see IsHeard()
};
#ifdef __unix__
// In the block that each thread has from its begin. What a library has elsewhere is allocated at a
// thread's first access if the library was loaded later: a signal that comes in the middle of an
// allocation would wait for its own thread for ever.
[[gnu::tls_model("initial-exec")]]
#endif
thread_local ThreadState OwnState;

#ifdef __unix__
// What handled each signal before, and what did when it was taken first: none is ever changed or
// freed, so that a handler may read it at any time.
using Action = struct sigaction;
std::array<std::atomic<const Action*>, EndingSignals.size()> Previous{};
std::array<const Action*, EndingSignals.size()> First{};
std::mutex Taking;

const Action* Keep(const Action& action)
{
  static std::vector<std::unique_ptr<const Action>> kept;
  for (const auto& known : kept)
  {
    const bool isSame = (action.sa_flags & SA_SIGINFO) != 0
      ? action.sa_sigaction == known->sa_sigaction
      : action.sa_handler == known->sa_handler;
    if (isSame && action.sa_flags == known->sa_flags)
    {
      return known.get();
    }
  }
  kept.push_back(std::make_unique<const Action>(action));
  return kept.back().get();
}

// SIGINT that came, that CountInterrupts() has returned; when the last one came and until when
// somebody listens [ms].
std::atomic<std::uint32_t> Interrupts{ 0 };
std::atomic<std::uint32_t> HeardInterrupts{ 0 };
std::atomic<std::int64_t> LastInterrupt{ 0 };
std::atomic<std::int64_t> ListensUntil{ 0 };
constexpr std::int64_t Patience = 1000; // [ms]: longer than it takes to draw a picture
static_assert(std::atomic<std::int64_t>::is_always_lock_free, "used in signal handlers");

/// Safe in a signal handler.
std::int64_t Milliseconds() noexcept
{
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec / 1000000;
}

/// Whether an event loop takes this SIGINT for its end.
bool IsHeard() noexcept
{
  const std::int64_t now = Milliseconds();
  LastInterrupt.store(now);
  const std::uint32_t before = Interrupts.fetch_add(1);
  return before == HeardInterrupts.load() && now < ListensUntil.load();
}

void Sleep(long nanoseconds) noexcept
{
  const timespec time{ 0, nanoseconds };
  nanosleep(&time, nullptr);
}
#endif

/// Safe in a signal handler.
void StopAllServos() noexcept
{
  Requests.fetch_add(1, std::memory_order_acq_rel);
  if (OwnState.Cycle)
  {
    // This servo thread ends the process itself and cannot wait for its own next tick.
    OwnState.Cycle->End(ServoState::Interrupted);
    OwnState.Cycle = nullptr;
    RunningServos.fetch_sub(1);
  }
#ifdef __unix__
  constexpr long Pause = 250000; // [ns]
  for (int i = 0; i < 1000 && RunningServos.load(std::memory_order_acquire) > 0; ++i)
  {
    Sleep(Pause);
  }
#endif
}

#ifdef __unix__
void HandleSignal(int signal, siginfo_t* information, void* context)
{
  const int error = errno;
  StopAllServos();
  ThreadState& own = OwnState;
  own.IsHeard = own.Depth == 0 ? signal == SIGINT && IsHeard() : own.IsHeard;
  for (std::size_t i = 0; i < EndingSignals.size(); ++i)
  {
    if (EndingSignals[i] != signal)
    {
      continue;
    }
    const Action& previous = *(own.Depth == 0 ? Previous[i].load() : First[i]);
    ++own.Depth;
    if ((previous.sa_flags & SA_SIGINFO) != 0)
    {
      previous.sa_sigaction(signal, information, context);
    }
    else if (previous.sa_handler != SIG_DFL)
    {
      previous.sa_handler(signal);
    }
    else if (!own.IsHeard)
    {
      sigaction(signal, &previous, nullptr);
      raise(signal);
    }
    --own.Depth;
  }
  errno = error;
}

/// Of a signal that nobody handles: ends the process as it would have. A thread that has crashed
/// and is the servo's own may crash again here, which ends the process at once.
void HandleFatalSignal(int signal)
{
  const int error = errno;
  StopAllServos();
  Action standard{};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  raise(signal); // as soon as this returns
  errno = error;
}

/// Stops the process as it would have, and puts itself back when that goes on.
void HandleStoppingSignal(int signal)
{
  const int error = errno;
  Suspensions.fetch_add(1);
  constexpr long Pause = 250000; // [ns]
  for (int i = 0; i < 1000 && HeldServos.load() < RunningServos.load(); ++i)
  {
    Sleep(Pause);
  }
  Action standard{};
  standard.sa_handler = SIG_DFL;
  Action own{};
  sigaction(signal, &standard, &own);
  sigset_t signals;
  sigset_t before;
  sigemptyset(&signals);
  sigaddset(&signals, signal);
  raise(signal);
  pthread_sigmask(SIG_UNBLOCK, &signals, &before); // stops here
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  sigaction(signal, &own, nullptr);
  Suspensions.fetch_sub(1);
  errno = error;
}

/// Only where the program leaves a signal to its default: its own handlers do what they did.
void TakeUnhandledSignal(int signal, void (*handler)(int))
{
  Action present{};
  sigaction(signal, nullptr, &present);
  if ((present.sa_flags & SA_SIGINFO) == 0 && present.sa_handler == SIG_DFL)
  {
    Action ours{};
    ours.sa_handler = handler;
    ours.sa_flags = SA_RESTART;
    sigemptyset(&ours.sa_mask);
    sigaction(signal, &ours, nullptr);
  }
}

void TakeUnhandledSignals()
{
  for (const int signal : FatalSignals)
  {
    TakeUnhandledSignal(signal, HandleFatalSignal);
  }
  TakeUnhandledSignal(SIGABRT, HandleFatalSignal);
  for (const int signal : CrashSignals)
  {
    TakeUnhandledSignal(signal, HandleFatalSignal);
  }
  for (const int signal : StoppingSignals)
  {
    TakeUnhandledSignal(signal, HandleStoppingSignal);
  }
}

void TakeSignals()
{
  const std::lock_guard<std::mutex> lock(Taking);
  for (std::size_t i = 0; i < EndingSignals.size(); ++i)
  {
    struct sigaction present
    {
    };
    sigaction(EndingSignals[i], nullptr, &present);
    const bool hasInformation = (present.sa_flags & SA_SIGINFO) != 0;
    const bool isIgnored = !hasInformation && present.sa_handler == SIG_IGN;
    const bool isOurs = hasInformation && present.sa_sigaction == HandleSignal;
    if (!isIgnored && !isOurs)
    {
      Previous[i] = Keep(present);
      First[i] = First[i] ? First[i] : Previous[i].load();
      struct sigaction ours
      {
      };
      ours.sa_sigaction = HandleSignal;
      ours.sa_flags = SA_SIGINFO | (present.sa_flags & (SA_RESTART | SA_ONSTACK));
      ours.sa_mask = present.sa_mask;
      sigaction(EndingSignals[i], &ours, nullptr);
    }
  }
}
#endif

std::terminate_handler PreviousTerminate = nullptr;

[[noreturn]] void HandleTerminate()
{
  StopAllServos();
  if (PreviousTerminate)
  {
    PreviousTerminate();
  }
  std::abort();
}

void HandleExit()
{
  StopAllServos();
}

#ifdef __unix__
/// A child has none of its parent's servo threads to wait for.
void ForgetServos()
{
  RunningServos.store(0, std::memory_order_release);
  HeldServos.store(0);
}
#endif
}

void EmergencyStop::Install()
{
#ifdef __unix__
  TakeSignals();
  TakeUnhandledSignals();
#endif
  if (std::get_terminate() != HandleTerminate)
  {
    PreviousTerminate = std::set_terminate(HandleTerminate);
  }
  static const bool isRegistered = std::atexit(HandleExit) == 0;
  static const bool isRegisteredToo = std::at_quick_exit(HandleExit) == 0;
  (void)isRegistered;
  (void)isRegisteredToo;
#ifdef __unix__
  static const bool isTold = pthread_atfork(nullptr, nullptr, ForgetServos) == 0;
  (void)isTold;
#endif
}

void EmergencyStop::KeepSignals()
{
#ifdef __unix__
  TakeSignals();
#endif
}

std::uint32_t EmergencyStop::CountInterrupts() noexcept
{
#ifdef __unix__
  ListensUntil.store(Milliseconds() + Patience);
  const std::uint32_t count = Interrupts.load();
  HeardInterrupts.store(count);
  return count;
#else
  return 0;
#endif
}

std::uint32_t EmergencyStop::CountInterruptsBeforeLoop() noexcept
{
#ifdef __unix__
  const std::uint32_t heard = HeardInterrupts.load();
  const bool isOld = Milliseconds() > LastInterrupt.load() + Patience;
  if (Interrupts.load() == heard || isOld)
  {
    return CountInterrupts();
  }
  ListensUntil.store(Milliseconds() + Patience);
  return heard;
#else
  return 0;
#endif
}

EmergencyStop::EmergencyStop(ServoCycle& cycle) noexcept
  : RequestsBefore(Requests.load(std::memory_order_acquire))
{
  RunningServos.fetch_add(1, std::memory_order_acq_rel);
  OwnState.Cycle = &cycle;
}

EmergencyStop::~EmergencyStop()
{
  if (OwnState.Cycle)
  {
    OwnState.Cycle = nullptr;
    RunningServos.fetch_sub(1, std::memory_order_acq_rel);
  }
}

bool EmergencyStop::IsRequested() const noexcept
{
  return Requests.load(std::memory_order_acquire) != this->RequestsBefore;
}

bool EmergencyStop::IsSuspended() noexcept
{
  return Suspensions.load(std::memory_order_acquire) > 0;
}

void EmergencyStop::Hold() const noexcept
{
  HeldServos.fetch_add(1, std::memory_order_acq_rel);
  while (IsSuspended() && !this->IsRequested())
  {
#ifdef __unix__
    Sleep(1000000); // [ns]
#endif
  }
  HeldServos.fetch_sub(1, std::memory_order_acq_rel);
}
}
