#include "FakeHaplyService.h"

#include "DriverBench.h"
#include "haptics/Devices/EndingSignals.h"
#include "haptics/Devices/Haply/HaplyMessage.h"
#include "vtkHaplyHapticDevice.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdint>
#include <cstdio>

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

struct FakeHaplyService::Connections
{
  asio::io_context Io;
  tcp::acceptor Acceptor{ this->Io };
  std::vector<std::unique_ptr<tcp::socket>> Sockets; ///< never fewer; Mutex
  std::vector<std::thread> Threads;                  ///< the accepting thread's
};

FakeHaplyService::FakeHaplyService(std::string version, int port)
  : Version(std::move(version))
  , Self(std::make_unique<Connections>())
{
  tcp::acceptor& acceptor = this->Self->Acceptor;
  const tcp::endpoint place(asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port));
  acceptor.open(place.protocol());
  // Where one has just ended.
  acceptor.set_option(tcp::acceptor::reuse_address(true));
  acceptor.bind(place);
  acceptor.listen();
  this->Port = acceptor.local_endpoint().port();
}

FakeHaplyService::~FakeHaplyService()
{
  this->Stop();
}

void FakeHaplyService::Start()
{
  this->Thread = std::thread([this] { this->Accept(); });
}

void FakeHaplyService::Stop()
{
  this->IsStopping = true;
  if (this->Thread.joinable())
  {
    // Wakes accept().
    ::shutdown(this->Self->Acceptor.native_handle(), SHUT_RDWR);
    this->Thread.join();
  }
  boost::system::error_code ignored;
  this->Self->Acceptor.close(ignored);
}

void FakeHaplyService::Accept()
{
  haptics::LeaveEndingSignalsToOtherThreads();
  while (!this->IsStopping)
  {
    auto socket = std::make_unique<tcp::socket>(this->Self->Io);
    boost::system::error_code error;
    this->Self->Acceptor.accept(*socket, error);
    if (!error)
    {
      socket->set_option(tcp::no_delay(true), error);
      std::size_t number = 0;
      {
        const std::lock_guard<std::mutex> lock(this->Mutex);
        number = this->Self->Sockets.size();
        this->Self->Sockets.push_back(std::move(socket));
      }
      this->Self->Threads.emplace_back([this, number] { this->Talk(number); });
    }
  }
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const auto& socket : this->Self->Sockets)
    {
      ::shutdown(socket->native_handle(), SHUT_RDWR);
    }
  }
  for (std::thread& thread : this->Self->Threads)
  {
    thread.join();
  }
}

void FakeHaplyService::Talk(std::size_t number)
{
  haptics::LeaveEndingSignalsToOtherThreads();
  tcp::socket* socket = nullptr;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    socket = this->Self->Sockets[number].get();
  }
  const int session = static_cast<int>(number) + 1;
  try
  {
    beast::flat_buffer buffer;
    http::request<http::string_body> request;
    http::read(*socket, buffer, request);
    if (!websocket::is_upgrade(request))
    {
      http::response<http::string_body> response(
        this->Version.empty() ? http::status::not_found : http::status::ok, request.version());
      response.set(http::field::content_type, "application/json");
      response.body() =
        R"({"git_tag":"x","project_name":"haply-inverse-service","project_version":")" +
        this->Version + R"("})";
      response.prepare_payload();
      http::write(*socket, response);
      boost::system::error_code ignored;
      socket->shutdown(tcp::socket::shutdown_both, ignored);
      return;
    }
    websocket::stream<tcp::socket&> stream(*socket);
    stream.accept(request);
    stream.text(true);
    ++this->Clients;
    if (!this->IsMute)
    {
      const std::string hello =
        this->Greeting.empty() ? this->State(true, session) : this->Greeting;
      stream.write(asio::buffer(hello));
    }
    while (true)
    {
      beast::flat_buffer message;
      stream.read(message);
      ++this->Messages;
      this->Take(beast::buffers_to_string(message.data()), session);
      if (const int delay = this->NextDelay())
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(delay));
      }
      if (this->IsMute || (this->Swallowed > 0 && this->Swallowed-- > 0))
      {
        continue;
      }
      std::string answer = this->State(false, session);
      if (this->Damaged > 0 && this->Damaged-- > 0)
      {
        answer.resize(answer.size() / 2);
      }
      stream.write(asio::buffer(answer));
    }
  }
  catch (const std::exception&)
  {
    // The connection has ended.
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->Owner == session)
  {
    this->Owner = 0;
  }
  boost::system::error_code ignored;
  socket->shutdown(tcp::socket::shutdown_both, ignored);
}

