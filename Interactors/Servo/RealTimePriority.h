#ifndef Haptics_RealTimePriority_h
#define Haptics_RealTimePriority_h

#include <string>

namespace haptics
{
/// How urgent a thread is among ours.
enum class Urgency
{
  Servo,
  AboveServo ///< for who watches the servo
};

/// Asks for real-time priority for the calling thread, and names it for top -H and debuggers. 0
/// where the priority was given, else the errno.
int RequestRealTimePriority(Urgency urgency) noexcept;

/// What came of it, as a message: what it means and what to do. `result` as returned above.
std::string DescribePriority(int result);
}

#endif
