#include "haptics/Devices/Falcon/FalconExchange.h"

#include "haptics/Devices/MonotonicClock.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace haptics
{
namespace
{
using std::chrono::nanoseconds;

const char* const Doing = "exchanging packets with it";
constexpr std::int64_t Millisecond = 1000000;             // [ns]
constexpr std::int64_t Period = Millisecond;              // [ns]
constexpr std::int64_t ReplyTimeout = 20 * Millisecond;   // [ns]; no older position counts
constexpr std::int64_t QuietTime = 30 * Millisecond;      // [ns]; longer than packets are apart
constexpr std::int64_t LongestHiccup = 140 * Millisecond; // [ns]; FalconChannel waits a bit longer
constexpr std::int64_t DoubtTime = LongestHiccup;         // [ns]; a reply later than that is lost
constexpr int ProbeTries = 5;                             // of ReplyTimeout each
constexpr int FailuresInARow = 5;                         // 0.1 s without a reply
constexpr unsigned int FarewellTimeout = 50;              // [ms]

}

FalconExchange::FalconExchange(FalconUsb& usb, FalconLink& link)
  : Usb(usb)
  , Link(link)
  , Out(usb, FalconUsb::OutEndpoint)
  , In(usb, FalconUsb::InEndpoint)
{
}

// A read that brings nothing but the modem status, or a part of a packet, is followed by another.
bool FalconExchange::ReadOnce(FalconReply& reply, std::int64_t rest)
{
  const auto timeout = static_cast<unsigned int>((rest + Millisecond - 1) / Millisecond);
  this->In.Submit(nullptr, 0, timeout, Doing);
  const int status = this->In.Wait();
  if (status != LIBUSB_TRANSFER_TIMED_OUT)
  {
    FalconUsb::Check(status, Doing);
  }
  bool heard = false;
  FtdiPayload payload{};
  if (ReadFtdi(this->In.GetBytes(), this->In.GetSize(), payload))
  {
    for (std::size_t i = 0; i < payload.Size; ++i)
    {
      if (this->Reader.Push(payload.Bytes[i], reply))
      {
        this->Unanswered = std::max(0, this->Unanswered - 1);
        heard = true;
      }
    }
  }
  return heard;
}

// The write and the first read are under way together.
FalconExchange::Outcome FalconExchange::TryOnce(const FalconCommand& command, FalconReply& reply)
{
  const FalconPacket packet = Encode(command);
  this->DropLateReplies();
  const std::int64_t start = MonotonicNow();
  const std::uint64_t malformed = this->Reader.GetNumberOfMalformed();
  bool heard = false;
  const bool pushes = command.Torques != decltype(command.Torques){};
  if (pushes)
  {
    this->Usb.GetGuardian().SetPushes(true);
  }
  this->Out.Submit(packet.data(), packet.size(), ReplyTimeout / Millisecond, Doing);
  ++this->Unanswered;
  while (!heard && this->Reader.GetNumberOfMalformed() == malformed)
  {
    const std::int64_t rest = ReplyTimeout - (MonotonicNow() - start);
    if (rest <= 0)
    {
      break;
    }
    heard = this->ReadOnce(reply, rest);
  }
  this->Age = MonotonicNow() - start;
  const int written = this->Out.Wait();
  if (written != LIBUSB_TRANSFER_TIMED_OUT)
  {
    FalconUsb::Check(written, Doing);
  }
  this->Link.MalformedPackets.store(this->Reader.GetNumberOfMalformed(), std::memory_order_relaxed);
  if (!heard)
  {
    return Outcome::Silent;
  }
  if (this->Unanswered > 0 || this->Age > ReplyTimeout)
  {
    return Outcome::Unsure;
  }
  if (!pushes)
  {
    this->Usb.GetGuardian().SetPushes(false);
  }
  this->Link.Exchanges.fetch_add(1, std::memory_order_acq_rel); // see FalconChannel::Settle()
  return Outcome::Answered;
}

// Replies have no number, but come in the order of their packets: which is whose is known again
// once all have come, or none has come for longer than packets were apart. One that comes even
// later is looked for before each packet for a while: else all that follow would answer the packet
// before.
void FalconExchange::WaitForLateReplies(std::int64_t deadline)
{
  FalconReply late;
  std::int64_t last = MonotonicNow();
  while (this->Unanswered > 0)
  {
    const std::int64_t rest = std::min(last + QuietTime, deadline) - MonotonicNow();
    if (rest <= 0)
    {
      this->DoubtUntil = MonotonicNow() + DoubtTime;
      break;
    }
    if (this->ReadOnce(late, rest))
    {
      last = MonotonicNow();
    }
  }
  this->Unanswered = 0;
  this->Reader.Clear();
}

void FalconExchange::DropLateReplies()
{
  FalconReply late;
  while (MonotonicNow() < this->DoubtUntil && this->ReadOnce(late, Millisecond))
  {
  }
}

bool FalconExchange::IsAnswered()
{
  FalconReply reply;
  for (int i = 0; i < ProbeTries; ++i)
  {
    const Outcome outcome = this->TryOnce(FalconCommand(), reply);
    if (outcome != Outcome::Silent)
    {
      this->WaitForLateReplies(MonotonicNow() + LongestHiccup);
      return true;
    }
    this->Reader.Clear();
  }
  this->Unanswered = 0;
  return false;
}

FalconReply FalconExchange::Exchange(FalconCommand command)
{
  const std::int64_t deadline = MonotonicNow() + LongestHiccup;
  FalconReply reply;
  Outcome outcome = this->TryOnce(command, reply);
  if (outcome == Outcome::Answered)
  {
    return reply;
  }
  // The position is old now, and so is any torque that was made for it.
  command.Torques = {};
  ++this->Releases;
  int silent = 0;
  for (; outcome != Outcome::Answered; outcome = this->TryOnce(command, reply))
  {
    this->Link.MissedReplies.fetch_add(1, std::memory_order_relaxed);
    silent = outcome == Outcome::Silent ? silent + 1 : 0;
    if (silent == FailuresInARow)
    {
      throw FalconFault("The Falcon did not answer " + std::to_string(FailuresInARow) +
        " packets in a row. Check its power supply and its cable, then open it again.");
    }
    if (outcome == Outcome::Unsure)
    {
      this->WaitForLateReplies(deadline);
    }
    if (MonotonicNow() >= deadline)
    {
      throw FalconFault("The Falcon's replies come more than " +
        std::to_string(ReplyTimeout / Millisecond) +
        " ms late. Leave out hubs, relieve the machine, then open it again.");
    }
  }
  return reply;
}

void FalconExchange::WaitForNextTick()
{
  const std::int64_t now = MonotonicNow();
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
  int reported = -1;
  while (reported != FalconAllHomed)
  {
    this->Usb.CheckStop();
    const FalconReply reply = this->Exchange(command);
    if (reply.HomedLegs != reported)
    {
      reported = reply.HomedLegs;
      progress(reply.HomedLegs);
    }
    this->WaitForNextTick();
  }
}

void FalconExchange::Serve(double commandTimeout, const std::function<void()>& ready)
{
  const auto tooOld = static_cast<std::int64_t>(commandTimeout * 1e9);
  FalconCommand command;
  std::int64_t renewed = MonotonicNow() - tooOld;
  bool withdrawn = true;
  while (true)
  {
    this->Usb.CheckStop();
    const std::int64_t start = MonotonicNow();
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
      ++this->Releases;
      this->Link.LateCommands.fetch_add(1, std::memory_order_relaxed);
    }
    const FalconDemand& demand = this->Link.Demands.Get();
    if (demand.Halts != halts || demand.Releases != this->Releases)
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
    this->Link.Times.Add(static_cast<double>(MonotonicNow() - start) * 1e-9);
    this->Link.Answers.Publish({ reply, this->Releases, static_cast<double>(this->Age) * 1e-9 });
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
  this->Usb.GetGuardian().SetPushes(false);
}
}
