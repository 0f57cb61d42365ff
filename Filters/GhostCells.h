#ifndef Haptics_GhostCells_h
#define Haptics_GhostCells_h

#include "vtkDataSetAttributes.h"
#include "vtkUnsignedCharArray.h"

namespace haptics
{
/// Whether a cell is another piece's or hidden, so that it is not touched. `ghosts`: the array of
/// vtkDataSet::GetCellGhostArray(), or null; a cell beyond its end is none.
inline bool IsGhostCell(vtkUnsignedCharArray* ghosts, vtkIdType cell)
{
  constexpr unsigned char dropped = vtkDataSetAttributes::DUPLICATECELL |
    vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;
  return ghosts && cell < ghosts->GetNumberOfValues() && (ghosts->GetValue(cell) & dropped) != 0;
}
}

#endif
