#include "../TemporaryFolder.h"
#include "haptics/Files/OutputFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <csignal>
#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
using haptics::OutputFile;

namespace
{
/// Each test in an empty folder of its own.
class OutputFileTest : public ::testing::Test
{
public:
  std::string Path(const char* name) const { return (this->Folder / name).string(); }
  static void Put(const std::string& name, const std::string& text) { std::ofstream(name) << text; }
  static std::string Text(const std::string& name)
  {
    std::ifstream file(name);
    return { std::istreambuf_iterator<char>(file), {} };
  }
  static mode_t Mode(const std::string& name)
  {
    struct stat status
    {
    };
    EXPECT_EQ(stat(name.c_str(), &status), 0) << name;
    return status.st_mode & 07777;
  }
  std::size_t NumberOfFiles() const
  {
    return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator()));
  }
  /// Empty, or the error.
  static std::string Replace(const std::string& name, const std::string& text)
  {
    std::string error;
    if (OutputFile::WriteWhole(name, text.data(), text.size(), error))
    {
      return "";
    }
    EXPECT_NE(error, "");
    return error;
  }

  const TemporaryFolder Own;
  const fs::path Folder = this->Own.Path;
};

TEST_F(OutputFileTest, IsSeenOnceItIsWholeAndLeavesNothingElse)
{
  const std::string name = this->Path("a.csv");
  Put(name, "old");
  OutputFile file;
  std::string error;
  ASSERT_TRUE(file.Open(name, error)) << error;
  ASSERT_TRUE(file.Write("new", 3, error)) << error;
  EXPECT_EQ(Text(name), "old");
  ASSERT_TRUE(file.Publish(error)) << error;
  EXPECT_EQ(Text(name), "new");
  ASSERT_TRUE(file.Write("er", 2, error)) << error;
  ASSERT_TRUE(file.Close(error)) << error;
  EXPECT_EQ(Text(name), "newer");
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(OutputFileTest, ThatIsDroppedLeavesTheOldOneAndNoRemains)
{
  const std::string name = this->Path("a.csv");
  Put(name, "old");
  std::string error;
  {
    OutputFile file;
    ASSERT_TRUE(file.Open(name, error)) << error;
    ASSERT_TRUE(file.Write("new", 3, error)) << error;
  }
  EXPECT_EQ(Text(name), "old");
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(OutputFileTest, KeepsTheModeOfTheOldOneAndGoesByTheUmaskElse)
{
  const mode_t before = umask(0);
  for (const mode_t mask : { 0022, 0077, 0002 })
  {
    umask(mask);
    const std::string name = this->Path(("new" + std::to_string(mask)).c_str());
    EXPECT_EQ(Replace(name, "x"), "");
    EXPECT_EQ(Mode(name), 0666 & ~mask) << mask;
    for (const mode_t mode : { 0600, 0640, 0664, 0444 | 0200 })
    {
      ASSERT_EQ(chmod(name.c_str(), mode), 0);
      EXPECT_EQ(Replace(name, "y"), "");
      EXPECT_EQ(Mode(name), mode) << mask;
    }
  }
  umask(before);
}

TEST_F(OutputFileTest, FollowsLinksAndLeavesThem)
{
  fs::create_directory(this->Folder / "real");
  Put(this->Path("real/a"), "old");
  fs::create_symlink("real/a", this->Path("near"));          // relative to its folder
  fs::create_symlink(this->Path("near"), this->Path("far")); // of a link
  EXPECT_EQ(Replace(this->Path("far"), "new"), "");
  EXPECT_TRUE(fs::is_symlink(this->Path("near")) && fs::is_symlink(this->Path("far")));
  EXPECT_EQ(Text(this->Path("real/a")), "new");
  fs::create_symlink("real/none", this->Path("dangling"));
  EXPECT_EQ(Replace(this->Path("dangling"), "new"), "");
  EXPECT_EQ(Text(this->Path("real/none")), "new");
  fs::create_symlink("round", this->Path("round"));
  EXPECT_NE(Replace(this->Path("round"), "new"), "");
}

TEST_F(OutputFileTest, RefusesWhatIsNoRegularFileWithoutWaiting)
{
  ASSERT_EQ(mkfifo(this->Path("fifo").c_str(), 0600), 0);
  fs::create_directory(this->Folder / "folder");
  for (const std::string& name : { this->Path("fifo"), std::string("/dev/full"),
         this->Path("folder"), this->Path("folder/"), this->Path("."), std::string() })
  {
    const std::string error = Replace(name, "x");
    EXPECT_NE(error.find(name), std::string::npos) << name << ": " << error;
    EXPECT_NE(error.find("hoose"), std::string::npos) << "no advice: " << error;
  }
  EXPECT_NE(Replace(this->Path("none/a"), "x").find("Make its folder first"), std::string::npos);
  EXPECT_EQ(this->NumberOfFiles(), 2u);
}

TEST_F(OutputFileTest, OfALongNameIsWritten)
{
  EXPECT_EQ(Replace(this->Path(std::string(250, 'a').c_str()), "x"), "");
}

TEST_F(OutputFileTest, RefusesWhatIsBeingWritten)
{
  const std::string name = this->Path("a");
  OutputFile first;
  std::string error;
  ASSERT_TRUE(first.Open(name, error) && first.Publish(error)) << error;
  EXPECT_NE(Replace(name, "second").find("being written already"), std::string::npos);
  ASSERT_TRUE(first.Write("first", 5, error) && first.Close(error)) << error;
  EXPECT_EQ(Text(name), "first");
  EXPECT_EQ(Replace(name, "second"), "");
}

TEST_F(OutputFileTest, NoticesWhatOthersDoToIt)
{
  const std::string name = this->Path("a");
  OutputFile file;
  std::string error;
  std::uint64_t left = 0;
  const auto begin = [&]
  {
    ASSERT_TRUE(file.Open(name, error) && file.Publish(error) && file.Write("12345", 5, error));
    ASSERT_TRUE(file.IsIntact(left, error)) << error;
    ASSERT_EQ(left, 5u);
  };
  begin();
  fs::resize_file(name, 2);
  EXPECT_FALSE(file.IsIntact(left, error));
  EXPECT_EQ(left, 2u);
  EXPECT_NE(error.find("2 bytes instead of 5"), std::string::npos) << error;
  begin();
  fs::remove(name);
  EXPECT_FALSE(file.IsIntact(left, error));
  EXPECT_EQ(left, 0u);
  EXPECT_NE(error.find("deleted"), std::string::npos) << error;
  begin();
  Put(this->Path("b"), "other");
  fs::rename(this->Path("b"), name);
  EXPECT_FALSE(file.IsIntact(left, error));
  EXPECT_NE(error.find("replaced"), std::string::npos) << error;
  EXPECT_TRUE(file.Close(error));
  EXPECT_EQ(Text(name), "other");
}

// Written where the file ended before, it would fill what was cut off with zeros, and nobody would
// notice.
TEST_F(OutputFileTest, IsNotWrittenOnAfterAnotherHasCutItOrAddedToIt)
{
  const std::string name = this->Path("a");
  OutputFile file;
  std::string error;
  std::uint64_t left = 0;
  for (const char* const found : { "", "12", "1234567" })
  {
    ASSERT_TRUE(file.Open(name, error) && file.Publish(error) && file.Write("12345", 5, error));
    const std::string text = found;
    if (text.size() < 5)
    {
      fs::resize_file(name, text.size());
    }
    else
    {
      std::ofstream(name, std::ios::app) << text.substr(5);
    }
    EXPECT_FALSE(file.Write("abcde", 5, error)) << found;
    EXPECT_NE(error.find(std::to_string(text.size()) + " bytes instead of 5"), std::string::npos)
      << error;
    EXPECT_EQ(Text(name), text);
    EXPECT_EQ(file.GetSize(), 5u);
    EXPECT_FALSE(file.IsIntact(left, error));
    EXPECT_EQ(left, std::min<std::size_t>(text.size(), 5));
    EXPECT_TRUE(file.Close(error)) << error;
  }
}

TEST_F(OutputFileTest, BeyondTheLimitOnFilesIsAnErrorAndNoSignal)
{
  const std::string name = this->Path("a");
  Put(name, "old");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const rlim_t most : { 0, 1, 1000, 4096 })
  {
    const rlimit limit{ most, before.rlim_max };
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const std::string error = Replace(name, std::string(5000, 'x'));
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_NE(error.find("ulimit -f"), std::string::npos) << error;
    EXPECT_EQ(Text(name), "old");
    EXPECT_EQ(this->NumberOfFiles(), 1u);
  }
}

TEST_F(OutputFileTest, OfAProcessThatWasKilledLeavesNoRemains)
{
  const int probe = open(this->Folder.c_str(), O_WRONLY | O_TMPFILE, 0600);
  if (probe < 0)
  {
    GTEST_SKIP() << "this file system has no files without names";
  }
  close(probe);
  const std::string name = this->Path("a");
  Put(name, "old");
  const pid_t child = fork();
  if (child == 0)
  {
    OutputFile file;
    std::string error;
    if (file.Open(name, error) && file.Write("new", 3, error) && file.Sync(error))
    {
      raise(SIGKILL);
    }
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(Text(name), "old");
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(OutputFileTest, GoesWhereItIsRun)
{
  const fs::path before = fs::current_path();
  fs::current_path(this->Folder);
  EXPECT_EQ(Replace("here", "new"), "");
  EXPECT_EQ(Replace("./here", "newer"), "");
  fs::current_path(before);
  EXPECT_EQ(Text(this->Path("here")), "newer");
  EXPECT_EQ(this->NumberOfFiles(), 1u);
}

TEST_F(OutputFileTest, OnAFullDiskLeavesTheOldOneAndNoRemains)
{
  // A disk of 64 kB that only this child sees.
  const pid_t child = fork();
  if (child == 0)
  {
    if (unshare(CLONE_NEWNS) != 0 ||
      mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", this->Folder.c_str(), "tmpfs", 0, "size=64k") != 0)
    {
      _exit(77);
    }
    const std::string name = this->Path("a");
    Put(name, "old");
    bool isRight = true;
    for (const std::size_t size : { 70000, 1000000 })
    {
      const std::string error = Replace(name, std::string(size, 'x'));
      isRight = isRight && error.find("No space left") != std::string::npos &&
        error.find("Free some space") != std::string::npos && Text(name) == "old" &&
        this->NumberOfFiles() == 1;
    }
    isRight =
      isRight && Replace(name, std::string(30000, 'y')).empty() && Text(name).size() == 30000;
    _exit(isRight ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "by signal " << WTERMSIG(status);
  if (WEXITSTATUS(status) == 77)
  {
    GTEST_SKIP() << "needs the right to mount a small disk, as root has it";
  }
  EXPECT_EQ(WEXITSTATUS(status), 0);
}
}
