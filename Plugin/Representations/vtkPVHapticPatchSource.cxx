#include "vtkPVHapticPatchSource.h"

#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHapticPatchInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTimerLog.h"

#include <memory>
#include <utility>

vtkStandardNewMacro(vtkPVHapticPatchSource);

vtkPVHapticPatchSource::vtkPVHapticPatchSource() = default;
vtkPVHapticPatchSource::~vtkPVHapticPatchSource() = default;

void vtkPVHapticPatchSource::SetGather(Gather gather)
{
  this->Server = std::move(gather);
}

void vtkPVHapticPatchSource::SetOutdated()
{
  this->IsOutdated = true;
  this->Modified();
}

/// False, and an error once, where there is no answer.
bool vtkPVHapticPatchSource::Ask(vtkHapticPatchInformation* question)
{
  const double start = vtkTimerLog::GetUniversalTime();
  question->ClearAnswer();
  if (this->Server)
  {
    this->Server(question);
  }
  const bool isAnswered = question->GetHasHead();
  this->AnswerTime = vtkTimerLog::GetUniversalTime() - start;
  if (!isAnswered && !this->IsSilent)
  {
    vtkErrorMacro("The server does not say what is near the hand. Where it is gone, connect to "
                  "another one and touch again; what was known of the surface stays.");
  }
  this->IsSilent = !isAnswered;
  return isAnswered;
}

bool vtkPVHapticPatchSource::IsInPatches()
{
  this->Survey();
  return this->Patches;
}

bool vtkPVHapticPatchSource::Survey()
{
  if (!this->IsOutdated)
  {
    return this->HasWhole();
  }
  vtkNew<vtkHapticPatchInformation> question;
  if (!this->Ask(question))
  {
    return this->HasWhole(); // what was known stays
  }
  this->IsOutdated = false;
  this->Patches = question->GetIsInPatches();
  if (this->HasWhole() && this->ServerVersion == question->GetVersion())
  {
    return true;
  }
  this->ServerVersion = question->GetVersion();
  this->ForgetWhole();
  if (!this->Patches)
  {
    return false;
  }
  vtkSmartPointer<vtkPolyData> first;
  std::shared_ptr<const haptics::PatchRecord> served;
  haptics::PartBox box;
  for (vtkPolyData* const sample : question->GetParts())
  {
    const auto found = haptics::PatchRecord::ReadFrom(sample->GetFieldData());
    served = found ? found : served;
    if (vtkDataArray* const bounds = sample->GetFieldData()->GetArray(BoxName))
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        box.Low[axis] = bounds->GetComponent(0, axis);
        box.High[axis] = bounds->GetComponent(1, axis);
      }
    }
    if (!first && sample->GetNumberOfCells() > 0)
    {
      first = sample;
      first->GetFieldData()->Initialize();
    }
  }
  if (!question->GetError().empty() || !served || !first)
  {
    vtkErrorMacro("The surface cannot be touched in patches. " << question->GetError());
    return false;
  }
  haptics::PatchRecord record = *served;
  const bool isFromTouched =
    record.Whole.Before != 0 && record.Whole.Before == this->TouchedServerVersion;
  record.Whole.Before = isFromTouched ? this->TouchedVersion : 0;
  this->SetWhole(record, box, first);
  return true;
}

/// False also where it is another surface since it was surveyed, which it is then.
bool vtkPVHapticPatchSource::AskOfThisVersion(vtkHapticPatchInformation* question)
{
  if (!this->Ask(question))
  {
    return false;
  }
  if (question->GetVersion() != this->ServerVersion)
  {
    this->IsOutdated = true;
    if (!this->Survey() || !this->Ask(question) || question->GetVersion() != this->ServerVersion)
    {
      return false;
    }
  }
  this->NumberOfBytes += question->GetNumberOfBytes();
  return true;
}

bool vtkPVHapticPatchSource::Crop(
  const haptics::PatchRegion& region, Use use, std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  using Question = vtkHapticPatchInformation::Question;
  vtkNew<vtkHapticPatchInformation> question;
  question->Ask(use == Use::Touch ? Question::TouchedRegion : Question::Region, region);
  if (!this->AskOfThisVersion(question))
  {
    return false;
  }
  if (use == Use::Touch)
  {
    this->TouchedServerVersion = this->ServerVersion;
    this->TouchedVersion = this->GetVersion();
  }
  ++this->NumberOfPatches;
  parts = question->GetParts();
  return true;
}

bool vtkPVHapticPatchSource::CropNearest(
  const haptics::Vec3& place, std::vector<vtkSmartPointer<vtkPolyData>>& parts)
{
  vtkNew<vtkHapticPatchInformation> question;
  question->Ask(vtkHapticPatchInformation::Question::Nearest, { place, place, 0.0 });
  if (!this->AskOfThisVersion(question))
  {
    return false;
  }
  parts = question->GetParts();
  return true;
}

void vtkPVHapticPatchSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPatches: " << this->NumberOfPatches << "\n";
  os << indent << "NumberOfBytes: " << this->NumberOfBytes << "\n";
  os << indent << "AnswerTime: " << this->AnswerTime << "\n";
}
