#ifndef Haptics_DeviceRecording_h
#define Haptics_DeviceRecording_h

#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace haptics
{
/// The device of a recording and the servo that made it.
struct RecordingHeader
{
  double Rate = 1000.0;                    ///< of the servo [Hz]
  double MaximumForce = 0.0;               ///< [N]
  double MaximumStiffness = 0.0;           ///< [N/m]
  double Damping = 0.0;                    ///< [N s/m]
  double Latency = 0.0;                    ///< [s]
  std::array<double, 6> WorkspaceBounds{}; ///< device frame [m]
  std::uint32_t NumberOfButtons = 0;
};

/// One servo tick as the device saw it, device frame.
struct RecordedTick
{
  std::uint64_t Tick = 0;           ///< from 0; a gap where ticks could not be recorded
  double Time = 0.0;                ///< [s] since the servo's start
  std::array<double, 3> Position{}; ///< [m]
  std::array<double, 3> Force{};    ///< asked for [N]
  std::uint32_t Buttons = 0;
};

/// @brief Writes a recording: a header and one record of 72 bytes a tick, all little-endian.
///
///     "VTKHAPT1"  header, 108 bytes with its CRC-32
///     tick u64, time f64, position 3 f64, force 3 f64, buttons u32, CRC-32 of the record
///     ...
///
/// A record is whole or is not there: its checksum tells. Not the servo thread.
class VTKHAPTICSDEVICES_EXPORT RecordingWriter
{
public:
  RecordingWriter();
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Makes the file, in place of any of that name. False with the cause in `error`.
  bool Open(const std::string& fileName, const RecordingHeader& header, std::string& error);
  /// Appends ticks and hands them to the system at once, so that a crash of this program does not
  /// lose them. False with the cause in `error`, as on a full disk.
  bool Write(const std::vector<RecordedTick>& ticks, std::string& error);
  /// Closes the file. False with the cause in `error` where the last bytes could not be written.
  bool Close(std::string& error);

private:
  std::string FileName;
  std::FILE* File = nullptr;
  std::vector<unsigned char> Bytes; // kept for its memory
};

/// What a file held.
struct Recording
{
  RecordingHeader Header;
  std::vector<RecordedTick> Ticks;
  /// For people: what was cut off, where the file does not end with a whole record; else empty.
  std::string Note;
};

/// Reads a recording up to its last whole record. False, with the cause in `error`, where the file
/// cannot be read, is none, or has no whole record, where a tick is not later than the one before,
/// or where the header tells no rate or a limit below 0.
VTKHAPTICSDEVICES_EXPORT bool ReadRecording(
  const std::string& fileName, Recording& recording, std::string& error);
}

#endif
