#ifndef Haptics_LargePages_h
#define Haptics_LargePages_h

#include "vtkHapticsCoreModule.h"

#include <cstddef>
#include <vector>

namespace haptics
{
/// Asks the system to put memory that has not been written to yet into large pages, where it has
/// such (Linux: madvise) and the memory fills several. The servo thread reads a large surface here
/// and there: with pages of 4 KB it waits for their addresses as long as for what they hold. Where
/// the answer is no, nothing changes but that.
VTKHAPTICSCORE_EXPORT void AdviseLargePages(void* memory, std::size_t bytes) noexcept;

/// Reserves what a vector will hold, in large pages. Throws std::bad_alloc.
template <class T>
void ReserveLargePages(std::vector<T>& vector, std::size_t size)
{
  vector.reserve(size);
  AdviseLargePages(vector.data(), vector.capacity() * sizeof(T));
}
}

#endif
