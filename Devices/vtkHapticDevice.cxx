#include "vtkHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/MonitoredChannel.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <vector>

namespace
{
/// The two parts of NAME:ID.
std::pair<std::string, std::string> Split(const char* name)
{
  const std::string whole = name ? name : "";
  const std::size_t colon = whole.find(':');
  return { whole.substr(0, colon), colon < whole.size() ? whole.substr(colon + 1) : "" };
}

vtkSmartPointer<vtkHapticDevice> Make(const char* name, std::string& problem)
{
  const auto [kind, id] = Split(name);
  std::string known;
  for (const haptics::DeviceKind& each : haptics::DeviceRegistration::Kinds())
  {
    if (each.Name == kind)
    {
      auto device = vtkSmartPointer<vtkHapticDevice>::Take(each.New());
      if (device->SetDeviceId(id.c_str()))
      {
        return device;
      }
      problem = "'" + id + "' is no id of a device of the kind '" + kind + "' (" + each.Title +
        "); leave out the colon for the first that is found.";
      return nullptr;
    }
    known += (known.empty() ? "" : ", ") + each.Name;
  }
  problem = "'" + kind + "' is no device. There are: " + known + ".";
  return nullptr;
}
}

vtkHapticDevice::vtkHapticDevice() = default;

vtkHapticDevice::~vtkHapticDevice()
{
  if (this->Channel)
  {
    this->Channel->Close();
  }
}

vtkHapticDevice* vtkHapticDevice::CreateByName(const char* name)
{
  std::string problem;
  const vtkSmartPointer<vtkHapticDevice> device = Make(name, problem);
  if (device)
  {
    device->Register(nullptr);
  }
  return device;
}

std::string vtkHapticDevice::GetNameProblem(const char* name)
{
  std::string problem;
  Make(name, problem);
  return problem;
}

void vtkHapticDevice::GetKnownNames(vtkStringArray* names, vtkStringArray* titles)
{
  names->Initialize();
  titles->Initialize();
  for (const haptics::DeviceKind& each : haptics::DeviceRegistration::Kinds())
  {
    names->InsertNextValue(each.Name);
    titles->InsertNextValue(each.Title);
  }
}

void vtkHapticDevice::ListDevices(vtkStringArray* names, vtkStringArray* states)
{
  names->Initialize();
  states->Initialize();
  for (const haptics::DeviceKind& each : haptics::DeviceRegistration::Kinds())
  {
    const auto device = vtkSmartPointer<vtkHapticDevice>::Take(each.New());
    vtkNew<vtkStringArray> ids;
    vtkNew<vtkStringArray> found;
    device->FindDevices(ids, found);
    for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
    {
      const std::string id = ids->GetValue(i);
      names->InsertNextValue(id.empty() ? each.Name : each.Name + ":" + id);
      states->InsertNextValue(found->GetValue(i));
    }
  }
}

bool vtkHapticDevice::SetDeviceId(const char* id)
{
  return !id || !*id;
}

void vtkHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  ids->InsertNextValue("");
  states->InsertNextValue("ready; it needs no hardware.");
}

bool vtkHapticDevice::NeedsPath()
{
  return false;
}

void vtkHapticDevice::FollowPath(vtkPolyData*, double, bool) {}

void vtkHapticDevice::StartInFront() {}

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

void vtkHapticDevice::SetPressed(bool) {}

bool vtkHapticDevice::GetPressed()
{
  return false;
}

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
