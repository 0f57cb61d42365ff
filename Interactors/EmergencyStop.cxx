#include "EmergencyStop.h"

#include "EndingSignals.h"
#include "ServoCycle.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>

#ifdef __unix__
#include <cerrno>
#include <csignal>
#include <ctime>
#endif

namespace haptics
{
namespace
{
// Plain atomics: a signal handler may touch nothing else.
std::atomic<std::uint32_t> Requests{ 0 };
std::atomic<int> RunningServos{ 0 };
static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "used in signal handlers");

// The cycle that this thread runs; null in all but servo threads.
thread_local ServoCycle* OwnCycle = nullptr;

#ifdef __unix__
std::array<struct sigaction, EndingSignals.size()> Previous;

// SIGINT that came, that CountInterrupts() has returned, and until when somebody listens [ms].
std::atomic<std::uint32_t> Interrupts{ 0 };
std::atomic<std::uint32_t> HeardInterrupts{ 0 };
std::atomic<std::int64_t> ListensUntil{ 0 };
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
  const std::uint32_t before = Interrupts.fetch_add(1);
  return before == HeardInterrupts.load() && Milliseconds() < ListensUntil.load();
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
  if (OwnCycle)
  {
    // This servo thread ends the process itself and cannot wait for its own next tick.
    OwnCycle->End(ServoState::Interrupted);
    OwnCycle = nullptr;
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
  const bool isHeard = signal == SIGINT && IsHeard();
  for (std::size_t i = 0; i < EndingSignals.size(); ++i)
  {
    if (EndingSignals[i] != signal)
    {
      continue;
    }
    const struct sigaction& previous = Previous[i];
    if ((previous.sa_flags & SA_SIGINFO) != 0)
    {
      previous.sa_sigaction(signal, information, context);
    }
    else if (previous.sa_handler != SIG_DFL)
    {
      previous.sa_handler(signal);
    }
    else if (!isHeard)
    {
      sigaction(signal, &previous, nullptr);
      raise(signal);
    }
  }
  errno = error;
}

void TakeSignals()
{
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
      Previous[i] = present;
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
}

void EmergencyStop::Install()
{
#ifdef __unix__
  TakeSignals();
#endif
  if (std::get_terminate() != HandleTerminate)
  {
    PreviousTerminate = std::set_terminate(HandleTerminate);
  }
  static const bool isRegistered = std::atexit(HandleExit) == 0;
  (void)isRegistered;
}

std::uint32_t EmergencyStop::CountInterrupts() noexcept
{
#ifdef __unix__
  constexpr std::int64_t Patience = 1000; // [ms]: longer than it takes to draw a picture
  ListensUntil.store(Milliseconds() + Patience);
  const std::uint32_t count = Interrupts.load();
  HeardInterrupts.store(count);
  return count;
#else
  return 0;
#endif
}

EmergencyStop::EmergencyStop(ServoCycle& cycle) noexcept
  : RequestsBefore(Requests.load(std::memory_order_acquire))
{
  RunningServos.fetch_add(1, std::memory_order_acq_rel);
  OwnCycle = &cycle;
}

EmergencyStop::~EmergencyStop()
{
  if (OwnCycle)
  {
    OwnCycle = nullptr;
    RunningServos.fetch_sub(1, std::memory_order_acq_rel);
  }
}

bool EmergencyStop::IsRequested() const noexcept
{
  return Requests.load(std::memory_order_acquire) != this->RequestsBefore;
}
}
