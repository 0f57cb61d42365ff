#include "haptics/Files/OutputFile.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace haptics
{
namespace
{
namespace fs = std::filesystem;

/// What a chain of links ends with, whether that is there or not.
fs::path FollowLinks(const fs::path& name)
{
  constexpr int longest = 40; // as Linux has it
  fs::path target = name;
  std::error_code none;
  for (int i = 0; i < longest && fs::is_symlink(fs::symlink_status(target, none)); ++i)
  {
    const fs::path next = fs::read_symlink(target, none);
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

const char* Advice(int cause)
{
  switch (cause)
  {
    case ENOSPC:
    case EDQUOT:
      return "Free some space there, or choose a file on another disk.";
    case EFBIG:
      return "Raise the limit on the size of files (ulimit -f), or choose another file system.";
    case ENOENT:
    case ENOTDIR:
      return "Make its folder first, or choose another one.";
    case EWOULDBLOCK:
      return "Choose another name, or end what writes it first.";
    case EISDIR:
    case EINVAL:
    case ELOOP:
    case ENAMETOOLONG:
      return "Choose another name.";
    default:
      return "Choose a folder that you may write to.";
  }
}

std::string Cause(int cause)
{
  switch (cause)
  {
    case EWOULDBLOCK:
      return "it is being written already, by this program or another one";
    case EINVAL:
      return "it is no regular file";
    default:
      return std::generic_category().message(cause);
  }
}

const std::string DescriptorFolder = "/proc/self/fd/";

/// A file in a folder that nothing names yet, so that it is gone with the process; or -1 where the
/// system has no such files.
int OpenWithoutName(const fs::path& folder, mode_t mode)
{
#ifdef O_TMPFILE
  if (access(DescriptorFolder.c_str(), X_OK) == 0) // by which it gets a name
  {
    return open(
      folder.empty() ? "." : folder.c_str(), O_WRONLY | O_APPEND | O_TMPFILE | O_CLOEXEC, mode);
  }
#endif
  return -1;
}

/// A write beyond the limit on the size of files comes with a signal that ends the process.
class FileSizeSignalBlock
{
public:
  FileSizeSignalBlock()
  {
    sigemptyset(&this->Signals);
    sigaddset(&this->Signals, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &this->Signals, &this->Before);
  }
  ~FileSizeSignalBlock()
  {
    if (!sigismember(&this->Before, SIGXFSZ))
    {
      const timespec now{};
      while (this->IsPending() && sigtimedwait(&this->Signals, nullptr, &now) < 0 && errno == EINTR)
      {
      }
      pthread_sigmask(SIG_SETMASK, &this->Before, nullptr);
    }
  }
  FileSizeSignalBlock(const FileSizeSignalBlock&) = delete;
  FileSizeSignalBlock& operator=(const FileSizeSignalBlock&) = delete;

private:
  static bool IsPending()
  {
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGXFSZ) != 0;
  }

  sigset_t Signals{};
  sigset_t Before{};
};
}

OutputFile::~OutputFile()
{
  std::string ignored; // who wants to know calls Close()
  this->Close(ignored);
}

bool OutputFile::Fail(int cause, std::string& error)
{
  error = this->FileName + " cannot be written: " + Cause(cause) + ". " + Advice(cause);
  return false;
}

bool OutputFile::Open(const std::string& fileName, std::string& error)
{
  if (!this->Close(error))
  {
    return false;
  }
  this->FileName = fileName;
  this->Target = FollowLinks(fileName).string();
  this->Size = 0;
  const std::string base = fs::path(this->Target).filename().string();
  if (base.empty() || base == "." || base == "..")
  {
    return this->Fail(this->Target.empty() ? ENOENT : EISDIR, error);
  }
  std::error_code none;
  if (fs::is_symlink(fs::symlink_status(this->Target, none)))
  {
    return this->Fail(ELOOP, error);
  }
  struct stat present
  {
  };
  const bool isThere = stat(this->Target.c_str(), &present) == 0;
  if (isThere && !S_ISREG(present.st_mode))
  {
    return this->Fail(S_ISDIR(present.st_mode) ? EISDIR : EINVAL, error);
  }
  if (isThere && access(this->Target.c_str(), W_OK) != 0)
  {
    return this->Fail(errno, error);
  }
  if (isThere)
  {
    const int old = open(this->Target.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const bool isBeingWritten =
      old >= 0 && flock(old, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (old >= 0)
    {
      close(old);
    }
    if (isBeingWritten)
    {
      return this->Fail(EWOULDBLOCK, error);
    }
  }
  const mode_t mode = isThere ? present.st_mode & 0777 : 0666;
  this->IsPublished = false;
  this->Descriptor = OpenWithoutName(fs::path(this->Target).parent_path(), mode);
  if (this->Descriptor < 0)
  {
    const auto create = [this, mode](const char* name)
    {
      this->Descriptor =
        open(name, O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
      return this->Descriptor >= 0;
    };
    if (!this->TakePartialName(create))
    {
      return this->Fail(errno, error);
    }
  }
  // Where the system has no locks nothing is lost: IsIntact() notices another writer.
  (void)flock(this->Descriptor, LOCK_EX | LOCK_NB);
  if (isThere)
  {
    // Only root can give a file away. The mode comes after, as a change of owner changes it.
    const int given = fchown(this->Descriptor, present.st_uid, present.st_gid);
    (void)given;
    if (fchmod(this->Descriptor, present.st_mode & 07777) != 0)
    {
      return this->Fail(errno, error);
    }
  }
  return true;
}

bool OutputFile::Write(const void* bytes, std::size_t size, std::string& error)
{
  if (!this->IsOpen())
  {
    error = "No file is open to be written. Call Open() first.";
    return false;
  }
  const FileSizeSignalBlock block;
  const auto* next = static_cast<const unsigned char*>(bytes);
  while (size > 0)
  {
    const ssize_t written = write(this->Descriptor, next, size);
    if (written < 0 && errno == EINTR)
    {
      continue;
    }
    if (written <= 0)
    {
      return this->Fail(written < 0 ? errno : ENOSPC, error);
    }
    if (!this->IsAtEnd(written, error))
    {
      return false;
    }
    next += written;
    size -= static_cast<std::size_t>(written);
    this->Size += static_cast<std::uint64_t>(written);
  }
  return true;
}

/// Whether the bytes just written follow on the ones before; else they are taken back, as long as
/// they are the last. What is written goes to the end, so that it never fills what another program
/// has cut off.
bool OutputFile::IsAtEnd(std::int64_t written, std::string& error)
{
  const off_t end = lseek(this->Descriptor, 0, SEEK_CUR);
  if (end < 0 || static_cast<std::uint64_t>(end) == this->Size + written)
  {
    return true;
  }
  struct stat own
  {
  };
  const bool isLast = fstat(this->Descriptor, &own) == 0 && own.st_size == end;
  const bool isTaken = isLast && ftruncate(this->Descriptor, end - written) == 0;
  error = this->ChangeOf(static_cast<std::uint64_t>(isTaken ? end - written : own.st_size));
  return false;
}

std::string OutputFile::ChangeOf(std::uint64_t size) const
{
  return this->FileName + " was changed by another program while it was written: it has " +
    std::to_string(size) + " bytes instead of " + std::to_string(this->Size) + ".";
}

bool OutputFile::Sync(std::string& error)
{
  return fsync(this->Descriptor) == 0 || this->Fail(errno, error);
}

bool OutputFile::WriteWhole(
  const std::string& fileName, const void* bytes, std::size_t size, std::string& error)
{
  OutputFile file;
  return file.Open(fileName, error) && file.Write(bytes, size, error) && file.Sync(error) &&
    file.Publish(error) && file.Close(error);
}

template <typename Take>
bool OutputFile::TakePartialName(const Take& take)
{
  static std::atomic<unsigned> count{ 0 };
  constexpr std::size_t longestBase = 200; // with what is added a name may have 255 bytes
  const fs::path target = this->Target;
  do
  {
    const std::string name = "." + target.filename().string().substr(0, longestBase) + "." +
      std::to_string(getpid()) + "-" + std::to_string(count++) + ".part";
    this->Partial = (target.parent_path() / name).string();
    if (take(this->Partial.c_str()))
    {
      return true;
    }
  } while (errno == EEXIST);
  this->Partial.clear();
  return false;
}

bool OutputFile::Publish(std::string& error)
{
  if (this->IsPublished)
  {
    return true;
  }
  const std::string handle = DescriptorFolder + std::to_string(this->Descriptor);
  const auto link = [&handle](const char* name)
  { return linkat(AT_FDCWD, handle.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0; };
  // No call puts a file without a name in place of another: it takes a name for a moment.
  if (this->Partial.empty() && !this->TakePartialName(link))
  {
    return this->Fail(errno, error);
  }
  if (std::rename(this->Partial.c_str(), this->Target.c_str()) != 0)
  {
    return this->Fail(errno, error);
  }
  this->Partial.clear();
  this->IsPublished = true;
  return true;
}

void OutputFile::Truncate(std::uint64_t size)
{
  if (size < this->Size && ftruncate(this->Descriptor, static_cast<off_t>(size)) == 0)
  {
    this->Size = size;
  }
}

bool OutputFile::IsIntact(std::uint64_t& bytesLeft, std::string& error) const
{
  struct stat own
  {
  };
  struct stat named
  {
  };
  bytesLeft = this->Size;
  if (fstat(this->Descriptor, &own) != 0)
  {
    return true; // nothing is known
  }
  const bool isNamed = stat(this->Target.c_str(), &named) == 0;
  if (!isNamed || named.st_ino != own.st_ino || named.st_dev != own.st_dev)
  {
    bytesLeft = 0;
    error = this->FileName + " was " + (isNamed ? "replaced" : "deleted or moved away") +
      " while it was written.";
    return false;
  }
  const auto size = static_cast<std::uint64_t>(own.st_size);
  if (size != this->Size)
  {
    bytesLeft = std::min(size, this->Size);
    error = this->ChangeOf(size);
    return false;
  }
  return true;
}

bool OutputFile::Close(std::string& error)
{
  if (!this->IsOpen())
  {
    return true;
  }
  const bool isClosed = close(std::exchange(this->Descriptor, -1)) == 0;
  const int cause = errno;
  if (!this->IsPublished)
  {
    if (!this->Partial.empty())
    {
      std::remove(this->Partial.c_str());
      this->Partial.clear();
    }
    return true;
  }
  return isClosed || this->Fail(cause, error);
}
}
