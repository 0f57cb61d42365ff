#ifndef Haptics_SharedExchange_h
#define Haptics_SharedExchange_h

#include <array>
#include <cstddef>
#include <cstdint>

namespace haptics
{
/// Where each value is in the memory that a device of one's own and its servo share.
///
/// All are float64, so that a program in any language can map them as one array. The hand's side is
/// written by the device's program, the force's side by the servo. A sequence is odd while its side
/// is being written and grows by two with each exchange; who reads takes a side only where the
/// sequence was even and the same before and after.
enum SharedValue : std::size_t
{
  HandSequence,    ///< 0 until the first position
  HandPosition,    ///< 3 values [m], device frame
  HandButtons = 4, ///< a whole number; bit i is set while button i is held
  HandLost,        ///< other than 0: the device is lost
  ForceSequence = 8,
  ForceValue,     ///< 3 values [N], device frame
  ForceLive = 12, ///< 1 while a servo renews the force; else there is none
  SharedSize = 16
};

/// What a device's program reports.
struct SharedHand
{
  std::array<double, 3> Position{};
  std::uint32_t Buttons = 0;
  bool IsLost = false;
};

/// @brief Reads and writes the shared memory: one writer and any number of readers a side, none of
/// which waits.
class SharedExchange
{
public:
  /// `values` are SharedSize float64, aligned to 8 bytes, and outlive this object.
  explicit SharedExchange(double* values)
    : Values(values)
  {
  }

  /// What has been written last, and its sequence. False where it is being written just now.
  bool ReadHand(SharedHand& hand, double& sequence) const noexcept
  {
    std::array<double, 5> values;
    if (!this->Read(HandSequence, values, sequence))
    {
      return false;
    }
    hand.Position = { values[0], values[1], values[2] };
    const bool isNumber = values[3] >= 0.0 && values[3] <= 4294967295.0;
    hand.Buttons = isNumber ? static_cast<std::uint32_t>(values[3]) : 0;
    hand.IsLost = values[4] != 0.0; // NaN too
    return true;
  }
  void WriteHand(const SharedHand& hand) noexcept
  {
    this->Write(HandSequence,
      std::array<double, 5>{ hand.Position[0], hand.Position[1], hand.Position[2],
        static_cast<double>(hand.Buttons), hand.IsLost ? 1.0 : 0.0 });
  }

  /// The force; zero where no servo renews it, or where it is being written just now.
  std::array<double, 3> ReadForce(double& sequence) const noexcept
  {
    std::array<double, 3> force;
    const bool isWhole = this->Read(ForceSequence, force, sequence);
    return isWhole && this->Load(ForceLive) == 1.0 ? force : std::array<double, 3>{};
  }
  void WriteForce(const std::array<double, 3>& force) noexcept
  {
    this->Write(ForceSequence, force);
  }
  void SetLive(bool isLive) noexcept { this->Store(ForceLive, isLive ? 1.0 : 0.0); }

private:
  double Load(std::size_t i, int order = __ATOMIC_ACQUIRE) const noexcept
  {
    double value;
    __atomic_load(this->Values + i, &value, order);
    return value;
  }
  void Store(std::size_t i, double value, int order = __ATOMIC_RELEASE) noexcept
  {
    __atomic_store(this->Values + i, &value, order);
  }
  static bool IsWhole(double sequence) noexcept
  {
    constexpr double Largest =
      9007199254740992.0; // 2^53: up to here every whole number is a float64
    return sequence >= 0.0 && sequence < Largest && static_cast<std::int64_t>(sequence) % 2 == 0;
  }

  template <std::size_t N>
  bool Read(std::size_t first, std::array<double, N>& values, double& sequence) const noexcept
  {
    constexpr int Tries = 4;
    for (int i = 0; i < Tries; ++i)
    {
      sequence = this->Load(first);
      if (IsWhole(sequence))
      {
        for (std::size_t k = 0; k < N; ++k)
        {
          values[k] = this->Load(first + 1 + k);
        }
        if (this->Load(first) == sequence)
        {
          return true;
        }
      }
    }
    return false;
  }
  template <std::size_t N>
  void Write(std::size_t first, const std::array<double, N>& values) noexcept
  {
    const double last = this->Load(first, __ATOMIC_RELAXED);
    const double even = IsWhole(last) ? last : 0.0;
    this->Store(first, even + 1.0, __ATOMIC_SEQ_CST);
    for (std::size_t k = 0; k < N; ++k)
    {
      this->Store(first + 1 + k, values[k]);
    }
    this->Store(first, even + 2.0);
  }

  double* Values;
};
}

#endif
