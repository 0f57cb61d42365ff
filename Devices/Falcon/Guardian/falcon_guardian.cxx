// Takes a Falcon's torque away when the process that drives it has ended or was stopped: see
// haptics::FalconGuardian, which starts it. Standard input has what that process says last: '1',
// the device pushes; '0', it does not; 'q', go.
#include "haptics/Devices/Falcon/FalconPacket.h"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace
{
constexpr int LookEvery = 20; // [ms], while it pushes
constexpr unsigned int Interface = 0;
constexpr unsigned int OutEndpoint = 0x02;

/// Whether a process was stopped, as by SIGSTOP or a debugger.
bool IsStopped(int process)
{
  const std::string name = "/proc/" + std::to_string(process) + "/stat";
  std::array<char, 512> text{};
  std::FILE* file = std::fopen(name.c_str(), "r");
  if (!file)
  {
    return false;
  }
  const std::size_t size = std::fread(text.data(), 1, text.size() - 1, file);
  std::fclose(file);
  // "number (any name) state ...": a name may hold brackets itself.
  const char* end = size > 0 ? std::strrchr(text.data(), ')') : nullptr;
  return end && (end[1] == ' ') && (end[2] == 'T' || end[2] == 't');
}

/// Whether it is still a Falcon: another device may have been plugged in since.
bool IsFalcon(int device)
{
  std::array<unsigned char, 18> descriptor{}; // little-endian, as on the bus
  return read(device, descriptor.data(), descriptor.size()) ==
    static_cast<ssize_t>(descriptor.size()) &&
    descriptor[8] == 0x03 && descriptor[9] == 0x04 && descriptor[10] == 0x48 &&
    descriptor[11] == 0xcb; // 0403:cb48
}

/// Takes the device from whoever has it, a stopped process too.
bool Claim(int device)
{
  usbdevfs_disconnect_claim claim{};
  claim.interface = Interface;
  if (ioctl(device, USBDEVFS_DISCONNECT_CLAIM, &claim) == 0)
  {
    return true;
  }
  unsigned int interface = Interface;
  return ioctl(device, USBDEVFS_CLAIMINTERFACE, &interface) == 0;
}

void TakeTorqueAway(const char* file)
{
  const timespec pause{ 0, 5000000 };
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i, nanosleep(&pause, nullptr))
  {
    const int device = open(file, O_RDWR | O_CLOEXEC);
    if (device >= 0 && IsFalcon(device) && Claim(device))
    {
      haptics::FalconPacket packet = haptics::Encode(haptics::FalconCommand());
      // Three: the first may meet the rest of one that was cut off.
      bool isTaken = false;
      for (int packets = 0; packets < 3; ++packets)
      {
        usbdevfs_bulktransfer transfer{};
        transfer.ep = OutEndpoint;
        transfer.len = static_cast<unsigned int>(packet.size());
        transfer.timeout = 50; // [ms]
        transfer.data = packet.data();
        isTaken = ioctl(device, USBDEVFS_BULK, &transfer) >= 0;
      }
      close(device);
      if (isTaken)
      {
        return;
      }
    }
    else if (device >= 0)
    {
      close(device);
    }
  }
}
}

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: %s DEVICE_FILE PROCESS    started by the driver of the Falcon\n",
      argc > 0 ? argv[0] : "falcon-guardian");
    return 2;
  }
  // It goes when its process does, and not before.
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE })
  {
    std::signal(signal, SIG_IGN);
  }
  const int process = std::atoi(argv[2]);
  bool pushes = false;
  while (true)
  {
    pollfd input{ STDIN_FILENO, POLLIN, 0 };
    const int ready = poll(&input, 1, pushes ? LookEvery : -1);
    bool isOver = getppid() != process;
    if (ready > 0)
    {
      std::array<char, 64> signs{};
      const ssize_t size = read(STDIN_FILENO, signs.data(), signs.size());
      isOver = isOver || size <= 0;
      for (ssize_t i = 0; i < size; ++i)
      {
        if (signs[static_cast<std::size_t>(i)] == 'q')
        {
          return 0;
        }
        pushes = signs[static_cast<std::size_t>(i)] == '1';
      }
    }
    if (pushes && (isOver || (ready == 0 && IsStopped(process))))
    {
      TakeTorqueAway(argv[1]);
      return 0;
    }
    if (isOver)
    {
      return 0;
    }
  }
}
