#include "haptics/Devices/Haply/HaplyDriver.h"

#include "haptics/Devices/Driver/ForceExchange.h"
#include "haptics/Devices/FormerUser.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace haptics
{
namespace
{
using std::chrono::milliseconds;
using Clock = HaplySocket::Clock;

constexpr milliseconds Period{ 1 };
constexpr milliseconds WaitingPeriod{ 20 }; // while it is not calibrated
constexpr milliseconds HelloTimeout{ 500 };
constexpr milliseconds StateTimeout{ 20 }; // later states are late
constexpr milliseconds LongestSilence{ 200 };
constexpr milliseconds LostTime{ 30 }; // a state that is later than that is taken for lost
constexpr milliseconds DoubtTime{ LongestSilence }; // so long it may come all the same
constexpr milliseconds DropTimeout{ 1 };
constexpr milliseconds FarewellTimeout{ 50 };
constexpr int MostDamaged = 5;
constexpr const char* Profile = "vtk-haptics";

/// What the device waits for, or empty where it is ready.
std::string Missing(const HaplyDevice& device)
{
  if (!device.IsPowered)
  {
    return "has no power: connect its power supply; the USB cable alone drives no motor.";
  }
  if (!device.IsStarted)
  {
    return "is being started by the service.";
  }
  if (!device.IsCalibrated)
  {
    return "is not calibrated: calibrate it as its manual says, or in Haply Hub. It goes on by "
           "itself then.";
  }
  return "";
}
}

HaplyDriver::HaplyDriver(std::string id, int port)
  : WantedId(std::move(id))
  , Socket(port)
{
}

std::vector<std::pair<std::string, std::string>> HaplyDriver::List(int port)
{
  HaplyDriver driver("", port);
  driver.ReadVersion();
  driver.Socket.Connect();
  driver.SayHello();
  std::vector<std::pair<std::string, std::string>> devices;
  for (const HaplyDevice& device : driver.State.Devices)
  {
    const std::string missing = Missing(device);
    devices.emplace_back(device.Id,
      !missing.empty()   ? "Inverse3 " + missing
        : device.IsInUse ? "Inverse3, in use by another program."
                         : "Inverse3, ready.");
  }
  driver.Socket.Close();
  return devices;
}

void HaplyDriver::ReadVersion()
{
  const std::string answer = this->Socket.Get("/version");
  if (!HaplyMessage::ReadVersion(answer, this->Version))
  {
    throw DeviceFault("The Haply Inverse Service does not say its version, so that it is not known "
                      "how it names a force. Update it to 3.1 or later.");
  }
  const HaplyVersion& version = this->Version;
  if (version.Major < 3 || (version.Major == 3 && version.Minor < 1))
  {
    throw DeviceFault("The Haply Inverse Service is version " + std::to_string(version.Major) +
      "." + std::to_string(version.Minor) + ", which is too old. Update it to 3.1 or later.");
  }
  if (version.Major > 3)
  {
    throw DeviceFault("The Haply Inverse Service is version " + std::to_string(version.Major) +
      "." + std::to_string(version.Minor) +
      ", which this driver does not know. Update VTK Haptics, or install the service 3.5.");
  }
}

/// The first message of all comes without being asked for.
void HaplyDriver::SayHello()
{
  this->State = HaplyState();
  this->Unanswered = 0;
  this->Damaged = 0;
  this->HasSentForce = false;
  std::string_view text;
  if (!this->Socket.Receive(text, Clock::now() + HelloTimeout))
  {
    throw DeviceFault("The Haply Inverse Service took the connection but reports nothing. Start it "
                      "anew: systemctl restart haply-inverse-service");
  }
  if (!HaplyMessage::Read(text, this->State))
  {
    throw DeviceFault("The Haply Inverse Service's first message is no inventory of devices. Is it "
                      "another program's port, or an unknown version?");
  }
}

const HaplyDevice& HaplyDriver::FindWanted() const
{
  const HaplyDevice* device = this->State.Find(this->WantedId);
  if (!device)
  {
    std::string others;
    for (const HaplyDevice& other : this->State.Devices)
    {
      others += (others.empty() ? "" : ", ") + other.Id;
    }
    throw DeviceFault(others.empty()
        ? "The Haply Inverse Service runs but finds no Inverse3. Connect its USB cable and its "
          "power supply, and open it again."
        : "The Haply Inverse Service finds no Inverse3 '" + this->WantedId + "', but: " + others +
          ".");
  }
  return *device;
}

void HaplyDriver::Choose(DriverContext& context)
{
  const auto isFree = [this]
  {
    this->Socket.Close();
    this->Socket.Connect();
    this->SayHello();
    return !this->FindWanted().IsInUse;
  };
  const bool isTaken = this->FindWanted().IsInUse && !WaitForFormerUser(context, isFree);
  const HaplyDevice& device = this->FindWanted();
  if (isTaken)
  {
    throw DeviceFault("The Inverse3 " + device.Id +
      " is in use by another program. End that program's session, and open it again.");
  }
  if (!HaplyMessage::IsPermutation(device.Permutation))
  {
    throw DeviceFault("The Inverse3 " + device.Id + " reports positions along the axes '" +
      device.Permutation +
      "', which are none or mirror. Set its basis to XYZ in the service's settings.");
  }
  this->Id = device.Id;
  this->Permutation = device.Permutation;
}

void HaplyDriver::Open(DriverContext& context)
{
  context.Report(DevicePhase::Opening, "Looking for the Haply Inverse Service.");
  this->ReadVersion();
  context.CheckStop();
  this->Socket.Connect();
  this->SayHello();
  this->Choose(context);

  DriverLimits limits;
  limits.Name = "Inverse3 " + this->Id;
  limits.MaximumForce = 10.0; // for a short while, as its maker says
  limits.MaximumStiffness = 500.0;
  // Of about 0.3 m that it reaches in each direction, in the service's own axes: x -0.08 to 0.08,
  // y -0.20 to -0.04, z 0.08 to 0.24. An assumption: the service does not report it.
  limits.Workspace = { -0.08, 0.08, 0.08, 0.24, 0.04, 0.20 };
  limits.Buttons = 3;
  context.SetLimits(limits);

  HaplyMessage::WriteForce(
    this->Id, {}, this->Permutation, this->Version.HasVectors(), Profile, this->Message);
  this->Socket.Send(this->Message);
  ++this->Unanswered;
  this->HasSentForce = true;
  this->CatchUp(context);
  this->WaitUntilCalibrated(context);
}

void HaplyDriver::WaitUntilCalibrated(DriverContext& context)
{
  for (std::string missing; !(missing = Missing(this->Find())).empty();)
  {
    context.Report(this->Find().IsPowered ? DevicePhase::Homing : DevicePhase::Opening,
      "The Inverse3 " + this->Id + " " + missing);
    std::this_thread::sleep_for(WaitingPeriod);
    context.CheckStop();
    if (!this->TryOnce({}, Clock::now() + StateTimeout))
    {
      this->CatchUp(context);
    }
  }
}

const HaplyDevice& HaplyDriver::Find() const
{
  const HaplyDevice* device = this->State.Find(this->Id);
  if (!device)
  {
    throw DeviceFault("The Inverse3 " + this->Id +
      " is gone: it was unplugged. Plug it in again and open it again.");
  }
  return *device;
}

/// Drops states that CatchUp() did not wait for: else each one later would answer the message
/// before.
void HaplyDriver::DropLateStates()
{
  std::string_view text;
  while (Clock::now() < this->DoubtUntil && this->Socket.Receive(text, Clock::now() + DropTimeout))
  {
  }
}

/// Sends a force and waits for the state that answers it. False where none came in time, or what
/// came is none.
bool HaplyDriver::TryOnce(const std::array<double, 3>& force, Clock::time_point deadline)
{
  this->DropLateStates();
  HaplyMessage::WriteForce(
    this->Id, force, this->Permutation, this->Version.HasVectors(), nullptr, this->Message);
  this->Socket.Send(this->Message);
  ++this->Unanswered;
  std::string_view text;
  if (!this->Socket.Receive(text, deadline))
  {
    return false;
  }
  --this->Unanswered;
  if (!HaplyMessage::Read(text, this->State))
  {
    if (++this->Damaged == MostDamaged)
    {
      throw DeviceFault("The Haply Inverse Service sent " + std::to_string(MostDamaged) +
        " messages in a row that are no states. Start it anew and open the device again.");
    }
    return false;
  }
  this->Damaged = 0;
  return true;
}

/// Has the device without force, and waits until every message is answered or lost.
void HaplyDriver::CatchUp(DriverContext& context)
{
  const Clock::time_point end = Clock::now() + LongestSilence;
  if (this->Unanswered > 0)
  {
    // The force that was sent last may hold until then.
    HaplyMessage::WriteForce(
      this->Id, {}, this->Permutation, this->Version.HasVectors(), nullptr, this->Message);
    this->Socket.Send(this->Message);
    ++this->Unanswered;
  }
  bool hasState = this->Unanswered == 0;
  std::string_view text;
  while (this->Unanswered > 0)
  {
    context.CheckStop();
    const Clock::time_point now = Clock::now();
    if (now >= end && !hasState)
    {
      throw DeviceFault("The Haply Inverse Service has not answered for 0.2 s. Start it anew: "
                        "systemctl restart haply-inverse-service; then open the device again.");
    }
    if (this->Socket.Receive(text, std::min(end, now + LostTime)))
    {
      --this->Unanswered;
      hasState = HaplyMessage::Read(text, this->State) || hasState;
    }
    else if (hasState)
    {
      this->Unanswered = 0; // the rest is lost
      this->DoubtUntil = Clock::now() + DoubtTime;
    }
  }
}

void HaplyDriver::Check() const
{
  const HaplyDevice& device = this->Find();
  const std::string missing = Missing(device);
  if (!missing.empty())
  {
    throw DeviceFault("The Inverse3 " + this->Id + " " + missing);
  }
  if (!device.HasPosition ||
    !std::all_of(device.Position.begin(), device.Position.end(),
      [](double x) { return std::isfinite(x) && std::abs(x) < 10.0; }))
  {
    throw DeviceFault("The Haply Inverse Service reports no position of the Inverse3 " + this->Id +
      ", or one that cannot be. Calibrate the device, start the service anew and open it again.");
  }
}

void HaplyDriver::Serve(
  ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready)
{
  bool isReady = false;
  Clock::time_point next = Clock::now();
  while (true)
  {
    context.CheckStop();
    const Clock::time_point start = Clock::now();
    if (this->TryOnce(exchange.NextForce(), start + StateTimeout))
    {
      this->Check();
      DriverSample sample;
      sample.Position = HaplyMessage::ToDevice(this->Find().Position, this->Permutation);
      sample.Buttons = this->State.HasGrip ? this->State.Buttons : 0;
      if (this->State.HasGrip)
      {
        const auto& q = this->State.Orientation;
        const auto axis = HaplyMessage::ToDevice({ q[1], q[2], q[3] }, this->Permutation);
        sample.Orientation = { q[0], axis[0], axis[1], axis[2] };
      }
      exchange.Publish(sample, std::chrono::duration<double>(Clock::now() - start).count());
      if (!isReady)
      {
        isReady = true;
        ready();
      }
    }
    else
    {
      exchange.LetGo();
      this->CatchUp(context);
    }
    const Clock::time_point now = Clock::now();
    next = std::max(next + Period, now - Period); // no burst after a delay
    std::this_thread::sleep_until(next);
  }
}

void HaplyDriver::Close() noexcept
{
  if (!this->Socket.IsConnected())
  {
    return;
  }
  try
  {
    if (this->HasSentForce)
    {
      HaplyMessage::WriteForce(
        this->Id, {}, this->Permutation, this->Version.HasVectors(), nullptr, this->Message);
      this->Socket.Send(this->Message);
      ++this->Unanswered;
      const Clock::time_point end = Clock::now() + FarewellTimeout;
      std::string_view text;
      while (this->Unanswered > 0 && this->Socket.Receive(text, end))
      {
        --this->Unanswered;
      }
    }
  }
  catch (const DeviceFault&)
  {
    // Gone or stuck: why the session ended is reported already, and says as much.
  }
  this->HasSentForce = false;
  this->Socket.Close();
}
}
