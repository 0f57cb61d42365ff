/**
 * @class   vtkHapticDevice
 * @brief   a device that reports where a hand is and pulls on it: position in, force out
 *
 * The abstract face of every haptic device. It opens and closes the device and reports its state
 * and limits; the positions and forces themselves go through a plain channel that the servo thread
 * uses (see haptics::DeviceChannel and vtkHapticServo), never through this object.
 *
 * All positions, forces and limits are in the device frame, in metres, newtons and seconds. What
 * the axes mean is the device's own; vtkHapticServo's workspace transform maps them to the world.
 *
 * Every method is for the GUI thread (the one that made the object). StateChangedEvent is invoked
 * on it whenever the state changes; a loss that the servo thread meets is noticed by Update().
 *
 * CreateByName() makes a device by the name that a user gives it, and ListDevices() says what is
 * plugged in or running.
 *
 * @sa vtkSimulatedHapticDevice vtkHapticServo
 */
#ifndef Haptics_vtkHapticDevice_h
#define Haptics_vtkHapticDevice_h

#include "vtkCommand.h"
#include "vtkHapticsDevicesModule.h"
#include "vtkObject.h"

#include <memory>
#include <string>

namespace haptics
{
class DeviceChannel;
class MonitoredChannel;
}

class vtkHapticScene;
class vtkPolyData;
class vtkRenderWindowInteractor;
class vtkStringArray;

