// What a vtkGodObjectActor leaves on the surface, and the legend: trail, active triangles,
// landmarks.
#include "vtkGodObjectActor.h"

#include "haptics/View/ViewHeight.h"
#include "vtkActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkShaderProperty.h"
#include "vtkStringArray.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkUniforms.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace
{
constexpr double DefaultSize = 0.012; // of the view's height
constexpr double TrianglesLift = 1.0; // [pixel] towards the viewer
constexpr double TrailLift = 4.0;     // a line's width more: half of it dips into a slope
constexpr double TextHeight = 0.045;  // of the view's height
constexpr double SmallestText = 10.0; // [pixel]
constexpr double LargestText = 15.0;  // [pixel]
constexpr double TextLift = 1.5;      // in heights of the text
constexpr vtkIdType RingBands = 3;
constexpr double RingEdge = 0.1; // grey of the dark bands
constexpr const char* LiftUniform = "hapticsLift";

/// Draws what lies in a surface a little nearer than the surface, by Lift(). VTK's own offset is
/// one for all mappers of a program, which is not ours to change.
void DrawTrianglesNearer(vtkActor* part)
{
  part->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Depth::Impl", true,
    "gl_FragDepth = gl_FragCoord.z - hapticsLift * gl_FragCoord.w;\n", false);
}

/// As above for tubes and balls, whose round depth VTK has written before this place.
void DrawRoundNearer(vtkActor* part)
{
  part->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Coincident::Impl", true,
    "//VTK::Coincident::Impl\n  gl_FragDepth = gl_FragDepth - hapticsLift * gl_FragCoord.w;\n",
    false);
}

/// Where VTK is to resolve coincident topology, as in ParaView, it shifts all points and lines of a
/// program by an offset. For balls and tubes it takes that from a depth that it has not written
/// yet: on some drivers that is no number, and nothing of them is seen. Lift() is enough.
void TakeOffsetBack(vtkActor* part)
{
  double factor = 0.0;
  double units = 0.0;
  vtkMapper::GetResolveCoincidentTopologyPointOffsetParameter(units);
  part->GetMapper()->SetRelativeCoincidentTopologyPointOffsetParameter(-units);
  vtkMapper::GetResolveCoincidentTopologyLineOffsetParameters(factor, units);
  part->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-factor, -units);
}

/// Lifts a part by the width of some pixels, wherever it is: at a distance d in perspective a pixel
/// is c d wide, the depth buffer's slope goes with 1/d^2, and gl_FragCoord.w is 1/d. In parallel
/// projection all three are constant.
void Lift(vtkActor* part, vtkViewport* viewport, double pixels)
{
  vtkRenderer* renderer = vtkRenderer::SafeDownCast(viewport);
  if (!renderer)
  {
    return;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* range = camera->GetClippingRange();
  const bool parallel = camera->GetParallelProjection() != 0;
  const double height = haptics::ViewHeight(camera, 1.0);
  const double slope = (parallel ? 1.0 : range[0] * range[1]) / (range[1] - range[0]);
  const double lift = pixels * height / std::max(1, viewport->GetSize()[1]) * slope;
  part->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
    LiftUniform, static_cast<float>(lift));
}

/// Bright on a dark ground with a bright edge, to be read over anything.
vtkSmartPointer<vtkBillboardTextActor3D> MakeText()
{
  auto text = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  text->PickableOff();
  text->UseBoundsOff();
  text->ForceOpaqueOn();
  vtkTextProperty* const look = text->GetTextProperty();
  look->SetFontFamilyToArial();
  look->BoldOn();
  look->SetColor(0.96, 0.97, 0.98);
  look->SetBackgroundColor(0.09, 0.11, 0.15);
  look->SetBackgroundOpacity(1.0);
  look->SetFrame(true);
  look->SetFrameColor(0.96, 0.97, 0.98);
  look->SetFrameWidth(1);
  look->SetJustificationToLeft();
  look->SetVerticalJustificationToCentered();
  return text;
}

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
    this->TrailBounds.Reset();
    for (const TrailPoint& last : this->TrailPoints)
    {
      this->TrailBounds.AddPoint(last.Position[0], last.Position[1], last.Position[2]);
    }
  }
  this->TrailBounds.AddPoint(point[0], point[1], point[2]);
  this->TrailPoints.push_back({ { point[0], point[1], point[2] }, touching });
  this->TrailChanged = true;
  this->Modified();
}

