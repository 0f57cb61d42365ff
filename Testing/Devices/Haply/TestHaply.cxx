// The driver of the Inverse3 against a service that speaks its protocol on loopback.
#include "DriverTest.h"
#include "FakeHaplyService.h"
#include "haptics/Devices/Haply/HaplyMessage.h"
#include "vtkHaplyHapticDevice.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace
{
using haptics::HaplyMessage;

class Haply : public DriverTest<vtkHaplyHapticDevice>
{
protected:
  void Use(FakeHaplyService& service)
  {
    service.Start();
    this->Device->SetPort(service.GetPort());
  }
  /// The fault that opening ends with.
  std::string FaultOf(FakeHaplyService& service)
  {
    this->Use(service);
    return this->FaultOfOpening();
  }
  /// Pushes with 1 N up until the service has got it.
  void Push(FakeHaplyService& service)
  {
    this->Use(service);
    this->PushUntil([&] { return service.GetForce()[2] > 0.9; });
  }
};

TEST(HaplyMessages, AForceIsSpelledAsEachVersionWantsIt)
{
  std::string text;
  HaplyMessage::WriteForce("049D", { 1.0, 2.0, -0.5 }, "XYZ", true, nullptr, text);
  EXPECT_EQ(text,
    R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":1,"y":0.5,"z":2}}}}]})");
  HaplyMessage::WriteForce("049D", {}, "XYZ", false, nullptr, text);
  EXPECT_TRUE(Says(text, R"("values":{"x":0,)")) << text;
}

TEST(HaplyMessages, APermutationAndItsWayBackGiveTheSame)
{
  const Vec place{ 0.1, 0.2, 0.3 };
  for (const char* permutation : { "XYZ", "YZX", "ZXY", "-YXZ", "XZ-Y", "-X-YZ" })
  {
    ASSERT_TRUE(HaplyMessage::IsPermutation(permutation)) << permutation;
    const Vec back =
      HaplyMessage::ToService(HaplyMessage::ToDevice(place, permutation), permutation);
    EXPECT_EQ(back, place) << permutation;
  }
  for (const char* permutation : { "", "XY", "XXZ", "XZY", "XYZX", "abc", "--XYZ", "XYZ-" })
  {
    EXPECT_FALSE(HaplyMessage::IsPermutation(permutation)) << permutation;
  }
  // Up is z there and y here; away from the user is y there and -z here.
  EXPECT_EQ(HaplyMessage::ToDevice({ 0.0, 0.0, 1.0 }, "XYZ"), (Vec{ 0.0, 1.0, -0.0 }));
  EXPECT_EQ(HaplyMessage::ToDevice({ 0.0, 1.0, 0.0 }, "XYZ"), (Vec{ 0.0, 0.0, -1.0 }));
}

TEST(HaplyMessages, WhatIsNoStateIsRefusedAndHarmsNothing)
{
  haptics::HaplyState state;
  for (const char* text :
    { "", "{", "[]", "null", "3", R"({"inverse3":3})", R"({"verse_grip":[]})" })
  {
    EXPECT_FALSE(HaplyMessage::Read(text, state)) << text;
  }
  for (const char* text :
    { R"({"inverse3":[3,null,[],{"device_id":5}],"verse_grip":3})",
      R"({"inverse3":[{"device_id":"a","state":[],"status":"x","config":[1]}],"verse_grip":[0]})",
      R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":"1","y":[],"z":{}}}}]})" })
  {
    EXPECT_TRUE(HaplyMessage::Read(text, state)) << text;
    EXPECT_TRUE(state.Devices.empty() || !state.Devices[0].HasPosition);
  }
  EXPECT_FALSE(HaplyMessage::Read(std::string(100000, '['), state));
}

TEST_F(Haply, BothWaysToNameAForceReachTheDevice)
{
  for (const char* version : { "3.5.0.0", "3.1.1.0" })
  {
    FakeHaplyService service(version);
    this->Push(service);
    EXPECT_TRUE(service.HasProfile);
    this->Device->Close();
    EXPECT_TRUE(WaitFor([&service] { return service.GetForce() == Vec{}; }));
  }
}

TEST_F(Haply, ButtonsAndOrientationOfTheGripAreReported)
{
  FakeHaplyService service;
  service.Buttons = 5;
  this->Push(service);
  this->ExpectHeldAndTurned();
  EXPECT_STREQ(this->Device->GetModelName(), "Inverse3 049D");
}

TEST_F(Haply, ABasisThatTheUserHasSetIsTakenIntoAccount)
{
  FakeHaplyService service("3.1.0.0");
  service.With(
    [](auto& devices)
    {
      devices[0].Permutation = "YZX";
      devices[0].Position = { 0.01, 0.02, 0.03 }; // along the service's own y, z, x
    });
  this->Use(service);
  ASSERT_TRUE(WaitUntilOpen(this->Device));
  this->Channel = this->Device->GetChannel();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Exchange();
      double p[3];
      this->Device->GetPosition(p);
      return std::abs(p[0] - 0.03) + std::abs(p[1] - 0.02) + std::abs(p[2] + 0.01) < 1e-9;
    }));
  EXPECT_TRUE(WaitFor(
    [&]
    {
      this->Exchange(); // up, which is z, reported second
      return service.GetForce()[1] > 0.9;
    }));
}

