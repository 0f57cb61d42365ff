#include "haptics/Filters/TraceCSV.h"

#include "haptics/Files/OutputFile.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <array>
#include <charconv>
#include <cstring>
#include <locale>
#include <sstream>
#include <vector>

namespace haptics
{
namespace
{
template <class Number>
std::string Shortest(Number value)
{
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return { text.data(), end.ptr };
}

struct Column
{
  vtkAbstractArray* Array;
  std::string Name;
};

std::vector<Column> ColumnsOf(vtkPolyData* trace)
{
  std::vector<Column> columns;
  vtkPointData* const data = trace->GetPointData();
  if (vtkAbstractArray* const time = data->GetAbstractArray("Time"))
  {
    columns.push_back({ time, "Time" });
  }
  if (trace->GetPoints())
  {
    columns.push_back({ trace->GetPoints()->GetData(), "GodObject" });
  }
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(i);
    if (array->GetName() && std::strcmp(array->GetName(), "Time") != 0)
    {
      columns.push_back({ array, array->GetName() });
    }
  }
  return columns;
}

void WriteTable(vtkPolyData* trace, std::ostream& stream)
{
  const std::vector<Column> columns = ColumnsOf(trace);
  const vtkIdType rows = trace->GetNumberOfPoints();
  for (vtkIdType row = -1; row < rows; ++row)
  {
    const char* separator = "";
    for (const Column& column : columns)
    {
      const int count = column.Array->GetNumberOfComponents();
      for (int c = 0; c < count; ++c)
      {
        stream << separator
               << (row < 0 ? CSVField(CSVColumn(column.Name, c, count))
                           : CSVValue(column.Array, row, c));
        separator = ",";
      }
    }
    stream << "\n";
  }
}
}

std::string CSVField(const std::string& given)
{
  std::string text = given.find_first_of("=+-@\t\r") == 0 ? "'" + given : given;
  if (text.find_first_of(",\"\n\r") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  }
  return quoted + "\"";
}

std::string CSVValue(vtkAbstractArray* array, vtkIdType tuple, int component)
{
  vtkDataArray* const numbers = vtkDataArray::SafeDownCast(array);
  const vtkIdType index = tuple * array->GetNumberOfComponents() + component;
  if (!numbers)
  {
    return CSVField(array->GetVariantValue(index).ToString());
  }
  switch (numbers->GetDataType())
  {
    case VTK_DOUBLE:
      return Shortest(numbers->GetComponent(tuple, component));
    case VTK_FLOAT:
      return Shortest(static_cast<float>(numbers->GetComponent(tuple, component)));
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR: // numbers here, and letters for a variant
      return std::to_string(static_cast<int>(numbers->GetComponent(tuple, component)));
    default: // 64-bit integers do not go through a double
      return array->GetVariantValue(index).ToString();
  }
}

std::string CSVColumn(const std::string& array, int component, int count)
{
  const std::string number = std::to_string(component);
  return count == 1 ? array
                    : array + "_" + (count == 3 ? std::string(1, "XYZ"[component]) : number);
}

std::string WriteTraceCSV(vtkPolyData* trace, const char* file)
{
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  WriteTable(trace, stream);
  const std::string text = stream.str();
  std::string error;
  if (!OutputFile::WriteWhole(file ? file : "", text.data(), text.size(), error))
  {
    return "The trace " + error;
  }
  return {};
}
}
