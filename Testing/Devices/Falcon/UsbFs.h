#ifndef Haptics_UsbFs_h
#define Haptics_UsbFs_h

#include "FalconModel.h"

#include <umockdev.h>

#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

struct usbdevfs_urb;

/// @brief A USB bus in this process, for real libusb: what the kernel's usbfs would answer.
///
///     libusb --udev, sysfs--> umockdev testbed       what is plugged in, hotplug
///            --open---------> symbolic link to a pty  something that can be polled
///            --ioctl--------> our own ioctl()         transfers, answered by a FalconModel
///
/// One at a time. Make it before the first use of libusb. No root, no LD_PRELOAD.
class UsbFs
{
public:
  UsbFs();
  ~UsbFs();
  /// False where there are no pseudo-terminals, as in a bare chroot: nothing can be plugged in
  /// then.
  static bool IsPossible();
  UsbFs(const UsbFs&) = delete;
  UsbFs& operator=(const UsbFs&) = delete;

  /// Plugs a device into a port, 1 to 9. One that was there before comes back with a new number.
  void Plug(int port, const FalconModel& model);
  void Unplug(int port);
  /// Calls look(FalconModel&) while nothing else touches the device, plugged or pulled last.
  template <typename Look>
  auto With(int port, Look look)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return look(this->Find(port).Model);
  }
  /// Whether the device is claimed by somebody.
  bool IsClaimed(int port);

  ///@{
  /// What the system denies: opening the node, claiming the interface. At first nothing.
  void DenyOpening(bool deny);
  void ClaimByOther(bool claimed);
  /// For our open(): waits until what is being plugged in is wholly there.
  bool DeniesOpening();
  ///@}
  /// True while the kernel's driver, there at first, is detached.
  bool IsDriverDetached();

  /// For our ioctl(): true where the file is one of ours; `result` is then 0 or a negative errno.
  bool OnIoctl(int fd, unsigned long request, void* argument, int& result);

private:
  struct Pending
  {
    usbdevfs_urb* Urb;
    FalconModel::Clock::time_point Start;
  };
  struct Device
  {
    int Port = 0;
    int Number = 0;
    FalconModel Model;
    bool Gone = false;
    bool Claimed = false;
    bool Readable = true;
    int Master = -1;
    int Slave = -1;
    unsigned long Node = 0;     // the pty's device number
    std::list<Pending> Waiting; // reads
    std::list<Pending> Stuck;   // writes that the device does not take
    std::list<usbdevfs_urb*> Finished;
  };

  Device& Find(int port);
  int Answer(Device& device, unsigned long request, void* argument);
  int Submit(Device& device, usbdevfs_urb* urb);
  int Reap(Device& device, void* argument);
  int Discard(Device& device, void* urb);
  void Service(Device& device);
  void Finish(Device& device, usbdevfs_urb* urb, int status, int length);
  void Gate(Device& device);
  void RunTimer();
  std::string PathOf(const Device& device) const;

  std::mutex Plugging; // before Mutex
  std::mutex Mutex;
  std::condition_variable Wake;
  UMockdevTestbed* Bed;
  std::list<Device> Devices; // newest first
  std::thread Timer;
  bool Quit = false;
  bool OpeningDenied = false;
  bool ClaimedByOther = false;
  bool Detached = false;
  int Numbers = 1;
};

#endif
