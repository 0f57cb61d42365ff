#include "haptics/Contact/BallWalk.h"

#include <algorithm>
#include <array>

namespace haptics
{
namespace
{
/// By so much of its radius a ball that overlaps grows in an update: at 1 kHz to all of it in 0.13
/// s.
constexpr double Growth = 1.0 / 128.0;
/// Out of nearly opposite planes there is no near way: a push is so many times as long as the most
/// that it grows by.
constexpr double FarthestPush = 4.0;
/// A motion shorter than this, of the way to the HIP, is none.
constexpr double SmallestStep = 1e-13;
/// The cosine of the largest angle that a ball is taken round at once.
constexpr double SharpestTurn = 0.25;
}

void BallWalk::Grow()
{
  this->God.Around.FitBall();
  if (this->God.Around.IsFit)
  {
    return;
  }
  // Out of a narrow pit it is pushed far for little.
  for (const double share : { 1.0, 1.0 / 8.0, 1.0 / 64.0 })
  {
    if (this->GrowBy(share * Growth * this->God.Around.TipRadius))
    {
      return;
    }
  }
}

bool BallWalk::GrowBy(double growth)
{
  const double size = std::min(this->God.Around.TipRadius, this->God.Around.BallRadius + growth);
  ActivePlanes planes;
  std::array<double, ActivePlanes::Capacity> heights{};
  int count = 0;
  std::array<ActivePlane, ActivePlanes::Capacity> nearest;
  for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
  {
    this->God.Around.Balls[i].VisitOverlaps(this->God.Around.Sets[i], size, this->God.Around.Budget,
      [&](const ActivePlane& plane)
      {
        const double height = glm::dot(plane.Normal, this->God.Position - plane.Anchor);
        int place = count < ActivePlanes::Capacity ? count : ActivePlanes::Capacity - 1;
        if (place < count && heights[place] <= height)
        {
          return;
        }
        count = std::min(count + 1, ActivePlanes::Capacity);
        for (; place > 0 && heights[place - 1] > height; --place)
        {
          heights[place] = heights[place - 1];
          nearest[place] = nearest[place - 1];
        }
        heights[place] = height;
        nearest[place] = plane;
      });
  }
  for (int k = 0; k < count; ++k)
  {
    planes.Add(nearest[k]);
  }
  Vector goal = this->God.Position;
  FacetHit hit;
  if (planes.PushOut(goal) &&
    glm::length(goal - this->God.Position) <= FarthestPush * Growth * this->God.Around.TipRadius &&
    this->God.Around.FindFirstTouch(goal, hit) && !hit)
  {
    this->God.SurfaceDisplacement += goal - this->God.Position;
    this->God.MoveBall(goal);
    this->God.Around.FitBall();
    return true;
  }
  return false;
}

bool BallWalk::Roll(const Vector& goal)
{
  double slack = 0.0;
  bool mayGoRound = true;
  while (this->God.PassesLeft-- > 0)
  {
    this->God.KeepTouches(slack);
    const Vector before = this->God.Position;
    const Vector aim = this->God.Active.IsEmpty() ? goal : this->God.Active.Nearest(before, goal);
    const double left = glm::length(aim - before);
    if (left <= SmallestStep * glm::length(goal - before) ||
      (this->God.Active.SupportSize() > 0 && left <= this->God.Active.Support(0).Clearance))
    {
      return true;
    }
    Vector corner(0.0);
    Vector end(0.0);
    const bool isRound = mayGoRound && this->FindWayRound(goal, corner, end);
    if (isRound ? !this->RollRound(corner, end, goal) : !this->RollTowards(aim, goal))
    {
      return false;
    }
    mayGoRound = mayGoRound && !(isRound && this->God.Position == before);
    if (this->God.Position == goal || (this->God.Position == aim && this->LiesFlat()))
    {
      return true;
    }
    slack = glm::length(this->God.Position - before);
  }
  return false;
}

/// Whether the ball is held by one plane alone, and has the same where it has been moved to.
bool BallWalk::LiesFlat()
{
  if (this->God.Active.SupportSize() != 1)
  {
    return false;
  }
  ActivePlane plane = this->God.Active.Support(0);
  this->God.Around.RenewPlane(plane);
  return plane.Normal == this->God.Active.Support(0).Normal;
}

/// Where one facet holds the ball, which an edge or a corner of that lets come nearer to the goal:
/// the nearest place is known, and the way there, along the plane that holds the ball now to that
/// which will. Each is the certificate of its part.
///
///     O ---- corner
///    ____    |
///        |   O end    x goal
///
bool BallWalk::FindWayRound(const Vector& goal, Vector& corner, Vector& end)
{
  if (this->God.Active.SupportSize() != 1)
  {
    return false;
  }
  const ActivePlane& now = this->God.Active.Support(0);
  const auto i = static_cast<std::size_t>(now.Facet.Surface);
  ActivePlane last;
  if (!this->God.Around.Balls[i].FindLast(
        this->God.Around.Sets[i], goal, this->God.Around.BallRadius, now.Facet, last))
  {
    return false;
  }
  const double squaredSine = SquaredLength(glm::cross(now.Normal, last.Normal));
  const double cosine = glm::dot(now.Normal, last.Normal);
  end = goal + (last.Clearance - glm::dot(last.Normal, goal - last.Anchor)) * last.Normal;
  const double lacking = now.Clearance - glm::dot(now.Normal, end - now.Anchor);
  if (cosine < SharpestTurn || lacking <= now.Clearance)
  {
    return false;
  }
  corner = end + (lacking / squaredSine) * (now.Normal - cosine * last.Normal);
  return true;
}

/// The way around, in two passes. The corner may be farther from the goal than where it begins: if
/// something is in the way behind that, the ball goes back as it came. False as RollTowards.
bool BallWalk::RollRound(const Vector& corner, const Vector& end, const Vector& goal)
{
  const Vector before = this->God.Position;
  const int start = this->God.WaySize - 1;
  bool isDone = this->RollTowards(corner, goal);
  if (isDone && this->God.Position == corner && this->God.PassesLeft-- > 0)
  {
    isDone = this->RollTowards(end, goal);
  }
  if (SquaredLength(this->God.Position - goal) > SquaredLength(before - goal))
  {
    for (int i = this->God.WaySize - 2; i > start; --i)
    {
      this->God.Way[this->God.WaySize] = this->God.Way[i];
      ++this->God.WaySize;
    }
    this->God.Way[this->God.WaySize++] = ToVec3(before);
    this->God.Around.MoveSetsTo(before);
    this->God.Position = before;
  }
  return isDone;
}

/// A pass: casts the ball to the nearest point that the planes leave, and takes the planes in that
/// it meets. False where a tick may not look at as much as is there.
bool BallWalk::RollTowards(const Vector& first, const Vector& goal)
{
  Vector aim = first;
  for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
  {
    FacetHit hit;
    if (!this->God.Around.FindFirstTouch(aim, hit, true))
    {
      this->God.IsOverloaded = true;
      return false;
    }
    if (!hit)
    {
      this->God.MoveBall(aim);
      return true;
    }
    if (hit.Fraction > 0.0)
    {
      this->God.MoveBall(this->God.Position + hit.Fraction * (aim - this->God.Position));
    }
    if (hit.IsWaypoint)
    {
      continue;
    }
    this->God.Active.Keep(
      [&hit](const ActivePlane& plane) { return !(plane.Facet == hit.Plane.Facet); });
    this->God.Active.Add(hit.Plane);
    aim = this->God.Active.Nearest(this->God.Position, goal);
  }
  return true;
}
}
