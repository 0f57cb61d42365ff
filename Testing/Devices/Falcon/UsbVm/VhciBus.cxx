#include "VhciBus.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <stdexcept>

namespace
{
// USB/IP: every message begins with twelve 32-bit words, big end first.
constexpr std::size_t HeaderWords = 12;
using Header = std::array<std::uint32_t, HeaderWords>;
constexpr std::uint32_t CommandSubmit = 1;
constexpr std::uint32_t CommandUnlink = 2;
constexpr std::uint32_t ReplySubmit = 3;
constexpr std::uint32_t ReplyUnlink = 4;
constexpr int FullSpeed = 2;

using Bytes = std::vector<std::uint8_t>;
const Bytes DeviceDescriptor{ 18, 1, 0, 2, 0, 0, 0, 64, 0x03, 0x04, 0x48, 0xcb, 0, 6, 0, 0, 0, 1 };
const Bytes ConfigurationDescriptor{ 9, 2, 32, 0, 1, 1, 0, 0xa0, 45, 9, 4, 0, 0, 2, 0xff, 0xff,
  0xff, 0, 7, 5, 0x81, 2, 64, 0, 0, 7, 5, 0x02, 2, 64, 0, 0 };

/// What the kernel asks of any device. False where this one has no such thing.
bool AnswerStandardRequest(const std::uint8_t* setup, Bytes& answer)
{
  constexpr std::uint8_t getDescriptor = 6;
  constexpr std::uint8_t getConfiguration = 8;
  if (setup[1] == 0)
  {
    answer = { 1, 0 }; // status: self-powered
  }
  else if (setup[1] == getDescriptor && setup[3] == 1)
  {
    answer = DeviceDescriptor;
  }
  else if (setup[1] == getDescriptor && setup[3] == 2)
  {
    answer = ConfigurationDescriptor;
  }
  else if (setup[1] == getConfiguration)
  {
    answer = { 1 };
  }
  else
  {
    return (setup[0] & 0x80) == 0; // settings are taken
  }
  return true;
}
}

VhciBus::~VhciBus()
{
  this->Unplug();
}

void VhciBus::Plug(const FalconModel& model)
{
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
  {
    throw std::runtime_error("no socket pair");
  }
  this->Socket = ends[0];
  this->Model = model;
  this->Over = false;
  this->Thread = std::thread(&VhciBus::Run, this);
  std::ofstream attach("/sys/devices/platform/vhci_hcd.0/attach");
  attach << "0 " << ends[1] << " 65538 " << FullSpeed << std::flush;
  if (!attach)
  {
    throw std::runtime_error("the virtual host controller takes no device");
  }
  close(ends[1]); // the kernel has its own
}

void VhciBus::Unplug()
{
  if (this->Socket >= 0)
  {
    shutdown(this->Socket, SHUT_RDWR);
    this->Thread.join();
    close(this->Socket);
    this->Socket = -1;
    this->Waiting.clear();
  }
}

bool VhciBus::ReadAll(void* bytes, std::size_t size)
{
  auto* next = static_cast<char*>(bytes);
  while (size > 0)
  {
    const ssize_t got = read(this->Socket, next, size);
    if (got <= 0)
    {
      this->Over = true;
      return false;
    }
    next += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void VhciBus::Run()
{
  while (!this->Over)
  {
    pollfd poll{ this->Socket, POLLIN, 0 };
    const int ready = ::poll(&poll, 1, 1);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (ready > 0)
    {
      this->Receive();
    }
    this->Service();
  }
}

void VhciBus::Receive()
{
  Header header;
  if (!this->ReadAll(header.data(), sizeof header))
  {
    return;
  }
  const std::uint32_t number = ntohl(header[1]);
  if (ntohl(header[0]) == CommandSubmit)
  {
    this->Submit(header.data(), number);
    return;
  }
  if (ntohl(header[0]) != CommandUnlink)
  {
    throw std::runtime_error("the kernel sent what is no USB/IP message");
  }
  const std::uint32_t victim = ntohl(header[5]);
  const auto found = std::find_if(this->Waiting.begin(), this->Waiting.end(),
    [victim](const Pending& pending) { return pending.Number == victim; });
  Header reply{ htonl(ReplyUnlink), header[1] };
  if (found != this->Waiting.end())
  {
    this->Waiting.erase(found);
    reply[5] = htonl(static_cast<std::uint32_t>(-ECONNRESET));
  }
  this->Over = send(this->Socket, reply.data(), sizeof reply, MSG_NOSIGNAL) < 0 || this->Over;
}

void VhciBus::Submit(const std::uint32_t* header, std::uint32_t number)
{
  const bool in = ntohl(header[3]) != 0;
  const std::uint32_t endpoint = ntohl(header[4]);
  const std::uint32_t size = ntohl(header[6]);
  Bytes bytes(in ? 0 : size);
  if (!in && !this->ReadAll(bytes.data(), size))
  {
    return;
  }
  if (endpoint == 0)
  {
    const auto* setup = reinterpret_cast<const std::uint8_t*>(header + 10);
    Bytes answer;
    int status = 0;
    if ((setup[0] & 0x60) == 0)
    {
      status = AnswerStandardRequest(setup, answer) ? 0 : -EPIPE;
      answer.resize(std::min<std::size_t>(answer.size(), size));
    }
    else
    {
      status = this->Model.Control(setup[1], setup[2] | setup[3] << 8);
    }
    this->Answer(number, status, answer, static_cast<std::uint32_t>(answer.size()));
  }
  else if (in)
  {
    this->Waiting.push_back({ number, size, FalconModel::Clock::now() });
  }
  else
  {
    const int status = this->Model.Write(bytes.data(), bytes.size());
    this->Answer(number, status, {}, status == 0 ? size : 0);
  }
}

void VhciBus::Service()
{
  while (!this->Waiting.empty())
  {
    const Pending pending = this->Waiting.front();
    std::optional<FalconModel::Answer> answer = this->Model.Read(pending.Start);
    if (!answer)
    {
      return;
    }
    this->Waiting.pop_front();
    answer->Bytes.resize(std::min<std::size_t>(answer->Bytes.size(), pending.Size));
    this->Answer(pending.Number, answer->Status, answer->Bytes,
      static_cast<std::uint32_t>(answer->Bytes.size()));
  }
}

void VhciBus::Answer(std::uint32_t number, int status, const Bytes& bytes, std::uint32_t length)
{
  Header header{ htonl(ReplySubmit), htonl(number) };
  header[5] = htonl(static_cast<std::uint32_t>(status));
  header[6] = htonl(length);
  Bytes message(sizeof header);
  std::copy_n(reinterpret_cast<const std::uint8_t*>(header.data()), sizeof header, message.begin());
  message.insert(message.end(), bytes.begin(), bytes.end());
  this->Over = send(this->Socket, message.data(), message.size(), MSG_NOSIGNAL) < 0 || this->Over;
}
