#ifndef Haptics_FormerUser_h
#define Haptics_FormerUser_h

#include <chrono>
#include <thread>

namespace haptics
{
/// @brief Waits until a device is free that another object of this program, closed just now, may
/// still be taking its leave from: half a second at most. Device's thread.
/// `isFree` tries; `context.CheckStop()` is called in between, and may throw. Whether it is free.
template <typename Context, typename Condition>
bool WaitForFormerUser(const Context& context, Condition isFree)
{
  constexpr std::chrono::milliseconds longest{ 500 };
  constexpr std::chrono::milliseconds pause{ 10 };
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!isFree())
  {
    if (std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    context.CheckStop();
    std::this_thread::sleep_for(pause);
  }
  return true;
}
}

#endif
