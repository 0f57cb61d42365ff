#include "haptics/Contact/Neighbourhood.h"

#include <algorithm>
#include <utility>

namespace haptics
{
namespace
{
/// About as many make gathering rare and scanning quick.
constexpr double WantedInBall = 16.0;
/// How far ahead of the god-object a ball is centred, in radii.
constexpr double ShareAhead = 0.9;
/// Of the distance from the surface, a ball that is hoped to be empty after a while.
constexpr double ShareFree = 0.9;
/// Of the radius of a ball of as many as wanted: one that is empty, and smaller, does not serve.
constexpr double ShareOfWanted = 0.5;
/// Of the surface's radius: the engine is asked about places no farther from the middle.
constexpr double FarthestOut = 1.5;
/// So many radii of a ball are a leap.
constexpr double RadiiOfLeap = 4.0;
/// Of a patch's radius.
constexpr double ShareOfPatch = 1.0 / 64.0;

/// How far ahead of a motion a ball is centred, so that it serves the next ones too: not where it
/// does not hold this one.
Vector Ahead(const Vector& way, double radius)
{
  const double length = glm::length(way);
  const bool isShort = length > 0.0 && length < 2.0 * radius;
  return (isShort ? ShareAhead * radius / length : 0.0) * way;
}

std::size_t CapacityFor(const TriangleSurface& surface)
{
  return std::min<std::size_t>(Neighbourhood::LargestNumberOfTriangles, surface.Triangles().size());
}
}

Neighbourhood::Neighbourhood(const std::shared_ptr<const TriangleSurface>& surface)
  : Table(surface, CapacityFor(*surface))
  , Triangles(CapacityFor(*surface))
  , RadiusToTry(surface->Radius())
{
}

TriangleList Neighbourhood::Scratch()
{
  return { this->Triangles.data(), static_cast<std::int32_t>(this->Triangles.size()) };
}

void Neighbourhood::KeepClearOfRounding(double distance)
{
  const TriangleSurface& surface = this->Table.Surface().Surface();
  this->SmallestClearance =
    std::max(surface.Clearance(), 1024.0 * UnitRoundoff * (distance + surface.Radius()));
  this->Reach = LargestGrowth(this->SmallestClearance, surface.Radius());
}

void Neighbourhood::KeepClearAfterMove(double distance)
{
  const double farthest = this->SmallestClearance / (1024.0 * UnitRoundoff);
  if (distance + this->Table.Surface().Surface().Radius() > farthest)
  {
    this->KeepClearOfRounding(distance);
    // Twice as far, so that one that goes on does not come here in every tick.
    this->SmallestClearance *= 2.0;
    this->Reach *= 2.0;
    this->Forget();
    this->ForgetEmptyBall();
  }
}

void Neighbourhood::Continue(const Neighbourhood& previous)
{
  this->SmallestClearance = std::max(this->SmallestClearance, previous.SmallestClearance);
  this->Reach = std::max(this->Reach, previous.Reach);
  this->RadiusToTry = previous.RadiusToTry;
  this->FreeRadius = previous.FreeRadius;
  this->IsFreeGrowing = previous.IsFreeGrowing;
  this->LargestToTry = previous.LargestToTry;
  this->MostInBall = previous.MostInBall;
  this->LeapMetNear = previous.LeapMetNear;
}

/// Whether a ball holds no place where triangles may be missing.
bool Neighbourhood::IsWithinPatch(const Vector& centre, double radius) const
{
  const SurfacePatch* const patch = this->Table.Surface().Surface().Patch();
  return !patch || patch->Region().DistanceTo(ToVec3(centre)) + radius <= patch->Region().Radius;
}

void Neighbourhood::TakeOver(const Neighbourhood& previous)
{
  this->Place(previous.Table.Position());
  this->Continue(previous);
  this->GatheredAt = previous.GatheredAt;
  if (previous.HasBall() && previous.IsWithinPatch(previous.Table.Centre(), previous.Radius) &&
    this->Table.TakeOver(previous.Table))
  {
    this->Covered = Region::Ball;
    this->Radius = previous.Radius;
    this->EmptyCentre = previous.EmptyCentre;
    this->EmptyRadius = previous.EmptyRadius;
    this->FoundCount = 0; // only a sweep asks for it, and a patch is not swept
  }
}

void Neighbourhood::ForgetLearned()
{
  this->EmptyRadius = 0.0;
  this->RadiusToTry = this->Table.Surface().Surface().Radius();
  this->FreeRadius = 0.0;
  this->IsFreeGrowing = true;
  this->LargestToTry = HUGE_VAL;
  this->MostInBall = FewInBall;
  this->LeapMetNear = false;
  this->GatheredAt = this->Table.Position();
}

bool Neighbourhood::IsFarOut() const
{
  const double far = 8.0 * this->Table.Surface().Surface().Radius();
  return SquaredLength(this->Table.Position()) > far * far;
}

bool Neighbourhood::IsLeap(const Vector& to) const
{
  const double far = RadiiOfLeap * this->RadiusToTry;
  return SquaredLength(to - this->Table.Position()) > far * far && !this->IsFarOut();
}

bool Neighbourhood::MayHold(const Vector& x) const
{
  const double far = (1.0 + ShareAhead) * this->RadiusToTry;
  return SquaredLength(x - this->Table.Position()) <= far * far;
}

bool Neighbourhood::PassesThroughNothing(const Vector& to)
{
  const bool isEmpty =
    this->HasBall() && this->IsEmptyAround(this->Table.Position()) && this->IsEmptyAround(to);
  if (isEmpty)
  {
    this->Table.SetTarget(to);
  }
  return isEmpty;
}

bool Neighbourhood::GoesNowhere(const Vector& to)
{
  // The distance from a thin facet is another one, by rounding, as position and as target.
  const bool isNowhere =
    to == this->Table.Position() && this->HasBall() && !this->Table.HasThin() && this->IsInBall(to);
  if (isNowhere)
  {
    this->Table.SetTarget(to);
  }
  return isNowhere;
}

bool Neighbourhood::GatherBallAhead(const Vector& way, WorkBudget& budget)
{
  this->Forget();
  const TriangleSurface& surface = this->Table.Surface().Surface();
  const Vector position = this->Table.Position();
  this->GatheredAt = position;
  const double surfaceRadius = surface.Radius();
  const double fromOrigin = glm::length(position);
  if (fromOrigin > FarthestOut * surfaceRadius)
  {
    // No triangle is this far out.
    this->Radius = (fromOrigin - surfaceRadius) * (1.0 - 0x1p-40);
    this->RadiusToTry = surfaceRadius;
    this->Table.Clear(position);
    this->FoundCount = 0;
    this->EmptyCentre = position;
    this->EmptyRadius = this->Radius;
    this->MeasurePosition();
    this->Covered = Region::Ball;
    return true;
  }
  const auto capacity = static_cast<std::int32_t>(this->Triangles.size());
  double radius = this->RadiusToTry;
  const double smallest = 0x1p-20 * surfaceRadius;
  const SurfacePatch* const patch = surface.Patch();
  // What would leave a patch is halved as what has too many triangles, as the whole surface's has:
  // so both are measured alike. At the rim a ball as small as this may leave it.
  const double smallestInPatch = patch ? ShareOfPatch * patch->Region().Radius : HUGE_VAL;
  while (budget.Triangles > 0)
  {
    const Vector centre = position + Ahead(way, radius);
    TriangleList found{ this->Triangles.data(), std::min(capacity, this->MostInBall) };
    if (radius > smallestInPatch && !this->IsWithinPatch(centre, radius))
    {
      found.Overflow = true;
    }
    else
    {
      surface.Engine().FindInBall(ToVec3(centre), radius, found);
      budget.Triangles -= found.Count;
    }
    if (!found.Overflow)
    {
      this->Radius = radius * (1.0 - 0x1p-40);
      this->FreeRadius = ShareFree * this->Fill(found, centre, centre, radius, radius);
      this->Covered = Region::Ball;
      const double change = std::sqrt(WantedInBall / (this->Table.Size() + 1.0));
      // A surface of small triangles comes into a growing ball all at once: a radius that was too
      // large is not tried again soon.
      this->LargestToTry *= 1.05;
      this->RadiusToTry =
        std::min({ radius * std::clamp(change, 0.5, 4.0), surfaceRadius, this->LargestToTry });
      if (found.Count < this->MostInBall / 4)
      {
        this->MostInBall = std::max(FewInBall, this->MostInBall / 2);
      }
      return true;
    }
    if (radius > smallest)
    {
      this->LargestToTry = 0.7 * radius;
      radius *= 0.5;
    }
    else if (this->MostInBall < capacity)
    {
      this->MostInBall *= 4;
      this->LargestToTry = HUGE_VAL;
    }
    else
    {
      return false;
    }
  }
  return false;
}

bool Neighbourhood::GatherBallFor(const Vector& to, WorkBudget& budget)
{
  const bool wasEmpty = this->HasBall() && this->Table.Size() == 0;
  if (this->HasBall() && !wasEmpty && this->Table.IsPositionMeasured())
  {
    // What has come nearer shows by its planes, before the engine is asked in vain.
    this->FreeRadius = ShareFree * std::min(this->Table.NearestPlane(), this->Radius);
  }
  const double radius = this->FreeRadius;
  // What goes away from a surface is soon far from it.
  if (wasEmpty && this->IsFreeGrowing && this->GatherNothing(2.0 * radius, to))
  {
    return true;
  }
  this->IsFreeGrowing = !wasEmpty;
  return this->GatherNothing(radius, to) ||
    this->GatherBallAhead(to - this->Table.Position(), budget);
}

/// In free space a ball in which there is nothing serves as long, and the engine looks at little
/// for it. False where there is something in it, or it would not serve.
bool Neighbourhood::GatherNothing(double radius, const Vector& to)
{
  const Vector& position = this->Table.Position();
  const Vector centre = position + Ahead(to - position, radius);
  const TriangleSurface& surface = this->Table.Surface().Surface();
  TriangleList found{ this->Triangles.data(), 0 };
  found.Overflow = radius <= ShareOfWanted * this->RadiusToTry ||
    SquaredLength(to - centre) >= radius * radius ||
    glm::length(position) > FarthestOut * surface.Radius() || !this->IsWithinPatch(centre, radius);
  if (!found.Overflow)
  {
    surface.Engine().FindInBall(ToVec3(centre), radius, found);
  }
  if (found.Overflow)
  {
    return false;
  }
  this->GatheredAt = position;
  this->FreeRadius = radius;
  this->Radius = radius * (1.0 - 0x1p-40);
  this->Fill(found, centre, centre, radius, radius);
  this->EmptyCentre = centre;
  this->EmptyRadius = this->Radius - this->Reach;
  this->Covered = Region::Ball;
  return true;
}

bool Neighbourhood::GatherSegment(const Vector& to, WorkBudget& budget)
{
  this->Forget();
  const TriangleSurface& surface = this->Table.Surface().Surface();
  const Vector position = this->Table.Position();
  // Far away there is no triangle, and the engine's coordinates are for the surface's own size.
  const double reach = FarthestOut * surface.Radius();
  const Vector way = to - position;
  const double a = SquaredLength(way);
  const double b = glm::dot(way, position);
  const double c = SquaredLength(position) - reach * reach;
  const double root = b * b - a * c;
  double enter = 0.0;
  double leave = 1.0;
  if (a > 0.0 && root > 0.0)
  {
    enter = std::max(0.0, (-b - std::sqrt(root)) / a);
    leave = std::min(1.0, (-b + std::sqrt(root)) / a);
  }
  const Vector first = position + enter * way;
  const Vector last = position + leave * way;
  TriangleList found = this->Scratch();
  if ((a == 0.0 || root > 0.0) && enter <= leave)
  {
    surface.Engine().FindOnSegment(ToVec3(first), ToVec3(last), found);
    budget.Triangles -= found.Count;
  }
  if (found.Overflow || budget.Triangles <= 0)
  {
    return false;
  }
  this->Radius = HUGE_VAL;
  this->Fill(found, position, 0.5 * (first + last), 0.5 * glm::length(last - first) + this->Reach,
    std::sqrt(a));
  this->Covered = Region::Segment;
  return true;
}

bool Neighbourhood::GatherSwept(const Vector& to, WorkBudget& budget)
{
  // Engines find a triangle wherever it passes.
  const auto holdsWay = [&]
  { return this->HasBall() && this->IsInBall(this->Table.Position()) && this->IsInBall(to); };
  return holdsWay() || (this->GatherBallFor(to, budget) && holdsWay()) ||
    this->GatherSegment(to, budget);
}

/// Keeps of the found triangles those that meet the ball about `middle`. `farthest`: no place that
/// will be asked for is farther from `centre`.
/// Returns how far the nearest is from the god-object, at most `radius`.
double Neighbourhood::Fill(const TriangleList& found, const Vector& centre, const Vector& middle,
  double radius, double farthest)
{
  this->FoundCount = found.Count;
  const double nearest = this->Table.Fill(
    found, { middle, radius, centre, farthest, this->Table.Position(), this->SmallestClearance });
  this->EmptyRadius = 0.0;
  this->GrowEmptyBall(nearest);
  this->MeasurePosition();
  return std::min(nearest, radius);
}

/// `nearest`: no gathered triangle is nearer to the god-object.
void Neighbourhood::GrowEmptyBall(double nearest)
{
  const Vector& position = this->Table.Position();
  const double rim = this->Radius - glm::length(position - this->Table.Centre());
  const double radius = std::min(nearest - this->Reach, rim);
  if (radius > this->EmptyRadius - glm::length(position - this->EmptyCentre))
  {
    this->EmptyCentre = position;
    this->EmptyRadius = radius;
  }
}

void Neighbourhood::GrowToPlanes()
{
  // No triangle is nearer than its plane.
  const double nearest = this->HasBall() ? this->Table.NearestPlane() : 0.0;
  if (nearest > this->Reach)
  {
    this->GrowEmptyBall(nearest);
  }
}

void Neighbourhood::MeasurePosition()
{
  this->Table.MeasurePosition();
  this->GrowToPlanes();
}

void Neighbourhood::Move()
{
  if (this->HasSegment())
  {
    this->Place(this->Table.Target());
  }
  else if (this->Table.Target() != this->Table.Position() && this->Table.MoveToTarget())
  {
    this->GrowToPlanes();
  }
}

void Neighbourhood::MoveSwept()
{
  this->Table.SetPosition(this->Table.Target());
  this->Table.ForgetTarget();
  if (this->HasBall())
  {
    // What the engine found holds for the whole sweep; planes and distances are new.
    const double radius = this->Radius * (1.0 + 0x1p-39);
    const Vector centre = this->Table.Centre();
    this->Fill(this->Found(), centre, centre, radius, radius);
  }
  else
  {
    this->Forget();
  }
}
}
