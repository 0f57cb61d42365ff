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
    if (!this->File.Close(closing) && !this->HasFailed.load())
    {
      this->Error = closing;
      this->HasFailed.store(true);
    }
  }
  error = this->GetFailure();
  return error.empty();
}

std::string RecordingChannel::GetFailure() const
{
  if (this->HasFailed.load(std::memory_order_acquire))
  {
    return this->Error;
  }
  const std::uint64_t overflows = this->Overflows.load();
  return overflows == 0 ? std::string()
                        : "The recording lacks " + std::to_string(overflows) +
      " ticks: its disk took no data for longer than can be kept. Choose a file on a faster one.";
}

void RecordingChannel::WaitForRoom() const
{
  while (!this->HasFailed.load(std::memory_order_acquire) &&
    this->Pushed.load() - this->Drained.load() > TicksKept / 2)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

bool RecordingChannel::Read(double time, DeviceSample& sample) noexcept
{
  this->HasSample = this->Device->Read(time, sample);
  this->Now.Time = time;
  this->Now.Position = sample.Position;
  this->Now.Buttons = sample.Buttons;
  this->Now.Placements = sample.Placements;
  this->Now.Place = sample.Place;
  this->Now.Releases = sample.Releases;
  this->Now.Latency = sample.Latency;
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
    if (this->Ring.Push(this->Now))
    {
      this->Pushed.fetch_add(1, std::memory_order_relaxed);
    }
    else
    {
      this->LostTicks.fetch_add(1, std::memory_order_relaxed);
      this->Overflows.fetch_add(1, std::memory_order_relaxed);
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
    this->Drain();
  }
}

void RecordingChannel::Drain()
{
  this->Ticks.clear();
  for (RecordedTick tick; this->Ticks.size() < TicksKept && this->Ring.Pop(tick);)
  {
    this->Ticks.push_back(tick);
  }
  if (this->HasFailed.load())
  {
    this->LostTicks.fetch_add(this->Ticks.size());
  }
  else
  {
    const std::uint64_t all = this->Written.load() + this->Ticks.size();
    // Also without a tick: the file may have been taken away meanwhile.
    const bool isWritten = this->File.Write(this->Ticks, this->Error);
    this->Written.store(this->File.GetNumberOfTicks());
    if (!isWritten)
    {
      this->LostTicks.fetch_add(all - this->File.GetNumberOfTicks());
      this->HasFailed.store(true, std::memory_order_release);
    }
  }
  this->Drained.fetch_add(this->Ticks.size());
}
}
