#include "vtkRecordedHapticDevice.h"

#include "haptics/Devices/MonitoredChannel.h"
#include "haptics/Devices/Recorded/DeviceRecording.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

/// The servo thread's end: a table that is gone through once.
class vtkRecordedHapticDevice::RecordedChannel : public haptics::MonitoredChannel
{
public:
  RecordedChannel(std::vector<haptics::RecordedTick> ticks, double period)
    : Ticks(std::move(ticks))
    , Period(period)
  {
  }
  const std::vector<haptics::RecordedTick>& GetTicks() const { return this->Ticks; }

  void Restart() noexcept override
  {
    this->Next = 0;
    this->TicksAfterEnd = 0;
  }
  bool NextTime(double& time) noexcept override
  {
    time = this->Next < this->Ticks.size()
      ? this->Ticks[this->Next].Time
      : this->Ticks.back().Time + static_cast<double>(++this->TicksAfterEnd) * this->Period;
    return true;
  }

protected:
  bool ReadDevice(double time, haptics::DeviceSample& sample) noexcept override
  {
    while (this->Next < this->Ticks.size() && this->Ticks[this->Next].Time <= time)
    {
      ++this->Next;
    }
    const haptics::RecordedTick& tick = this->Ticks[this->Next > 0 ? this->Next - 1 : 0];
    sample.Position = tick.Position;
    sample.Buttons = tick.Buttons;
    sample.Placements = tick.Placements;
    sample.Place = tick.Place;
    sample.Releases = tick.Releases;
    sample.Latency = tick.Latency;
    return true;
  }
  void WriteDevice(const std::array<double, 3>&) noexcept override {}

private:
  const std::vector<haptics::RecordedTick> Ticks; // at least one
  const double Period;
  std::size_t Next = 0; // first that is still to come
  std::uint64_t TicksAfterEnd = 0;
};

vtkStandardNewMacro(vtkRecordedHapticDevice);

vtkRecordedHapticDevice::vtkRecordedHapticDevice() = default;
vtkRecordedHapticDevice::~vtkRecordedHapticDevice() = default;

bool vtkRecordedHapticDevice::Open()
{
  if (this->IsOpen())
  {
    return true;
  }
  this->SetState(Opening);
  haptics::Recording recording;
  std::string error;
  if (!haptics::ReadRecording(this->FileName, recording, error))
  {
    this->Fail(Closed, error);
    return false;
  }
  const haptics::RecordingHeader& header = recording.Header;
  this->MaximumForce = header.MaximumForce;
  this->MaximumStiffness = header.MaximumStiffness;
  this->Damping = header.Damping;
  this->Latency = header.Latency;
  std::copy(header.WorkspaceBounds.begin(), header.WorkspaceBounds.end(), this->WorkspaceBounds);
  this->NumberOfButtons = static_cast<int>(header.NumberOfButtons);
  this->Rate = header.Rate;
  this->NumberOfTicks = static_cast<vtkTypeInt64>(recording.Ticks.size());
  this->Duration = recording.Ticks.back().Time - recording.Ticks.front().Time;
  this->Note = recording.Note;
  const std::uint64_t missing =
    recording.Ticks.back().Tick - recording.Ticks.front().Tick + 1 - recording.Ticks.size();
  if (missing > 0)
  {
    this->Note += (this->Note.empty() ? "" : " ") + std::to_string(missing) +
      " ticks within the recording were lost when it was made.";
  }
  if (!this->Note.empty())
  {
    vtkWarningMacro(<< this->Note);
  }
  this->Recorded = std::make_shared<RecordedChannel>(std::move(recording.Ticks), 1.0 / header.Rate);
  this->BecomeReady(this->Recorded);
  return true;
}

bool vtkRecordedHapticDevice::PlaysFile(const char* fileName)
{
  std::error_code noSuchFile;
  return fileName && std::filesystem::equivalent(this->FileName, fileName, noSuchFile);
}

void vtkRecordedHapticDevice::Close()
{
  this->BecomeClosed();
}

bool vtkRecordedHapticDevice::GetTick(
  vtkTypeInt64 tick, double& time, double position[3], double force[3]) const
{
  if (!this->IsOpen() || tick < 0 || tick >= this->NumberOfTicks)
  {
    return false;
  }
  const haptics::RecordedTick& recorded =
    this->Recorded->GetTicks()[static_cast<std::size_t>(tick)];
  time = recorded.Time;
  std::copy(recorded.Position.begin(), recorded.Position.end(), position);
  std::copy(recorded.Force.begin(), recorded.Force.end(), force);
  return true;
}

void vtkRecordedHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "NumberOfTicks: " << this->NumberOfTicks << "\n";
  os << indent << "Duration: " << this->Duration << " s\n";
  os << indent << "Rate: " << this->Rate << " Hz\n";
  os << indent << "Note: " << this->Note << "\n";
}
