#include "haptics/Filters/DataPoints.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
constexpr std::int32_t Unknown = -1;
constexpr std::int32_t Same = -2;

/// The arrays whose values count.
std::vector<vtkAbstractArray*> DataArrays(vtkDataSetAttributes* data, vtkIdType inputPoints)
{
  std::vector<vtkAbstractArray*> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(i);
    const int attribute = data->IsArrayAnAttribute(i);
    const bool isId = attribute == vtkDataSetAttributes::GLOBALIDS ||
      attribute == vtkDataSetAttributes::PEDIGREEIDS;
    const char* const name = array->GetName();
    const bool isGhost = name && std::strcmp(name, vtkDataSetAttributes::GhostArrayName()) == 0;
    if (!isId && !isGhost && array->GetNumberOfTuples() >= inputPoints)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

bool HasSameTuples(vtkAbstractArray* array, vtkIdType a, vtkIdType b)
{
  const int components = array->GetNumberOfComponents();
  vtkDataArray* const numbers = vtkDataArray::SafeDownCast(array);
  for (int i = 0; i < components; ++i)
  {
    if (!numbers)
    {
      if (array->GetVariantValue(a * components + i) != array->GetVariantValue(b * components + i))
      {
        return false;
      }
      continue;
    }
    const double x = numbers->GetComponent(a, i);
    const double y = numbers->GetComponent(b, i);
    if (x != y && !(std::isnan(x) && std::isnan(y)))
    {
      return false;
    }
  }
  return true;
}
}

DataPoints FindDataPoints(const std::vector<Triangle>& triangles,
  const std::vector<Triangle>& originalCorners, const vtkIdType* originals, std::size_t points,
  vtkDataSetAttributes* data, vtkIdType inputPoints)
{
  DataPoints found;
  const std::vector<vtkAbstractArray*> arrays = DataArrays(data, inputPoints);
  if (originalCorners.empty() || arrays.empty())
  {
    return found;
  }
  std::vector<std::int32_t> known(static_cast<std::size_t>(inputPoints), Unknown);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::int32_t point = triangles[t][k];
      const std::int32_t original = originalCorners[t][k];
      std::int32_t& own = known[static_cast<std::size_t>(original)];
      if (own == Unknown)
      {
        const vtkIdType kept = originals[point];
        own = std::all_of(arrays.begin(), arrays.end(),
                [kept, original](vtkAbstractArray* array)
                { return HasSameTuples(array, kept, original); })
          ? Same
          : static_cast<std::int32_t>(points + found.Originals.size());
        if (own != Same)
        {
          found.Originals.push_back(original);
          found.MergedWith.push_back(point);
        }
      }
      if (own != Same)
      {
        if (found.Corners.empty())
        {
          found.Corners = triangles;
        }
        found.Corners[t][k] = own;
      }
    }
  }
  return found;
}

bool HasExchangedCorners(vtkPolyData* prepared, const TriangleSurface& surface)
{
  // A point that the surface has too shows the order; the points that were added come after those.
  const auto own = static_cast<vtkIdType>(surface.Points().size());
  vtkNew<vtkIdList> ids;
  for (std::size_t t = 0; t < surface.Triangles().size(); ++t)
  {
    prepared->GetPolys()->GetCellAtId(static_cast<vtkIdType>(t), ids);
    const Triangle& triangle = surface.Triangles()[t];
    for (vtkIdType k = 1; k < 3; ++k)
    {
      if (ids->GetId(k) < own)
      {
        return ids->GetId(k) != triangle[static_cast<std::size_t>(k)];
      }
    }
  }
  return false;
}

std::vector<Triangle> DataCorners(vtkPolyData* prepared, const TriangleSurface& surface)
{
  std::vector<Triangle> corners;
  if (prepared->GetNumberOfPoints() == static_cast<vtkIdType>(surface.Points().size()))
  {
    return corners;
  }
  const bool isExchanged = HasExchangedCorners(prepared, surface);
  vtkNew<vtkIdList> ids;
  corners.reserve(surface.Triangles().size());
  for (std::size_t t = 0; t < surface.Triangles().size(); ++t)
  {
    prepared->GetPolys()->GetCellAtId(static_cast<vtkIdType>(t), ids);
    corners.push_back({ static_cast<std::int32_t>(ids->GetId(0)),
      static_cast<std::int32_t>(ids->GetId(isExchanged ? 2 : 1)),
      static_cast<std::int32_t>(ids->GetId(isExchanged ? 1 : 2)) });
  }
  return corners;
}
}
