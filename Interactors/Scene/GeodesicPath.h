#ifndef Haptics_GeodesicPath_h
#define Haptics_GeodesicPath_h

#include "haptics/Math/Vec3.h"
#include "haptics/Surface/TriangleSurface.h"

#include <cstdint>
#include <vector>

namespace haptics
{
/// A point of a surface: on a triangle, world frame.
struct SurfacePoint
{
  std::int32_t Triangle = -1;
  Vec3 Position{};
};

/// A way along a surface.
struct GeodesicPath
{
  double Length = 0.0;      ///< [world unit]; infinite where there is no way
  std::vector<Vec3> Points; ///< world frame, from one end to the other; empty where there is none
};

/// @brief A shortest way along a surface between two of its points.
///
/// Dijkstra's method over the corners and three points of each edge finds which triangles the way
/// crosses (M. Lanthier, A. Maheshwari, J.-R. Sack, "Approximating Weighted Shortest Paths on
/// Polyhedral Surfaces", 1997), and again with fifteen near the way found; then the crossings slide
/// along their edges until the way is straight in the unfolded triangles. So it is exact within
/// those triangles, and never shorter than the shortest. Triangles that only touch in a corner are
/// joined there. For the GUI: it allocates.
GeodesicPath FindGeodesicPath(
  const TriangleSurface& surface, const SurfacePoint& from, const SurfacePoint& to);
}

#endif
