#include "haptics/Devices/Driver/ForceExchange.h"

#include "haptics/Devices/MonotonicClock.h"

#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
constexpr std::int64_t CommandTimeout = 20000000; // [ns]
}

ForceExchange::ForceExchange(std::shared_ptr<ForceLink> link, double maximumForce)
  : Link(std::move(link))
  , MaximumForce(maximumForce)
  , RenewedAt(MonotonicNow() - CommandTimeout)
{
}

std::array<double, 3> ForceExchange::NextForce() noexcept
{
  const std::uint64_t halts = this->Link->Halts.load(std::memory_order_acquire);
  const std::int64_t now = MonotonicNow();
  if (this->Link->Demands.Update())
  {
    this->RenewedAt = now;
    this->IsWithdrawn = false;
  }
  else if (!this->IsWithdrawn && now - this->RenewedAt > CommandTimeout)
  {
    this->IsWithdrawn = true;
    this->LetGo();
    this->Link->LateCommands.fetch_add(1, std::memory_order_relaxed);
  }
  const LinkDemand& demand = this->Link->Demands.Get();
  std::array<double, 3> force = demand.Force;
  const double magnitude = std::hypot(force[0], force[1], force[2]);
  if (this->IsWithdrawn || demand.Halts != halts || demand.Releases != this->Releases ||
    !std::isfinite(magnitude))
  {
    return {};
  }
  const double share = magnitude > this->MaximumForce ? this->MaximumForce / magnitude : 1.0;
  for (double& component : force)
  {
    component *= share;
  }
  return force;
}

void ForceExchange::LetGo() noexcept
{
  ++this->Releases;
  this->Link->Releases.fetch_add(1, std::memory_order_relaxed);
}

void ForceExchange::Publish(const DriverSample& sample, double age) noexcept
{
  this->Link->Times.Add(age);
  this->Link->Shown.Publish(sample);
  this->Link->Answers.Publish({ sample, this->Releases, age });
  this->Link->Exchanges.fetch_add(1, std::memory_order_acq_rel);
  this->Link->Bell.Ring();
}
}
