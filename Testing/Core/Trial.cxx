#include "Trial.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr int WaysToPress = 6;
constexpr int WaysToBeStuck = 5;
constexpr int TicksToPress = 4;
constexpr double LiftClearances = 30.0;
constexpr double StuckShare = 0.02;
/// Of a clearance: some 16 roundings. A wire that thin passes a point as it passes its neighbours.
constexpr double RoundingShare = 1.0 / 64.0;
/// The core's word: a coordinate under this share of a surface's radius is 0 there.
constexpr double NegligibleShare = 0x1p-68;
}

const char* NameOf(Fault fault)
{
  static const char* const names[] = { "CROSSING", "GRAZE", "GAP", "AWAY", "PHANTOM", "STUCK",
    "BALANCE" };
  return names[static_cast<int>(fault)];
}

TrialCount& TrialCount::operator+=(const TrialCount& other)
{
  this->Ticks += other.Ticks;
  this->Contacts += other.Contacts;
  this->Pieces += other.Pieces;
  this->Views += other.Views;
  this->Presses += other.Presses;
  this->Unanswered += other.Unanswered;
  for (std::size_t i = 0; i < std::size(this->Faults); ++i)
  {
    this->Faults[i] += other.Faults[i];
  }
  return *this;
}

GodObjectFollower::GodObjectFollower(std::vector<TouchedSurface> surfaces, int substepLimit)
  : Point(std::move(surfaces))
{
  this->Point.SetSubstepLimit(substepLimit);
}

Vec3 GodObjectFollower::Place(const Vec3& position)
{
  const Vec3 world = this->Point.WayOrigin() + position;
  this->Point.Place(world);
  return world - this->Point.WayOrigin();
}

const std::vector<Vec3>& GodObjectFollower::Follow(const Vec3& hip, Vec3& goal)
{
  const Vec3 world = this->Point.WayOrigin() + hip;
  goal = world - this->Point.WayOrigin();
  this->Point.Update(world);
  int size = 0;
  const Vec3* const way = this->Point.Way(size);
  this->Corners.assign(way, way + size);
  return this->Corners;
}

bool GodObjectFollower::Answers() const
{
  const UpdateStatus status = this->Point.Current().Status;
  return status == UpdateStatus::Free || status == UpdateStatus::Touching;
}

std::vector<Vec3> GodObjectFollower::Supports() const
{
  std::vector<Vec3> normals;
  const Contact& contact = this->Point.Current();
  for (int i = 0; i < contact.NumberOfConstraints; ++i)
  {
    normals.push_back(contact.Constraints[i].Normal);
  }
  return normals;
}

Trial::Trial(std::vector<Part> parts, Follower& follower, Follower& probe, const Settings& settings)
  : Parts(std::move(parts))
  , Tried(follower)
  , Probe(probe)
  , Set(settings)
  , Random(settings.Seed)
{
}

std::vector<Trial::Part> Trial::PartsOf(const std::vector<TouchedSurface>& surfaces)
{
  std::vector<Part> parts;
  for (const TouchedSurface& touched : surfaces)
  {
    const TriangleSurface& surface = *touched.Surface;
    parts.push_back({ std::make_shared<Judge>(surface),
      surface.Origin() - surfaces.front().Surface->Origin(), NegligibleShare * surface.Radius() });
  }
  return parts;
}

Trial::Settings Trial::SettingsOf(const std::vector<TouchedSurface>& surfaces)
{
  Settings settings;
  for (const TouchedSurface& touched : surfaces)
  {
    const TriangleSurface& surface = *touched.Surface;
    settings.Clearance = std::max(settings.Clearance, surface.Clearance());
    for (const double x : surface.Origin())
    {
      settings.Resolution =
        std::max(settings.Resolution, 0x1p-52 * (std::abs(x) + surface.Radius()));
    }
  }
  return settings;
}

Vec3 Trial::LocalOf(const Part& part, const Vec3& x) const
{
  Vec3 local = x - part.Offset;
  for (double& coordinate : local)
  {
    coordinate = std::abs(coordinate) < part.Negligible ? 0.0 : coordinate;
  }
  return local;
}

bool Trial::Crosses(const Vec3& from, const Vec3& to) const
{
  return std::any_of(this->Parts.begin(), this->Parts.end(),
    [&](const Part& part)
    { return part.Surface->Crosses(this->LocalOf(part, from), this->LocalOf(part, to)); });
}

