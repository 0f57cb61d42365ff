#ifndef Haptics_TouchedArrays_h
#define Haptics_TouchedArrays_h

#include "haptics/Math/Vec3.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkCellData;
class vtkIdList;
class vtkPointData;
class vtkPolyData;

namespace haptics
{
/// @brief The values of a surface's arrays where a path touches it, tick by tick. GUI thread.
///
/// Point arrays are interpolated between the corners of the triangle that pushes most, cell arrays
/// are those of its cell. In free space floating-point values are NaN, all others 0 or empty.
class TouchedArrays
{
public:
  /// `prepared`: the surface's triangles with their arrays; `names`: those that are wanted, empty
  /// for all.
  TouchedArrays(vtkPolyData* prepared, const std::vector<std::string>& names, vtkIdType ticks);
  ~TouchedArrays();
  TouchedArrays(const TouchedArrays&) = delete;
  TouchedArrays& operator=(const TouchedArrays&) = delete;

  /// The names that no array has.
  const std::vector<std::string>& Missing() const { return this->MissingNames; }
  /// From here on the surface is `prepared`, another patch of it. False where that has other
  /// arrays.
  bool Continue(vtkPolyData* prepared);
  /// A tick that touches `triangle`, or none where that is -1. Each tick once, in order.
  void Add(vtkIdType tick, vtkIdType triangle, const Vec3& weights);
  /// Adds the arrays; one whose name is taken comes as "Surface" and its name.
  void AddTo(vtkPointData* data) const;

private:
  vtkPolyData* Prepared;
  vtkNew<vtkPointData> PointSource;
  vtkNew<vtkCellData> CellSource;
  vtkNew<vtkPointData> PointValues;
  vtkNew<vtkCellData> CellValues;
  vtkNew<vtkIdList> Ids;
  std::vector<std::string> Names;
  std::vector<std::string> MissingNames;
};
}

#endif
