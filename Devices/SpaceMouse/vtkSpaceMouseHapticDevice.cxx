#include "vtkSpaceMouseHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/SpaceMouse/SpaceMouseDriver.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <thread>

vtkStandardNewMacro(vtkSpaceMouseHapticDevice);

namespace
{
const haptics::DeviceRegistration Registration("spacemouse",
  "3Dconnexion SpaceMouse, no force (not tried on hardware)",
  []() -> vtkHapticDevice* { return vtkSpaceMouseHapticDevice::New(); });
}

vtkSpaceMouseHapticDevice::vtkSpaceMouseHapticDevice()
{
  this->SetForceLimit(5.0); // as for the mouse, of what is shown
  this->MaximumForce = 5.0;
  this->MaximumStiffness = 2000.0;
  this->Damping = 0.0;
  this->Latency = 0.0;
  this->NumberOfButtons = 32;
  const double bounds[6] = { -0.08, 0.08, -0.06, 0.06, -0.05, 0.05 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkSpaceMouseHapticDevice::~vtkSpaceMouseHapticDevice() = default;

std::unique_ptr<haptics::DeviceDriver> vtkSpaceMouseHapticDevice::MakeDriver()
{
  haptics::SpaceMouseMotion motion;
  motion.Speed = this->Speed;
  motion.DeadZone = this->DeadZone;
  std::copy(this->WorkspaceBounds, this->WorkspaceBounds + 6, motion.Bounds.begin());
  return std::make_unique<haptics::SpaceMouseDriver>(motion);
}

bool vtkSpaceMouseHapticDevice::SetDeviceId(const char* id)
{
  return !id || !*id;
}

void vtkSpaceMouseHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  std::string state;
  // libspnav writes to a daemon that may have ended; on a thread of its own SIGPIPE ends nothing.
  std::thread asking(
    [&state]
    {
      haptics::LeaveEndingSignalsToOtherThreads();
      state = haptics::SpaceMouseDriver::Describe();
    });
  asking.join();
  ids->InsertNextValue("");
  states->InsertNextValue(state);
}

void vtkSpaceMouseHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Speed: " << this->Speed << " m/s\n";
  os << indent << "DeadZone: " << this->DeadZone << "\n";
}
