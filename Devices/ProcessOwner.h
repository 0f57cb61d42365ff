#ifndef Haptics_ProcessOwner_h
#define Haptics_ProcessOwner_h

#include <thread>
#include <utility>

#ifdef __unix__
#include <unistd.h>
#endif

namespace haptics
{
/// @brief Knows whether this is the process that made it, or a child of fork(), which got a copy.
///
/// Of all threads a child has only the one that forked. Whatever waits for another one would wait
/// there for ever, and whatever writes to a device or a file would do so behind its parent's back.
/// Objects with a thread therefore give that up in a child: they neither join it nor end what it
/// holds. Any thread; wait-free.
class ProcessOwner
{
public:
#ifdef __unix__
  bool IsHere() const noexcept
  {
    return getpid() == this->Maker;
  }

private:
  const pid_t Maker = getpid();
#else
  bool IsHere() const noexcept
  {
    return true;
  }
#endif
};

/// For a child: forgets a thread that only its parent has. A std::thread that is destroyed while it
/// can be joined ends the process, and one that does not exist cannot be detached.
inline void GiveUp(std::thread& thread)
{
  new std::thread(std::move(thread));
}
}

#endif
