// The USB bus that the guardian under test meets: open() and ioctl() for device files, in place of
// the system's. Writes what the device would get to the file that HAPTICS_GUARDIAN_LOG names:
// "claim", and the bytes of each packet in hexadecimal digits, a line each.
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace
{
int Device = -1;

void Log(const char* text)
{
  const char* name = std::getenv("HAPTICS_GUARDIAN_LOG");
  if (std::FILE* file = name ? std::fopen(name, "a") : nullptr)
  {
    std::fprintf(file, "%s\n", text);
    std::fclose(file);
  }
}
}

extern "C" int open(const char* path, int flags, ...)
{
  if (std::strncmp(path, "/dev/bus/usb/", 13) == 0)
  {
    // What a device file begins with: the device's descriptor.
    const unsigned char descriptor[18] = { 18, 1, 0, 2, 0, 0, 0, 64, 0x03, 0x04, 0x48, 0xcb, 0, 4,
      1, 2, 0, 1 };
    Device = memfd_create("falcon", 0);
    if (write(Device, descriptor, sizeof(descriptor)) < 0)
    {
      return -1;
    }
    lseek(Device, 0, SEEK_SET);
    return Device;
  }
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, 0));
}

extern "C" int ioctl(int file, unsigned long request, ...)
{
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (file != Device)
  {
    errno = ENOTTY;
    return -1;
  }
  if (request == USBDEVFS_DISCONNECT_CLAIM)
  {
    Log("claim");
    return 0;
  }
  if (request == USBDEVFS_BULK)
  {
    const auto* transfer = static_cast<usbdevfs_bulktransfer*>(argument);
    char text[256] = {};
    for (unsigned int i = 0; i < transfer->len && i < 100; ++i)
    {
      std::snprintf(text + 2 * i, 3, "%02x", static_cast<unsigned char*>(transfer->data)[i]);
    }
    Log(text);
    return static_cast<int>(transfer->len);
  }
  errno = EINVAL;
  return -1;
}
