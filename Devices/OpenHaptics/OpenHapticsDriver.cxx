#include "haptics/Devices/OpenHaptics/OpenHapticsDriver.h"

#include "haptics/Devices/Driver/ForceExchange.h"
#include "haptics/Devices/FormerUser.h"
#include "haptics/Devices/MonotonicClock.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

namespace haptics
{
namespace
{
using std::chrono::milliseconds;

constexpr milliseconds LookPeriod{ 5 };
constexpr std::int64_t LongestSilence = 200000000; // [ns]
constexpr milliseconds FarewellTimeout{ 50 };
constexpr std::uint64_t FarewellTicks = 2;     // the one under way may carry a force
constexpr std::uint64_t CalibrationLook = 100; // [ticks]
constexpr double Millimeter = 0.001;           // [m]
constexpr int MostErrors = 8;                  // that are taken from HDAPI's stack at once

std::atomic<bool> IsSchedulerTaken{ false }; // HDAPI has one a process
}

OpenHapticsDriver::OpenHapticsDriver(std::string name, std::string libraryFile, bool resetsEncoders)
  : DeviceName(std::move(name))
  , LibraryFile(std::move(libraryFile))
  , ResetsEncoders(resetsEncoders)
{
}

OpenHapticsDriver::~OpenHapticsDriver() = default;

void OpenHapticsDriver::Open(DriverContext& context)
{
  context.Report(DevicePhase::Opening, "Looking for the device through OpenHaptics.");
  this->Fault = 0;
  this->HasBadPosition = false;
  this->Calibration = 0;
  this->IsParting = false;
  this->Exchange = nullptr;
  if (!this->Hd)
  {
    this->Hd = std::make_unique<HdLibrary>(this->LibraryFile);
  }
  this->Take(context);
  this->ReadLimits(context);
  this->Hd->Enable(HdLibrary::ForceOutput); // which stays zero until Serve()
  this->Scheduled = this->Hd->ScheduleAsynchronous(
    OnTick, this, static_cast<unsigned short>(HdLibrary::DefaultPriority));
  this->IsScheduled = true;
  this->Hd->StartScheduler();
  const HdLibrary::Error error = this->Hd->GetError();
  if (error.Code != 0)
  {
    throw DeviceFault(this->Hd->Explain(error.Code));
  }
  this->LastTick = MonotonicNow();
  this->SeenTicks = this->Ticks;
  while (this->Calibration.load() != HdLibrary::CalibrationIsGood)
  {
    const unsigned int calibration = this->Calibration.load();
    if (calibration == HdLibrary::CalibrationNeedsHand ||
      (calibration == HdLibrary::CalibrationNeedsUpdate &&
        this->CalibrationStyle == HdLibrary::EncoderReset))
    {
      context.Report(DevicePhase::Homing,
        this->CalibrationStyle == HdLibrary::EncoderReset
          ? "Not calibrated: hold the arm in its reset position, all links at right angles, and "
            "open it with ResetEncoders on."
          : "Not calibrated: put the stylus into the inkwell until this goes away.");
    }
    this->Watch(context);
  }
}

void OpenHapticsDriver::Take(DriverContext& context)
{
  if (!WaitForFormerUser(context, [] { return !IsSchedulerTaken.exchange(true); }))
  {
    throw DeviceFault("Another device object of this program has OpenHaptics, which drives one "
                      "device a program. Close that one, then open this.");
  }
  this->HasScheduler = true;
  this->Device =
    this->Hd->InitDevice(this->DeviceName.empty() ? nullptr : this->DeviceName.c_str());
  const HdLibrary::Error error = this->Hd->GetError();
  if (error.Code != 0 || this->Device == HdLibrary::InvalidDevice)
  {
    throw DeviceFault(this->Hd->Explain(error.Code != 0 ? error.Code : 0x0300) +
      (this->DeviceName.empty() ? "" : " It was asked for as '" + this->DeviceName + "'."));
  }
  this->Hd->MakeCurrentDevice(this->Device);
}

void OpenHapticsDriver::ReadLimits(DriverContext& context)
{
  const auto text = [this](unsigned int what)
  {
    const char* const value = this->Hd->GetString(what);
    return std::string(value ? value : "");
  };
  DriverLimits limits;
  limits.Name = text(HdLibrary::ModelType) + " " + text(HdLibrary::SerialNumber);
  double force = 0.0;
  double stiffness = 0.0; // [N/mm]
  std::array<double, 6> box{};
  this->Hd->GetDoublev(HdLibrary::NominalMaximumForce, &force);
  this->Hd->GetDoublev(HdLibrary::NominalMaximumStiffness, &stiffness);
  this->Hd->GetDoublev(HdLibrary::UsableWorkspace, box.data());
  this->Hd->GetIntegerv(HdLibrary::CalibrationStyle, &this->CalibrationStyle);
  while (this->Hd->GetError().Code != 0)
  {
    // Not every model reports all of them.
  }
  const bool hasForce = std::isfinite(force) && force > 0.0;
  const bool hasStiffness = std::isfinite(stiffness) && stiffness > 0.0;
  const bool hasBox = box[3] > box[0] && box[4] > box[1] && box[5] > box[2];
  limits.MaximumForce = hasForce ? force : 3.3; // of a Touch
  limits.MaximumStiffness = hasStiffness ? std::min(500.0, stiffness / Millimeter) : 500.0;
  limits.Workspace = { -0.08, 0.08, -0.06, 0.06, -0.035, 0.035 }; // of a Touch
  if (hasBox)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      limits.Workspace[2 * axis] = box[axis] * Millimeter;
      limits.Workspace[2 * axis + 1] = box[axis + 3] * Millimeter;
    }
  }
  limits.Buttons = 4;
  context.SetLimits(limits);
}

