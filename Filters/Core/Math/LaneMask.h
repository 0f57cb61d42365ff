#ifndef Haptics_LaneMask_h
#define Haptics_LaneMask_h

#include "haptics/Math/VectorClones.h"

#include <cstdint>
#include <cstring>

namespace haptics
{
/// Eight answers of a comparison of vectors: each -1 or 0.
using EightLanes = std::int32_t __attribute__((vector_size(32)));

/// One bit for each lane whose answer is yes, the first the lowest.
HAPTICS_ALWAYS_INLINE unsigned MaskOf(const EightLanes& answers)
{
  const EightLanes bits = answers & EightLanes{ 1, 2, 4, 8, 16, 32, 64, 128 };
  std::uint64_t pairs[4];
  std::memcpy(pairs, &bits, sizeof(pairs));
  const std::uint64_t all = pairs[0] | pairs[1] | pairs[2] | pairs[3];
  return static_cast<unsigned>(all | all >> 32);
}
}

#endif
