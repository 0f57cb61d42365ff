#include "FalconModel.h"

#include <algorithm>
#include <cerrno>

namespace
{
const std::vector<std::uint8_t> Greeting{ 0x0a, 0x43, 0x0d };
const std::vector<std::uint8_t> GreetingAnswer{ 0x0a, 0x44, 0x2c, 0x0d };
constexpr int BaudToGreet = 0x4138;
constexpr int BaudToUpload = 0x0015;
constexpr int BaudToRun = 0x0002;
constexpr std::size_t ReadSize = 62;
}

const Act* FalconModel::Find(At where, int nth) const
{
  for (const Act& act : this->Script)
  {
    if (act.Where == where && nth >= act.Nth && nth - act.Nth < act.Times)
    {
      return &act;
    }
  }
  return nullptr;
}

// What an act does to the transfer that it is played on; reads fail when they come.
int FalconModel::Perform(const Act* act)
{
  if (!act)
  {
    return 0;
  }
  switch (act->What)
  {
    case Do::Stall:
      this->Failures.push_back(-EPIPE);
      return 0;
    case Do::IoError:
      this->Failures.push_back(-EPROTO);
      return 0;
    case Do::Overflow:
      this->Failures.push_back(-EOVERFLOW);
      return 0;
    case Do::StallWrite:
      this->Halted = true;
      return -EPIPE;
    case Do::CutStatus:
      this->CutNextStatus = true;
      return 0;
    case Do::Unplug:
      this->WantsUnplug = true;
      return 0;
    case Do::Jam:
      this->Jammed = true;
      return 0;
    case Do::ForgetHome:
      this->Homed = 0;
      return 0;
    default:
      return 0;
  }
}

bool FalconModel::TakesUnplug()
{
  const bool wants = this->WantsUnplug;
  this->WantsUnplug = false;
  return wants;
}

int FalconModel::Control(int request, int value)
{
  const Act* act = this->Find(At::Control, static_cast<int>(this->Controls.size()));
  this->Controls.push_back({ request, value });
  if (act)
  {
    this->Perform(act);
    const int failure = this->Failures.empty() ? 0 : this->Failures.front();
    this->Failures.clear();
    return failure;
  }
  switch (request)
  {
    case 0:
      if (value == 1)
      {
        this->Outgoing.clear();
      }
      else
      {
        this->Incoming.clear();
      }
      break;
    case 1:
      if (value == 0x0101 && !this->Dtr && this->Baud == BaudToGreet)
      {
        this->Now = Stage::Hello;
        this->Loaded = false;
      }
      if ((value & 0x0100) != 0)
      {
        this->Dtr = (value & 1) != 0;
      }
      break;
    case 3:
      this->Baud = value;
      if (value == BaudToRun && this->Now == Stage::Upload)
      {
        this->Loaded = this->Firmware == this->Image;
      }
      if (value == BaudToRun)
      {
        this->Now = this->Loaded ? Stage::Run : Stage::Unknown;
      }
      break;
    case 9:
      this->Latency = value;
      break;
    default:
      break;
  }
  return 0;
}

void FalconModel::Say(const std::vector<std::uint8_t>& bytes, const Act* act)
{
  std::vector<std::uint8_t> said = bytes;
  const Do what = act ? act->What : Do::ForgetHome;
  if (what == Do::Silence || what == Do::Jam || what == Do::Unplug)
  {
    return;
  }
  if (what == Do::Garble)
  {
    said[said.size() / 2] ^= 0x80;
  }
  if (what == Do::Chatter)
  {
    said.insert(said.begin(), { 'x', '<', '\0', '>' });
  }
  const bool isLate = what == Do::Late;
  const auto ready = Clock::now() + (isLate ? this->LateBy : std::chrono::milliseconds(0));
  this->LateBy += isLate ? this->LaterBy : std::chrono::milliseconds(0);
  const std::size_t size = what == Do::Split ? 7 : ReadSize;
  for (std::size_t i = 0; i < said.size(); i += size)
  {
    const auto begin = said.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = said.begin() + static_cast<std::ptrdiff_t>(std::min(i + size, said.size()));
    this->Outgoing.push_back({ { begin, end }, ready });
  }
}

