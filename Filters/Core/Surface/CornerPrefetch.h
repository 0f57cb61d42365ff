#ifndef Haptics_CornerPrefetch_h
#define Haptics_CornerPrefetch_h

#include "haptics/Surface/TriangleSurface.h"

#include <cstdint>

namespace haptics
{
/// Calls for the corners of triangles, which lie anywhere in memory: for all of them before the
/// first is waited for.
inline void PrefetchCorners(
  const TriangleSurface& surface, const std::int32_t* triangles, std::int32_t count)
{
#if defined(__GNUC__)
  for (std::int32_t i = 0; i < count; ++i)
  {
    __builtin_prefetch(&surface.Triangles()[triangles[i]]);
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    for (const std::int32_t corner : surface.Triangles()[triangles[i]])
    {
      __builtin_prefetch(&surface.Points()[corner]);
    }
  }
#else
  (void)surface;
  (void)triangles;
  (void)count;
#endif
}
}

#endif
