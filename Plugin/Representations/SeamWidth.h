#ifndef Haptics_SeamWidth_h
#define Haptics_SeamWidth_h

#include <limits>

namespace haptics
{
/// How far apart two processes may place the same point [world unit]: some units of the last place
/// of the precision that points are stored in.
inline double SeamWidth(double largestCoordinate, bool areFloats)
{
  return 8.0 * largestCoordinate *
    (areFloats ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
}
}

#endif
