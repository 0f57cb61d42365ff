/**
 * @class   vtkForceDimensionHapticDevice
 * @brief   a Force Dimension omega, delta, sigma or lambda, or a Novint Falcon, through its SDK
 *
 * The SDK (libdrd, version 3) is Force Dimension's, and has to be installed; it is loaded when the
 * device is opened. Devices are identified by their index, "0" and on, as the SDK counts them.
 *
 * Device frame: x right, y up, z towards the user [m], the vendor's axes turned. Buttons are the
 * SDK's button mask. GetOrientation() is the wrist's, where it has one; torques and grippers are
 * not driven. Homing means that it waits to be initialised: by hand, or by AutoInitialize.
 *
 * Gravity compensation, the watchdog and the velocity threshold stay as the vendor has set them.
 * The largest force is ForceLimit, up to 8 N; what it reaches, a box of 100 mm by 100 by 80 around
 * the vendor's origin, is an assumption, as is Damping.
 *
 * Untested on hardware so far: see Devices/README.md before you trust
 * it.
 *
 * @sa vtkDriverHapticDevice vtkFalconHapticDevice
 */
#ifndef Haptics_vtkForceDimensionHapticDevice_h
#define Haptics_vtkForceDimensionHapticDevice_h

#include "vtkDriverHapticDevice.h"

class VTKHAPTICSDEVICES_EXPORT vtkForceDimensionHapticDevice : public vtkDriverHapticDevice
{
public:
  static vtkForceDimensionHapticDevice* New();
  vtkTypeMacro(vtkForceDimensionHapticDevice, vtkDriverHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// A number from 0 to 15.
  bool SetDeviceId(const char* id) override;
  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;

  ///@{
  /// The library's path. Empty, the default where the environment variable HAPTICS_DRD_LIBRARY is
  /// not set: libdrd.so in $FDSDK, /usr/local/lib or where the system looks. Read by Open().
  void SetLibraryFile(const char* path);
  const char* GetLibraryFile() const { return this->LibraryFile.c_str(); }
  ///@}
  ///@{
  /**
   * Have the SDK initialise a device that is not. It MOVES THE ARM for some seconds: keep clear of
   * it. Default off: the device waits to be initialised by hand. Read by Open().
   */
  vtkSetMacro(AutoInitialize, bool);
  vtkGetMacro(AutoInitialize, bool);
  vtkBooleanMacro(AutoInitialize, bool);
  ///@}

protected:
  vtkForceDimensionHapticDevice();
  ~vtkForceDimensionHapticDevice() override;
  std::unique_ptr<haptics::DeviceDriver> MakeDriver() override;

private:
  vtkForceDimensionHapticDevice(const vtkForceDimensionHapticDevice&) = delete;
  void operator=(const vtkForceDimensionHapticDevice&) = delete;

  std::string LibraryFile;
  bool AutoInitialize = false;
};

#endif
