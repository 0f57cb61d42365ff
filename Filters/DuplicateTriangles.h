#ifndef Haptics_DuplicateTriangles_h
#define Haptics_DuplicateTriangles_h

#include "haptics/Surface/TriangleSurface.h"

#include "vtkType.h"

#include <cstdint>
#include <vector>

namespace haptics
{
/// Keeps the first of all triangles with the same corners and orientation, drops the cell and the
/// original corners (which may be empty) of each other one, and returns how many were dropped. One
/// that faces the other way is no duplicate. Where the triangles have sides, what is kept is
/// touched from all that its duplicates were.
std::int64_t DropDuplicateTriangles(TriangleMesh& mesh, std::vector<vtkIdType>& originalCells,
  std::vector<Triangle>& originalCorners);
}

#endif
