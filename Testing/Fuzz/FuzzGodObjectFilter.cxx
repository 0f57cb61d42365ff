// Any polydata: the filter gives clean triangles and a surface, or an error and neither.
#include "FuzzInput.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

namespace haptics::fuzz
{
namespace
{
/// Keeps errors and warnings off the console and counts the errors.
class Counter : public vtkCommand
{
public:
  static Counter* New() { return new Counter; }
  void Execute(vtkObject*, unsigned long event, void*) override
  {
    this->Errors += event == vtkCommand::ErrorEvent;
  }

  int Errors = 0;
};

vtkSmartPointer<vtkCellArray> MakeCells(FuzzInput& input, int numberOfPoints)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const int count = input.Choice(12);
  for (int i = 0; i < count; ++i)
  {
    const int kind = input.Byte();
    const int size = kind < 160 ? 3 : kind % 9;
    cells->InsertNextCell(size);
    for (int corner = 0; corner < size; ++corner)
    {
      const bool isAny = input.Byte() == 255 || numberOfPoints == 0;
      cells->InsertCellPoint(
        isAny ? static_cast<vtkIdType>(input.Word()) : input.Choice(numberOfPoints));
    }
  }
  if (input.Choice(4) == 3)
  {
    cells->ConvertTo32BitStorage();
  }
  return cells;
}

vtkSmartPointer<vtkPolyData> MakePolyData(FuzzInput& input)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  const int numberOfPoints = input.Choice(20);
  if (numberOfPoints > 0)
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(input.Choice(2) ? VTK_FLOAT : VTK_DOUBLE);
    for (int i = 0; i < numberOfPoints; ++i)
    {
      points->InsertNextPoint(input.Place().data());
    }
    data->SetPoints(points);
  }
  data->SetPolys(MakeCells(input, numberOfPoints));
  const int more = input.Byte();
  if (more & 1)
  {
    data->SetStrips(MakeCells(input, numberOfPoints));
  }
  if (more & 2)
  {
    data->SetVerts(MakeCells(input, numberOfPoints));
    data->SetLines(MakeCells(input, numberOfPoints));
  }
  if (more & 4)
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (int i = input.Choice(32); i > 0; --i)
    {
      ghosts->InsertNextValue(input.Byte());
    }
    data->GetCellData()->AddArray(ghosts);
  }
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
      static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    if (more & 8)
    {
      // As often as not shorter than it should be.
      vtkNew<vtkFloatArray> values;
      values->SetName("Values");
      values->SetNumberOfTuples(input.Choice(32));
      values->Fill(1.0);
      attributes->SetScalars(values);
    }
  }
  if (more & 16)
  {
    vtkNew<vtkFloatArray> sides;
    sides->SetName("Sides");
    const bool fits = input.Choice(4) != 3;
    for (vtkIdType i = fits ? data->GetNumberOfCells() : input.Choice(32); i > 0; --i)
    {
      const int side = input.Choice(64);
      sides->InsertNextValue(side < 60 ? static_cast<float>(side % 3) : std::nanf(""));
    }
    data->GetCellData()->AddArray(sides);
  }
  return data;
}

void SetProperties(FuzzInput& input, vtkGodObjectFilter* filter)
{
  filter->SetSide(input.Choice(3));
  filter->SetEngine(input.Choice(4));
  if (input.Choice(4) == 3)
  {
    filter->SetInputArrayToProcess(vtkGodObjectFilter::SIDE_ARRAY, 0, 0,
      input.Choice(8) == 7 ? vtkDataObject::FIELD_ASSOCIATION_POINTS
                           : vtkDataObject::FIELD_ASSOCIATION_CELLS,
      "Sides");
  }
  const int more = input.Byte();
  if (more & 1)
  {
    filter->SetMergeTolerance(input.Coordinate());
    filter->SetMergeToleranceIsAbsolute((more & 2) != 0);
  }
  if (more & 4)
  {
    filter->SetAutomaticCrackWidth(false);
    filter->SetCrackWidth(input.Coordinate());
  }
}

