#include "haptics/Devices/Falcon/FalconBoot.h"

#include "haptics/Devices/Falcon/FalconUsb.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace haptics
{
namespace FalconBoot
{
namespace
{
constexpr int HelloTries = 100;
constexpr int HelloTimeout = 20; // [ms]: the chip holds short answers back for up to 16
constexpr int EchoTimeout = 200; // [ms] a chunk
constexpr std::size_t ChunkSize = 62;
constexpr std::size_t LargestFirmware = 1 << 20; // the real one is some tens of kB

struct ControlStep
{
  std::uint8_t Request;
  std::uint16_t Value;
};

// Requests of the FTDI chip.
constexpr std::uint8_t Purge = 0; // 1: what it received, 2: what it is to send
constexpr std::uint8_t ModemLines = 1;
constexpr std::uint8_t FlowControl = 2;
constexpr std::uint8_t BaudRate = 3;
constexpr std::uint8_t DataFormat = 4;
constexpr std::uint8_t LatencyTimer = 9;

constexpr std::uint16_t DtrLow = 0x0100;
constexpr std::uint16_t DtrHigh = 0x0101;
constexpr std::uint16_t RtsLow = 0x0200;

constexpr std::array<ControlStep, 6> ExchangeSteps{ {
  { Purge, 1 },
  { Purge, 2 },
  { LatencyTimer, 1 },
  { BaudRate, 0x0002 }, // 1.5 M
  { Purge, 1 },
  { Purge, 2 },
} };

constexpr std::array<ControlStep, 9> BootSteps{ {
  { Purge, 1 },
  { Purge, 2 },
  { LatencyTimer, 16 },
  { BaudRate, 0x4138 }, // 9600
  { DataFormat, 8 },    // 8N1
  { FlowControl, 0 },
  { ModemLines, RtsLow },
  { ModemLines, DtrLow },
  { ModemLines, DtrHigh },
} };

constexpr std::array<ControlStep, 2> UploadSteps{ {
  { ModemLines, DtrLow }, { BaudRate, 0x0015 }, // about 142.9 k
} };

template <typename Steps>
void Run(FalconUsb& usb, const Steps& steps)
{
  for (const ControlStep& step : steps)
  {
    usb.Control(step.Request, step.Value);
  }
}

bool Hello(FalconUsb& usb)
{
  const std::array<std::uint8_t, 3> question{ 0x0a, 0x43, 0x0d };
  const std::vector<std::uint8_t> answer{ 0x0a, 0x44, 0x2c, 0x0d };
  for (int i = 0; i < HelloTries; ++i)
  {
    usb.Write(question.data(), question.size(), "waking its boot loader");
    if (usb.Read(answer.size(), HelloTimeout, "waking its boot loader") == answer)
    {
      return true;
    }
  }
  return false;
}

std::string Hex(unsigned int byte)
{
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "0x%02x", byte);
  return text.data();
}

void CompareEcho(const std::uint8_t* sent, std::size_t size, const std::vector<std::uint8_t>& echo,
  std::size_t offset)
{
  const auto difference = std::mismatch(echo.begin(), echo.end(), sent);
  const auto same = static_cast<std::size_t>(difference.first - echo.begin());
  if (same == size)
  {
    return;
  }
  const std::string where = "byte " + std::to_string(offset + same);
  throw FalconBadUpload(difference.first == echo.end()
      ? "The Falcon stopped echoing its firmware at " + where +
        ". Unplug it and its power supply, connect both again, and open it again."
      : "The Falcon echoed its firmware wrongly at " + where + ": " + Hex(*difference.second) +
        " was sent, " + Hex(*difference.first) +
        " came back. Check the cable, leave out hubs, and open it again.");
}
}

void PrepareExchange(FalconUsb& usb)
{
  Run(usb, ExchangeSteps);
}

std::vector<std::uint8_t> ReadFirmwareFile(const std::string& path)
{
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    // To open a FIFO would wait for who writes it.
    throw FalconFault("The firmware file " + path +
      " is no regular file. Set FirmwareFile to the image that came with the device.");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw FalconFault("The firmware file " + path + " cannot be opened: " + std::strerror(errno) +
      ". Set FirmwareFile to the image that came with the device.");
  }
  // No more is read than shows that it is too large.
  std::vector<std::uint8_t> bytes(LargestFirmware + 1);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.empty() || bytes.size() > LargestFirmware)
  {
    throw FalconFault("The firmware file " + path + " is no firmware image: it holds " +
      (bytes.empty() ? "0 bytes" : "more than " + std::to_string(LargestFirmware) + " bytes") +
      ", an image 1 to " + std::to_string(LargestFirmware) +
      ". Set FirmwareFile to the image that came with the device.");
  }
  return bytes;
}

void LoadFirmware(FalconUsb& usb, const std::vector<std::uint8_t>& firmware,
  const std::function<void(double)>& progress)
{
  Run(usb, BootSteps);
  if (!Hello(usb))
  {
    throw FalconBadUpload(
      "The Falcon's boot loader does not answer. Check its power supply; unplug "
      "both cables, connect them again, and open it again.");
  }
  Run(usb, UploadSteps);
  const std::uint8_t start = 0x41;
  usb.Write(&start, 1, "starting the firmware upload");
  if (usb.Read(1, EchoTimeout, "starting the firmware upload") !=
    std::vector<std::uint8_t>{ start })
  {
    throw FalconBadUpload(
      "The Falcon's boot loader does not take a firmware. Unplug it and its power "
      "supply, connect both again, and open it again.");
  }
  for (std::size_t offset = 0; offset < firmware.size(); offset += ChunkSize)
  {
    const std::size_t size = std::min(ChunkSize, firmware.size() - offset);
    const std::uint8_t* chunk = firmware.data() + offset;
    usb.Write(chunk, size, "sending the firmware");
    CompareEcho(chunk, size, usb.Read(size, EchoTimeout, "reading the firmware's echo"), offset);
    progress(static_cast<double>(offset + size) / static_cast<double>(firmware.size()));
  }
  PrepareExchange(usb);
}
}
}
