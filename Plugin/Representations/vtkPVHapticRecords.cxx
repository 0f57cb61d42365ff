#include "vtkPVHapticRecords.h"

#include "RepresentedSurfaces.h"
#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkHapticLandmarks.h"
#include "vtkHapticScene.h"
#include "vtkHapticServo.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <numeric>

vtkStandardNewMacro(vtkPVHapticRecords);

namespace
{
const std::string EndOfText = "</VTKFile>";

/// Of several texts behind each other.
std::vector<std::string> Split(const std::string& contents)
{
  std::vector<std::string> texts;
  std::size_t begin = 0;
  for (std::size_t end = contents.find(EndOfText); end != std::string::npos;
       end = contents.find(EndOfText, begin))
  {
    end += EndOfText.size();
    texts.push_back(contents.substr(begin, end - begin) + "\n");
    begin = std::min(contents.find('<', end), contents.size());
  }
  return texts;
}

/// VTK's writer puts names of arrays into XML as they are: what XML does not bear, and %, is %XX.
std::string Encoded(const std::string& name)
{
  std::string text;
  for (const char c : name)
  {
    const bool isPlain = c >= ' ' && !std::strchr("%\"<>&\x7f", c);
    char code[8];
    std::snprintf(code, sizeof(code), "%%%02X", static_cast<unsigned char>(c));
    text += isPlain || static_cast<unsigned char>(c) >= 0x80 ? std::string(1, c) : code;
  }
  return text;
}

std::string Decoded(const std::string& text)
{
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    unsigned int code = 0;
    const bool isCode =
      text[i] == '%' && std::sscanf(text.substr(i + 1, 2).c_str(), "%2x", &code) == 1;
    name += isCode ? static_cast<char>(code) : text[i];
    i += isCode ? 2 : 0;
  }
  return name;
}

/// Gives the arrays of data, which no one else has, other names.
void RenameArrays(vtkPolyData* record, std::string (*renamed)(const std::string&))
{
  for (vtkFieldData* data : { static_cast<vtkFieldData*>(record->GetPointData()),
         static_cast<vtkFieldData*>(record->GetCellData()) })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = data->GetAbstractArray(i);
      array->SetName(renamed(array->GetName() ? array->GetName() : "").c_str());
    }
  }
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
      vtkNew<vtkPolyData> copy;
      copy->DeepCopy(record);
      RenameArrays(copy, &Encoded);
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData(copy);
      writer->SetDataModeToBinary(); // base64: no byte that a property or XML could not hold
      writer->WriteToOutputStringOn();
      writer->Write();
      this->LandmarkTexts.push_back(Split(writer->GetOutputString()).front());
    }
  }
  return this->LandmarkTexts;
}

std::string vtkPVHapticRecords::GetLandmarkContents()
{
  return this->Scene ? std::accumulate(this->Texts().begin(), this->Texts().end(), std::string())
                     : std::string();
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
  for (std::size_t i = kept; i < there.size(); ++i)
  {
    landmarks->Undo();
  }
  for (std::size_t i = kept; i < wanted.size(); ++i)
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(wanted[i]);
    reader->Update();
    RenameArrays(reader->GetOutput(), &Decoded);
    landmarks->Add(reader->GetOutput());
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
