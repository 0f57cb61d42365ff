#include "haptics/Servo/RecordingChannel.h"

#include "haptics/Devices/EndingSignals.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace haptics
{
namespace
{
constexpr std::size_t TicksKept = 16384;
constexpr std::chrono::milliseconds WritingPeriod{ 10 };
}

RecordingChannel::RecordingChannel(std::shared_ptr<DeviceChannel> device)
  : Device(std::move(device))
  , Ring(TicksKept)
{
  this->Ticks.reserve(TicksKept);
}

RecordingChannel::~RecordingChannel()
{
  std::string ignored; // who wants to know calls Finish()
  this->Finish(ignored);
}

bool RecordingChannel::Start(
  const std::string& fileName, const RecordingHeader& header, std::string& error)
{
  if (!this->File.Open(fileName, header, error))
  {
    return false;
  }
  try
  {
    this->Thread = std::thread([this] { this->Run(); });
  }
  catch (const std::system_error& failure)
  {
    error = "The system gave no thread for the recording: " + std::string(failure.what());
    return false;
  }
  return true;
}

bool RecordingChannel::Finish(std::string& error)
{
  if (this->Thread.joinable())
  {
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->End = true;
    }
    this->Ending.notify_one();
    this->Thread.join();
    std::string closing;
    if (!this->File.Close(closing) && this->Error.empty())
    {
      this->Error = closing;
    }
  }
  error = this->Error;
  return this->Error.empty();
}

bool RecordingChannel::Read(double time, DeviceSample& sample) noexcept
{
  this->HasSample = this->Device->Read(time, sample);
  this->Now.Time = time;
  this->Now.Position = sample.Position;
  this->Now.Buttons = sample.Buttons;
  return this->HasSample;
}

void RecordingChannel::Write(const std::array<double, 3>& force) noexcept
{
  this->Device->Write(force);
  // A servo that ends writes a last zero force without having read: that is no tick.
  if (this->HasSample)
  {
    this->HasSample = false;
    this->Now.Force = force;
    this->Now.Tick = this->NextTick++;
    if (!this->Ring.Push(this->Now))
    {
      this->Lost.fetch_add(1, std::memory_order_relaxed);
    }
  }
}

void RecordingChannel::Run()
{
  LeaveEndingSignalsToOtherThreads();
  std::unique_lock<std::mutex> lock(this->Mutex);
  bool isLast = false;
  while (!isLast)
  {
    isLast = this->Ending.wait_for(lock, WritingPeriod, [this] { return this->End; });
    if (!this->Drain())
    {
      return; // what comes now is counted as lost once the ring is full
    }
  }
}

bool RecordingChannel::Drain()
{
  this->Ticks.clear();
  for (RecordedTick tick; this->Ticks.size() < TicksKept && this->Ring.Pop(tick);)
  {
    this->Ticks.push_back(tick);
  }
  if (!this->Ticks.empty() && !this->File.Write(this->Ticks, this->Error))
  {
    return false;
  }
  this->Written.fetch_add(this->Ticks.size());
  return true;
}
}
