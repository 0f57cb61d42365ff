// What the hand of a vtkHapticScene does beside touching: landmarks, clutch.
#include "vtkHapticScene.h"

#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkHapticDevice.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticProbe.h"
#include "vtkHapticServo.h"
#include "vtkMatrix4x4.h"

vtkHapticLandmarks* vtkHapticScene::GetLandmarks()
{
  return this->Landmarks;
}

int vtkHapticScene::DropLandmark()
{
  this->ForgetMessage();
  if (!this->Touching)
  {
    this->Fail("A landmark needs a contact, and nothing is touched. Touch a surface first.");
    return -1;
  }
  return this->Landmarks->Drop(this->GetProbe());
}

void vtkHapticScene::ObeyButtons()
{
  for (const haptics::TickRecord& tick : this->Internal->Events.TakePresses(this->LandmarkButton))
  {
    if (tick.NumberOfConstraints > 0)
    {
      auto probe = vtkSmartPointer<vtkHapticProbe>::New();
      this->Internal->Surfaces.Probe(tick, probe);
      if (this->Landmarks->Drop(probe) >= 0)
      {
        this->Internal->Events.Add(
          vtkHapticScene::LandmarkEvent, this->Landmarks->GetNumberOfLandmarks());
      }
    }
  }
  const bool held = this->Internal->Latest && this->ClutchButton >= 0 &&
    (this->Internal->Latest->Buttons >> this->ClutchButton & 1U) != 0;
  if (held != this->Internal->ClutchHeld)
  {
    this->Internal->ClutchHeld = held;
    this->SetClutched(held);
  }
  this->ObeyGripButton();
}

void vtkHapticScene::SetClutched(bool clutched)
{
  if (clutched == this->Internal->Clutched)
  {
    return;
  }
  if (clutched)
  {
    this->LetGo();
  }
  else
  {
    vtkMatrix4x4* workspace = this->Workspace;
    double device[4] = { 0.0, 0.0, 0.0, 1.0 };
    this->Servo->GetDevicePosition(device);
    double world[4];
    workspace->MultiplyPoint(device, world);
    vtkNew<vtkMatrix4x4> moved;
    moved->DeepCopy(workspace);
    for (int i = 0; i < 3; ++i)
    {
      moved->SetElement(i, 3, moved->GetElement(i, 3) + this->GodObject[i] - world[i]);
    }
    this->MoveWorkspace(moved);
  }
  this->Internal->Clutched = clutched;
  this->Servo->SetClutched(clutched); // after the workspace: the servo takes both in one tick
  this->PullSurfaces();
  this->Modified();
}

bool vtkHapticScene::GetClutched()
{
  return this->Internal->Clutched;
}

void vtkHapticScene::UpdateProbe(bool touching)
{
  this->Probe = vtkSmartPointer<vtkHapticProbe>::New();
  if (touching)
  {
    this->Internal->Surfaces.Probe(*this->Internal->Latest, this->Probe);
  }
}

vtkHapticProbe* vtkHapticScene::GetProbe()
{
  if (!this->Probe)
  {
    this->UpdateProbe(this->Touching);
  }
  return this->Probe;
}

const std::vector<haptics::TickRecord>& vtkHapticScene::GetNewTicks()
{
  return this->Internal->Drained;
}

std::vector<haptics::Vec3> vtkHapticScene::GetActiveCorners()
{
  return this->Touching ? this->Internal->Surfaces.ActiveCorners(*this->Internal->Latest)
                        : std::vector<haptics::Vec3>();
}
