#include "UsbFs.h"

#include <linux/usbdevice_fs.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace
{
std::atomic<UsbFs*> TheBus{ nullptr };

// An FT232BM with the Falcon's numbers: one interface, bulk endpoints 0x81 and 0x02.
const char* const Descriptors = "12010002000000400304" // device, vendor 0403
                                "48CB000601020301"     // product cb48
                                "09022000010100A02D"   // configuration
                                "0904000002FFFFFF02"   // interface 0
                                "07058102400000"       // endpoint 0x81
                                "07050202400000";      // endpoint 0x02

int RealIoctl(int fd, unsigned long request, void* argument)
{
  static const auto real =
    reinterpret_cast<int (*)(int, unsigned long, ...)>(dlsym(RTLD_NEXT, "ioctl"));
  return real(fd, request, argument);
}

ssize_t RealSendmsg(int socket, const msghdr* message, int flags)
{
  static const auto real =
    reinterpret_cast<ssize_t (*)(int, const msghdr*, int)>(dlsym(RTLD_NEXT, "sendmsg"));
  return real(socket, message, flags);
}

/// The device number of an open file. Asked of the kernel itself, since umockdev 0.19 answers
/// fstat() with what it plays.
bool FindNode(int fd, dev_t& node)
{
  struct statx status = {};
  if (syscall(SYS_statx, fd, "", AT_EMPTY_PATH, STATX_BASIC_STATS, &status) != 0)
  {
    return false;
  }
  node = makedev(status.stx_rdev_major, status.stx_rdev_minor);
  return true;
}

void Require(bool condition, const char* what)
{
  if (!condition)
  {
    throw std::runtime_error(std::string("The test's USB bus: ") + what + ": " + strerror(errno));
  }
}
}

UsbFs::UsbFs()
  : Bed(umockdev_testbed_new())
{
  signal(SIGHUP, SIG_IGN); // a session leader gets it when a pty that libusb opened is closed
  this->Timer = std::thread(&UsbFs::RunTimer, this);
  TheBus = this;
}

UsbFs::~UsbFs()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Quit = true;
    this->Wake.notify_all();
  }
  this->Timer.join();
  std::vector<int> plugged;
  for (const Device& device : this->Devices)
  {
    if (!device.Gone)
    {
      plugged.push_back(device.Port);
    }
  }
  for (const int port : plugged)
  {
    this->Unplug(port);
  }
  TheBus = nullptr;
  g_object_unref(this->Bed);
}

bool UsbFs::IsPossible()
{
  int master = -1;
  int slave = -1;
  if (openpty(&master, &slave, nullptr, nullptr, nullptr) != 0)
  {
    return false;
  }
  close(master);
  close(slave);
  return true;
}

UsbFs::Device& UsbFs::Find(int port)
{
  const auto found = std::find_if(this->Devices.begin(), this->Devices.end(),
    [port](const Device& device) { return device.Port == port; });
  if (found == this->Devices.end())
  {
    throw std::logic_error("nothing was ever plugged into port " + std::to_string(port));
  }
  return *found;
}

std::string UsbFs::PathOf(const Device& device) const
{
  return "/devices/usb1/1-" + std::to_string(device.Port);
}

void UsbFs::Plug(int port, const FalconModel& model)
{
  Device device;
  device.Port = port;
  device.Model = model;
  char terminal[128] = {};
  Require(openpty(&device.Master, &device.Slave, terminal, nullptr, nullptr) == 0, "openpty");
  termios settings;
  tcgetattr(device.Slave, &settings);
  cfmakeraw(&settings);
  tcsetattr(device.Slave, TCSANOW, &settings);
  Require(FindNode(device.Slave, device.Node), "statx");

  std::string node;
  std::string description;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    device.Number = ++this->Numbers;
    char number[16];
    snprintf(number, sizeof number, "%03d", device.Number);
    node = std::string("bus/usb/001/") + number;
    description = "P: " + this->PathOf(device) + "\nN: " + node +
      "\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=" + number +
      "\nE: DEVNAME=/dev/" + node +
      "\nE: DEVTYPE=usb_device\nA: busnum=1\\n\nA: devnum=" + std::to_string(device.Number) +
      "\\n\nA: bConfigurationValue=1\\n\nA: speed=12\\n\n" + "H: descriptors=" + Descriptors + "\n";
    this->Devices.push_front(std::move(device));
    this->Gate(this->Devices.front());
  }
  // It is announced before its node is the pty.
  const std::lock_guard<std::mutex> plugging(this->Plugging);
  Require(umockdev_testbed_add_from_string(this->Bed, description.c_str(), nullptr), "plugging in");
  char* root = umockdev_testbed_get_root_dir(this->Bed);
  const std::string link = std::string(root) + "/dev/" + node;
  g_free(root);
  unlink(link.c_str());
  Require(symlink(terminal, link.c_str()) == 0, "symlink");
}

