#ifndef Haptics_FalconModel_h
#define Haptics_FalconModel_h

#include "haptics/Devices/Falcon/FalconPacket.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

/// Where in its life a scripted device does something unusual.
enum class At
{
  Control, ///< the nth control transfer
  Upload,  ///< the nth chunk of firmware
  Probe,   ///< the nth packet before the device is homed
  Serve    ///< the nth packet after it is homed
};

/// What it does there.
enum class Do
{
  Stall,      ///< refuses the transfer; for packets, the read of the reply
  StallWrite, ///< refuses the write, until the halt is cleared
  IoError,    ///< breaks the transfer; for packets, the read of the reply
  Overflow,   ///< sends more than was asked for
  Silence,    ///< takes the bytes and says nothing
  Split,      ///< answers in two reads
  Late,       ///< answers later, by LateBy
  CutStatus,  ///< sends a read of one byte, shorter than the modem status
  Garble,     ///< damages a byte of the answer
  Chatter,    ///< puts rubbish before the answer
  ForgetHome, ///< loses the origin
  Jam,        ///< takes no byte and says nothing any more
  Unplug      ///< is pulled out, with the transfer pending
};

/// One line of a scripted device: from the nth on, so often.
struct Act
{
  At Where;
  int Nth;
  Do What;
  int Times = 1;
};

constexpr int Always = 1 << 30;

/// @brief A Falcon as a table of what it does wrong, on top of what it does right.
///
/// The FTDI chip, the boot loader behind it and the firmware, with the hand that homes it. One
/// thread at a time.
struct FalconModel
{
  using Clock = std::chrono::steady_clock;

  ///@{
  /// Set before it is plugged in.
  std::vector<Act> Script;
  bool Loaded = true;              ///< whether the firmware runs
  std::vector<std::uint8_t> Image; ///< the only firmware that it runs
  int HomesAfter = 5;              ///< packets a leg; negative: nobody homes it
  std::array<std::int16_t, 3> Encoders{ { 300, 310, 320 } };
  std::uint8_t Buttons = 0;
  std::chrono::milliseconds LateBy{ 2 };
  std::chrono::milliseconds LaterBy{ 0 }; ///< LateBy grows by it with each late answer
  bool CountsPackets =
    false; ///< at leg 0: FirstCount, and one more with every packet, up to CountTo
  static constexpr std::int16_t FirstCount = 300;
  static constexpr int CountTo = 256;
  std::function<void(const haptics::FalconCommand&)> OnCommand; ///< called with every packet
  ///@}

  ///@{
  /// What it saw.
  std::vector<std::array<int, 2>> Controls;     ///< request, value
  std::vector<haptics::FalconCommand> Commands; ///< every well-formed packet
  std::vector<std::uint8_t> Firmware;           ///< of the last upload
  int Uploads = 0;
  int BadPackets = 0;
  int Served = 0; ///< packets since it was homed
  ///@}

  struct Answer
  {
    int Status = 0; ///< negative errno
    std::vector<std::uint8_t> Bytes;
  };

  /// A control transfer: 0 or a negative errno.
  int Control(int request, int value);
  /// Bytes written to it: 0 or a negative errno.
  int Write(const std::uint8_t* bytes, std::size_t size);
  /// What a read that has been waiting since `start` gets; nothing yet where it has to go on
  /// waiting.
  std::optional<Answer> Read(Clock::time_point start);
  /// When a read that gets nothing now is to be tried again.
  Clock::time_point NextTry(Clock::time_point start) const;
  void ClearHalt() { this->Halted = false; }
  bool TakesUnplug();
  bool IsJammed() const { return this->Jammed; }

private:
  enum class Stage
  {
    Unknown,
    Hello,  ///< the boot loader waits to be greeted
    Start,  ///< and for the start of an upload
    Upload, ///< and for its chunks
    Run
  };

  const Act* Find(At where, int nth) const;
  int Perform(const Act* act);
  void Say(const std::vector<std::uint8_t>& bytes, const Act* act);
  int WriteToLoader(const std::uint8_t* bytes, std::size_t size);
  int TakePacket(const haptics::FalconPacket& packet);

  Stage Now = Stage::Unknown;
  int Baud = 0;
  int Latency = 16;
  bool Dtr = true;
  bool Halted = false;
  bool WantsUnplug = false;
  bool Jammed = false;
  int Chunks = 0;
  int Probes = 0;
  int HomingPackets = 0;
  std::uint8_t Homed = 0;
  std::vector<std::uint8_t> Incoming;
  struct Reading
  {
    std::vector<std::uint8_t> Bytes;
    Clock::time_point NotBefore;
  };
  std::deque<Reading> Outgoing;
  std::deque<int> Failures; // of the next reads
  bool CutNextStatus = false;
};

#endif
