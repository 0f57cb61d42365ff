#include "haptics/Filters/BuildKey.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <utility>

namespace haptics
{
namespace
{
void Add(BuildKey& key, vtkObject* object)
{
  key.Objects.push_back(object);
  key.Times.push_back(object ? object->GetMTime() : 0);
}

void AddCells(BuildKey& key, vtkCellArray* cells)
{
  Add(key, cells);
  Add(key, cells->GetOffsetsArray());
  Add(key, cells->GetConnectivityArray());
  key.Sizes.push_back(cells->GetNumberOfCells());
  key.Sizes.push_back(cells->GetNumberOfConnectivityIds());
}
}

bool HaveSameCells(const BuildKey& a, const BuildKey& b)
{
  // The points come first, see MakeBuildKey().
  return a.Sizes == b.Sizes && a.Properties == b.Properties &&
    std::equal(a.Objects.begin() + 1, a.Objects.end(), b.Objects.begin() + 1, b.Objects.end()) &&
    std::equal(a.Times.begin() + 1, a.Times.end(), b.Times.begin() + 1, b.Times.end());
}

BuildKey MakeBuildKey(vtkPolyData* input, vtkDataArray* sides, std::vector<double> properties)
{
  BuildKey key;
  key.SideArray = sides;
  key.SideTime = sides ? sides->GetMTime() : 0;
  key.Properties = std::move(properties);
  Add(key, input->GetPoints());
  AddCells(key, input->GetPolys());
  AddCells(key, input->GetStrips());
  Add(key, input->GetCellGhostArray());
  // Verts and lines come first in the numbering of the cells.
  key.Sizes.push_back(input->GetNumberOfVerts());
  key.Sizes.push_back(input->GetNumberOfLines());
  key.Sizes.push_back(input->GetNumberOfPoints());
  return key;
}
}
