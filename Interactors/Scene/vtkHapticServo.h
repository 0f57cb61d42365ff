/**
 * @class   vtkHapticServo
 * @brief   the 1 kHz loop between a haptic device and the surfaces: position in, force out
 *
 * Each tick reads the device, maps its position to the world, moves the god-object, maps its
 * displacement back, and writes the force of a spring to the device. Start() does so on a thread
 * of its own at absolute deadlines, with real-time priority where the system permits it; Step()
 * does so in virtual time on the calling thread, which gives the same result in every run.
 *
 * The servo thread touches no vtkObject, allocates nothing and takes no lock. All that goes to and
 * from it goes wait-free: settings and surfaces at once at its next tick, its state when Update()
 * is called.
 *
 * Safety: the force is zero after Stop(), after destruction, while paused, when the process ends,
 * and from the very tick on in which the device is lost, reports a position that is not finite, or
 * in which the displacement is not finite. A watchdog takes it away while a tick is overdue; after
 * too many missed deadlines or a gap of more than StallLimit the run ends. The servo then has
 * stopped in the state that says why, and stays so until Start() or Step(). No force is longer
 * than the device's or this object's MaximumForce, none grows faster than GetSafety() allows, and
 * no surface is stiffer than device and measured periods can hold. README.md in this folder has
 * the table.
 *
 * vtkHapticScene gives it the surfaces; without any it is free space and all forces are zero.
 *
 * Every method is for the GUI thread; none but Start(), Stop() and SetDevice() waits for the servo.
 *
 * @sa vtkHapticReadings vtkHapticScene vtkHapticDevice haptics::ServoCycle haptics::ServoLoop
 */
#ifndef Haptics_vtkHapticServo_h
#define Haptics_vtkHapticServo_h

#include "vtkCommand.h"
#include "vtkHapticsSceneModule.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkHapticDevice;
class vtkHapticReadings;
class vtkHapticSafety;
class vtkMatrix4x4;

namespace haptics
{
class GodObject;
struct ServoReport;
struct TickRecord;
}

