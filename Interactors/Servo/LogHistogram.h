#ifndef Haptics_LogHistogram_h
#define Haptics_LogHistogram_h

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace haptics
{
/// @brief Counts durations [ns] in bins that are 3 % wide, from 1 ns to 18 minutes.
///
/// One thread adds, wait-free and without allocation; any thread may copy the counts meanwhile.
///
/// Each power of two is cut into 32 equal bins; below 32 ns a bin is 1 ns wide. Longer durations
/// count in the last bin.
class LogHistogram
{
public:
  static constexpr int BinsPerOctave = 32; // 2^OctaveShift
  static constexpr int OctaveShift = 5;
  static constexpr int LastExponent = 39;
  static constexpr int NumberOfBins = (LastExponent - OctaveShift + 2) * BinsPerOctave;

  using Counts = std::array<std::uint64_t, NumberOfBins>;

  /// The bin that a duration [ns] counts in.
  static int Bin(std::uint64_t duration)
  {
    if (duration < BinsPerOctave)
    {
      return static_cast<int>(duration);
    }
    if ((duration >> (LastExponent + 1)) != 0)
    {
      return NumberOfBins - 1;
    }
    const int exponent = std::ilogb(static_cast<double>(duration)); // exact below 2^53
    const int part = static_cast<int>(duration >> (exponent - OctaveShift)) - BinsPerOctave;
    return (exponent - OctaveShift + 1) * BinsPerOctave + part;
  }

  /// The shortest duration [ns] that counts in a bin; for NumberOfBins the end of the last.
  static std::uint64_t LowerEdge(int bin)
  {
    if (bin < BinsPerOctave)
    {
      return static_cast<std::uint64_t>(bin);
    }
    const int octave = bin / BinsPerOctave - 1;
    return static_cast<std::uint64_t>(BinsPerOctave + bin % BinsPerOctave) << octave;
  }

  /// Counts a duration [ns]. The adding thread only.
  void Add(std::uint64_t duration)
  {
    // One writer: a plain read and write cannot lose a count, and needs no locked instruction.
    std::atomic<std::uint64_t>& bin = this->Bins[static_cast<std::size_t>(Bin(duration))];
    bin.store(bin.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  /// The counts by now. Any thread.
  Counts Copy() const
  {
    Counts counts;
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      counts[i] = this->Bins[i].load(std::memory_order_relaxed);
    }
    return counts;
  }

  /// Forgets all. Only while no thread adds.
  void Clear()
  {
    for (std::atomic<std::uint64_t>& bin : this->Bins)
    {
      bin.store(0, std::memory_order_relaxed);
    }
  }

private:
  std::array<std::atomic<std::uint64_t>, NumberOfBins> Bins{};
};
}

#endif
