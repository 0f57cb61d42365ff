#include "vtkHapticServo.h"

#include "haptics/Devices/MonotonicClock.h"
#include "haptics/Scene/RunRecorder.h"
#include "haptics/Servo/RealTimePriority.h"
#include "haptics/Servo/SafetySettings.h"
#include "haptics/Servo/ServoCycle.h"
#include "haptics/Servo/ServoLoop.h"
#include "haptics/Servo/ServoStatistics.h"
#include "haptics/Servo/StiffnessLimit.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkCommand.h"
#include "vtkHapticDevice.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSafety.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

class vtkHapticServo::Internals
{
public:
  static constexpr std::size_t RecordsKept = 16384;

  haptics::ServoCycle Cycle{ RecordsKept };
  haptics::ServoStatistics Statistics;
  haptics::ServoLoop Loop{ this->Cycle, this->Statistics }; // last: ends before the others
  haptics::ServoSettings Settings;
  haptics::RunRecorder Recorder;
  std::shared_ptr<haptics::DeviceChannel> Claimed; // null while no run has a device

  void Unclaim()
  {
    if (this->Claimed)
    {
      this->Claimed->Unclaim();
      this->Claimed.reset();
    }
  }
};

namespace
{
constexpr double NanosecondsInSecond = 1e9;

/// The same in the servo's whole nanoseconds.
std::uint64_t Nanoseconds(double seconds)
{
  return static_cast<std::uint64_t>(std::llround(NanosecondsInSecond * seconds));
}

static_assert(static_cast<int>(haptics::ServoState::Stalled) == vtkHapticServo::Stalled &&
    static_cast<int>(haptics::ServoState::DeviceLost) == vtkHapticServo::DeviceLost &&
    static_cast<int>(haptics::ServoState::Stepping) == vtkHapticServo::Stepping &&
    static_cast<int>(haptics::ServoState::Interrupted) == vtkHapticServo::Interrupted,
  "both list the same states");

/// What a fault means and what to do.
const char* Explain(int state)
{
  switch (state)
  {
    case vtkHapticServo::DeviceLost:
      return "The device was closed or stopped answering, so the servo stopped with zero force. "
             "Open the device and start again.";
    case vtkHapticServo::InvalidPosition:
      return "The device reported a position that is not finite, so the servo stopped with zero "
             "force. "
             "Check the device's calibration and start again.";
    case vtkHapticServo::InvalidForce:
      return "The god-object's displacement is not finite in the device frame, so the servo "
             "stopped with zero force. Check the scale of the workspace transform and start again.";
    case vtkHapticServo::Stalled:
      return "Two ticks were further apart than StallLimit, so the servo stopped with zero force. "
             "Relieve the machine or give the servo real-time priority, and start again.";
    case vtkHapticServo::Overrun:
      return "More deadlines were missed than the safety's MissedTickShare allows, so the servo "
             "stopped with zero force. Relieve the machine, lower Rate or give the servo real-time "
             "priority, and start again.";
    case vtkHapticServo::Interrupted:
      return "The process was asked to end, so the servo stopped with zero force. Start again if "
             "the process goes on.";
    default:
      return "";
  }
}
}

vtkStandardNewMacro(vtkHapticServo);

vtkHapticServo::vtkHapticServo()
  : Internal(new Internals)
{
  this->Safety->AddObserver(vtkCommand::ModifiedEvent, this, &vtkHapticServo::Configure);
  this->Configure();
}

vtkHapticServo::~vtkHapticServo()
{
  this->Stop();
}

void vtkHapticServo::SetDevice(vtkHapticDevice* device)
{
  if (this->Device != device)
  {
    this->Stop();
    this->Device = device;
    this->Configure();
    this->Modified();
  }
}

vtkHapticDevice* vtkHapticServo::GetDevice()
{
  return this->Device;
}

void vtkHapticServo::SetRate(double rate)
{
  if (std::isnan(rate))
  {
    vtkErrorMacro("The rate must be a number, but is NaN; it stays " << this->Rate << " Hz.");
    return;
  }
  rate = std::clamp(rate, 50.0, 10000.0);
  if (this->Rate != rate)
  {
    this->Rate = rate;
    this->Modified();
  }
}

