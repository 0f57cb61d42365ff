#ifndef Haptics_AnswerBell_h
#define Haptics_AnswerBell_h

#include <semaphore.h>

#include <cerrno>
#include <cstdint>
#include <ctime>

namespace haptics
{
/// The time of the monotonic clock `timeout` [ns] from now.
inline timespec DeadlineIn(std::uint64_t timeout) noexcept
{
  constexpr std::uint64_t NanosecondsInSecond = 1000000000;
  timespec deadline{};
  clock_gettime(CLOCK_MONOTONIC, &deadline);
  const std::uint64_t nanoseconds = static_cast<std::uint64_t>(deadline.tv_nsec) + timeout;
  deadline.tv_sec += static_cast<std::time_t>(nanoseconds / NanosecondsInSecond);
  deadline.tv_nsec = static_cast<long>(nanoseconds % NanosecondsInSecond);
  return deadline;
}

/// @brief Wakes one thread that sleeps; ringing never waits.
class AnswerBell
{
public:
  AnswerBell() { sem_init(&this->Semaphore, 0, 0); }
  ~AnswerBell() { sem_destroy(&this->Semaphore); }
  AnswerBell(const AnswerBell&) = delete;
  AnswerBell& operator=(const AnswerBell&) = delete;

  void Ring() noexcept { sem_post(&this->Semaphore); }
  /// False where it did not ring until the monotonic clock shows `deadline`. Takes one ring.
  bool WaitUntil(const timespec& deadline) noexcept
  {
    int result = 0;
    do
    {
      result = sem_clockwait(&this->Semaphore, CLOCK_MONOTONIC, &deadline);
    } while (result != 0 && errno == EINTR);
    return result == 0;
  }

private:
  sem_t Semaphore;
};
}

#endif