void UsbFs::Unplug(int port)
{
  std::string path;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    Device& device = this->Find(port);
    if (device.Gone)
    {
      return;
    }
    device.Gone = true;
    device.Waiting.splice(device.Waiting.end(), device.Stuck);
    for (const Pending& pending : device.Waiting)
    {
      this->Finish(device, pending.Urb, -ESHUTDOWN, 0);
    }
    device.Waiting.clear();
    this->Gate(device);
    close(device.Master); // whoever polls the other end sees an error, as on usbfs
    device.Master = -1;
    path = "/sys" + this->PathOf(device);
  }
  umockdev_testbed_uevent(this->Bed, path.c_str(), "remove");
  umockdev_testbed_remove_device(this->Bed, path.c_str());
  const std::lock_guard<std::mutex> lock(this->Mutex);
  Device& device = this->Find(port);
  close(device.Slave);
  device.Slave = -1;
}

bool UsbFs::IsClaimed(int port)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Find(port).Claimed;
}

void UsbFs::DenyOpening(bool deny)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->OpeningDenied = deny;
}

void UsbFs::ClaimByOther(bool claimed)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->ClaimedByOther = claimed;
}

bool UsbFs::DeniesOpening()
{
  const std::lock_guard<std::mutex> plugging(this->Plugging);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->OpeningDenied;
}

bool UsbFs::IsDriverDetached()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Detached;
}

bool UsbFs::OnIoctl(int fd, unsigned long request, void* argument, int& result)
{
  dev_t node = 0;
  if (!FindNode(fd, node))
  {
    return false;
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = std::find_if(this->Devices.begin(), this->Devices.end(),
    [&](const Device& device) { return device.Node == node; });
  if (found == this->Devices.end())
  {
    return false;
  }
  result = this->Answer(*found, request, argument);
  return true;
}

int UsbFs::Answer(Device& device, unsigned long request, void* argument)
{
  const bool reaps = request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY;
  if (device.Gone && !reaps && request != USBDEVFS_RELEASEINTERFACE)
  {
    return -ENODEV;
  }
  switch (request)
  {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) = USBDEVFS_CAP_ZERO_PACKET |
        USBDEVFS_CAP_BULK_CONTINUATION | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
        USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      return 0;
    case USBDEVFS_GETDRIVER:
      std::strcpy(static_cast<usbdevfs_getdriver*>(argument)->driver, "ftdi_sio");
      return this->Detached ? -ENODATA : 0;
    case USBDEVFS_IOCTL: // detaches, or attaches, the kernel's driver
      this->Detached =
        static_cast<usbdevfs_ioctl*>(argument)->ioctl_code == static_cast<int>(USBDEVFS_DISCONNECT);
      return 0;
    case USBDEVFS_DISCONNECT_CLAIM:
      this->Detached = true;
      [[fallthrough]];
    case USBDEVFS_CLAIMINTERFACE:
      if (this->ClaimedByOther || device.Claimed)
      {
        return -EBUSY;
      }
      device.Claimed = true;
      return 0;
    case USBDEVFS_RELEASEINTERFACE:
      device.Claimed = false;
      return 0;
    case USBDEVFS_CLEAR_HALT:
      device.Model.ClearHalt();
      return 0;
    case USBDEVFS_SUBMITURB:
      return this->Submit(device, static_cast<usbdevfs_urb*>(argument));
    case USBDEVFS_DISCARDURB:
      return this->Discard(device, argument);
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      return this->Reap(device, argument);
    default:
      fprintf(stderr, "The test's USB bus does not know ioctl %#lx.\n", request);
      return -ENOTTY;
  }
}

int UsbFs::Submit(Device& device, usbdevfs_urb* urb)
{
  const auto* bytes = static_cast<const std::uint8_t*>(urb->buffer);
  if (urb->type == USBDEVFS_URB_TYPE_CONTROL)
  {
    const int status = device.Model.Control(bytes[1], bytes[2] | bytes[3] << 8);
    this->Finish(device, urb, status, 0);
  }
  else if ((urb->endpoint & 0x80) == 0 && device.Model.IsJammed())
  {
    device.Stuck.push_back({ urb, FalconModel::Clock::now() });
  }
  else if ((urb->endpoint & 0x80) == 0)
  {
    const int size = urb->buffer_length;
    const int status = device.Model.Write(bytes, static_cast<std::size_t>(size));
    this->Finish(device, urb, status, status == 0 ? size : 0);
  }
  else
  {
    device.Waiting.push_back({ urb, FalconModel::Clock::now() });
  }
  this->Service(device);
  this->Wake.notify_one(); // for what is awaited, and where this was the time to be unplugged
  return 0;
}

