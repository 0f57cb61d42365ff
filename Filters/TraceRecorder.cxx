#include "haptics/Filters/TraceRecorder.h"

#include "haptics/Filters/LengthUnit.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <numeric>
#include <string>

namespace haptics
{
namespace
{
/// A dimensionless array has none.
void SetUnit(vtkDataArray* array, const char* unit)
{
  if (unit && *unit)
  {
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
  }
}

template <class Array, class Value>
void AddScalar(vtkPolyData* trace, const char* name, const std::vector<TraceTick>& ticks,
  Value TraceTick::*member, const char* unit)
{
  vtkNew<Array> array;
  SetUnit(array, unit);
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
  const char* name, const std::vector<TraceTick>& ticks, Vec3 TraceTick::*member, const char* unit)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  SetUnit(array, unit);
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

TraceTick::TraceTick(const TickRecord& record, const TracePlace& place)
  : Time(record.Time)
  , Hip(record.Hip)
  , GodObject(record.Position)
  , Force(record.WorldForce)
  , Normal(record.NumberOfConstraints > 0 ? record.Constraints[0].Normal : Vec3{})
  , Weights(place.Weights)
  , Penetration(record.Penetration)
  , Stiffness(record.Stiffness)
  , Energy(record.Energy)
  , Tank(record.Tank)
  , Cell(place.Cell)
  , Points(place.Points)
  , Surface(place.Surface)
  , ActiveConstraints(record.NumberOfConstraints)
{
}

void TraceRecorder::Write(vtkPolyData* trace, double unitLength) const
{
  const std::string unit = LengthUnitName(unitLength);
  const char* const length = unit.c_str();
  trace->Initialize();
  vtkNew<vtkPoints> way;
  way->SetDataTypeToDouble();
  way->SetData(Vectors("GodObject", this->Ticks, &TraceTick::GodObject, length));
  trace->SetPoints(way);
  if (!this->Ticks.empty())
  {
    std::vector<vtkIdType> line(this->Ticks.size());
    std::iota(line.begin(), line.end(), 0);
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    this->Ticks.size() > 1 ? trace->SetLines(lines) : trace->SetVerts(lines);
  }
  vtkPointData* const data = trace->GetPointData();
  AddScalar<vtkDoubleArray>(trace, "Time", this->Ticks, &TraceTick::Time, "s");
  data->AddArray(Vectors("HapticInterfacePoint", this->Ticks, &TraceTick::Hip, length));
  data->AddArray(Vectors("Force", this->Ticks, &TraceTick::Force, "N"));
  data->AddArray(Vectors("Normal", this->Ticks, &TraceTick::Normal, nullptr));
  AddScalar<vtkIntArray>(
    trace, "ActiveConstraints", this->Ticks, &TraceTick::ActiveConstraints, nullptr);
  AddScalar<vtkIntArray>(trace, "Surface", this->Ticks, &TraceTick::Surface, nullptr);
  AddScalar<vtkIdTypeArray>(trace, "OriginalCellId", this->Ticks, &TraceTick::Cell, nullptr);
  vtkNew<vtkIdTypeArray> points;
  points->SetName("PointIds");
  points->SetNumberOfComponents(3);
  points->SetNumberOfTuples(this->Size());
  for (vtkIdType i = 0; i < this->Size(); ++i)
  {
    const std::array<std::int32_t, 3>& ids = this->Ticks[static_cast<std::size_t>(i)].Points;
    points->SetTuple3(i, ids[0], ids[1], ids[2]);
  }
  data->AddArray(points);
  data->AddArray(Vectors("BarycentricWeights", this->Ticks, &TraceTick::Weights, nullptr));
  AddScalar<vtkDoubleArray>(trace, "Penetration", this->Ticks, &TraceTick::Penetration, length);
  AddScalar<vtkDoubleArray>(trace, "Stiffness", this->Ticks, &TraceTick::Stiffness, "N/m");
  AddScalar<vtkDoubleArray>(trace, "Energy", this->Ticks, &TraceTick::Energy, "J");
  AddScalar<vtkDoubleArray>(trace, "EnergyTank", this->Ticks, &TraceTick::Tank, "J");
}
}
