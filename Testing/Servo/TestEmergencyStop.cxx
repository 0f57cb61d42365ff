// A child process presses on a plane with a real servo thread and ends in one of many ways; the
// device is in memory that it shares with this one, which reads what the hand was left with.
#include "DefaultSignals.h"
#include "ServoTestTools.h"
#include "haptics/Servo/EmergencyStop.h"
#include "haptics/Servo/ServoLoop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <thread>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

// A child that exits while its servo runs leaves a thread behind: that is what is tested.
extern "C" const char* __tsan_default_options()
{
  return "report_thread_leaks=0";
}

namespace
{
/// What both processes see of the device.
struct SharedDevice
{
  std::atomic<double> Force{ 0.0 };   ///< [N] upwards, what was written last
  std::atomic<double> Largest{ 0.0 }; ///< [N]
  std::atomic<double> Growth{ 0.0 };  ///< the largest in a tick [N]
  std::atomic<bool> Throw{ false };
  std::atomic<bool> Survived{ false };
};

void ThrowDriversFault()
{
  throw std::runtime_error("a driver's fault");
}

class SharedChannel : public haptics::DeviceChannel
{
public:
  explicit SharedChannel(SharedDevice& device)
    : Device(device)
  {
  }
  bool Read(double time, haptics::DeviceSample& sample) noexcept override
  {
    if (this->Device.Throw)
    {
      ThrowDriversFault(); // leaves a noexcept function: std::terminate
    }
    sample.Position = { 0.0, 0.0, std::max(0.005 - 0.1 * time, -0.002) };
    return true;
  }
  void Write(const std::array<double, 3>& force) noexcept override
  {
    this->Device.Growth = std::max(this->Device.Growth.load(), force[2] - this->Device.Force);
    this->Device.Force = force[2];
    this->Device.Largest = std::max(this->Device.Largest.load(), force[2]);
  }

private:
  SharedDevice& Device;
};

/// Runs `end` in a child that is pressing with about 1 N; gives how the child ended.
/// `parent` has to be through first, where there is one.
template <typename Function>
int EndWhilePressing(
  SharedDevice& device, Function end, const std::function<void(pid_t)>& parent = nullptr)
{
  const pid_t child = fork();
  if (child == 0)
  {
    // Never destroyed: nothing but the emergency stop can take the force away.
    auto* cycle = new haptics::ServoCycle(1024);
    auto* statistics = new haptics::ServoStatistics;
    auto* loop = new haptics::ServoLoop(*cycle, *statistics);
    cycle->GetExchange().Publish(MakeGodObject(MakePlane()));
    cycle->Begin(std::make_shared<SharedChannel>(device), haptics::ServoState::Running);
    haptics::ServoTiming timing;
    timing.WatchdogTime = 60000000000;
    timing.StallLimit = 60000000000;
    timing.MissedShare = 60.0;
    std::string error;
    if (!loop->Start(timing, error))
    {
      _exit(99);
    }
    while (device.Force < 0.9)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    end(device);
    _exit(98);
  }
  if (parent)
  {
    parent(child);
    if (::testing::Test::HasFatalFailure())
    {
      kill(child, SIGKILL); // it may be stopped, and would be waited for without end
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

SharedDevice* HandlersDevice = nullptr;

class EmergencyStop : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Memory = mmap(
      nullptr, sizeof(SharedDevice), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(this->Memory, MAP_FAILED);
    this->Device = new (this->Memory) SharedDevice;
  }
  void TearDown() override
  {
    EXPECT_GE(this->Device->Largest, 0.9) << "the hand was pressing";
    EXPECT_EQ(this->Device->Force, 0.0) << "what the hand was left with";
    munmap(this->Memory, sizeof(SharedDevice));
  }

  void* Memory = nullptr;
  SharedDevice* Device = nullptr;
};

TEST_F(EmergencyStop, SignalsTakeTheForceAwayAndStillEndTheProcess)
{
  for (const int signal : { SIGTERM, SIGINT, SIGHUP, SIGQUIT })
  {
    this->Device->Force = 0.0;
    const int status = EndWhilePressing(*this->Device, [signal](SharedDevice&) { raise(signal); });
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(this->Device->Force, 0.0) << signal;
  }
}

TEST_F(EmergencyStop, SoDoSignalsThatNobodyHandles)
{
  for (const int signal : { SIGPIPE, SIGXFSZ, SIGALRM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF,
         SIGXCPU, SIGIO, SIGPWR, SIGABRT })
  {
    this->Device->Force = 0.0;
    const int status = EndWhilePressing(*this->Device, [signal](SharedDevice&) { raise(signal); });
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(this->Device->Force, 0.0) << signal;
  }
}

TEST_F(EmergencyStop, ABrokenPipeDoesToo)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      int ends[2];
      if (pipe(ends) == 0 && close(ends[0]) == 0)
      {
        (void)!write(ends[1], "x", 1);
      }
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGPIPE);
}

#if !defined(__SANITIZE_ADDRESS__) &&                                                              \
  !defined(__SANITIZE_THREAD__) // they have handlers of their own
TEST_F(EmergencyStop, ACrashDoesTooAndEndsTheProcessAsItWouldHave)
{
  for (const int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS })
  {
    this->Device->Force = 0.0;
    const int status = EndWhilePressing(*this->Device, [signal](SharedDevice&) { raise(signal); });
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(WTERMSIG(status), signal);
    EXPECT_EQ(this->Device->Force, 0.0) << signal;
  }
  // A real one, in a thread of the program's.
  this->Device->Force = 0.0;
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      std::thread other(
        []
        {
          volatile int* nowhere = nullptr;
          *nowhere = 1;
        });
      other.join();
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGSEGV);
}
#endif

