#include "vtkHapticTraceRecorder.h"

#include "haptics/Filters/LengthUnit.h"
#include "haptics/Filters/TraceCSV.h"
#include "haptics/Filters/TraceRecorder.h"
#include "haptics/Scene/TouchedColumns.h"
#include "haptics/Scene/TouchedPlace.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <map>

vtkStandardNewMacro(vtkHapticTraceRecorder);

class vtkHapticTraceRecorder::vtkInternals
{
public:
  haptics::TraceRecorder Ticks;
  haptics::TouchedColumns Columns;
  std::map<int, std::string> Names; // of the surfaces that were touched, as they were called last

  void AddNames(vtkFieldData* data) const
  {
    vtkNew<vtkIntArray> ids;
    vtkNew<vtkStringArray> names;
    ids->SetName("SurfaceId");
    names->SetName("SurfaceName");
    for (const auto& entry : this->Names)
    {
      ids->InsertNextValue(entry.first);
      names->InsertNextValue(
        entry.second.empty() ? "surface " + std::to_string(entry.first) : entry.second);
    }
    data->AddArray(ids);
    data->AddArray(names);
  }
};

vtkHapticTraceRecorder::vtkHapticTraceRecorder()
  : Internals(std::make_unique<vtkInternals>())
{
}

vtkHapticTraceRecorder::~vtkHapticTraceRecorder() = default;

void vtkHapticTraceRecorder::Start()
{
  this->InvokeEvent(vtkCommand::StartEvent);
  this->Internals->Ticks.Clear();
  this->Internals->Columns.Restart(this->SurfaceArrays);
  this->Internals->Names.clear();
  this->NumberOfLostTicks = 0;
  this->Recording = true;
  this->Modified();
}

void vtkHapticTraceRecorder::Stop()
{
  this->InvokeEvent(vtkCommand::EndEvent);
  const std::string missing =
    this->SurfaceArrays.empty() ? std::string() : this->Internals->Columns.Missing();
  if (this->Recording && !missing.empty() && !this->Internals->Names.empty())
  {
    vtkWarningMacro(<< "No surface that was touched has an array " << missing
                    << "; the trace lacks it. Check the name, and see what a probe lists.");
  }
  this->Recording = false;
  this->Modified();
}

void vtkHapticTraceRecorder::SetRecording(bool recording)
{
  if (recording != this->Recording)
  {
    recording ? this->Start() : this->Stop();
  }
}

void vtkHapticTraceRecorder::AddSurfaceArray(const char* name)
{
  if (name && *name)
  {
    this->SurfaceArrays.emplace_back(name);
    this->Modified();
  }
}

void vtkHapticTraceRecorder::ClearSurfaceArrays()
{
  this->SurfaceArrays.clear();
  this->Modified();
}

void vtkHapticTraceRecorder::SetUnitLength(double metres)
{
  haptics::SetLength(this, "UnitLength", this->UnitLength, metres);
}

void vtkHapticTraceRecorder::Add(
  const haptics::TickRecord& tick, const haptics::TouchedPlace& place)
{
  if (this->Recording && this->Internals->Ticks.Size() >= this->MaximumTicks)
  {
    this->Recording = false;
    vtkWarningMacro("The trace is full with " << this->Internals->Ticks.Size()
                                              << " ticks; recording has stopped. Raise "
                                                 "MaximumTicks to record longer.");
  }
  if (this->Recording)
  {
    this->Internals->Ticks.Add({ tick, place.Traced });
    this->Internals->Columns.Add(place.Prepared, place.Triangle, place.Traced.Weights);
    if (place.Traced.Surface >= 0)
    {
      std::string& name = this->Internals->Names[place.Traced.Surface];
      name = place.Name ? *place.Name : name;
    }
  }
}

void vtkHapticTraceRecorder::OnLostTicks(vtkIdType lostInRun)
{
  if (this->Recording)
  {
    // The servo counts from 0 again at each start.
    const bool isSameRun = lostInRun >= this->LostInRun;
    this->NumberOfLostTicks += isSameRun ? lostInRun - this->LostInRun : lostInRun;
  }
  this->LostInRun = lostInRun;
}

vtkIdType vtkHapticTraceRecorder::GetNumberOfTicks()
{
  return this->Internals->Ticks.Size();
}

vtkPolyData* vtkHapticTraceRecorder::GetTrace()
{
  this->Internals->Ticks.Write(this->Trace, this->UnitLength);
  this->Internals->Columns.AddTo(this->Trace->GetPointData());
  this->Internals->AddNames(this->Trace->GetFieldData());
  return this->Trace;
}

bool vtkHapticTraceRecorder::WriteCSV(const char* file)
{
  const std::string error = haptics::WriteTraceCSV(this->GetTrace(), file);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
  return error.empty();
}

void vtkHapticTraceRecorder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UnitLength: " << this->UnitLength << " m\n";
  os << indent << "SurfaceArrays:";
  for (const std::string& name : this->SurfaceArrays)
  {
    os << " " << name;
  }
  os << "\n" << indent << "Recording: " << (this->Recording ? "yes" : "no") << "\n";
  os << indent << "NumberOfTicks: " << this->Internals->Ticks.Size() << "\n";
  os << indent << "MaximumTicks: " << this->MaximumTicks << "\n";
  os << indent << "NumberOfLostTicks: " << this->NumberOfLostTicks << "\n";
}
