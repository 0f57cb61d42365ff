#include "vtkFalconHapticDevice.h"

#include "haptics/Devices/DeviceRegistry.h"
#include "haptics/Devices/Falcon/FalconChannel.h"
#include "haptics/Devices/Falcon/FalconGuardian.h"
#include "haptics/Devices/Falcon/FalconTransport.h"
#include "haptics/Devices/Falcon/FalconUsb.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <system_error>

namespace
{
constexpr double SmallestTorqueScale = 100.0;  // [1/(N m)]
constexpr double LargestTorqueScale = 20000.0; // [1/(N m)]

int StateOf(haptics::FalconPhase phase)
{
  switch (phase)
  {
    case haptics::FalconPhase::Opening:
      return vtkHapticDevice::Opening;
    case haptics::FalconPhase::LoadingFirmware:
      return vtkHapticDevice::LoadingFirmware;
    case haptics::FalconPhase::Homing:
      return vtkHapticDevice::Homing;
    case haptics::FalconPhase::Ready:
      return vtkHapticDevice::Ready;
    default:
      return vtkHapticDevice::Faulted;
  }
}

const haptics::DeviceRegistration Registration(
  "falcon", "Novint Falcon", []() -> vtkHapticDevice* { return vtkFalconHapticDevice::New(); });

vtkTypeInt64 Load(const std::atomic<std::uint64_t>& count)
{
  return static_cast<vtkTypeInt64>(count.load(std::memory_order_relaxed));
}
}

vtkStandardNewMacro(vtkFalconHapticDevice);

vtkFalconHapticDevice::vtkFalconHapticDevice()
  : GuardianProgram(haptics::FalconGuardian::Find())
  , Link(std::make_shared<haptics::FalconLink>())
{
  this->MaximumForce = 8.0;
  this->MaximumStiffness = 800.0; // up to 3000 was seen in the best case
  // Nobody has published it. With this one 800 N/m, which the field knows as safe, are just passive
  // at 1 kHz and this latency: K (T / 2 + latency). More would allow what was not tried.
  this->Damping = 2.0;
  this->Latency = 0.002; // up to a millisecond until the next exchange, and as much on the bus
  this->NumberOfButtons = 4;
  const double bounds[6] = { -0.03, 0.03, -0.03, 0.03, 0.095, 0.155 };
  std::copy(bounds, bounds + 6, this->WorkspaceBounds);
}

vtkFalconHapticDevice::~vtkFalconHapticDevice() = default;

bool vtkFalconHapticDevice::Open()
{
  if (this->IsOpen())
  {
    return true;
  }
  if (this->Transport && this->GetState() != Faulted)
  {
    return false;
  }
  this->LetGo();
  this->Ending.reset();
  haptics::FalconSettings settings;
  settings.DeviceIndex = this->DeviceIndex;
  settings.FirmwareFile = this->FirmwareFile;
  settings.OpenOnArrival = this->OpenOnArrival;
  settings.Guardian = this->GuardianProgram;
  try
  {
    this->Transport = std::make_unique<haptics::FalconTransport>(settings);
  }
  catch (const std::system_error& failure)
  {
    const std::string problem =
      std::string("The system gave no thread for the Falcon: ") + failure.what();
    const bool changed = this->ChangeStatusMessage(problem);
    this->Fail(Faulted, problem);
    this->TellStatusMessage(changed);
    return false;
  }
  this->Arrivals = 0;
  this->FirmwareProgress = 0.0;
  const bool changed = this->ChangeStatusMessage("");
  this->SetState(Opening);
  this->TellStatusMessage(changed);
  return false;
}

void vtkFalconHapticDevice::Close()
{
  const bool changed = this->ChangeStatusMessage("");
  this->LetGo();
  this->BecomeClosed();
  this->TellStatusMessage(changed);
}

// Changed before the state and told after it: who hears of either can read both.
bool vtkFalconHapticDevice::ChangeStatusMessage(const std::string& message)
{
  const bool changed = this->StatusMessage != message;
  this->StatusMessage = message;
  return changed;
}

void vtkFalconHapticDevice::TellStatusMessage(bool changed)
{
  if (changed)
  {
    this->InvokeEvent(StatusMessageChangedEvent);
  }
}

void vtkFalconHapticDevice::LetGo()
{
  if (this->Transport)
  {
    this->Transport->RequestStop();
    this->Ending = std::move(this->Transport);
  }
  this->Falcon.reset();
}

void vtkFalconHapticDevice::Update()
{
  if (!this->Transport)
  {
    return;
  }
  this->Follow(this->Transport->GetStatus());
  // Where the channel has no problem of its own the transport is to blame. It tells the cause after
  // its farewell, which can take 50 ms, and may then bring the device up again.
  const std::string problem = this->IsOpen() ? this->Falcon->GetProblem() : "";
  if (!problem.empty())
  {
    const bool changed = this->ChangeStatusMessage(problem);
    this->LetGo();
    this->Fail(Faulted, problem);
    this->TellStatusMessage(changed);
  }
}

