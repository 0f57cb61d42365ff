#include "haptics/Servo/RealTimePriority.h"

#include <cerrno>
#include <system_error>

#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#endif

namespace haptics
{
namespace
{
// Above ordinary real-time work, below the kernel's own threads at 99.
constexpr int Priority = 80;
}

int RequestRealTimePriority(Urgency urgency) noexcept
{
#ifdef __linux__
  prctl(PR_SET_NAME, urgency == Urgency::Servo ? "haptic servo" : "haptic watchdog", 0UL, 0UL, 0UL);
  // Without real-time priority the kernel may wake a thread 50 us late to save power; not this one.
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
  sched_param parameters{};
  parameters.sched_priority = Priority + (urgency == Urgency::AboveServo ? 1 : 0);
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
#else
  (void)urgency;
  return ENOTSUP;
#endif
}

std::string DescribePriority(int result)
{
  if (result == 0)
  {
    return "The servo thread has real-time priority (SCHED_FIFO " + std::to_string(Priority) + ").";
  }
  return "The servo thread has no real-time priority (" + std::generic_category().message(result) +
    "), so other programs may delay its ticks. Where the system lets users have it (on Linux a "
    "line "
    "like '@haptics - rtprio 90' in /etc/security/limits.conf, then a new login), it is taken by "
    "itself.";
}
}
