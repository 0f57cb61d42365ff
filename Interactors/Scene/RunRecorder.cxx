#include "haptics/Scene/RunRecorder.h"

#include "vtkHapticDevice.h"

#include <utility>

namespace haptics
{
void RunRecorder::Clear()
{
  this->Channel.reset();
  this->Failure.clear();
  this->IsFailureTaken = false;
  this->Ticks = 0;
  this->LostTicks = 0;
}

std::shared_ptr<DeviceChannel> RunRecorder::Start(const std::string& file, vtkHapticDevice* device,
  double rate, std::shared_ptr<DeviceChannel> channel, std::string& error)
{
  if (device->PlaysFile(file.c_str()))
  {
    error = "The recording " + file +
      " is being played and cannot be recorded to. Give another RecordingFileName, or an empty one "
      "to run without.";
    return nullptr;
  }
  RecordingHeader header;
  header.Rate = rate;
  header.MaximumForce = device->GetMaximumForce();
  header.MaximumStiffness = device->GetMaximumStiffness();
  header.Damping = device->GetDamping();
  header.Latency = device->GetLatency();
  device->GetWorkspaceBounds(header.WorkspaceBounds.data());
  header.NumberOfButtons = static_cast<std::uint32_t>(device->GetNumberOfButtons());
  auto recorder = std::make_shared<RecordingChannel>(std::move(channel));
  if (!recorder->Start(file, header, error))
  {
    error += " Give another RecordingFileName, or an empty one to run without.";
    return nullptr;
  }
  this->Channel = recorder;
  return recorder;
}

void RunRecorder::Finish()
{
  if (this->Channel && !this->Channel->IsHere())
  {
    new std::shared_ptr<RecordingChannel>(this->Channel); // its file is its parent's
    this->Channel.reset();
  }
  if (this->Channel)
  {
    std::string error;
    this->Channel->Finish(error);
    this->Failure = this->Channel->GetFailure();
    this->Ticks = this->Channel->GetNumberOfTicks();
    this->LostTicks = this->Channel->GetNumberOfLostTicks();
    this->Channel.reset();
  }
}

std::string RunRecorder::TakeFailure()
{
  const bool isHere = this->Channel && this->Channel->IsHere();
  std::string failure = isHere ? this->Channel->GetFailure() : this->Failure;
  if (failure.empty() || std::exchange(this->IsFailureTaken, true))
  {
    return {};
  }
  return failure;
}
}
