#ifndef Haptics_PointReader_h
#define Haptics_PointReader_h

#include "haptics/Math/Vec3.h"

#include "vtkDataArray.h"
#include "vtkPoints.h"

namespace haptics
{
/// Reads points, in a third of the time that it takes through the array's virtual methods where
/// they are stored as usual. Several threads may. Null is no points.
class PointReader
{
public:
  explicit PointReader(vtkPoints* points)
    : Points(points)
  {
    vtkDataArray* const data = points ? points->GetData() : nullptr;
    if (data && data->HasStandardMemoryLayout())
    {
      void* const memory = data->GetVoidPointer(0);
      this->Floats = data->GetDataType() == VTK_FLOAT ? static_cast<float*>(memory) : nullptr;
      this->Doubles = data->GetDataType() == VTK_DOUBLE ? static_cast<double*>(memory) : nullptr;
    }
  }
  Vec3 At(vtkIdType i) const
  {
    if (const float* p = this->Floats)
    {
      return { p[3 * i], p[3 * i + 1], p[3 * i + 2] };
    }
    if (const double* p = this->Doubles)
    {
      return { p[3 * i], p[3 * i + 1], p[3 * i + 2] };
    }
    Vec3 p;
    this->Points->GetPoint(i, p.data());
    return p;
  }

private:
  vtkPoints* Points;
  const float* Floats = nullptr;
  const double* Doubles = nullptr;
};
}

#endif
