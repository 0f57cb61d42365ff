#include "haptics/Filters/PassAttributes.h"

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <numeric>

namespace haptics
{
int PassAttributes(
  vtkDataSetAttributes* from, vtkIdType elements, vtkIdTypeArray* ids, vtkDataSetAttributes* to)
{
  vtkSmartPointer<vtkDataSetAttributes> whole = vtk::TakeSmartPointer(from->NewInstance());
  whole->ShallowCopy(from);
  int dropped = 0;
  bool areLonger = false;
  for (int i = whole->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const vtkIdType tuples = whole->GetAbstractArray(i)->GetNumberOfTuples();
    areLonger = areLonger || tuples > elements;
    if (tuples < elements)
    {
      whole->RemoveArray(i);
      ++dropped;
    }
  }
  const vtkIdType count = ids->GetNumberOfValues();
  bool unchanged = count == elements && !areLonger;
  for (vtkIdType i = 0; unchanged && i < count; ++i)
  {
    unchanged = ids->GetValue(i) == i;
  }
  if (unchanged)
  {
    to->PassData(whole);
  }
  else if (whole->GetNumberOfArrays() > 0)
  {
    vtkNew<vtkIdList> sources;
    sources->SetNumberOfIds(count);
    std::copy_n(ids->GetPointer(0), count, sources->GetPointer(0));
    // VTK 9.1 copies a list of elements only to a list of destinations.
    vtkNew<vtkIdList> destinations;
    destinations->SetNumberOfIds(count);
    std::iota(destinations->GetPointer(0), destinations->GetPointer(0) + count, vtkIdType{ 0 });
    to->CopyAllocate(whole, count);
    to->CopyData(whole, sources, destinations);
  }
  to->AddArray(ids);
  return dropped;
}
}
