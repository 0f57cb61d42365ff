/**
 * @class   vtkFalconHapticDevice
 * @brief   a Novint Falcon on the USB
 *
 * GetStatusMessage() reports what goes on while it opens, and what the user is to do:
 *
 *     Closed -> Opening -> LoadingFirmware -> Homing -> Ready -> Faulted, Closed
 *
 * The firmware is not part of this software; it is loaded from FirmwareFile where the device has
 * none loaded, which is so whenever its power was off. Homing needs a hand: pull the grip all the
 * way out, then push it all the way in. No force is asked for before that is done.
 *
 * The device frame is that of the kinematics: z points out of the device to the user and is 0.15 m
 * where its makers put the origin; see haptics::FalconKinematics. Buttons 0 to 3 are plus, forward,
 * centre and minus.
 *
 * Torques are in undocumented units: calibrate TorqueScale before trusting a force,
 * see Devices/README.md, which also lists every fault, what the device gets and what the user
 * reads. Damping, 2 N s/m, is an assumption: it is what the stiffness limit goes by.
 *
 * The last that the device gets is zero force: on Close(), destruction and every fault that leaves
 * it able to listen, and where the process ends while a servo runs (see haptics::EmergencyStop).
 *
 * @sa vtkThreadedHapticDevice vtkHapticServo
 */
#ifndef Haptics_vtkFalconHapticDevice_h
#define Haptics_vtkFalconHapticDevice_h

#include "vtkThreadedHapticDevice.h"

#include <memory>
#include <string>

namespace haptics
{
class FalconChannel;
class FalconTransport;
struct FalconLink;
struct FalconStatus;
}

class VTKHAPTICSDEVICES_EXPORT vtkFalconHapticDevice : public vtkThreadedHapticDevice
{
public:
  static vtkFalconHapticDevice* New();
  vtkTypeMacro(vtkFalconHapticDevice, vtkThreadedHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// From Update(). ProgressEvent carries the share of the firmware sent, a double* 0 to 1.
  enum FalconEvents
  {
    DeviceArrivedEvent = StatusMessageChangedEvent + 1 ///< a Falcon was plugged in
  };

  /// Lamps, for SetLeds().
  enum Led
  {
    GreenLed = 1,
    BlueLed = 2,
    RedLed = 4
  };

  /// An id is a DeviceIndex.
  bool SetDeviceId(const char* id) override;
  const char* GetDeviceId() const override { return this->DeviceId.c_str(); }
  void FindDevices(vtkStringArray* ids, vtkStringArray* states) override;

  ///@{
  /// Which of the Falcons plugged in, counted from 0 by bus and port. Default 0, up to 15. Read by
  /// Open().
  vtkSetClampMacro(DeviceIndex, int, 0, 15);
  vtkGetMacro(DeviceIndex, int);
  ///@}
  ///@{
  /// The path of the firmware image; empty by default. Read when it is needed, while opening.
  void SetFirmwareFile(const char* path);
  const char* GetFirmwareFile() const { return this->FirmwareFile.c_str(); }
  ///@}
  ///@{
  /// Bring the device up again by itself whenever a Falcon is plugged in after a fault. Default
  /// off. Read by Open().
  vtkSetMacro(OpenOnArrival, bool);
  vtkGetMacro(OpenOnArrival, bool);
  vtkBooleanMacro(OpenOnArrival, bool);
  ///@}
  ///@{
  /// A program that takes the torque away within 0.1 s when this process is killed, crashes or is
  /// stopped, which no program can catch itself. By default the one that is installed with this
  /// library (Linux); empty for none. Read by Open().
  vtkSetMacro(GuardianProgram, std::string);
  vtkGetMacro(GuardianProgram, std::string);
  ///@}
  ///@{
  /**
   * Motor units for a torque of 1 N m [1/(N m)], its sign is the way in which the motors turn.
   * Default -3500; from 100 to 20,000 in magnitude, else an error and no change. Read when the
   * device becomes ready.
   */
  void SetTorqueScale(double scale);
  vtkGetMacro(TorqueScale, double);
  ///@}
  ///@{
  /// What lights while the device is ready, bits of Led. Default GreenLed. Red lights while homing.
  void SetLeds(int leds);
  vtkGetMacro(Leds, int);
  ///@}

  /// Share of the firmware sent in this upload, 0 to 1.
  double GetFirmwareProgress() const { return this->FirmwareProgress; }
  ///@{
  /// Since the device was opened: replies that did not come in time, after which the next packet
  /// asked for no torque; packets that were none.
  vtkTypeInt64 GetNumberOfMissedReplies() const;
  vtkTypeInt64 GetNumberOfMalformedPackets() const;
  ///@}

protected:
  vtkFalconHapticDevice();
  ~vtkFalconHapticDevice() override;

  void BeginThread() override;
  void EndThread() override;
  bool HasThread() const override;
  void FollowThread() override;
  std::string GetProblem() const override;
  std::shared_ptr<haptics::MonitoredChannel> MakeChannel() override;
  const haptics::LinkCounts& GetCounts() const override;

private:
  vtkFalconHapticDevice(const vtkFalconHapticDevice&) = delete;
  void operator=(const vtkFalconHapticDevice&) = delete;

  void ReportProgress(const haptics::FalconStatus& status);

  std::string DeviceId;
  int DeviceIndex = 0;
  std::string FirmwareFile;
  bool OpenOnArrival = false;
  std::string GuardianProgram;
  double TorqueScale = -3500.0;
  int Leds = GreenLed;

  std::unique_ptr<haptics::FalconTransport> Transport;
  std::unique_ptr<haptics::FalconTransport> Ending; // asked to stop; joined before the next begins
  std::shared_ptr<haptics::FalconLink> Link;
  std::shared_ptr<haptics::FalconChannel> Falcon;
  double FirmwareProgress = 0.0;
  unsigned int Arrivals = 0;
};

#endif