void vtkGodObjectActor::ClearTrail()
{
  if (!this->TrailPoints.empty())
  {
    this->TrailPoints.clear();
    this->TrailBounds.Reset();
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

/// Three bands of 1 in radius around the y axis: the coloured one between two dark ones, so that it
/// stands out from bright and dark surfaces.
void vtkGodObjectActor::MakeRing()
{
  constexpr int Sides = 72;
  constexpr std::array<double, 4> Radii{ { 0.74, 0.80, 1.0, 1.06 } };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < Sides; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * i / Sides;
    for (const double radius : Radii)
    {
      points->InsertNextPoint(radius * std::cos(angle), 0.0, radius * std::sin(angle));
    }
  }
  vtkNew<vtkCellArray> quads;
  for (vtkIdType i = 0; i < Sides; ++i)
  {
    const vtkIdType next = (i + 1) % Sides;
    for (vtkIdType band = 0; band < RingBands; ++band)
    {
      const vtkIdType corners[4] = { 4 * i + band, 4 * i + band + 1, 4 * next + band + 1,
        4 * next + band };
      quads->InsertNextCell(4, corners);
    }
  }
  this->Ring->SetPoints(points);
  this->Ring->SetPolys(quads);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(quads->GetNumberOfCells());
  this->Ring->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Ring);
  this->ContactPart->SetMapper(mapper);
  this->ContactPart->GetProperty()->LightingOff();
  this->ContactPart->PickableOff();
}

void vtkGodObjectActor::ColorRing(const double color[3])
{
  auto* colors = vtkUnsignedCharArray::SafeDownCast(this->Ring->GetCellData()->GetScalars());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double value = i % RingBands == 1 ? color[k] : RingEdge;
      colors->SetTypedComponent(i, k, static_cast<unsigned char>(255.0 * value));
    }
  }
  colors->Modified();
  this->Ring->Modified();
}

void vtkGodObjectActor::KeepRingOnSurface()
{
  DrawTrianglesNearer(this->ContactPart);
}

void vtkGodObjectActor::LiftRing(vtkViewport* viewport)
{
  Lift(this->ContactPart, viewport, TrailLift);
}

void vtkGodObjectActor::MakeMarks()
{
  this->MakeRing();
  vtkNew<vtkPolyDataMapper> trail;
  trail->SetInputData(this->Trail);
  this->TrailPart->SetMapper(trail);
  this->TrailPart->PickableOff();
  DrawRoundNearer(this->TrailPart);
  vtkProperty* line = this->TrailPart->GetProperty();
  line->SetColor(1.0, 0.62, 0.1);
  line->SetLineWidth(3.0f);
  line->RenderLinesAsTubesOn();

  vtkNew<vtkPolyDataMapper> triangles;
  triangles->SetInputData(this->Triangles);
  triangles->ScalarVisibilityOff();
  this->TrianglesPart->SetMapper(triangles);
  this->TrianglesPart->PickableOff();
  DrawTrianglesNearer(this->TrianglesPart);
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
  DrawRoundNearer(this->LandmarksPart);
  this->LandmarksPart->GetProperty()->SetColor(0.10, 0.55, 0.75);
  this->LandmarksPart->GetProperty()->SetAmbient(0.3);
}

void vtkGodObjectActor::ArrangeMarks(vtkViewport* viewport)
{
  // Landmarks are 1.4 times as wide as the god-object's radius, whatever their distance.
  const double pixels =
    1.4 * (this->SizeInWorld ? DefaultSize : this->Size) * viewport->GetSize()[1];
  if (this->TrailChanged)
  {
    this->BuildTrail();
  }
  this->TrailPart->SetVisibility(this->ShowTrail && this->Trail->GetNumberOfLines() > 0);
  for (vtkActor* const part : { this->TrailPart.Get(), this->LandmarksPart.Get() })
  {
    TakeOffsetBack(part);
    Lift(part, viewport, TrailLift);
  }
  Lift(this->TrianglesPart, viewport, TrianglesLift);
  this->TrianglesPart->SetVisibility(this->ShowHand && this->ShowActiveTriangles &&
    this->Touching && this->Triangles->GetNumberOfPolys() > 0);
  this->LandmarksPart->SetVisibility(this->Landmarks->GetNumberOfPoints() > 0);
  this->LandmarksPart->GetProperty()->SetPointSize(static_cast<float>(pixels));
  this->ArrangeTexts(viewport, pixels);
  if (this->ShowLegend)
  {
    this->ArrangeLegend(viewport);
  }
}