int FalconModel::Write(const std::uint8_t* bytes, std::size_t size)
{
  if (this->Halted)
  {
    return -EPIPE;
  }
  if (this->Now != Stage::Run || this->Baud != BaudToRun)
  {
    return this->WriteToLoader(bytes, size);
  }
  this->Incoming.insert(this->Incoming.end(), bytes, bytes + size);
  while (this->Incoming.size() >= haptics::FalconPacketSize)
  {
    haptics::FalconPacket packet;
    std::copy_n(this->Incoming.begin(), packet.size(), packet.begin());
    this->Incoming.erase(
      this->Incoming.begin(), this->Incoming.begin() + static_cast<std::ptrdiff_t>(packet.size()));
    const int status = this->TakePacket(packet);
    if (status != 0)
    {
      return status;
    }
  }
  return 0;
}

int FalconModel::WriteToLoader(const std::uint8_t* bytes, std::size_t size)
{
  const std::vector<std::uint8_t> written(bytes, bytes + size);
  if (this->Now == Stage::Hello && this->Baud == BaudToGreet && written == Greeting)
  {
    this->Say(GreetingAnswer, nullptr);
    this->Now = Stage::Start;
  }
  else if (this->Now == Stage::Start && this->Baud == BaudToUpload && !this->Dtr &&
    written == std::vector<std::uint8_t>{ 0x41 })
  {
    this->Say(written, nullptr);
    this->Firmware.clear();
    ++this->Uploads;
    this->Now = Stage::Upload;
  }
  else if (this->Now == Stage::Upload)
  {
    this->Firmware.insert(this->Firmware.end(), bytes, bytes + size);
    const Act* act = this->Find(At::Upload, this->Chunks++);
    const int status = this->Perform(act);
    this->Say(written, act);
    return status;
  }
  return 0;
}

int FalconModel::TakePacket(const haptics::FalconPacket& packet)
{
  haptics::FalconCommand command;
  if (!haptics::Decode(packet, command))
  {
    ++this->BadPackets;
    return 0;
  }
  this->Commands.push_back(command);
  if (this->OnCommand)
  {
    this->OnCommand(command);
  }
  if (!command.Home)
  {
    this->Homed = 0;
  }
  else if (this->HomesAfter >= 0 && this->Homed != haptics::FalconAllHomed)
  {
    ++this->HomingPackets;
    for (int leg = 0; leg < 3; ++leg)
    {
      if (this->HomingPackets > this->HomesAfter * (leg + 1))
      {
        this->Homed |= static_cast<std::uint8_t>(1 << leg);
      }
    }
  }
  const bool homed = this->Homed == haptics::FalconAllHomed;
  const Act* act =
    homed ? this->Find(At::Serve, this->Served++) : this->Find(At::Probe, this->Probes++);
  const int status = this->Perform(act);
  if (this->CountsPackets)
  {
    this->Encoders[0] = static_cast<std::int16_t>(FirstCount + this->Served % CountTo);
  }
  const haptics::FalconPacket reply =
    haptics::Encode(haptics::FalconReply{ this->Encoders, this->Buttons, this->Homed });
  this->Say({ reply.begin(), reply.end() }, act);
  return status;
}

std::optional<FalconModel::Answer> FalconModel::Read(Clock::time_point start)
{
  if (!this->Failures.empty())
  {
    const int status = this->Failures.front();
    this->Failures.pop_front();
    return Answer{ status, {} };
  }
  if (this->CutNextStatus)
  {
    this->CutNextStatus = false;
    return Answer{ 0, { 0x01 } };
  }
  Answer answer{ 0, { 0x01, 0x60 } };
  if (!this->Outgoing.empty() && Clock::now() >= this->Outgoing.front().NotBefore)
  {
    const std::vector<std::uint8_t>& next = this->Outgoing.front().Bytes;
    answer.Bytes.insert(answer.Bytes.end(), next.begin(), next.end());
    this->Outgoing.pop_front();
    return answer;
  }
  if (Clock::now() >= start + std::chrono::milliseconds(this->Latency))
  {
    return answer; // the latency timer ran out: the status alone
  }
  return std::nullopt;
}

FalconModel::Clock::time_point FalconModel::NextTry(Clock::time_point start) const
{
  const Clock::time_point timer = start + std::chrono::milliseconds(this->Latency);
  return this->Outgoing.empty() ? timer : std::min(timer, this->Outgoing.front().NotBefore);
}
