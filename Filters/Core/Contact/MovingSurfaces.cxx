#include "haptics/Contact/MovingSurfaces.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A tick's motion that cannot be followed in one is tried in parts, down to this.
constexpr double SmallestPart = 1.0 / 32.0;
}

MovingSurfaces::MovingSurfaces(GodObjectState& god, PlaneRelease& planes, HipApproach& walker)
  : God(god)
  , Planes(planes)
  , Walker(walker)
{
  for (std::size_t i = 0; i < god.Around.Surfaces.size(); ++i)
  {
    const TouchedSurface& touched = god.Around.Surfaces[i];
    if (touched.IsGripped)
    {
      continue;
    }
    const auto index = static_cast<std::int32_t>(i);
    if (touched.Surface->Deforms())
    {
      this->Deforming.push_back(index);
    }
    if (SurfaceMotion* const motion = touched.Motion.get())
    {
      Mover mover;
      mover.Surface = index;
      mover.Motion = motion;
      mover.Pivot = ToVector(touched.Surface->Origin());
      this->Movers.push_back(mover);
      if (std::find(this->Motions.begin(), this->Motions.end(), motion) == this->Motions.end())
      {
        this->Motions.push_back(motion);
      }
    }
  }
}

void MovingSurfaces::TakePoses()
{
  for (Mover& mover : this->Movers)
  {
    this->TakePose(mover);
  }
}

void MovingSurfaces::TakeOver(const MovingSurfaces& previous)
{
  for (std::size_t i = 0; i < this->Movers.size(); ++i)
  {
    this->Movers[i].Pose = previous.Movers[i].Pose;
    this->Movers[i].Jumps = previous.Movers[i].Jumps;
  }
}

void MovingSurfaces::TakePose(Mover& mover)
{
  mover.Pose = mover.Motion->Pose();
  mover.Jumps = mover.Motion->Jumps();
  this->God.Around.Sets[mover.Surface].SetFrame(
    this->God.Around.FrameOf(mover.Surface, mover.Pose));
}

/// A motion that nobody has followed while the hand carried its surface ends where that is now.
void MovingSurfaces::TakeFromHand(const Surroundings& previous)
{
  for (const Mover& mover : this->Movers)
  {
    for (std::size_t i = previous.TouchableCount; i < previous.Surfaces.size(); ++i)
    {
      if (previous.Surfaces[i].Motion.get() == mover.Motion)
      {
        mover.Motion->Advance(0.0);
      }
    }
  }
}

bool MovingSurfaces::HasArrived() const
{
  return std::all_of(this->Deforming.begin(), this->Deforming.end(),
    [this](std::int32_t i) { return this->God.Around.Sets[i].Fraction() >= 1.0; });
}

void MovingSurfaces::Advance(double dt, double haste)
{
  if (this->Movers.empty() && this->Deforming.empty())
  {
    return;
  }
  this->God.Active.SetKnownOver(false);
  if (!this->MoveSurfaces(dt, haste))
  {
    return;
  }
  this->God.Around.RenewBudget();
  if (this->God.Around.IsBall() && !this->God.Around.IsFit)
  {
    this->God.Around.FitBall();
  }
  const Vector before = this->God.Position;
  // The HIP's way to the next update is one over the surface that holds, so it begins where that
  // has taken what was there.
  const WorkingSet* const holder = this->God.Active.SupportSize() > 0
    ? &this->God.Around.Sets[this->God.Active.Support(0).Facet.Surface]
    : nullptr;
  const Vector hipInHolder =
    holder ? holder->Frame().PointToLocal(this->God.HipBefore) : this->God.HipBefore;
  double part = 1.0;
  double done = 0.0;
  while (this->God.IsPlaced && !this->God.IsSplit && done < 1.0)
  {
    if (this->Step(done + part))
    {
      done += part;
    }
    else if (part > SmallestPart)
    {
      part *= 0.5;
    }
    else
    {
      this->God.IsSplit = true;
    }
  }
  this->TakePoses();
  this->God.HipBefore = holder ? holder->Frame().PointToScene(hipInHolder) : hipInHolder;
  if (this->God.IsSplit)
  {
    this->StepApart();
  }
  this->God.SurfaceDisplacement += this->God.Position - before;
}

/// Takes all motions and deformations on. True where a surface is elsewhere now than its set.
bool MovingSurfaces::MoveSurfaces(double dt, double haste)
{
  for (SurfaceMotion* motion : this->Motions)
  {
    motion->Advance(dt);
  }
  bool isMoving = false;
  for (Mover& mover : this->Movers)
  {
    if (mover.Jumps != mover.Motion->Jumps())
    {
      // Taken away and put elsewhere: it has not swept over anything.
      this->God.Around.IsFit = false;
      this->TakePose(mover);
      this->God.Around.Sets[mover.Surface].Place(this->God.Position);
      const std::int32_t gone = mover.Surface;
      this->God.Active.KeepSupports(
        [gone](const ActivePlane& plane) { return plane.Facet.Surface != gone; });
    }
    isMoving = isMoving || mover.Pose != mover.Motion->Pose();
  }
  for (const std::int32_t i : this->Deforming)
  {
    isMoving = isMoving || this->God.Around.Sets[i].Fraction() < 1.0;
    this->God.Around.Sets[i].BeginTick(haste * dt);
  }
  return isMoving;
}

