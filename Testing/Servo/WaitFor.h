#ifndef Haptics_WaitFor_h
#define Haptics_WaitFor_h

#include <chrono>
#include <thread>

/// Waits 20 s at most for a condition, and does `work` between two looks. True as soon as it holds:
/// it is not asked again, as it may hold for a moment only.
template <class Condition, class Work>
bool WaitFor(const Condition& condition, const Work& work)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  do
  {
    if (condition())
    {
      return true;
    }
    work();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (std::chrono::steady_clock::now() < end);
  return condition();
}

template <class Condition>
bool WaitFor(const Condition& condition)
{
  return WaitFor(condition, [] {});
}

#endif
