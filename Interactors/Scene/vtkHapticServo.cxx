#include "vtkHapticServo.h"

#include "haptics/Scene/HapticServoInternals.h"

#include "haptics/Servo/StiffnessLimit.h"
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
    vtkErrorMacro("The rate is no number; it stays " << this->Rate << " Hz.");
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
    vtkErrorMacro("The stall limit is no number; it stays " << this->StallLimit << " s.");
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
  // The state is read first, so that the record of an end is there when the state tells of it.
  const int state = static_cast<int>(this->Internal->Cycle.GetState());
  const bool hasTicked = this->Internal->Cycle.UpdateLatest();
  this->NoticeRecording();
  if (state != Running && state != Stepping)
  {
    // A run that has ended by itself still has its thread, and a watchdog that would halt the
    // device although another servo has it.
    this->Internal->Loop.Stop();
    this->FinishRecording();
    this->Internal->Unclaim();
  }
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
