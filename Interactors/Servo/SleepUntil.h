#ifndef Haptics_SleepUntil_h
#define Haptics_SleepUntil_h

#include <cstdint>

namespace haptics
{
/// Sleeps until a moment of MonotonicNow() [ns]; returns at once where it has passed.
void SleepUntil(std::uint64_t moment) noexcept;
}

#endif
