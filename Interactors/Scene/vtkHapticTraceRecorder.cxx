#include "vtkHapticTraceRecorder.h"

#include "haptics/Filters/TraceRecorder.h"
#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkHapticTraceRecorder);

vtkHapticTraceRecorder::vtkHapticTraceRecorder()
  : Ticks(std::make_unique<haptics::TraceRecorder>())
{
}

vtkHapticTraceRecorder::~vtkHapticTraceRecorder() = default;

void vtkHapticTraceRecorder::Start()
{
  this->InvokeEvent(vtkCommand::StartEvent);
  this->Ticks->Clear();
  this->NumberOfLostTicks = 0;
  this->Recording = true;
  this->Modified();
}

void vtkHapticTraceRecorder::Stop()
{
  this->InvokeEvent(vtkCommand::EndEvent);
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

void vtkHapticTraceRecorder::Add(const haptics::TickRecord& tick, int surface, vtkIdType cell)
{
  if (this->Recording && this->Ticks->Size() >= this->MaximumTicks)
  {
    this->Recording = false;
    vtkWarningMacro("The trace is full with " << this->Ticks->Size()
                                              << " ticks; recording has stopped. Raise "
                                                 "MaximumTicks to record longer.");
  }
  if (this->Recording)
  {
    this->Ticks->Add({ tick, surface, cell });
  }
}

void vtkHapticTraceRecorder::CountLost(vtkIdType lostInRun)
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
  return this->Ticks->Size();
}

vtkPolyData* vtkHapticTraceRecorder::GetTrace()
{
  this->Ticks->Write(this->Trace, 0.0);
  return this->Trace;
}

void vtkHapticTraceRecorder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Recording: " << (this->Recording ? "yes" : "no") << "\n";
  os << indent << "NumberOfTicks: " << this->Ticks->Size() << "\n";
  os << indent << "MaximumTicks: " << this->MaximumTicks << "\n";
  os << indent << "NumberOfLostTicks: " << this->NumberOfLostTicks << "\n";
}
