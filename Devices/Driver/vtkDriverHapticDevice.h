/**
 * @class   vtkDriverHapticDevice
 * @brief   a device that a thread of its own exchanges with, a thousand times a second
 *
 * What the drivers of commercial devices have in common; each of them is a class derived from
 * it:
 *
 *     Closed -> Opening -> Homing -> Ready -> Faulted, Closed
 *
 * The servo waits for the device's samples. A force is withdrawn where the servo does not renew it
 * for 20 ms or the device's position is older than that; what the device gets last is zero, on
 * Close(), destruction, every fault after which it still listens, and where the process ends while
 * a servo runs (see haptics::EmergencyStop). After a fault the next force grows softly from zero.
 *
 * Limits are those that the device reports or its maker documents, and the stiffness that its
 * damping allows; no maker publishes that, so Damping is 1 N s/m, an assumption with which 360 N/m
 * are allowed at 1 kHz and the stated latency of 2 ms. See Devices/README.md, *Before you trust a
 * new device*.
 *
 * GUI thread.
 *
 * @sa vtkThreadedHapticDevice vtkHaplyHapticDevice vtkOpenHapticsDevice
 * vtkForceDimensionHapticDevice vtkSpaceMouseHapticDevice
 */
#ifndef Haptics_vtkDriverHapticDevice_h
#define Haptics_vtkDriverHapticDevice_h

#include "vtkThreadedHapticDevice.h"

#include <memory>
#include <string>

namespace haptics
{
class DeviceDriver;
class DriverThread;
class ForceChannel;
struct DriverLimits;
struct ForceLink;
}

class VTKHAPTICSDEVICES_EXPORT vtkDriverHapticDevice : public vtkThreadedHapticDevice
{
public:
  vtkAbstractTypeMacro(vtkDriverHapticDevice, vtkThreadedHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Any text; which ids there are the class of the device says.
  bool SetDeviceId(const char* id) override;
  const char* GetDeviceId() const override { return this->DeviceId.c_str(); }

  ///@{
  /**
   * No force is larger [N], whatever the device can give. Default 2, to begin with; 0 to 50. Read
   * by Open().
   */
  vtkSetClampMacro(ForceLimit, double, 0.0, 50.0);
  vtkGetMacro(ForceLimit, double);
  ///@}
  ///@{
  /**
   * Bring the device up again by itself after a fault, every half second. A servo that ran stays
   * ended. Default off. Read by Open().
   */
  vtkSetMacro(Reconnect, bool);
  vtkGetMacro(Reconnect, bool);
  vtkBooleanMacro(Reconnect, bool);
  ///@}

  /// What the device calls itself, with its serial number; empty before it was Ready.
  const char* GetModelName() const { return this->ModelName.c_str(); }
  /// How the grip is held, device frame: a unit quaternion w, x, y, z; (1, 0, 0, 0) where the
  /// device does not measure it. No force depends on it.
  void GetOrientation(double orientation[4]);

  /// How often the driver let go of all force by itself since the device was opened, late commands
  /// included.
  vtkTypeInt64 GetNumberOfReleases() const;

protected:
  vtkDriverHapticDevice();
  ~vtkDriverHapticDevice() override;

  /// For Open(): what talks to the device, with the settings of now.
  virtual std::unique_ptr<haptics::DeviceDriver> MakeDriver() = 0;

  void BeginThread() override;
  void EndThread() override;
  bool HasThread() const override;
  void FollowThread() override;
  std::string GetProblem() const override;
  std::shared_ptr<haptics::MonitoredChannel> MakeChannel() override;
  const haptics::LinkCounts& GetCounts() const override;

private:
  vtkDriverHapticDevice(const vtkDriverHapticDevice&) = delete;
  void operator=(const vtkDriverHapticDevice&) = delete;

  void BecomeAble(const haptics::DriverLimits& limits);

  std::string DeviceId;
  double ForceLimit = 2.0;
  bool Reconnect = false;

  std::unique_ptr<haptics::DriverThread> Driver;
  std::unique_ptr<haptics::DriverThread> Ending; // asked to stop; joined before the next begins
  std::shared_ptr<haptics::ForceLink> Link;
  std::shared_ptr<haptics::ForceChannel> Force;
  std::string ModelName;
};

#endif