void CheckOutput(vtkPolyData* input, vtkGodObjectFilter* filter, int errors)
{
  vtkPolyData* const output = filter->GetOutput();
  const auto surface = filter->GetSurface();
  // Bad sides are an error, and the surface has the filter's own.
  const bool hasSides = filter->GetInputArrayInformation(vtkGodObjectFilter::SIDE_ARRAY)
                          ->Has(vtkDataObject::FIELD_NAME());
  const bool isEmpty = vtkGodObjectFilter::IsEmpty(input);
  Require(surface || errors > 0 || isEmpty, "a surface, an error or an empty input");
  Require(!isEmpty || (!surface && errors == 0), "an empty input is no error");
  Require(!surface || errors == 0 || hasSides, "not both");
  if (!surface)
  {
    Require(output->GetNumberOfPoints() == 0 && output->GetNumberOfCells() == 0,
      "an error leaves an empty output");
    return;
  }
  const vtkIdType triangles = output->GetNumberOfPolys();
  const vtkIdType points = output->GetNumberOfPoints();
  Require(triangles > 0 && triangles == output->GetNumberOfCells(), "triangles only");
  Require(static_cast<std::size_t>(triangles) == surface->Triangles().size(),
    "output and surface have the same triangles");
  for (vtkIdType i = 0; i < triangles; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    output->GetPolys()->GetCellAtId(i, size, corners);
    Require(size == 3, "three corners");
    for (int k = 0; k < 3; ++k)
    {
      Require(corners[k] >= 0 && corners[k] < points, "corners are points");
      Require(corners[k] == surface->Triangles()[i][k], "output and surface have the same corners");
    }
    Require(corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0],
      "three different corners");
  }
  for (vtkIdType i = 0; i < points; ++i)
  {
    double x[3];
    output->GetPoint(i, x);
    Require(std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]), "points are finite");
  }
  const auto checkIds =
    [](vtkDataSetAttributes* data, const char* name, vtkIdType size, vtkIdType below)
  {
    auto* const ids = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(name));
    Require(ids && ids->GetNumberOfValues() == size, "one original id each");
    for (vtkIdType i = 0; i < size; ++i)
    {
      Require(
        ids->GetValue(i) >= 0 && ids->GetValue(i) < below, "original ids are those of the input");
    }
  };
  checkIds(output->GetPointData(), "OriginalPointId", points, input->GetNumberOfPoints());
  checkIds(output->GetCellData(), "OriginalCellId", triangles, input->GetNumberOfCells());
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(output->GetPointData()),
         static_cast<vtkDataSetAttributes*>(output->GetCellData()) })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      Require(data->GetAbstractArray(i)->GetNumberOfTuples() ==
          (data == output->GetPointData() ? points : triangles),
        "arrays have one tuple each");
    }
  }
}

void CheckTrace(FuzzInput& input, vtkGodObjectFilter* filter)
{
  vtkNew<vtkPoints> places;
  places->SetDataType(VTK_DOUBLE);
  for (int i = 0; i < 16 && !input.IsEmpty(); ++i)
  {
    places->InsertNextPoint(input.Place().data());
  }
  vtkNew<vtkPolyData> path;
  path->SetPoints(places);
  vtkNew<vtkGodObjectTrace> trace;
  vtkNew<Counter> messages;
  trace->AddObserver(vtkCommand::ErrorEvent, messages);
  trace->AddObserver(vtkCommand::WarningEvent, messages);
  trace->SetInputData(path);
  trace->SetSurfaceConnection(filter->GetOutputPort());
  trace->Update();
  vtkPolyData* const output = trace->GetOutput();
  const vtkIdType expected = messages->Errors ? 0 : places->GetNumberOfPoints();
  Require(output->GetNumberOfPoints() == expected, "a point for each HIP, or an error");
  if (expected > 0)
  {
    vtkDataArray* const force = output->GetPointData()->GetArray("Force");
    for (vtkIdType i = 0; i < expected; ++i)
    {
      const double* const f = force->GetTuple3(i);
      Require(std::hypot(f[0], f[1], f[2]) <= trace->GetMaximumForce() * (1.0 + 1e-12),
        "forces are finite and limited");
    }
  }
}
}

void TestOneInput(FuzzInput& input)
{
  const auto data = MakePolyData(input);
  vtkNew<vtkGodObjectFilter> filter;
  vtkNew<Counter> messages;
  filter->AddObserver(vtkCommand::ErrorEvent, messages);
  filter->AddObserver(vtkCommand::WarningEvent, messages);
  SetProperties(input, filter);
  messages->Errors = 0; // a setting that is refused is an error by itself: the one before stays
  filter->SetInputData(data);
  filter->Update();
  CheckOutput(data, filter, messages->Errors);
  if (filter->GetSurface())
  {
    CheckTrace(input, filter);
  }
}
}
