// What a vtkGodObjectActor leaves on the surface, and the legend: trail, active triangles,
// landmarks.
#include "vtkGodObjectActor.h"

#include "ForceColor.h"
#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkLookupTable.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkScalarBarActor.h"
#include "vtkShaderProperty.h"
#include "vtkTextProperty.h"

#include <array>
#include <cmath>

namespace
{
constexpr int LegendColors = 128;

bool AllFinite(const double v[3])
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
}

void vtkGodObjectActor::AddTrailPoint(const double point[3], bool touching)
{
  if (!this->ShowTrail)
  {
    return;
  }
  if (!AllFinite(point))
  {
    vtkErrorMacro("A trail point (" << point[0] << ", " << point[1] << ", " << point[2]
                                    << ") is not finite; it was left out.");
    return;
  }
  // Forgetting half at once keeps the cost of an added point constant.
  if (this->TrailPoints.size() >= static_cast<std::size_t>(this->MaximumTrailPoints))
  {
    const auto kept = static_cast<std::ptrdiff_t>(this->MaximumTrailPoints / 2);
    this->TrailPoints.erase(this->TrailPoints.begin(), this->TrailPoints.end() - kept);
  }
  this->TrailPoints.push_back({ { point[0], point[1], point[2] }, touching });
  this->TrailChanged = true;
  this->Modified();
}

void vtkGodObjectActor::ClearTrail()
{
  if (!this->TrailPoints.empty())
  {
    this->TrailPoints.clear();
    this->TrailChanged = true;
    this->Modified();
  }
}

void vtkGodObjectActor::BuildTrail()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  std::vector<vtkIdType> line;
  const auto endLine = [&]()
  {
    if (line.size() > 1)
    {
      lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    }
    line.clear();
  };
  for (const TrailPoint& point : this->TrailPoints)
  {
    if (point.Touching)
    {
      line.push_back(points->InsertNextPoint(point.Position));
    }
    else
    {
      endLine();
    }
  }
  endLine();
  this->Trail->SetPoints(points);
  this->Trail->SetLines(lines);
  this->TrailChanged = false;
}

void vtkGodObjectActor::MakeMarks()
{
  vtkNew<vtkPolyDataMapper> triangles;
  triangles->SetInputData(this->Triangles);
  triangles->ScalarVisibilityOff();
  this->TrianglesPart->SetMapper(triangles);
  this->TrianglesPart->PickableOff();
  // A little nearer than the surface in which they lie. VTK's own offset is one for all mappers of
  // a program, which is not ours to change.
  this->TrianglesPart->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Depth::Impl", true, "gl_FragDepth = 0.9995 * gl_FragCoord.z;\n", false);
  vtkProperty* look = this->TrianglesPart->GetProperty();
  look->SetColor(1.0, 0.86, 0.42);
  look->LightingOff();
  look->EdgeVisibilityOn();
  look->SetEdgeColor(0.55, 0.30, 0.02);
  look->SetLineWidth(1.5f);

  vtkNew<vtkPolyDataMapper> landmarks;
  landmarks->SetInputData(this->Landmarks);
  landmarks->ScalarVisibilityOff();
  this->LandmarksPart->SetMapper(landmarks);
  this->LandmarksPart->GetProperty()->RenderPointsAsSpheresOn();
  this->LandmarksPart->PickableOff();
  this->LandmarksPart->GetProperty()->SetColor(0.10, 0.55, 0.75);
  this->LandmarksPart->GetProperty()->SetAmbient(0.3);
}

void vtkGodObjectActor::ArrangeMarks(double pixels)
{
  this->TrianglesPart->SetVisibility(
    this->ShowActiveTriangles && this->Touching && this->Triangles->GetNumberOfPolys() > 0);
  this->LandmarksPart->SetVisibility(this->Landmarks->GetNumberOfPoints() > 0);
  this->LandmarksPart->GetProperty()->SetPointSize(static_cast<float>(pixels));
  if (this->ShowLegend)
  {
    this->ArrangeLegend();
  }
}

void vtkGodObjectActor::ArrangeLegend()
{
  if (!this->Legend)
  {
    this->Legend = vtkSmartPointer<vtkScalarBarActor>::New();
    vtkNew<vtkLookupTable> table;
    table->SetNumberOfTableValues(LegendColors);
    table->Build();
    for (int i = 0; i < LegendColors; ++i)
    {
      const std::array<double, 3> color =
        haptics::ForceColor(static_cast<double>(i) / (LegendColors - 1));
      table->SetTableValue(i, color[0], color[1], color[2], 1.0);
    }
    this->Legend->SetLookupTable(table);
    this->Legend->SetTitle("force [N]");
    this->Legend->SetNumberOfLabels(4);
    this->Legend->SetLabelFormat("%.1f");
    this->Legend->UnconstrainedFontSizeOn();
    this->Legend->SetWidth(0.13);
    this->Legend->SetHeight(0.42);
    this->Legend->SetMaximumWidthInPixels(70);
    this->Legend->SetMaximumHeightInPixels(260);
    this->Legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    this->Legend->SetPosition(0.86, 0.54);
    for (vtkTextProperty* text :
      { this->Legend->GetTitleTextProperty(), this->Legend->GetLabelTextProperty() })
    {
      text->SetColor(0.18, 0.21, 0.27);
      text->SetFontSize(12);
      text->ItalicOff();
      text->BoldOff();
      text->ShadowOff();
    }
  }
  this->Legend->GetLookupTable()->SetRange(0.0, this->ReferenceForce);
}

void vtkGodObjectActor::SetActiveTriangles(const double* corners, int numberOfTriangles)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (int i = 0; i < numberOfTriangles; ++i)
  {
    cells->InsertNextCell(3);
    for (int k = 0; k < 3; ++k)
    {
      cells->InsertCellPoint(points->InsertNextPoint(corners + 9 * i + 3 * k));
    }
  }
  this->Triangles->SetPoints(points);
  this->Triangles->SetPolys(cells);
  this->Modified();
}

void vtkGodObjectActor::SetLandmarks(vtkPolyData* points)
{
  this->Landmarks->Initialize();
  if (points)
  {
    this->Landmarks->ShallowCopy(points);
  }
  this->Landmarks->Modified();
  this->Modified();
}

vtkProperty* vtkGodObjectActor::GetLandmarksProperty()
{
  return this->LandmarksPart->GetProperty();
}

vtkProperty* vtkGodObjectActor::GetActiveTrianglesProperty()
{
  return this->TrianglesPart->GetProperty();
}
