#include "vtkHaplyHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/Haply/HaplyDriver.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <cstdlib>

vtkStandardNewMacro(vtkHaplyHapticDevice);

namespace
{
const haptics::DeviceRegistration Registration("haply", "Haply Inverse3 (not tried on hardware)",
  []() -> vtkHapticDevice* { return vtkHaplyHapticDevice::New(); });
}

vtkHaplyHapticDevice::vtkHaplyHapticDevice()
{
  if (const char* port = std::getenv("HAPTICS_HAPLY_PORT"))
  {
    this->SetPort(std::atoi(port));
  }
  this->NumberOfButtons = 3;
  const double bounds[6] = { -0.08, 0.08, 0.08, 0.24, 0.04, 0.20 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkHaplyHapticDevice::~vtkHaplyHapticDevice() = default;

std::unique_ptr<haptics::DeviceDriver> vtkHaplyHapticDevice::MakeDriver()
{
  return std::make_unique<haptics::HaplyDriver>(this->GetDeviceId(), this->Port);
}

void vtkHaplyHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  try
  {
    const auto devices = haptics::HaplyDriver::List(this->Port);
    for (const auto& [id, state] : devices)
    {
      ids->InsertNextValue(id);
      states->InsertNextValue(state);
    }
    if (devices.empty())
    {
      ids->InsertNextValue("");
      states->InsertNextValue("The Haply Inverse Service runs but finds no Inverse3. Connect its "
                              "USB cable and its power supply.");
    }
  }
  catch (const haptics::DeviceFault& fault)
  {
    ids->InsertNextValue("");
    states->InsertNextValue(fault.what());
  }
}

void vtkHaplyHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Port: " << this->Port << "\n";
}