/// Each text stands on the right of its ball, as large on the screen wherever it is. It is a flat
/// picture that faces the viewer and would sink into the slope that the ball lies on: so it is
/// taken towards the viewer by its own height, which does not change where it is seen, and only
/// what lies further in front than that hides it.
void vtkGodObjectActor::ArrangeTexts(vtkViewport* viewport, double ball)
{
  vtkRenderer* const renderer = vtkRenderer::SafeDownCast(viewport);
  vtkWindow* const window = viewport->GetVTKWindow();
  const bool shown = this->ShowLandmarkTexts && renderer && window;
  // A picture at a multiple of the window's size is drawn in tiles; VTK makes its text larger.
  const int tiles = window ? window->GetTileScale()[1] : 1;
  const double view = std::max(1, viewport->GetSize()[1]); // [pixel]
  const double font = std::min(LargestText, std::max(SmallestText, TextHeight * view));
  for (std::size_t i = 0; i < this->LandmarkTexts.size(); ++i)
  {
    vtkBillboardTextActor3D* const text = this->LandmarkTexts[i];
    text->SetVisibility(shown);
    if (!shown)
    {
      continue;
    }
    text->GetTextProperty()->SetFontSize(static_cast<int>(font));
    text->SetDisplayOffset(static_cast<int>(tiles * (0.5 * ball + 0.3 * font)), 0);
    vtkCamera* const camera = renderer->GetActiveCamera();
    double anchor[3];
    this->Landmarks->GetPoint(static_cast<vtkIdType>(i), anchor);
    double toViewer[3];
    const double* const axis = camera->GetDirectionOfProjection();
    for (int k = 0; k < 3; ++k)
    {
      toViewer[k] =
        camera->GetParallelProjection() ? -axis[k] : camera->GetPosition()[k] - anchor[k];
    }
    const double distance = vtkMath::Normalize(toViewer);
    const double height = haptics::ViewHeight(camera, distance);
    const double lift = std::min(TextLift * font * height / view, 0.5 * distance);
    for (int k = 0; k < 3; ++k)
    {
      anchor[k] += lift * toViewer[k];
    }
    text->SetPosition(anchor);
  }
}

void vtkGodObjectActor::ArrangeLegend(vtkViewport* viewport)
{
  if (!this->Legend)
  {
    this->Legend = vtkSmartPointer<vtkScalarBarActor>::New();
    this->Legend->SetLookupTable(this->ForceColors);
    this->Legend->SetTitle("force [N]");
    this->Legend->SetNumberOfLabels(4);
    this->Legend->SetLabelFormat("%.1f");
    this->Legend->UnconstrainedFontSizeOn();
    this->Legend->SetBarRatio(0.22);
    this->Legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
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
  // At the upper right; wide enough for its title, whatever the view's size.
  const double width = std::min(1.0, 74.0 / std::max(1, viewport->GetSize()[0]));
  const double height = std::min(0.42, 260.0 / std::max(1, viewport->GetSize()[1]));
  this->Legend->SetWidth(width);
  this->Legend->SetHeight(height);
  this->Legend->SetPosition(1.0 - width, 0.97 - height);
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
  auto* const texts =
    vtkStringArray::SafeDownCast(this->Landmarks->GetPointData()->GetAbstractArray("Text"));
  // Without VTK's text renderer there is none in the program.
  const bool isWritten = texts && vtkTextRenderer::GetInstance();
  this->LandmarkTexts.resize(
    isWritten ? static_cast<std::size_t>(this->Landmarks->GetNumberOfPoints()) : 0);
  for (std::size_t i = 0; i < this->LandmarkTexts.size(); ++i)
  {
    if (!this->LandmarkTexts[i])
    {
      this->LandmarkTexts[i] = MakeText();
    }
    const std::string text = " " + texts->GetValue(static_cast<vtkIdType>(i)) + " ";
    this->LandmarkTexts[i]->SetInput(text.c_str());
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
