// The Falcon's driver against a real kernel: runs as root where vhci-hcd is loaded, in usb-vm.sh's
// virtual machine. Never asserts time: the machine is emulated.

#include "VhciBus.h"
#include "haptics/Devices/Falcon/FalconTransport.h"

#include <cstdio>
#include <fstream>

namespace
{
int Failures = 0;

void Check(bool condition, const char* what, const std::string& detail = "")
{
  std::printf("%s: %s %s\n", condition ? "ok" : "FAILED", what, condition ? "" : detail.c_str());
  std::fflush(stdout);
  Failures += condition ? 0 : 1;
}

template <typename Condition>
bool WaitFor(Condition condition)
{
  const auto end = FalconModel::Clock::now() + std::chrono::seconds(20);
  while (!condition())
  {
    if (FalconModel::Clock::now() > end)
    {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

bool Reaches(haptics::FalconTransport& transport, haptics::DevicePhase phase)
{
  return WaitFor([&] { return transport.GetStatus().Phase == phase; });
}

/// The kernel takes its time to find what was plugged in.
void Bring(haptics::FalconTransport& transport, const char* what)
{
  Check(Reaches(transport, haptics::DevicePhase::Ready), what, transport.GetStatus().Text);
}

bool Pushes(VhciBus& bus)
{
  return bus.With([](FalconModel& model) { return model.Commands.back().Torques[2] != 0; });
}
}

int main()
{
  const char* const file = "/tmp/firmware.bin";
  const std::vector<std::uint8_t> firmware(1000, 0x5a);
  std::ofstream(file, std::ios::binary)
    .write(reinterpret_cast<const char*>(firmware.data()),
      static_cast<std::streamsize>(firmware.size()));
  FalconModel model;
  model.Loaded = false;
  model.Image = firmware;
  haptics::FalconSettings settings;
  settings.FirmwareFile = file;
  settings.CommandTimeout = 10.0;

  VhciBus bus;
  bus.Plug(model);
  Check(
    WaitFor([] { return std::ifstream("/dev/bus/usb/001/002").good(); }), "the kernel finds it");
  {
    haptics::FalconTransport transport(settings);
    Bring(transport, "comes up, with its firmware loaded and homed");
    bus.With([&](FalconModel& m) { Check(m.Firmware == firmware, "got the firmware unchanged"); });
    const auto link = transport.GetStatus().Link;
    const std::uint64_t before = link->Exchanges;
    Check(WaitFor([&] { return link->Exchanges > before + 100; }), "exchanges packets");
    link->Demands.Publish({ { 0.0, 0.0, 1000.0 }, 0 });
    Check(WaitFor([&] { return Pushes(bus); }), "gets a torque");
  }
  Check(!Pushes(bus), "gets zero torque when it is let go");
  {
    haptics::FalconTransport transport(settings);
    Bring(transport, "comes up again, without an upload");
    bus.With([](FalconModel& m) { Check(m.Uploads == 1, "was loaded once"); });
    bus.Unplug();
    Check(Reaches(transport, haptics::DevicePhase::Faulted), "is missed when it is pulled out");
    const std::string text = transport.GetStatus().Text;
    Check(text.find("unplugged") != std::string::npos, "and the user reads so", text);
    Check(!transport.GetStatus().Link->Up, "and the servo too");
  }
  model.Loaded = true;
  model.Script = { { At::Serve, 20, Do::Stall } };
  bus.Plug(model);
  Check(WaitFor([] { return std::ifstream("/dev/bus/usb/001/003").good(); }), "is found again");
  {
    haptics::FalconTransport transport(settings);
    Check(Reaches(transport, haptics::DevicePhase::Faulted), "stalls");
    const std::string text = transport.GetStatus().Text;
    Check(text.find("stall") != std::string::npos, "and the user reads so", text);
  }
  Check(!Pushes(bus), "and gets zero torque");
  std::printf(Failures == 0 ? "VM-RESULT: passed\n" : "VM-RESULT: failed\n");
  return Failures;
}
