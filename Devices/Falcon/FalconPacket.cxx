#include "haptics/Devices/Falcon/FalconPacket.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
constexpr std::uint8_t Zero = 'A'; // the digit 0
constexpr std::size_t Flags = 13;
constexpr std::size_t Unused = 14;
constexpr std::size_t NibblesInValue = 4;
constexpr std::uint8_t HomeFlag = 1;
constexpr int LedShift = 1;
constexpr std::uint8_t AllButtons = 15;
constexpr int HomedShift = 4;
constexpr std::size_t FtdiStatusSize = 2;

FalconPacket Frame(const std::array<std::int16_t, 3>& values, unsigned int flags) noexcept
{
  FalconPacket packet;
  std::size_t next = 0;
  packet[next++] = '<';
  for (const std::int16_t value : values)
  {
    unsigned int bits = static_cast<std::uint16_t>(value);
    for (std::size_t i = 0; i < NibblesInValue; ++i, bits >>= 4)
    {
      packet[next++] = static_cast<std::uint8_t>(Zero + (bits & 15u));
    }
  }
  packet[Flags] = static_cast<std::uint8_t>(Zero + flags);
  packet[Unused] = Zero;
  packet.back() = '>';
  return packet;
}

bool Unframe(const FalconPacket& packet, unsigned int maximumFlags,
  std::array<std::int16_t, 3>& values, unsigned int& flags) noexcept
{
  if (packet.front() != '<' || packet.back() != '>' || packet[Flags] < Zero ||
    packet[Flags] - Zero > static_cast<int>(maximumFlags))
  {
    return false;
  }
  std::size_t next = 1;
  for (std::int16_t& value : values)
  {
    unsigned int bits = 0;
    for (std::size_t i = 0; i < NibblesInValue; ++i)
    {
      const std::uint8_t digit = packet[next++];
      if (digit < Zero || digit > Zero + 15)
      {
        return false;
      }
      bits |= static_cast<unsigned int>(digit - Zero) << (4 * i);
    }
    value = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
  }
  flags = packet[Flags] - Zero;
  return true;
}
}

FalconPacket Encode(const FalconCommand& command) noexcept
{
  return Frame(command.Torques,
    (command.Home ? HomeFlag : 0u) |
      static_cast<unsigned int>(command.Leds & FalconLedAll) << LedShift);
}

FalconPacket Encode(const FalconReply& reply) noexcept
{
  return Frame(reply.Encoders,
    (reply.Buttons & AllButtons) |
      static_cast<unsigned int>(reply.HomedLegs & FalconAllHomed) << HomedShift);
}

bool Decode(const FalconPacket& packet, FalconCommand& command) noexcept
{
  FalconCommand read;
  unsigned int flags = 0;
  if (!Unframe(packet, HomeFlag | FalconLedAll << LedShift, read.Torques, flags))
  {
    return false;
  }
  read.Home = (flags & HomeFlag) != 0;
  read.Leds = static_cast<std::uint8_t>(flags >> LedShift);
  command = read;
  return true;
}

bool Decode(const FalconPacket& packet, FalconReply& reply) noexcept
{
  FalconReply read;
  unsigned int flags = 0;
  if (!Unframe(packet, AllButtons | FalconAllHomed << HomedShift, read.Encoders, flags))
  {
    return false;
  }
  read.Buttons = static_cast<std::uint8_t>(flags & AllButtons);
  read.HomedLegs = static_cast<std::uint8_t>(flags >> HomedShift);
  reply = read;
  return true;
}

std::array<std::int16_t, 3> ClampTorques(const std::array<double, 3>& torques) noexcept
{
  double largest = FalconMaximumTorque;
  for (const double torque : torques)
  {
    if (!std::isfinite(torque))
    {
      return {};
    }
    largest = std::max(largest, std::abs(torque));
  }
  std::array<std::int16_t, 3> clamped{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    clamped[i] = static_cast<std::int16_t>(std::lround(torques[i] / largest * FalconMaximumTorque));
  }
  return clamped;
}

bool FalconPacketReader::Push(std::uint8_t byte, FalconReply& reply) noexcept
{
  if (this->Size == 0 && byte != '<')
  {
    return false;
  }
  this->Bytes[this->Size++] = byte;
  if (this->Size < FalconPacketSize)
  {
    return false;
  }
  if (Decode(this->Bytes, reply))
  {
    this->Size = 0;
    return true;
  }
  ++this->Malformed;
  this->Resynchronise();
  return false;
}

// A packet that lost bytes swallowed the beginning of the next one.
void FalconPacketReader::Resynchronise() noexcept
{
  const auto end = this->Bytes.begin() + static_cast<std::ptrdiff_t>(this->Size);
  const auto begin = std::find(this->Bytes.begin() + 1, end, '<');
  this->Size = static_cast<std::size_t>(end - begin);
  std::copy(begin, end, this->Bytes.begin());
}

bool ReadFtdi(const std::uint8_t* read, std::size_t size, FtdiPayload& payload) noexcept
{
  if (size < FtdiStatusSize || size > FtdiPacketSize)
  {
    return false;
  }
  payload = { read + FtdiStatusSize, size - FtdiStatusSize };
  return true;
}
}
