/**
 * @class   vtkOpenHapticsDevice
 * @brief   a 3D Systems Touch, Touch X or Phantom, through OpenHaptics
 *
 * OpenHaptics (libHD.so) and the device's driver are 3D Systems', and have to be installed;
 * the library is loaded when the device is opened. Devices are identified by the name under which
 * the maker's Touch_Setup knows them, such as "Default Device". OpenHaptics' own scheduler is the
 * clock; it drives one device a program.
 *
 * Device frame: x right, y up, z towards the user [m], as HDAPI's. Buttons 0 to 3 are the stylus'
 * first to fourth. GetOrientation() is the stylus'. Homing means that it waits to be calibrated: a
 * Touch in its inkwell.
 *
 * The largest force is ForceLimit, up to the nominal one that the device reports; the largest
 * stiffness 500 N/m or the nominal one where that is less. Warm motors, too much force and too high
 * a speed, which OpenHaptics reports, end the run.
 *
 * Untested on hardware so far: see Devices/README.md before you trust
 * it.
 *
 * @sa vtkDriverHapticDevice
 */
#ifndef Haptics_vtkOpenHapticsDevice_h
#define Haptics_vtkOpenHapticsDevice_h

#include "vtkDriverHapticDevice.h"

class VTKHAPTICSDEVICES_EXPORT vtkOpenHapticsDevice : public vtkDriverHapticDevice
{
public:
  static vtkOpenHapticsDevice* New();
  vtkTypeMacro(vtkOpenHapticsDevice, vtkDriverHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;

  ///@{
  /// The library, a path or a name that the system finds. Default libHD.so, or the environment
  /// variable HAPTICS_HD_LIBRARY. Read by Open().
  void SetLibraryFile(const char* path);
  const char* GetLibraryFile() const { return this->LibraryFile.c_str(); }
  ///@}
  ///@{
  /**
   * Take where the arm is held while it opens for its reset position, in which all links are at
   * right angles. Only for models that have no other calibration, as the Phantom Premium; wrong
   * positions and forces come of another pose. Default off. Read by Open().
   */
  vtkSetMacro(ResetEncoders, bool);
  vtkGetMacro(ResetEncoders, bool);
  vtkBooleanMacro(ResetEncoders, bool);
  ///@}

protected:
  vtkOpenHapticsDevice();
  ~vtkOpenHapticsDevice() override;
  std::unique_ptr<haptics::DeviceDriver> MakeDriver() override;

private:
  vtkOpenHapticsDevice(const vtkOpenHapticsDevice&) = delete;
  void operator=(const vtkOpenHapticsDevice&) = delete;

  std::string LibraryFile = "libHD.so";
  bool ResetEncoders = false;
};

#endif
