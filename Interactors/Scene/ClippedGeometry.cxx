#include "haptics/Scene/ClippedGeometry.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellData.h"
#include "vtkClipPolyData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMapper.h"
#include "vtkNonMergingPointLocator.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPolyData.h"

#include <cmath>
#include <numeric>

namespace haptics
{
namespace
{
constexpr const char* IdName = "vtkHapticSceneClippedCell";

/// Of the corners of the bounds, whether any is cut away.
bool Cuts(const std::array<double, 4>& plane, const double bounds[6])
{
  double lowest = plane[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    lowest += plane[axis] * bounds[2 * axis + (plane[axis] > 0.0 ? 0 : 1)];
  }
  return !(lowest >= 0.0);
}

void Clip(vtkPolyData* geometry, const std::array<double, 4>& plane)
{
  vtkNew<vtkPlane> function;
  const double square = plane[0] * plane[0] + plane[1] * plane[1] + plane[2] * plane[2];
  const double toPlane = -plane[3] / square;
  function->SetNormal(plane[0], plane[1], plane[2]);
  function->SetOrigin(toPlane * plane[0], toPlane * plane[1], toPlane * plane[2]);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(geometry);
  clip->SetClipFunction(function);
  // Points in one place may differ in their data, which merging them would lose.
  vtkNew<vtkNonMergingPointLocator> locator;
  clip->SetLocator(locator);
  clip->Update();
  geometry->ShallowCopy(clip->GetOutput());
}
}

vtkStandardNewMacro(ClippedGeometry);

vtkAlgorithmOutput* ClippedGeometry::Follow(
  vtkMapper* mapper, vtkAlgorithmOutput* geometry, const Matrix4& matrix)
{
  std::vector<Equation> planes;
  vtkPlaneCollection* given = mapper->GetClippingPlanes();
  const double determinant = Determinant(matrix);
  const bool isInvertible = std::isfinite(determinant) && determinant != 0.0;
  for (int i = 0; isInvertible && given && i < given->GetNumberOfItems(); ++i)
  {
    vtkPlane* const plane = vtkPlane::SafeDownCast(given->GetItemAsObject(i));
    const double* const n = plane->GetNormal();
    const double* const o = plane->GetOrigin();
    Equation equation{};
    for (std::size_t j = 0; j < 3; ++j)
    {
      equation[j] = n[0] * matrix[j] + n[1] * matrix[4 + j] + n[2] * matrix[8 + j];
    }
    equation[3] =
      n[0] * (matrix[3] - o[0]) + n[1] * (matrix[7] - o[1]) + n[2] * (matrix[11] - o[2]);
    const double size = std::abs(equation[0]) + std::abs(equation[1]) + std::abs(equation[2]);
    if (size > 0.0 && std::isfinite(size + equation[3])) // else it is no plane
    {
      planes.push_back(equation);
    }
  }
  if (planes.empty())
  {
    return nullptr;
  }
  geometry->GetProducer()->UpdateDataObject();
  if (!vtkPolyData::SafeDownCast(
        geometry->GetProducer()->GetOutputDataObject(geometry->GetIndex())))
  {
    return nullptr; // is refused for what it is
  }
  if (this->GetNumberOfInputConnections(0) == 0 || this->GetInputConnection(0, 0) != geometry)
  {
    this->SetInputConnection(geometry);
  }
  if (planes != this->Planes)
  {
    this->Planes = planes;
    this->Modified();
  }
  return this->GetOutputPort();
}

int ClippedGeometry::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* const input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* const output = vtkPolyData::GetData(outputs);
  vtkNew<vtkPolyData> kept;
  kept->ShallowCopy(input);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(IdName);
  ids->SetNumberOfValues(input->GetNumberOfCells());
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfValues(), vtkIdType{ 0 });
  kept->GetCellData()->AddArray(ids);
  for (const Equation& plane : this->Planes)
  {
    if (kept->GetNumberOfCells() > 0 && Cuts(plane, kept->GetBounds()))
    {
      Clip(kept, plane);
    }
  }
  this->OriginalCells = vtkIdTypeArray::SafeDownCast(kept->GetCellData()->GetArray(IdName));
  kept->GetCellData()->RemoveArray(IdName);
  if (kept->GetNumberOfCells() > 0 || input->GetNumberOfCells() == 0)
  {
    output->ShallowCopy(kept);
  }
  return 1; // where all is cut away there are no points either, which would be somebody's mistake
}
}
