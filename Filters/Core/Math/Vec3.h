#ifndef Haptics_Vec3_h
#define Haptics_Vec3_h

#include <array>

namespace haptics
{
/// A point or vector in three dimensions; the frame and unit are named where one is used.
/// `data()` is the `double[3]` that VTK speaks. Inside the module the arithmetic is GLM's.
using Vec3 = std::array<double, 3>;

/// Coordinates have to be smaller than this, so that products of four of them stay finite.
constexpr double LargestCoordinate = 1e70;
}

#endif
