#include "haptics/Devices/SpaceMouse/SpnavLibrary.h"

#include "haptics/Devices/Driver/VendorLibrary.h"

namespace haptics
{
SpnavLibrary::SpnavLibrary()
{
  const VendorLibrary library(
    { "libspnav.so.0", "libspnav.so" }, "Install libspnav (Debian: apt install libspnav0).");
  library.Get(this->Open, "spnav_open");
  library.Get(this->Close, "spnav_close");
  library.Get(this->Socket, "spnav_fd");
  library.Get(this->PollEvent, "spnav_poll_event");
  library.Get(this->Protocol, "spnav_protocol");
  library.Get(this->DeviceName, "spnav_dev_name");
}

const SpnavLibrary& SpnavLibrary::Get()
{
  static const SpnavLibrary library;
  return library;
}
}
