#include "haptics/Filters/TraceRecorder.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <numeric>

namespace haptics
{
namespace
{
template <class Array, class Value>
void AddScalar(vtkPolyData* trace, const char* name, const std::vector<TraceTick>& ticks,
  Value TraceTick::*member)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(ticks.size()));
  vtkIdType i = 0;
  for (const TraceTick& tick : ticks)
  {
    array->SetValue(i++, static_cast<typename Array::ValueType>(tick.*member));
  }
  trace->GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkDoubleArray> Vectors(
  const char* name, const std::vector<TraceTick>& ticks, Vec3 TraceTick::*member)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(ticks.size()));
  vtkIdType i = 0;
  for (const TraceTick& tick : ticks)
  {
    array->SetTypedTuple(i++, (tick.*member).data());
  }
  return array;
}
}

TraceTick::TraceTick(const TickRecord& record, std::int32_t surface, std::int64_t cell)
  : Time(record.Time)
  , Hip(record.Hip)
  , GodObject(record.Position)
  , Force(record.WorldForce)
  , Penetration(record.Penetration)
  , Stiffness(record.Stiffness)
  , Energy(record.Energy)
  , Tank(record.Tank)
  , Cell(cell)
  , Surface(surface)
  , ActiveConstraints(record.NumberOfConstraints)
{
}

void TraceRecorder::Write(vtkPolyData* trace) const
{
  trace->Initialize();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(Vectors("GodObject", this->Ticks, &TraceTick::GodObject));
  trace->SetPoints(points);
  if (!this->Ticks.empty())
  {
    std::vector<vtkIdType> line(this->Ticks.size());
    std::iota(line.begin(), line.end(), 0);
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    this->Ticks.size() > 1 ? trace->SetLines(lines) : trace->SetVerts(lines);
  }
  AddScalar<vtkDoubleArray>(trace, "Time", this->Ticks, &TraceTick::Time);
  trace->GetPointData()->AddArray(Vectors("HapticInterfacePoint", this->Ticks, &TraceTick::Hip));
  trace->GetPointData()->AddArray(Vectors("Force", this->Ticks, &TraceTick::Force));
  AddScalar<vtkIntArray>(trace, "ActiveConstraints", this->Ticks, &TraceTick::ActiveConstraints);
  AddScalar<vtkIntArray>(trace, "Surface", this->Ticks, &TraceTick::Surface);
  AddScalar<vtkIdTypeArray>(trace, "OriginalCellId", this->Ticks, &TraceTick::Cell);
  AddScalar<vtkDoubleArray>(trace, "Penetration", this->Ticks, &TraceTick::Penetration);
  AddScalar<vtkDoubleArray>(trace, "Stiffness", this->Ticks, &TraceTick::Stiffness);
  AddScalar<vtkDoubleArray>(trace, "Energy", this->Ticks, &TraceTick::Energy);
  AddScalar<vtkDoubleArray>(trace, "EnergyTank", this->Ticks, &TraceTick::Tank);
}
}
