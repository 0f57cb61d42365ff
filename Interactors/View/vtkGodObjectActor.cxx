#include "vtkGodObjectActor.h"

#include "haptics/Filters/NumberSetting.h"
#include "haptics/View/ForceColors.h"
#include "haptics/View/ViewHeight.h"
#include "vtkActor.h"
#include "vtkBillboardTextActor3D.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkCylinderSource.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkShaderProperty.h"
#include "vtkSphereSource.h"
#include "vtkWindow.h"

#include <algorithm>
#include <array>
#include <cmath>

vtkStandardNewMacro(vtkGodObjectActor);

namespace
{
constexpr double DefaultSize = 0.012;              // of the view's height
constexpr double LeastPixels = 4.0;                // of a radius of that size
constexpr double HapticInterfacePointRadius = 0.6; // all in radii of the god-object
constexpr double SpringRadius = 0.16;
constexpr double ShaftRadius = 0.3;
constexpr double ArrowTipRadius = 0.75;
constexpr double TipLength = 2.0;
constexpr double ReferenceArrowLength = 12.0;
constexpr double LeastRing = 1.6; // the ring's radius at the lightest touch
constexpr double RingGrowth = 3.0;

bool AllFinite(const double v[3])
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

void Give(vtkActor* part, vtkAlgorithmOutput* geometry, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(geometry);
  mapper->ScalarVisibilityOff();
  part->SetMapper(mapper);
  part->PickableOff();
  vtkProperty* property = part->GetProperty();
  property->SetColor(red, green, blue);
  property->SetAmbient(0.25);
  property->SetDiffuse(0.8);
  property->SetSpecular(0.4);
  property->SetSpecularPower(40.0);
}

/// Nearer than everything that is not drawn so, in unchanged order among what is. For opaque parts:
/// the translucent passes of VTK go by the depth that a fragment had before.
void DrawThroughSurfaces(vtkActor* part, bool through)
{
  part->GetShaderProperty()->ClearAllFragmentShaderReplacements();
  if (!through)
  {
    return;
  }
  part->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Depth::Impl", true, "gl_FragDepth = 0.001 * gl_FragCoord.z;\n", false);
}

/// Places a part whose geometry is 1 long in y, from the origin, and 1 in radius.
void Stretch(
  vtkActor* part, const double from[3], const double unit[3], double length, double radius)
{
  double side[3];
  double other[3];
  vtkMath::Perpendiculars(unit, side, other, 0.0);
  vtkNew<vtkMatrix4x4> matrix;
  for (int i = 0; i < 3; ++i)
  {
    matrix->SetElement(i, 0, radius * other[i]);
    matrix->SetElement(i, 1, length * unit[i]);
    matrix->SetElement(i, 2, radius * side[i]);
    matrix->SetElement(i, 3, from[i]);
  }
  part->SetUserMatrix(matrix);
}
}

vtkGodObjectActor::vtkGodObjectActor()
{
  this->PickableOff();
  this->UseBoundsOff();
  haptics::SetForceColors(this->ForceColors, this->ReferenceForce);

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(36);
  sphere->SetPhiResolution(24);
  Give(this->GodObjectPart, sphere->GetOutputPort(), 0.94, 0.94, 0.90);
  this->GodObjectLook->DeepCopy(this->GodObjectPart->GetProperty());
  Give(this->HapticInterfacePointPart, sphere->GetOutputPort(), 0.16, 0.48, 0.92);

  vtkNew<vtkCylinderSource> bar;
  bar->SetCenter(0.0, 0.5, 0.0);
  bar->SetRadius(1.0);
  bar->SetResolution(24);
  Give(this->SpringPart, bar->GetOutputPort(), 0.85, 0.92, 1.0);
  Give(this->ForceShaftPart, bar->GetOutputPort(), 0.92, 0.22, 0.15);

  vtkNew<vtkConeSource> tip;
  tip->SetDirection(0.0, 1.0, 0.0);
  tip->SetCenter(0.0, 0.5, 0.0);
  tip->SetResolution(32);
  tip->SetRadius(1.0);
  Give(this->ForceTipPart, tip->GetOutputPort(), 0.92, 0.22, 0.15);
  this->ForceTipPart->SetProperty(this->ForceShaftPart->GetProperty());

  this->MakeMarks();
  this->ShowThrough();
}

vtkGodObjectActor::~vtkGodObjectActor() = default;

void vtkGodObjectActor::SetSize(double value)
{
  haptics::SetNumber(this, "Size", this->Size, value, 1e-300, VTK_DOUBLE_MAX);
}

