// A child process presses on a plane with a Falcon on a USB bus of its own and ends in one of many
// ways; the last packet that the Falcon got is in memory shared with this process.
#include "DefaultSignals.h"
#include "FalconEncoders.h"
#include "ServoTestTools.h"
#include "UsbFs.h"
#include "WaitFor.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/Falcon/FalconPacket.h"
#include "vtkFalconHapticDevice.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

// A child that ends while it presses leaves threads behind: that is what is tested. Under
// ThreadSanitizer each of these tests needs a process of its own, as ctest gives it: signals do not
// come through in the child of a process that has had other threads.
extern "C" const char* __tsan_default_options()
{
  return "report_thread_leaks=0";
}

namespace
{
constexpr int NeverPressed = 97;
constexpr int CameBack = 98;

/// What the Falcon got, for both processes.
struct Received
{
  std::atomic<bool> Pushes{ false }; ///< in the last packet
  std::atomic<bool> HasPushed{ false };
};

void TakeEndingSignals()
{
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// Presses 2 mm into a plane; nothing is ever destroyed.
bool Press(UsbFs& bus, Received& received, const char* guardian)
{
  FalconModel model;
  model.Encoders = EncodersAt({ 0.0, 0.0, 0.131 });
  model.OnCommand = [&received](const haptics::FalconCommand& command)
  {
    received.Pushes = command.Torques != std::array<std::int16_t, 3>{};
    received.HasPushed = received.HasPushed || received.Pushes;
  };
  bus.Plug(1, model);
  static auto* const device = vtkFalconHapticDevice::New(); // static: no leak
  device->SetGuardianProgram(guardian);
  device->Open();
  static auto* const servo = vtkHapticServo::New();
  servo->SetDevice(device);
  servo->SetStallLimit(60.0);
  servo->GetSafety()->LoosenWatchdogTime(1.0);
  servo->GetSafety()->LoosenMissedTickShare(60.0);
  servo->PublishGodObject(MakeGodObject(MakePlane(0.13, 0.1)));
  const auto isOpen = []
  {
    device->Update();
    return device->IsOpen();
  };
  if (!WaitFor(isOpen) || !servo->Start() ||
    !WaitFor([] { return servo->GetNumberOfTicks() > 50; }))
  {
    return false;
  }
  bus.With(1, [](FalconModel& pressed) { pressed.Encoders = EncodersAt({ 0.0, 0.0, 0.128 }); });
  return WaitFor([&received] { return received.Pushes.load(); });
}

class FalconEmergencyStop : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!UsbFs::IsPossible())
    {
      GTEST_SKIP() << "There are no pseudo-terminals here: mount devpts at /dev/pts.";
    }
    this->Memory =
      mmap(nullptr, sizeof(Received), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(this->Memory, MAP_FAILED);
  }
  void TearDown() override
  {
    if (this->Memory)
    {
      munmap(this->Memory, sizeof(Received));
    }
  }

  /// Runs `end` in a child that presses; gives how the child ended.
  template <typename Function>
  int EndWhilePressing(Function end)
  {
    int status = 0;
    waitpid(this->StartPressing(end, ""), &status, 0);
    const auto* received = static_cast<Received*>(this->Memory);
    EXPECT_TRUE(received->HasPushed);
    EXPECT_FALSE(received->Pushes) << "the last packet that the Falcon got";
    return status;
  }

  /// The child that does so.
  template <typename Function>
  pid_t StartPressing(Function end, const char* guardian)
  {
    auto* received = new (this->Memory) Received;
    const pid_t child = fork();
    if (child == 0)
    {
      haptics::LeaveEndingSignalsToOtherThreads(); // the bus is no thread of ours, and must go on
      static auto* const bus = new UsbFs;
      TakeEndingSignals();
      if (!Press(*bus, *received, guardian))
      {
        _exit(NeverPressed);
      }
      end(*bus);
      _exit(CameBack);
    }
    return child;
  }

  void* Memory = nullptr;
};

TEST_F(FalconEmergencyStop, TheLastPacketBeforeASignalEndsTheProcessIsZero)
{
  for (const int signal : { SIGTERM, SIGINT, SIGQUIT })
  {
    const int status = this->EndWhilePressing([signal](UsbFs&) { raise(signal); });
    ASSERT_TRUE(WIFSIGNALED(status)) << status;
    EXPECT_EQ(WTERMSIG(status), signal);
  }
}