unsigned int OpenHapticsDriver::OnTick(void* self)
{
  static_cast<OpenHapticsDriver*>(self)->Tick();
  return HdLibrary::CallAgain;
}

void OpenHapticsDriver::Tick() noexcept
{
  const std::uint64_t tick = this->Ticks.load(std::memory_order_relaxed);
  const std::int64_t start = MonotonicNow();
  ForceExchange* const exchange = this->Exchange.load(std::memory_order_acquire);
  std::array<double, 3> position{};
  std::array<double, 16> transform{};
  int buttons = 0;

  this->Hd->BeginFrame(this->Device);
  this->Hd->GetDoublev(HdLibrary::CurrentPosition, position.data());
  this->Hd->GetDoublev(HdLibrary::CurrentTransform, transform.data());
  this->Hd->GetIntegerv(HdLibrary::CurrentButtons, &buttons);
  if (!exchange && tick % CalibrationLook == 0)
  {
    this->Calibration.store(this->Hd->CheckCalibration(), std::memory_order_release);
  }
  const bool isFine = std::all_of(position.begin(), position.end(),
    [](double x) { return std::isfinite(x) && std::abs(x) < 10000.0; });
  if (!isFine)
  {
    this->HasBadPosition.store(true, std::memory_order_release);
  }
  const bool mayPush = exchange && isFine && !this->IsParting.load(std::memory_order_acquire) &&
    this->Fault.load(std::memory_order_relaxed) == 0;
  const std::array<double, 3> force = mayPush ? exchange->NextForce() : std::array<double, 3>{};
  this->Hd->SetDoublev(HdLibrary::CurrentForce, force.data());
  this->Hd->EndFrame(this->Device);

  for (int i = 0; i < MostErrors; ++i)
  {
    const unsigned int code = this->Hd->GetError().Code;
    unsigned int none = 0;
    if (code == 0)
    {
      break;
    }
    this->Fault.compare_exchange_strong(none, code);
  }
  if (!exchange && tick % CalibrationLook == 0)
  {
    this->Calibrate();
  }
  if (exchange && isFine)
  {
    DriverSample sample;
    sample.Position = { position[0] * Millimeter, position[1] * Millimeter,
      position[2] * Millimeter };
    sample.Buttons = static_cast<std::uint32_t>(buttons) & 0xFu;
    const auto& m = transform; // rotation m[4 column + row]
    const double w = 0.5 * std::sqrt(std::max(0.0, 1.0 + m[0] + m[5] + m[10]));
    const auto part = [](double square, double sign)
    { return std::copysign(0.5 * std::sqrt(std::max(0.0, square)), sign); };
    const std::array<double, 4> q{ w, part(1.0 + m[0] - m[5] - m[10], m[6] - m[9]),
      part(1.0 - m[0] + m[5] - m[10], m[8] - m[2]), part(1.0 - m[0] - m[5] + m[10], m[1] - m[4]) };
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (length > 0.5 && std::isfinite(length))
    {
      sample.Orientation = { q[0] / length, q[1] / length, q[2] / length, q[3] / length };
    }
    exchange->Publish(sample, static_cast<double>(MonotonicNow() - start) * 1e-9);
  }
  this->Ticks.store(tick + 1, std::memory_order_release);
}

