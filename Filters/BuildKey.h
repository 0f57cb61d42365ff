#ifndef Haptics_BuildKey_h
#define Haptics_BuildKey_h

#include "vtkType.h"

#include <vector>

class vtkDataArray;
class vtkPolyData;

namespace haptics
{
/// What a surface depends on. Equal keys mean that nothing has to be rebuilt.
struct BuildKey
{
  std::vector<const void*> Objects;
  std::vector<vtkMTimeType> Times; // never the same for two states, whatever memory is used again
  const void* SideArray = nullptr;
  vtkMTimeType SideTime = 0;
  std::vector<vtkIdType> Sizes;
  std::vector<double>
    Properties; // by value: SetInputData() and others touch the filter's MTime too

  bool operator==(const BuildKey& other) const
  {
    return this->Objects == other.Objects && this->Times == other.Times &&
      this->SideArray == other.SideArray && this->SideTime == other.SideTime &&
      this->Sizes == other.Sizes && this->Properties == other.Properties;
  }
};

/// Whether two keys differ in nothing but the points and the array of the sides.
bool HaveSameCells(const BuildKey& a, const BuildKey& b);

/// The key of `input` and the values of the filter's properties. Does not look at a coordinate.
/// `sides`: the array of the cells' sides, or null.
BuildKey MakeBuildKey(vtkPolyData* input, vtkDataArray* sides, std::vector<double> properties);
}

#endif