int UsbFs::Discard(Device& device, void* urb)
{
  for (std::list<Pending>* list : { &device.Waiting, &device.Stuck })
  {
    for (auto pending = list->begin(); pending != list->end(); ++pending)
    {
      if (pending->Urb == urb)
      {
        this->Finish(device, pending->Urb, -ENOENT, 0);
        list->erase(pending);
        this->Gate(device);
        return 0;
      }
    }
  }
  return -EINVAL;
}

int UsbFs::Reap(Device& device, void* argument)
{
  if (device.Finished.empty())
  {
    return device.Gone ? -ENODEV : -EAGAIN;
  }
  *static_cast<usbdevfs_urb**>(argument) = device.Finished.front();
  device.Finished.pop_front();
  this->Gate(device);
  return 0;
}

void UsbFs::Finish(Device& device, usbdevfs_urb* urb, int status, int length)
{
  urb->status = status;
  urb->actual_length = length;
  device.Finished.push_back(urb);
}

void UsbFs::Service(Device& device)
{
  while (!device.Waiting.empty())
  {
    const Pending pending = device.Waiting.front();
    const std::optional<FalconModel::Answer> answer = device.Model.Read(pending.Start);
    if (!answer)
    {
      break;
    }
    const std::size_t size =
      std::min(answer->Bytes.size(), static_cast<std::size_t>(pending.Urb->buffer_length));
    std::copy_n(answer->Bytes.begin(), size, static_cast<std::uint8_t*>(pending.Urb->buffer));
    this->Finish(device, pending.Urb, answer->Status, static_cast<int>(size));
    device.Waiting.pop_front();
  }
  this->Gate(device);
}

// usbfs files are writable while transfers have finished: stopping the pty's output is ours.
void UsbFs::Gate(Device& device)
{
  const bool readable = !device.Finished.empty() || device.Gone;
  if (device.Slave >= 0 && readable != device.Readable)
  {
    device.Readable = readable;
    const long action = readable ? TCOON : TCOOFF;
    RealIoctl(device.Slave, TCXONC, reinterpret_cast<void*>(action));
  }
}

// Reads that wait for the latency timer, and cables that the script pulls.
void UsbFs::RunTimer()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (!this->Quit)
  {
    auto next = FalconModel::Clock::now() + std::chrono::milliseconds(20);
    int pulled = 0;
    for (Device& device : this->Devices)
    {
      if (device.Gone)
      {
        continue;
      }
      if (device.Model.TakesUnplug())
      {
        pulled = device.Port;
      }
      this->Service(device);
      for (const Pending& pending : device.Waiting)
      {
        next = std::min(next, device.Model.NextTry(pending.Start));
      }
    }
    if (pulled > 0)
    {
      lock.unlock();
      this->Unplug(pulled);
      lock.lock();
      continue;
    }
    this->Wake.wait_until(lock, next);
  }
}

/// For ThreadSanitizer: it does not see the locks inside of umockdev and GLib, compiled without it.
extern "C" const char* __tsan_default_suppressions()
{
  return "race:libumockdev.so\nrace:libglib-2.0.so\nrace:libgobject-2.0.so\n"
         "race:libgio-2.0.so\nrace:libudev.so\n";
}

/// umockdev ends the process where a listener to hotplug events leaves while it is informed of one.
/// The kernel has nobody refuse an event: who has left misses it.
extern "C" ssize_t sendmsg(int socket, const msghdr* message, int flags)
{
  const ssize_t sent = RealSendmsg(socket, message, flags);
  if (sent >= 0 || errno != ECONNREFUSED || !TheBus.load())
  {
    return sent;
  }
  ssize_t size = 0;
  for (std::size_t i = 0; i < message->msg_iovlen; ++i)
  {
    size += static_cast<ssize_t>(message->msg_iov[i].iov_len);
  }
  return size;
}

extern "C" int ioctl(int fd, unsigned long request, ...) noexcept
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  UsbFs* bus = TheBus;
  int result = 0;
  if (bus && _IOC_TYPE(request) == 'U' && bus->OnIoctl(fd, request, argument, result))
  {
    if (result < 0)
    {
      errno = -result;
      return -1;
    }
    return result;
  }
  return RealIoctl(fd, request, argument);
}

namespace
{
// libusb is compiled with checked open(): these are what it calls, by the width of its offsets.
int OpenUnlessDenied(const char* name, const char* path, int flags)
{
  UsbFs* bus = TheBus;
  if (bus && std::strncmp(path, "/dev/bus/usb/", 13) == 0 && bus->DeniesOpening())
  {
    errno = EACCES;
    return -1;
  }
  return reinterpret_cast<int (*)(const char*, int)>(dlsym(RTLD_NEXT, name))(path, flags);
}
}

extern "C" int __open_2(const char* path, int flags)
{
  return OpenUnlessDenied("__open_2", path, flags);
}

extern "C" int __open64_2(const char* path, int flags)
{
  return OpenUnlessDenied("__open64_2", path, flags);
}
