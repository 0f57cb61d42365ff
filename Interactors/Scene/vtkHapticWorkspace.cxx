#include "vtkHapticWorkspace.h"

#include "haptics/Filters/LengthUnit.h"
#include "haptics/Math/WorkspaceTransform.h"
#include "haptics/Scene/WorkspaceFit.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticDevice.h"
#include "vtkHapticServo.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkHapticWorkspace);

vtkHapticWorkspace::vtkHapticWorkspace() = default;
vtkHapticWorkspace::~vtkHapticWorkspace() = default;

bool vtkHapticWorkspace::Fail(const std::string& message)
{
  this->ErrorMessage = message;
  vtkErrorMacro(<< message);
  return false;
}

void vtkHapticWorkspace::SetServo(vtkHapticServo* servo)
{
  this->Servo = servo;
}

bool vtkHapticWorkspace::SetTransform(vtkMatrix4x4* deviceToWorld)
{
  if (!deviceToWorld)
  {
    return this->Fail("There is no matrix to take as the workspace transform. Give one.");
  }
  if (!this->Move(deviceToWorld))
  {
    return false;
  }
  this->Home->DeepCopy(deviceToWorld);
  this->Chosen = true;
  return true;
}

bool vtkHapticWorkspace::Move(vtkMatrix4x4* deviceToWorld)
{
  this->ErrorMessage.clear();
  std::string error;
  if (!haptics::WorkspaceTransform().SetMatrix(deviceToWorld->GetData(), error))
  {
    return this->Fail(error + " The last one stays.");
  }
  if (this->Servo)
  {
    this->Servo->SetWorkspaceTransform(deviceToWorld);
  }
  this->Transform->DeepCopy(deviceToWorld);
  this->Modified();
  return true;
}

void vtkHapticWorkspace::SetUnitLength(double metres)
{
  this->ErrorMessage.clear();
  if (!haptics::SetLength(this, "UnitLength", this->UnitLength, metres) || this->Chosen)
  {
    return;
  }
  this->Home->Identity();
  for (int i = 0; i < 3; ++i)
  {
    this->Home->SetElement(i, i, this->UnitLength > 0.0 ? 1.0 / this->UnitLength : 1.0);
  }
  vtkNew<vtkMatrix4x4> home;
  home->DeepCopy(this->Home);
  this->Move(home);
}

vtkMatrix4x4* vtkHapticWorkspace::GetTransform()
{
  return this->Transform;
}

double vtkHapticWorkspace::GetScale()
{
  return std::cbrt(this->Transform->Determinant());
}

void vtkHapticWorkspace::Reset()
{
  this->SetClutched(false);
  vtkNew<vtkMatrix4x4> home;
  home->DeepCopy(this->Home);
  this->Move(home);
}

bool vtkHapticWorkspace::Fit(const double bounds[6], vtkCamera* camera)
{
  vtkHapticDevice* const device = this->Servo ? this->Servo->GetDevice() : nullptr;
  if (!device)
  {
    return this->Fail(
      "The workspace cannot be fitted without a device. Call the scene's SetDevice() first.");
  }
  vtkNew<vtkMatrix4x4> fitted;
  std::string error;
  if (!haptics::FitWorkspace(device->GetWorkspaceBounds(), bounds, camera, fitted, error))
  {
    return this->Fail("The workspace cannot be fitted: " + error + ".");
  }
  return this->SetTransform(fitted);
}

bool vtkHapticWorkspace::Scale(double factor)
{
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    return this->Fail("The workspace cannot be scaled by " + std::to_string(factor) +
      ". Give a finite factor > 0.");
  }
  vtkNew<vtkMatrix4x4> scaled;
  scaled->DeepCopy(this->Transform);
  // About the god-object: a displacement in the hand stays as it is, and so does its force.
  double middle[4] = { 0.0, 0.0, 0.0, 1.0 };
  if (this->Servo && this->Servo->GetLatestRecord().Generation > 0)
  {
    const haptics::Vec3& place = this->Servo->GetLatestRecord().Position;
    std::copy(place.begin(), place.end(), middle);
  }
  else
  {
    this->Transform->MultiplyPoint(middle, middle); // nobody has been there: the device's origin
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      scaled->SetElement(i, j, factor * scaled->GetElement(i, j));
    }
    scaled->SetElement(i, 3, middle[i] + factor * (scaled->GetElement(i, 3) - middle[i]));
  }
  return this->Move(scaled);
}

void vtkHapticWorkspace::SetClutched(bool clutched)
{
  if (clutched == this->Clutched)
  {
    return;
  }
  if (!clutched && this->Servo)
  {
    const haptics::TickRecord& tick = this->Servo->GetLatestRecord();
    const haptics::Vec3& hand = tick.Position;
    const double device[4] = { tick.DevicePosition[0], tick.DevicePosition[1],
      tick.DevicePosition[2], 1.0 };
    double world[4];
    this->Transform->MultiplyPoint(device, world);
    vtkNew<vtkMatrix4x4> moved;
    moved->DeepCopy(this->Transform);
    for (int i = 0; i < 3; ++i)
    {
      moved->SetElement(i, 3, moved->GetElement(i, 3) + hand[i] - world[i]);
    }
    this->Move(moved);
  }
  this->Clutched = clutched;
  if (this->Servo)
  {
    this->Servo->SetClutched(clutched); // after the transform: the servo takes both in one tick
  }
  this->Modified();
  this->InvokeEvent(vtkHapticWorkspace::ClutchEvent);
}

void vtkHapticWorkspace::OnButtons(unsigned int buttons)
{
  const bool isHeld = this->ClutchButton >= 0 && (buttons >> this->ClutchButton & 1U) != 0;
  if (isHeld != this->IsButtonHeld)
  {
    this->IsButtonHeld = isHeld;
    this->SetClutched(isHeld);
  }
}

void vtkHapticWorkspace::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UnitLength: " << this->UnitLength << " m\n";
  os << indent << "Chosen: " << (this->Chosen ? "yes" : "no") << "\n";
  os << indent << "Clutched: " << (this->Clutched ? "yes" : "no") << "\n";
  os << indent << "ClutchButton: " << this->ClutchButton << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Transform:\n";
  this->Transform->PrintSelf(os, indent.GetNextIndent());
}
