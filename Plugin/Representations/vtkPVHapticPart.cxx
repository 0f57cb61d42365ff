#include "vtkPVHapticPart.h"

#include "vtkHapticScene.h"

vtkPVHapticPart::vtkPVHapticPart() = default;
vtkPVHapticPart::~vtkPVHapticPart() = default;

void vtkPVHapticPart::SetScene(vtkHapticScene* scene, haptics::RepresentedSurfaces* surfaces)
{
  this->Scene = scene;
  this->Surfaces = surfaces;
}

void vtkPVHapticPart::Fail()
{
  this->InvokeEvent(vtkPVHapticPart::FailEvent, const_cast<char*>(this->Scene->GetErrorMessage()));
}

void vtkPVHapticPart::Fail(const std::string& message)
{
  vtkErrorMacro(<< message);
  this->InvokeEvent(vtkPVHapticPart::FailEvent, const_cast<char*>(message.c_str()));
}

void vtkPVHapticPart::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
}
