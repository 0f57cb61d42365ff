#include "SurfacePreparation.h"

#include "PassAttributes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <utility>

namespace haptics
{
namespace
{
vtkSmartPointer<vtkIdTypeArray> MakeIdArray(const char* name, const std::vector<vtkIdType>& ids)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkPoints> MakePoints(const TriangleMesh& mesh, int dataType)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(dataType == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.Points.size()));
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    points->SetPoint(static_cast<vtkIdType>(i), mesh.Points[i].data());
  }
  return points;
}

vtkSmartPointer<vtkCellArray> MakeCells(const TriangleMesh& mesh)
{
  const auto count = static_cast<vtkIdType>(mesh.Triangles.size());
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  vtkIdType* corner = connectivity->GetPointer(0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    offsets->SetValue(i, 3 * i);
    corner = std::copy(mesh.Triangles[i].begin(), mesh.Triangles[i].end(), corner);
  }
  offsets->SetValue(count, 3 * count);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}
}

SurfacePreparation::SurfacePreparation(vtkPolyData* input, const PreparationOptions& options)
  : Options(options)
  , InputKey(MakeKey(input, options))
{
  this->Input->CopyStructure(input);
  if (vtkUnsignedCharArray* ghosts = input->GetCellGhostArray())
  {
    this->Input->GetCellData()->AddArray(ghosts);
  }
}

SurfacePreparation::~SurfacePreparation() = default;

BuildKey SurfacePreparation::MakeKey(vtkPolyData* input, const PreparationOptions& options)
{
  return MakeBuildKey(input,
    { static_cast<double>(options.TouchedSide), static_cast<double>(options.Engine),
      options.Cleaning.MergeTolerance, options.Cleaning.AbsoluteTolerance ? 1.0 : 0.0,
      options.AutomaticCrackWidth ? 1.0 : 0.0, options.CrackWidth });
}

vtkIdTypeArray* SurfacePreparation::OriginalCells() const
{
  return this->CellIds;
}

void SurfacePreparation::CopyPoints()
{
  if (vtkPoints* shared = this->Input->GetPoints())
  {
    vtkNew<vtkPoints> own;
    own->SetDataType(shared->GetDataType());
    own->DeepCopy(shared);
    this->Input->SetPoints(own);
  }
}

void SurfacePreparation::Finish()
{
  this->Input->SetPoints(nullptr);
}

int SurfacePreparation::Fill(vtkPolyData* input, vtkPolyData* output) const
{
  output->SetPoints(this->CleanPoints);
  output->SetPolys(this->CleanTriangles);
  return PassAttributes(input->GetPointData(), input->GetNumberOfPoints(), this->PointIds,
           output->GetPointData()) +
    PassAttributes(
      input->GetCellData(), input->GetNumberOfCells(), this->CellIds, output->GetCellData());
}

CleaningResult SurfacePreparation::Run(const ProgressCall& progress)
{
  CleanedMesh cleaned;
  const CleaningResult result =
    CleanSurface(this->Input, this->Options.Cleaning, progress, cleaned, this->ErrorText);
  if (result != CleaningResult::Done)
  {
    return result;
  }
  if (cleaned.Report.FoldedPolygons > 0)
  {
    this->WarningText = std::to_string(cleaned.Report.FoldedPolygons) +
      " polygons cross themselves, the first is cell " +
      std::to_string(cleaned.Report.FirstFoldedCell) +
      ". They were split into fans, which may not feel as they look.";
  }
  const int dataType = this->Input->GetPoints()->GetDataType();
  this->Found = cleaned.Report;
  this->CleanPoints = MakePoints(cleaned.Mesh, dataType);
  this->CleanTriangles = MakeCells(cleaned.Mesh);
  this->PointIds = MakeIdArray("OriginalPointId", cleaned.OriginalPoint);
  this->CellIds = MakeIdArray("OriginalCellId", cleaned.OriginalCell);
  if (progress && !progress(0.5))
  {
    return CleaningResult::Aborted;
  }

  SurfaceOptions options;
  options.TouchedSide = this->Options.TouchedSide;
  options.Engine = this->Options.Engine;
  options.CrackWidth = this->Options.CrackWidth;
  if (this->Options.AutomaticCrackWidth)
  {
    options.CrackWidth = dataType == VTK_FLOAT ? 0x1p-21 * cleaned.LargestCoordinate : 0.0;
  }
  this->CrackWidthInUse = options.CrackWidth;
  std::string error;
  this->Built = TriangleSurface::Build(std::move(cleaned.Mesh), options, error);
  if (!this->Built)
  {
    this->ErrorText = "No surface could be built from the " +
      std::to_string(cleaned.OriginalCell.size()) + " clean triangles: " + error +
      ". Check the input and this filter's properties.";
    return CleaningResult::Failed;
  }
  return CleaningResult::Done;
}
}
