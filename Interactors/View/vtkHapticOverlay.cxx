#include "vtkHapticOverlay.h"

#include "haptics/View/ForceColors.h"
#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

vtkStandardNewMacro(vtkHapticOverlay);

namespace
{
constexpr double GroundColor[3] = { 0.09, 0.11, 0.15 };
constexpr double GroundOpacity = 0.72;
constexpr int Margin = 12;            // [pixel]
constexpr int TextRim = 2;            // [pixel], of the ground that VTK adds around a text
constexpr double LeastLines = 22.0;   // of text that a view has room for
constexpr double LeastColumns = 30.0; // in heights of the text
constexpr int LeastFontSize = 6;      // [pixel] that can be read

void MakeText(vtkTextActor* part, int vertical)
{
  vtkTextProperty* look = part->GetTextProperty();
  look->SetFontFamilyToArial();
  look->SetColor(0.96, 0.97, 0.98);
  look->SetBackgroundColor(GroundColor[0], GroundColor[1], GroundColor[2]);
  look->SetBackgroundOpacity(GroundOpacity);
  look->SetJustificationToLeft();
  look->SetVerticalJustification(vertical);
  look->SetLineSpacing(1.15);
  part->SetTextScaleModeToNone();
  part->PickableOff();
}

void MakeBox(vtkActor2D* part, vtkPolyData* box)
{
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(box);
  part->SetMapper(mapper);
  part->PickableOff();
}

/// A rectangle with its lower left corner at (x, y) [pixel].
void SetBox(vtkPolyData* box, double x, double y, double width, double height)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(x, y, 0.0);
  points->InsertNextPoint(x + width, y, 0.0);
  points->InsertNextPoint(x + width, y + height, 0.0);
  points->InsertNextPoint(x, y + height, 0.0);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[4] = { 0, 1, 2, 3 };
  cells->InsertNextCell(4, corners);
  box->SetPoints(points);
  box->SetPolys(cells);
}

/// Text with a little room around it on its ground: `after` goes to the right of each line.
std::string Padded(const std::string& text, const std::string& after)
{
  std::string padded = "  ";
  for (const char c : text)
  {
    padded += c == '\n' ? after + "\n  " : std::string(1, c);
  }
  return padded + after;
}

/// Shows text in a font of at most that size [pixel], smaller where it would be wider or higher
/// than the room [pixel]; its height [pixel].
double ShowFitting(vtkTextActor* part, const std::string& text, int size, double width,
  double height, int resolution)
{
  std::string padded = Padded(text, "  ");
  // Of a copy: what is changed and changed back is drawn anew.
  vtkNew<vtkTextProperty> look;
  look->ShallowCopy(part->GetTextProperty());
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  int box[4] = { 0, -1, 0, -1 };
  // How many times its room the text takes.
  const auto excessAt = [&](int fontSize)
  {
    look->SetFontSize(fontSize);
    return renderer && !text.empty() && renderer->GetBoundingBox(look, padded, box, resolution)
      ? std::max((box[1] - box[0] + 1) / width, (box[3] - box[2] + 1) / height)
      : 0.0;
  };
  int fitting = size;
  const double excess = excessAt(size);
  if (excess > 1.0)
  {
    // Letters are whole pixels wide, so that a share of the size may be more than that of the
    // width.
    fitting = static_cast<int>(size / excess);
    while (fitting > LeastFontSize && excessAt(fitting) > 1.0)
    {
      --fitting;
    }
    fitting = std::max(LeastFontSize, fitting);
    if (excessAt(fitting) > 1.0)
    {
      padded = Padded(text, "");
    }
  }
  part->SetInput(padded.c_str());
  part->GetTextProperty()->SetFontSize(fitting);
  return box[3] - box[2] + 1;
}
}

