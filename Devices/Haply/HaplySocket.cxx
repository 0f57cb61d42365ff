#include "haptics/Devices/Haply/HaplySocket.h"

#include "haptics/Devices/Driver/DeviceDriver.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace haptics
{
namespace
{
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;

constexpr milliseconds AnswerTimeout{ 500 };
constexpr milliseconds SendTimeout{ 100 };
constexpr milliseconds FarewellTimeout{ 50 };
constexpr std::size_t LargestMessage = 1 << 20; // [bytes]

tcp::endpoint ServiceAt(int port)
{
  return { asio::ip::address_v4::loopback(), static_cast<unsigned short>(port) };
}

[[noreturn]] void ThrowNotRunning(int port, const error_code& error)
{
  throw DeviceFault("The Haply Inverse Service does not answer on port " + std::to_string(port) +
    " of this machine (" + error.message() +
    "). Install it from Haply, or start it: systemctl start haply-inverse-service");
}

/// Waits for what was begun; its completion sets `isDone`. Where it takes longer `cancel` ends it,
/// and the error is a timeout.
template <typename Cancel>
void Await(asio::io_context& io, const bool& isDone, error_code& error,
  HaplySocket::Clock::time_point deadline, Cancel cancel)
{
  io.restart();
  while (!isDone && io.run_one_until(deadline))
  {
  }
  if (!isDone)
  {
    cancel();
    io.restart();
    while (!isDone && io.run_one())
    {
    }
    error = beast::error::timeout;
  }
}
}

struct HaplySocket::Implementation
{
  asio::io_context Io{ 1 };
  websocket::stream<beast::tcp_stream, false> Stream{ this->Io }; // nothing is compressed
  beast::flat_buffer Buffer;
  bool IsReading = false;
  error_code ReadError;
};

HaplySocket::HaplySocket(int port)
  : Port(port)
{
}

HaplySocket::~HaplySocket()
{
  this->Close();
}

bool HaplySocket::IsConnected() const
{
  return this->Self != nullptr;
}

std::string HaplySocket::Get(const char* target)
{
  asio::io_context io(1);
  beast::tcp_stream stream(io);
  const auto deadline = Clock::now() + AnswerTimeout;
  error_code error;
  bool isDone = false;
  const auto finish = [&](const error_code& result, std::size_t = 0)
  {
    error = result;
    isDone = true;
  };
  const auto cancel = [&stream] { stream.close(); };
  stream.async_connect(ServiceAt(this->Port), [&](const error_code& result) { finish(result); });
  Await(io, isDone, error, deadline, cancel);
  if (error)
  {
    ThrowNotRunning(this->Port, error);
  }
  http::request<http::empty_body> request(http::verb::get, target, 11);
  request.set(http::field::host, "localhost");
  isDone = false;
  http::async_write(stream, request, finish);
  Await(io, isDone, error, deadline, cancel);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  if (!error)
  {
    isDone = false;
    http::async_read(stream, buffer, response, finish);
    Await(io, isDone, error, deadline, cancel);
  }
  if (error)
  {
    throw DeviceFault("What answers on port " + std::to_string(this->Port) +
      " of this machine is not the Haply Inverse Service, or hangs (" + error.message() +
      "). Start the service anew, or set its port.");
  }
  return response.result() == http::status::ok ? response.body() : "";
}

void HaplySocket::Connect()
{
  this->Close();
  this->Self = std::make_unique<Implementation>();
  Implementation& self = *this->Self;
  self.Stream.read_message_max(LargestMessage);
  self.Stream.auto_fragment(false);
  const auto deadline = Clock::now() + AnswerTimeout;
  const auto cancel = [&self] { beast::get_lowest_layer(self.Stream).close(); };
  error_code error;
  bool isDone = false;
  const auto finish = [&](const error_code& result)
  {
    error = result;
    isDone = true;
  };
  beast::get_lowest_layer(self.Stream).async_connect(ServiceAt(this->Port), finish);
  Await(self.Io, isDone, error, deadline, cancel);
  if (!error)
  {
    beast::get_lowest_layer(self.Stream).socket().set_option(tcp::no_delay(true));
    isDone = false;
    self.Stream.async_handshake("localhost:" + std::to_string(this->Port), "/", finish);
    Await(self.Io, isDone, error, deadline, cancel);
  }
  if (error)
  {
    this->Self.reset();
    ThrowNotRunning(this->Port, error);
  }
  self.Stream.text(true);
}

void HaplySocket::Send(const std::string& text)
{
  Implementation& self = *this->Self;
  error_code error;
  bool isDone = false;
  self.Stream.async_write(asio::buffer(text),
    [&](const error_code& result, std::size_t)
    {
      error = result;
      isDone = true;
    });
  Await(self.Io, isDone, error, Clock::now() + SendTimeout,
    [&self] { beast::get_lowest_layer(self.Stream).close(); });
  if (error)
  {
    throw DeviceFault("The Haply Inverse Service takes no messages any more (" + error.message() +
      "). Start it anew and open the device again.");
  }
}

bool HaplySocket::Receive(std::string_view& text, Clock::time_point deadline)
{
  Implementation& self = *this->Self;
  if (!self.IsReading)
  {
    self.Buffer.clear();
    self.IsReading = true;
    self.Stream.async_read(self.Buffer,
      [&self](const error_code& result, std::size_t)
      {
        self.ReadError = result;
        self.IsReading = false;
      });
  }
  self.Io.restart();
  while (self.IsReading && self.Io.run_one_until(deadline))
  {
  }
  if (self.IsReading)
  {
    return false;
  }
  if (self.ReadError)
  {
    throw DeviceFault("The Haply Inverse Service ended the connection (" +
      self.ReadError.message() +
      "). Where it was stopped or crashed, start it: systemctl start haply-inverse-service; then "
      "open the device again.");
  }
  const auto data = self.Buffer.data();
  text = { static_cast<const char*>(data.data()), data.size() };
  return true;
}

void HaplySocket::Close() noexcept
{
  if (!this->Self)
  {
    return;
  }
  try
  {
    Implementation& self = *this->Self;
    error_code error;
    bool isDone = !self.Stream.is_open();
    if (!isDone)
    {
      self.Stream.async_close(websocket::close_code::normal,
        [&](const error_code& result)
        {
          error = result;
          isDone = true;
        });
    }
    const auto cancel = [&self] { beast::get_lowest_layer(self.Stream).close(); };
    Await(self.Io, isDone, error, Clock::now() + FarewellTimeout, cancel);
    cancel();
    self.Io.restart();
    self.Io.run(); // what was cancelled ends
  }
  catch (const std::exception&)
  {
    // The socket goes with the object: nothing is left to do.
  }
  this->Self.reset();
}
}
