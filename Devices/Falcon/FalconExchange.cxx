#include "haptics/Devices/Falcon/FalconExchange.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace haptics
{
namespace
{
using Clock = std::chrono::steady_clock;
using std::chrono::nanoseconds;

constexpr std::int64_t Period = 1000000;     // [ns]
constexpr int ReplyTimeout = 20;             // [ms]
constexpr int ProbeTries = 5;                // of ReplyTimeout each
constexpr int FailuresInARow = 5;            // 0.1 s without a reply
constexpr unsigned int FarewellTimeout = 50; // [ms]

std::int64_t Now()
{
  return std::chrono::duration_cast<nanoseconds>(Clock::now().time_since_epoch()).count();
}

}

FalconExchange::FalconExchange(FalconUsb& usb, FalconLink& link)
  : Usb(usb)
  , Link(link)
  , Out(usb, FalconUsb::OutEndpoint)
  , In(usb, FalconUsb::InEndpoint)
{
}

// The write and the first read are under way together; a read that brings nothing but the modem
// status, or a part of a packet, is followed by another.
bool FalconExchange::TryOnce(const FalconCommand& command, FalconReply& reply, int timeout)
{
  const char* const doing = "exchanging packets with it";
  const FalconPacket packet = Encode(command);
  const std::int64_t start = Now();
  const std::uint64_t malformed = this->Reader.GetNumberOfMalformed();
  bool answered = false;
  this->Out.Submit(packet.data(), packet.size(), static_cast<unsigned int>(timeout), doing);
  while (!answered && this->Reader.GetNumberOfMalformed() == malformed)
  {
    const std::int64_t rest = timeout - (Now() - start) / 1000000;
    if (rest <= 0)
    {
      break;
    }
    this->In.Submit(nullptr, 0, static_cast<unsigned int>(rest), doing);
    const int status = this->In.Wait();
    if (status != LIBUSB_TRANSFER_TIMED_OUT)
    {
      FalconUsb::Check(status, doing);
    }
    FtdiPayload payload{};
    if (ReadFtdi(this->In.GetBytes(), this->In.GetSize(), payload))
    {
      for (std::size_t i = 0; i < payload.Size; ++i)
      {
        // An answer to an earlier question may come first: the last one counts.
        answered = this->Reader.Push(payload.Bytes[i], reply) || answered;
      }
    }
  }
  const int written = this->Out.Wait();
  if (written != LIBUSB_TRANSFER_TIMED_OUT)
  {
    FalconUsb::Check(written, doing);
  }
  this->Link.MalformedPackets.store(this->Reader.GetNumberOfMalformed(), std::memory_order_relaxed);
  if (answered)
  {
    this->Link.Exchanges.fetch_add(1, std::memory_order_acq_rel); // see FalconChannel::Settle()
  }
  return answered;
}

bool FalconExchange::IsAnswered()
{
  FalconReply reply;
  for (int i = 0; i < ProbeTries; ++i)
  {
    if (this->TryOnce(FalconCommand(), reply, ReplyTimeout))
    {
      return true;
    }
    this->Reader.Clear();
  }
  return false;
}

FalconReply FalconExchange::Exchange(FalconCommand command)
{
  FalconReply reply;
  for (int failures = 0; failures < FailuresInARow; ++failures)
  {
    if (this->TryOnce(command, reply, ReplyTimeout))
    {
      return reply;
    }
    // The position is old now, and so is any torque that was made for it.
    command.Torques = {};
    this->Link.MissedReplies.fetch_add(1, std::memory_order_relaxed);
  }
  throw FalconFault("The Falcon did not answer " + std::to_string(FailuresInARow) +
    " packets in a row. Check its power supply and its cable, then open it again.");
}

void FalconExchange::WaitForNextTick()
{
  const std::int64_t now = Now();
  this->NextTick = std::max(this->NextTick + Period, now - Period); // no burst after a delay
  if (this->NextTick > now)
  {
    std::this_thread::sleep_for(nanoseconds(this->NextTick - now));
  }
}

void FalconExchange::Home(const std::function<void(std::uint8_t)>& progress)
{
  FalconCommand command;
  command.Leds = FalconLedRed;
  int told = -1;
  while (told != FalconAllHomed)
  {
    this->Usb.CheckStop();
    const FalconReply reply = this->Exchange(command);
    if (reply.HomedLegs != told)
    {
      told = reply.HomedLegs;
      progress(reply.HomedLegs);
    }
    this->WaitForNextTick();
  }
}

void FalconExchange::Serve(double commandTimeout, const std::function<void()>& ready)
{
  const auto tooOld = static_cast<std::int64_t>(commandTimeout * 1e9);
  FalconCommand command;
  std::int64_t renewed = Now() - tooOld;
  bool withdrawn = true;
  while (true)
  {
    this->Usb.CheckStop();
    const std::int64_t start = Now();
    const std::uint64_t halts = this->Link.Halts.load(std::memory_order_acquire);
    if (this->Link.Demands.Update())
    {
      command.Torques = ClampTorques(this->Link.Demands.Get().Torques);
      renewed = start;
      withdrawn = false;
    }
    else if (!withdrawn && start - renewed > tooOld)
    {
      command.Torques = {};
      withdrawn = true;
      this->Link.LateCommands.fetch_add(1, std::memory_order_relaxed);
    }
    if (this->Link.Demands.Get().Halts != halts)
    {
      command.Torques = {};
    }
    command.Leds = this->Link.Leds.load(std::memory_order_relaxed);

    const FalconReply reply = this->Exchange(command);
    if (reply.HomedLegs != FalconAllHomed)
    {
      throw FalconFault("The Falcon lost its origin, as it does when its power fails for a moment. "
                        "Check its power supply, then open and home it again.");
    }
    this->Link.Times.Add(static_cast<double>(Now() - start) * 1e-9);
    this->Link.Answers.Publish(reply);
    this->Link.Bell.Ring();
    if (!this->Link.Up.exchange(true, std::memory_order_acq_rel))
    {
      ready();
    }
    this->WaitForNextTick();
  }
}

void FalconExchange::SayFarewell()
{
  const char* const doing = "sending it zero force";
  const FalconPacket packet = Encode(FalconCommand());
  this->Out.Submit(packet.data(), packet.size(), FarewellTimeout, doing);
  int status = this->Out.Wait();
  if (status == LIBUSB_TRANSFER_STALL)
  {
    this->Usb.ClearHalt(FalconUsb::OutEndpoint);
    this->Out.Submit(packet.data(), packet.size(), FarewellTimeout, doing);
    status = this->Out.Wait();
  }
  FalconUsb::Check(status, doing);
}
}
