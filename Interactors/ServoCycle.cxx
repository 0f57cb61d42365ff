#include "ServoCycle.h"

#include "DeviceChannel.h"

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
  this->Lost.store(0, std::memory_order_relaxed);
  this->Channel = std::move(channel);
  this->Channel->Restart();
  this->Channel->Resume(); // a watchdog may have halted it in the run before
  this->Now = TickRecord();
  this->IsFirst = true;
  this->MustPlace = true;
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
  const Vec3 hip = settings.DeviceToWorld.PointToWorld(sample.Position);
  double period = time - this->Now.Time;
  if (this->IsFirst)
  {
    this->Guard.Restart(settings.Safety);
    period = settings.Safety.NominalPeriod;
  }
  god.Object->Advance(period, this->Exchange.HasNext());
  if (this->NoticeJumps(god, settings))
  {
    god.Object->Place(hip);
  }

  const Contact& contact = god.Object->Update(hip);
  GuardedContact guarded;
  guarded.Position = sample.Position;
  guarded.Period = period;
  if (contact.Status != UpdateStatus::InvalidHip)
  {
    guarded.Displacement = settings.DeviceToWorld.VectorToDevice(contact.Displacement);
    guarded.Touching =
      contact.NumberOfConstraints > 0 || contact.Status == UpdateStatus::Overloaded;
    guarded.SurfaceStep = settings.DeviceToWorld.VectorToDevice(contact.Carried);
    guarded.Felt = contact.Felt;
    if (contact.Felt.IsShaded)
    {
      guarded.Shaded = settings.DeviceToWorld.VectorToDevice(contact.Shaded);
    }
    if (!IsFinite(guarded.Displacement))
    {
      this->End(ServoState::InvalidForce);
      return false;
    }
  }
  const Vec3 force = this->Guard.Force(guarded, settings.Force, settings.Safety);
  this->Channel->Write(force);

  this->Now.Time = time;
  this->Now.DevicePosition = sample.Position;
  this->Now.Buttons = sample.Buttons;
  this->Record(god, force);
  return true;
}

bool ServoCycle::NoticeJumps(const NumberedGodObject& god, const ServoSettings& settings) noexcept
{
  const bool mustPlace = this->MustPlace || this->Placements != settings.Placements;
  // What was published before the first tick is what the run begins with: no change.
  const bool changed = !this->IsFirst && god.Generation != this->Now.Generation && !god.IsSeamless;
  if (mustPlace || changed)
  {
    this->Guard.StartSoftly(settings.Safety);
  }
  this->MustPlace = false;
  this->Placements = settings.Placements;
  this->IsFirst = false;
  return mustPlace;
}

void ServoCycle::Resume() noexcept
{
  this->Channel->Resume();
  this->Guard.Release();
  this->Guard.StartSoftly(this->NextSettings.Get().Safety);
}

void ServoCycle::Record(NumberedGodObject& god, const Vec3& force) noexcept
{
  const Contact& contact = god.Object->Current();
  this->Now.Force = force;
  this->Now.WorldForce = this->NextSettings.Get().DeviceToWorld.DirectionToWorld(force);
  this->Now.Hip = contact.Hip;
  this->Now.GodObject = contact.Position;
  if (contact.NumberOfConstraints > 0)
  {
    this->Now.Local = god.Object->LocalPosition(contact.Constraints[0].Surface);
    this->Now.DeformFraction = god.Object->DeformFraction(contact.Constraints[0].Surface);
  }
  this->Now.Penetration = contact.Penetration;
  this->Now.Status = contact.Status;
  this->Now.NumberOfConstraints = contact.NumberOfConstraints;
  this->Now.Constraints = contact.Constraints;
  this->Now.Generation = god.Generation;
  this->Now.Stiffness = this->Guard.GetStiffness();
  this->Now.Energy = this->Guard.GetEnergy();
  this->Now.Tank = this->Guard.GetTank();
  this->Now.Limits = this->Guard.GetLimits();

  this->Latest.Publish(this->Now);
  if (!this->Records.Push(this->Now))
  {
    this->Lost.store(this->Lost.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  ++this->Now.Tick;
}

void ServoCycle::End(ServoState state) noexcept
{
  this->Channel->Write({});
  if (this->Now.Tick > 0) // else there is nothing that this run could tell
  {
    this->Now.Force = {};
    this->Now.WorldForce = {};
    this->Latest.Publish(this->Now);
  }
  this->State.store(state, std::memory_order_release);
  this->Channel->Settle(SettleTime);
}
}
