// The SpaceMouse through libspnav against a daemon that speaks spacenavd's protocol.
#include "DriverTest.h"
#include "haptics/Devices/DeviceChannel.h"
#include "haptics/Devices/EndingSignals.h"
#include "vtkNew.h"
#include "vtkSpaceMouseHapticDevice.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

// libspnav itself leaks 48 bytes whenever no daemon answers.
extern "C" const char* __lsan_default_suppressions()
{
  return "leak:spnav_open";
}

namespace
{
using Packet = std::array<std::int32_t, 8>;

enum : std::int32_t
{
  Motion = 0,
  Press = 1,
  Release = 2,
  DeviceChange = 3,
  Tag = 0x7faa0000,
  ChangeProtocol = 0x5500,
  DeviceName = 0x2000
};

/// Speaks the protocol's version 1, or 0, which answers no request.
class FakeDaemon
{
public:
  explicit FakeDaemon(bool isOld = false, bool hasDevice = true)
    : IsOld(isOld)
    , HasDevice(hasDevice)
    , Path(std::string(testing::TempDir()) + "/spnav-" + std::to_string(getpid()))
    , Listener(socket(AF_UNIX, SOCK_STREAM, 0))
  {
    unlink(this->Path.c_str());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, this->Path.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(this->Listener, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    listen(this->Listener, 1);
    setenv("SPNAV_SOCKET", this->Path.c_str(), 1);
    this->Thread = std::thread([this] { this->Run(); });
  }
  ~FakeDaemon() { this->End(); }

  void End()
  {
    this->IsEnding = true;
    if (this->Thread.joinable())
    {
      this->Thread.join();
      close(this->Listener);
      unlink(this->Path.c_str());
    }
  }
  void Send(const Packet& packet)
  {
    EXPECT_TRUE(WaitFor([this] { return this->Client >= 0; }));
    EXPECT_EQ(send(this->Client, packet.data(), sizeof(packet), MSG_NOSIGNAL),
      static_cast<ssize_t>(sizeof(packet)));
  }

private:
  void Run()
  {
    haptics::LeaveEndingSignalsToOtherThreads();
    while (!this->IsEnding)
    {
      pollfd watched[2] = { { this->Listener, POLLIN, 0 }, { this->Client, POLLIN, 0 } };
      poll(watched, this->Client >= 0 ? 2 : 1, 10);
      if ((watched[0].revents & POLLIN) != 0)
      {
        this->Client = accept(this->Listener, nullptr, nullptr);
      }
      else if (this->Client >= 0 && (watched[1].revents & (POLLIN | POLLHUP)) != 0)
      {
        this->Answer();
      }
    }
    if (this->Client >= 0)
    {
      close(this->Client);
    }
  }
  void Answer()
  {
    Packet request{};
    const ssize_t size = recv(this->Client, request.data(), sizeof(request), 0);
    if (size <= 0)
    {
      close(this->Client);
      this->Client = -1;
    }
    else if (!this->IsOld && size == 4 && (request[0] & 0xffffff00) == (Tag | ChangeProtocol))
    {
      const std::int32_t answer = Tag | ChangeProtocol | 1;
      send(this->Client, &answer, sizeof(answer), MSG_NOSIGNAL);
    }
    else if (!this->IsOld && request[0] == (Tag | DeviceName))
    {
      const char name[] = "SpaceNavigator";
      std::memcpy(&request[1], name, sizeof(name));
      request[7] = this->HasDevice ? static_cast<std::int32_t>(sizeof(name) - 1) : -1;
      send(this->Client, request.data(), sizeof(request), MSG_NOSIGNAL);
    }
  }

  const bool IsOld;

public:
  std::atomic<bool> HasDevice;

private:
  const std::string Path;
  const int Listener;
  std::atomic<int> Client{ -1 };
  std::atomic<bool> IsEnding{ false };
  std::thread Thread;
};

class SpaceMouse : public testing::Test
{
protected:
  void Open()
  {
    ASSERT_TRUE(WaitUntilOpen(this->Device)) << this->Device->GetErrorMessage();
    this->Channel = this->Device->GetChannel();
  }
  Vec Read()
  {
    haptics::DeviceSample sample;
    this->Channel->WaitForSample(4000000);
    this->Time += 0.001;
    this->IsThere = this->Channel->Read(this->Time, sample);
    this->Channel->Write({ 0.0, 0.0, 1.0 });
    this->Buttons = sample.Buttons;
    return sample.Position;
  }

