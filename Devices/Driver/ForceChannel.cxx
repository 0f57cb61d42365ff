#include "haptics/Devices/Driver/ForceChannel.h"

#include "haptics/Devices/Driver/ForceLink.h"

#include <algorithm>
#include <utility>

namespace haptics
{
namespace
{
// A driver gives up a silent device by itself; this is for one that gets no time, or that waits in
// a call to the vendor's library.
constexpr double LongestSilence = 0.2; // [s]
// A force for an older position is none.
constexpr double OldestPosition = 0.02; // [s]
// What the servo writes waits for the next exchange.
constexpr double ExchangePeriod = 0.001; // [s]
}

ForceChannel::ForceChannel(std::shared_ptr<ForceLink> link)
  : Link(std::move(link))
{
}

ForceChannel::~ForceChannel() = default;

bool ForceChannel::ReadDevice(double time, DeviceSample& sample) noexcept
{
  if (!this->Link->Up.load(std::memory_order_acquire))
  {
    return false;
  }
  const bool isAnswered = this->Link->Answers.Update() || this->TookAnswer;
  this->TookAnswer = false;
  if (isAnswered || time < this->Answered)
  {
    this->Answered = time; // a smaller time: the servo was started anew
  }
  else if (time - this->Answered > LongestSilence)
  {
    this->Starved.store(true, std::memory_order_release);
    return false;
  }
  const LinkAnswer& answer = this->Link->Answers.Get();
  sample.Position = answer.Sample.Position;
  sample.Buttons = answer.Sample.Buttons;
  sample.Latency = std::max(ExchangePeriod, answer.Age) + answer.Age;
  // In each tick without one: the force grows from zero after the last of them.
  this->IsFresh = time - this->Answered + answer.Age <= OldestPosition;
  this->OwnReleases += this->IsFresh ? 0 : 1;
  sample.Releases = static_cast<std::uint32_t>(answer.Releases) + this->OwnReleases;
  return true;
}

void ForceChannel::WriteDevice(const std::array<double, 3>& force) noexcept
{
  this->Link->Demands.Publish({ this->IsFresh ? force : std::array<double, 3>{},
    this->Link->Halts.load(std::memory_order_acquire), this->Link->Answers.Get().Releases });
}

void ForceChannel::HaltDevice() noexcept
{
  this->Link->Halts.fetch_add(1, std::memory_order_acq_rel);
}

bool ForceChannel::WaitForSample(std::uint64_t timeout) noexcept
{
  const timespec deadline = DeadlineIn(timeout);
  // The bell rang for answers that were read long ago, too.
  while (!this->TookAnswer)
  {
    this->TookAnswer = this->Link->Answers.Update();
    if (!this->TookAnswer && !this->Link->Bell.WaitUntil(deadline))
    {
      return false;
    }
  }
  return true;
}

void ForceChannel::Settle(std::uint64_t timeout) noexcept
{
  const timespec deadline = DeadlineIn(timeout);
  // The exchange that is under way may carry the demand before; the next one carries the last.
  // Read by an addition: whatever adds after it sees the demand.
  const std::uint64_t enough = this->Link->Exchanges.fetch_add(0, std::memory_order_acq_rel) + 2;
  while (this->Link->Exchanges.load(std::memory_order_acquire) < enough &&
    !this->Link->Over.load(std::memory_order_acquire) && this->Link->Bell.WaitUntil(deadline))
  {
  }
}
}
