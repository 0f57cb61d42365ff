/**
 * @class   vtkHaplyHapticDevice
 * @brief   a Haply Inverse3, with or without a VerseGrip, through the Haply Inverse Service
 *
 * The service is Haply's, and owns the USB; it has to run on this machine. Versions 3.1 to 3.x are
 * spoken. Devices are identified by the service's `device_id`, such as "049D".
 *
 * Device frame: x right, y up, z towards the user [m], the service's axes turned (they have z up);
 * a basis that the user has set in the service is taken into account. The origin is the service's.
 * Buttons 0 to 2 are a, b and c of the first grip; GetOrientation() is that grip's, and no force
 * depends on it. Homing means that it waits to be calibrated.
 *
 * The largest force is ForceLimit, up to the 10 N that its maker names for a short while. What it
 * reaches, a box of 160 mm, is an assumption, as is Damping.
 *
 * Untested on hardware so far. Whether the service holds the last force
 * of a program that was killed is not known: see Devices/README.md before you trust it.
 *
 * @sa vtkDriverHapticDevice
 */
#ifndef Haptics_vtkHaplyHapticDevice_h
#define Haptics_vtkHaplyHapticDevice_h

#include "vtkDriverHapticDevice.h"

class VTKHAPTICSDEVICES_EXPORT vtkHaplyHapticDevice : public vtkDriverHapticDevice
{
public:
  static vtkHaplyHapticDevice* New();
  vtkTypeMacro(vtkHaplyHapticDevice, vtkDriverHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;

  ///@{
  /// The port at which the service is reached, HTTP and WebSocket. Default 10001, or the number in
  /// the environment variable HAPTICS_HAPLY_PORT; 1 to 65535. Read by Open().
  vtkSetClampMacro(Port, int, 1, 65535);
  vtkGetMacro(Port, int);
  ///@}

protected:
  vtkHaplyHapticDevice();
  ~vtkHaplyHapticDevice() override;
  std::unique_ptr<haptics::DeviceDriver> MakeDriver() override;

private:
  vtkHaplyHapticDevice(const vtkHaplyHapticDevice&) = delete;
  void operator=(const vtkHaplyHapticDevice&) = delete;

  int Port = 10001;
};

#endif
