#include "haptics/Scene/TouchedColumns.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
void TouchedColumns::Restart(const std::vector<std::string>& names)
{
  this->Columns.clear();
  this->Ticks = 0;
  for (const std::string& name : names)
  {
    this->Columns.push_back({ name, 0, {} });
  }
}

void TouchedColumns::Add(vtkPolyData* prepared, vtkIdType triangle, const Vec3& weights)
{
  ++this->Ticks;
  if (prepared && !this->Columns.empty())
  {
    prepared->GetPolys()->GetCellAtId(triangle, this->Ids);
  }
  for (Column& column : this->Columns)
  {
    const char* const name = column.Name.c_str();
    vtkDataArray* const ofPoints = prepared ? prepared->GetPointData()->GetArray(name) : nullptr;
    vtkDataArray* const array =
      prepared && !ofPoints ? prepared->GetCellData()->GetArray(name) : ofPoints;
    const int components = array ? array->GetNumberOfComponents() : 0;
    column.Components = column.Components == 0 ? components : column.Components;
    column.Values.resize(static_cast<std::size_t>(this->Ticks * column.Components), std::nan(""));
    double* const values = column.Values.data() + (this->Ticks - 1) * column.Components;
    for (int c = 0; c < std::min(components, column.Components); ++c)
    {
      values[c] = ofPoints ? 0.0 : array->GetComponent(triangle, c);
      for (int i = 0; ofPoints && i < 3; ++i)
      {
        values[c] += weights[i] * ofPoints->GetComponent(this->Ids->GetId(i), c);
      }
    }
  }
}

void TouchedColumns::AddTo(vtkDataSetAttributes* data) const
{
  for (const Column& column : this->Columns)
  {
    if (column.Components > 0)
    {
      vtkNew<vtkDoubleArray> array;
      array->SetName(
        (data->HasArray(column.Name.c_str()) ? "Surface" + column.Name : column.Name).c_str());
      array->SetNumberOfComponents(column.Components);
      array->SetNumberOfTuples(this->Ticks);
      std::copy(column.Values.begin(), column.Values.end(), array->GetPointer(0));
      data->AddArray(array);
    }
  }
}

std::string TouchedColumns::Missing() const
{
  std::string names;
  for (const Column& column : this->Columns)
  {
    names += column.Components > 0 ? "" : (names.empty() ? "" : ", ") + column.Name;
  }
  return names;
}
}
