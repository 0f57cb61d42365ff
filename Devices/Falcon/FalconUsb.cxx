#include "haptics/Devices/Falcon/FalconUsb.h"

#include "haptics/Devices/FormerUser.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <iomanip>
#include <memory>
#include <sstream>
#include <utility>

namespace haptics
{
const char* const FalconUdevRule =
  R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0660", TAG+="uaccess")";

namespace
{
using Clock = std::chrono::steady_clock;

constexpr std::uint16_t Vendor = 0x0403;
constexpr std::uint16_t Product = 0xcb48;
constexpr int Interface = 0;
constexpr std::uint8_t VendorRequestOut = 0x40;
constexpr unsigned int ControlTimeout = 1000; // [ms]
constexpr unsigned int WriteTimeout = 500;    // [ms]
constexpr int StopCheck = 5;                  // [ms]

std::string NameOf(libusb_device* device)
{
  std::ostringstream name;
  name << std::setfill('0') << "bus " << std::setw(3)
       << static_cast<int>(libusb_get_bus_number(device)) << " device " << std::setw(3)
       << static_cast<int>(libusb_get_device_address(device));
  return name.str();
}

std::string ExplainOpening(int error, libusb_device* device)
{
  const std::string name = "The Falcon at " + NameOf(device);
  switch (error)
  {
    case LIBUSB_ERROR_ACCESS:
      return name +
        " may not be opened by this user. Put this line into "
        "/etc/udev/rules.d/60-novint-falcon.rules, run `udevadm control --reload` as root and plug "
        "the device in again:\n  " +
        FalconUdevRule;
    case LIBUSB_ERROR_BUSY:
      return name + " is in use by another program or another device object. Close it there.";
    case LIBUSB_ERROR_NO_DEVICE:
    case LIBUSB_ERROR_NOT_FOUND:
      return name + " was unplugged while it was being opened. Plug it in and open it again.";
    default:
      return name + " could not be opened: " + libusb_strerror(static_cast<int>(error)) +
        ". Unplug it, plug it in again, and open it again.";
  }
}

void LIBUSB_CALL MarkDone(libusb_transfer* transfer)
{
  *static_cast<int*>(transfer->user_data) = 1;
}

int MillisecondsUntil(Clock::time_point end)
{
  return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count());
}

timeval Timeval(long milliseconds)
{
  return { milliseconds / 1000, milliseconds % 1000 * 1000 };
}

struct DeviceListDeleter
{
  void operator()(libusb_device** list) const { libusb_free_device_list(list, 1); }
};
}

FalconUsb::Transfer::Transfer(FalconUsb& usb, std::uint8_t endpoint)
  : Usb(usb)
  , Endpoint(endpoint)
  , Handle(libusb_alloc_transfer(0))
{
  if (!this->Handle)
  {
    throw FalconFault("There is no memory left to talk to the Falcon.");
  }
}

FalconUsb::Transfer::~Transfer()
{
  if (!this->Done)
  {
    libusb_cancel_transfer(this->Handle);
    while (!this->Done)
    {
      timeval wait = Timeval(StopCheck);
      libusb_handle_events_timeout_completed(this->Usb.Context, &wait, &this->Done);
    }
  }
  libusb_free_transfer(this->Handle);
}

void FalconUsb::Transfer::Submit(
  const std::uint8_t* bytes, std::size_t size, unsigned int timeout, const char* doing)
{
  std::copy_n(bytes, size, this->Buffer);
  const bool in = this->Endpoint == InEndpoint;
  libusb_fill_bulk_transfer(this->Handle, this->Usb.Device, this->Endpoint, this->Buffer,
    static_cast<int>(in ? FtdiPacketSize : size), MarkDone, &this->Done, timeout);
  this->SubmitFilled(doing);
}

void FalconUsb::Transfer::SubmitFilled(const char* doing)
{
  this->Done = 0;
  const int error = libusb_submit_transfer(this->Handle);
  if (error != LIBUSB_SUCCESS)
  {
    this->Done = 1;
    FalconUsb::Check(
      error == LIBUSB_ERROR_NO_DEVICE ? LIBUSB_TRANSFER_NO_DEVICE : LIBUSB_TRANSFER_ERROR, doing);
  }
}

int FalconUsb::Transfer::Wait()
{
  while (!this->Done)
  {
    this->Usb.CheckStop(); // whoever destroys this transfer then cancels it
    timeval wait = Timeval(StopCheck);
    libusb_handle_events_timeout_completed(this->Usb.Context, &wait, &this->Done);
  }
  return this->Handle->status;
}

