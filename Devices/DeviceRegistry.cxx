#include "haptics/Devices/DeviceRegistry.h"

#include <algorithm>
#include <map>

namespace haptics
{
namespace
{
/// Made by whichever device registers first, before main(), and never destroyed: a device of
/// another library may be forgotten after everything else.
std::map<std::string, DeviceKind>& Known()
{
  static auto* const known = new std::map<std::string, DeviceKind>;
  return *known;
}
}

DeviceRegistration::DeviceRegistration(
  const char* name, const char* title, vtkHapticDevice* (*make)())
  : Name(name)
{
  Known()[this->Name] = { name, title, make };
}

DeviceRegistration::~DeviceRegistration()
{
  Known().erase(this->Name);
}

std::vector<DeviceKind> DeviceRegistration::Kinds()
{
  std::vector<DeviceKind> kinds;
  for (const auto& [name, kind] : Known())
  {
    kinds.push_back(kind);
  }
  std::sort(kinds.begin(), kinds.end(),
    [](const DeviceKind& a, const DeviceKind& b) { return a.Title < b.Title; });
  return kinds;
}
}
