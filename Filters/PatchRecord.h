#ifndef Haptics_PatchRecord_h
#define Haptics_PatchRecord_h

#include "haptics/Surface/SurfacePatch.h"
#include "vtkHapticsFiltersModule.h"
#include "vtkType.h"

#include <array>
#include <map>
#include <memory>
#include <string>

class vtkFieldData;

namespace haptics
{
/// Within which points are cleaned: that of all parts of a surface, not of the one at hand.
struct CleaningFrame
{
  Vec3 Origin{}; ///< middle of the bounds of the used points
  double Diagonal = 0.0;
  double LargestCoordinate = 0.0; ///< largest |coordinate| of a used point
};

/// The finite values' least and greatest of an array of one component.
using ArrayRanges = std::map<std::string, std::array<double, 2>>;

/// @brief What a polydata that is a patch of a surface says of that, and of itself.
///
/// It is kept in field data, so that it goes wherever the patch does: through files, pipelines and
/// ParaView's delivery. Cells and points of the patch have their numbers in the whole surface in
/// arrays of these names, and where points come from in a third.
struct VTKHAPTICSFILTERS_EXPORT PatchRecord
{
  static constexpr const char* CellIds = "HapticWholeCellId";
  static constexpr const char* PointIds = "HapticWholePointId";
  /// Where points were in the version WholeSurface::Before.
  static constexpr const char* StartPoints = "HapticStartPoint";

  WholeSurface Whole;
  CleaningFrame Frame;
  ArrayRanges PointRanges;
  ArrayRanges CellRanges;
  PatchRegion Region;
  PatchEnclosure Enclosure;

  void WriteTo(vtkFieldData* fields) const;
  /// Null where there is none.
  static std::shared_ptr<const PatchRecord> ReadFrom(vtkFieldData* fields);
  /// Copies what a material needs, the ranges of arrays.
  void WriteRangesTo(vtkFieldData* fields) const;
  /// The range of an array of the whole surface; null where `fields` has none.
  static const double* RangeIn(vtkFieldData* fields, bool isPerCell, const char* array);
};
}

#endif
