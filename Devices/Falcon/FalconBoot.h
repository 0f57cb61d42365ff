#ifndef Haptics_FalconBoot_h
#define Haptics_FalconBoot_h

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace haptics
{
class FalconUsb;

/// @brief The set-up of the Falcon's serial chip, and the way its firmware gets into it.
///
/// Functions for the thread of the FalconUsb that they are given; they throw what it throws, and
/// FalconBadUpload where another attempt may help.
namespace FalconBoot
{
/// Readies the chip for exchanges of packets: 1 ms latency, 1.5 Mbaud, empty queues.
void PrepareExchange(FalconUsb& usb);

/// The content of a firmware file. Throws FalconFault where it cannot be read, is empty, or is far
/// too large to be one.
std::vector<std::uint8_t> ReadFirmwareFile(const std::string& path);

/// Wakes the boot loader, sends the firmware, compares every echo, and readies the chip again.
/// Only an exchange can show whether the firmware runs. `progress` gets the share sent, 0 to 1.
void LoadFirmware(FalconUsb& usb, const std::vector<std::uint8_t>& firmware,
  const std::function<void(double)>& progress);
}
}

#endif
