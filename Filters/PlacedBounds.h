#ifndef Haptics_PlacedBounds_h
#define Haptics_PlacedBounds_h

#include "vtkBoundingBox.h"
#include "vtkMatrix4x4.h"

namespace haptics
{
/// The box around a box whose corners an affine matrix has placed. `matrix`: row by row.
inline vtkBoundingBox PlacedBounds(const double bounds[6], const double matrix[16])
{
  const vtkBoundingBox unplaced(bounds);
  vtkBoundingBox placed;
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    unplaced.GetCorner(corner, point);
    vtkMatrix4x4::MultiplyPoint(matrix, point, point);
    placed.AddPoint(point);
  }
  return placed;
}
}

#endif