FalconUsb::FalconUsb(const std::atomic<bool>& stop, std::string guardian)
  : Stop(stop)
  , GuardianProgram(std::move(guardian))
{
  const int error = libusb_init(&this->Context);
  if (error != LIBUSB_SUCCESS)
  {
    throw FalconFault("The system gives no access to USB devices: " +
      std::string(libusb_strerror(static_cast<int>(error))) +
      ". Is /dev/bus/usb there, and may this user read it?");
  }
  if (libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG))
  {
    libusb_hotplug_register_callback(this->Context, LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED,
      LIBUSB_HOTPLUG_ENUMERATE, Vendor, Product, LIBUSB_HOTPLUG_MATCH_ANY, OnHotplug, this,
      nullptr);
  }
}

FalconUsb::~FalconUsb()
{
  this->Close();
  libusb_exit(this->Context); // forgets the hotplug callback too
}

int LIBUSB_CALL FalconUsb::OnHotplug(
  libusb_context*, libusb_device*, libusb_hotplug_event, void* self)
{
  ++static_cast<FalconUsb*>(self)->Arrivals;
  return 0;
}

std::vector<libusb_device*> FalconUsb::FindDevices() const
{
  libusb_device** list = nullptr;
  const ssize_t size = libusb_get_device_list(this->Context, &list);
  if (size < 0)
  {
    throw FalconFault("The USB devices cannot be listed: " +
      std::string(libusb_strerror(static_cast<int>(size))) + ".");
  }
  const std::unique_ptr<libusb_device*, DeviceListDeleter> owner(list);
  struct Found
  {
    std::array<std::uint8_t, 8> Place; // bus, then ports
    libusb_device* Device;
  };
  std::vector<Found> found;
  for (ssize_t i = 0; i < size; ++i)
  {
    libusb_device_descriptor descriptor;
    if (libusb_get_device_descriptor(list[i], &descriptor) == LIBUSB_SUCCESS &&
      descriptor.idVendor == Vendor && descriptor.idProduct == Product)
    {
      Found one{ { libusb_get_bus_number(list[i]) }, libusb_ref_device(list[i]) };
      libusb_get_port_numbers(list[i], one.Place.data() + 1, 7);
      found.push_back(one);
    }
  }
  std::sort(
    found.begin(), found.end(), [](const Found& a, const Found& b) { return a.Place < b.Place; });
  std::vector<libusb_device*> devices;
  devices.reserve(found.size());
  for (const Found& one : found)
  {
    devices.push_back(one.Device);
  }
  return devices;
}

std::size_t FalconUsb::CountDevices() const
{
  const std::vector<libusb_device*> devices = this->FindDevices();
  std::for_each(devices.begin(), devices.end(), libusb_unref_device);
  return devices.size();
}

void FalconUsb::Open(int index)
{
  const std::vector<libusb_device*> devices = this->FindDevices();
  std::string problem;
  if (index >= static_cast<int>(devices.size()))
  {
    problem = devices.empty()
      ? "No Novint Falcon is plugged in (none of the USB devices is 0403:cb48). Connect its USB "
        "cable and its power supply, and open it again."
      : "There is no Novint Falcon number " + std::to_string(index) + ": " +
        std::to_string(devices.size()) + " plugged in, counted from 0. Set another DeviceIndex.";
  }
  const auto unref = [](libusb_device* device) { libusb_unref_device(device); };
  const std::unique_ptr<libusb_device, decltype(unref)> device(
    problem.empty() ? libusb_ref_device(devices[static_cast<std::size_t>(index)]) : nullptr, unref);
  std::for_each(devices.begin(), devices.end(), libusb_unref_device);
  if (device)
  {
    int error = LIBUSB_SUCCESS;
    WaitForFormerUser(*this,
      [&]
      {
        error = this->Claim(device.get());
        return error != LIBUSB_ERROR_BUSY;
      });
    if (error != LIBUSB_SUCCESS)
    {
      problem = ExplainOpening(error, device.get());
    }
  }
  if (!problem.empty())
  {
    throw FalconFault(problem);
  }
}