TEST_F(FalconEmergencyStop, NoThreadThatTheZeroNeedsTakesASignalToTheProcess)
{
  const int status = this->EndWhilePressing(
    [](UsbFs&)
    {
      haptics::LeaveEndingSignalsToOtherThreads();
      kill(getpid(), SIGTERM);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      TakeEndingSignals(); // nobody did so far
      std::this_thread::sleep_for(std::chrono::seconds(20));
    });
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(FalconEmergencyStop, TheLastPacketIsZeroThoughRepliesAreLostJustThen)
{
  const int status = this->EndWhilePressing(
    [](UsbFs& bus)
    {
      bus.With(1,
        [](FalconModel& model) {
          model.Script = { { At::Serve, 0, Do::Silence, Always } };
        });
      raise(SIGTERM);
    });
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(FalconEmergencyStop, TheLastPacketBeforeTheProcessExitsIsZero)
{
  const int status = this->EndWhilePressing([](UsbFs&) { std::exit(3); });
  ASSERT_TRUE(WIFEXITED(status)) << status;
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_F(FalconEmergencyStop, TheLastPacketBeforeAnExceptionThatNobodyCatchesIsZero)
{
  const int status = this->EndWhilePressing(
    [](UsbFs&)
    {
      std::thread thrower([] { throw std::runtime_error("nobody's"); });
      thrower.join();
    });
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
}

/// What no program can catch: there is nobody left to send a packet but the guardian, whose bus
/// (GuardianBus.cxx) writes down what the device gets.
class FalconGuarded : public FalconEmergencyStop
{
protected:
  void SetUp() override
  {
    FalconEmergencyStop::SetUp();
    this->Name = testing::TempDir() + "guardian-" + std::to_string(getpid()) + ".log";
    setenv("HAPTICS_GUARDIAN_LOG", this->Name.c_str(), 1);
    std::remove(this->Name.c_str());
  }
  void TearDown() override
  {
    std::remove(this->Name.c_str());
    FalconEmergencyStop::TearDown();
  }

  std::string Log() const
  {
    std::ifstream file(this->Name);
    return { std::istreambuf_iterator<char>(file), {} };
  }
  /// The zero packet, three times, after the device was taken.
  static std::string ZeroPackets()
  {
    std::string line;
    for (const std::uint8_t byte : haptics::Encode(haptics::FalconCommand()))
    {
      constexpr char digits[] = "0123456789abcdef";
      line += { digits[byte >> 4], digits[byte & 15] };
    }
    return "claim\n" + line + "\n" + line + "\n" + line + "\n";
  }
  bool GetsZero() const
  {
    return WaitFor([this] { return this->Log() == ZeroPackets(); });
  }

  std::string Name;
};

TEST_F(FalconGuarded, TheFalconGetsZeroAfterTheProcessWasKilled)
{
  const std::vector<std::function<void(UsbFs&)>> ends{
    [](UsbFs&) { raise(SIGKILL); },
    [](UsbFs&)
    {
      signal(SIGSEGV, SIG_DFL); // not the sanitizers'
      raise(SIGSEGV);
    },
    [](UsbFs&) { _exit(5); },
  };
  for (const auto& end : ends)
  {
    std::remove(this->Name.c_str());
    int status = 0;
    waitpid(this->StartPressing(end, HAPTICS_TEST_GUARDIAN), &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 5) << status;
    EXPECT_TRUE(static_cast<Received*>(this->Memory)->Pushes) << "nobody here could send a zero";
    EXPECT_TRUE(this->GetsZero()) << this->Log();
  }
}

TEST_F(FalconGuarded, EachDeviceHasTheGuardianThatIsInstalledWithTheLibrary)
{
  vtkNew<vtkFalconHapticDevice> device;
  const std::filesystem::path program = device->GetGuardianProgram();
  EXPECT_EQ(program.filename(), "falcon-guardian");
  EXPECT_EQ(access(program.c_str(), X_OK), 0) << program;
}

TEST_F(FalconGuarded, TheFalconGetsZeroWhileTheProcessIsStopped)
{
  const pid_t child = this->StartPressing([](UsbFs&) { raise(SIGSTOP); }, HAPTICS_TEST_GUARDIAN);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
  ASSERT_TRUE(WIFSTOPPED(status)) << status;
  EXPECT_TRUE(static_cast<Received*>(this->Memory)->Pushes);
  EXPECT_TRUE(this->GetsZero()) << this->Log();
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
}

TEST_F(FalconGuarded, TheGuardianLeavesTheFalconAloneWhereTheProcessTookTheForceItself)
{
  // The number of the guardian goes to this test through a pipe.
  for (const int signal : { SIGTERM, SIGKILL })
  {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = this->StartPressing(
      [signal, &ends](UsbFs& bus)
      {
        pid_t guardian = 0;
        for (const auto& task : std::filesystem::directory_iterator("/proc/self/task"))
        {
          std::ifstream(task.path() / "children") >> guardian;
          if (guardian > 0)
          {
            break;
          }
        }
        if (signal == SIGKILL) // after the hand has gone from the plane
        {
          bus.With(1,
            [](FalconModel& pressed) {
              pressed.Encoders = EncodersAt({ 0.0, 0.0, 0.135 });
            });
          std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        if (write(ends[1], &guardian, sizeof(guardian)) == sizeof(guardian))
        {
          raise(signal);
        }
      },
      HAPTICS_TEST_GUARDIAN);
    close(ends[1]);
    pid_t guardian = 0;
    ASSERT_EQ(read(ends[0], &guardian, sizeof(guardian)), static_cast<ssize_t>(sizeof(guardian)));
    close(ends[0]);
    ASSERT_GT(guardian, 0);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << status;
    EXPECT_FALSE(static_cast<Received*>(this->Memory)->Pushes);
    const auto isGone = [guardian]
    {
      std::ifstream file("/proc/" + std::to_string(guardian) + "/stat");
      std::string number;
      std::string name;
      std::string state;
      return !(file >> number >> name >> state) || state == "Z";
    };
    EXPECT_TRUE(WaitFor(isGone)) << "it goes with its process";
    EXPECT_EQ(this->Log(), "");
  }
}
}
