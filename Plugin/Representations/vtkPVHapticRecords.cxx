#include "vtkPVHapticRecords.h"

#include "PolyDataText.h"
#include "RepresentedSurfaces.h"
#include "vtkCallbackCommand.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>

vtkStandardNewMacro(vtkPVHapticRecords);

namespace
{
const std::string EndOfText = "</VTKFile>";
constexpr const char* Space = " \t\r\n";

/// Of several texts behind each other, the last of which may be cut.
std::vector<std::string> Split(const std::string& contents)
{
  std::vector<std::string> texts;
  std::size_t begin = contents.find_first_not_of(Space);
  while (begin < contents.size())
  {
    std::size_t end = contents.find(EndOfText, begin);
    end = end == std::string::npos ? contents.size() : end + EndOfText.size();
    texts.push_back(contents.substr(begin, end - begin) + "\n");
    begin = contents.find_first_not_of(Space, end);
  }
  return texts;
}

/// Makes records of texts from the `first` on; what is wrong with one, else empty.
std::string Read(const std::vector<std::string>& texts, std::size_t first,
  std::vector<vtkSmartPointer<vtkPolyData>>& records)
{
  vtkNew<vtkHapticLandmarks> trial;
  trial->AddObserver(vtkCommand::ErrorEvent, vtkNew<vtkCallbackCommand>()); // said here
  for (std::size_t i = first; i < texts.size(); ++i)
  {
    const auto record = vtkSmartPointer<vtkPolyData>::New();
    if (!haptics::FromText(texts[i], record) || trial->Add(record) < 0)
    {
      return "Landmark " + std::to_string(i + 1) + " of " + std::to_string(texts.size()) +
        " in LandmarkContents cannot be read: the text was cut or changed. All landmarks stay as "
        "they were. Give the text as it was saved, or load another state.";
    }
    records.push_back(record);
  }
  return {};
}
}

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

const std::vector<std::string>& vtkPVHapticRecords::Texts()
{
  vtkHapticLandmarks* const landmarks = this->Scene->GetLandmarks();
  if (this->TextsTime != landmarks->GetMTime())
  {
    this->TextsTime = landmarks->GetMTime();
    this->LandmarkTexts.clear();
    vtkNew<vtkPolyData> record;
    for (int i = 0; i < landmarks->GetNumberOfLandmarks(); ++i)
    {
      landmarks->GetRecord(i, record);
      this->LandmarkTexts.push_back(Split(haptics::ToText(record)).front());
    }
  }
  return this->LandmarkTexts;
}

std::string vtkPVHapticRecords::GetLandmarkContents()
{
  std::string contents;
  if (this->Scene)
  {
    for (const std::string& text : this->Texts())
    {
      contents += text;
    }
  }
  return contents;
}

void vtkPVHapticRecords::SetLandmarkContents(const char* contents)
{
  if (!this->Scene)
  {
    return;
  }
  vtkHapticLandmarks* const landmarks = this->Scene->GetLandmarks();
  const std::vector<std::string> wanted = Split(contents ? contents : "");
  const std::vector<std::string> there = this->Texts();
  const std::size_t most = std::min(wanted.size(), there.size());
  std::size_t kept = 0;
  while (kept < most && wanted[kept] == there[kept])
  {
    ++kept;
  }
  std::vector<vtkSmartPointer<vtkPolyData>> records;
  const std::string problem = Read(wanted, kept, records);
  if (!problem.empty())
  {
    this->Fail(problem);
    return;
  }
  for (std::size_t i = kept; i < there.size(); ++i)
  {
    landmarks->Undo();
  }
  for (const vtkSmartPointer<vtkPolyData>& record : records)
  {
    landmarks->Add(record);
  }
}

std::string vtkPVHapticRecords::GetProblemOf(const char* contents)
{
  std::vector<vtkSmartPointer<vtkPolyData>> records;
  return Read(Split(contents ? contents : ""), 0, records);
}

void vtkPVHapticRecords::SetLandmarkDistance(int distance)
{
  if (this->Scene)
  {
    this->Scene->GetLandmarks()->SetDistance(distance);
  }
}

int vtkPVHapticRecords::GetNumberOfFreeLandmarks()
{
  return this->Scene ? this->Scene->GetLandmarks()->GetNumberOfFreeLandmarks() : 0;
}

int vtkPVHapticRecords::GetNumberOfLandmarks()
{
  return this->Scene ? this->Scene->GetLandmarks()->GetNumberOfLandmarks() : 0;
}
