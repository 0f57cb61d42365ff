/**
 * @class   vtkSpaceMouseHapticDevice
 * @brief   a 3Dconnexion SpaceMouse moves the hand; it cannot push back
 *
 * Through the free daemon spacenavd, by libspnav; 3Dconnexion's own driver is not needed. Pushing
 * the cap moves the hand in that direction, at a rate: Speed with the cap fully deflected, nothing
 * within DeadZone. Twisting it does nothing. The hand starts in front of all that it reaches, and
 * stays within WorkspaceBounds.
 *
 * What it is not: it gives no force (GivesForce() is false). The force that a haptic device would
 * give is computed all the same and shown, as for vtkMouseHapticDevice: as the arrow of
 * vtkGodObjectActor, and as a bar and a number by vtkHapticOverlay.
 *
 * Device frame: x right, y up, z towards the user [m]. Button i is the daemon's. One device a
 * program. Untested on hardware so far.
 *
 * @sa vtkDriverHapticDevice vtkMouseHapticDevice
 */
#ifndef Haptics_vtkSpaceMouseHapticDevice_h
#define Haptics_vtkSpaceMouseHapticDevice_h

#include "vtkDriverHapticDevice.h"

class VTKHAPTICSDEVICES_EXPORT vtkSpaceMouseHapticDevice : public vtkDriverHapticDevice
{
public:
  static vtkSpaceMouseHapticDevice* New();
  vtkTypeMacro(vtkSpaceMouseHapticDevice, vtkDriverHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// There are no ids: the daemon has one SpaceMouse.
  bool SetDeviceId(const char* id) override;
  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;
  bool GivesForce() override { return false; }

  ///@{
  /// How fast the hand goes with the cap fully deflected [m/s]. Default 0.06; 0.001 to 1. Read by
  /// Open().
  vtkSetClampMacro(Speed, double, 0.001, 1.0);
  vtkGetMacro(Speed, double);
  ///@}
  ///@{
  /// Share of the full deflection, on each axis, that moves nothing. Default 0.08; 0 to 0.9. Read
  /// by Open().
  vtkSetClampMacro(DeadZone, double, 0.0, 0.9);
  vtkGetMacro(DeadZone, double);
  ///@}

protected:
  vtkSpaceMouseHapticDevice();
  ~vtkSpaceMouseHapticDevice() override;
  std::unique_ptr<haptics::DeviceDriver> MakeDriver() override;

private:
  vtkSpaceMouseHapticDevice(const vtkSpaceMouseHapticDevice&) = delete;
  void operator=(const vtkSpaceMouseHapticDevice&) = delete;

  double Speed = 0.06;
  double DeadZone = 0.08;
};

#endif