  vtkNew<vtkSpaceMouseHapticDevice> Device;
  std::shared_ptr<haptics::DeviceChannel> Channel;
  double Time = 0.0;
  bool IsThere = false;
  std::uint32_t Buttons = 0;
};

TEST_F(SpaceMouse, TheCapMovesTheHandAndLetGoItRests)
{
  FakeDaemon daemon;
  this->Open();
  EXPECT_STREQ(this->Device->GetModelName(), "SpaceNavigator");
  EXPECT_EQ(this->Read(), (Vec{ 0.0, 0.0, 0.05 })) << "in front";
  daemon.Send({ Motion, 350, 0, 0, 0, 0, 0, 8 });
  EXPECT_TRUE(WaitFor([this] { return this->Read()[0] > 0.005; }));
  daemon.Send({ Motion, 0, 0, 350, 0, 0, 0, 8 }); // away from the user
  EXPECT_TRUE(WaitFor([this] { return this->Read()[2] < 0.045; }));
  daemon.Send({ Motion, 0, 0, 0, 0, 0, 0, 8 });
  Vec last{};
  EXPECT_TRUE(WaitFor(
    [&]
    {
      const Vec now = this->Read();
      const bool rests = now == last;
      last = now;
      return rests;
    }));
  for (int i = 0; i < 20; ++i)
  {
    EXPECT_EQ(this->Read(), last);
  }
  EXPECT_EQ(last[1], 0.0);
}

TEST_F(SpaceMouse, ItGoesAsFastAsItsSpeedAndStaysWithinItsReach)
{
  FakeDaemon daemon;
  this->Device->SetSpeed(1.0);
  this->Open();
  daemon.Send({ Motion, -350, 0, 0, 0, 0, 0, 8 });
  EXPECT_TRUE(WaitFor([this] { return this->Read()[0] == -0.08; }));
  EXPECT_EQ(this->Read()[0], -0.08);
}

TEST_F(SpaceMouse, ASmallDeflectionMovesNothing)
{
  FakeDaemon daemon;
  this->Device->SetDeadZone(0.2);
  this->Open();
  daemon.Send({ Motion, 69, -69, 69, 300, 300, 300, 8 });
  daemon.Send({ Press, 0, 0, 0, 0, 0, 0, 0 });
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Read();
      return this->Buttons == 1;
    }));
  EXPECT_EQ(this->Read(), (Vec{ 0.0, 0.0, 0.05 }));
  daemon.Send({ Release, 0, 0, 0, 0, 0, 0, 0 });
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Read();
      return this->Buttons == 0;
    }));
}

TEST_F(SpaceMouse, ItSaysThatItCannotPushBackAndShowsTheForce)
{
  FakeDaemon daemon;
  EXPECT_FALSE(this->Device->GivesForce());
  this->Open();
  this->Read();
  double force[3];
  this->Device->GetForce(force);
  EXPECT_EQ(force[2], 1.0) << "what would be given is known, to be shown";
  vtkNew<vtkStringArray> ids;
  vtkNew<vtkStringArray> states;
  this->Device->Close();
  EXPECT_TRUE(WaitFor(
    [&]
    {
      states->Initialize();
      this->Device->FindDevices(ids, states);
      return Says(states->GetValue(0), "SpaceNavigator, ready; it moves the hand and cannot push");
    }))
    << states->GetValue(0);
}

TEST_F(SpaceMouse, AnOldDaemonDoes)
{
  FakeDaemon daemon(true);
  this->Open();
  EXPECT_STREQ(this->Device->GetModelName(), "SpaceMouse");
  daemon.Send({ Motion, 0, 350, 0, 0, 0, 0, 8 });
  EXPECT_TRUE(WaitFor([this] { return this->Read()[1] > 0.001; }));
}

TEST_F(SpaceMouse, NoDaemonIsSaid)
{
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  EXPECT_FALSE(WaitUntilOpen(this->Device));
  std::unique_ptr<FakeDaemon> daemon;
  ExpectRemedyOf(this->Device,
    "daemon does not run. Install and start spacenavd (Debian: apt install "
    "spacenavd), or set SPNAV_SOCKET to where it listens",
    [&] { daemon = std::make_unique<FakeDaemon>(); }); // which sets SPNAV_SOCKET
}

TEST_F(SpaceMouse, NoSpaceMouseIsSaid)
{
  FakeDaemon daemon(false, false);
  EXPECT_FALSE(WaitUntilOpen(this->Device));
  ExpectRemedyOf(this->Device, "no SpaceMouse is plugged in. Connect it, then open it again",
    [&] { daemon.HasDevice = true; });
}

TEST_F(SpaceMouse, UnpluggedAndADaemonThatEndsAreSaid)
{
  FakeDaemon daemon;
  this->Open();
  daemon.Send({ DeviceChange, 1, 0, 0, 0, 0, 0, 0 });
  EXPECT_TRUE(WaitForFault(this->Device));
  this->Read();
  EXPECT_FALSE(this->IsThere);
  ExpectRemedyOf(
    this->Device, "was unplugged. Connect it, then open it again", [] {}); // the daemon has it
  daemon.End();
  EXPECT_TRUE(WaitForFault(this->Device));
  std::unique_ptr<FakeDaemon> anew;
  ExpectRemedyOf(this->Device, "daemon has ended. Start spacenavd, then open the SpaceMouse again",
    [&] { anew = std::make_unique<FakeDaemon>(); });
}

TEST_F(SpaceMouse, ASecondObjectGetsTheErrorThatThereIsOneAProgram)
{
  FakeDaemon daemon;
  this->Open();
  vtkNew<vtkSpaceMouseHapticDevice> second;
  EXPECT_FALSE(WaitUntilOpen(second));
  ExpectRemedyOf(second, "Close that one, then open this", [this] { this->Device->Close(); });
}
}
