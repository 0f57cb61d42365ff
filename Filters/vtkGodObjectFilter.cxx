#include "vtkGodObjectFilter.h"

#include "BuildKey.h"
#include "PassAttributes.h"
#include "SurfaceCleaner.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <utility>
#include <vector>

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

vtkSmartPointer<vtkPoints> MakePoints(const haptics::TriangleMesh& mesh, int dataType)
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

vtkSmartPointer<vtkCellArray> MakeCells(const haptics::TriangleMesh& mesh)
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

class vtkGodObjectFilter::vtkInternals
{
public:
  haptics::BuildKey Key;
  std::shared_ptr<const haptics::TriangleSurface> Surface;
  haptics::CleaningReport Report;
  double CrackWidth = 0.0;
  vtkSmartPointer<vtkPoints> Points;
  vtkSmartPointer<vtkCellArray> Triangles;
  vtkSmartPointer<vtkIdTypeArray> OriginalPoints;
  vtkSmartPointer<vtkIdTypeArray> OriginalCells;
};

vtkStandardNewMacro(vtkGodObjectFilter);

vtkGodObjectFilter::vtkGodObjectFilter()
  : Internals(new vtkInternals)
{
}

vtkGodObjectFilter::~vtkGodObjectFilter() = default;

int vtkGodObjectFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that a missing input reaches RequestData and does not leave the last surface
  // there.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

bool vtkGodObjectFilter::Build(vtkPolyData* input)
{
  ++this->NumberOfBuilds;
  std::string error;
  haptics::CleanedMesh cleaned;
  const haptics::CleaningOptions cleaning{ this->MergeTolerance, this->MergeToleranceIsAbsolute };
  const haptics::CleaningResult result = haptics::CleanSurface(
    input, cleaning,
    [this](double fraction)
    {
      this->UpdateProgress(fraction);
      return !this->GetAbortExecute();
    },
    cleaned, error);
  if (result == haptics::CleaningResult::Aborted)
  {
    return false;
  }
  if (result == haptics::CleaningResult::Failed)
  {
    vtkErrorMacro(<< error);
    return false;
  }
  if (cleaned.Report.FoldedPolygons > 0)
  {
    vtkWarningMacro(<< cleaned.Report.FoldedPolygons << " polygons cross themselves, the first is "
                    << "cell " << cleaned.Report.FirstFoldedCell
                    << ". They were split into fans, which may not feel as they look.");
  }
  vtkInternals& built = *this->Internals;
  const int dataType = input->GetPoints()->GetDataType();
  built.Report = cleaned.Report;
  built.Points = MakePoints(cleaned.Mesh, dataType);
  built.Triangles = MakeCells(cleaned.Mesh);
  built.OriginalPoints = MakeIdArray("OriginalPointId", cleaned.OriginalPoint);
  built.OriginalCells = MakeIdArray("OriginalCellId", cleaned.OriginalCell);
  this->UpdateProgress(0.5);

  haptics::SurfaceOptions options;
  options.TouchedSide = static_cast<haptics::Side>(this->Side);
  options.Engine = static_cast<haptics::EngineKind>(this->Engine);
  options.CrackWidth = this->CrackWidth;
  if (this->AutomaticCrackWidth)
  {
    options.CrackWidth = dataType == VTK_FLOAT ? 0x1p-21 * cleaned.LargestCoordinate : 0.0;
  }
  built.CrackWidth = options.CrackWidth;
  built.Surface = haptics::TriangleSurface::Build(std::move(cleaned.Mesh), options, error);
  if (!built.Surface)
  {
    vtkErrorMacro(<< "No surface could be built from the " << cleaned.OriginalCell.size()
                  << " clean triangles: " << error
                  << ". Check the input and this filter's properties.");
    return false;
  }
  return true;
}

int vtkGodObjectFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!input)
  {
    *this->Internals = vtkInternals();
    vtkErrorMacro("There is no input to touch. Connect a vtkPolyData with polygons or strips.");
    return 1;
  }
  haptics::BuildKey key = haptics::MakeBuildKey(input,
    { static_cast<double>(this->Side), static_cast<double>(this->Engine), this->MergeTolerance,
      this->MergeToleranceIsAbsolute ? 1.0 : 0.0, this->AutomaticCrackWidth ? 1.0 : 0.0,
      this->CrackWidth });
  vtkInternals& built = *this->Internals;
  if (!built.Surface || !(built.Key == key))
  {
    built = vtkInternals();
    if (!this->Build(input))
    {
      built = vtkInternals();
      return 1;
    }
    built.Key = std::move(key);
  }
  output->SetPoints(built.Points);
  output->SetPolys(built.Triangles);
  const int dropped = haptics::PassAttributes(input->GetPointData(), input->GetNumberOfPoints(),
                        built.OriginalPoints, output->GetPointData()) +
    haptics::PassAttributes(
      input->GetCellData(), input->GetNumberOfCells(), built.OriginalCells, output->GetCellData());
  if (dropped > 0)
  {
    vtkWarningMacro(<< dropped << " data arrays of the input are shorter than its points or cells, "
                    << "and were left out.");
  }
  this->AddReport(output);
  this->UpdateProgress(1.0);
  return 1;
}

void vtkGodObjectFilter::AddReport(vtkPolyData* output) const
{
  vtkFieldData* fields = output->GetFieldData();
  const auto add = [fields](const char* name, vtkIdType value)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    fields->AddArray(array);
  };
  add("MergedPoints", this->GetNumberOfMergedPoints());
  add("UnusedPoints", this->GetNumberOfUnusedPoints());
  add("DegenerateTriangles", this->GetNumberOfDegenerateTriangles());
  add("DuplicateTriangles", this->GetNumberOfDuplicateTriangles());
  add("FoldedPolygons", this->GetNumberOfFoldedPolygons());
  add("GhostCells", this->GetNumberOfGhostCells());
  add("BoundaryEdges", this->GetNumberOfBoundaryEdges());
  add("NonManifoldEdges", this->GetNumberOfNonManifoldEdges());
  add("FlippedEdges", this->GetNumberOfFlippedEdges());
  add("Components", this->GetNumberOfComponents());
  add("InsideOutComponents", this->GetNumberOfInsideOutComponents());
  add("Closed", this->GetClosed());
  add("Oriented", this->GetOriented());
  vtkNew<vtkStringArray> side;
  side->SetName("TouchedSide");
  side->InsertNextValue(this->GetTouchedSideAsString());
  fields->AddArray(side);
  vtkNew<vtkDoubleArray> crackWidth;
  crackWidth->SetName("CrackWidthInUse");
  crackWidth->InsertNextValue(this->GetCrackWidthInUse());
  fields->AddArray(crackWidth);
}

std::shared_ptr<const haptics::TriangleSurface> vtkGodObjectFilter::GetSurface() const
{
  return this->Internals->Surface;
}

vtkIdType vtkGodObjectFilter::GetNumberOfMergedPoints() const
{
  return this->Internals->Report.MergedPoints;
}

vtkIdType vtkGodObjectFilter::GetNumberOfUnusedPoints() const
{
  return this->Internals->Report.UnusedPoints;
}

vtkIdType vtkGodObjectFilter::GetNumberOfDegenerateTriangles() const
{
  return this->Internals->Report.DegenerateTriangles;
}

vtkIdType vtkGodObjectFilter::GetNumberOfDuplicateTriangles() const
{
  return this->Internals->Report.DuplicateTriangles;
}

vtkIdType vtkGodObjectFilter::GetNumberOfFoldedPolygons() const
{
  return this->Internals->Report.FoldedPolygons;
}

vtkIdType vtkGodObjectFilter::GetNumberOfGhostCells() const
{
  return this->Internals->Report.GhostCells;
}