class VTKHAPTICSSCENE_EXPORT vtkHapticServo : public vtkObject
{
public:
  static vtkHapticServo* New();
  vtkTypeMacro(vtkHapticServo, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What the servo does, or why it stopped. The same as haptics::ServoState.
  enum ServoStates
  {
    Stopped,         ///< not started, or stopped on request
    Running,         ///< ticking on its own thread
    Stepping,        ///< Step() was called last
    DeviceLost,      ///< the device did not answer or was closed
    InvalidPosition, ///< the device reported a position that is not finite
    InvalidForce,    ///< the displacement is not finite in the device frame
    Stalled,         ///< two ticks were more than StallLimit apart
    Overrun,         ///< more deadlines were missed than the safety's MissedTickShare
    Interrupted      ///< a signal, exit or std::terminate; the process may have gone on
  };

  /// Invoked after GetState() has changed, from Start(), Step(), Stop() or Update(). No call data.
  enum ServoEvents
  {
    StateChangedEvent = vtkCommand::UserEvent + 4300
  };

  ///@{
  /// The device. Null by default. Setting another one stops the servo first.
  void SetDevice(vtkHapticDevice* device);
  vtkHapticDevice* GetDevice();
  ///@}

  ///@{
  /// Ticks a second [Hz]. Default 1000, clamped to 50 to 10,000; NaN is an error and
  /// changes nothing. Read by Start() and by the first Step().
  void SetRate(double rate);
  vtkGetMacro(Rate, double);
  ///@}
  ///@{
  /// Whether Start() asks for real-time priority. Default on. See GetPriorityNote().
  vtkSetMacro(RealTimePriority, bool);
  vtkGetMacro(RealTimePriority, bool);
  ///@}
  ///@{
  /// The longest gap between two ticks [s] that is no fault. Default 0.5, clamped to 0.05 to 60;
  /// NaN is an error and changes nothing. Read by Start().
  void SetStallLimit(double limit);
  vtkGetMacro(StallLimit, double);
  ///@}

  ///@{
  /**
   * The spring between HIP and god-object [N/m], device frame. Default 500, finite and >= 0; any
   * other value is an error and changes nothing. Acts at the next tick; a higher one is reached
   * over the safety's SoftStartTime.
   *
   * What is used is not above the device's MaximumStiffness, nor what its Damping and Latency allow
   * (see vtkHapticSafety): GetStiffnessLimit(), VTK_DOUBLE_MAX without a device, and
   * GetEffectiveStiffness() where all periods are exact. What the latest tick had is among
   * GetReadings().
   */
  void SetStiffness(double stiffness);
  vtkGetMacro(Stiffness, double);
  double GetStiffnessLimit();
  double GetEffectiveStiffness();
  ///@}
  ///@{
  /**
   * The longest force [N]; longer ones are shortened. Default VTK_DOUBLE_MAX: only the device's own
   * MaximumForce limits. Not below 0; any other value is an error and changes nothing. Acts at the
   * next tick.
   */
  void SetMaximumForce(double force);
  vtkGetMacro(MaximumForce, double);
  double GetEffectiveMaximumForce();
  ///@}
  ///@{
  /**
   * In how many substeps a tick may follow the HIP's straight way since the tick before: 1 to 16;
   * other values are clamped. Default 1: off; 4 are enough nearly everywhere. A tick has more than
   * one only where what holds the god-object changes on the way and leads it elsewhere, as on rough
   * ground and in folds: there one coarse step can end in another valley than a hand that moves
   * slowly. Each costs about as much as a tick; a ball goes in one. All guarantees of
   * haptics::GodObject hold, whatever the limit. Acts at the next tick.
   */
  void SetSubstepLimit(int limit);
  int GetSubstepLimit();
  ///@}
  ///@{
  /**
   * The radius of the ball about the HIP that touches [m], device frame; 0, the default: a point.
   * Finite and >= 0; any other value is an error and changes nothing. Acts at the next tick, on
   * god-objects that are published as haptics::Tip::Ball. A ball that overlaps is smaller at
   * first, and is pushed out as it grows to its size, over 128 ticks. See
   * haptics::GodObject::SetTipRadius().
   */
  void SetTipRadius(double radius);
  double GetTipRadius();
  ///@}

  /// What keeps the force from hurting: slew, soft start, stiffness, watchdog, passivity. Not null.
  vtkHapticSafety* GetSafety();

  ///@{
  /// While paused the servo goes on, with zero force from the next tick on; after it the force
  /// grows softly. Default off.
  void SetPaused(bool paused);
  vtkGetMacro(Paused, bool);
  vtkBooleanMacro(Paused, bool);
  ///@}

  ///@{
  /**
   * Device frame [m] to world frame: rotation, uniform scale, translation. Default the identity.
   * Any other matrix (a mirror, a shear, not finite, null) is an error, changes nothing and returns
   * false. After a change the HIP is where the device is; a god-object that touches stays on its
   * side, one that is free goes along with the HIP, but never to the inside of a closed surface,
   * and the force starts softly.
   */
  bool SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld);
  void GetWorkspaceTransform(vtkMatrix4x4* deviceToWorld);
  ///@}

  ///@{
  /**
   * While clutched the god-object stays where it is, wherever the device goes, and no force is
   * asked for; surfaces that move push it along. Afterwards contact goes on from there, softly:
   * give a workspace transform before that takes the device to the god-object. Default off.
   */
  void SetClutched(bool clutched);
  bool GetClutched();
  ///@}

  ///@{
  /**
   * A file to record every tick to, as it happens: what the device reported, and the force. Empty
   * by default: nothing is recorded. Read by Start() and the first Step(), which replace a
   * recording of that name, and fail where it cannot be written, holds anything else than a
   * recording, is no regular file, or is recorded to by another servo. What vtkRecordedHapticDevice
   * plays back. The servo thread writes nothing itself; the file is whole after Stop(), or up to 10
   * ms before a crash. Where the disk fills up, or the file is deleted, replaced or cut off
   * meanwhile, the next Update() reports it (ErrorEvent and GetErrorMessage()); the servo goes on
   * without recording.
   */
  vtkSetMacro(RecordingFileName, std::string);
  vtkGetMacro(RecordingFileName, std::string);
  ///@}
  ///@{
  /// Ticks of this run or the last one that are in the file, and that are not, or not any more.
  /// After the run they make up all of its ticks.
  vtkTypeInt64 GetNumberOfRecordedTicks();
  vtkTypeInt64 GetNumberOfUnrecordedTicks();
  ///@}

