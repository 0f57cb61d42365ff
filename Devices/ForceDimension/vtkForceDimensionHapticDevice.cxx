#include "vtkForceDimensionHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/ForceDimension/ForceDimensionDriver.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstdlib>

vtkStandardNewMacro(vtkForceDimensionHapticDevice);

namespace
{
constexpr int LargestIndex = 15;

const haptics::DeviceRegistration Registration("forcedimension",
  "Force Dimension omega, delta, sigma, lambda (not tried on hardware)",
  []() -> vtkHapticDevice* { return vtkForceDimensionHapticDevice::New(); });
}

vtkForceDimensionHapticDevice::vtkForceDimensionHapticDevice()
{
  if (const char* file = std::getenv("HAPTICS_DRD_LIBRARY"))
  {
    this->LibraryFile = file;
  }
  this->NumberOfButtons = 8;
  const double bounds[6] = { -0.05, 0.05, -0.05, 0.05, -0.04, 0.04 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkForceDimensionHapticDevice::~vtkForceDimensionHapticDevice() = default;

std::unique_ptr<haptics::DeviceDriver> vtkForceDimensionHapticDevice::MakeDriver()
{
  return std::make_unique<haptics::ForceDimensionDriver>(
    std::atoi(this->GetDeviceId()), this->LibraryFile, this->AutoInitialize);
}

bool vtkForceDimensionHapticDevice::SetDeviceId(const char* id)
{
  const std::string digits = id ? id : "";
  return digits.size() <= 2 && digits.find_first_not_of("0123456789") == std::string::npos &&
    std::atoi(digits.c_str()) <= LargestIndex && this->Superclass::SetDeviceId(id);
}

void vtkForceDimensionHapticDevice::SetLibraryFile(const char* path)
{
  const std::string file = path ? path : "";
  if (this->LibraryFile != file)
  {
    this->LibraryFile = file;
    this->Modified();
  }
}

void vtkForceDimensionHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  try
  {
    const haptics::DhdLibrary library(this->LibraryFile);
    const int count = library.GetDeviceCount();
    for (int i = 0; i < std::min(count, LargestIndex + 1); ++i)
    {
      ids->InsertNextValue(std::to_string(i));
      states->InsertNextValue("plugged in; whether it is initialised shows when it is opened.");
    }
    if (count <= 0)
    {
      ids->InsertNextValue("");
      states->InsertNextValue("Force Dimension's SDK is installed but finds no device. Connect its "
                              "USB cable and its power supply.");
    }
  }
  catch (const haptics::DeviceFault& fault)
  {
    ids->InsertNextValue("");
    states->InsertNextValue(fault.what());
  }
}

void vtkForceDimensionHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LibraryFile: " << this->LibraryFile << "\n";
  os << indent << "AutoInitialize: " << (this->AutoInitialize ? "on" : "off") << "\n";
}
