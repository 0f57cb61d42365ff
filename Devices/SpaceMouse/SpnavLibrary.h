#ifndef Haptics_SpnavLibrary_h
#define Haptics_SpnavLibrary_h

#include <spnav.h>

namespace haptics
{
/// @brief What the driver uses of libspnav, loaded when a SpaceMouse is first asked for.
///
/// Linked, it would bring the X11 library into every program that touches, a headless one too.
class SpnavLibrary
{
public:
  /// Loads it once a process. Throws DeviceFault.
  static const SpnavLibrary& Get();

  decltype(&spnav_open) Open;
  decltype(&spnav_close) Close;
  decltype(&spnav_fd) Socket;
  decltype(&spnav_poll_event) PollEvent;
  decltype(&spnav_protocol) Protocol;
  decltype(&spnav_dev_name) DeviceName;

private:
  SpnavLibrary();
};
}

#endif
