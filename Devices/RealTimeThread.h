#ifndef Haptics_RealTimeThread_h
#define Haptics_RealTimeThread_h

#include <pthread.h>

namespace haptics
{
/// For the thread that talks to a device: what it sends goes out in time then even while the
/// machine is busy. False where the system does not allow it.
inline bool RequestDriverPriority() noexcept
{
  sched_param parameters{};
  parameters.sched_priority = 40; // of 1 to 99, as for a driver
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}
}

#endif
