#ifndef Haptics_LatestValue_h
#define Haptics_LatestValue_h

#include <array>
#include <atomic>
#include <cstdint>

namespace haptics
{
/// @brief Hands the latest value from one thread to another, wait-free: a triple buffer.
///
/// One thread publishes, one thread reads; neither ever waits, and a value is never torn. Values
/// that nobody read are overwritten. T is assigned by copy, which must not allocate if the
/// publisher is the servo.
///
///     publisher            in the middle           reader
///     [ back  ] --swap-->  [ newest ]  <--swap--  [ front ]
template <typename T>
class LatestValue
{
public:
  explicit LatestValue(const T& initial = T()) { this->Slots.fill(initial); }
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Publishes a value. The publishing thread only.
  void Publish(const T& value)
  {
    this->Slots[this->Back] = value;
    // Release hands the slot's content over; acquire makes sure that the reader is done with the
    // slot that comes back.
    this->Back = this->Middle.exchange(this->Back | Fresh, std::memory_order_acq_rel) & SlotMask;
  }

  /// Takes the newest value, if one came since the last call. The reading thread only.
  bool Update()
  {
    if ((this->Middle.load(std::memory_order_relaxed) & Fresh) == 0)
    {
      return false;
    }
    this->Front = this->Middle.exchange(this->Front, std::memory_order_acq_rel) & SlotMask;
    return true;
  }

  /// The value taken by the last Update(). The reading thread only.
  const T& Get() const { return this->Slots[this->Front]; }

private:
  static constexpr std::uint8_t SlotMask = 3;
  static constexpr std::uint8_t Fresh = 4;
  static constexpr std::size_t CacheLine = 64;

  std::array<T, 3> Slots;
  alignas(CacheLine) std::atomic<std::uint8_t> Middle{ 1 };
  alignas(CacheLine) std::uint8_t Back = 0;
  alignas(CacheLine) std::uint8_t Front = 2;
};
}

#endif
