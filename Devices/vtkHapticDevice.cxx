#include "vtkHapticDevice.h"

#include "haptics/Devices/MonitoredChannel.h"

#include <algorithm>

vtkHapticDevice::vtkHapticDevice() = default;

vtkHapticDevice::~vtkHapticDevice()
{
  if (this->Channel)
  {
    this->Channel->Close();
  }
}

bool vtkHapticDevice::PlaysFile(const char*)
{
  return false;
}

bool vtkHapticDevice::UsesView()
{
  return false;
}

bool vtkHapticDevice::HasView()
{
  return false;
}

void vtkHapticDevice::ConnectView(vtkRenderWindowInteractor*, vtkHapticScene*) {}

void vtkHapticDevice::Update()
{
  if (this->State == Ready && this->Channel->IsLost())
  {
    this->Fail(Faulted,
      "The device stopped answering while it was in use. Check its cable and power, then open it "
      "again.");
  }
}

const char* vtkHapticDevice::GetStateAsString() const
{
  switch (this->State)
  {
    case Closed:
      return "Closed";
    case Opening:
      return "Opening";
    case Ready:
      return "Ready";
    case Faulted:
      return "Faulted";
    case LoadingFirmware:
      return "LoadingFirmware";
    case Homing:
      return "Homing";
    default:
      return "Unknown";
  }
}

void vtkHapticDevice::GetPosition(double position[3])
{
  const haptics::DeviceSnapshot last =
    this->Channel ? this->Channel->Latest() : haptics::DeviceSnapshot();
  std::copy(last.Position.begin(), last.Position.end(), position);
}

void vtkHapticDevice::GetForce(double force[3])
{
  const haptics::DeviceSnapshot last =
    this->Channel ? this->Channel->Latest() : haptics::DeviceSnapshot();
  std::copy(last.Force.begin(), last.Force.end(), force);
}

unsigned int vtkHapticDevice::GetButtons()
{
  return this->Channel ? this->Channel->Latest().Buttons : 0;
}

std::shared_ptr<haptics::DeviceChannel> vtkHapticDevice::GetChannel() const
{
  return this->State == Ready ? this->Channel : nullptr;
}

void vtkHapticDevice::BecomeReady(std::shared_ptr<haptics::MonitoredChannel> channel)
{
  this->Channel = std::move(channel);
  this->ErrorMessage.clear();
  this->SetState(Ready);
}

void vtkHapticDevice::Fail(int state, const std::string& message)
{
  if (this->Channel)
  {
    this->Channel->Close();
  }
  this->ErrorMessage = message;
  this->SetState(state);
  vtkErrorMacro(<< message);
}

void vtkHapticDevice::BecomeClosed()
{
  if (this->Channel)
  {
    this->Channel->Close();
  }
  this->ErrorMessage.clear();
  this->SetState(Closed);
}

void vtkHapticDevice::SetState(int state)
{
  if (state != Closed && state != Faulted)
  {
    this->ErrorMessage.clear();
  }
  if (this->State != state)
  {
    this->State = state;
    this->Modified();
    this->InvokeEvent(StateChangedEvent);
  }
}

void vtkHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* bounds = this->WorkspaceBounds;
  os << indent << "State: " << this->GetStateAsString() << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "MaximumForce: " << this->MaximumForce << " N\n";
  os << indent << "MaximumStiffness: " << this->MaximumStiffness << " N/m\n";
  os << indent << "Damping: " << this->Damping << " N s/m\n";
  os << indent << "Latency: " << this->Latency << " s\n";
  os << indent << "WorkspaceBounds: (" << bounds[0] << ", " << bounds[1] << ", " << bounds[2]
     << ", " << bounds[3] << ", " << bounds[4] << ", " << bounds[5] << ") m\n";
  os << indent << "NumberOfButtons: " << this->NumberOfButtons << "\n";
  const haptics::DeviceSnapshot last =
    this->Channel ? this->Channel->Latest() : haptics::DeviceSnapshot();
  os << indent << "Position: (" << last.Position[0] << ", " << last.Position[1] << ", "
     << last.Position[2] << ") m\n";
  os << indent << "Force: (" << last.Force[0] << ", " << last.Force[1] << ", " << last.Force[2]
     << ") N\n";
  os << indent << "Buttons: " << last.Buttons << "\n";
}
