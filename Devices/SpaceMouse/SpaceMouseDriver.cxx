#include "haptics/Devices/SpaceMouse/SpaceMouseDriver.h"

#include "haptics/Devices/Driver/ForceExchange.h"
#include "haptics/Devices/FormerUser.h"
#include "haptics/Devices/SpaceMouse/SpnavLibrary.h"

#include <poll.h>
#include <sys/socket.h>

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
constexpr double FullDeflection = 350.0; // what spacenavd reports, at its sensitivity of 1
constexpr int MostEvents = 64;           // that are read in a tick
constexpr double LongestStep = 0.02;     // [s]: after a delay the hand does not leap

std::atomic<bool> IsConnectionTaken{ false }; // libspnav has one a process

bool HasEnded(int socket)
{
  pollfd watched{ socket, POLLIN, 0 };
  if (poll(&watched, 1, 0) <= 0)
  {
    return false;
  }
  char byte = 0;
  return (watched.revents & (POLLERR | POLLNVAL)) != 0 ||
    recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}
}

std::array<double, 3> SpaceMouseMotion::Velocity(const std::array<int, 3>& deflection) const
{
  std::array<double, 3> velocity{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double share = std::min(1.0, std::abs(deflection[axis]) / FullDeflection);
    const double beyond = std::max(0.0, share - this->DeadZone) / (1.0 - this->DeadZone);
    velocity[axis] = std::copysign(this->Speed * beyond, deflection[axis]);
  }
  velocity[2] = -velocity[2]; // the daemon's z goes away from the user
  return velocity;
}

SpaceMouseDriver::SpaceMouseDriver(const SpaceMouseMotion& motion)
  : Motion(motion)
{
}

/// Waits for a former user only with a context, which says when to stop.
void SpaceMouseDriver::Connect(const DriverContext* context)
{
  const auto take = [] { return !IsConnectionTaken.exchange(true); };
  if (!(context ? WaitForFormerUser(*context, take) : take()))
  {
    throw DeviceFault("Another device object of this program has the SpaceMouse. Close that one, "
                      "then open this.");
  }
  if (SpnavLibrary::Get().Open() < 0)
  {
    IsConnectionTaken.store(false);
    throw DeviceFault("The SpaceMouse's daemon does not run. Install and start spacenavd (Debian: "
                      "apt install spacenavd), or set SPNAV_SOCKET to where it listens.");
  }
  this->IsConnected = true;
}

/// Empty where the daemon is too old to report it. Throws where nothing is plugged in.
std::string SpaceMouseDriver::ReadName() const
{
  if (SpnavLibrary::Get().Protocol() < 1)
  {
    return "";
  }
  std::array<char, 128> name{};
  if (SpnavLibrary::Get().DeviceName(name.data(), static_cast<int>(name.size()) - 1) < 0)
  {
    throw DeviceFault("The SpaceMouse's daemon runs, but no SpaceMouse is plugged in. Connect it, "
                      "then open it again.");
  }
  return name.data();
}

std::string SpaceMouseDriver::Describe()
{
  SpaceMouseDriver driver{ SpaceMouseMotion() };
  try
  {
    driver.Connect();
    const std::string name = driver.ReadName();
    driver.Close();
    return (name.empty() ? "its daemon runs" : name + ", ready") +
      "; it moves the hand and cannot push back.";
  }
  catch (const DeviceFault& fault)
  {
    driver.Close();
    return fault.what();
  }
}

void SpaceMouseDriver::Open(DriverContext& context)
{
  context.Report(DevicePhase::Opening, "Looking for the SpaceMouse's daemon.");
  this->Deflection = {};
  this->Buttons = 0;
  this->Connect(&context);
  const std::string name = this->ReadName();
  DriverLimits limits;
  limits.Name = name.empty() ? "SpaceMouse" : name;
  limits.MaximumForce = 50.0; // of what is shown: ForceLimit alone counts
  limits.MaximumStiffness = 2000.0;
  limits.Workspace = this->Motion.Bounds;
  limits.Buttons = 32;
  context.SetLimits(limits);
}

void SpaceMouseDriver::ReadEvents()
{
  const SpnavLibrary& library = SpnavLibrary::Get();
  spnav_event event;
  for (int i = 0; i < MostEvents; ++i)
  {
    switch (library.PollEvent(&event))
    {
      case SPNAV_EVENT_MOTION:
        this->Deflection = { event.motion.x, event.motion.y, event.motion.z };
        break;
      case SPNAV_EVENT_BUTTON:
        if (event.button.bnum >= 0 && event.button.bnum < 32)
        {
          const std::uint32_t bit = 1u << event.button.bnum;
          this->Buttons = event.button.press ? this->Buttons | bit : this->Buttons & ~bit;
        }
        break;
      case SPNAV_EVENT_DEV:
        if (event.dev.op == SPNAV_DEV_RM)
        {
          throw DeviceFault("The SpaceMouse was unplugged. Connect it, then open it again.");
        }
        break;
      case 0:
        if (HasEnded(library.Socket()))
        {
          throw DeviceFault("The SpaceMouse's daemon has ended. Start spacenavd, then open the "
                            "SpaceMouse again.");
        }
        return;
      default:
        break;
    }
  }
}

void SpaceMouseDriver::Serve(
  ForceExchange& exchange, DriverContext& context, const std::function<void()>& ready)
{
  const auto& bounds = this->Motion.Bounds;
  DriverSample sample; // in front of all that it reaches
  sample.Position = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]), bounds[5] };
  bool isReady = false;
  Clock::time_point last = Clock::now();
  Clock::time_point next = last;
  while (true)
  {
    context.CheckStop();
    this->ReadEvents();
    const Clock::time_point now = Clock::now();
    const double step = std::min(LongestStep, std::chrono::duration<double>(now - last).count());
    last = now;
    const std::array<double, 3> velocity = this->Motion.Velocity(this->Deflection);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sample.Position[axis] = std::clamp(
        sample.Position[axis] + step * velocity[axis], bounds[2 * axis], bounds[2 * axis + 1]);
    }
    sample.Buttons = this->Buttons;
    exchange.NextForce(); // goes nowhere
    exchange.Publish(sample, 0.0);
    if (!isReady)
    {
      isReady = true;
      ready();
    }
    next = std::max(next + Period, now - Period); // no burst after a delay
    std::this_thread::sleep_until(next);
  }
}

void SpaceMouseDriver::Close() noexcept
{
  if (std::exchange(this->IsConnected, false))
  {
    SpnavLibrary::Get().Close();
    IsConnectionTaken.store(false);
  }
}
}
