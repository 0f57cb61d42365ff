#ifndef TouchedSurface_h
#define TouchedSurface_h

#include "TriangleSurface.h"

#include <memory>
#include <utility>

namespace haptics
{
/// One surface as a god-object touches it: its snapshot, and all that is not geometry.
struct TouchedSurface
{
  /// A snapshot alone is a surface that stands still.
  TouchedSurface(std::shared_ptr<const TriangleSurface> surface)
    : Surface(std::move(surface))
  {
  }

  std::shared_ptr<const TriangleSurface> Surface; ///< not null
};
}

#endif