void OpenHapticsDriver::Calibrate() noexcept
{
  if (this->Calibration.load() != HdLibrary::CalibrationNeedsUpdate)
  {
    return;
  }
  // In the inkwell or by itself where it can; a reset of the encoders takes wherever the arm is for
  // its reset position, and is made only when asked for.
  const auto style = static_cast<unsigned int>(this->CalibrationStyle);
  if ((style & (HdLibrary::Inkwell | HdLibrary::Automatic)) != 0)
  {
    this->Hd->UpdateCalibration(
      (style & HdLibrary::Inkwell) != 0 ? HdLibrary::Inkwell : HdLibrary::Automatic);
  }
  else if (this->ResetsEncoders)
  {
    this->Hd->UpdateCalibration(HdLibrary::EncoderReset);
  }
}

void OpenHapticsDriver::ThrowAtError() const
{
  const unsigned int code = this->Fault.load(std::memory_order_acquire);
  if (code != 0)
  {
    throw DeviceFault(this->Hd->Explain(code));
  }
  if (this->HasBadPosition.load(std::memory_order_acquire))
  {
    throw DeviceFault("The device reports a position that cannot be. Calibrate it with the maker's "
                      "program, then open it again.");
  }
}

/// Looks once whether the vendor's thread goes on.
void OpenHapticsDriver::Watch(DriverContext& context)
{
  std::this_thread::sleep_for(LookPeriod);
  context.CheckStop();
  this->ThrowAtError();
  const std::uint64_t ticks = this->Ticks.load(std::memory_order_acquire);
  const std::int64_t now = MonotonicNow();
  if (ticks != this->SeenTicks)
  {
    this->SeenTicks = ticks;
    this->LastTick = now;
  }
  else if (now - this->LastTick > LongestSilence)
  {
    throw DeviceFault("OpenHaptics' scheduler has not called for 0.2 s: its thread hangs, or the "
                      "device was unplugged. Check the cable, then open the device again.");
  }
}

void OpenHapticsDriver::Serve(
  ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready)
{
  this->Exchange.store(&exchange, std::memory_order_release);
  const std::uint64_t first = this->Ticks.load();
  bool isReady = false;
  while (true)
  {
    this->Watch(context);
    if (!isReady && this->Ticks.load(std::memory_order_acquire) > first + 1)
    {
      isReady = true;
      ready();
    }
  }
}

void OpenHapticsDriver::Close() noexcept
{
  this->IsParting.store(true, std::memory_order_release);
  if (this->IsScheduled)
  {
    const std::uint64_t enough = this->Ticks.load() + FarewellTicks;
    const auto end = std::chrono::steady_clock::now() + FarewellTimeout;
    while (this->Ticks.load() < enough && std::chrono::steady_clock::now() < end)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    this->Hd->StopScheduler();
    this->Hd->Unschedule(this->Scheduled);
    this->IsScheduled = false;
  }
  this->Exchange.store(nullptr);
  if (this->Device != HdLibrary::InvalidDevice)
  {
    this->Hd->DisableDevice(this->Device);
    this->Device = HdLibrary::InvalidDevice;
  }
  if (std::exchange(this->HasScheduler, false))
  {
    IsSchedulerTaken.store(false);
  }
}
}