void vtkHapticServo::SetStallLimit(double limit)
{
  if (std::isnan(limit))
  {
    vtkErrorMacro(
      "The stall limit must be a number, but is NaN; it stays " << this->StallLimit << " s.");
    return;
  }
  limit = std::clamp(limit, 0.05, 60.0);
  if (this->StallLimit != limit)
  {
    this->StallLimit = limit;
    this->Modified();
  }
}

void vtkHapticServo::SetStiffness(double stiffness)
{
  if (!std::isfinite(stiffness) || stiffness < 0.0)
  {
    vtkErrorMacro("The stiffness must be finite and not below 0 N/m, but is "
      << stiffness << "; it stays " << this->Stiffness << " N/m.");
    return;
  }
  if (this->Stiffness != stiffness)
  {
    this->Stiffness = stiffness;
    this->Configure();
    this->Modified();
  }
}

void vtkHapticServo::SetMaximumForce(double force)
{
  if (!(force >= 0.0))
  {
    vtkErrorMacro("The maximum force must not be below 0 N, but is "
      << force << "; it stays " << this->MaximumForce << " N.");
    return;
  }
  if (this->MaximumForce != force)
  {
    this->MaximumForce = force;
    this->Configure();
    this->Modified();
  }
}

void vtkHapticServo::SetSubstepLimit(int limit)
{
  limit = std::clamp(limit, 1, haptics::GodObject::LargestNumberOfSubsteps);
  if (this->Internal->Settings.SubstepLimit != limit)
  {
    this->Internal->Settings.SubstepLimit = limit;
    this->Configure();
    this->Modified();
  }
}

int vtkHapticServo::GetSubstepLimit()
{
  return this->Internal->Settings.SubstepLimit;
}

void vtkHapticServo::SetTipRadius(double radius)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    vtkErrorMacro("The radius of the tip must be finite and not below 0 m, but is "
      << radius << "; it stays " << this->GetTipRadius() << " m.");
    return;
  }
  if (this->Internal->Settings.TipRadius != radius)
  {
    this->Internal->Settings.TipRadius = radius;
    this->Configure();
    this->Modified();
  }
}

double vtkHapticServo::GetTipRadius()
{
  return this->Internal->Settings.TipRadius;
}

double vtkHapticServo::GetStiffnessLimit()
{
  const haptics::SafetySettings& safety = this->Internal->Settings.Safety;
  haptics::StiffnessLimit regular;
  regular.Restart(safety.NominalPeriod);
  const double most = this->Device ? this->Device->GetMaximumStiffness() : VTK_DOUBLE_MAX;
  return std::min(most, regular.Allowed(safety));
}

double vtkHapticServo::GetEffectiveStiffness()
{
  return std::min(this->Stiffness, this->GetStiffnessLimit());
}

double vtkHapticServo::GetEffectiveMaximumForce()
{
  return this->Device ? std::min(this->MaximumForce, this->Device->GetMaximumForce())
                      : this->MaximumForce;
}

bool vtkHapticServo::SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  if (!deviceToWorld)
  {
    vtkErrorMacro("The workspace transform is null; the last one stays.");
    return false;
  }
  haptics::WorkspaceTransform transform;
  std::string error;
  if (!transform.SetMatrix(deviceToWorld->GetData(), error))
  {
    vtkErrorMacro(<< error << " The last one stays.");
    return false;
  }
  if (transform != this->Internal->Settings.DeviceToWorld)
  {
    this->Internal->Settings.DeviceToWorld = transform;
    this->Configure();
    this->Modified();
  }
  return true;
}

void vtkHapticServo::GetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  this->Internal->Settings.DeviceToWorld.GetMatrix(deviceToWorld->GetData());
  deviceToWorld->Modified();
}

void vtkHapticServo::SetClutched(bool clutched)
{
  if (this->Internal->Settings.IsClutched != clutched)
  {
    this->Internal->Settings.IsClutched = clutched;
    this->Configure();
    this->Modified();
  }
}