TEST_F(Haply, OneOfSeveralIsChosenByItsId)
{
  FakeHaplyService service;
  service.With(
    [](auto& devices)
    {
      devices.push_back(devices[0]);
      devices[1].Id = "04BA";
    });
  this->Use(service);
  this->Device->SetDeviceId("04BA");
  ASSERT_TRUE(WaitUntilOpen(this->Device));
  this->Channel = this->Device->GetChannel();
  EXPECT_TRUE(WaitFor(
    [&]
    {
      this->Exchange();
      return service.GetForce(1)[2] > 0.9;
    }));
  EXPECT_EQ(service.GetForce(0), Vec{});
}

TEST_F(Haply, NoServiceIsSaid)
{
  FakeHaplyService service;
  this->Device->SetPort(service.GetPort());
  service.Stop();
  EXPECT_FALSE(WaitUntilOpen(this->Device));
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "does not answer"))
    << this->Device->GetErrorMessage();
  EXPECT_TRUE(Says(this->Device->GetErrorMessage(), "systemctl start"));
}

TEST_F(Haply, NoDeviceIsSaid)
{
  FakeHaplyService service;
  service.With([](auto& devices) { devices.clear(); });
  EXPECT_TRUE(Says(this->FaultOf(service), "finds no Inverse3"));
}

TEST_F(Haply, AnUnknownIdIsSaidWithThoseThatThereAre)
{
  FakeHaplyService service;
  this->Device->SetDeviceId("FFFF");
  EXPECT_TRUE(Says(this->FaultOf(service), "no Inverse3 'FFFF', but: 049D"));
}

TEST_F(Haply, VersionsThatItDoesNotKnowAreSaid)
{
  for (const auto& [version, words] :
    { std::pair{ "3.0.7.0", "too old" }, { "", "does not say its version" },
      { "4.0.0.0", "does not know" }, { "x", "does not say its version" } })
  {
    FakeHaplyService service(version);
    EXPECT_TRUE(Says(this->FaultOf(service), words)) << this->Device->GetErrorMessage();
    EXPECT_EQ(service.Forces, 0);
  }
}

TEST_F(Haply, ADamagedInventoryIsSaid)
{
  FakeHaplyService service;
  service.Greeting = "{\"inverse3\":";
  EXPECT_TRUE(Says(this->FaultOf(service), "no inventory"));
}

TEST_F(Haply, AServiceThatReportsNothingIsSaid)
{
  FakeHaplyService service;
  service.IsMute = true;
  EXPECT_TRUE(Says(this->FaultOf(service), "reports nothing"));
}

TEST_F(Haply, AMirroringBasisIsSaid)
{
  FakeHaplyService service;
  service.With([](auto& devices) { devices[0].Permutation = "XZY"; });
  EXPECT_TRUE(Says(this->FaultOf(service), "Set its basis to XYZ"));
}