bool Trial::IsFree(const Vec3& from, const Vec3& to) const
{
  return std::none_of(this->Parts.begin(), this->Parts.end(),
    [&](const Part& part)
    {
      const Vec3 p = this->LocalOf(part, from);
      const Vec3 q = this->LocalOf(part, to);
      return part.Surface->Crosses(p, q) || part.Surface->FindGrazed(p, q) != Judge::Nothing;
    });
}

bool Trial::IsInPlainView(const Vec3& goal, const Vec3& eye) const
{
  return std::all_of(this->Parts.begin(), this->Parts.end(),
    [&](const Part& part)
    {
      return part.Surface->IsInPlainView(
        this->LocalOf(part, goal), this->LocalOf(part, eye), RoundingShare * this->Set.Clearance);
    });
}

bool Trial::IsWellFree(const Vec3& from, const Vec3& to) const
{
  return this->IsFree(from, to) &&
    std::all_of(this->Parts.begin(), this->Parts.end(),
      [&](const Part& part)
      {
        return part.Surface->IsInView(this->LocalOf(part, to), this->LocalOf(part, from), 0.0,
          RoundingShare * this->Set.Clearance);
      });
}

void Trial::Report(Finding finding)
{
  ++this->Counted[finding.What];
  if (this->OnFault)
  {
    this->OnFault(finding);
  }
}

bool Trial::Place(const Vec3& position)
{
  const bool isOn = std::any_of(this->Parts.begin(), this->Parts.end(),
    [&](const Part& part) { return part.Surface->IsOnTriangle(this->LocalOf(part, position)); });
  if (!isOn)
  {
    this->Tried.Place(position);
    this->IsPlaced = false;
  }
  return !isOn;
}

void Trial::Lead(const Vec3& hip)
{
  const Vec3 before = this->Now;
  const std::vector<Vec3>& way = this->Tried.Follow(hip, this->Goal);
  ++this->Counted.Ticks;
  if (this->IsPlaced && way.front() != before)
  {
    this->Report({ Fault::Gap, before, way.front(), this->Goal });
  }
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
  {
    ++this->Counted.Pieces;
    for (std::size_t k = 0; k < this->Parts.size(); ++k)
    {
      const Part& part = this->Parts[k];
      const Vec3 from = this->LocalOf(part, way[i]);
      const Vec3 to = this->LocalOf(part, way[i + 1]);
      const int index = static_cast<int>(k);
      const std::int32_t crossed = part.Surface->FindCrossed(from, to);
      if (crossed != Judge::Nothing)
      {
        this->Report({ Fault::Crossing, way[i], way[i + 1], this->Goal, index, crossed });
      }
      const std::int32_t grazed = part.Surface->FindGrazed(from, to);
      if (grazed != Judge::Nothing)
      {
        this->Report({ Fault::Graze, way[i], way[i + 1], this->Goal, index, grazed });
      }
    }
  }
  this->Now = way.back();
  const double farther = Length(this->Now - this->Goal) - Length(way.front() - this->Goal);
  if (farther > 1e-9 * Length(way.front() - this->Goal) + this->Set.Clearance)
  {
    this->Report({ Fault::Away, way.front(), this->Now, this->Goal });
  }
  if (this->OnTick)
  {
    this->OnTick(way.front(), this->Now, this->Goal);
  }
  this->IsPlaced = true;
}

bool Trial::IsFarFromGoal() const
{
  const double distance = Length(this->Now - this->Goal);
  const double most = this->Set.Clearances;
  if (distance <= most * this->Set.Clearance)
  {
    return false;
  }
  // A sliver is kept at a distance of its own.
  return std::none_of(this->Parts.begin(), this->Parts.end(),
    [&](const Part& part)
    {
      return distance <= most * part.Surface->LargestSliverClearance() &&
        distance <= most * part.Surface->SliverClearance(this->LocalOf(part, this->Now), distance);
    });
}

void Trial::Tick(const Vec3& hip)
{
  this->Lead(hip);
  if (!this->Tried.Answers())
  {
    ++this->Counted.Unanswered;
    return;
  }
  if (this->Now == this->Goal)
  {
    return;
  }
  ++this->Counted.Contacts;
  if (this->IsFarFromGoal())
  {
    this->LookForPhantom(hip);
  }
  if (this->Set.PressEvery > 0 && ++this->SincePress >= this->Set.PressEvery)
  {
    this->SincePress = 0;
    this->PressAgain(hip);
  }
}

void Trial::LookForPhantom(const Vec3& hip)
{
  ++this->Counted.Views;
  const Vec3 from = this->Now;
  for (int tick = 0; this->IsFarFromGoal() && this->IsInPlainView(this->Goal, this->Now); ++tick)
  {
    if (tick == this->Set.Rest)
    {
      this->Report({ Fault::Phantom, from, this->Now, this->Goal });
      return;
    }
    this->Lead(hip);
    if (!this->Tried.Answers())
    {
      return;
    }
  }
}

