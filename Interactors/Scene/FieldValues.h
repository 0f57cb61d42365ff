#ifndef Haptics_FieldValues_h
#define Haptics_FieldValues_h

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <string>

namespace haptics
{
/// Some values of a record, as arrays of its field data with one tuple.
class FieldValues
{
public:
  explicit FieldValues(vtkFieldData* data)
    : Data(data)
  {
  }

  ///@{
  /// Adds `count` values under a name.
  void Set(const char* name, const double* values, int count)
  {
    this->Add<vtkDoubleArray>(name, values, count);
  }
  void Set(const char* name, const vtkIdType* values, int count)
  {
    this->Add<vtkIdTypeArray>(name, values, count);
  }
  void Set(const char* name, const std::string& text)
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    this->Data->AddArray(array);
  }
  ///@}

  ///@{
  /// Gets what Set() has put there; false, and nothing is changed, where that is not there.
  template <class Value>
  bool Get(const char* name, Value* values, int count) const
  {
    vtkDataArray* const array = this->Data->GetArray(name);
    if (!array || array->GetNumberOfTuples() != 1 || array->GetNumberOfComponents() != count)
    {
      return false;
    }
    for (int i = 0; i < count; ++i)
    {
      values[i] = static_cast<Value>(array->GetComponent(0, i));
    }
    return true;
  }
  bool Get(const char* name, std::string& text) const
  {
    auto* const array = vtkStringArray::SafeDownCast(this->Data->GetAbstractArray(name));
    if (!array || array->GetNumberOfValues() != 1)
    {
      return false;
    }
    text = array->GetValue(0);
    return true;
  }
  ///@}

private:
  template <class Array, class Value>
  void Add(const char* name, const Value* values, int count)
  {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(count);
    array->InsertNextTypedTuple(values);
    this->Data->AddArray(array);
  }

  vtkFieldData* Data;
};
}

#endif
