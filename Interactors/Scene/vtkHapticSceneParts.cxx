#include "vtkHapticSceneParts.h"

#include "vtkHapticGrip.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticServo.h"
#include "vtkHapticSurfaces.h"

vtkHapticSceneParts::vtkHapticSceneParts()
{
  this->Workspace->SetServo(this->Servo);
}

vtkHapticSceneParts::~vtkHapticSceneParts() = default;

int vtkHapticSceneParts::GetNumberOfSurfaces()
{
  return this->Surfaces->GetNumberOfSurfaces();
}

vtkActor* vtkHapticSceneParts::GetSurfaceActor(int id)
{
  return this->Surfaces->GetActor(id);
}

vtkGodObjectFilter* vtkHapticSceneParts::GetSurfaceFilter(int id)
{
  return this->Surfaces->GetFilter(id);
}

vtkHapticProperties* vtkHapticSceneParts::GetSurfaceProperties(int id)
{
  return this->Surfaces->GetProperties(id);
}

bool vtkHapticSceneParts::SetSurfacePropertyArray(
  int id, int property, int association, const char* name)
{
  return this->Surfaces->SetPropertyArray(id, property, association, name);
}

bool vtkHapticSceneParts::IntersectRay(
  const double from[3], const double direction[3], double hit[3])
{
  double normal[3];
  return this->Surfaces->IntersectRay(from, direction, hit, normal);
}

bool vtkHapticSceneParts::SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  this->ForgetMessage();
  return this->Workspace->SetTransform(deviceToWorld);
}

bool vtkHapticSceneParts::ScaleWorkspace(double factor)
{
  this->ForgetMessage();
  return this->Workspace->Scale(factor);
}

void vtkHapticSceneParts::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto printPart = [&](const char* name, vtkObject* part)
  {
    os << indent << name << ":\n";
    part->PrintSelf(os, indent.GetNextIndent());
  };
  printPart("Surfaces", this->Surfaces);
  printPart("Workspace", this->Workspace);
  printPart("Grip", this->Grip);
  printPart("TraceRecorder", this->TraceRecorder);
  printPart("Landmarks", this->Landmarks);
  printPart("Servo", this->Servo);
}
