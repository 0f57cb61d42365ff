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

namespace
{
constexpr double SmallestTorqueScale = 100.0;  // [1/(N m)]
constexpr double LargestTorqueScale = 20000.0; // [1/(N m)]

const haptics::DeviceRegistration Registration(
  "falcon", "Novint Falcon", []() -> vtkHapticDevice* { return vtkFalconHapticDevice::New(); });
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

void vtkFalconHapticDevice::BeginThread()
{
  this->Ending.reset();
  haptics::FalconSettings settings;
  settings.DeviceIndex = this->DeviceIndex;
  settings.FirmwareFile = this->FirmwareFile;
  settings.OpenOnArrival = this->OpenOnArrival;
  settings.Guardian = this->GuardianProgram;
  this->Transport = std::make_unique<haptics::FalconTransport>(settings);
  this->Arrivals = 0;
  this->FirmwareProgress = 0.0;
}

void vtkFalconHapticDevice::EndThread()
{
  if (this->Transport)
  {
    this->Transport->RequestStop();
    this->Ending = std::move(this->Transport);
  }
  this->Falcon.reset();
}

bool vtkFalconHapticDevice::HasThread() const
{
  return this->Transport != nullptr;
}

void vtkFalconHapticDevice::FollowThread()
{
  const haptics::FalconStatus status = this->Transport->GetStatus();
  const bool isNewSession = status.Link != this->Link;
  this->Link = status.Link;
  this->HasRealTimePriority = status.RealTime;
  this->Follow(status.Phase, status.Text, isNewSession);
  this->ReportProgress(status);
}

// Where the channel has no problem of its own the transport is to blame. It reports the cause after
// its farewell, which can take 50 ms, and may then bring the device up again.
std::string vtkFalconHapticDevice::GetProblem() const
{
  return this->Falcon->GetProblem();
}

std::shared_ptr<haptics::MonitoredChannel> vtkFalconHapticDevice::MakeChannel()
{
  this->Link->Leds.store(static_cast<std::uint8_t>(this->Leds), std::memory_order_relaxed);
  this->Falcon =
    std::make_shared<haptics::FalconChannel>(this->Link, this->TorqueScale, this->MaximumForce);
  return this->Falcon;
}

const haptics::LinkCounts& vtkFalconHapticDevice::GetCounts() const
{
  return *this->Link;
}

void vtkFalconHapticDevice::ReportProgress(const haptics::FalconStatus& status)
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

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfMissedReplies() const
{
  return Load(this->Link->MissedReplies);
}

vtkTypeInt64 vtkFalconHapticDevice::GetNumberOfMalformedPackets() const
{
  return Load(this->Link->MalformedPackets);
}

void vtkFalconHapticDevice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceIndex: " << this->DeviceIndex << "\n";
  os << indent << "FirmwareFile: " << this->FirmwareFile << "\n";
  os << indent << "FirmwareProgress: " << this->FirmwareProgress << "\n";
  os << indent << "GuardianProgram: " << this->GuardianProgram << "\n";
  os << indent << "OpenOnArrival: " << (this->OpenOnArrival ? "on" : "off") << "\n";
  os << indent << "TorqueScale: " << this->TorqueScale << " 1/(N m)\n";
  os << indent << "Leds: " << this->Leds << "\n";
  os << indent << "NumberOfMissedReplies: " << this->GetNumberOfMissedReplies() << "\n";
  os << indent << "NumberOfMalformedPackets: " << this->GetNumberOfMalformedPackets() << "\n";
}