TEST_F(EmergencyStop, AbortAndQuickExitDoToo)
{
  int status = EndWhilePressing(*this->Device, [](SharedDevice&) { std::abort(); });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
  EXPECT_EQ(this->Device->Force, 0.0);
  this->Device->Force = 0.0;
  status = EndWhilePressing(*this->Device, [](SharedDevice&) { std::quick_exit(4); });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
}

// Ctrl+Z: the hand has nothing while the process is stopped, and its force comes back softly.
TEST_F(EmergencyStop, AStopTakesTheForceAwayUntilTheProcessGoesOn)
{
  for (const int signal : { SIGTSTP, SIGTTIN, SIGTTOU })
  {
    this->Device->Force = 0.0;
    const auto parent = [&](pid_t child)
    {
      for (int times = 0; times < 2; ++times)
      {
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, WUNTRACED), child);
        ASSERT_TRUE(WIFSTOPPED(status)) << signal;
        EXPECT_EQ(WSTOPSIG(status), signal);
        EXPECT_EQ(this->Device->Force, 0.0) << "while it is stopped";
        std::this_thread::sleep_for(std::chrono::milliseconds(700)); // more than a stall may last
        EXPECT_EQ(this->Device->Force, 0.0);
        this->Device->Growth = 0.0;
        kill(child, SIGCONT);
      }
    };
    const int status = EndWhilePressing(
      *this->Device,
      [signal](SharedDevice& device)
      {
        setpgid(0, 0); // a job of its own: one without a parent in its terminal is not stopped
        for (int times = 0; times < 2; ++times)
        {
          kill(getpid(), signal);
          while (device.Force < 0.9)
          {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }
        std::exit(5);
      },
      parent);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 5);
    EXPECT_GT(this->Device->Growth, 0.0);
    EXPECT_LE(this->Device->Growth, 2.0 * 3.3 * 0.001 / 0.1 + 1e-9) << "of a late tick: two";
  }
}