vtkHapticOverlay::vtkHapticOverlay()
{
  this->PickableOff();
  this->UseBoundsOff();
  haptics::SetForceColors(this->ForceColors, this->MaximumForce);
  MakeBox(this->GroundPart, this->Ground);
  MakeBox(this->BarPart, this->Bar);
  this->GroundPart->GetProperty()->SetColor(GroundColor[0], GroundColor[1], GroundColor[2]);
  this->GroundPart->GetProperty()->SetOpacity(GroundOpacity);
  MakeText(this->NumberPart, VTK_TEXT_CENTERED);
  this->NumberPart->GetTextProperty()->SetBackgroundOpacity(0.0);
  this->NumberPart->GetTextProperty()->BoldOn();
  MakeText(this->ReadoutPart, VTK_TEXT_BOTTOM);
  MakeText(this->StatusPart, VTK_TEXT_BOTTOM);
  MakeText(this->HelpPart, VTK_TEXT_TOP);
  this->HelpPart->GetTextProperty()->SetFontFamilyToCourier(); // for its columns
}

vtkHapticOverlay::~vtkHapticOverlay() = default;

void vtkHapticOverlay::SetForce(double force)
{
  if (!std::isfinite(force) || force < 0.0)
  {
    vtkErrorMacro("A force of " << force << " N cannot be shown; " << this->Force
                                << " N stays. Give its strength, finite and >= 0.");
    return;
  }
  if (force != this->Force)
  {
    this->Force = force;
    this->Modified();
  }
}

void vtkHapticOverlay::SetMaximumForce(double force)
{
  if (!std::isfinite(force) || !(force > 0.0))
  {
    vtkErrorMacro("A bar cannot be filled by " << force << " N; " << this->MaximumForce
                                               << " N stays. Give a finite force > 0.");
    return;
  }
  if (force != this->MaximumForce)
  {
    this->MaximumForce = force;
    haptics::SetForceColors(this->ForceColors, force);
    this->Modified();
  }
}

void vtkHapticOverlay::SetReadout(const std::string& text)
{
  if (text != this->Readout)
  {
    this->Readout = text;
    this->Modified();
  }
}

void vtkHapticOverlay::SetHelp(const std::string& text)
{
  if (text != this->Help)
  {
    this->Help = text;
    this->Modified();
  }
}

void vtkHapticOverlay::SetStatus(const std::string& text)
{
  if (text != this->Status)
  {
    this->Status = text;
    this->Modified();
  }
}

void vtkHapticOverlay::SetHint(const std::string& text)
{
  if (text != this->Hint)
  {
    this->Hint = text;
    this->Modified();
  }
}

void vtkHapticOverlay::ArrangeBar()
{
  const double height = 1.9 * this->Text;
  const double number = 7.0 * this->Text;
  const double length = 11.0 * this->Text;
  const double gap = 0.5 * this->Text;
  const double x = this->Left + Margin * this->Unit;
  const double y = this->Bottom + Margin * this->Unit;
  SetBox(this->Ground, x, y, length + number + 2.0 * gap, height);
  const double share = std::min(1.0, this->Force / this->MaximumForce);
  SetBox(this->Bar, x + gap, y + gap, share * length, height - 2.0 * gap);
  this->BarPart->GetProperty()->SetColor(this->ForceColors->GetColor(this->Force));

  char text[64];
  std::snprintf(text, sizeof(text), "%.2f of %.3g N", this->Force, this->MaximumForce);
  this->NumberPart->SetInput(text);
  this->NumberPart->SetPosition(x + length + 2.0 * gap, y + 0.5 * height);
}

