#include "vtkGodObjectFilter.h"

#include "haptics/Filters/NumberSetting.h"
#include "haptics/Filters/SurfacePreparation.h"
#include "vtkHapticProperties.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>

class vtkGodObjectFilter::vtkInternals
{
public:
  std::shared_ptr<const haptics::SurfacePreparation> Built; // null, or with a surface
  vtkSmartPointer<vtkHapticProperties> Properties = vtkSmartPointer<vtkHapticProperties>::New();

  // The last properties made, and what of.
  std::shared_ptr<const haptics::SurfaceProperties> Made;
  std::shared_ptr<const haptics::TriangleSurface> MadeFor;
  vtkMTimeType MadeAt = 0;
  std::string Said; // what was wrong with them

  std::string SaidOfSides;
  std::string SaidOfSideValues;

  /// The array that is chosen for a purpose.
  static vtkHapticProperties::ChosenArray Choose(
    vtkGodObjectFilter* filter, int index, vtkPolyData* geometry);
};

static_assert(
  static_cast<int>(vtkGodObjectFilter::SIDE_ARRAY) == vtkHapticProperties::NUMBER_OF_PROPERTIES &&
    static_cast<int>(vtkGodObjectFilter::MIXED_SIDES) == static_cast<int>(haptics::Side::Mixed),
  "no index is given twice, and both list the same sides");

vtkStandardNewMacro(vtkGodObjectFilter);

vtkGodObjectFilter::vtkGodObjectFilter()
  : Internals(new vtkInternals)
{
}

vtkGodObjectFilter::~vtkGodObjectFilter() = default;

void vtkGodObjectFilter::SetMergeTolerance(double value)
{
  haptics::SetNumber(this, "MergeTolerance", this->MergeTolerance, value, 0.0, 1e100);
}

void vtkGodObjectFilter::SetCrackWidth(double value)
{
  haptics::SetNumber(this, "CrackWidth", this->CrackWidth, value, 0.0, 1e100);
}

int vtkGodObjectFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that a missing input reaches RequestData and does not leave the last surface
  // there.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return this->Superclass::FillInputPortInformation(port, info);
}

void vtkGodObjectFilter::SetProperties(vtkHapticProperties* properties)
{
  if (!properties)
  {
    this->Internals->Properties = vtkSmartPointer<vtkHapticProperties>::New();
  }
  else if (this->Internals->Properties == properties)
  {
    return;
  }
  else
  {
    this->Internals->Properties = properties;
  }
  this->Internals->MadeFor.reset();
  this->Modified();
}

vtkHapticProperties* vtkGodObjectFilter::GetProperties()
{
  return this->Internals->Properties;
}

vtkMTimeType vtkGodObjectFilter::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->Internals->Properties->GetMTime());
}

bool vtkGodObjectFilter::HasBadArray() const
{
  const vtkInternals& internals = *this->Internals;
  return !internals.Said.empty() || !internals.SaidOfSides.empty() ||
    !internals.SaidOfSideValues.empty();
}

std::shared_ptr<const haptics::SurfaceProperties> vtkGodObjectFilter::GetSurfaceProperties() const
{
  return this->Internals->Made;
}

std::shared_ptr<const haptics::SurfaceProperties> vtkGodObjectFilter::MakeProperties(
  vtkPolyData* geometry, const std::shared_ptr<const haptics::TriangleSurface>& surface)
{
  const auto choose = [&](int property) { return vtkInternals::Choose(this, property, geometry); };
  vtkInternals& internals = *this->Internals;
  const vtkMTimeType now = internals.Properties->GetMTime();
  const bool isSame = internals.MadeFor == surface && internals.MadeAt == now;
  std::string problems;
  auto made = internals.Properties->Build(
    geometry, *surface, choose, isSame ? internals.Made : nullptr, problems);
  if (!problems.empty() && problems != internals.Said)
  {
    vtkErrorMacro(<< problems);
  }
  internals.Said = problems;
  internals.Made = made;
  internals.MadeFor = surface;
  internals.MadeAt = now;
  return made;
}

