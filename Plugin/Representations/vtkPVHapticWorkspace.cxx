#include "vtkPVHapticWorkspace.h"

#include "vtkHapticScene.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkPVHapticWorkspace);

vtkPVHapticWorkspace::vtkPVHapticWorkspace() = default;
vtkPVHapticWorkspace::~vtkPVHapticWorkspace() = default;

void vtkPVHapticWorkspace::SetTransform(const double matrix[16])
{
  double now[16];
  this->GetTransform(now);
  if (!this->Scene || std::equal(matrix, matrix + 16, now))
  {
    return; // so that the god-object need not start anew
  }
  if (std::all_of(matrix, matrix + 16, [](double element) { return element == 0.0; }))
  {
    this->Forget();
    return;
  }
  vtkNew<vtkMatrix4x4> transform;
  transform->DeepCopy(matrix);
  if (this->Scene->SetWorkspaceTransform(transform))
  {
    this->Choose();
  }
  else
  {
    this->Fail();
  }
}

void vtkPVHapticWorkspace::GetTransform(double matrix[16])
{
  std::fill_n(matrix, 16, 0.0);
  if (this->Scene && this->Chosen)
  {
    std::copy_n(this->Scene->GetWorkspaceTransform()->GetData(), 16, matrix);
  }
}

bool vtkPVHapticWorkspace::Fit(const double bounds[6], vtkCamera* camera)
{
  this->Forget();
  if (!this->Scene)
  {
    return false;
  }
  if (!this->Scene->FitWorkspace(bounds, camera))
  {
    this->Fail();
    return false;
  }
  this->Choose();
  return true;
}

void vtkPVHapticWorkspace::Choose()
{
  this->Chosen = true;
  this->ChosenTime.Modified();
}

void vtkPVHapticWorkspace::Scale(double factor)
{
  if (this->Scene && !this->Scene->ScaleWorkspace(factor))
  {
    this->Fail();
  }
}

void vtkPVHapticWorkspace::SetClutched(bool clutched)
{
  if (this->Scene)
  {
    this->Scene->SetClutched(clutched);
  }
}

bool vtkPVHapticWorkspace::GetClutched()
{
  return this->Scene && this->Scene->GetClutched();
}

void vtkPVHapticWorkspace::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Chosen: " << (this->Chosen ? "yes" : "no") << "\n";
}
