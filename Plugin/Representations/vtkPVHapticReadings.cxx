#include "vtkPVHapticReadings.h"

#include "RepresentedSurfaces.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkHapticProbe.h"
#include "vtkHapticReadings.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <sstream>
#include <string>

vtkStandardNewMacro(vtkPVHapticReadings);

namespace
{
double Nowhere[3] = { 0.0, 0.0, 0.0 };
}

vtkPVHapticReadings::vtkPVHapticReadings() = default;
vtkPVHapticReadings::~vtkPVHapticReadings() = default;

double vtkPVHapticReadings::GetRate()
{
  return this->Scene && this->Scene->IsEngaged()
    ? this->Scene->GetServo()->GetReadings()->GetMeasuredRate()
    : 0.0;
}

vtkTypeInt64 vtkPVHapticReadings::GetMissedTicks()
{
  return this->Scene ? this->Scene->GetServo()->GetReadings()->GetNumberOfMissedTicks() : 0;
}

double vtkPVHapticReadings::GetEffectiveStiffness()
{
  return this->Scene ? this->Scene->GetServo()->GetEffectiveStiffness() : 0.0;
}

double* vtkPVHapticReadings::GetForce()
{
  return this->Scene ? this->Scene->GetForce() : Nowhere;
}

double vtkPVHapticReadings::GetForceMagnitude()
{
  return vtkMath::Norm(this->GetForce());
}

double vtkPVHapticReadings::GetPenetration()
{
  return this->Scene ? this->Scene->GetPenetration() : 0.0;
}

double* vtkPVHapticReadings::GetHapticInterfacePoint()
{
  return this->Scene ? this->Scene->GetHapticInterfacePoint() : Nowhere;
}

double* vtkPVHapticReadings::GetGodObject()
{
  return this->Scene ? this->Scene->GetGodObject() : Nowhere;
}

bool vtkPVHapticReadings::GetTouching()
{
  return this->Scene && this->Scene->GetTouching();
}

int vtkPVHapticReadings::GetTouchedRepresentation()
{
  return this->Scene ? this->Surfaces->IndexOf(this->Scene->GetTouchedSurface()) : -1;
}

const char* vtkPVHapticReadings::GetTouchedName()
{
  const int touched = this->GetTouching() ? this->GetTouchedRepresentation() : -1;
  return touched < 0 ? "" : this->Surfaces->Name(touched).c_str();
}

vtkIdType vtkPVHapticReadings::GetTouchedCell()
{
  if (!this->Scene)
  {
    return -1;
  }
  // ParaView's extraction of the surface has kept where each face came from.
  vtkHapticProbe* probe = this->Scene->GetProbe();
  vtkDataArray* ids = probe->GetCellValues()->GetArray("vtkOriginalCellIds");
  return probe->GetTouching() && ids && ids->GetNumberOfTuples() > 0
    ? static_cast<vtkIdType>(ids->GetComponent(0, 0))
    : this->Scene->GetTouchedCell();
}

vtkStringArray* vtkPVHapticReadings::GetProbedValues()
{
  this->Probed->Initialize();
  vtkHapticProbe* probe = this->GetTouching() ? this->Scene->GetProbe() : nullptr;
  if (!probe || !probe->GetTouching())
  {
    return this->Probed;
  }
  for (vtkFieldData* values : { static_cast<vtkFieldData*>(probe->GetPointValues()),
         static_cast<vtkFieldData*>(probe->GetCellValues()) })
  {
    for (int i = 0; i < values->GetNumberOfArrays(); ++i)
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
      this->Probed->InsertNextValue(name);
      this->Probed->InsertNextValue(text.str());
    }
  }
  return this->Probed;
}
