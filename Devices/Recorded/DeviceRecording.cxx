#include "haptics/Devices/Recorded/DeviceRecording.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

namespace haptics
{
namespace
{
using Bytes = std::vector<unsigned char>;

constexpr char Magic[] = "VTKHAPT1";
constexpr std::size_t MagicSize = sizeof(Magic) - 1;
constexpr std::size_t ChecksumSize = 4;
constexpr std::size_t HeaderSize = MagicSize + 11 * 8 + 2 * 4 + ChecksumSize;
constexpr std::uint32_t OldRecordSize = 2 * 8 + 6 * 8 + 4 + ChecksumSize;
constexpr std::uint32_t RecordSize = OldRecordSize + 4 + 3 * 8 + 4 + 8;

/// CRC-32 as in ISO 3309 and zip files.
std::uint32_t Checksum(const unsigned char* bytes, std::size_t size)
{
  std::uint32_t crc = 0xffffffffU;
  for (std::size_t i = 0; i < size; ++i)
  {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = (crc >> 1) ^ (0xedb88320U & (0U - (crc & 1U)));
    }
  }
  return ~crc;
}

template <typename Integer>
void Put(Bytes& bytes, Integer value)
{
  for (std::size_t i = 0; i < sizeof(Integer); ++i)
  {
    bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
  }
}

void Put(Bytes& bytes, double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  Put(bytes, bits);
}

template <std::size_t N>
void Put(Bytes& bytes, const std::array<double, N>& values)
{
  for (const double value : values)
  {
    Put(bytes, value);
  }
}

void PutChecksum(Bytes& bytes, std::size_t begin)
{
  Put(bytes, Checksum(bytes.data() + begin, bytes.size() - begin));
}

/// Takes values off the front of a record.
class Taker
{
public:
  explicit Taker(const unsigned char* bytes)
    : Next(bytes)
  {
  }
  template <typename Integer>
  void Take(Integer& value)
  {
    value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
    {
      value |= static_cast<Integer>(*this->Next++) << (8 * i);
    }
  }
  void Take(double& value)
  {
    std::uint64_t bits = 0;
    this->Take(bits);
    std::memcpy(&value, &bits, sizeof(value));
  }
  template <std::size_t N>
  void Take(std::array<double, N>& values)
  {
    for (double& value : values)
    {
      this->Take(value);
    }
  }

private:
  const unsigned char* Next;
};

/// Whether the last four of the bytes are the checksum of those before.
bool IsWhole(const unsigned char* bytes, std::size_t size)
{
  std::uint32_t stored = 0;
  Taker(bytes + size - ChecksumSize).Take(stored);
  return stored == Checksum(bytes, size - ChecksumSize);
}

/// A period is divided by, and limits are compared with.
bool IsUsable(const RecordingHeader& header)
{
  return std::isfinite(header.Rate) && header.Rate > 0.0 && header.MaximumForce >= 0.0 &&
    header.MaximumStiffness >= 0.0 && header.Damping >= 0.0 && header.Latency >= 0.0;
}

/// Servos count on time that goes on; false for a time that is NaN.
bool Follows(const RecordedTick& tick, const std::vector<RecordedTick>& ticks)
{
  return std::isfinite(tick.Time) &&
    (ticks.empty() || (tick.Time > ticks.back().Time && tick.Tick > ticks.back().Tick));
}

std::string SystemError()
{
  return std::generic_category().message(errno);
}

/// Whether there is a regular file that is neither empty nor begins as a recording does.
bool IsSomethingElse(const std::string& fileName)
{
  std::error_code none;
  if (!std::filesystem::is_regular_file(fileName, none))
  {
    return false;
  }
  std::array<char, MagicSize> begin{};
  std::ifstream file(fileName, std::ios::binary);
  file.read(begin.data(), begin.size());
  return file.gcount() > 0 && std::memcmp(begin.data(), Magic, MagicSize) != 0;
}
}

RecordingWriter::RecordingWriter() = default;
RecordingWriter::~RecordingWriter() = default;

bool RecordingWriter::Open(
  const std::string& fileName, const RecordingHeader& header, std::string& error)
{
  if (!this->Close(error))
  {
    return false;
  }
  if (IsSomethingElse(fileName))
  {
    error = "The recording " + fileName +
      " cannot be written: there is a file of that name which "
      "is no recording, and is not replaced. Choose another name, or remove it.";
    return false;
  }
  this->NumberOfTicks = 0;
  this->Bytes.assign(Magic, Magic + MagicSize);
  Put(this->Bytes, RecordSize);
  Put(this->Bytes, header.Rate);
  Put(this->Bytes, header.MaximumForce);
  Put(this->Bytes, header.MaximumStiffness);
  Put(this->Bytes, header.Damping);
  Put(this->Bytes, header.Latency);
  Put(this->Bytes, header.WorkspaceBounds);
  Put(this->Bytes, header.NumberOfButtons);
  PutChecksum(this->Bytes, 0);
  if (!this->File.Open(fileName, error) ||
    !this->File.Write(this->Bytes.data(), this->Bytes.size(), error) || !this->File.Publish(error))
  {
    std::string ignored; // nothing was published
    this->File.Close(ignored);
    error = "The recording " + error;
    return false;
  }
  return true;
}

