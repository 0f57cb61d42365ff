// What a vtkPVHapticScene tells.
#include "vtkPVHapticScene.h"

#include "PVHapticSceneInternals.h"
#include "vtkCellData.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticServo.h"
#include "vtkMath.h"
#include "vtkPointData.h"

#include <algorithm>
#include <sstream>

const char* vtkPVHapticScene::GetState()
{
  Internals& self = *this->Internal;
  vtkHapticScene* scene = self.Scene;
  const char* waits = scene->GetDevice() ? scene->GetDevice()->GetStatusMessage() : "";
  if ((scene->IsEngaged() || self.Wanted) && scene->IsBuilding() && !scene->GetTouching())
  {
    self.State = "Preparing the surfaces, " +
      std::to_string(static_cast<int>(100.0 * scene->GetBuildProgress())) + " %";
  }
  else if (scene->IsEngaged())
  {
    self.State = scene->GetClutched() ? "Engaged, clutched: nothing is touched"
      : scene->GetTouching()          ? "Engaged, touching " + std::string(this->GetTouchedName())
      : *waits                        ? std::string("Engaged, ") + waits
                                      : "Engaged, in free space";
  }
  else if (self.Wanted)
  {
    self.State = waits;
  }
  else
  {
    const std::string& why = self.Message.empty() ? self.ReleasedBecause : self.Message;
    self.State = why.empty() ? "Released" : "Released: " + why;
  }
  if (!self.State.empty() && self.State.back() == ' ')
  {
    self.State.pop_back(); // without a name
  }
  return self.State.c_str();
}

bool vtkPVHapticScene::GetBuilding()
{
  return this->Internal->Scene->IsBuilding();
}

double vtkPVHapticScene::GetBuildProgress()
{
  return this->Internal->Scene->GetBuildProgress();
}

void vtkPVHapticScene::CancelBuild()
{
  this->Internal->Scene->CancelBuild();
}

const char* vtkPVHapticScene::GetMessage()
{
  return this->Internal->Message.c_str();
}

double vtkPVHapticScene::GetRate()
{
  return this->GetEngaged() ? this->Internal->Scene->GetServo()->GetMeasuredRate() : 0.0;
}

vtkTypeInt64 vtkPVHapticScene::GetMissedTicks()
{
  return this->Internal->Scene->GetServo()->GetNumberOfMissedTicks();
}

double* vtkPVHapticScene::GetForce()
{
  return this->Internal->Scene->GetForce();
}

double vtkPVHapticScene::GetForceMagnitude()
{
  return vtkMath::Norm(this->GetForce());
}

double vtkPVHapticScene::GetPenetration()
{
  return this->Internal->Scene->GetPenetration();
}

double* vtkPVHapticScene::GetHapticInterfacePoint()
{
  return this->Internal->Scene->GetHapticInterfacePoint();
}

double* vtkPVHapticScene::GetGodObject()
{
  return this->Internal->Scene->GetGodObject();
}

bool vtkPVHapticScene::GetTouching()
{
  return this->Internal->Scene->GetTouching();
}

int vtkPVHapticScene::GetTouchedRepresentation()
{
  const int id = this->Internal->Scene->GetTouchedSurface();
  const std::vector<Internals::Surface>& surfaces = this->Internal->Surfaces;
  const auto found = std::find_if(surfaces.begin(), surfaces.end(),
    [id](const Internals::Surface& surface) { return id >= 0 && surface.Id == id; });
  return found == surfaces.end() ? -1 : static_cast<int>(found - surfaces.begin());
}

const char* vtkPVHapticScene::GetTouchedName()
{
  const int touched = this->GetTouching() ? this->GetTouchedRepresentation() : -1;
  this->Internal->TouchedName = touched < 0 ? "" : this->Internal->Surfaces.at(touched).Name;
  return this->Internal->TouchedName.c_str();
}

vtkIdType vtkPVHapticScene::GetTouchedCell()
{
  // ParaView's extraction of the surface has kept where each face came from.
  vtkHapticProbe* probe = this->Internal->Scene->GetProbe();
  vtkDataArray* ids = probe->GetCellValues()->GetArray("vtkOriginalCellIds");
  return probe->GetTouching() && ids && ids->GetNumberOfTuples() > 0
    ? static_cast<vtkIdType>(ids->GetComponent(0, 0))
    : this->Internal->Scene->GetTouchedCell();
}

vtkStringArray* vtkPVHapticScene::GetProbedValues()
{
  vtkStringArray* texts = this->Internal->Probed;
  texts->Initialize();
  vtkHapticProbe* probe = this->Internal->Scene->GetProbe();
  for (vtkFieldData* values : { static_cast<vtkFieldData*>(probe->GetPointValues()),
         static_cast<vtkFieldData*>(probe->GetCellValues()) })
  {
    for (int i = 0; probe->GetTouching() && i < values->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = values->GetAbstractArray(i);
      const std::string name = array->GetName() ? array->GetName() : "";
      if (name.rfind("vtk", 0) == 0)
      {
        continue; // ParaView's own bookkeeping
      }
      std::ostringstream text;
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        text << (c ? ", " : "") << array->GetVariantValue(c).ToString();
      }
      texts->InsertNextValue(name);
      texts->InsertNextValue(text.str());
    }
  }
  return texts;
}

void vtkPVHapticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << this->Internal->View.Get() << "\n";
  os << indent << "Surfaces: " << this->Internal->Surfaces.size() << "\n";
  os << indent << "DeviceName: " << this->Internal->DeviceName << "\n";
  os << indent << "State: " << this->GetState() << "\n";
  os << indent << "Message: " << this->Internal->Message << "\n";
  os << indent << "Scene:\n";
  this->Internal->Scene->PrintSelf(os, indent.GetNextIndent());
}
