#ifndef Haptics_CleanPart_h
#define Haptics_CleanPart_h

#include "haptics/Filters/PatchRecord.h"
#include "haptics/Surface/TriangleSurface.h"

#include <optional>

class vtkPolyData;

namespace haptics
{
/// @brief The clean triangles of a few cells of a surface, to ask where a place is against them.
///
/// Each question looks at all of them. World frame.
class CleanPart
{
public:
  /// Cells that cannot be cleaned, which a survey of the whole surface reports, have no triangles.
  CleanPart(vtkPolyData* cells, const CleaningFrame& frame);

  /// How often they are crossed on the way, from their backs less from their fronts: by so much
  /// more they enclose `from` than `to`. None where the way meets an edge, a corner, or a triangle
  /// with its end. Exact.
  std::optional<int> CountCrossings(const Vec3& from, const Vec3& to) const;
  /// Their nearest place; none where there is no triangle.
  std::optional<Vec3> NearestTo(const Vec3& place) const;

private:
  TriangleMesh Mesh;
};
}

#endif