void vtkGodObjectActor::SetTipRadius(double radius)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    vtkErrorMacro("The radius of the tip must be finite and not below 0, but is "
      << radius << "; it stays " << this->TipRadius << ".");
    return;
  }
  if (this->TipRadius != radius)
  {
    this->TipRadius = radius;
    this->Modified();
  }
}

void vtkGodObjectActor::SetReferenceForce(double value)
{
  haptics::SetNumber(this, "ReferenceForce", this->ReferenceForce, value, 1e-300, VTK_DOUBLE_MAX);
  haptics::SetForceColors(this->ForceColors, this->ReferenceForce);
}

void vtkGodObjectActor::ShowThrough()
{
  for (vtkActor* part :
    { this->GodObjectPart.Get(), this->HapticInterfacePointPart.Get(), this->SpringPart.Get(),
      this->ForceShaftPart.Get(), this->ForceTipPart.Get(), this->ContactPart.Get() })
  {
    DrawThroughSurfaces(part, this->SeeThrough);
  }
  if (!this->SeeThrough)
  {
    this->KeepRingOnSurface();
  }
}

void vtkGodObjectActor::SetSeeThrough(bool through)
{
  if (through != this->SeeThrough)
  {
    this->SeeThrough = through;
    this->ShowThrough();
    this->Modified();
  }
}

void vtkGodObjectActor::SetFinite(double target[3], const double value[3], const char* name)
{
  if (!AllFinite(value))
  {
    vtkErrorMacro(<< name << " (" << value[0] << ", " << value[1] << ", " << value[2]
                  << ") is not finite; the last one stays. Check where it comes from.");
    return;
  }
  if (!std::equal(value, value + 3, target))
  {
    std::copy(value, value + 3, target);
    this->Modified();
  }
}

void vtkGodObjectActor::SetHapticInterfacePoint(const double point[3])
{
  this->SetFinite(this->HapticInterfacePoint, point, "The haptic interface point");
}

void vtkGodObjectActor::SetHapticInterfacePoint(double x, double y, double z)
{
  const double point[3] = { x, y, z };
  this->SetHapticInterfacePoint(point);
}

void vtkGodObjectActor::SetGodObject(const double point[3])
{
  this->SetFinite(this->GodObject, point, "The god-object");
}

void vtkGodObjectActor::SetGodObject(double x, double y, double z)
{
  const double point[3] = { x, y, z };
  this->SetGodObject(point);
}

void vtkGodObjectActor::SetForce(const double force[3])
{
  this->SetFinite(this->Force, force, "The force");
}

void vtkGodObjectActor::SetForce(double x, double y, double z)
{
  const double force[3] = { x, y, z };
  this->SetForce(force);
}

