// How vtkHapticServo starts, steps, stops and records.
#include "haptics/Scene/HapticServoInternals.h"
#include "haptics/Servo/MonotonicClock.h"
#include "haptics/Servo/RealTimePriority.h"
#include "vtkHapticSafety.h"

#include "vtkHapticDevice.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace
{
constexpr double NanosecondsInSecond = 1e9;
}

bool vtkHapticServo::Begin(int state)
{
  if (!this->Device || !this->Device->IsOpen())
  {
    this->Fail(this->Device ? "The device is not open. Call its Open() first."
                            : "There is no device. Call SetDevice() first.");
    return false;
  }
  this->Stop();
  this->Internal->Settings.Safety.NominalPeriod = 1.0 / this->Rate;
  this->Configure(); // the device's limits may be others since it was opened
  this->Internal->Statistics.Clear();
  std::shared_ptr<haptics::DeviceChannel> channel = this->Device->GetChannel();
  if (!channel->Claim())
  {
    this->Fail("The device is in use by another servo, of another scene or view. Release that one "
               "first, or give each a device of its own.");
    return false;
  }
  this->Internal->Claimed = channel;
  this->RecordedTicks = 0;
  this->UnrecordedTicks = 0;
  if (!this->RecordingFileName.empty())
  {
    if (this->Device->PlaysFile(this->RecordingFileName.c_str()))
    {
      this->Internal->Unclaim();
      this->Fail("The recording " + this->RecordingFileName +
        " is being played and cannot be recorded to. Give another RecordingFileName, or an empty "
        "one to run without.");
      return false;
    }
    haptics::RecordingHeader header;
    header.Rate = this->Rate;
    header.MaximumForce = this->Device->GetMaximumForce();
    header.MaximumStiffness = this->Device->GetMaximumStiffness();
    header.Damping = this->Device->GetDamping();
    header.Latency = this->Device->GetLatency();
    this->Device->GetWorkspaceBounds(header.WorkspaceBounds.data());
    header.NumberOfButtons = static_cast<std::uint32_t>(this->Device->GetNumberOfButtons());
    auto recorder = std::make_shared<haptics::RecordingChannel>(channel);
    std::string error;
    if (!recorder->Start(this->RecordingFileName, header, error))
    {
      this->Internal->Unclaim();
      this->Fail(error + " Give another RecordingFileName, or an empty one to run without.");
      return false;
    }
    this->Internal->Recorder = recorder;
    this->Internal->IsFailureReported = false;
    channel = recorder;
  }
  this->Internal->Cycle.Begin(std::move(channel), static_cast<haptics::ServoState>(state));
  this->ErrorMessage.clear();
  return true;
}

bool vtkHapticServo::Start()
{
  if (this->IsRunning())
  {
    return true;
  }
  if (!this->Begin(Running))
  {
    return false;
  }
  haptics::ServoTiming timing;
  timing.Period = static_cast<std::uint64_t>(std::llround(NanosecondsInSecond / this->Rate));
  timing.StallLimit =
    static_cast<std::uint64_t>(std::llround(NanosecondsInSecond * this->StallLimit));
  timing.WatchdogTime =
    static_cast<std::uint64_t>(std::llround(NanosecondsInSecond * this->Safety->GetWatchdogTime()));
  timing.MissedShare = this->Safety->GetMissedTickShare();
  timing.RealTimePriority = this->RealTimePriority;
  timing.DevicePaced = this->DevicePaced;
  std::string error;
  if (!this->Internal->Loop.Start(timing, error))
  {
    this->Internal->Cycle.End(haptics::ServoState::Stopped);
    this->Update(); // others may have the device
    this->Fail(error);
    return false;
  }
  this->PriorityNote = this->RealTimePriority
    ? haptics::DescribePriority(this->Internal->Loop.GetPriorityResult())
    : "Real-time priority was not asked for.";
  this->NoticeState(Running);
  return true;
}

void vtkHapticServo::Stop()
{
  this->Internal->Loop.Stop();
  if (this->Internal->Cycle.GetState() == haptics::ServoState::Stepping)
  {
    this->Internal->Cycle.End(haptics::ServoState::Stopped);
  }
  this->Update();
}

int vtkHapticServo::Step(int n)
{
  this->ErrorMessage.clear();
  if (this->IsRunning())
  {
    this->Fail("The servo is running on its own thread. Call Stop() before Step().");
    return 0;
  }
  if (n < 0)
  {
    this->Fail("The number of steps must not be below 0, but is " + std::to_string(n) + ".");
    return 0;
  }
  // A device that was opened again has another channel, and begins anew.
  const std::shared_ptr<haptics::DeviceChannel> channelNow =
    this->Device ? this->Device->GetChannel() : nullptr;
  const bool isOpenedAgain = channelNow && channelNow != this->Internal->Claimed;
  if (this->Internal->Cycle.GetState() != haptics::ServoState::Stepping || isOpenedAgain)
  {
    if (!this->Begin(Stepping))
    {
      return 0;
    }
    this->NextStep = 0;
    this->StepPeriod = 1.0 / this->Rate;
  }

  haptics::DeviceChannel& channel = this->Internal->Cycle.GetChannel();
  int done = 0;
  for (; done < n; ++done)
  {
    double time = 0.0;
    const bool deviceTime = channel.NextTime(time);
    if (!deviceTime)
    {
      time = static_cast<double>(this->NextStep) * this->StepPeriod;
    }
    const double period = deviceTime ? time - this->LastStepTime : this->StepPeriod;
    if (this->Internal->Recorder)
    {
      this->Internal->Recorder->WaitForRoom();
    }
    const std::uint64_t before = haptics::MonotonicNow();
    if (!this->Internal->Cycle.Tick(time))
    {
      break;
    }
    this->Internal->Statistics.AddTick(
      static_cast<std::uint64_t>(std::llround(NanosecondsInSecond * std::max(0.0, period))),
      haptics::MonotonicNow() - before);
    this->LastStepTime = time;
    ++this->NextStep;
  }
  this->Update();
  return done;
}

void vtkHapticServo::FinishRecording()
{
  if (this->Internal->Recorder && !this->Internal->Recorder->IsHere())
  {
    new std::shared_ptr<haptics::RecordingChannel>(
      this->Internal->Recorder); // its file is its parent's
    this->Internal->Recorder.reset();
  }
  if (this->Internal->Recorder)
  {
    std::string error;
    this->Internal->Recorder->Finish(error);
    this->CountRecordedTicks();
    this->NoticeRecording();
    this->Internal->Recorder.reset();
  }
}

void vtkHapticServo::NoticeRecording()
{
  if (this->Internal->Recorder && this->Internal->Recorder->IsHere() &&
    !this->Internal->IsFailureReported)
  {
    const std::string failure = this->Internal->Recorder->GetFailure();
    if (!failure.empty())
    {
      this->Internal->IsFailureReported = true;
      this->Fail(failure);
    }
  }
}

void vtkHapticServo::CountRecordedTicks()
{
  if (this->Internal->Recorder)
  {
    this->RecordedTicks = static_cast<vtkTypeInt64>(this->Internal->Recorder->GetNumberOfTicks());
    this->UnrecordedTicks =
      static_cast<vtkTypeInt64>(this->Internal->Recorder->GetNumberOfLostTicks());
  }
}

vtkTypeInt64 vtkHapticServo::GetNumberOfRecordedTicks()
{
  this->CountRecordedTicks();
  return this->RecordedTicks;
}

vtkTypeInt64 vtkHapticServo::GetNumberOfUnrecordedTicks()
{
  this->CountRecordedTicks();
  return this->UnrecordedTicks;
}