bool vtkHapticServo::GetClutched()
{
  return this->Internal->Settings.IsClutched;
}

void vtkHapticServo::PlaceGodObject()
{
  ++this->Internal->Settings.Placements;
  this->Configure();
}

vtkHapticSafety* vtkHapticServo::GetSafety()
{
  return this->Safety;
}

void vtkHapticServo::SetPaused(bool paused)
{
  if (this->Paused != paused)
  {
    this->Paused = paused;
    this->Configure();
    this->Modified();
  }
}

void vtkHapticServo::Configure()
{
  haptics::SafetySettings& safety = this->Internal->Settings.Safety;
  safety.SlewLimit = this->Safety->GetSlewLimit();
  safety.SoftStartTime = this->Safety->GetSoftStartTime();
  safety.StiffnessMargin = this->Safety->GetStiffnessMargin();
  safety.ContactDamping = this->Safety->GetContactDamping();
  safety.PassivityControl = this->Safety->GetPassivityControl();
  safety.Paused = this->Paused;
  safety.DeviceDamping = this->Device ? this->Device->GetDamping() : 0.0;
  safety.DeviceLatency = this->Device ? this->Device->GetLatency() : 0.0;
  // The servo itself limits the stiffness by what its periods turn out to be.
  this->Internal->Settings.Force.Stiffness =
    this->Device ? std::min(this->Stiffness, this->Device->GetMaximumStiffness()) : this->Stiffness;
  this->Internal->Settings.Force.LargestStiffness =
    this->Device ? this->Device->GetMaximumStiffness() : VTK_DOUBLE_MAX;
  this->Internal->Settings.Force.MaximumForce = this->GetEffectiveMaximumForce();
  this->Internal->Cycle.Configure(this->Internal->Settings);
}

//--- runs -----------------------------------------------------------------------------------------

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
  this->Internal->Recorder.Clear();
  if (!this->RecordingFileName.empty())
  {
    std::string error;
    channel = this->Internal->Recorder.Start(
      this->RecordingFileName, this->Device, this->Rate, channel, error);
    if (!channel)
    {
      this->Internal->Unclaim();
      this->Fail(error);
      return false;
    }
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
  timing.StallLimit = Nanoseconds(this->StallLimit);
  timing.WatchdogTime = Nanoseconds(this->Safety->GetWatchdogTime());
  timing.MissedShare = this->Safety->GetMissedTickShare();
  timing.RealTimePriority = this->RealTimePriority;
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
    this->Internal->Recorder.WaitForRoom();
    const std::uint64_t before = haptics::MonotonicNow();
    if (!this->Internal->Cycle.Tick(time))
    {
      break;
    }
    this->Internal->Statistics.AddTick(
      Nanoseconds(std::max(0.0, period)), haptics::MonotonicNow() - before);
    this->LastStepTime = time;
    ++this->NextStep;
  }
  this->Update();
  return done;
}

bool vtkHapticServo::IsRunning()
{
  return this->Internal->Cycle.GetState() == haptics::ServoState::Running;
}

bool vtkHapticServo::Update()
{
  this->Internal->Cycle.GetExchange().Collect();
  if (this->Internal->Loop.IsParents())
  {
    this->Internal->Loop.Stop(); // in a child of fork() it does not run
  }
  if (this->Device)
  {
    this->Device->Update();
  }
  // The state is read first, so that the record of an end is there when the state says so.
  const int state = static_cast<int>(this->Internal->Cycle.GetState());
  const bool hasTicked = this->Internal->Cycle.UpdateLatest();
  this->ReportRecording();
  if (state != Running && state != Stepping)
  {
    // A run that has ended by itself still has its thread, and a watchdog that would halt the
    // device although another servo has it.
    this->Internal->Loop.Stop();
    this->Internal->Recorder.Finish();
    this->ReportRecording();
    this->Internal->Unclaim();
  }
  return this->NoticeState(state) || hasTicked;
}

