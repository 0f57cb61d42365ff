#ifndef Haptics_MonotonicClock_h
#define Haptics_MonotonicClock_h

#include <chrono>
#include <cstdint>

namespace haptics
{
/// Nanoseconds on a clock that is never set back. Any thread; wait-free.
inline std::int64_t MonotonicNow() noexcept
{
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
    std::chrono::steady_clock::now().time_since_epoch())
    .count();
}
}

#endif
