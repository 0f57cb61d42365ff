#ifndef Haptics_LinkedChannel_h
#define Haptics_LinkedChannel_h

#include "haptics/Devices/MonitoredChannel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

namespace haptics
{
/// @brief The servo thread's end of a DeviceLink: it waits for the device's samples, judges their
/// age, and never waits for the device's thread.
template <class Link>
class LinkedChannel : public MonitoredChannel
{
public:
  explicit LinkedChannel(std::shared_ptr<Link> link)
    : Linked(std::move(link))
  {
  }

  bool SetsPace() const noexcept override { return true; }

  bool WaitForSample(std::uint64_t timeout) noexcept override
  {
    const timespec deadline = DeadlineIn(timeout);
    // The bell rang for answers that were read long ago, too.
    while (!this->TookAnswer)
    {
      this->TookAnswer = this->Linked->Answers.Update();
      if (!this->TookAnswer && !this->Linked->Bell.WaitUntil(deadline))
      {
        return false;
      }
    }
    return true;
  }

  void Settle(std::uint64_t timeout) noexcept override
  {
    const timespec deadline = DeadlineIn(timeout);
    // The exchange that is under way may carry the demand before; the next one carries the last.
    // Read by an addition: whatever adds after it sees the demand.
    const std::uint64_t enough =
      this->Linked->Exchanges.fetch_add(0, std::memory_order_acq_rel) + 2;
    while (this->Linked->Exchanges.load(std::memory_order_acquire) < enough &&
      !this->Linked->Over.load(std::memory_order_acquire) && this->Linked->Bell.WaitUntil(deadline))
    {
    }
  }

protected:
  enum class Reading
  {
    Down,   ///< the device does not answer any more
    Silent, ///< no answer came for 0.2 s
    Answer
  };

  /// Takes the newest answer. Where its device is silent, the device's thread gives up first; this
  /// is for one that gets no time, or that waits in a call to a vendor's library.
  Reading Take(double time) noexcept
  {
    constexpr double longestSilence = 0.2; // [s]
    if (!this->Linked->Up.load(std::memory_order_acquire))
    {
      return Reading::Down;
    }
    const bool isAnswered = this->Linked->Answers.Update() || this->TookAnswer;
    this->TookAnswer = false;
    if (isAnswered || time < this->Answered)
    {
      this->Answered = time; // a smaller time: the servo was started anew
    }
    else if (time - this->Answered > longestSilence)
    {
      return Reading::Silent;
    }
    return Reading::Answer;
  }

  /// Whether the position is new enough for a force.
  bool IsFresh(double time) const noexcept
  {
    constexpr double oldestPosition = 0.02; // [s]
    return time - this->Answered + this->Linked->Answers.Get().Age <= oldestPosition;
  }

  /// Reports a sample's latency and the releases so far. Each tick without a force is one, so that
  /// the force grows from zero after the last of them.
  void Account(bool hasForce, DeviceSample& sample) noexcept
  {
    // What the servo writes waits for the next exchange, at most so long or until the last is over.
    constexpr double exchangePeriod = 0.001; // [s]
    const auto& answer = this->Linked->Answers.Get();
    sample.Latency = std::max(exchangePeriod, answer.Age) + answer.Age;
    this->OwnReleases += hasForce ? 0 : 1;
    sample.Releases = static_cast<std::uint32_t>(answer.Releases) + this->OwnReleases;
  }

  void Demand(const std::array<double, 3>& wanted) noexcept
  {
    this->Linked->Demands.Publish({ wanted, this->Linked->Halts.load(std::memory_order_acquire),
      this->Linked->Answers.Get().Releases });
  }

  void HaltDevice() noexcept override
  {
    this->Linked->Halts.fetch_add(1, std::memory_order_acq_rel);
  }

  const std::shared_ptr<Link> Linked;

private:
  // The servo thread's own.
  bool TookAnswer = false; // by WaitForSample()
  double Answered = 0.0;   // when the last new answer was read [s]
  std::uint32_t OwnReleases = 0;
};
}

#endif
