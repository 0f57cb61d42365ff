#include "haptics/Filters/CellReader.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// The memory of an array of integers that are so large; null where it has no such memory.
template <class T>
const T* MemoryOf(vtkDataArray* array)
{
  return array && array->HasStandardMemoryLayout() && array->GetDataTypeSize() == sizeof(T) &&
      array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE
    ? static_cast<const T*>(array->GetVoidPointer(0))
    : nullptr;
}
}

bool CellReader::ReadInPlace(vtkDataArray* offsets, vtkDataArray* ids)
{
  this->Offsets64 = MemoryOf<vtkTypeInt64>(offsets);
  this->Ids64 = MemoryOf<vtkTypeInt64>(ids);
  this->Offsets32 = MemoryOf<vtkTypeInt32>(offsets);
  this->Ids32 = MemoryOf<vtkTypeInt32>(ids);
  if (!this->Offsets64 || !this->Ids64)
  {
    this->Offsets64 = this->Ids64 = nullptr;
  }
  return this->Ids64 || (this->Offsets32 && this->Ids32);
}

CellReader::CellReader(vtkCellArray* cells)
  : Count(static_cast<std::size_t>(cells->GetNumberOfCells()))
{
  if (this->Count == 0 ||
    this->ReadInPlace(cells->GetOffsetsArray(), cells->GetConnectivityArray()))
  {
    return;
  }
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  this->OwnOffsets.push_back(0);
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    iterator->GetCurrentCell(size, points);
    this->OwnIds.insert(this->OwnIds.end(), points, points + size);
    this->OwnOffsets.push_back(static_cast<vtkTypeInt64>(this->OwnIds.size()));
  }
  this->Offsets64 = this->OwnOffsets.data();
  this->Ids64 = this->OwnIds.data();
}

const vtkIdType* CellReader::At(
  std::size_t cell, vtkIdType& size, std::vector<vtkIdType>& memory) const
{
  // Not the ids: where all cells are empty, these have no memory.
  if (this->Offsets64)
  {
    const vtkTypeInt64 first = this->Offsets64[cell];
    size = static_cast<vtkIdType>(this->Offsets64[cell + 1] - first);
    if constexpr (sizeof(vtkIdType) == sizeof(vtkTypeInt64))
    {
      return reinterpret_cast<const vtkIdType*>(this->Ids64 + first);
    }
    memory.assign(this->Ids64 + first, this->Ids64 + first + size);
    return memory.data();
  }
  const vtkTypeInt32 first = this->Offsets32[cell];
  size = this->Offsets32[cell + 1] - first;
  memory.assign(this->Ids32 + first, this->Ids32 + first + size);
  return memory.data();
}
}
