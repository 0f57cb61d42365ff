#ifndef Haptics_PatchCropper_h
#define Haptics_PatchCropper_h

#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Surface/SurfacePatch.h"
#include "vtkHapticsFiltersModule.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <utility>
#include <vector>

class vtkPoints;
class vtkPolyData;

namespace haptics
{
/// What comes before a part among the parts of a surface.
struct PartOffset
{
  vtkIdType Cells = 0;
  vtkIdType Points = 0;
};

/// @brief Where the polygons of a part are, to crop it often.
///
/// The box of each run of polygons that follow each other: neighbours mostly do, in what readers,
/// contours and scanners give. 48 bytes a run, where a vtkStaticCellLocator takes 70 a triangle
/// and, measured with two million, three seconds to say which are in a box. In whatever order they
/// are, what is found is right.
class VTKHAPTICSFILTERS_EXPORT PolygonRuns
{
public:
  static constexpr vtkIdType Length = 256;

  /// By as many threads as the machine has cores. `starts`: as in CropPart(), which is given the
  /// same.
  explicit PolygonRuns(vtkPolyData* part, vtkPoints* starts = nullptr);
  /// The first polygons of those runs that meet the region, in their order.
  std::vector<vtkIdType> Near(const PatchRegion& region) const;
  /// The first polygons of all runs and how far the boxes of these are from a place, the nearest
  /// first.
  std::vector<std::pair<double, vtkIdType>> ByDistance(const Vec3& place) const;

private:
  std::vector<PartBox> Boxes;
};

/// @brief The polygons and strips of a part of a surface that come near a region, with their
/// arrays.
///
/// All whose box does: so every triangle that meets the region is among them. They keep their
/// order, and the arrays PatchRecord::CellIds and PointIds have their numbers in the part, plus the
/// offset. Ghost cells are left out. The part is only read. `runs`: of the part; null: each polygon
/// is looked at. `starts`: where each of the part's points comes from, of a surface that deforms:
/// what comes near anywhere on that way is among them, and the array PatchRecord::StartPoints has
/// these; null: none.
VTKHAPTICSFILTERS_EXPORT vtkSmartPointer<vtkPolyData> CropPart(vtkPolyData* part,
  const PatchRegion& region, const PartOffset& offset, const PolygonRuns* runs = nullptr,
  vtkPoints* starts = nullptr);

/// @brief The polygon or strip of a part that comes nearest to a place, without arrays.
///
/// No cell where none is nearer than `distance`, which is set to that of what was found. `runs`: of
/// the part; null: each polygon is looked at.
VTKHAPTICSFILTERS_EXPORT vtkSmartPointer<vtkPolyData> CropNearest(
  vtkPolyData* part, const Vec3& place, double& distance, const PolygonRuns* runs = nullptr);
}

#endif
