#ifndef Haptics_LaneMask_h
#define Haptics_LaneMask_h

#include "haptics/Math/VectorClones.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace haptics
{
/// Eight numbers, or answers of a comparison of vectors: each -1 or 0.
using EightLanes = std::int32_t __attribute__((vector_size(32)));

/// One bit for each lane whose answer is yes, the first the lowest.
HAPTICS_ALWAYS_INLINE unsigned MaskOf(const EightLanes& answers)
{
#if defined(__SSE2__)
  __m128i halves[2];
  std::memcpy(halves, &answers, sizeof(halves));
  const __m128i words = _mm_packs_epi32(halves[0], halves[1]);
  return static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(words, _mm_setzero_si128())));
#else
  const EightLanes bits = answers & EightLanes{ 1, 2, 4, 8, 16, 32, 64, 128 };
  std::uint64_t pairs[4];
  std::memcpy(pairs, &bits, sizeof(pairs));
  const std::uint64_t all = pairs[0] | pairs[1] | pairs[2] | pairs[3];
  return static_cast<unsigned>(all | all >> 32);
#endif
}

/// Places of eight lanes.
struct LanePlaces
{
  alignas(sizeof(EightLanes)) std::int32_t Lane[8];
};

/// For each mask of eight bits the places of those that are set, and after them some that are not.
inline constexpr auto PlacesOfSet = []
{
  std::array<LanePlaces, 256> places{};
  for (std::size_t mask = 0; mask < places.size(); ++mask)
  {
    std::size_t count = 0;
    for (std::int32_t i = 0; i < 8; ++i)
    {
      if ((mask >> i & 1u) != 0)
      {
        places[mask].Lane[count++] = i;
      }
    }
  }
  return places;
}();

/// Puts first those of eight numbers whose bits of the mask are set; how many, is for the caller to
/// count. No branch hangs on the mask: it would be foreseen badly.
HAPTICS_ALWAYS_INLINE void PutSetFirst(unsigned mask, EightLanes& numbers)
{
  EightLanes places;
  std::memcpy(&places, &PlacesOfSet[mask], sizeof(places));
#if defined(__clang__)
  const EightLanes all = numbers;
  for (int i = 0; i < 8; ++i)
  {
    numbers[i] = all[places[i]];
  }
#else
  numbers = __builtin_shuffle(numbers, places);
#endif
}

/// Writes eight pairs of numbers.
HAPTICS_ALWAYS_INLINE void WritePairs(const EightLanes& first, const EightLanes& second, void* to)
{
#if defined(__clang__)
  const EightLanes pairs[2] = { __builtin_shufflevector(first, second, 0, 8, 1, 9, 2, 10, 3, 11),
    __builtin_shufflevector(first, second, 4, 12, 5, 13, 6, 14, 7, 15) };
#else
  const EightLanes pairs[2] = { __builtin_shuffle(
                                  first, second, EightLanes{ 0, 8, 1, 9, 2, 10, 3, 11 }),
    __builtin_shuffle(first, second, EightLanes{ 4, 12, 5, 13, 6, 14, 7, 15 }) };
#endif
  std::memcpy(to, pairs, sizeof(pairs));
}
}

#endif
