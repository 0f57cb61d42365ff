#ifndef Haptics_SurfaceReport_h
#define Haptics_SurfaceReport_h

#include "haptics/Math/ProgressCall.h"
#include "haptics/Math/Vec3.h"
#include "vtkHapticsCoreModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace haptics
{
/// For each triangle the neighbour across its edges 0-1, 1-2 and 2-0; see the two constants below.
using Neighbours = std::vector<std::array<std::int32_t, 3>>;
constexpr std::int32_t BoundaryEdge = -1;    ///< no triangle on the other side
constexpr std::int32_t NonManifoldEdge = -2; ///< more than two triangles share the edge

/// @brief The topology of a triangle surface: what is needed to choose the side to touch, and
/// what explains a mesh whose contact does not look right.
struct SurfaceReport
{
  std::int64_t BoundaryEdges = 0;    ///< edges with one triangle
  std::int64_t NonManifoldEdges = 0; ///< edges with more than two triangles
  std::int64_t FlippedEdges = 0;     ///< edges whose two triangles are oriented against each other
  std::int64_t Components = 0;       ///< pieces connected through edges
  std::int64_t InsideOutComponents = 0; ///< closed pieces whose normals point into their solid
  bool Closed = false;                  ///< no boundary edge and no non-manifold edge
  bool Oriented = false;                ///< no flipped edge and no non-manifold edge
};

/// Finds the neighbours of each triangle and reports the topology.
/// `points` may be in any frame; O(n log n) time, by several threads. What it finds means nothing
/// where `progress` has stopped it.
VTKHAPTICSCORE_EXPORT SurfaceReport AnalyseSurface(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, Neighbours& neighbours,
  const ProgressCall& progress = {});
}

#endif
