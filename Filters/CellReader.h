#ifndef Haptics_CellReader_h
#define Haptics_CellReader_h

#include "vtkType.h"

#include <vector>

class vtkCellArray;
class vtkDataArray;

namespace haptics
{
/// @brief Reads the cells of an array, which must not change meanwhile. Several threads may.
///
/// In the array's own memory where that is stored as usual, else in a copy.
class CellReader
{
public:
  explicit CellReader(vtkCellArray* cells);

  std::size_t NumberOfCells() const { return this->Count; }
  /// The point ids of a cell; `memory` is where they are put if they need to be.
  const vtkIdType* At(std::size_t cell, vtkIdType& size, std::vector<vtkIdType>& memory) const;

private:
  bool ReadInPlace(vtkDataArray* offsets, vtkDataArray* ids);

  std::size_t Count = 0;
  const vtkTypeInt32* Offsets32 = nullptr;
  const vtkTypeInt32* Ids32 = nullptr;
  const vtkTypeInt64* Offsets64 = nullptr;
  const vtkTypeInt64* Ids64 = nullptr;
  std::vector<vtkTypeInt64> OwnOffsets, OwnIds;
};
}

#endif