void vtkHapticServo::ReportRecording()
{
  const std::string failure = this->Internal->Recorder.TakeFailure();
  if (!failure.empty())
  {
    this->Fail(failure);
  }
}

bool vtkHapticServo::NoticeState(int state)
{
  if (state == this->State)
  {
    return false;
  }
  this->State = state;
  const std::string explanation = Explain(state);
  if (state == Interrupted) // somebody wanted it: no error
  {
    this->ErrorMessage = explanation;
  }
  else if (!explanation.empty())
  {
    this->Fail(explanation);
  }
  this->InvokeEvent(StateChangedEvent);
  return true;
}

void vtkHapticServo::Fail(const std::string& message)
{
  this->ErrorMessage = message;
  vtkErrorMacro(<< message);
}

//--- readings -------------------------------------------------------------------------------------

std::uint64_t vtkHapticServo::PublishGodObject(std::unique_ptr<haptics::GodObject> godObject)
{
  if (!godObject)
  {
    vtkErrorMacro("The god-object to publish is null; the last one stays.");
    return 0;
  }
  return this->Internal->Cycle.GetExchange().Publish(std::move(godObject));
}

std::size_t vtkHapticServo::DrainRecords(std::vector<haptics::TickRecord>& records)
{
  return this->Internal->Cycle.Drain(records);
}

const haptics::TickRecord& vtkHapticServo::GetLatestRecord() const
{
  return this->Internal->Cycle.GetLatest();
}

haptics::ServoReport vtkHapticServo::GetReport() const
{
  return this->Internal->Statistics.Report();
}

vtkHapticReadings* vtkHapticServo::GetReadings()
{
  const bool isLive = this->State == Running || this->State == Stepping;
  this->Readings->Read(this->GetLatestRecord(), this->GetReport(), isLive,
    static_cast<vtkTypeInt64>(this->Internal->Loop.GetNumberOfHalts()),
    static_cast<vtkTypeInt64>(this->Internal->Cycle.GetNumberOfLostRecords()));
  return this->Readings;
}

const char* vtkHapticServo::GetStateAsString()
{
  static const char* const names[] = { "Stopped", "Running", "Stepping", "DeviceLost",
    "InvalidPosition", "InvalidForce", "Stalled", "Overrun", "Interrupted" };
  return names[this->State];
}

vtkTypeInt64 vtkHapticServo::GetNumberOfRecordedTicks()
{
  return static_cast<vtkTypeInt64>(this->Internal->Recorder.GetNumberOfTicks());
}

vtkTypeInt64 vtkHapticServo::GetNumberOfUnrecordedTicks()
{
  return static_cast<vtkTypeInt64>(this->Internal->Recorder.GetNumberOfLostTicks());
}

vtkTypeInt64 vtkHapticServo::GetNumberOfTicks()
{
  return static_cast<vtkTypeInt64>(this->GetReport().Ticks);
}

void vtkHapticServo::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Device: " << this->Device.Get() << "\n";
  os << indent << "Rate: " << this->Rate << " Hz\n";
  os << indent << "RealTimePriority: " << (this->RealTimePriority ? "on" : "off") << "\n";
  os << indent << "PriorityNote: " << this->PriorityNote << "\n";
  os << indent << "StallLimit: " << this->StallLimit << " s\n";
  os << indent << "Stiffness: " << this->Stiffness << " N/m, in effect "
     << this->GetEffectiveStiffness() << " N/m\n";
  os << indent << "MaximumForce: " << this->MaximumForce << " N, in effect "
     << this->GetEffectiveMaximumForce() << " N\n";
  os << indent << "SubstepLimit: " << this->GetSubstepLimit() << "\n";
  os << indent << "TipRadius: " << this->GetTipRadius() << " m\n";
  os << indent << "Paused: " << (this->Paused ? "yes" : "no") << "\n";
  os << indent << "RecordingFileName: " << this->RecordingFileName << "\n";
  os << indent << "State: " << this->GetStateAsString() << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
  os << indent << "Readings:\n";
  this->GetReadings()->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Safety:\n";
  this->GetSafety()->PrintSelf(os, indent.GetNextIndent());
}
