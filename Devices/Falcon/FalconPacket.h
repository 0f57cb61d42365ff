#ifndef Haptics_FalconPacket_h
#define Haptics_FalconPacket_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace haptics
{
/// @brief What is sent to a Novint Falcon in one exchange.
struct FalconCommand
{
  std::array<std::int16_t, 3> Torques{}; ///< motor units, one a leg; the device takes -4095 to 4095
  bool Home = true;                      ///< must be set in every packet, or the origin is lost
  std::uint8_t Leds = 0;                 ///< bits of FalconLed
};

/// The lamps of FalconCommand::Leds.
enum FalconLed : std::uint8_t
{
  FalconLedGreen = 1,
  FalconLedBlue = 2,
  FalconLedRed = 4,
  FalconLedAll = 7
};

/// @brief What comes back.
struct FalconReply
{
  std::array<std::int16_t, 3> Encoders{}; ///< counts, one a leg
  std::uint8_t Buttons = 0;               ///< bits 0 to 3: plus, forward, centre, minus
  std::uint8_t HomedLegs = 0;             ///< bits 0 to 2: the encoder of that leg has its origin
};

constexpr double FalconMaximumTorque = 4095.0; ///< motor units
constexpr std::uint8_t FalconAllHomed = 7;
constexpr std::size_t FalconPacketSize = 16;
using FalconPacket = std::array<std::uint8_t, FalconPacketSize>;

///@{
/// Writes a packet; bits that have no place in it are dropped. Any thread; allocates nothing.
///
///      0    1..4    5..8    9..12   13             14   15
///     '<'  leg 0   leg 1   leg 2   flags + 'A'    'A'  '>'     a leg: 4 nibbles + 'A', low first
///
VTKHAPTICSDEVICES_EXPORT FalconPacket Encode(const FalconCommand& command) noexcept;
VTKHAPTICSDEVICES_EXPORT FalconPacket Encode(const FalconReply& reply) noexcept;
///@}

///@{
/// Reads a packet. False, leaving the result as it is, where a bracket, a digit or a flag is not
/// what Encode() writes; byte 14 carries nothing and may be anything. Any thread.
VTKHAPTICSDEVICES_EXPORT bool Decode(const FalconPacket& packet, FalconCommand& command) noexcept;
VTKHAPTICSDEVICES_EXPORT bool Decode(const FalconPacket& packet, FalconReply& reply) noexcept;
///@}

/// Motor units to send: all three scaled down where one is beyond what the device takes, so that
/// the force keeps its direction; zero where one is not finite.
VTKHAPTICSDEVICES_EXPORT std::array<std::int16_t, 3> ClampTorques(
  const std::array<double, 3>& torques) noexcept;

/// @brief Finds the packets in a stream of bytes that comes in pieces of any length.
///
/// What is no packet is skipped up to the next '<' and counted. One thread; allocates nothing.
class VTKHAPTICSDEVICES_EXPORT FalconPacketReader
{
public:
  /// Takes one byte. True where it completes a well-formed reply, which is then in `reply`.
  bool Push(std::uint8_t byte, FalconReply& reply) noexcept;
  /// Packets that had to be given up since the reader was made.
  std::uint64_t GetNumberOfMalformed() const { return this->Malformed; }
  /// Forgets the piece of a packet that came so far.
  void Clear() { this->Size = 0; }

private:
  void Resynchronise() noexcept;

  FalconPacket Bytes{};
  std::size_t Size = 0;
  std::uint64_t Malformed = 0;
};

/// @brief The bytes in one read from the device's FTDI chip behind the two of modem status.
struct FtdiPayload
{
  const std::uint8_t* Bytes;
  std::size_t Size;
};

/// False where the read is not one that the chip can send: shorter than its status bytes or longer
/// than a USB packet.
VTKHAPTICSDEVICES_EXPORT bool ReadFtdi(
  const std::uint8_t* read, std::size_t size, FtdiPayload& payload) noexcept;
constexpr std::size_t FtdiPacketSize = 64; ///< with the status bytes
}

#endif
