#include "haptics/Devices/Driver/VendorLibrary.h"

#include "haptics/Devices/Driver/DeviceDriver.h"

#include <dlfcn.h>

namespace haptics
{
VendorLibrary::VendorLibrary(const std::vector<std::string>& names, const std::string& advice)
  : Advice(advice)
{
  std::string problem;
  for (const std::string& name : names)
  {
    this->Handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (this->Handle)
    {
      this->Name = name;
      return;
    }
    const char* const reason = dlerror();
    const std::string text = reason ? reason : "unknown";
    // A library that is there and cannot be loaded says more than one that is not.
    if (problem.empty() || text.rfind(name + ": cannot open shared object file", 0) != 0)
    {
      problem = text;
    }
  }
  throw DeviceFault(names.front() + " cannot be loaded (" + problem + "). " + advice);
}

void* VendorLibrary::Find(const char* name) const
{
  void* const symbol = dlsym(this->Handle, name);
  if (!symbol)
  {
    throw DeviceFault(
      this->Name + " has no function " + name + ": its version is too old. " + this->Advice);
  }
  return symbol;
}
}