vtkIdType vtkGodObjectFilter::GetNumberOfBoundaryEdges() const
{
  return this->Internals->Surface ? this->Internals->Surface->Report().BoundaryEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfNonManifoldEdges() const
{
  return this->Internals->Surface ? this->Internals->Surface->Report().NonManifoldEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfFlippedEdges() const
{
  return this->Internals->Surface ? this->Internals->Surface->Report().FlippedEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfComponents() const
{
  return this->Internals->Surface ? this->Internals->Surface->Report().Components : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfInsideOutComponents() const
{
  return this->Internals->Surface ? this->Internals->Surface->Report().InsideOutComponents : 0;
}

bool vtkGodObjectFilter::GetClosed() const
{
  return this->Internals->Surface && this->Internals->Surface->Report().Closed;
}

bool vtkGodObjectFilter::GetOriented() const
{
  return this->Internals->Surface && this->Internals->Surface->Report().Oriented;
}

int vtkGodObjectFilter::GetTouchedSide() const
{
  return this->Internals->Surface ? static_cast<int>(this->Internals->Surface->TouchedSide())
                                  : static_cast<int>(FRONT);
}

int vtkGodObjectFilter::GetEngineInUse() const
{
  return this->Internals->Surface ? static_cast<int>(this->Internals->Surface->Engine().Kind())
                                  : static_cast<int>(AUTOMATIC_ENGINE);
}

double vtkGodObjectFilter::GetCrackWidthInUse() const
{
  return this->Internals->CrackWidth;
}

const char* vtkGodObjectFilter::GetTouchedSideAsString() const
{
  if (!this->Internals->Surface)
  {
    return "";
  }
  return this->GetTouchedSide() == FRONT ? "Front" : "Both";
}

const char* vtkGodObjectFilter::GetEngineInUseAsString() const
{
  static const char* const names[] = { "", "BruteForce", "Embree", "Exact" };
  return names[this->GetEngineInUse()];
}

void vtkGodObjectFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const sides[] = { "Front", "Both", "Automatic" };
  static const char* const engines[] = { "Automatic", "BruteForce", "Embree", "Exact" };
  os << indent << "Side: " << sides[this->Side] << "\n";
  os << indent << "Engine: " << engines[this->Engine] << "\n";
  os << indent << "MergeTolerance: " << this->MergeTolerance
     << (this->MergeToleranceIsAbsolute ? " world units\n" : " of the bounds' diagonal\n");
  os << indent << "AutomaticCrackWidth: " << (this->AutomaticCrackWidth ? "On\n" : "Off\n");
  os << indent << "CrackWidth: " << this->CrackWidth << "\n";
  os << indent << "NumberOfBuilds: " << this->NumberOfBuilds << "\n";
  if (!this->Internals->Surface)
  {
    os << indent << "Surface: (none)\n";
    return;
  }
  os << indent << "Surface: " << this->Internals->Surface->Triangles().size() << " triangles\n";
  os << indent << "TouchedSide: " << this->GetTouchedSideAsString() << "\n";
  os << indent << "EngineInUse: " << this->GetEngineInUseAsString() << "\n";
  os << indent << "CrackWidthInUse: " << this->GetCrackWidthInUse() << "\n";
  os << indent << "MergedPoints: " << this->GetNumberOfMergedPoints() << "\n";
  os << indent << "UnusedPoints: " << this->GetNumberOfUnusedPoints() << "\n";
  os << indent << "DegenerateTriangles: " << this->GetNumberOfDegenerateTriangles() << "\n";
  os << indent << "DuplicateTriangles: " << this->GetNumberOfDuplicateTriangles() << "\n";
  os << indent << "FoldedPolygons: " << this->GetNumberOfFoldedPolygons() << "\n";
  os << indent << "GhostCells: " << this->GetNumberOfGhostCells() << "\n";
  os << indent << "BoundaryEdges: " << this->GetNumberOfBoundaryEdges() << "\n";
  os << indent << "NonManifoldEdges: " << this->GetNumberOfNonManifoldEdges() << "\n";
  os << indent << "FlippedEdges: " << this->GetNumberOfFlippedEdges() << "\n";
  os << indent << "Components: " << this->GetNumberOfComponents() << "\n";
  os << indent << "InsideOutComponents: " << this->GetNumberOfInsideOutComponents() << "\n";
  os << indent << "Closed: " << (this->GetClosed() ? "Yes\n" : "No\n");
  os << indent << "Oriented: " << (this->GetOriented() ? "Yes\n" : "No\n");
}
