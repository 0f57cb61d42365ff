/**
 * @class   vtkRecordedHapticDevice
 * @brief   plays back what a hand did: a recording made by vtkHapticServo::SetRecordingFileName()
 *
 * Position and buttons of each tick are given back bit for bit, and where the hand
 * was put down, as a mouse does it, what the device let go of by itself, and how late it was. In
 * virtual time (vtkHapticServo::Step()) the ticks also come at the recorded times, so that the same
 * surfaces, workspace transform, stiffness and safety give the same forces, bit for bit; what was
 * changed while the recording was made, and what a watchdog did then, is not in it. Behind a servo
 * thread the device is where the hand was at the time, between two recorded ticks at the earlier.
 *
 * After the last tick the hand stays where it was. A new start of the servo starts the recording
 * over. Forces are kept (GetForce()) but move nothing. Limits and workspace are those of the device
 * that was recorded.
 *
 * A recording that a crash has cut off is read up to its last whole tick; GetNote() says so.
 *
 * Every method is for the GUI thread.
 *
 * @sa vtkHapticServo vtkSimulatedHapticDevice haptics::RecordingWriter
 */
#ifndef Haptics_vtkRecordedHapticDevice_h
#define Haptics_vtkRecordedHapticDevice_h

#include "vtkHapticDevice.h"

#include <string>

class VTKHAPTICSDEVICES_EXPORT vtkRecordedHapticDevice : public vtkHapticDevice
{
public:
  static vtkRecordedHapticDevice* New();
  vtkTypeMacro(vtkRecordedHapticDevice, vtkHapticDevice);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The recording. Empty by default; read by Open().
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /// Reads the whole recording: 112 bytes of memory a tick. False, with the cause in
  /// GetErrorMessage(), where haptics::ReadRecording() takes none: it cannot be read, is none, has
  /// no whole tick, or its time does not go on.
  bool Open() override;
  void Close() override;
  bool PlaysFile(const char* fileName) override;

  ///@{
  /// Of the recording as it was opened: ticks, length [s], the servo's rate [Hz]; 0 before.
  vtkGetMacro(NumberOfTicks, vtkTypeInt64);
  vtkGetMacro(Duration, double);
  vtkGetMacro(Rate, double);
  ///@}
  /// What of the recording is missing, in a sentence: its end, or ticks within. Empty where nothing
  /// is.
  vtkGetMacro(Note, std::string);
  /// What the hand did in a tick, 0 <= tick < GetNumberOfTicks(): position [m] and force [N],
  /// device frame, and time [s]. False elsewhere or while not open.
  bool GetTick(vtkTypeInt64 tick, double& time, double position[3], double force[3]) const;

protected:
  vtkRecordedHapticDevice();
  ~vtkRecordedHapticDevice() override;

private:
  vtkRecordedHapticDevice(const vtkRecordedHapticDevice&) = delete;
  void operator=(const vtkRecordedHapticDevice&) = delete;

  class RecordedChannel;

  std::string FileName;
  std::string Note;
  vtkTypeInt64 NumberOfTicks = 0;
  double Duration = 0.0;
  double Rate = 0.0;
  std::shared_ptr<RecordedChannel> Recorded;
};

#endif