class VTKHAPTICSDEVICES_EXPORT vtkHapticDevice : public vtkObject
{
public:
  vtkAbstractTypeMacro(vtkHapticDevice, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What a device may be in. Later devices may add states after the last.
  enum DeviceState
  {
    Closed,  ///< not in use; what every device starts as
    Opening, ///< being found, powered or calibrated
    Ready,   ///< answers and takes forces
    Faulted, ///< could not be opened or was lost: see GetErrorMessage(); Close() or Open() again
    LoadingFirmware, ///< is being given the program that runs on it
    Homing           ///< waits for a hand to move it so that it finds its origin
  };

  /// Invoked after GetState() has changed. No call data.
  enum DeviceEvents
  {
    StateChangedEvent = vtkCommand::UserEvent + 4100
  };

  ///@{
  /**
   * A new device by the name that users give it, NAME or NAME:ID, such as "mouse", "falcon:1" or
   * "haply:049D"; what an ID is each device says in SetDeviceId(). The caller owns it. Null where
   * there is no such device; GetNameProblem() then says why and which there are, and is empty for a
   * name that is one. Names of devices that another library of the project brings, as the mouse is
   * one of rendering, are known once that library is loaded.
   */
  VTK_NEWINSTANCE static vtkHapticDevice* CreateByName(const char* name);
  static std::string GetNameProblem(const char* name);
  ///@}
  /**
   * What CreateByName() can make: the names, and what a chooser shows for each, sorted by that.
   * Both arrays are emptied first.
   */
  static void GetKnownNames(vtkStringArray* names, vtkStringArray* titles);
  /**
   * What is plugged in or running, of all devices that are known: what to give to CreateByName(),
   * and in a sentence its state, or why there is none and what helps. A device needs no permission
   * to be listed and none is opened, moved or given force. Takes up to half a second a device.
   */
  static void ListDevices(vtkStringArray* names, vtkStringArray* states);

  ///@{
  /**
   * Which of several devices of its kind it is. Read by Open(). SetDeviceId() returns false for
   * what cannot be an id of this kind; an empty one stands for the first that is found. By default
   * there are none but that.
   */
  virtual bool SetDeviceId(const char* id);
  virtual const char* GetDeviceId() const { return ""; }
  ///@}
  /**
   * Appends the ids of what is plugged in or running of this kind, each with its state in a
   * sentence; an empty id with what is missing where there is nothing. Default: what needs no
   * hardware is ready.
   */
  virtual void FindDevices(vtkStringArray* ids, vtkStringArray* states);
  /** Whether it pushes back. Default true; where not, forces are only shown. */
  virtual bool GivesForce() { return true; }

  /**
   * Open the device and make it ready. Returns true when it is ready or already was; else the
   * cause is in GetErrorMessage() and, through vtkErrorMacro, in VTK's error output. A device that
   * takes time to open returns false in the state Opening, with no error, and becomes Ready or
   * Faulted in a later Update().
   */
  virtual bool Open() = 0;

  /**
   * Let go of the device: no force from here on. Closing a closed device does nothing. A servo
   * that still holds the channel reads "lost" from it and stops; it is safe to close at any time.
   */
  virtual void Close() = 0;

  /// Notice what happened on the servo thread: a device lost there becomes Faulted here. Cheap.
  virtual void Update();

  /// Whether the device is open with other settings than it has now, so that it has to be closed
  /// and opened for them. A scene does so before it engages or steps. Here false.
  virtual bool HasChanged() { return false; }

  /// True from a successful Open() to Close() or a fault.
  bool IsOpen() const { return this->State == Ready; }
  ///@{
  /// The state, as a number of DeviceState and as its English name.
  int GetState() const { return this->State; }
  const char* GetStateAsString() const;
  ///@}
  /// Why the device is Faulted or did not open; empty where nothing is wrong.
  const char* GetErrorMessage() const { return this->ErrorMessage.c_str(); }
  /// What goes on, as a message: the error if there is one, or what opening is waiting for.
  virtual const char* GetStatusMessage() const { return this->ErrorMessage.c_str(); }

  ///@{
  /**
   * What the device can do. MaximumForce [N] and MaximumStiffness [N/m] are what it can hold
   * without shaking; Damping [N s/m] is the viscous friction of its mechanics, 0 where it is not
   * known. Latency [s] is the time from a force that the servo asks for to the one that the hand
   * meets, beyond the servo's own period. WorkspaceBounds [m] is (xmin, xmax, ymin, ymax, zmin,
   * zmax), what the hand can reach.
   */
  vtkGetMacro(MaximumForce, double);
  vtkGetMacro(MaximumStiffness, double);
  vtkGetMacro(Damping, double);
  vtkGetMacro(Latency, double);
  vtkGetVector6Macro(WorkspaceBounds, double);
  vtkGetMacro(NumberOfButtons, int);
  ///@}

  ///@{
  /**
   * What went between servo and device last: the position [m], the force asked for [N] and the
   * buttons (bit i is set while button i is held). Zeros before the first tick after Open(); the
   * last values after Close(). Never waits for the servo.
   */
  void GetPosition(double position[3]);
  void GetForce(double force[3]);
  unsigned int GetButtons();
  ///@}

  /** Whether it plays this file, by whichever name. Default: no. */
  virtual bool PlaysFile(const char* fileName);

  ///@{
  /**
   * A device without a hand of its own, where NeedsPath() is true, goes along the points of a path
   * [m], device frame, at the times of its point array `Time` [s] or at `speed` [m/s], over and
   * over where it loops. It closes, as a path is read by Open(). Defaults: no, does nothing.
   */
  virtual bool NeedsPath();
  virtual void FollowPath(vtkPolyData* path, double speed, bool loops);
  ///@}
  /**
   * A device that has no place of its own, as a mouse, starts from the front of what it reaches
   * when it opens next. Others are where they are. Default: does nothing.
   */
  virtual void StartInFront();

  ///@{
  /**
   * A device that is moved by the mouse and keys of a view, where UsesView() is true, gets that
   * view's interactor and the scene that it is to touch by ConnectView(); null for no view.
   * HasView() is whether it has one. Defaults: no, does nothing, no.
   */
  virtual bool UsesView();
  virtual bool HasView();
  virtual void ConnectView(vtkRenderWindowInteractor* interactor, vtkHapticScene* scene);
  ///@}
  ///@{
  /**
   * Of a device with UsesView(): whether it presses on the surface, as its held key does. Defaults:
   * does nothing, no.
   */
  virtual void SetPressed(bool pressed);
  virtual bool GetPressed();
  ///@}

  /**
   * The servo thread's end of the device; null while the device is not open. A channel may outlive
   * Close(): its Read() then returns false. C++ only.
   */
  std::shared_ptr<haptics::DeviceChannel> GetChannel() const;

protected:
  vtkHapticDevice();
  ~vtkHapticDevice() override;

  /// For Open(): takes the channel, forgets the error, becomes Ready.
  void BecomeReady(std::shared_ptr<haptics::MonitoredChannel> channel);
  /// For Open() and Update(): shuts the channel, keeps the message, reports it, becomes `state`.
  void Fail(int state, const std::string& message);
  /// For Close(): shuts the channel, becomes Closed.
  void BecomeClosed();
  /// Changes the state and reports it; any but Closed and Faulted forgets the error.
  void SetState(int state);

  double MaximumForce = 0.0;
  double MaximumStiffness = 0.0;
  double Damping = 0.0;
  double Latency = 0.0;
  double WorkspaceBounds[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  int NumberOfButtons = 0;

private:
  vtkHapticDevice(const vtkHapticDevice&) = delete;
  void operator=(const vtkHapticDevice&) = delete;

  int State = Closed;
  std::string ErrorMessage;
  std::shared_ptr<haptics::MonitoredChannel> Channel;
};

#endif
