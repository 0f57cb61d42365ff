#include "vtkPVHapticRecords.h"

#include "RepresentedSurfaces.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkObjectFactory.h"

#include <string>

vtkStandardNewMacro(vtkPVHapticRecords);

vtkPVHapticRecords::vtkPVHapticRecords() = default;
vtkPVHapticRecords::~vtkPVHapticRecords() = default;

void vtkPVHapticRecords::SetRecordingFileName(const char* name)
{
  if (this->Scene)
  {
    this->Scene->GetServo()->SetRecordingFileName(name ? name : "");
  }
}

void vtkPVHapticRecords::SetRecordTrace(bool record)
{
  if (!this->Scene)
  {
    return;
  }
  vtkHapticTraceRecorder* recorder = this->Scene->GetTraceRecorder();
  if (record && !recorder->GetRecording())
  {
    this->Surfaces->Sync(); // whose arrays it has
    for (const std::string& name : this->Surfaces->NamesOfArrays())
    {
      recorder->AddSurfaceArray(name.c_str());
    }
  }
  recorder->SetRecording(record);
  recorder->ClearSurfaceArrays(); // nobody asked for them by name: one not touched is no fault
}

bool vtkPVHapticRecords::GetRecordTrace()
{
  return this->Scene && this->Scene->GetTraceRecorder()->GetRecording();
}

void vtkPVHapticRecords::DropLandmark()
{
  if (this->Scene && this->Scene->DropLandmark() < 0)
  {
    this->Fail();
  }
}

void vtkPVHapticRecords::RemoveLastLandmark()
{
  if (this->Scene)
  {
    this->Scene->GetLandmarks()->Undo();
  }
}

void vtkPVHapticRecords::ClearLandmarks()
{
  if (this->Scene)
  {
    this->Scene->GetLandmarks()->RemoveAll();
  }
}

void vtkPVHapticRecords::SetLandmarkDistance(int distance)
{
  if (this->Scene)
  {
    this->Scene->GetLandmarks()->SetDistance(distance);
  }
}

int vtkPVHapticRecords::GetNumberOfLandmarks()
{
  return this->Scene ? this->Scene->GetLandmarks()->GetNumberOfLandmarks() : 0;
}