vtkHapticProperties::ChosenArray vtkGodObjectFilter::vtkInternals::Choose(
  vtkGodObjectFilter* filter, int index, vtkPolyData* geometry)
{
  vtkHapticProperties::ChosenArray chosen;
  vtkInformation* const wanted = filter->GetInputArrayInformation(index);
  const char* const name = wanted->Get(vtkDataObject::FIELD_NAME());
  if ((name && *name) || wanted->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
    chosen.Array = filter->GetInputArrayToProcess(index, geometry, association);
    chosen.IsPerCell = association == vtkDataObject::FIELD_ASSOCIATION_CELLS;
    // What ParaView calls the choice of none.
    const bool isNone = name && std::strcmp(name, "None") == 0;
    chosen.Missing = chosen.Array || isNone ? "" : name ? name : "of the attribute asked for";
  }
  return chosen;
}

haptics::PreparationOptions vtkGodObjectFilter::GetOptions(vtkPolyData* geometry)
{
  haptics::PreparationOptions options;
  const vtkHapticProperties::ChosenArray sides = vtkInternals::Choose(this, SIDE_ARRAY, geometry);
  std::string problem;
  if (sides.Array)
  {
    problem = haptics::CheckSideArray(sides.Array, sides.IsPerCell, geometry);
    options.CellSides = problem.empty() ? sides.Array : nullptr;
    const char* const name = sides.Array->GetName();
    problem = problem.empty()
      ? problem
      : std::string("The array ") + (name ? name : "without a name") + " for the side " + problem;
  }
  else if (!sides.Missing.empty())
  {
    problem = "There is no array " + sides.Missing + " for the side";
  }
  if (!problem.empty() && problem != this->Internals->SaidOfSides)
  {
    vtkErrorMacro(<< problem << "; the side of the filter is used.");
  }
  this->Internals->SaidOfSides = problem;
  options.Cleaning = { this->MergeTolerance, this->MergeToleranceIsAbsolute };
  options.TouchedSide = static_cast<haptics::Side>(this->Side);
  options.Engine = static_cast<haptics::EngineKind>(this->Engine);
  options.AutomaticCrackWidth = this->AutomaticCrackWidth;
  options.CrackWidth = this->CrackWidth;
  return options;
}

bool vtkGodObjectFilter::Take(
  const std::shared_ptr<haptics::SurfacePreparation>& prepared, haptics::CleaningResult result)
{
  ++this->NumberOfBuilds;
  prepared->Finish();
  this->Internals->Built.reset();
  if (result == haptics::CleaningResult::Aborted)
  {
    return false;
  }
  if (!prepared->Warning().empty())
  {
    vtkWarningMacro(<< prepared->Warning());
  }
  if (result == haptics::CleaningResult::Failed)
  {
    vtkErrorMacro(<< prepared->Error());
    return false;
  }
  this->TellOfSides(*prepared);
  this->Internals->Built = prepared;
  return true;
}

void vtkGodObjectFilter::TellOfSides(const haptics::SurfacePreparation& prepared)
{
  if (!prepared.SideError().empty() && prepared.SideError() != this->Internals->SaidOfSideValues)
  {
    vtkErrorMacro(<< prepared.SideError());
  }
  this->Internals->SaidOfSideValues = prepared.SideError();
}

int vtkGodObjectFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!input)
  {
    this->Internals->Built.reset();
    this->Internals->Made.reset();
    vtkErrorMacro("There is no input to touch. Connect a vtkPolyData with polygons or strips.");
    return 1;
  }
  if (vtkGodObjectFilter::IsEmpty(input))
  {
    this->PassNothing(input, output);
    return 1;
  }
  const haptics::PreparationOptions options = this->GetOptions(input);
  if (!this->Internals->Built ||
    !(this->Internals->Built->Key() == haptics::SurfacePreparation::MakeKey(input, options)))
  {
    const auto prepared = std::make_shared<haptics::SurfacePreparation>(input, options);
    const haptics::CleaningResult result = prepared->Run(
      [this](double fraction)
      {
        this->UpdateProgress(fraction);
        return !this->GetAbortExecute();
      });
    this->Internals->Made.reset();
    if (!this->Take(prepared, result))
    {
      return 1;
    }
  }
  const int dropped = this->Internals->Built->Fill(input, output);
  if (dropped > 0)
  {
    vtkWarningMacro(<< dropped << " data arrays of the input are shorter than its points or cells, "
                    << "and were left out.");
  }
  this->MakeProperties(output, this->Internals->Built->Surface());
  this->AddReport(output);
  this->UpdateProgress(1.0);
  return 1;
}

