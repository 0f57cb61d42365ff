#ifndef DuplicateTriangles_h
#define DuplicateTriangles_h

#include "TriangleSurface.h"

#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace haptics
{
/// Keeps the first of all triangles with the same corners and orientation, drops its cell with each
/// other one, and returns how many were dropped. One that faces the other way is no duplicate.
std::int64_t DropDuplicateTriangles(std::vector<Triangle>& triangles,
  std::vector<vtkIdType>& originalCells, std::size_t numberOfPoints);
}

#endif
