#include "haptics/Filters/PropertyArrays.h"

#include "vtkDataArray.h"
#include "vtkPiecewiseFunction.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace haptics
{
namespace
{
/// The finite values' least and greatest; false where there is none.
bool FiniteRange(vtkDataArray* array, double range[2])
{
  range[0] = HUGE_VAL;
  range[1] = -HUGE_VAL;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    if (std::isfinite(value))
    {
      range[0] = std::min(range[0], value);
      range[1] = std::max(range[1], value);
    }
  }
  return range[0] <= range[1];
}
}

std::string MapArray(vtkDataArray* array, const PropertyMapping& mapping, double constant,
  vtkIdType wanted, PropertyField& field)
{
  std::ostringstream problem;
  field.Values.clear();
  if (array->GetNumberOfComponents() != 1)
  {
    problem << "has " << array->GetNumberOfComponents()
            << " components, and one is needed (a vtkArrayCalculator makes one of them)";
    return problem.str();
  }
  if (array->GetNumberOfTuples() != wanted)
  {
    problem << "has " << array->GetNumberOfTuples() << " values, and " << wanted << " are needed";
    return problem.str();
  }
  double range[2] = { 0.0, 0.0 };
  if (mapping.WholeRange)
  {
    std::copy_n(mapping.WholeRange, 2, range);
  }
  const bool isRanged =
    mapping.Range && !mapping.Function && (mapping.WholeRange || FiniteRange(array, range));
  const auto map = [&](double value)
  {
    if (mapping.Function)
    {
      return mapping.Function->GetValue(value);
    }
    if (!isRanged)
    {
      return value;
    }
    double share = range[1] > range[0] ? (value - range[0]) / (range[1] - range[0]) : 0.5;
    if (mapping.Curve)
    {
      share = std::clamp(mapping.Curve->GetValue(share), 0.0, 1.0);
    }
    return (*mapping.Range)[0] + share * ((*mapping.Range)[1] - (*mapping.Range)[0]);
  };

  field.Values.reserve(static_cast<std::size_t>(wanted));
  vtkIdType bad = 0;
  vtkIdType firstBad = -1;
  for (vtkIdType i = 0; i < wanted; ++i)
  {
    const double given = array->GetComponent(i, 0);
    double value = std::isfinite(given) ? map(given) : given;
    if (mapping.CutsOff && std::isfinite(value))
    {
      value = std::clamp(value, mapping.Lowest, mapping.Highest);
    }
    // Not within is also how NaN answers.
    if (!(value >= mapping.Lowest && value <= mapping.Highest))
    {
      firstBad = bad++ == 0 ? i : firstBad;
      value = constant;
    }
    field.Values.push_back(static_cast<float>(value));
  }
  if (bad > 0)
  {
    problem << "is not finite or out of range at " << bad << " of " << wanted
            << " places, the first is number " << firstBad << " with "
            << array->GetComponent(firstBad, 0);
  }
  return problem.str();
}

void RaiseStaticFriction(PropertyValues& values, const TriangleSurface& surface)
{
  const PropertyField& slide = values[Property::DynamicFriction];
  PropertyField& hold = values[Property::StaticFriction];
  if (slide.Values.empty() && hold.Values.empty())
  {
    hold.Constant = std::max(hold.Constant, slide.Constant);
    return;
  }
  if (hold.Values.empty())
  {
    hold.IsPerTriangle = slide.IsPerTriangle;
    hold.Values.assign(slide.Values.size(), static_cast<float>(hold.Constant));
  }
  const auto& triangles = surface.Triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (const std::int32_t corner : values.CornersOf(surface, i))
    {
      const double least = slide.Values.empty()
        ? slide.Constant
        : slide.Values[slide.IsPerTriangle ? i : static_cast<std::size_t>(corner)];
      float& value = hold.Values[hold.IsPerTriangle ? i : static_cast<std::size_t>(corner)];
      value = std::max(value, static_cast<float>(least));
    }
  }
}
}
