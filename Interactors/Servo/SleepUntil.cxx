#include "haptics/Servo/SleepUntil.h"

#ifdef __linux__
#include <cerrno>
#include <ctime>
#else
#include <chrono>
#include <thread>
#endif

namespace haptics
{
#ifdef __linux__
namespace
{
constexpr std::uint64_t NanosecondsInSecond = 1000000000;
}

void SleepUntil(std::uint64_t moment) noexcept
{
  timespec until{};
  until.tv_sec = static_cast<time_t>(moment / NanosecondsInSecond);
  until.tv_nsec = static_cast<long>(moment % NanosecondsInSecond);
  // Absolute, so that neither a signal nor the time spent before the call makes it drift.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR)
  {
  }
}
#else
void SleepUntil(std::uint64_t moment) noexcept
{
  std::this_thread::sleep_until(std::chrono::steady_clock::time_point(
    std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::nanoseconds(moment))));
}
#endif
}
