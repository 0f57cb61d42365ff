#include "vtkDriverHapticDevice.h"

#include "haptics/Devices/Driver/DriverThread.h"
#include "haptics/Devices/Driver/ForceChannel.h"

#include <algorithm>
#include <system_error>

namespace
{
int StateOf(haptics::DriverPhase phase)
{
  switch (phase)
  {
    case haptics::DriverPhase::Opening:
      return vtkHapticDevice::Opening;
    case haptics::DriverPhase::Homing:
      return vtkHapticDevice::Homing;
    case haptics::DriverPhase::Ready:
      return vtkHapticDevice::Ready;
    default:
      return vtkHapticDevice::Faulted;
  }
}

vtkTypeInt64 Load(const std::atomic<std::uint64_t>& count)
{
  return static_cast<vtkTypeInt64>(count.load(std::memory_order_relaxed));
}
}

vtkDriverHapticDevice::vtkDriverHapticDevice()
  : Link(std::make_shared<haptics::ForceLink>())
{
  // Nobody publishes the damping of these devices. With 1 N s/m, at 1 kHz and this latency, the
  // stiffness limit is 0.9 b / (T / 2 + latency) = 360 N/m.
  this->Damping = 1.0;
  this->Latency = 0.002; // up to a millisecond until the next exchange, and as much on the bus
  this->MaximumForce = this->ForceLimit;
  this->MaximumStiffness = 500.0;
}

vtkDriverHapticDevice::~vtkDriverHapticDevice() = default;

bool vtkDriverHapticDevice::Open()
{
  if (this->IsOpen())
  {
    return true;
  }
  if (this->Driver && this->GetState() != Faulted)
  {
    return false;
  }
  this->LetGo();
  this->Ending.reset();
  try
  {
    this->Driver = std::make_unique<haptics::DriverThread>(
      this->MakeDriver(), this->ForceLimit, this->Reconnect);
  }
  catch (const std::system_error& failure)
  {
    const std::string problem =
      std::string("The system gave no thread for the device: ") + failure.what();
    const bool changed = this->ChangeStatusMessage(problem);
    this->Fail(Faulted, problem);
    this->TellStatusMessage(changed);
    return false;
  }
  const bool changed = this->ChangeStatusMessage("");
  this->SetState(Opening);
  this->TellStatusMessage(changed);
  return false;
}

void vtkDriverHapticDevice::Close()
{
  const bool changed = this->ChangeStatusMessage("");
  this->LetGo();
  this->BecomeClosed();
  this->TellStatusMessage(changed);
}

void vtkDriverHapticDevice::LetGo()
{
  if (this->Driver)
  {
    this->Driver->RequestStop();
    this->Ending = std::move(this->Driver);
  }
  this->Force.reset();
}

void vtkDriverHapticDevice::Update()
{
  if (!this->Driver)
  {
    return;
  }
  this->Follow(this->Driver->GetStatus());
  // Any other loss the driver reports itself, once it has left the device without force.
  if (this->IsOpen() && this->Force->HasStarved())
  {
    const std::string problem =
      "No new position of the device came for 0.2 s: the machine is too busy, or the vendor's "
      "software hangs. Relieve the machine or start that software anew, then open the device "
      "again.";
    const bool changed = this->ChangeStatusMessage(problem);
    this->LetGo();
    this->Fail(Faulted, problem);
    this->TellStatusMessage(changed);
  }
}

void vtkDriverHapticDevice::Follow(const haptics::DriverStatus& status)
{
  if (this->IsOpen() && status.Link != this->Link)
  {
    this->Fail(Faulted, "The device was lost, and is being brought up again.");
  }
  this->Link = status.Link;
  this->RealTime = status.IsRealTime;
  const bool changed = this->ChangeStatusMessage(status.Text);
  const int state = StateOf(status.Phase);
  if (state == Faulted)
  {
    if (this->GetState() != Faulted || changed)
    {
      this->Fail(Faulted, status.Text);
    }
  }
  else if (state != Ready)
  {
    this->SetState(state);
  }
  else if (!this->IsOpen())
  {
    this->BecomeAble(status);
    this->Force = std::make_shared<haptics::ForceChannel>(this->Link);
    this->BecomeReady(this->Force);
  }
  this->TellStatusMessage(changed);
}

void vtkDriverHapticDevice::BecomeAble(const haptics::DriverStatus& status)
{
  this->ModelName = status.Limits.Name;
  this->MaximumForce = status.Limits.MaximumForce;
  this->MaximumStiffness = status.Limits.MaximumStiffness;
  this->NumberOfButtons = status.Limits.Buttons;
  std::copy(status.Limits.Workspace.begin(), status.Limits.Workspace.end(), this->WorkspaceBounds);
}

// Changed before the state and told after it: who hears of either can read both.
bool vtkDriverHapticDevice::ChangeStatusMessage(const std::string& message)
{
  const bool changed = this->StatusMessage != message;
  this->StatusMessage = message;
  return changed;
}

void vtkDriverHapticDevice::TellStatusMessage(bool changed)
{
  if (changed)
  {
    this->InvokeEvent(StatusMessageChangedEvent);
  }
}

const char* vtkDriverHapticDevice::GetStatusMessage() const
{
  return this->StatusMessage.c_str();
}

bool vtkDriverHapticDevice::SetDeviceId(const char* id)
{
  const std::string wanted = id ? id : "";
  if (this->DeviceId != wanted)
  {
    this->DeviceId = wanted;
    this->Modified();
  }
  return true;
}

void vtkDriverHapticDevice::GetOrientation(double orientation[4])
{
  this->Link->Shown.Update();
  const auto& shown = this->Link->Shown.Get().Orientation;
  std::copy(shown.begin(), shown.end(), orientation);
}

vtkTypeInt64 vtkDriverHapticDevice::GetNumberOfExchanges() const
{
  return Load(this->Link->Exchanges);
}

vtkTypeInt64 vtkDriverHapticDevice::GetNumberOfLateCommands() const
{
  return Load(this->Link->LateCommands);
}

vtkTypeInt64 vtkDriverHapticDevice::GetNumberOfReleases() const
{
  return Load(this->Link->Releases);
}

double vtkDriverHapticDevice::GetExchangeTime(double share) const
{
  return this->Link->Times.Within(share);
}

void vtkDriverHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TriedOnHardware: no, by nobody who has reported it\n";
  os << indent << "StatusMessage: " << this->StatusMessage << "\n";
  os << indent << "DeviceId: " << this->DeviceId << "\n";
  os << indent << "ModelName: " << this->ModelName << "\n";
  os << indent << "ForceLimit: " << this->ForceLimit << " N\n";
  os << indent << "Reconnect: " << (this->Reconnect ? "on" : "off") << "\n";
  os << indent << "RealTimePriority: " << (this->RealTime ? "yes" : "no") << "\n";
  os << indent << "ExchangeTime: " << this->GetExchangeTime(0.5) << " s (median), "
     << this->GetExchangeTime(0.99) << " s (99 %)\n";
  os << indent << "NumberOfExchanges: " << this->GetNumberOfExchanges() << "\n";
  os << indent << "NumberOfLateCommands: " << this->GetNumberOfLateCommands() << "\n";
  os << indent << "NumberOfReleases: " << this->GetNumberOfReleases() << "\n";
}
