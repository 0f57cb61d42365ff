#ifndef HapticServoInternals_h
#define HapticServoInternals_h

#include "RecordingChannel.h"
#include "ServoCycle.h"
#include "ServoLoop.h"
#include "ServoStatistics.h"
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
