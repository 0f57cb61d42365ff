#ifndef Haptics_FlatTriangles_h
#define Haptics_FlatTriangles_h

#include "haptics/Filters/SurfaceCleaner.h"

#include <vector>

namespace haptics
{
/// @brief Closes the seams that triangles without area leave where they are dropped.
///
///     +--- r ---+            +--- r ---+
///     |         |            |    |    |
///     p ------- q     to     p -- m -- q
///     p -- m -- q            p -- m -- q
///     |    |    |            |    |    |
///
/// A flat triangle p m q, m on the edge p q, joins facets that have the corner m to a facet p q r
/// that has not. Dropping it would leave the surface open, though there is no gap to be seen. So
/// the facet takes the corner in and becomes two.
///
/// `flat`: triangles without area but with three different corners, oriented as in the surface. One
/// that joins nothing changes nothing. `points`: where the corners are, in any frame. The corner
/// that a facet takes in has the values of the point that it stands for.
void CloseFlatTriangles(
  const std::vector<Vec3>& points, std::vector<Triangle> flat, CleanedMesh& cleaned);
}

#endif
