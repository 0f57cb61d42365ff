#ifndef Haptics_HapticServoInternals_h
#define Haptics_HapticServoInternals_h

#include "haptics/Servo/RecordingChannel.h"
#include "haptics/Servo/ServoCycle.h"
#include "haptics/Servo/ServoLoop.h"
#include "haptics/Servo/ServoStatistics.h"
#include "vtkHapticServo.h"

/// The plain parts of a vtkHapticServo, for its own source files.
class vtkHapticServo::Internals
{
public:
  static constexpr std::size_t RecordsKept = 16384;

  haptics::ServoCycle Cycle{ RecordsKept };
  haptics::ServoStatistics Statistics;
  haptics::ServoLoop Loop{ this->Cycle, this->Statistics }; // last: ends before the others
  haptics::ServoSettings Settings;
  std::shared_ptr<haptics::RecordingChannel> Recorder; // null while nothing is recorded
  bool IsFailureReported = false;                      // of the recorder
  std::shared_ptr<haptics::DeviceChannel> Claimed;     // null while no run has a device

  void Unclaim()
  {
    if (this->Claimed)
    {
      this->Claimed->Unclaim();
      this->Claimed.reset();
    }
  }
};

#endif