bool Trial::Lift(int attempt, double height)
{
  std::normal_distribution<double> normal;
  Vec3 outward = Unit(this->Now - this->Goal);
  const std::vector<Vec3> supports = this->Tried.Supports();
  if (attempt % 2 == 1 && !supports.empty())
  {
    Vec3 sum{};
    for (const Vec3& support : supports)
    {
      sum = sum + support;
    }
    outward = Length(sum) > 0.0 ? Unit(sum) : outward;
  }
  for (int halving = 0; halving < 3; ++halving, height *= 0.5)
  {
    const double x = normal(this->Random);
    const double y = normal(this->Random);
    const Vec3 kick = Unit({ x, y, normal(this->Random) });
    const Vec3 lifted = this->Probe.Place(this->Now + height * Unit(outward + 0.3 * kick));
    if (this->IsFree(this->Now, lifted))
    {
      return true;
    }
  }
  return false;
}

bool Trial::HasDescent(double reach, double length) const
{
  const Vec3 pull = Unit(this->Goal - this->Now);
  std::vector<Vec3> normals;
  for (const Part& part : this->Parts)
  {
    const std::vector<Vec3> more = part.Surface->NormalsNear(this->LocalOf(part, this->Now), reach);
    normals.insert(normals.end(), more.begin(), more.end());
  }
  const auto leads = [&](const Vec3& along)
  {
    // Steeper than 1 in 1000, and so long that it does not end in the clearance of a narrow fold.
    const double steep = Dot(along, pull);
    return steep > 1e-3 * Length(along) && Length(along) > 1e-3 &&
      this->IsWellFree(this->Now, this->Now + (length / Length(along)) * along);
  };
  if (leads(pull))
  {
    return true;
  }
  constexpr std::size_t most = 64;
  normals.resize(std::min(normals.size(), most));
  for (const Vec3& n : normals)
  {
    if (leads(pull - Dot(pull, n) * n))
    {
      return true;
    }
    for (const Vec3& m : normals)
    {
      const Vec3 crease = Cross(n, m);
      if (leads(Dot(crease, pull) * crease))
      {
        return true;
      }
    }
  }
  return false;
}

void Trial::PressAgain(const Vec3& hip)
{
  double clearance = this->Set.Clearance;
  const double distanceBefore = Length(this->Now - this->Goal);
  for (const Part& part : this->Parts)
  {
    if (part.Surface->LargestSliverClearance() > clearance)
    {
      clearance = std::max(clearance,
        part.Surface->SliverClearance(
          this->LocalOf(part, this->Now), 4.0 * part.Surface->LargestSliverClearance()));
    }
  }
  const double lift = std::max(LiftClearances * clearance, 32.0 * this->Set.Resolution);
  // So near that the lift itself would count.
  if (distanceBefore < 1e2 * lift)
  {
    return;
  }
  // As long at rest as those that press again are given.
  for (int tick = 0; tick < TicksToPress; ++tick)
  {
    this->Lead(hip);
  }
  const double distance = Length(this->Now - this->Goal);
  if (!this->Tried.Answers() || distance < 1e2 * lift)
  {
    return;
  }
  ++this->Counted.Presses;
  int nearer = 0;
  int missed = 0;
  double best = 0.0;
  for (int way = 0; way < WaysToPress && missed <= WaysToPress - WaysToBeStuck; ++way)
  {
    Vec3 goal;
    double reached = distance;
    if (this->Lift(way, lift))
    {
      for (int tick = 0; tick < TicksToPress; ++tick)
      {
        const std::vector<Vec3>& corners = this->Probe.Follow(hip, goal);
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
        {
          ++this->Counted.Pieces;
          if (this->Crosses(corners[i], corners[i + 1]))
          {
            this->Report({ Fault::Crossing, corners[i], corners[i + 1], this->Goal });
          }
        }
        reached = Length(corners.back() - this->Goal);
      }
    }
    const double share = 1.0 - reached / distance;
    (share > StuckShare ? nearer : missed)++;
    best = std::max(best, share);
  }
  if (nearer >= WaysToBeStuck)
  {
    const Fault fault = this->HasDescent(2.0 * lift, std::min(50.0 * lift, 0.5 * distance))
      ? Fault::Stuck
      : Fault::Balance;
    Finding finding{ fault, this->Now, this->Now, this->Goal };
    finding.Share = best;
    this->Report(finding);
  }
}
}
