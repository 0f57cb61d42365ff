#include "haptics/Devices/ForceDimension/ForceDimensionDriver.h"

#include "haptics/Devices/Driver/ForceExchange.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace haptics
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds Period{ 1 };
constexpr std::chrono::milliseconds WaitingPeriod{ 20 };
}

ForceDimensionDriver::ForceDimensionDriver(int index, std::string libraryFile, bool movesArm)
  : Index(index)
  , LibraryFile(std::move(libraryFile))
  , MovesArm(movesArm)
{
}

void ForceDimensionDriver::Check(bool isFine, const char* doing) const
{
  if (!isFine)
  {
    const char* const reason = this->Dhd->GetLastError();
    throw DeviceFault(std::string("Force Dimension's SDK failed ") + doing + " (" +
      (reason && *reason ? reason : "it gives no reason") +
      "). Check the device's cable, power and emergency stop, then open it again.");
  }
}

void ForceDimensionDriver::Check(int result, const char* doing) const
{
  this->Check(result >= 0, doing);
}

void ForceDimensionDriver::Open(DriverContext& context)
{
  context.Report(DevicePhase::Opening, "Looking for the device through Force Dimension's SDK.");
  if (!this->Dhd)
  {
    this->Dhd = std::make_unique<DhdLibrary>(this->LibraryFile);
  }
  const int count = this->Dhd->GetDeviceCount();
  if (this->Index >= count)
  {
    throw DeviceFault(count <= 0
        ? "Force Dimension's SDK finds no device. Connect its USB cable and its power supply; let "
          "the user open USB devices by the vendor's udev rule."
        : "There is no Force Dimension device number " + std::to_string(this->Index) + ": " +
          std::to_string(count) + " plugged in, counted from 0.");
  }
  this->Id = this->Dhd->OpenID(static_cast<char>(this->Index));
  this->Check(
    this->Id, "to open the device, which another program may have, or this user may not open");
  const char id = static_cast<char>(this->Id);

  const char* const name = this->Dhd->GetSystemName(id);
  unsigned short serial = 0;
  this->Dhd->GetSerialNumber(&serial, id);
  DriverLimits limits;
  limits.Name = std::string(name ? name : "Force Dimension device") + " " + std::to_string(serial);
  limits.MaximumForce = 8.0; // of a Falcon, the weakest of those that the SDK drives
  limits.MaximumStiffness = 500.0;
  // What the smallest of them reaches, around the origin that the vendor gives. An assumption.
  limits.Workspace = { -0.05, 0.05, -0.05, 0.05, -0.04, 0.04 };
  limits.Buttons = 8;
  context.SetLimits(limits);

  this->Check(this->Dhd->IsSupported(id), "to say that it supports this device");
  this->Initialize(context);
  // Whatever regulation is left would pull by itself.
  this->Check(this->Dhd->StopRegulation(true, id), "to stop its own regulation");
  this->Check(this->Dhd->SetForce(0.0, 0.0, 0.0, id), "to send zero force");
  this->Check(this->Dhd->EnableForce(1, id), "to enable force");
  this->HasWrist = this->Dhd->HasWrist(id);
}

void ForceDimensionDriver::Initialize(DriverContext& context)
{
  const char id = static_cast<char>(this->Id);
  if (this->Dhd->IsInitialized(id))
  {
    return;
  }
  if (this->MovesArm)
  {
    context.Report(
      DevicePhase::Homing, "The arm moves by itself to find its origin: keep hands away from it.");
    this->Check(this->Dhd->AutoInitialize(id), "to initialise the device");
    return;
  }
  context.Report(DevicePhase::Homing,
    "Not initialised: move the arm through all of its range by hand (a Falcon: pull it out, push "
    "it "
    "in); or keep clear of it and open it with AutoInitialize on, which moves the arm.");
  while (!this->Dhd->IsInitialized(id))
  {
    context.CheckStop();
    this->Check(this->Dhd->SetForce(0.0, 0.0, 0.0, id), "to send zero force"); // a Falcon homes so
    std::this_thread::sleep_for(WaitingPeriod);
  }
}

/// In the device frame, of the vendor's rotation matrix.
std::array<double, 4> ForceDimensionDriver::ReadOrientation() const
{
  double r[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  if (!this->HasWrist || this->Dhd->GetOrientation(r, static_cast<char>(this->Id)) < 0)
  {
    return { 1.0, 0.0, 0.0, 0.0 };
  }
  const auto part = [](double square, double sign)
  { return std::copysign(0.5 * std::sqrt(std::max(0.0, square)), sign); };
  const double w = 0.5 * std::sqrt(std::max(0.0, 1.0 + r[0][0] + r[1][1] + r[2][2]));
  const double x = part(1.0 + r[0][0] - r[1][1] - r[2][2], r[2][1] - r[1][2]);
  const double y = part(1.0 - r[0][0] + r[1][1] - r[2][2], r[0][2] - r[2][0]);
  const double z = part(1.0 - r[0][0] - r[1][1] + r[2][2], r[1][0] - r[0][1]);
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(length > 0.5) || !std::isfinite(length))
  {
    return { 1.0, 0.0, 0.0, 0.0 };
  }
  return { w / length, y / length, z / length, x / length };
}

void ForceDimensionDriver::Serve(
  ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready)
{
  const char id = static_cast<char>(this->Id);
  bool isReady = false;
  Clock::time_point next = Clock::now();
  while (true)
  {
    context.CheckStop();
    const Clock::time_point start = Clock::now();
    const std::array<double, 3> force = exchange.NextForce();
    this->Check(this->Dhd->SetForce(force[2], force[0], force[1], id), "to send a force");
    std::array<double, 3> p{};
    this->Check(this->Dhd->GetPosition(&p[0], &p[1], &p[2], id), "to read the position");
    if (!std::all_of(
          p.begin(), p.end(), [](double x) { return std::isfinite(x) && std::abs(x) < 10.0; }))
    {
      throw DeviceFault("The device reports a position that cannot be. Initialise it with the "
                        "vendor's program, then open it again.");
    }
    DriverSample sample;
    sample.Position = { p[1], p[2], p[0] };
    sample.Buttons = this->Dhd->GetButtonMask(id);
    sample.Orientation = this->ReadOrientation();
    exchange.Publish(sample, std::chrono::duration<double>(Clock::now() - start).count());
    if (!isReady)
    {
      isReady = true;
      ready();
    }
    const Clock::time_point now = Clock::now();
    next = std::max(next + Period, now - Period); // no burst after a delay
    std::this_thread::sleep_until(next);
  }
}

void ForceDimensionDriver::Close() noexcept
{
  if (this->Id >= 0)
  {
    const char id = static_cast<char>(std::exchange(this->Id, -1));
    // Twice where it fails: why the session ended is reported already.
    for (int i = 0; i < 2 && this->Dhd->SetForce(0.0, 0.0, 0.0, id) < 0; ++i)
    {
    }
    this->Dhd->EnableForce(0, id);
    this->Dhd->Close(id);
  }
}
}
