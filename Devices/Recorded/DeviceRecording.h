#ifndef Haptics_DeviceRecording_h
#define Haptics_DeviceRecording_h

#include "haptics/Files/OutputFile.h"
#include "vtkHapticsDevicesModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
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
  ///@{
  /// As in DeviceSample; 0 from older files, whose records have 72 bytes.
  std::uint32_t Placements = 0;
  std::array<double, 3> Place{}; ///< [m]
  std::uint32_t Releases = 0;
  double Latency = 0.0; ///< [s]
  ///@}
};

/// @brief Writes a recording: a header and one record of 112 bytes a tick, all little-endian.
///
///     "VTKHAPT1"  header, 108 bytes with the size of a record and its own CRC-32
///     tick u64, time f64, position 3 f64, force 3 f64, buttons u32,
///       placements u32, place 3 f64, releases u32, latency f64, CRC-32 of the record
///     ...
///
/// A record is whole or is not there, by its checksum. Records of 72 bytes lack the second line
/// but for the checksum. Not the servo thread.
class VTKHAPTICSDEVICES_EXPORT RecordingWriter
{
public:
  RecordingWriter();
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  /// Makes the file, in place of another recording of that name, which is left as it is where this
  /// fails. A file that holds anything else is not replaced. False with the cause in `error`.
  bool Open(const std::string& fileName, const RecordingHeader& header, std::string& error);
  /// Appends ticks and hands them to the system at once, so that a crash of this program does not
  /// lose them. False with the cause in `error`, as on a full disk, or where the file is not what
  /// was written any more, as when it was deleted: then no more can be appended.
  bool Write(const std::vector<RecordedTick>& ticks, std::string& error);
  /// Ticks that the file has, by what is known since the last Write().
  std::uint64_t GetNumberOfTicks() const { return this->NumberOfTicks; }
  /// Closes the file. False with the cause in `error` where the last bytes could not be written.
  bool Close(std::string& error);

private:
  OutputFile File;
  std::uint64_t NumberOfTicks = 0;
  std::vector<unsigned char> Bytes; // kept for its memory
};

/// What a file held.
struct Recording
{
  RecordingHeader Header;
  std::vector<RecordedTick> Ticks;
  /// In a sentence, what was cut off where the file does not end with a whole record; else empty.
  std::string Note;
};

/// Reads a recording up to its last whole record. False, with the cause in `error`, where the file
/// cannot be read, is no regular file, no recording, or has no whole record, where a tick is not
/// later than the one before, or where the header has no rate or a limit below 0.
VTKHAPTICSDEVICES_EXPORT bool ReadRecording(
  const std::string& fileName, Recording& recording, std::string& error);
}

#endif
