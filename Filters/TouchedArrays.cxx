#include "haptics/Filters/TouchedArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace haptics
{
namespace
{
/// Shares the wanted arrays of `from`, all as plain arrays: how values are interpolated must not
/// hang on which of them is called a normal or an id.
void Choose(vtkDataSetAttributes* from, const std::vector<std::string>& names, vtkIdType elements,
  vtkDataSetAttributes* to)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(i);
    const char* const name = array->GetName();
    if (!name || array->GetNumberOfTuples() < elements ||
      std::strcmp(name, "OriginalPointId") == 0 || std::strcmp(name, "OriginalCellId") == 0 ||
      std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0)
    {
      continue;
    }
    if (names.empty() || std::find(names.begin(), names.end(), name) != names.end())
    {
      to->AddArray(array);
    }
  }
}

void SetNoValue(vtkDataSetAttributes* values, vtkIdType tick)
{
  values->NullData(tick);
  for (int i = 0; i < values->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = values->GetArray(i);
    for (int k = 0; array && k < array->GetNumberOfComponents(); ++k)
    {
      if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
      {
        array->SetComponent(tick, k, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
}
}

TouchedArrays::TouchedArrays(
  vtkPolyData* prepared, const std::vector<std::string>& names, vtkIdType ticks)
  : Prepared(prepared)
  , Names(names)
{
  Choose(prepared->GetPointData(), names, prepared->GetNumberOfPoints(), this->PointSource);
  Choose(prepared->GetCellData(), names, prepared->GetNumberOfCells(), this->CellSource);
  for (const std::string& name : names)
  {
    if (!this->PointSource->HasArray(name.c_str()) && !this->CellSource->HasArray(name.c_str()))
    {
      this->MissingNames.push_back(name);
    }
  }
  this->PointValues->InterpolateAllocate(this->PointSource, ticks);
  this->CellValues->CopyAllocate(this->CellSource, ticks);
}

TouchedArrays::~TouchedArrays() = default;

bool TouchedArrays::Continue(vtkPolyData* prepared)
{
  const auto list = [this]
  {
    std::vector<std::string> found;
    for (vtkDataSetAttributes* const data :
      { static_cast<vtkDataSetAttributes*>(this->PointSource.Get()),
        static_cast<vtkDataSetAttributes*>(this->CellSource.Get()) })
    {
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* const array = data->GetAbstractArray(i);
        found.push_back(std::to_string(array->GetDataType()) + " " +
          std::to_string(array->GetNumberOfComponents()) + " " + array->GetName());
      }
      found.emplace_back();
    }
    return found;
  };
  const std::vector<std::string> before = list();
  this->Prepared = prepared;
  this->PointSource->Initialize();
  this->CellSource->Initialize();
  Choose(prepared->GetPointData(), this->Names, prepared->GetNumberOfPoints(), this->PointSource);
  Choose(prepared->GetCellData(), this->Names, prepared->GetNumberOfCells(), this->CellSource);
  return list() == before;
}

void TouchedArrays::Add(vtkIdType tick, vtkIdType triangle, const Vec3& weights)
{
  if (triangle < 0)
  {
    SetNoValue(this->PointValues, tick);
    SetNoValue(this->CellValues, tick);
    return;
  }
  this->Prepared->GetPolys()->GetCellAtId(triangle, this->Ids);
  double shares[3] = { weights[0], weights[1], weights[2] };
  this->PointValues->InterpolatePoint(this->PointSource, tick, this->Ids, shares);
  this->CellValues->CopyData(this->CellSource, triangle, tick);
}

void TouchedArrays::AddTo(vtkPointData* data) const
{
  for (vtkDataSetAttributes* const values :
    { static_cast<vtkDataSetAttributes*>(this->PointValues.Get()),
      static_cast<vtkDataSetAttributes*>(this->CellValues.Get()) })
  {
    for (int i = 0; i < values->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = values->GetAbstractArray(i);
      const std::string name = array->GetName();
      array->SetName((data->HasArray(name.c_str()) ? "Surface" + name : name).c_str());
      data->AddArray(array);
    }
  }
}
}
