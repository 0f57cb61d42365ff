#include "haptics/Devices/ForceDimension/DhdLibrary.h"

#include "haptics/Devices/Driver/DeviceDriver.h"
#include "haptics/Devices/Driver/VendorLibrary.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace haptics
{
namespace
{
constexpr int OldestMajor = 3; // drdIsSupported and drdStop have their arguments from there on

std::vector<std::string> Folders()
{
  std::vector<std::string> folders;
  if (const char* sdk = std::getenv("FDSDK"))
  {
    folders.push_back(std::string(sdk) + "/lib/release/lin-x86_64-gcc/");
    folders.push_back(std::string(sdk) + "/lib/");
  }
  folders.push_back("/usr/local/lib/");
  return folders;
}

std::vector<std::string> Names(const std::string& file)
{
  if (!file.empty())
  {
    return { file };
  }
  std::vector<std::string> names{ "libdrd.so.3", "libdrd.so" };
  for (const std::string& folder : Folders())
  {
    names.push_back(folder + "libdrd.so.3");
    names.push_back(folder + "libdrd.so");
  }
  return names;
}

std::string Advice(const std::string& file)
{
  for (const std::string& folder : Folders())
  {
    std::error_code error;
    if (file.empty() && std::filesystem::exists(folder + "libdrd.a", error))
    {
      return "There is only the static " + folder +
        "libdrd.a, which cannot be loaded: copy libdrd.so.3 from Force Dimension's SDK to the same "
        "folder.";
    }
  }
  return "Install Force Dimension's SDK, version 3, and set FDSDK to its folder, or set "
         "LibraryFile "
         "to its libdrd.so.";
}
}

DhdLibrary::DhdLibrary(const std::string& file)
{
  const VendorLibrary library(Names(file), Advice(file));
  library.Get(this->GetDeviceCount, "dhdGetDeviceCount");
  library.Get(this->OpenID, "drdOpenID");
  library.Get(this->Close, "drdClose");
  library.Get(this->IsSupported, "drdIsSupported");
  library.Get(this->IsInitialized, "drdIsInitialized");
  library.Get(this->AutoInitialize, "drdAutoInit");
  library.Get(this->StopRegulation, "drdStop");
  library.Get(this->GetSystemName, "dhdGetSystemName");
  library.Get(this->GetSerialNumber, "dhdGetSerialNumber");
  library.Get(this->GetLastError, "dhdErrorGetLastStr");
  library.Get(this->EnableForce, "dhdEnableForce");
  library.Get(this->GetPosition, "dhdGetPosition");
  library.Get(this->SetForce, "dhdSetForce");
  library.Get(this->GetButtonMask, "dhdGetButtonMask");
  library.Get(this->GetOrientation, "dhdGetOrientationFrame");
  library.Get(this->HasWrist, "dhdHasWrist");
  library.Get(this->GetVersion, "dhdGetSDKVersion");
  int version[4] = { 0, 0, 0, 0 };
  this->GetVersion(version, version + 1, version + 2, version + 3);
  if (version[0] < OldestMajor)
  {
    throw DeviceFault("Force Dimension's SDK is version " + std::to_string(version[0]) + "." +
      std::to_string(version[1]) + ", which is too old. Install version 3.");
  }
}
}