bool RecordingWriter::Write(const std::vector<RecordedTick>& ticks, std::string& error)
{
  if (!this->File.IsOpen())
  {
    error = "No recording is open. Call Open() first.";
    return false;
  }
  this->Bytes.clear();
  for (const RecordedTick& tick : ticks)
  {
    const std::size_t begin = this->Bytes.size();
    Put(this->Bytes, tick.Tick);
    Put(this->Bytes, tick.Time);
    Put(this->Bytes, tick.Position);
    Put(this->Bytes, tick.Force);
    Put(this->Bytes, tick.Buttons);
    Put(this->Bytes, tick.Placements);
    Put(this->Bytes, tick.Place);
    Put(this->Bytes, tick.Releases);
    Put(this->Bytes, tick.Latency);
    PutChecksum(this->Bytes, begin);
  }
  const auto ticksIn = [](std::uint64_t bytes)
  { return bytes < HeaderSize ? 0 : (bytes - HeaderSize) / RecordSize; };
  const bool isWritten = this->File.Write(this->Bytes.data(), this->Bytes.size(), error);
  std::uint64_t bytesLeft = 0;
  std::string change;
  if (!this->File.IsIntact(bytesLeft, change))
  {
    this->NumberOfTicks = ticksIn(bytesLeft);
    error = "The recording " + change + " Choose a name that no other program uses.";
    return false;
  }
  this->NumberOfTicks = ticksIn(this->File.GetSize());
  if (!isWritten)
  {
    this->File.Truncate(HeaderSize + this->NumberOfTicks * RecordSize);
    error = "The recording ends after " + std::to_string(this->NumberOfTicks) + " ticks: " + error;
  }
  return isWritten;
}

bool RecordingWriter::Close(std::string& error)
{
  if (!this->File.Close(error))
  {
    error = "The end of the recording " + error;
    return false;
  }
  return true;
}

bool ReadRecording(const std::string& fileName, Recording& recording, std::string& error)
{
  const auto fail = [&](const std::string& cause)
  {
    error = "The recording " + fileName + " " + cause;
    return false;
  };
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(fileName, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    return fail("cannot be read: it is no regular file. Give a file that a servo has recorded.");
  }
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(fileName.c_str(), "rb"), close);
  if (!file)
  {
    return fail("cannot be opened: " + SystemError() + ".");
  }

  std::array<unsigned char, HeaderSize> head{};
  const std::size_t headSize = std::fread(head.data(), 1, head.size(), file.get());
  if (headSize < MagicSize || std::memcmp(head.data(), Magic, MagicSize) != 0)
  {
    return fail("is none: it does not begin with " + std::string(Magic) + ".");
  }
  if (headSize < head.size() || !IsWhole(head.data(), head.size()))
  {
    return fail("is damaged in its header. Nothing of it can be read.");
  }
  Recording read;
  std::uint32_t recordSize = 0;
  Taker header(head.data() + MagicSize);
  header.Take(recordSize);
  header.Take(read.Header.Rate);
  header.Take(read.Header.MaximumForce);
  header.Take(read.Header.MaximumStiffness);
  header.Take(read.Header.Damping);
  header.Take(read.Header.Latency);
  header.Take(read.Header.WorkspaceBounds);
  header.Take(read.Header.NumberOfButtons);
  if (recordSize != RecordSize && recordSize != OldRecordSize)
  {
    return fail("was made by another version: its records have " + std::to_string(recordSize) +
      " bytes, not " + std::to_string(RecordSize) + " or " + std::to_string(OldRecordSize) + ".");
  }
  if (!IsUsable(read.Header))
  {
    return fail(
      "describes a device or a servo that cannot be: its rate must be finite and above 0, "
      "force, stiffness, damping and latency not below 0. Record it anew.");
  }

  Bytes bytes(recordSize);
  std::size_t size = 0;
  while ((size = std::fread(bytes.data(), 1, bytes.size(), file.get())) == bytes.size() &&
    IsWhole(bytes.data(), bytes.size()))
  {
    RecordedTick tick;
    Taker record(bytes.data());
    record.Take(tick.Tick);
    record.Take(tick.Time);
    record.Take(tick.Position);
    record.Take(tick.Force);
    record.Take(tick.Buttons);
    if (recordSize == RecordSize)
    {
      record.Take(tick.Placements);
      record.Take(tick.Place);
      record.Take(tick.Releases);
      record.Take(tick.Latency);
    }
    if (!Follows(tick, read.Ticks))
    {
      return fail("does not go on in time: tick " + std::to_string(tick.Tick) + " at " +
        std::to_string(tick.Time) + " s comes " +
        (read.Ticks.empty() ? "first"
                            : "after tick " + std::to_string(read.Ticks.back().Tick) + " at " +
              std::to_string(read.Ticks.back().Time) + " s") +
        ". Ticks and times must be finite and increase. Record it anew.");
    }
    read.Ticks.push_back(tick);
  }
  if (std::ferror(file.get()) != 0)
  {
    return fail("cannot be read on after " + std::to_string(read.Ticks.size()) +
      " ticks: " + SystemError() + ".");
  }
  if (read.Ticks.empty())
  {
    return fail("has no whole tick.");
  }
  if (size != 0)
  {
    read.Note = "The recording " + fileName +
      (size < bytes.size() ? " is cut off" : " is damaged") + " after " +
      std::to_string(read.Ticks.size()) + " whole ticks (" +
      std::to_string(read.Ticks.back().Time) + " s); it was read up to there.";
  }
  recording = std::move(read);
  return true;
}
}