/// Takes all surfaces to a part of this tick's motion, and the god-object with them. False, with
/// nothing changed, where there is no certain way for it.
bool MovingSurfaces::Step(double part)
{
  ActivePlanes planes = this->God.Active;
  planes.KeepSupports(
    [this](const ActivePlane& plane)
    {
      bool isInside = false;
      return this->God.Around.IsBall() ? this->God.Touches(plane, 0.0)
                                       : !plane.IsFar && this->God.IsOver(plane, isInside);
    });
  const ActivePlanes before = this->God.Active;
  for (Mover& mover : this->Movers)
  {
    WorkingSet& set = this->God.Around.Sets[mover.Surface];
    const RigidPose& target = mover.Motion->Pose();
    mover.Before = set.Frame();
    if (target != mover.Pose)
    {
      set.SetFrame(this->God.Around.FrameOf(
        mover.Surface, part < 1.0 ? Interpolated(mover.Pose, target, mover.Pivot, part) : target));
    }
  }
  for (const std::int32_t i : this->Deforming)
  {
    this->God.Around.Sets[i].SweepTo(part);
  }
  Vector wish = this->God.Position;
  if (this->God.Active.SupportSize() > 0)
  {
    const ActivePlane& holder = this->God.Active.Support(0);
    const WorkingSet& set = this->God.Around.Sets[holder.Facet.Surface];
    if (this->God.Around.Surfaces[holder.Facet.Surface].Motion || set.Surface().Deforms())
    {
      wish = set.Frame().PointToScene(this->God.Around.IsBall()
          ? this->God.Around.Balls[holder.Facet.Surface].PointAfterSweep(
              set, this->God.Around.BallRadius, holder)
          : set.PointAfterSweep(holder));
    }
  }
  const auto renew = [this](ActivePlane& plane) { this->God.Around.RenewPlane(plane); };
  this->God.Active.Renew(renew);
  planes.Renew(renew);
  if (this->MoveAll(wish, planes))
  {
    if (planes.SupportSize() > 0)
    {
      this->God.Active = planes;
    }
    return true;
  }
  for (Mover& mover : this->Movers)
  {
    this->God.Around.Sets[mover.Surface].SetFrame(mover.Before);
  }
  for (const std::int32_t i : this->Deforming)
  {
    this->God.Around.Sets[i].SweepNothing();
  }
  this->God.Active = before;
  return false;
}

/// A god-object that is split: each surface that deforms takes its own on with it.
void MovingSurfaces::StepApart()
{
  this->God.Around.RenewBudget();
  const Vector before = this->God.Position;
  for (const std::int32_t i : this->Deforming)
  {
    WorkingSet& set = this->God.Around.Sets[i];
    set.BeginRest();
    this->God.Around.CountOne(static_cast<std::size_t>(i));
    double part = 1.0;
    for (double done = 0.0; done < 1.0 && part >= SmallestPart;)
    {
      ActivePlanes planes;
      set.SweepTo(done + part);
      const bool isDone = this->MoveAll(set.Frame().PointToScene(set.LocalPosition()), planes);
      done += isDone ? part : 0.0;
      part *= isDone ? 1.0 : 0.5;
    }
    if (part < SmallestPart)
    {
      set.SkipTick(this->God.Around.Budget);
      this->God.Around.IsFit = false;
    }
  }
  this->God.Around.CountAll();
  this->God.Position = before;
}

/// From where each surface has the god-object to one place for all of them: the nearest to the wish
/// that the planes and the facets met on the ways there allow. All or nothing.
bool MovingSurfaces::MoveAll(const Vector& wish, ActivePlanes& planes)
{
  for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
  {
    Vector goal = wish;
    FacetHit hit;
    if (!planes.PushOut(goal) || !this->God.Around.FindFirstHit(goal, planes, hit))
    {
      return false;
    }
    if (!hit)
    {
      if (!this->God.Around.IsClear(goal))
      {
        return false;
      }
      if (this->God.Around.IsBall())
      {
        this->God.Around.MoveSetsTo(goal);
      }
      else
      {
        this->God.Around.MoveSets();
      }
      this->God.Position = goal;
      return true;
    }
    if (hit.IsWaypoint || planes.Has(hit.Plane.Facet))
    {
      return hit.IsWaypoint && this->God.Around.IsBall() && this->God.MoveCentre(goal);
    }
    planes.Add(hit.Plane);
  }
  return false;
}

/// Brings a split god-object together where its surfaces allow that again; else each surface's own
/// goes to the HIP as far as that surface lets it. True when there is one god-object again.
bool MovingSurfaces::Join(const Vector& hip)
{
  this->God.IsSplit = false;
  const Vector before = this->God.Position;
  for (const Vector& wish : { before, hip })
  {
    ActivePlanes planes;
    if (this->MoveAll(wish, planes))
    {
      this->God.SurfaceDisplacement += this->God.Position - before;
      this->God.Active = planes;
      return true;
    }
  }
  bool isTogether = true;
  for (std::size_t i = 0; i < this->God.Around.TouchableCount; ++i)
  {
    this->God.Around.CountOne(i);
    this->God.Position =
      this->God.Around.Sets[i].Frame().PointToScene(this->God.Around.Sets[i].LocalPosition());
    this->God.Active.Clear();
    this->God.WaySize = 1;
    this->Walker.RenewPasses();
    this->Planes.Left = LargestNumberOfReleases;
    this->Walker.Walk(hip);
    isTogether = isTogether &&
      this->God.Around.Sets[i].LocalPosition() ==
        this->God.Around.Sets[i].Frame().PointToLocal(hip);
  }
  this->God.Around.CountAll();
  this->God.Active.Clear();
  this->God.Position = hip;
  this->God.WaySize = 1;
  this->God.IsSplit = !isTogether;
  return isTogether;
}
}