double vtkGodObjectActor::RadiusInWorld(vtkViewport* viewport) const
{
  vtkRenderer* renderer = vtkRenderer::SafeDownCast(viewport);
  if (this->SizeInWorld || !renderer)
  {
    return this->Size;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  // A picture at a multiple of the window's size is drawn in tiles, each with a narrower view.
  const double tiles = renderer->GetVTKWindow() ? renderer->GetVTKWindow()->GetTileScale()[1] : 1.0;
  const double height = std::max(1, renderer->GetSize()[1]);
  const double least = LeastPixels / height * std::min(1.0, this->Size / DefaultSize);
  const double size = tiles * std::max(this->Size, least);
  double toGodObject[3];
  vtkMath::Subtract(this->GodObject, camera->GetPosition(), toGodObject);
  double depth = vtkMath::Dot(toGodObject, camera->GetDirectionOfProjection());
  if (depth <= 0.0) // behind the camera, out of sight
  {
    depth = camera->GetDistance();
  }
  return size * haptics::ViewHeight(camera, depth);
}

void vtkGodObjectActor::ArrangeForce(double radius)
{
  double direction[3] = { this->Force[0], this->Force[1], this->Force[2] };
  const double force = vtkMath::Normalize(direction);
  const double length = ReferenceArrowLength * radius * force / this->ReferenceForce;
  const bool shown = this->ShowHand && this->ShowForce && length > 0.0;
  this->ForceShaftPart->SetVisibility(shown);
  this->ForceTipPart->SetVisibility(shown);
  if (!shown)
  {
    return;
  }
  if (this->ColorForceByMagnitude)
  {
    this->ForceShaftPart->GetProperty()->SetColor(this->ForceColors->GetColor(force));
  }
  // A short arrow is all tip, and thinner.
  const double tip = std::min(TipLength * radius, 0.6 * length);
  const double thickness = tip / TipLength;
  double start[3];
  double base[3];
  for (int i = 0; i < 3; ++i)
  {
    start[i] = this->GodObject[i] + this->TipRadius * direction[i]; // out of the ball
    base[i] = start[i] + (length - tip) * direction[i];
  }
  Stretch(this->ForceShaftPart, start, direction, length - tip, ShaftRadius * thickness);
  Stretch(this->ForceTipPart, base, direction, tip, ArrowTipRadius * thickness);
}

void vtkGodObjectActor::Arrange(vtkViewport* viewport)
{
  const double radius = this->RadiusInWorld(viewport);
  const double up[3] = { 0.0, 1.0, 0.0 };
  const double ball = this->TipRadius > 0.0 ? this->TipRadius : radius;
  Stretch(this->GodObjectPart, this->GodObject, up, ball, ball);
  this->GodObjectPart->SetVisibility(this->ShowHand);

  double spring[3];
  vtkMath::Subtract(this->GodObject, this->HapticInterfacePoint, spring);
  const double length = vtkMath::Normalize(spring);
  const bool apart =
    this->ShowHand && this->ShowHapticInterfacePoint && this->Touching && length > 0.0;
  this->HapticInterfacePointPart->SetVisibility(apart);
  this->SpringPart->SetVisibility(apart);
  if (apart)
  {
    const double ghost = HapticInterfacePointRadius * radius;
    Stretch(this->HapticInterfacePointPart, this->HapticInterfacePoint, up, ghost, ghost);
    Stretch(this->SpringPart, this->HapticInterfacePoint, spring, length, SpringRadius * radius);
  }
  this->ArrangeForce(radius);
  this->ArrangeContact(viewport, radius);
  this->ArrangeMarks(viewport);
}

/// The ring lies across the force, which is the surface's normal but for friction, and widens with
/// it; the ball and its coloured band have the force's colour.
void vtkGodObjectActor::ArrangeContact(vtkViewport* viewport, double radius)
{
  double normal[3] = { this->Force[0], this->Force[1], this->Force[2] };
  const double force = vtkMath::Normalize(normal);
  const bool shown = this->ShowHand && this->ShowContact && this->Touching && force > 0.0;
  this->ContactPart->SetVisibility(shown);
  this->GodObjectPart->SetProperty(shown ? this->TouchingLook : this->GodObjectLook);
  if (!shown)
  {
    return;
  }
  const double share = force / this->ReferenceForce;
  double color[3];
  this->ForceColors->GetColor(force, color);
  this->TouchingLook->DeepCopy(this->GodObjectLook);
  this->TouchingLook->SetColor(color);
  this->ColorRing(color);
  const double width = radius * (LeastRing + RingGrowth * std::min(1.0, share));
  double place[3];
  for (int i = 0; i < 3; ++i)
  {
    place[i] = this->GodObject[i] - this->TipRadius * normal[i]; // under the ball
  }
  Stretch(this->ContactPart, place, normal, width, width);
  if (!this->SeeThrough)
  {
    this->LiftRing(viewport);
  }
}

std::vector<vtkProp3D*> vtkGodObjectActor::Parts() const
{
  std::vector<vtkProp3D*> parts{ this->GodObjectPart, this->HapticInterfacePointPart,
    this->SpringPart, this->ForceShaftPart, this->ForceTipPart, this->ContactPart, this->TrailPart,
    this->TrianglesPart, this->LandmarksPart };
  parts.insert(parts.end(), this->LandmarkTexts.begin(), this->LandmarkTexts.end());
  return parts;
}

int vtkGodObjectActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  this->Arrange(viewport);
  int rendered = 0;
  for (vtkProp3D* part : this->Parts())
  {
    if (part->GetVisibility())
    {
      rendered += part->RenderOpaqueGeometry(viewport);
    }
  }
  if (this->Legend && this->ShowLegend)
  {
    rendered += this->Legend->RenderOpaqueGeometry(viewport);
  }
  return rendered;
}

int vtkGodObjectActor::RenderOverlay(vtkViewport* viewport)
{
  return this->Legend && this->ShowLegend ? this->Legend->RenderOverlay(viewport) : 0;
}

int vtkGodObjectActor::RenderTranslucentPolygonalGeometry(vtkViewport* viewport)
{
  int rendered = 0;
  for (vtkProp3D* part : this->Parts())
  {
    if (part->GetVisibility())
    {
      rendered += part->RenderTranslucentPolygonalGeometry(viewport);
    }
  }
  return rendered;
}

