#ifndef Haptics_SurfaceCleaner_h
#define Haptics_SurfaceCleaner_h

#include "haptics/Filters/PatchRecord.h"
#include "haptics/Math/ProgressCall.h"
#include "haptics/Surface/TriangleSurface.h"

#include "vtkHapticsFiltersModule.h"
#include "vtkType.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace haptics
{
struct CleaningOptions
{
  double MergeTolerance = 0.0;    ///< finite, >= 0
  bool AbsoluteTolerance = false; ///< in world units; otherwise a fraction of the bounds' diagonal
  const std::vector<Side>* CellSides = nullptr; ///< one a cell of the input; null: none
  /// Of the surface that the input is a part of; null: it is the whole, and what has no triangle
  /// fails.
  const CleaningFrame* Frame = nullptr;
};

/// What was found and mended on the way from cells to clean triangles.
struct CleaningReport
{
  std::int64_t MergedPoints = 0;        ///< points that another one now stands for
  std::int64_t UnusedPoints = 0;        ///< points of no remaining triangle
  std::int64_t DegenerateTriangles = 0; ///< without area, dropped
  std::int64_t DuplicateTriangles = 0; ///< equal corners and orientation, all but the first dropped
  std::int64_t FoldedPolygons = 0;     ///< crossing themselves, split into a fan
  std::int64_t GhostCells = 0;         ///< ghosts and blanked cells, dropped
  std::int64_t FlatTriangles = 0; ///< degenerate ones with three corners: moved, they may have area
  vtkIdType FirstFoldedCell = -1;
};

/// @brief Clean triangles, and where each came from.
struct CleanedMesh
{
  TriangleMesh Mesh;                    ///< world frame; every point is used
  std::vector<vtkIdType> OriginalPoint; ///< for each point the first input point that it stands for
  std::vector<vtkIdType> OriginalCell;  ///< for each triangle the input cell
  /// For each triangle the input points at its corners, which have the values there; empty where no
  /// points were merged, as these are the OriginalPoint of its corners then.
  std::vector<Triangle> OriginalCorners;
  std::vector<std::int32_t> KeptPoint; ///< for each input point what stands for it, or -1
  double LargestCoordinate = 0.0;      ///< largest |coordinate| of a used point [world unit]
  double MergedWithin = 0.0;           ///< the merge tolerance [world unit]
  CleaningReport Report;
};

enum class CleaningResult
{
  Done,
  Failed, ///< see the error text
  Aborted
};

/// The bounds of the points that cells which count use: of no cell low is above high. False and
/// `error` where there is something that cannot be touched.
VTKHAPTICSFILTERS_EXPORT bool MeasureUsedPoints(
  vtkPolyData* input, Vec3& low, Vec3& high, std::string& error);

/// Turns the polygons and strips of `input` into clean triangles; its verts and lines are left out.
/// On failure `error` says what is wrong, where, and what to do. Reads `input` only, by as many
/// threads as the machine has cores.
VTKHAPTICSFILTERS_EXPORT CleaningResult CleanSurface(vtkPolyData* input,
  const CleaningOptions& options, const ProgressCall& progress, CleanedMesh& cleaned,
  std::string& error);
}

#endif
