#ifndef Haptics_MonotonicClock_h
#define Haptics_MonotonicClock_h

#include <cstdint>

namespace haptics
{
/// Nanoseconds on a clock that nobody sets. Any thread; wait-free.
std::uint64_t MonotonicNow() noexcept;

/// Sleeps until a moment of that clock [ns]; returns at once where it has passed.
void SleepUntil(std::uint64_t moment) noexcept;
}

#endif