int FakeHaplyService::NextDelay()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  int delay = this->Delay;
  if (!this->Delays.empty())
  {
    delay = this->Delays.front();
    this->Delays.erase(this->Delays.begin());
  }
  return delay;
}

std::string FakeHaplyService::State(bool isFull, int session)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->Counts)
  {
    this->Devices[0].Position[0] = MessageStep * this->Messages;
  }
  nlohmann::json root;
  root["session_id"] = session;
  root["inverse3"] = nlohmann::json::array();
  const bool isNew = this->Version.rfind("3.5", 0) == 0;
  for (const FakeInverse3& device : this->Devices)
  {
    nlohmann::json entry;
    entry["device_id"] = device.Id;
    if (isFull)
    {
      entry["config"]["type"] = "inverse3";
      entry["config"]["handedness"] = "right";
      entry["config"][isNew ? "basis" : "coordinate_system"]["permutation"] = device.Permutation;
    }
    const char* const axes[] = { "x", "y", "z" };
    for (int i = 0; device.HasPosition && i < 3; ++i)
    {
      entry["state"]["cursor_position"][axes[i]] = device.Position[static_cast<std::size_t>(i)];
      entry["state"]["cursor_velocity"][axes[i]] = 0.0;
    }
    entry["state"]["body_orientation"]["w"] = 1.0;
    entry["status"]["calibrated"] = device.IsCalibrated;
    entry["status"]["in_use"] = this->Owner != 0;
    entry["status"]["power_supply"] = device.IsPowered;
    entry["status"]["ready"] = device.IsCalibrated && device.IsPowered;
    entry["status"]["started"] = device.IsStarted;
    root["inverse3"].push_back(entry);
  }
  root["verse_grip"] = nlohmann::json::array();
  root["wireless_verse_grip"] = nlohmann::json::array();
  if (this->HasGrip)
  {
    nlohmann::json grip;
    grip["device_id"] = "1A2B";
    const unsigned int buttons = this->Buttons;
    grip["state"]["buttons"]["a"] = (buttons & 1u) != 0;
    grip["state"]["buttons"]["b"] = (buttons & 2u) != 0;
    grip["state"]["buttons"]["c"] = (buttons & 4u) != 0;
    // A quarter turn about the service's z, which is up.
    grip["state"]["orientation"]["w"] = 0.7071067811865476;
    grip["state"]["orientation"]["x"] = 0.0;
    grip["state"]["orientation"]["y"] = 0.0;
    grip["state"]["orientation"]["z"] = 0.7071067811865476;
    root["wireless_verse_grip"].push_back(grip);
  }
  return root.dump();
}

void FakeHaplyService::Take(const std::string& text, int session)
{
  const nlohmann::json root = nlohmann::json::parse(text, nullptr, false);
  if (!root.is_object())
  {
    return;
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (root.contains("/session/configure/profile/name"_json_pointer))
  {
    this->HasProfile = true;
  }
  const char* const key = this->Version.rfind("3.5", 0) == 0 ? "vector" : "values";
  const nlohmann::json::json_pointer place(std::string("/commands/set_cursor_force/") + key);
  for (const nlohmann::json& entry : root.at("inverse3"))
  {
    for (FakeInverse3& device : this->Devices)
    {
      if (entry.contains(place) && entry.at("device_id") == device.Id)
      {
        const nlohmann::json& force = entry.at(place);
        this->Owner = session;
        ++this->Forces;
        device.Force = { force.at("x"), force.at("y"), force.at("z") };
      }
    }
  }
}

std::array<double, 3> FakeHaplyService::GetForce(std::size_t device)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Devices[device].Force;
}

namespace
{
class HaplyBench : public DriverBench
{
public:
  void Begin() override { this->Service.Start(); }
  vtkSmartPointer<vtkDriverHapticDevice> MakeDevice() override
  {
    auto device = vtkSmartPointer<vtkHaplyHapticDevice>::New();
    device->SetPort(this->Service.GetPort());
    return device;
  }
  void MoveTo(const Vec& position) override
  {
    this->Service.With([&position](auto& devices)
      { devices[0].Position = haptics::HaplyMessage::ToService(position, "XYZ"); });
  }
  Vec GetForce() const override
  {
    return haptics::HaplyMessage::ToDevice(this->Service.GetForce(), "XYZ");
  }
  void SetDelay(int milliseconds) override { this->Service.Delay = milliseconds; }

private:
  mutable FakeHaplyService Service;
};
}

std::unique_ptr<DriverBench> MakeHaplyBench()
{
  return std::make_unique<HaplyBench>();
}
