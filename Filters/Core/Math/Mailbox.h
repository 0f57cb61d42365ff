#ifndef Haptics_Mailbox_h
#define Haptics_Mailbox_h

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace haptics
{
/// @brief Hands the latest few numbers from one thread to another: a sequence lock without a lock.
///
/// One thread writes and never waits. Readers take what is there and see, by a counter that is odd
/// while numbers change, when it is not whole: then they come again later.
template <std::size_t Size>
class Mailbox
{
public:
  using Numbers = std::array<double, Size>;

  /// The writing thread only.
  void Write(const Numbers& numbers) noexcept
  {
    const std::uint64_t count = this->Count.load(std::memory_order_relaxed);
    this->Count.store(count + 1, std::memory_order_relaxed);
    // A reader that sees one of these sees the odd count too.
    for (std::size_t i = 0; i < Size; ++i)
    {
      this->Values[i].store(numbers[i], std::memory_order_release);
    }
    this->Count.store(count + 2, std::memory_order_release);
  }

  /// Takes the numbers when there are newer ones than `seen` says, and brings it up to date. False:
  /// nothing new, or a writer is just at it.
  bool Read(std::uint64_t& seen, Numbers& numbers) const noexcept
  {
    const std::uint64_t before = this->Count.load(std::memory_order_acquire);
    if (before == seen || before % 2 == 1)
    {
      return false;
    }
    Numbers taken;
    for (std::size_t i = 0; i < Size; ++i)
    {
      taken[i] = this->Values[i].load(std::memory_order_acquire);
    }
    if (this->Count.load(std::memory_order_relaxed) != before)
    {
      return false;
    }
    seen = before;
    numbers = taken;
    return true;
  }

private:
  std::atomic<std::uint64_t> Count{ 0 };
  std::array<std::atomic<double>, Size> Values{};
};
}

#endif
