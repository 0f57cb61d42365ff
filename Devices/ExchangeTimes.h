#ifndef Haptics_ExchangeTimes_h
#define Haptics_ExchangeTimes_h

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace haptics
{
/// @brief How long exchanges took: counts in bins of 20 us, longer ones in the last bin.
class ExchangeTimes
{
public:
  static constexpr double BinWidth = 20e-6; ///< [s]

  /// One thread.
  void Add(double duration) noexcept
  {
    const double bin = duration / BinWidth;
    const std::size_t last = this->Bins.size() - 1;
    std::atomic<std::uint32_t>& count =
      this->Bins[bin < static_cast<double>(last) ? static_cast<std::size_t>(bin) : last];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  /// The time [s], up to a bin, within which this share of them was over; 0 before the first. Any
  /// thread.
  double Within(double share) const noexcept
  {
    std::uint64_t total = 0;
    for (const auto& bin : this->Bins)
    {
      total += bin.load(std::memory_order_relaxed);
    }
    std::uint64_t passed = 0;
    std::size_t bins = 0;
    while (
      bins < this->Bins.size() && static_cast<double>(passed) < share * static_cast<double>(total))
    {
      passed += this->Bins[bins++].load(std::memory_order_relaxed);
    }
    return static_cast<double>(bins) * BinWidth;
  }

private:
  std::array<std::atomic<std::uint32_t>, 1000> Bins{};
};
}

#endif