/// LIBUSB_SUCCESS, or why the device could not be had.
int FalconUsb::Claim(libusb_device* device)
{
  int error = libusb_open(device, &this->Device);
  if (error == LIBUSB_SUCCESS)
  {
    // Not supported means that there are no kernel drivers to detach.
    libusb_set_auto_detach_kernel_driver(this->Device, 1);
    error = libusb_claim_interface(this->Device, Interface);
  }
  if (error != LIBUSB_SUCCESS)
  {
    this->Close();
    return error;
  }
  std::array<char, 32> file{};
  std::snprintf(file.data(), file.size(), "/dev/bus/usb/%03d/%03d", libusb_get_bus_number(device),
    libusb_get_device_address(device));
  this->Guardian.Start(this->GuardianProgram, file.data());
  return LIBUSB_SUCCESS;
}

void FalconUsb::Close()
{
  if (this->Device)
  {
    // Fails where the device is gone, which then needs no release.
    libusb_release_interface(this->Device, Interface);
    libusb_close(this->Device);
    this->Device = nullptr;
    this->Guardian.Stop();
  }
}

void FalconUsb::HandleEvents(int duration)
{
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(duration);
  while (!this->MustStop())
  {
    const int rest = MillisecondsUntil(end);
    if (rest <= 0)
    {
      return;
    }
    timeval wait = Timeval(std::min(rest, StopCheck));
    libusb_handle_events_timeout(this->Context, &wait);
  }
}

void FalconUsb::CheckStop() const
{
  if (this->MustStop())
  {
    throw FalconStopped();
  }
}

void FalconUsb::ClearHalt(std::uint8_t endpoint)
{
  const int error = libusb_clear_halt(this->Device, endpoint);
  if (error != LIBUSB_SUCCESS)
  {
    Check(error == LIBUSB_ERROR_NO_DEVICE ? LIBUSB_TRANSFER_NO_DEVICE : LIBUSB_TRANSFER_ERROR,
      "recovering from a stall");
  }
}

void FalconUsb::Control(std::uint8_t request, std::uint16_t value)
{
  Transfer transfer(*this, 0);
  libusb_fill_control_setup(transfer.Buffer, VendorRequestOut, request, value, 0, 0);
  libusb_fill_control_transfer(
    transfer.Handle, this->Device, transfer.Buffer, MarkDone, &transfer.Done, ControlTimeout);
  const std::string doing = "setting up its serial chip (request " + std::to_string(request) +
    ", value " + std::to_string(value) + ")";
  transfer.SubmitFilled(doing.c_str());
  Check(transfer.Wait(), doing.c_str());
}

void FalconUsb::Write(const std::uint8_t* bytes, std::size_t size, const char* doing)
{
  Transfer transfer(*this, OutEndpoint);
  transfer.Submit(bytes, size, WriteTimeout, doing);
  Check(transfer.Wait(), doing);
}

std::vector<std::uint8_t> FalconUsb::Read(std::size_t size, int timeout, const char* doing)
{
  std::vector<std::uint8_t> bytes;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(timeout);
  Transfer transfer(*this, InEndpoint);
  while (bytes.size() < size)
  {
    const int rest = MillisecondsUntil(end);
    if (rest <= 0)
    {
      break;
    }
    transfer.Submit(nullptr, 0, static_cast<unsigned int>(rest), doing);
    const int status = transfer.Wait();
    if (status != LIBUSB_TRANSFER_TIMED_OUT)
    {
      Check(status, doing);
    }
    FtdiPayload payload{};
    if (ReadFtdi(transfer.GetBytes(), transfer.GetSize(), payload))
    {
      bytes.insert(bytes.end(), payload.Bytes, payload.Bytes + payload.Size);
    }
  }
  return bytes;
}

void FalconUsb::Check(int status, const char* doing)
{
  const std::string when = std::string(" while ") + doing + ". ";
  switch (status)
  {
    case LIBUSB_TRANSFER_COMPLETED:
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      throw FalconFault("The Falcon was unplugged" + when + "Plug it in again and open it again.");
    case LIBUSB_TRANSFER_TIMED_OUT:
      throw FalconFault(
        "The Falcon did not answer in time" + when + "Check its power supply, then open it again.");
    case LIBUSB_TRANSFER_STALL:
      throw FalconFault("The Falcon refused a USB transfer (stall)" + when +
        "Unplug it and its power supply, connect both again, and open it again.");
    case LIBUSB_TRANSFER_OVERFLOW:
      throw FalconFault("The Falcon sent more than was asked for (overflow)" + when +
        "Unplug it, plug it in again, and open it again.");
    default:
      throw FalconFault("The USB connection to the Falcon failed (I/O error)" + when +
        "Check the cable, leave out hubs, and open it again.");
  }
}
}
