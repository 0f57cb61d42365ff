#ifndef Haptics_TraceCSV_h
#define Haptics_TraceCSV_h

#include "vtkHapticsFiltersModule.h"
#include "vtkType.h"

#include <string>

class vtkAbstractArray;
class vtkPolyData;

namespace haptics
{
/// A name or text as a field of a table of comma-separated values, in quotes where RFC 4180 asks
/// for them. A spreadsheet would run what begins with =, +, - or @, so an apostrophe goes before
/// it, which marks it as text there.
VTKHAPTICSFILTERS_EXPORT std::string CSVField(const std::string& text);

/// One value of an array as such a field, a number with as many digits as distinguish it from every
/// other one of its type.
VTKHAPTICSFILTERS_EXPORT std::string CSVValue(
  vtkAbstractArray* array, vtkIdType tuple, int component);

/// What a column is called: the array's name, with the component where there are several: X, Y and
/// Z of three, else a number from 0.
VTKHAPTICSFILTERS_EXPORT std::string CSVColumn(const std::string& array, int component, int count);

/// Writes a trace as a table, a line a tick after one with the columns' names: Time, GodObject_X,
/// _Y, _Z, then the other point arrays. The file is replaced once all is written. Returns why it
/// could not be, or nothing.
[[nodiscard]] VTKHAPTICSFILTERS_EXPORT std::string WriteTraceCSV(
  vtkPolyData* trace, const char* file);
}

#endif
