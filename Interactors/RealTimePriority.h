#ifndef RealTimePriority_h
#define RealTimePriority_h

#include <string>

namespace haptics
{
/// Asks for real-time priority for the calling thread. 0 where it was given, else the errno.
int RequestRealTimePriority() noexcept;

/// What came of it, for people: what it means and what to do. `result` as returned above.
std::string DescribePriority(int result);
}

#endif