TEST_F(Haply, ItWaitsForPowerAndCalibrationAndSaysSo)
{
  FakeHaplyService service;
  service.With(
    [](auto& devices)
    {
      devices[0].IsPowered = false;
      devices[0].IsCalibrated = false;
    });
  this->Use(service);
  this->Device->Open();
  const auto says = [this](const char* words)
  {
    return WaitFor(
      [&]
      {
        this->Device->Update();
        return Says(this->Device->GetStatusMessage(), words);
      });
  };
  EXPECT_TRUE(says("has no power"));
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Opening);
  service.With([](auto& devices) { devices[0].IsPowered = true; });
  EXPECT_TRUE(says("is not calibrated"));
  EXPECT_EQ(this->Device->GetState(), vtkHapticDevice::Homing);
  EXPECT_EQ(service.GetForce(), Vec{});
  service.With([](auto& devices) { devices[0].IsCalibrated = true; });
  EXPECT_TRUE(WaitUntilOpen(this->Device));
}

TEST_F(Haply, ASecondClientGetsTheErrorThatItIsInUse)
{
  FakeHaplyService service;
  this->Push(service);
  vtkNew<vtkHaplyHapticDevice> second;
  second->SetPort(service.GetPort());
  EXPECT_FALSE(WaitUntilOpen(second));
  EXPECT_TRUE(Says(second->GetErrorMessage(), "in use by another program"));
  EXPECT_TRUE(this->Exchange()) << "the first goes on";
  this->Device->Update();
  EXPECT_STREQ(this->Device->GetErrorMessage(), "");
}

TEST_F(Haply, ALostStateIsReplacedByZeroAndItGoesOn)
{
  FakeHaplyService service;
  this->Push(service);
  const vtkTypeInt64 before = this->Device->GetNumberOfReleases();
  service.Swallowed = 1;
  EXPECT_TRUE(WaitFor(
    [&]
    {
      EXPECT_TRUE(this->Exchange());
      return this->Device->GetNumberOfReleases() > before;
    }));
  EXPECT_TRUE(WaitFor(
    [&]
    {
      EXPECT_TRUE(this->Exchange());
      return service.Swallowed == 0 && service.GetForce()[2] > 0.9;
    }));
}

// One that is behind stays behind: the least of many lags counts, whatever else the machine does.
TEST_F(Haply, AStateThatComesAfterAllWaitingLeavesNoOlderOnes)
{
  FakeHaplyService service;
  service.Counts = true;
  this->Push(service);
  const vtkTypeInt64 before = this->Device->GetNumberOfReleases();
  service.With([&service](auto&) { service.Delays = { 25, 60 }; });
  EXPECT_TRUE(WaitFor(
    [&]
    {
      EXPECT_TRUE(this->Exchange());
      bool isOver = false;
      service.With([&](auto&) { isOver = service.Delays.empty(); });
      return isOver && this->Device->GetNumberOfReleases() > before && service.GetForce()[2] > 0.9;
    }));
  int least = 1000;
  for (int i = 0; i < 300; ++i)
  {
    ASSERT_TRUE(this->Exchange());
    std::this_thread::sleep_for(std::chrono::microseconds(300)); // what was sent has come
    double position[3];
    this->Device->GetPosition(position);
    const long seen = std::lround(position[0] / FakeHaplyService::MessageStep);
    // Another message may have come since.
    least = std::min(least, std::max(0, service.Messages - static_cast<int>(seen)));
  }
  EXPECT_EQ(least, 0) << "messages";
}

TEST_F(Haply, ADamagedStateGivesZeroAndManyEndIt)
{
  FakeHaplyService service;
  this->Push(service);
  const vtkTypeInt64 before = this->Device->GetNumberOfReleases();
  service.Damaged = 1;
  EXPECT_TRUE(WaitFor(
    [&]
    {
      EXPECT_TRUE(this->Exchange());
      return this->Device->GetNumberOfReleases() > before && service.GetForce()[2] > 0.9;
    }));
  service.Damaged = 1000000;
  EXPECT_TRUE(Says(this->LossOf(), "in a row that are no states"));
  EXPECT_EQ(service.GetForce(), Vec{});
}

