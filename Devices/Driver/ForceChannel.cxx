#include "haptics/Devices/Driver/ForceChannel.h"

#include <utility>

namespace haptics
{
ForceChannel::ForceChannel(std::shared_ptr<ForceLink> link)
  : LinkedChannel(std::move(link))
{
}

ForceChannel::~ForceChannel() = default;

bool ForceChannel::ReadDevice(double time, DeviceSample& sample) noexcept
{
  const Reading reading = this->Take(time);
  if (reading == Reading::Silent)
  {
    this->Starved.store(true, std::memory_order_release);
  }
  if (reading != Reading::Answer)
  {
    return false;
  }
  const LinkAnswer& answer = this->Linked->Answers.Get();
  sample.Position = answer.Sample.Position;
  sample.Buttons = answer.Sample.Buttons;
  this->HasForce = this->IsFresh(time);
  this->Account(this->HasForce, sample);
  return true;
}

void ForceChannel::WriteDevice(const std::array<double, 3>& force) noexcept
{
  this->Demand(this->HasForce ? force : std::array<double, 3>{});
}
}
