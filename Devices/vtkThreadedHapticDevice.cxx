#include "vtkThreadedHapticDevice.h"

#include "haptics/Devices/DeviceLink.h"
#include "haptics/Devices/DevicePhase.h"
#include "haptics/Devices/MonitoredChannel.h"

#include <system_error>

namespace
{
int StateOf(haptics::DevicePhase phase)
{
  switch (phase)
  {
    case haptics::DevicePhase::Opening:
      return vtkHapticDevice::Opening;
    case haptics::DevicePhase::LoadingFirmware:
      return vtkHapticDevice::LoadingFirmware;
    case haptics::DevicePhase::Homing:
      return vtkHapticDevice::Homing;
    case haptics::DevicePhase::Ready:
      return vtkHapticDevice::Ready;
    default:
      return vtkHapticDevice::Faulted;
  }
}
}

vtkThreadedHapticDevice::vtkThreadedHapticDevice() = default;

vtkThreadedHapticDevice::~vtkThreadedHapticDevice() = default;

bool vtkThreadedHapticDevice::Open()
{
  if (this->IsOpen())
  {
    return true;
  }
  if (this->HasThread() && this->GetState() != Faulted)
  {
    return false;
  }
  this->EndThread();
  try
  {
    this->BeginThread();
  }
  catch (const std::system_error& failure)
  {
    this->FailFor(std::string("The system gave no thread for the device: ") + failure.what());
    return false;
  }
  const bool changed = this->ChangeStatusMessage("");
  this->SetState(Opening);
  this->ReportStatusMessage(changed);
  return false;
}

void vtkThreadedHapticDevice::Close()
{
  const bool changed = this->ChangeStatusMessage("");
  this->EndThread();
  this->BecomeClosed();
  this->ReportStatusMessage(changed);
}

void vtkThreadedHapticDevice::Update()
{
  if (!this->HasThread())
  {
    return;
  }
  this->FollowThread();
  const std::string problem = this->IsOpen() ? this->GetProblem() : "";
  if (!problem.empty())
  {
    this->EndThread();
    this->FailFor(problem);
  }
}

void vtkThreadedHapticDevice::Follow(
  haptics::DevicePhase phase, const std::string& text, bool isNewSession)
{
  if (this->IsOpen() && isNewSession)
  {
    this->Fail(Faulted, "The device was lost, and is being brought up again.");
  }
  const bool changed = this->ChangeStatusMessage(text);
  const int state = StateOf(phase);
  if (state == Faulted)
  {
    if (this->GetState() != Faulted || changed)
    {
      this->Fail(Faulted, text);
    }
  }
  else if (state != Ready)
  {
    this->SetState(state);
  }
  else if (!this->IsOpen())
  {
    this->BecomeReady(this->MakeChannel());
  }
  this->ReportStatusMessage(changed);
}

// The message changes before the state and is reported after it: an observer of either reads both.
void vtkThreadedHapticDevice::FailFor(const std::string& problem)
{
  const bool changed = this->ChangeStatusMessage(problem);
  this->Fail(Faulted, problem);
  this->ReportStatusMessage(changed);
}

bool vtkThreadedHapticDevice::ChangeStatusMessage(const std::string& message)
{
  const bool changed = this->StatusMessage != message;
  this->StatusMessage = message;
  return changed;
}

void vtkThreadedHapticDevice::ReportStatusMessage(bool changed)
{
  if (changed)
  {
    this->InvokeEvent(StatusMessageChangedEvent);
  }
}

const char* vtkThreadedHapticDevice::GetStatusMessage() const
{
  return this->StatusMessage.c_str();
}

vtkTypeInt64 vtkThreadedHapticDevice::Load(const std::atomic<std::uint64_t>& count)
{
  return static_cast<vtkTypeInt64>(count.load(std::memory_order_relaxed));
}

vtkTypeInt64 vtkThreadedHapticDevice::GetNumberOfExchanges() const
{
  return this->Load(this->GetCounts().Exchanges);
}

vtkTypeInt64 vtkThreadedHapticDevice::GetNumberOfLateCommands() const
{
  return this->Load(this->GetCounts().LateCommands);
}

double vtkThreadedHapticDevice::GetExchangeTime(double share) const
{
  return this->GetCounts().Times.Within(share);
}

void vtkThreadedHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StatusMessage: " << this->StatusMessage << "\n";
  os << indent << "RealTimePriority: " << (this->HasRealTimePriority ? "yes" : "no") << "\n";
  os << indent << "ExchangeTime: " << this->GetExchangeTime(0.5) << " s (median), "
     << this->GetExchangeTime(0.99) << " s (99 %)\n";
  os << indent << "NumberOfExchanges: " << this->GetNumberOfExchanges() << "\n";
  os << indent << "NumberOfLateCommands: " << this->GetNumberOfLateCommands() << "\n";
}
