#include "haptics/Devices/Falcon/FalconTransport.h"

#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/Falcon/FalconBoot.h"
#include "haptics/Devices/Falcon/FalconExchange.h"
#include "haptics/Devices/Falcon/FalconUsb.h"
#include "haptics/Devices/RealTimeThread.h"

#include <utility>
#include <vector>

namespace haptics
{
namespace
{
constexpr int UploadTries = 3;
constexpr int HotplugCheck = 20; // [ms]

/// Says farewell to a device that was opened and lets go of it, however its session ends.
class SessionEnd
{
public:
  SessionEnd(FalconUsb& usb, FalconLink& link)
    : Usb(usb)
    , Link(link)
  {
  }
  ~SessionEnd()
  {
    this->Link.Up.store(false, std::memory_order_release);
    this->Usb.SetStoppable(false);
    if (this->Link.Exchanges.load(std::memory_order_relaxed) > 0)
    {
      try
      {
        FalconExchange(this->Usb, this->Link).SayFarewell();
      }
      catch (const FalconFault&)
      {
        // Gone or stuck: why the session ended is reported already, and says as much.
      }
    }
    this->Usb.Close();
    this->Usb.SetStoppable(true);
    this->Link.Over.store(true, std::memory_order_release);
    this->Link.Bell.Ring();
  }
  SessionEnd(const SessionEnd&) = delete;
  SessionEnd& operator=(const SessionEnd&) = delete;

private:
  FalconUsb& Usb;
  FalconLink& Link;
};

std::string HomingText(std::uint8_t homed)
{
  int legs = 0;
  for (int leg = 0; leg < 3; ++leg)
  {
    legs += (homed >> leg) & 1;
  }
  return "Homing, " + std::to_string(legs) +
    " of 3 legs done: pull the grip all the way out, then push it all the way in.";
}
}

FalconTransport::FalconTransport(const FalconSettings& settings)
  : Settings(settings)
{
  this->Thread = std::thread(&FalconTransport::Run, this);
}

FalconTransport::~FalconTransport()
{
  if (!this->Owner.IsHere())
  {
    GiveUp(this->Thread);
    return;
  }
  this->RequestStop();
  this->Thread.join();
}

FalconStatus FalconTransport::GetStatus() const
{
  const std::lock_guard<std::mutex> lock(this->StatusMutex);
  return this->Status;
}

template <typename Change>
void FalconTransport::ChangeStatus(Change change)
{
  const std::lock_guard<std::mutex> lock(this->StatusMutex);
  change(this->Status);
}

void FalconTransport::Report(DevicePhase phase, const std::string& text)
{
  this->ChangeStatus(
    [&](FalconStatus& status)
    {
      status.Phase = phase;
      status.Text = text;
    });
}

void FalconTransport::Run()
{
  LeaveEndingSignalsToOtherThreads();
  try
  {
    this->RunSessions();
  }
  catch (const FalconFault& fault)
  {
    this->Report(DevicePhase::Faulted, fault.what());
  }
  catch (const FalconStopped&)
  {
    // Asked for: there is nothing to report.
  }
}

void FalconTransport::RunSessions()
{
  const bool realTime = RequestDriverPriority();
  this->ChangeStatus([=](FalconStatus& status) { status.RealTime = realTime; });
  FalconUsb usb(this->Stop, this->Settings.Guardian);
  while (true)
  {
    const unsigned int arrivals = usb.GetArrivals();
    try
    {
      this->Session(usb);
    }
    catch (const FalconFault& fault)
    {
      this->Report(DevicePhase::Faulted, fault.what());
    }
    do
    {
      usb.HandleEvents(HotplugCheck);
      usb.CheckStop();
      this->ChangeStatus([&](FalconStatus& status) { status.Arrivals = usb.GetArrivals(); });
    } while (!this->Settings.OpenOnArrival || usb.GetArrivals() == arrivals);
  }
}

void FalconTransport::Session(FalconUsb& usb)
{
  const auto link = std::make_shared<FalconLink>();
  this->ChangeStatus(
    [&](FalconStatus& status)
    {
      status.Phase = DevicePhase::Opening;
      status.Text = "Looking for the Falcon.";
      status.Progress = 0.0;
      status.Arrivals = usb.GetArrivals();
      status.Link = link;
    });
  usb.Open(this->Settings.DeviceIndex);
  const SessionEnd sessionEnd(usb, *link);
  FalconExchange exchange(usb, *link);
  this->BringUp(usb, exchange);
  exchange.Home(
    [this](std::uint8_t homed) { this->Report(DevicePhase::Homing, HomingText(homed)); });
  exchange.Serve(this->Settings.CommandTimeout,
    [this] { this->Report(DevicePhase::Ready, "The Falcon is ready."); });
}

void FalconTransport::BringUp(FalconUsb& usb, FalconExchange& exchange)
{
  this->Report(DevicePhase::Opening, "Setting up the Falcon.");
  FalconBoot::PrepareExchange(usb);
  if (exchange.IsAnswered())
  {
    return;
  }
  if (this->Settings.FirmwareFile.empty())
  {
    throw FalconFault("The Falcon has no firmware loaded. Set FirmwareFile to the image that came "
                      "with the device, then open it again.");
  }
  this->Upload(usb, exchange);
}

void FalconTransport::Upload(FalconUsb& usb, FalconExchange& exchange)
{
  const std::vector<std::uint8_t> firmware =
    FalconBoot::ReadFirmwareFile(this->Settings.FirmwareFile);
  for (int attempt = 1;; ++attempt)
  {
    this->Report(DevicePhase::LoadingFirmware,
      "Loading the Falcon's firmware, attempt " + std::to_string(attempt) + " of " +
        std::to_string(UploadTries) + ".");
    try
    {
      FalconBoot::LoadFirmware(usb, firmware,
        [this](double share)
        { this->ChangeStatus([=](FalconStatus& status) { status.Progress = share; }); });
      if (exchange.IsAnswered())
      {
        return;
      }
      throw FalconBadUpload("The Falcon took the firmware " + this->Settings.FirmwareFile +
        " but does not run it. Is it the image that came with the device?");
    }
    catch (const FalconBadUpload&)
    {
      if (attempt == UploadTries)
      {
        throw;
      }
    }
  }
}
}
