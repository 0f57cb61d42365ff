#include "vtkHapticServo.h"

#include "DeviceChannel.h"
#include "MonotonicClock.h"
#include "RealTimePriority.h"
#include "ServoCycle.h"
#include "ServoLoop.h"
#include "ServoStatistics.h"

#include "StiffnessLimit.h"
#include "vtkHapticSafety.h"

#include "vtkCommand.h"
#include "vtkHapticDevice.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
constexpr std::size_t RecordsKept = 16384;
constexpr double NanosecondsInSecond = 1e9;

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
      return "The device told a position that is not finite, so the servo stopped with zero force. "
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

class vtkHapticServo::Internals
{
public:
  haptics::ServoCycle Cycle{ RecordsKept };
  haptics::ServoStatistics Statistics;
  haptics::ServoLoop Loop{ this->Cycle, this->Statistics }; // last: ends before the others
  haptics::ServoSettings Settings;
};

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

double vtkHapticServo::GetEffectiveStiffness()
{
  const haptics::SafetySettings& safety = this->Internal->Settings.Safety;
  haptics::StiffnessLimit regular;
  regular.Restart(safety.NominalPeriod);
  const double most = this->Device ? this->Device->GetMaximumStiffness() : this->Stiffness;
  return std::min({ this->Stiffness, most, regular.Allowed(safety) });
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
    this->PlaceGodObject();
    this->Modified();
  }
  return true;
}

void vtkHapticServo::GetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  this->Internal->Settings.DeviceToWorld.GetMatrix(deviceToWorld->GetData());
  deviceToWorld->Modified();
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
  this->Internal->Settings.Force.MaximumForce = this->GetEffectiveMaximumForce();
  this->Internal->Cycle.Configure(this->Internal->Settings);
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
  this->Internal->Cycle.Begin(this->Device->GetChannel(), static_cast<haptics::ServoState>(state));
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
  if (this->Internal->Cycle.GetState() != haptics::ServoState::Stepping)
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

bool vtkHapticServo::IsRunning()
{
  return this->Internal->Cycle.GetState() == haptics::ServoState::Running;
}

bool vtkHapticServo::Update()
{
  this->Internal->Cycle.GetExchange().Collect();
  if (this->Device)
  {
    this->Device->Update();
  }
  // The state is read first, so that the record of an end is there when the state tells of it.
  const int state = static_cast<int>(this->Internal->Cycle.GetState());
  const bool hasTicked = this->Internal->Cycle.UpdateLatest();
  return this->NoticeState(state) || hasTicked;
}

bool vtkHapticServo::NoticeState(int state)
{
  if (state == this->State)
  {
    return false;
  }
  this->State = state;
  const std::string explanation = Explain(state);
  if (!explanation.empty())
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

vtkTypeInt64 vtkHapticServo::GetNumberOfHalts()
{
  return static_cast<vtkTypeInt64>(this->Internal->Loop.GetNumberOfHalts());
}

vtkTypeInt64 vtkHapticServo::GetNumberOfLostRecords()
{
  return static_cast<vtkTypeInt64>(this->Internal->Cycle.GetNumberOfLostRecords());
}

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