vtkTypeBool vtkGodObjectActor::HasTranslucentPolygonalGeometry()
{
  const std::vector<vtkProp3D*> parts = this->Parts();
  return std::any_of(parts.begin(), parts.end(),
    [](vtkProp3D* part) { return part->HasTranslucentPolygonalGeometry() != 0; });
}

void vtkGodObjectActor::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkProp3D* part : this->Parts())
  {
    part->ReleaseGraphicsResources(window);
  }
  if (this->Legend)
  {
    this->Legend->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

double* vtkGodObjectActor::GetBounds()
{
  vtkBoundingBox bounds;
  bounds.AddPoint(this->HapticInterfacePoint);
  bounds.AddPoint(this->GodObject);
  if (this->Landmarks->GetNumberOfPoints() > 0)
  {
    bounds.AddBounds(this->Landmarks->GetBounds());
  }
  if (this->ShowTrail)
  {
    bounds.AddBox(this->TrailBounds);
  }
  bounds.GetBounds(this->Bounds);
  return this->Bounds;
}

void vtkGodObjectActor::IncludeInClippingRange(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double reach =
    this->TipRadius + this->RadiusInWorld(renderer) * (ReferenceArrowLength + 1.0);
  double range[2];
  camera->GetClippingRange(range);
  for (const double* point : { this->HapticInterfacePoint, this->GodObject })
  {
    double toPoint[3];
    vtkMath::Subtract(point, camera->GetPosition(), toPoint);
    const double depth = vtkMath::Dot(toPoint, camera->GetDirectionOfProjection());
    range[1] = std::max(range[1], depth + reach);
    // The near plane stays in front of the camera, and far enough for the depth buffer's digits.
    range[0] = std::min(range[0], std::max(depth - reach, 0.001 * range[1]));
  }
  camera->SetClippingRange(range);
}

vtkProperty* vtkGodObjectActor::GetGodObjectProperty()
{
  return this->GodObjectLook;
}

vtkProperty* vtkGodObjectActor::GetHapticInterfacePointProperty()
{
  return this->HapticInterfacePointPart->GetProperty();
}

vtkProperty* vtkGodObjectActor::GetSpringProperty()
{
  return this->SpringPart->GetProperty();
}

vtkProperty* vtkGodObjectActor::GetForceProperty()
{
  return this->ForceShaftPart->GetProperty();
}

vtkProperty* vtkGodObjectActor::GetTrailProperty()
{
  return this->TrailPart->GetProperty();
}

void vtkGodObjectActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const double v[3])
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")\n"; };
  print("HapticInterfacePoint [world unit]", this->HapticInterfacePoint);
  print("GodObject [world unit]", this->GodObject);
  print("Force [N]", this->Force);
  os << indent << "Touching: " << (this->Touching ? "On" : "Off") << "\n";
  os << indent << "Size [" << (this->SizeInWorld ? "world unit" : "view heights")
     << "]: " << this->Size << "\n";
  os << indent << "TipRadius [world unit]: " << this->TipRadius << "\n";
  os << indent << "ReferenceForce [N]: " << this->ReferenceForce << "\n";
  os << indent << "ShowHand: " << (this->ShowHand ? "On" : "Off") << "\n";
  os << indent << "ShowHapticInterfacePoint: " << (this->ShowHapticInterfacePoint ? "On" : "Off")
     << "\n";
  os << indent << "ShowForce: " << (this->ShowForce ? "On" : "Off") << "\n";
  os << indent << "ShowContact: " << (this->ShowContact ? "On" : "Off") << "\n";
  os << indent << "ShowTrail: " << (this->ShowTrail ? "On" : "Off") << "\n";
  os << indent << "ShowLegend: " << (this->ShowLegend ? "On" : "Off") << "\n";
  os << indent << "ShowActiveTriangles: " << (this->ShowActiveTriangles ? "On" : "Off") << "\n";
  os << indent << "ShowLandmarkTexts: " << (this->ShowLandmarkTexts ? "On" : "Off") << "\n";
  os << indent << "SeeThrough: " << (this->SeeThrough ? "On" : "Off") << "\n";
  os << indent << "ColorForceByMagnitude: " << (this->ColorForceByMagnitude ? "On" : "Off") << "\n";
  os << indent << "MaximumTrailPoints: " << this->MaximumTrailPoints << "\n";
  os << indent << "Trail points: " << this->TrailPoints.size() << "\n";
}
