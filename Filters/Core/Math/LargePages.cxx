#include "haptics/Math/LargePages.h"

#if defined(__linux__)
#include <sys/mman.h>

#include <memory>
#endif

namespace haptics
{
void AdviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept
{
#if defined(__linux__)
  constexpr std::size_t page = std::size_t(2) << 20;
  // Whole pages only: what lies around them is others'.
  if (std::align(page, page, memory, bytes))
  {
    madvise(memory, bytes / page * page, MADV_HUGEPAGE);
  }
#endif
}
}
