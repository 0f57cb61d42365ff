#include "vtkOpenHapticsDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/OpenHaptics/OpenHapticsDriver.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

vtkStandardNewMacro(vtkOpenHapticsDevice);

namespace
{
const haptics::DeviceRegistration Registration("openhaptics",
  "3D Systems Touch, Phantom (not tried on hardware)",
  []() -> vtkHapticDevice* { return vtkOpenHapticsDevice::New(); });

/// The names under which the maker's setup program has written settings.
std::set<std::string> ConfiguredNames()
{
  std::set<std::string> names;
  const char* const home = std::getenv("GTDD_HOME");
  for (const std::string& folder :
    { std::string(home ? home : "/usr/share/3DSystems"), std::string("/usr/share/3DSystems") })
  {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder + "/config", error), end;
         !error && entry != end; entry.increment(error))
    {
      if (entry->path().extension() == ".config")
      {
        names.insert(entry->path().stem().string());
      }
    }
  }
  return names;
}
}

vtkOpenHapticsDevice::vtkOpenHapticsDevice()
{
  if (const char* file = std::getenv("HAPTICS_HD_LIBRARY"))
  {
    this->LibraryFile = file;
  }
  this->MaximumForce = std::min(this->GetForceLimit(), 3.3);
  this->NumberOfButtons = 4;
  const double bounds[6] = { -0.08, 0.08, -0.06, 0.06, -0.035, 0.035 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkOpenHapticsDevice::~vtkOpenHapticsDevice() = default;

std::unique_ptr<haptics::DeviceDriver> vtkOpenHapticsDevice::MakeDriver()
{
  return std::make_unique<haptics::OpenHapticsDriver>(
    this->GetDeviceId(), this->LibraryFile, this->ResetEncoders);
}

void vtkOpenHapticsDevice::SetLibraryFile(const char* path)
{
  const std::string file = path ? path : "";
  if (this->LibraryFile != file)
  {
    this->LibraryFile = file;
    this->Modified();
  }
}

void vtkOpenHapticsDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  try
  {
    const haptics::HdLibrary library(this->LibraryFile);
    const std::set<std::string> names = ConfiguredNames();
    for (const std::string& name : names)
    {
      ids->InsertNextValue(name);
      states->InsertNextValue("set up by the maker's program; whether it is plugged in shows when "
                              "it is opened.");
    }
    if (names.empty())
    {
      ids->InsertNextValue("");
      states->InsertNextValue("OpenHaptics is installed, but no device was set up: run the maker's "
                              "Touch_Setup, and set GTDD_HOME to where it writes.");
    }
  }
  catch (const haptics::DeviceFault& fault)
  {
    ids->InsertNextValue("");
    states->InsertNextValue(fault.what());
  }
}

void vtkOpenHapticsDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LibraryFile: " << this->LibraryFile << "\n";
  os << indent << "ResetEncoders: " << (this->ResetEncoders ? "on" : "off") << "\n";
}