TEST_F(Haply, AServiceThatFallsSilentIsGivenUp)
{
  FakeHaplyService service;
  this->Push(service);
  service.IsMute = true;
  EXPECT_TRUE(Says(this->LossOf(), "not answered for 0.2 s"));
  EXPECT_EQ(service.GetForce(), Vec{}) << "it still listened";
}

TEST_F(Haply, ADeviceThatIsUnpluggedOrLosesPowerIsGivenUp)
{
  FakeHaplyService unplugged;
  this->Push(unplugged);
  unplugged.With([](auto& devices) { devices[0].Id = "04BA"; });
  EXPECT_TRUE(Says(this->LossOf(), "was unplugged"));

  FakeHaplyService dark;
  this->Time = 0.0;
  this->Device->Close();
  this->Push(dark);
  dark.With([](auto& devices) { devices[0].IsPowered = false; });
  EXPECT_TRUE(Says(this->LossOf(), "has no power"));
  EXPECT_EQ(dark.GetForce(), Vec{});
}

TEST_F(Haply, APositionThatCannotBeEndsIt)
{
  FakeHaplyService missing;
  this->Push(missing);
  missing.With([](auto& devices) { devices[0].HasPosition = false; });
  EXPECT_TRUE(Says(this->LossOf(), "no position"));
  EXPECT_EQ(missing.GetForce(), Vec{});

  FakeHaplyService far;
  this->Time = 0.0;
  this->Device->Close();
  this->Push(far);
  far.With([](auto& devices) { devices[0].Position[1] = 1e300; });
  EXPECT_TRUE(Says(this->LossOf(), "cannot be"));
  EXPECT_EQ(far.GetForce(), Vec{});
}

TEST_F(Haply, AServiceThatEndsIsSaidAndOneThatComesBackIsTakenAgain)
{
  auto service = std::make_unique<FakeHaplyService>();
  this->Device->ReconnectOn();
  this->Push(*service);
  service->Stop();
  EXPECT_TRUE(WaitFor([this] { return !this->Exchange(); }));
  EXPECT_TRUE(WaitForFault(this->Device));
  const int port = service->GetPort();
  service.reset();
  service = std::make_unique<FakeHaplyService>("3.5.0.0", port);
  service->Start();
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return this->Device->IsOpen();
    }))
    << "by itself";
  service->With([](auto& devices) { devices[0].IsPowered = false; });
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return !this->Device->IsOpen();
    }));
  service->With([](auto& devices) { devices[0].IsPowered = true; });
  EXPECT_TRUE(WaitFor(
    [this]
    {
      this->Device->Update();
      return this->Device->IsOpen();
    }))
    << "by itself";
}

