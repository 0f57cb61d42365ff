// What the hand of a vtkPVHapticScene reaches, leaves behind and looks like.
#include "vtkPVHapticScene.h"

#include "PVHapticSceneInternals.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticServo.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"

#include <algorithm>

void vtkPVHapticScene::SetWorkspaceTransform(const double matrix[16])
{
  Internals& self = *this->Internal;
  double now[16];
  this->GetWorkspaceTransform(now);
  if (std::equal(matrix, matrix + 16, now))
  {
    return; // so that the god-object need not start anew
  }
  if (std::all_of(matrix, matrix + 16, [](double element) { return element == 0.0; }))
  {
    self.Fitted = false;
    return;
  }
  vtkNew<vtkMatrix4x4> transform;
  transform->DeepCopy(matrix);
  if (self.Scene->SetWorkspaceTransform(transform))
  {
    self.Fitted = true;
    self.PathIsKnown = false;
  }
  else
  {
    self.Message = self.Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::GetWorkspaceTransform(double matrix[16])
{
  std::fill_n(matrix, 16, 0.0);
  if (this->Internal->Fitted)
  {
    std::copy_n(this->Internal->Scene->GetWorkspaceTransform()->GetData(), 16, matrix);
  }
}

bool vtkPVHapticScene::Fit()
{
  Internals& self = *this->Internal;
  if (!self.View)
  {
    this->Fail("There is no render view to fit the device's workspace to. Activate one.");
    return false;
  }
  if (!this->ChooseDevice())
  {
    return false;
  }
  this->SyncSurfaces();
  // By what is shown, which may still be built beside.
  vtkBoundingBox box;
  for (const Internals::Surface& surface : self.Surfaces)
  {
    auto* shown = surface.Actor && surface.Actor->GetVisibility()
      ? vtkPolyData::SafeDownCast(surface.Actor->GetMapper()->GetInput())
      : nullptr;
    if (shown && shown->GetNumberOfPolys() > 0)
    {
      box.AddBounds(surface.Actor->GetBounds());
    }
  }
  vtkPolyData* path = self.Choice.WorldPath();
  if (path && !self.Choice.Strokes())
  {
    box.SetBounds(path->GetBounds());
  }
  if (!box.IsValid())
  {
    this->Fail(
      "The device's workspace fits nothing: what is to be touched is hidden, or has no surface: no "
      "faces. Touch a source with a surface, and render.");
    return false;
  }
  double bounds[6];
  box.GetBounds(bounds);
  self.Fitted = self.Scene->FitWorkspace(bounds, self.View->GetActiveCamera());
  if (!self.Fitted)
  {
    self.Message = self.Scene->GetErrorMessage();
    return false;
  }
  self.PathIsKnown = false;
  return true;
}

void vtkPVHapticScene::ScaleWorkspace(double factor)
{
  if (!this->Internal->Scene->ScaleWorkspace(factor))
  {
    this->Internal->Message = this->Internal->Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::SetClutched(bool clutched)
{
  this->Internal->Scene->SetClutched(clutched);
}

bool vtkPVHapticScene::GetClutched()
{
  return this->Internal->Scene->GetClutched();
}

void vtkPVHapticScene::SetShowForce(bool show)
{
  this->Internal->Picture->GetOverlay()->SetShowForce(show);
}

void vtkPVHapticScene::SetShowReadout(bool show)
{
  this->Internal->Picture->GetOverlay()->SetShowReadout(show);
}

void vtkPVHapticScene::SetShowTrail(bool show)
{
  this->Internal->Picture->GetGodObjectActor()->SetShowTrail(show);
}

void vtkPVHapticScene::SetRecordingFileName(const char* name)
{
  this->Internal->Scene->GetServo()->SetRecordingFileName(name ? name : "");
  this->Modified();
}

void vtkPVHapticScene::SetRecordTrace(bool record)
{
  vtkHapticTraceRecorder* recorder = this->Internal->Scene->GetTraceRecorder();
  if (record && !recorder->GetRecording())
  {
    this->SyncSurfaces(); // whose arrays it has
    for (const std::string& name : this->Internal->NamesOfArrays())
    {
      recorder->AddSurfaceArray(name.c_str());
    }
  }
  recorder->SetRecording(record);
  recorder->ClearSurfaceArrays(); // nobody asked for them by name: one not touched is no fault
}

bool vtkPVHapticScene::GetRecordTrace()
{
  return this->Internal->Scene->GetTraceRecorder()->GetRecording();
}

void vtkPVHapticScene::DropLandmark()
{
  if (this->Internal->Scene->DropLandmark() < 0)
  {
    this->Internal->Message = this->Internal->Scene->GetErrorMessage();
  }
}

void vtkPVHapticScene::RemoveLastLandmark()
{
  this->Internal->Scene->GetLandmarks()->Undo();
}

void vtkPVHapticScene::ClearLandmarks()
{
  this->Internal->Scene->GetLandmarks()->RemoveAll();
}

void vtkPVHapticScene::SetLandmarkDistance(int distance)
{
  this->Internal->Scene->GetLandmarks()->SetDistance(distance);
}

int vtkPVHapticScene::GetNumberOfLandmarks()
{
  return this->Internal->Scene->GetLandmarks()->GetNumberOfLandmarks();
}