bool vtkGodObjectFilter::IsEmpty(vtkPolyData* input)
{
  // A patch can be empty: then nothing is there.
  return input->GetNumberOfPoints() == 0 && input->GetNumberOfCells() == 0 &&
    !haptics::PatchRecord::ReadFrom(input->GetFieldData());
}

/// Keeps the arrays' names, so that what comes after this filter finds them.
void vtkGodObjectFilter::PassNothing(vtkPolyData* input, vtkPolyData* output)
{
  this->Internals->Built.reset();
  this->Internals->Made.reset();
  output->GetPointData()->ShallowCopy(input->GetPointData());
  output->GetCellData()->ShallowCopy(input->GetCellData());
  const auto addIds = [](vtkDataSetAttributes* data, const char* name)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName(name);
    data->AddArray(ids);
  };
  addIds(output->GetPointData(), "OriginalPointId");
  addIds(output->GetCellData(), "OriginalCellId");
  this->AddReport(output);
  this->UpdateProgress(1.0);
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
  return this->Internals->Built ? this->Internals->Built->Surface() : nullptr;
}

vtkIdType vtkGodObjectFilter::GetNumberOfMergedPoints() const
{
  return this->Internals->Built ? this->Internals->Built->Report().MergedPoints : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfUnusedPoints() const
{
  return this->Internals->Built ? this->Internals->Built->Report().UnusedPoints : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfDegenerateTriangles() const
{
  return this->Internals->Built ? this->Internals->Built->Report().DegenerateTriangles : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfDuplicateTriangles() const
{
  return this->Internals->Built ? this->Internals->Built->Report().DuplicateTriangles : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfFoldedPolygons() const
{
  return this->Internals->Built ? this->Internals->Built->Report().FoldedPolygons : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfGhostCells() const
{
  return this->Internals->Built ? this->Internals->Built->Report().GhostCells : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfBoundaryEdges() const
{
  return this->Internals->Built ? this->Internals->Built->Surface()->Report().BoundaryEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfNonManifoldEdges() const
{
  return this->Internals->Built ? this->Internals->Built->Surface()->Report().NonManifoldEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfFlippedEdges() const
{
  return this->Internals->Built ? this->Internals->Built->Surface()->Report().FlippedEdges : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfComponents() const
{
  return this->Internals->Built ? this->Internals->Built->Surface()->Report().Components : 0;
}

vtkIdType vtkGodObjectFilter::GetNumberOfInsideOutComponents() const
{
  return this->Internals->Built ? this->Internals->Built->Surface()->Report().InsideOutComponents
                                : 0;
}

bool vtkGodObjectFilter::GetClosed() const
{
  return this->Internals->Built && this->Internals->Built->Surface()->Report().Closed;
}

bool vtkGodObjectFilter::GetOriented() const
{
  return this->Internals->Built && this->Internals->Built->Surface()->Report().Oriented;
}

int vtkGodObjectFilter::GetTouchedSide() const
{
  return this->Internals->Built ? static_cast<int>(this->Internals->Built->Surface()->TouchedSide())
                                : static_cast<int>(FRONT);
}

int vtkGodObjectFilter::GetEngineInUse() const
{
  return this->Internals->Built
    ? static_cast<int>(this->Internals->Built->Surface()->Engine().Kind())
    : static_cast<int>(AUTOMATIC_ENGINE);
}

double vtkGodObjectFilter::GetCrackWidthInUse() const
{
  return this->Internals->Built ? this->Internals->Built->CrackWidth() : 0.0;
}

const char* vtkGodObjectFilter::GetTouchedSideAsString() const
{
  if (!this->Internals->Built)
  {
    return "";
  }
  static const char* const names[] = { "Front", "Both", "Automatic", "Mixed" };
  return names[this->GetTouchedSide()];
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
  os << indent << "Properties:\n";
  this->Internals->Properties->PrintSelf(os, indent.GetNextIndent());
  if (!this->Internals->Built)
  {
    os << indent << "Surface: (none)\n";
    return;
  }
  os << indent << "Surface: " << this->Internals->Built->Surface()->Triangles().size()
     << " triangles\n";
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