TEST_F(Haply, WhatMessagesAdviseEndsTheFault)
{
  auto service = std::make_unique<FakeHaplyService>();
  const int port = service->GetPort();
  const auto startAnew = [&](const char* version = "3.5.0.0")
  {
    service.reset();
    service = std::make_unique<FakeHaplyService>(version, port);
    service->Start();
  };
  const auto push = [&] { this->PushUntil([&] { return service->GetForce()[2] > 0.9; }); };
  this->Device->SetPort(port);
  service->Stop();
  this->ExpectRemedyOfOpening(
    "or start it: systemctl start haply-inverse-service", [&] { startAnew(); });
  {
    // Another program's port, which is silent.
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
    ASSERT_EQ(listen(listener, 4), 0);
    ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
    this->Device->SetPort(ntohs(address.sin_port));
    this->ExpectRemedyOfOpening(
      "Start the service anew, or set its port", [&] { this->Device->SetPort(port); });
    close(listener);
  }
  service->With([](auto& devices) { devices.clear(); });
  this->ExpectRemedyOfOpening("Connect its USB cable and its power supply, and open it again",
    [&] { service->With([](auto& devices) { devices.emplace_back(); }); });
  startAnew("3.0.7.0");
  this->ExpectRemedyOfOpening(
    "is too old. Update it to 3.1 or later", [&] { startAnew("3.1.0.0"); });
  startAnew("");
  this->ExpectRemedyOfOpening(
    "how it names a force. Update it to 3.1 or later", [&] { startAnew(); });
  startAnew("4.0.0.0");
  this->ExpectRemedyOfOpening("or install the service 3.5", [&] { startAnew("3.5.0.0"); });
  service->IsMute = true;
  this->ExpectRemedyOfOpening(
    "Start it anew: systemctl restart haply-inverse-service", [&] { startAnew(); });
  service->With([](auto& devices) { devices[0].Permutation = "XZY"; });
  this->ExpectRemedyOfOpening("Set its basis to XYZ in the service's settings",
    [&] { service->With([](auto& devices) { devices[0].Permutation = "XYZ"; }); });
  {
    vtkNew<vtkHaplyHapticDevice> other;
    other->SetPort(port);
    ASSERT_TRUE(WaitUntilOpen(other)) << other->GetErrorMessage();
    const auto pushes = [&]
    {
      haptics::DeviceSample sample;
      other->GetChannel()->Read(0.0, sample);
      other->GetChannel()->Write({ 0.0, 1.0, 0.0 });
      return service->GetForce()[2] > 0.9;
    };
    ASSERT_TRUE(WaitFor(pushes));
    this->ExpectRemedyOfOpening(
      "End that program's session, and open it again", [&] { other->Close(); });
  }

  startAnew();
  push();
  service->With([](auto& devices) { devices[0].Id = "04BA"; });
  this->ExpectRemedyOfLoss("Plug it in again and open it again",
    [&] { service->With([](auto& devices) { devices[0].Id = "049D"; }); });
  push();
  service->Damaged = 1000000;
  this->ExpectRemedyOfLoss("Start it anew and open the device again", [&] { startAnew(); });
  push();
  service->IsMute = true;
  this->ExpectRemedyOfLoss(
    "systemctl restart haply-inverse-service; then open the device again", [&] { startAnew(); });
  push();
  service->With([](auto& devices) { devices[0].HasPosition = false; });
  this->ExpectRemedyOfLoss(
    "Calibrate the device, start the service anew and open it again", [&] { startAnew(); });
  push();
  service->With([](auto& devices) { devices[0].IsPowered = false; });
  this->ExpectRemedyOfLoss("connect its power supply; the USB cable alone drives no motor",
    [&] { service->With([](auto& devices) { devices[0].IsPowered = true; }); });
  push();
  service->Stop();
  this->ExpectRemedyOfLoss(
    "start it: systemctl start haply-inverse-service; then open the device", [&] { startAnew(); });
}

TEST_F(Haply, WhatTheServiceHasIsListed)
{
  FakeHaplyService service;
  service.With(
    [](auto& devices)
    {
      devices.push_back(devices[0]);
      devices[1].Id = "04BA";
      devices[1].IsCalibrated = false;
    });
  this->Use(service);
  vtkNew<vtkStringArray> ids;
  vtkNew<vtkStringArray> states;
  this->Device->FindDevices(ids, states);
  ASSERT_EQ(ids->GetNumberOfValues(), 2);
  EXPECT_EQ(ids->GetValue(0), "049D");
  EXPECT_TRUE(Says(states->GetValue(0), "ready"));
  EXPECT_TRUE(Says(states->GetValue(1), "not calibrated"));
  EXPECT_EQ(service.Forces, 0);
}

/// What the exchange takes here, in process: printed, not asserted but for its being in time.
TEST_F(Haply, ExchangesAThousandTimesASecond)
{
  FakeHaplyService service;
  this->Push(service);
  const auto start = std::chrono::steady_clock::now();
  const vtkTypeInt64 before = this->Device->GetNumberOfExchanges();
  while (std::chrono::steady_clock::now() - start < std::chrono::seconds(2))
  {
    ASSERT_TRUE(this->Exchange());
  }
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto exchanges = static_cast<double>(this->Device->GetNumberOfExchanges() - before);
  std::printf("%.0f exchanges a second; p50 %.0f us, p99 %.0f us, p99.9 %.0f us; %lld releases\n",
    exchanges / seconds, 1e6 * this->Device->GetExchangeTime(0.5),
    1e6 * this->Device->GetExchangeTime(0.99), 1e6 * this->Device->GetExchangeTime(0.999),
    static_cast<long long>(this->Device->GetNumberOfReleases()));
  EXPECT_GT(exchanges, 100.0);
}
}