void vtkHapticOverlay::Arrange(vtkViewport* viewport)
{
  // A picture at a multiple of the window's size is drawn in tiles, whose parts of the whole are
  // the tile viewport; sizes and places are those of the window, as many times as large.
  vtkWindow* window = viewport->GetVTKWindow();
  const int* tiles = window ? window->GetTileScale() : nullptr;
  this->Unit = tiles ? std::max(1, tiles[1]) : 1.0;
  double part[4] = { 0.0, 0.0, 1.0, 1.0 };
  if (window)
  {
    window->GetTileViewport(part);
  }
  const double width = viewport->GetSize()[0] * this->Unit;
  const double height = viewport->GetSize()[1] * this->Unit;
  this->Left = -part[0] * width;
  this->Bottom = -part[1] * height;
  // Small views have smaller text.
  const double fits =
    std::min(viewport->GetSize()[1] / LeastLines, viewport->GetSize()[0] / LeastColumns);
  this->Text = std::max<double>(LeastFontSize, std::min<double>(this->FontSize, fits)) * this->Unit;
  // VTK multiplies the height of text by itself there, as a finer resolution.
  const int fontSize = static_cast<int>(this->Text / this->Unit);
  this->NumberPart->GetTextProperty()->SetFontSize(fontSize);
  const int resolution = window ? window->GetDPI() : 72; // 72: a point is a pixel
  const double room = viewport->GetSize()[0] - 2.0 * (Margin + TextRim);
  const auto show = [&](vtkTextActor* part, const std::string& text, double high)
  { return this->Unit * ShowFitting(part, text, fontSize, room, high / this->Unit, resolution); };
  this->ArrangeBar();
  this->GroundPart->SetVisibility(this->ShowForce);
  this->BarPart->SetVisibility(this->ShowForce && this->Force > 0.0);
  this->NumberPart->SetVisibility(this->ShowForce);

  const double left = this->Left + (Margin + TextRim) * this->Unit;
  double above = this->Bottom + Margin * this->Unit;
  above += this->ShowForce ? 1.9 * this->Text + 6.0 * this->Unit : 0.0;
  show(this->StatusPart, this->Status, height);
  this->StatusPart->SetPosition(left, above);
  this->StatusPart->SetVisibility(!this->Status.empty());

  above += this->Status.empty() ? 0.0 : 1.5 * this->Text + 6.0 * this->Unit;
  const std::string readout = this->ShowReadout ? this->Readout : "";
  const double readoutTop = above + show(this->ReadoutPart, readout, height);
  this->ReadoutPart->SetPosition(left, above);

  const std::string& top = this->ShowHelp ? this->Help : this->Hint;
  const double highest = this->Bottom + height - (Margin + TextRim) * this->Unit;
  const double topHeight = show(this->HelpPart, top, highest - above);
  this->HelpPart->SetPosition(left, highest);
  // Where there is no room for both, the read-out gives way to the help, and the hint to it.
  const bool meet = !readout.empty() && !top.empty() &&
    highest - topHeight < readoutTop + 2.0 * TextRim * this->Unit;
  this->ReadoutPart->SetVisibility(!readout.empty() && !(meet && this->ShowHelp));
  this->HelpPart->SetVisibility(!top.empty() && !(meet && !this->ShowHelp));
}

std::array<vtkActor2D*, 6> vtkHapticOverlay::Parts() const
{
  return { { this->GroundPart, this->BarPart, this->NumberPart, this->ReadoutPart, this->StatusPart,
    this->HelpPart } };
}

int vtkHapticOverlay::RenderOpaqueGeometry(vtkViewport* viewport)
{
  this->Arrange(viewport);
  int rendered = 0;
  for (vtkActor2D* part : this->Parts())
  {
    if (part->GetVisibility())
    {
      rendered += part->RenderOpaqueGeometry(viewport);
    }
  }
  return rendered;
}

int vtkHapticOverlay::RenderOverlay(vtkViewport* viewport)
{
  int rendered = 0;
  for (vtkActor2D* part : this->Parts())
  {
    if (part->GetVisibility())
    {
      rendered += part->RenderOverlay(viewport);
    }
  }
  return rendered;
}

void vtkHapticOverlay::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkActor2D* part : this->Parts())
  {
    part->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkHapticOverlay::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Force [N]: " << this->Force << " of " << this->MaximumForce << "\n";
  os << indent << "Readout: " << this->Readout << "\n";
  os << indent << "Status: " << this->Status << "\n";
  os << indent << "Hint: " << this->Hint << "\n";
  os << indent << "Help: " << this->Help << "\n";
  os << indent << "ShowForce: " << (this->ShowForce ? "On" : "Off") << "\n";
  os << indent << "ShowReadout: " << (this->ShowReadout ? "On" : "Off") << "\n";
  os << indent << "ShowHelp: " << (this->ShowHelp ? "On" : "Off") << "\n";
  os << indent << "FontSize [pixel]: " << this->FontSize << "\n";
}
