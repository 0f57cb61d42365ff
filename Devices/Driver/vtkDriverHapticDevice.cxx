#include "vtkDriverHapticDevice.h"

#include "haptics/Devices/Driver/DriverThread.h"
#include "haptics/Devices/Driver/ForceChannel.h"

#include <algorithm>

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

void vtkDriverHapticDevice::BeginThread()
{
  this->Ending.reset();
  this->Driver =
    std::make_unique<haptics::DriverThread>(this->MakeDriver(), this->ForceLimit, this->Reconnect);
}

void vtkDriverHapticDevice::EndThread()
{
  if (this->Driver)
  {
    this->Driver->RequestStop();
    this->Ending = std::move(this->Driver);
  }
  this->Force.reset();
}

bool vtkDriverHapticDevice::HasThread() const
{
  return this->Driver != nullptr;
}

void vtkDriverHapticDevice::FollowThread()
{
  const haptics::DriverStatus status = this->Driver->GetStatus();
  const bool isNewSession = status.Link != this->Link;
  this->Link = status.Link;
  this->HasRealTimePriority = status.IsRealTime;
  if (status.Phase == haptics::DevicePhase::Ready && (isNewSession || !this->IsOpen()))
  {
    this->BecomeAble(status.Limits);
  }
  this->Follow(status.Phase, status.Text, isNewSession);
}

// Any other loss the driver reports itself, once it has left the device without force.
std::string vtkDriverHapticDevice::GetProblem() const
{
  return this->Force->HasStarved()
    ? "No new position of the device came for 0.2 s: the machine is too busy, or the vendor's "
      "software hangs. Relieve the machine or start that software anew, then open the device "
      "again."
    : "";
}

std::shared_ptr<haptics::MonitoredChannel> vtkDriverHapticDevice::MakeChannel()
{
  this->Force = std::make_shared<haptics::ForceChannel>(this->Link);
  return this->Force;
}

const haptics::LinkCounts& vtkDriverHapticDevice::GetCounts() const
{
  return *this->Link;
}

void vtkDriverHapticDevice::BecomeAble(const haptics::DriverLimits& limits)
{
  this->ModelName = limits.Name;
  this->MaximumForce = limits.MaximumForce;
  this->MaximumStiffness = limits.MaximumStiffness;
  this->NumberOfButtons = limits.Buttons;
  std::copy(limits.Workspace.begin(), limits.Workspace.end(), this->WorkspaceBounds);
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

vtkTypeInt64 vtkDriverHapticDevice::GetNumberOfReleases() const
{
  return Load(this->Link->Releases);
}

void vtkDriverHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TriedOnHardware: no, by nobody who has reported it\n";
  os << indent << "DeviceId: " << this->DeviceId << "\n";
  os << indent << "ModelName: " << this->ModelName << "\n";
  os << indent << "ForceLimit: " << this->ForceLimit << " N\n";
  os << indent << "Reconnect: " << (this->Reconnect ? "on" : "off") << "\n";
  os << indent << "NumberOfReleases: " << this->GetNumberOfReleases() << "\n";
}
