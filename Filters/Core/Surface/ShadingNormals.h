#ifndef Haptics_ShadingNormals_h
#define Haptics_ShadingNormals_h

#include "haptics/Surface/TriangleSurface.h"

#include <array>
#include <vector>

namespace haptics
{
/// @brief A unit normal for each corner of each triangle, three a triangle, surface frame.
///
/// The mean normal, by the angles at the corner, of the facets around it that are joined across
/// edges which turn by no more than `featureAngle` [degrees]. Two facets joined so have the same
/// normals along their edge, so that the interpolated normal is continuous; across any other edge
/// (sharper, a border, oriented against each other) it is not. A triangle without area has zeros.
std::vector<std::array<float, 3>> ShadingNormals(
  const TriangleSurface& surface, double featureAngle);
}

#endif
