#ifndef Haptics_RingBuffer_h
#define Haptics_RingBuffer_h

#include <atomic>
#include <cstddef>
#include <vector>

namespace haptics
{
/// @brief A queue of fixed size from one thread to one other, wait-free at both ends.
///
/// Allocates in the constructor alone. When it is full Push() refuses: what is in it stays, in
/// order.
template <typename T>
class RingBuffer
{
public:
  /// Holds at least `capacity` values (rounded up to a power of two).
  explicit RingBuffer(std::size_t capacity)
  {
    std::size_t size = 1;
    while (size < capacity)
    {
      size *= 2;
    }
    this->Slots.resize(size);
  }
  RingBuffer(const RingBuffer&) = delete;
  RingBuffer& operator=(const RingBuffer&) = delete;

  std::size_t Capacity() const { return this->Slots.size(); }

  /// True while there is room for Push(). The pushing thread only.
  bool HasRoom() const
  {
    // Acquire: the reader's copy out of the slot is done before it is written again.
    return this->Pushed.load(std::memory_order_relaxed) -
      this->Popped.load(std::memory_order_acquire) <
      this->Slots.size();
  }

  /// Appends a value; false when full. The pushing thread only.
  bool Push(const T& value)
  {
    if (!this->HasRoom())
    {
      return false;
    }
    const std::size_t pushed = this->Pushed.load(std::memory_order_relaxed);
    this->Slots[pushed & (this->Slots.size() - 1)] = value;
    this->Pushed.store(pushed + 1, std::memory_order_release);
    return true;
  }

  /// Takes the oldest value; false when empty. The popping thread only.
  bool Pop(T& value)
  {
    const std::size_t popped = this->Popped.load(std::memory_order_relaxed);
    if (popped == this->Pushed.load(std::memory_order_acquire))
    {
      return false;
    }
    value = this->Slots[popped & (this->Slots.size() - 1)];
    this->Popped.store(popped + 1, std::memory_order_release);
    return true;
  }

private:
  static constexpr std::size_t CacheLine = 64;

  std::vector<T> Slots;
  // Both only grow, and wrap round together; their difference is the number of values held.
  alignas(CacheLine) std::atomic<std::size_t> Pushed{ 0 };
  alignas(CacheLine) std::atomic<std::size_t> Popped{ 0 };
};
}

#endif
