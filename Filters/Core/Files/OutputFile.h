#ifndef Haptics_OutputFile_h
#define Haptics_OutputFile_h

#include "vtkHapticsCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace haptics
{
/// @brief A file that takes the place of one of its name as a whole, or leaves that as it was.
///
/// It is written in the same folder without a name; Publish() gives it its own. Until then, and
/// where anything fails before or ends the process, the name has what it had, and nothing else is
/// left. (Where the file system has no files without names it has a hidden one, "*.part", which
/// stays if the process ends before.) Links are followed: what they point to is replaced. Mode,
/// owner and group are those of the file that is replaced, where there is one and the system allows
/// it, or go by the umask.
///
/// A name of anything but a regular file (a folder, FIFO or device) is rejected, so no call waits
/// for another process; so is a file that another OutputFile, of any process, is still writing. A
/// limit on the size of files is an error, not a signal. Where a call returns false, `error` names
/// the file and says why, and what to do. One thread; not the servo's.
class VTKHAPTICSCORE_EXPORT OutputFile
{
public:
  OutputFile() = default;
  /// Closes; drops what was not published.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// All of a file at once, from Open() to Close().
  static bool WriteWhole(
    const std::string& fileName, const void* bytes, std::size_t size, std::string& error);

  bool Open(const std::string& fileName, std::string& error);
  bool IsOpen() const { return this->Descriptor >= 0; }
  /// Appends bytes, before or after Publish(). After a failure GetSize() bytes are written. It
  /// fails where another program has cut the file or written to it, which keeps what that has left.
  bool Write(const void* bytes, std::size_t size, std::string& error);
  /// Waits until the disk has what was written.
  bool Sync(std::string& error);
  /// Puts the file in place of what its name had.
  bool Publish(std::string& error);
  /// Bytes that were written.
  std::uint64_t GetSize() const { return this->Size; }
  /// Cuts the end off, so that `size` bytes are left.
  void Truncate(std::uint64_t size);
  /// Whether the published file is still there as it was written; else what happened to it is in
  /// `error`, and `bytesLeft` are under its name.
  bool IsIntact(std::uint64_t& bytesLeft, std::string& error) const;
  /// Closes a published file, or drops one that was not. False where the system then reports that
  /// something was not written.
  bool Close(std::string& error);

private:
  bool Fail(int cause, std::string& error);
  bool IsAtEnd(std::int64_t written, std::string& error);
  /// What another program has done to a file that has `size` bytes now.
  std::string ChangeOf(std::uint64_t size) const;
  /// Sets Partial to the first hidden name that `take` takes; else errno says why it does not.
  template <typename Take>
  bool TakePartialName(const Take& take);

  std::string FileName; // as it was given, for messages
  std::string Target;   // links followed
  std::string Partial;  // a hidden name, while it has one
  bool IsPublished = false;
  int Descriptor = -1;
  std::uint64_t Size = 0;
};
}

#endif
