#ifndef Haptics_FalconUsb_h
#define Haptics_FalconUsb_h

#include "haptics/Devices/Falcon/FalconGuardian.h"
#include "haptics/Devices/Falcon/FalconPacket.h"

#include <libusb.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace haptics
{
/// @brief A fault of the device; what() says what went wrong and what to do.
class FalconFault : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// @brief An upload of the firmware failed in a way that another attempt may mend.
class FalconBadUpload : public FalconFault
{
public:
  using FalconFault::FalconFault;
};

/// @brief The owner asked to stop.
struct FalconStopped
{
};

/// What to add where the system denies access to the device.
extern const char* const FalconUdevRule;

/// @brief A Falcon on the USB, through libusb's asynchronous API.
///
/// Everything, libusb's events included, happens on the thread that made the object: nothing is
/// shared, so nothing is locked. Waiting goes on handling events and looks at `stop` every few
/// milliseconds. Methods throw FalconFault, and FalconStopped once `stop` is set.
class FalconUsb
{
public:
  /// @brief One transfer of up to a USB packet, to be used again and again.
  class Transfer
  {
  public:
    Transfer(FalconUsb& usb, std::uint8_t endpoint);
    /// Cancels what is under way and waits for its end.
    ~Transfer();
    Transfer(const Transfer&) = delete;
    Transfer& operator=(const Transfer&) = delete;

    /// Starts: bytes to write, or none to read up to a packet. [ms] `doing` is for the message
    /// where it cannot start.
    void Submit(
      const std::uint8_t* bytes, std::size_t size, unsigned int timeout, const char* doing);
    /// Waits for the end; a libusb_transfer_status.
    int Wait();
    const std::uint8_t* GetBytes() const { return this->Buffer; }
    std::size_t GetSize() const { return static_cast<std::size_t>(this->Handle->actual_length); }

  private:
    friend class FalconUsb;
    void SubmitFilled(const char* doing);

    FalconUsb& Usb;
    const std::uint8_t Endpoint;
    libusb_transfer* Handle;
    int Done = 1;
    std::uint8_t Buffer[FtdiPacketSize] = {};
  };

  /// `guardian`: the program of FalconGuardian, or empty.
  explicit FalconUsb(const std::atomic<bool>& stop, std::string guardian = {});
  ~FalconUsb();
  FalconUsb(const FalconUsb&) = delete;
  FalconUsb& operator=(const FalconUsb&) = delete;

  /// Falcons that were plugged in since the object was made, those found at first included.
  unsigned int GetArrivals() const { return this->Arrivals; }

  /// How many are plugged in now.
  std::size_t CountDevices() const;
  /// Opens one of them, counted by their place in the machine, and claims it from any kernel
  /// driver.
  void Open(int index);
  /// Lets go of the device, if there is one. Throws nothing.
  void Close();
  bool IsOpen() const { return this->Device != nullptr; }
  FalconGuardian& GetGuardian() { return this->Guardian; }

  /// Handles events for so long [ms] or until `stop` is set.
  void HandleEvents(int duration);
  /// Throws FalconStopped where `stop` is set.
  void CheckStop() const;
  /// Whether `stop` ends waiting; on at first. Off for saying farewell.
  void SetStoppable(bool stoppable) { this->Stoppable = stoppable; }

  /// A control transfer to the FTDI chip without data.
  void Control(std::uint8_t request, std::uint16_t value);
  /// Writes all bytes, at most a USB packet.
  void Write(const std::uint8_t* bytes, std::size_t size, const char* doing);
  /// Reads until so many bytes came or the time [ms] is over; returns what came.
  std::vector<std::uint8_t> Read(std::size_t size, int timeout, const char* doing);

  /// Ends the stall of an endpoint, where the device still can.
  void ClearHalt(std::uint8_t endpoint);

  /// Throws what a transfer's status means, unless it is completion.
  static void Check(int status, const char* doing);

  static constexpr std::uint8_t OutEndpoint = 0x02;
  static constexpr std::uint8_t InEndpoint = 0x81;

private:
  std::vector<libusb_device*> FindDevices() const;
  int Claim(libusb_device* device);
  static int LIBUSB_CALL OnHotplug(
    libusb_context*, libusb_device*, libusb_hotplug_event event, void* self);
  bool MustStop() const { return this->Stoppable && this->Stop.load(std::memory_order_relaxed); }

  const std::atomic<bool>& Stop;
  const std::string GuardianProgram;
  FalconGuardian Guardian; // while a device is open
  bool Stoppable = true;
  libusb_context* Context = nullptr;
  libusb_device_handle* Device = nullptr;
  unsigned int Arrivals = 0;
};
}

#endif
