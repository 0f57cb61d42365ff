#include "haptics/Servo/ServoCycle.h"

#include "haptics/Devices/DeviceChannel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
// A USB device that loses a reply gets the zero 20 ms later.
constexpr std::uint64_t SettleTime = 30000000; // [ns]

bool IsFinite(const Vec3& v) noexcept
{
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}
}

ServoCycle::ServoCycle(std::size_t records)
  : Records(records)
{
}

ServoCycle::~ServoCycle() = default;

std::size_t ServoCycle::Drain(std::vector<TickRecord>& records)
{
  std::size_t drained = 0;
  // At most what the ring holds: a servo that goes on pushing cannot keep the caller here.
  for (TickRecord record; drained < this->Records.Capacity() && this->Records.Pop(record);
       ++drained)
  {
    records.push_back(record);
  }
  return drained;
}

void ServoCycle::Begin(std::shared_ptr<DeviceChannel> channel, ServoState state)
{
  for (TickRecord old; this->Records.Pop(old);)
  {
  }
  this->LostRecords.store(0, std::memory_order_relaxed);
  this->Channel = std::move(channel);
  this->Channel->Restart();
  this->Channel->Resume(); // a watchdog may have halted it in the run before
  this->Now = TickRecord();
  this->Contacts.Restart();
  this->IsFirst = true;
  this->State.store(state, std::memory_order_release);
}

bool ServoCycle::Tick(double time) noexcept
{
  DeviceSample sample;
  if (!this->Channel->Read(time, sample))
  {
    this->End(ServoState::DeviceLost);
    return false;
  }
  if (!IsFinite(sample.Position))
  {
    this->End(ServoState::InvalidPosition);
    return false;
  }

  this->NextSettings.Update();
  const ServoSettings& settings = this->NextSettings.Get();
  NumberedGodObject& god = this->Exchange.Take();
  god.Object->SetSubstepLimit(settings.SubstepLimit);
  god.Object->SetTipRadius(settings.TipRadius * settings.DeviceToWorld.Scale);
  const Vec3 hip = settings.DeviceToWorld.PointToWorld(sample.Position);
  double period = time - this->Now.Time;
  if (this->IsFirst)
  {
    this->Guard.Restart(settings.Safety);
    period = settings.Safety.NominalPeriod;
  }
  god.Object->Advance(period, this->Exchange.HasNext());
  // What was published before the first tick is what the run begins with: no change.
  if (!this->IsFirst && god.Generation != this->Now.Generation && !god.IsSeamless)
  {
    this->Guard.NoticeExchange();
  }
  if (this->IsFirst || this->Placements != settings.Placements)
  {
    const bool isPutDown = this->IsFirst && sample.Placements > 0 && IsFinite(sample.Place);
    god.Object->Place(isPutDown ? settings.DeviceToWorld.PointToWorld(sample.Place) : hip);
    this->Guard.StartSoftly(settings.Safety);
  }
  else if (!settings.IsClutched && this->DevicePlacements != sample.Placements &&
    IsFinite(sample.Place))
  {
    god.Object->Place(settings.DeviceToWorld.PointToWorld(sample.Place));
  }
  else if (!settings.IsClutched &&
    (this->WasClutched || this->DeviceToWorld != settings.DeviceToWorld))
  {
    if (!this->WasClutched) // else it stays on its side, whatever it has held on to
    {
      god.Object->Jump(hip);
    }
    this->Guard.NoticeJump();
  }
  // The first tick starts softly anyway.
  if (!this->IsFirst && this->Releases != sample.Releases)
  {
    this->Guard.Release();
    this->Guard.StartSoftly(settings.Safety);
  }
  this->Releases = sample.Releases;
  this->Placements = settings.Placements;
  this->DevicePlacements = settings.IsClutched ? this->DevicePlacements : sample.Placements;
  this->WasClutched = settings.IsClutched;
  this->DeviceToWorld = settings.DeviceToWorld;
  this->IsFirst = false;

  const Contact& contact = settings.IsClutched
    ? this->Contacts.Hold(*god.Object, sample.Position, settings.DeviceToWorld)
    : this->Contacts.Touch(*god.Object, sample.Position, hip, settings.DeviceToWorld);
  if (!IsFinite(contact.Displacement))
  {
    this->End(ServoState::InvalidForce);
    return false;
  }
  SafetySettings safety = settings.Safety;
  safety.DeviceLatency = std::max(safety.DeviceLatency, sample.Latency);
  const Vec3 force = this->Guard.Force(contact, period, settings.Force, safety);
  this->Channel->Write(force);
  this->Channel->Notice(settings.IsClutched ? Vec3{} : contact.Displacement);

  this->Now.Time = time;
  this->Now.Buttons = sample.Buttons;
  this->Record(god, force);
  return true;
}

void ServoCycle::Suspend() noexcept
{
  this->Channel->Write({});
  this->Channel->Settle(SettleTime);
}

void ServoCycle::Resume() noexcept
{
  this->Channel->Resume();
  this->Guard.Release();
  this->Guard.StartSoftly(this->NextSettings.Get().Safety);
}

void ServoCycle::Record(const NumberedGodObject& god, const Vec3& force) noexcept
{
  this->Contacts.Record(*god.Object, force, this->Guard.GetLaw(), this->Now);
  this->Now.Generation = god.Generation;
  this->Now.PassivityBalance = this->Guard.GetPassivityBalance();
  this->Now.Limits = this->Guard.GetLimits();

  this->Latest.Publish(this->Now);
  if (!this->Records.Push(this->Now))
  {
    this->LostRecords.store(
      this->LostRecords.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  ++this->Now.Tick;
}

void ServoCycle::End(ServoState state) noexcept
{
  this->Channel->Write({});
  if (this->Now.Tick > 0) // else this run has nothing to report
  {
    this->Now.Force = {};
    this->Now.WorldForce = {};
    this->Latest.Publish(this->Now);
  }
  this->State.store(state, std::memory_order_release);
  this->Channel->Settle(SettleTime);
}
}