TEST_F(EmergencyStop, ASignalThatTheProgramHandlesLeavesTheForce)
{
  HandlersDevice = this->Device;
  const auto previous =
    std::signal(SIGUSR1, [](int) { HandlersDevice->Survived = HandlersDevice->Force > 0.9; });
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice& device)
    {
      raise(SIGUSR1);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      std::exit(device.Survived && device.Force > 0.9 ? 6 : 97);
    });
  std::signal(SIGUSR1, previous);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 6);
}

TEST_F(EmergencyStop, ASignalOfAnotherProcessDoesToo)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      const pid_t self = getpid();
      if (fork() == 0)
      {
        kill(self, SIGTERM);
        _exit(0);
      }
      std::this_thread::sleep_for(std::chrono::seconds(20));
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(EmergencyStop, AHandlerThatWasThereBeforeIsStillCalled)
{
  HandlersDevice = this->Device;
  const auto previous =
    std::signal(SIGINT, [](int) { HandlersDevice->Survived = HandlersDevice->Force == 0.0; });
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      raise(SIGINT);
      _exit(7); // the handler did not end the process
    });
  std::signal(SIGINT, previous);
  EXPECT_TRUE(this->Device->Survived) << "and the force was gone by then";
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

struct sigaction TakenOver;

/// Puts a handler in the place of the servo's, as Jupyter does before each cell, and waits until
/// the servo has taken the signal back.
void SetHandlerWhilePressing(void (*handler)(int))
{
  struct sigaction mine
  {
  };
  mine.sa_handler = handler;
  sigaction(SIGINT, &mine, &TakenOver);
  struct sigaction present = mine;
  while ((present.sa_flags & SA_SIGINFO) == 0 && present.sa_handler == handler)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    sigaction(SIGINT, nullptr, &present);
  }
}

TEST_F(EmergencyStop, AHandlerThatIsSetWhilePressingIsCalledWithTheForceGone)
{
  HandlersDevice = this->Device;
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      SetHandlerWhilePressing([](int) { HandlersDevice->Survived = HandlersDevice->Force == 0.0; });
      raise(SIGINT);
      _exit(7);
    });
  EXPECT_TRUE(this->Device->Survived);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST_F(EmergencyStop, AHandlerThatCallsTheOneItHasReplacedEnds)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      SetHandlerWhilePressing([](int signal) { TakenOver.sa_sigaction(signal, nullptr, nullptr); });
      raise(SIGINT); // there was none before: the process dies of it
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
}

TEST_F(EmergencyStop, AnInterruptOnTheWayIntoAnEventLoopIsItsEnd)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      using Stop = haptics::EmergencyStop;
      SetHandlerWhilePressing([](int) {});
      Stop::CountInterrupts();
      raise(SIGINT);
      const bool isNew = Stop::CountInterruptsBeforeLoop() == 0 && Stop::CountInterrupts() == 1;
      const bool isNextLoops = Stop::CountInterruptsBeforeLoop() == 0;
      raise(SIGINT); // which the program has dealt with, and a loop begins much later
      std::this_thread::sleep_for(std::chrono::milliseconds(1100));
      const bool isOld = Stop::CountInterruptsBeforeLoop() == 2;
      _exit(isNew && !isNextLoops && isOld ? 7 : 8);
    });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST_F(EmergencyStop, ExitTakesTheForceAway)
{
  const int status = EndWhilePressing(*this->Device, [](SharedDevice&) { std::exit(3); });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
}

TEST_F(EmergencyStop, AnExceptionThatNobodyCatchesTakesTheForceAway)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice&)
    {
      std::thread thrower([] { throw std::runtime_error("nobody's"); });
      thrower.join();
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
}

TEST_F(EmergencyStop, AnExceptionInTheServoThreadItselfTakesTheForceAway)
{
  const int status = EndWhilePressing(*this->Device,
    [](SharedDevice& device)
    {
      device.Throw = true;
      std::this_thread::sleep_for(std::chrono::seconds(20));
    });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGABRT);
}
}
