#ifndef Haptics_DhdLibrary_h
#define Haptics_DhdLibrary_h

#include <string>

namespace haptics
{
/// @brief What this driver uses of Force Dimension's SDK, libdrd with libdhd in it, which the user
/// has installed.
///
/// The declarations are this project's own, after the facts that the SDK's online manual and public
/// bindings of several languages agree on. In SI units. A function that returns a number below 0
/// has failed, and GetLastError() says why. `id` is what OpenID() returned.
class DhdLibrary
{
public:
  /// Loads it from a path; from $FDSDK, /usr/local/lib and where the system looks, where that is
  /// empty. Throws DeviceFault.
  explicit DhdLibrary(const std::string& file);

  int (*GetDeviceCount)();
  int (*OpenID)(char index); ///< the device's id
  int (*Close)(char id);
  bool (*IsSupported)(char id);
  bool (*IsInitialized)(char id);
  int (*AutoInitialize)(char id); ///< moves the arm, for some seconds
  int (*StopRegulation)(bool keepsForces, char id);
  const char* (*GetSystemName)(char id);
  int (*GetSerialNumber)(unsigned short* number, char id);
  const char* (*GetLastError)();
  int (*EnableForce)(unsigned char isOn, char id);
  int (*GetPosition)(double* x, double* y, double* z, char id);
  int (*SetForce)(double x, double y, double z, char id);
  unsigned int (*GetButtonMask)(char id);
  int (*GetOrientation)(double matrix[3][3], char id); ///< by rows
  bool (*HasWrist)(char id);
  void (*GetVersion)(int* major, int* minor, int* release, int* revision);
};
}

#endif
