#ifndef Haptics_TouchedColumns_h
#define Haptics_TouchedColumns_h

#include "haptics/Math/Vec3.h"
#include "vtkNew.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataSetAttributes;
class vtkIdList;
class vtkPolyData;

namespace haptics
{
/// @brief The values of chosen arrays of several surfaces where a hand touches them, tick by tick.
///
/// As double: surfaces may have arrays of other types under one name. Point arrays, which are
/// interpolated between the corners of the triangle, go before cell arrays. NaN in free space, and
/// where a surface has no such array or fewer components. GUI thread.
class TouchedColumns
{
public:
  /// Forgets all ticks, and takes the names for those to come.
  void Restart(const std::vector<std::string>& names);
  bool IsEmpty() const { return this->Columns.empty(); }
  /// A tick that touches `triangle` of the prepared triangles of a surface; null for none. The
  /// weights are those of the triangle's corners, in its own order.
  void Add(vtkPolyData* prepared, vtkIdType triangle, const Vec3& weights);
  /// Adds the arrays; one whose name is taken comes as "Surface" and its name.
  void AddTo(vtkDataSetAttributes* data) const;
  /// The names that no surface that was touched had an array of, in words; empty for none.
  std::string Missing() const;

private:
  struct Column
  {
    std::string Name;
    int Components = 0; ///< not known until one is touched
    std::vector<double> Values;
  };
  std::vector<Column> Columns;
  vtkIdType Ticks = 0;
  vtkNew<vtkIdList> Ids;
};
}

#endif
