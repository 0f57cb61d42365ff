#ifndef Haptics_DataPoints_h
#define Haptics_DataPoints_h

#include "haptics/Surface/TriangleSurface.h"
#include "vtkHapticsFiltersModule.h"
#include "vtkType.h"

#include <vector>

class vtkDataSetAttributes;
class vtkPolyData;

namespace haptics
{
/// @brief Points that a surface has once and data has several times.
///
/// Where points lie at the same place, a surface merges them: contact needs to know which triangles
/// are neighbours. But where an array has other values at each of them (creases, boxes, materials,
/// seams of texture coordinates, discontinuous Galerkin) each cell keeps those of its own: the
/// geometry with the data has a point for each.
///
///     surface   ---- o ----        data   ---- o  o ----
///                                              0  100
struct DataPoints
{
  /// For each corner of each triangle the point of the geometry with the data; empty where that is
  /// the surface's own.
  std::vector<Triangle> Corners;
  std::vector<vtkIdType> Originals;     ///< for each point that was added the input's
  std::vector<std::int32_t> MergedWith; ///< and the surface's, which lies at the same place
};

/// Finds which points have to be added. `triangles`: of the surface; `originalCorners`: for each of
/// their corners the input's point, or empty; `originals`: for each point of the surface the
/// input's point that it stands for. Ids and ghosts are no data.
DataPoints FindDataPoints(const std::vector<Triangle>& triangles,
  const std::vector<Triangle>& originalCorners, const vtkIdType* originals, std::size_t points,
  vtkDataSetAttributes* data, vtkIdType inputPoints);

/// For each triangle of `surface` the points of `prepared`, its geometry with the data, in the
/// order of the surface's corners; empty where they are the surface's own. A mirrored actor's
/// surface has the second and third corner exchanged.
VTKHAPTICSFILTERS_EXPORT std::vector<Triangle> DataCorners(
  vtkPolyData* prepared, const TriangleSurface& surface);

/// Whether `surface` has the second and third corner of each triangle of `prepared` exchanged.
VTKHAPTICSFILTERS_EXPORT bool HasExchangedCorners(
  vtkPolyData* prepared, const TriangleSurface& surface);
}

#endif