void vtkFalconHapticDevice::Follow(const haptics::FalconStatus& status)
{
  if (this->IsOpen() && status.Link != this->Link)
  {
    this->Fail(Faulted, "The Falcon was lost, and is being brought up again.");
  }
  this->Link = status.Link;
  this->RealTime = status.RealTime;
  const bool changed = this->ChangeStatusMessage(status.Text);

  const int state = StateOf(status.Phase);
  if (state == Faulted)
  {
    if (this->GetState() != Faulted || changed)
    {
      this->Fail(Faulted, status.Text);
    }
  }
  else if (state == Ready)
  {
    if (!this->IsOpen())
    {
      this->Link->Leds.store(static_cast<std::uint8_t>(this->Leds), std::memory_order_relaxed);
      this->Falcon =
        std::make_shared<haptics::FalconChannel>(this->Link, this->TorqueScale, this->MaximumForce);
      this->BecomeReady(this->Falcon);
    }
  }
  else
  {
    this->SetState(state);
  }
  this->TellStatusMessage(changed);
  this->TellProgress(status);
}

void vtkFalconHapticDevice::TellProgress(const haptics::FalconStatus& status)
{
  if (this->FirmwareProgress != status.Progress)
  {
    this->FirmwareProgress = status.Progress;
    this->InvokeEvent(vtkCommand::ProgressEvent, &this->FirmwareProgress);
  }
  if (this->Arrivals != status.Arrivals)
  {
    this->Arrivals = status.Arrivals;
    this->InvokeEvent(DeviceArrivedEvent);
  }
}

const char* vtkFalconHapticDevice::GetStatusMessage() const
{
  return this->StatusMessage.c_str();
}

bool vtkFalconHapticDevice::SetDeviceId(const char* id)
{
  const std::string digits = id ? id : "";
  const bool isIndex = digits.size() <= 2 &&
    digits.find_first_not_of("0123456789") == std::string::npos &&
    (digits.empty() || std::stoi(digits) <= 15);
  if (isIndex)
  {
    this->DeviceId = digits;
    this->SetDeviceIndex(digits.empty() ? 0 : std::stoi(digits));
  }
  return isIndex;
}

void vtkFalconHapticDevice::FindDevices(vtkStringArray* ids, vtkStringArray* states)
{
  const std::atomic<bool> stop{ false };
  try
  {
    haptics::FalconUsb usb(stop);
    const int count = static_cast<int>(usb.CountDevices());
    for (int i = 0; i < std::max(count, 1); ++i)
    {
      ids->InsertNextValue(count == 0 ? "" : std::to_string(i));
      try
      {
        usb.Open(i);
        usb.Close();
        states->InsertNextValue("plugged in; it is homed by hand once it is opened.");
      }
      catch (const haptics::FalconFault& fault)
      {
        states->InsertNextValue(fault.what());
      }
    }
  }
  catch (const haptics::FalconFault& fault)
  {
    ids->InsertNextValue("");
    states->InsertNextValue(fault.what());
  }
}

void vtkFalconHapticDevice::SetFirmwareFile(const char* path)
{
  const std::string file = path ? path : "";
  if (this->FirmwareFile != file)
  {
    this->FirmwareFile = file;
    this->Modified();
  }
}

void vtkFalconHapticDevice::SetTorqueScale(double scale)
{
  const double magnitude = std::abs(scale);
  if (!(magnitude >= SmallestTorqueScale && magnitude <= LargestTorqueScale))
  {
    vtkErrorMacro("The torque scale must be " << SmallestTorqueScale << " to " << LargestTorqueScale
                                              << " per N m in magnitude, but is " << scale
                                              << "; it stays " << this->TorqueScale << ".");
    return;
  }
  if (this->TorqueScale != scale)
  {
    this->TorqueScale = scale;
    this->Modified();
  }
}

void vtkFalconHapticDevice::SetLeds(int leds)
{
  leds &= haptics::FalconLedAll;
  if (this->Leds != leds)
  {
    this->Leds = leds;
    this->Link->Leds.store(static_cast<std::uint8_t>(leds), std::memory_order_relaxed);
    this->Modified();
  }
}

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfExchanges() const
{
  return Load(this->Link->Exchanges);
}

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfMissedReplies() const
{
  return Load(this->Link->MissedReplies);
}

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfMalformedPackets() const
{
  return Load(this->Link->MalformedPackets);
}

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfLateCommands() const
{
  return Load(this->Link->LateCommands);
}

double vtkFalconHapticDevice::GetExchangeTime(double share) const
{
  return this->Link->Times.Within(share);
}

void vtkFalconHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "StatusMessage: " << this->StatusMessage << "\n";
  os << indent << "DeviceIndex: " << this->DeviceIndex << "\n";
  os << indent << "FirmwareFile: " << this->FirmwareFile << "\n";
  os << indent << "FirmwareProgress: " << this->FirmwareProgress << "\n";
  os << indent << "GuardianProgram: " << this->GuardianProgram << "\n";
  os << indent << "OpenOnArrival: " << (this->OpenOnArrival ? "on" : "off") << "\n";
  os << indent << "TorqueScale: " << this->TorqueScale << " 1/(N m)\n";
  os << indent << "Leds: " << this->Leds << "\n";
  os << indent << "RealTimePriority: " << (this->RealTime ? "yes" : "no") << "\n";
  os << indent << "ExchangeTime: " << this->GetExchangeTime(0.5) << " s (median), "
     << this->GetExchangeTime(0.99) << " s (99 %)\n";
  os << indent << "NumberOfExchanges: " << this->GetNumberOfExchanges() << "\n";
  os << indent << "NumberOfMissedReplies: " << this->GetNumberOfMissedReplies() << "\n";
  os << indent << "NumberOfMalformedPackets: " << this->GetNumberOfMalformedPackets() << "\n";
  os << indent << "NumberOfLateCommands: " << this->GetNumberOfLateCommands() << "\n";
}
