#ifndef Haptics_TraceComparison_h
#define Haptics_TraceComparison_h

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
/// Between the points of two traces that have as many.
inline double LargestDistance(vtkPolyData* one, vtkPolyData* other)
{
  double farthest = 0.0;
  for (vtkIdType i = 0; i < one->GetNumberOfPoints(); ++i)
  {
    double a[3];
    double b[3];
    one->GetPoint(i, a);
    other->GetPoint(i, b);
    farthest = std::max(farthest, std::sqrt(vtkMath::Distance2BetweenPoints(a, b)));
  }
  return farthest;
}

/// Between the values of two arrays that have as many; two NaN are the same.
inline double LargestDifference(vtkDataArray* one, vtkDataArray* other)
{
  double most = 0.0;
  for (vtkIdType i = 0; i < one->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < one->GetNumberOfComponents(); ++c)
    {
      const double a = one->GetComponent(i, c);
      const double b = other->GetComponent(i, c);
      most = std::isnan(a) && std::isnan(b) ? most : std::max(most, std::abs(a - b));
    }
  }
  return most;
}

/// The largest change of the force from one tick of a trace to the next [N]; from that to `first`
/// on.
inline double LargestForceStep(vtkPolyData* trace, vtkIdType first = 1)
{
  vtkDataArray* const forces = trace->GetPointData()->GetArray("Force");
  double largest = 0.0;
  for (vtkIdType i = first; i < forces->GetNumberOfTuples(); ++i)
  {
    double before[3];
    double after[3];
    forces->GetTuple(i - 1, before);
    forces->GetTuple(i, after);
    largest = std::max(largest, std::sqrt(vtkMath::Distance2BetweenPoints(before, after)));
  }
  return largest;
}
}

#endif
