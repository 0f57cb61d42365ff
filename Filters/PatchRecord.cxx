#include "haptics/Filters/PatchRecord.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkTypeInt64Array.h"
#include "vtkVariant.h"

#include <algorithm>
#include <vector>

namespace haptics
{
namespace
{
constexpr const char* NumbersName = "HapticWholeSurface";
constexpr const char* CountsName = "HapticWholeCounts";
const std::string PointRangePrefix = "HapticPointRange ";
const std::string CellRangePrefix = "HapticCellRange ";

/// All numbers of a record, in the order in which they are stored: `visit` reads or writes each.
template <class Record, class Visitor>
void VisitNumbers(Record& record, const Visitor& visit)
{
  auto& whole = record.Whole;
  for (auto* place : { &whole.Origin, &record.Frame.Origin, &record.Region.From, &record.Region.To,
         &record.Enclosure.Anchor, &record.Enclosure.Middle })
  {
    for (auto& coordinate : *place)
    {
      visit(coordinate);
    }
  }
  visit(record.Region.Radius);
  visit(record.Enclosure.HollowRadius);
  visit(whole.Radius);
  visit(whole.Diagonal);
  visit(whole.LongestEdge);
  visit(whole.CrackWidth);
  visit(whole.LongestWay);
  visit(whole.Negligible);
  visit(record.Frame.Diagonal);
  visit(record.Frame.LargestCoordinate);
}

template <class Record, class Visitor>
void VisitCounts(Record& record, const Visitor& visit)
{
  auto& whole = record.Whole;
  visit(whole.Version);
  visit(whole.Before);
  visit(whole.Triangles);
  visit(whole.Report.BoundaryEdges);
  visit(whole.Report.NonManifoldEdges);
  visit(whole.Report.FlippedEdges);
  visit(whole.Report.Components);
  visit(whole.Report.InsideOutComponents);
  visit(whole.Report.Closed);
  visit(whole.Report.Oriented);
  visit(record.Enclosure.IsCounted);
  visit(record.Enclosure.Count);
  visit(record.Enclosure.IsSwept);
}

void WriteRanges(const ArrayRanges& ranges, const std::string& prefix, vtkFieldData* fields)
{
  for (const auto& [name, range] : ranges)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName((prefix + name).c_str());
    array->InsertNextValue(range[0]);
    array->InsertNextValue(range[1]);
    fields->AddArray(array);
  }
}

void ReadRanges(vtkFieldData* fields, const std::string& prefix, ArrayRanges& ranges)
{
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    auto* const array = vtkDoubleArray::SafeDownCast(fields->GetAbstractArray(i));
    const std::string name = array && array->GetName() ? array->GetName() : "";
    if (array && name.compare(0, prefix.size(), prefix) == 0 && array->GetNumberOfValues() == 2)
    {
      ranges[name.substr(prefix.size())] = { array->GetValue(0), array->GetValue(1) };
    }
  }
}
}

void PatchRecord::WriteTo(vtkFieldData* fields) const
{
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(NumbersName);
  VisitNumbers(*this, [&](double value) { numbers->InsertNextValue(value); });
  fields->AddArray(numbers);
  vtkNew<vtkTypeInt64Array> counts;
  counts->SetName(CountsName);
  VisitCounts(
    *this, [&](const auto& value) { counts->InsertNextValue(static_cast<vtkTypeInt64>(value)); });
  fields->AddArray(counts);
  this->WriteRangesTo(fields);
}

std::shared_ptr<const PatchRecord> PatchRecord::ReadFrom(vtkFieldData* fields)
{
  auto* const numbers = vtkDoubleArray::SafeDownCast(fields->GetAbstractArray(NumbersName));
  // Not always a vtkTypeInt64Array: writers have their own names for 64 bits.
  auto* const counts = vtkDataArray::SafeDownCast(fields->GetAbstractArray(CountsName));
  auto record = std::make_shared<PatchRecord>();
  vtkIdType size = 0;
  VisitNumbers(*record, [&size](double) { ++size; });
  vtkIdType number = 0;
  VisitCounts(*record, [&number](const auto&) { ++number; });
  if (!numbers || !counts || numbers->GetNumberOfValues() != size ||
    counts->GetNumberOfValues() != number)
  {
    return nullptr;
  }
  const double* value = numbers->GetPointer(0);
  VisitNumbers(*record, [&value](double& to) { to = *value++; });
  vtkIdType place = 0;
  VisitCounts(*record,
    [&](auto& to)
    {
      const vtkTypeInt64 count = counts->GetVariantValue(place++).ToTypeInt64();
      to = static_cast<std::decay_t<decltype(to)>>(count);
    });
  ReadRanges(fields, PointRangePrefix, record->PointRanges);
  ReadRanges(fields, CellRangePrefix, record->CellRanges);
  return record;
}

void PatchRecord::WriteRangesTo(vtkFieldData* fields) const
{
  WriteRanges(this->PointRanges, PointRangePrefix, fields);
  WriteRanges(this->CellRanges, CellRangePrefix, fields);
}

const double* PatchRecord::RangeIn(vtkFieldData* fields, bool isPerCell, const char* array)
{
  const std::string name = (isPerCell ? CellRangePrefix : PointRangePrefix) + (array ? array : "");
  auto* const range = vtkDoubleArray::SafeDownCast(fields->GetAbstractArray(name.c_str()));
  return range && range->GetNumberOfValues() == 2 ? range->GetPointer(0) : nullptr;
}
}