  /// At the next tick the god-object starts anew at the HIP, as in free space.
  void PlaceGodObject();

  /**
   * Start ticking on a thread. The device must be set and open. Returns whether the servo runs;
   * else the cause is in GetErrorMessage() and in VTK's error output. Forgets statistics and
   * records of the run before; does nothing while running.
   */
  bool Start();
  /// Ask for zero force and stop, waiting about a period for the thread, and on a USB device for
  /// the zero to get there: some milliseconds, at most 30. Keeps the statistics.
  void Stop();
  /**
   * Run n >= 0 ticks in virtual time, one period apart (or at the times of a recording, where the
   * device plays one), on this thread, then do what Update() does.
   * The first one after Start(), Stop() or a fault begins at time 0 and forgets statistics and
   * records. Returns the ticks done: fewer than n where the device was lost, and none, with an
   * error, while running or without an open device.
   */
  int Step(int n);
  /// True while the servo thread is ticking.
  bool IsRunning();

  /**
   * Take in what the servo did: the state below, faults, god-objects to delete. Call it about as
   * often as the picture is drawn. Returns whether there was a new tick or another state.
   */
  bool Update();

  ///@{
  /// The state as of the last Start(), Step(), Stop() or Update(): a number of ServoStates, and its
  /// English name.
  vtkGetMacro(State, int);
  const char* GetStateAsString();
  ///@}
  /// Why the servo did not start or has stopped; empty where nothing is wrong.
  const char* GetErrorMessage() { return this->ErrorMessage.c_str(); }
  /// Whether the last Start() got real-time priority, and what to do where not; empty before.
  const char* GetPriorityNote() { return this->PriorityNote.c_str(); }

  /// Reads the latest tick and the statistics, all at one moment. The same object each time, never
  /// null.
  vtkHapticReadings* GetReadings();
  /// Ticks of this run, or of the last one.
  vtkTypeInt64 GetNumberOfTicks();

#ifndef __VTK_WRAP__
  /**
   * Touch other surfaces: the servo's next tick goes on with this god-object from where the last
   * one stands. Returns the number that the ticks' records carry from then on (their Generation).
   * Null is an error and returns 0. C++ only, as all below.
   */
  std::uint64_t PublishGodObject(std::unique_ptr<haptics::GodObject> godObject);
  /// Append the ticks since the last call, oldest first; returns how many.
  std::size_t DrainRecords(std::vector<haptics::TickRecord>& records);
  /// The latest tick as of the last Update(), Step() or Stop().
  const haptics::TickRecord& GetLatestRecord() const;
  /// All statistics at one moment.
  haptics::ServoReport GetReport() const;
#endif

protected:
  vtkHapticServo();
  ~vtkHapticServo() override;

private:
  vtkHapticServo(const vtkHapticServo&) = delete;
  void operator=(const vtkHapticServo&) = delete;

  class Internals;

  bool Begin(int state);
  void Configure(); // hands all settings to the servo thread
  void Fail(const std::string& message);
  bool NoticeState(int state);
  void ReportRecording();

  std::unique_ptr<Internals> Internal;
  vtkSmartPointer<vtkHapticDevice> Device;
  double Rate = 1000.0;
  vtkNew<vtkHapticReadings> Readings;
  vtkNew<vtkHapticSafety> Safety;
  bool RealTimePriority = true;
  bool Paused = false;
  double StallLimit = 0.5;
  double Stiffness = 500.0;
  double MaximumForce = VTK_DOUBLE_MAX;
  int State = Stopped;
  vtkTypeInt64 NextStep = 0; // number of the next tick in virtual time
  double StepPeriod = 0.001; // [s], of the run in virtual time
  double LastStepTime = 0.0; // [s]
  std::string ErrorMessage;
  std::string PriorityNote;
  std::string RecordingFileName;
};

#endif
