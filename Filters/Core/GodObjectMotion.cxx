#include "GodObjectImplementation.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A tick's motion that cannot be followed in one is tried in parts, down to this.
constexpr double SmallestPart = 1.0 / 32.0;
}

SurfaceFrame GodObject::Implementation::FrameOf(std::int32_t surface, const RigidPose& pose) const
{
  return SurfaceFrame(pose, ToVector(this->Surfaces[surface].Surface->Origin()), this->Origin);
}

void GodObject::Implementation::TakePose(Mover& mover)
{
  mover.Pose = mover.Motion->Pose();
  mover.Jumps = mover.Motion->Jumps();
  this->Sets[mover.Surface].SetFrame(this->FrameOf(mover.Surface, mover.Pose));
}

void GodObject::Implementation::Continue(const Implementation& previous)
{
  this->Place(previous.Position + (previous.Origin - this->Origin));
}

void GodObject::Implementation::Advance(double dt)
{
  if (this->Movers.empty())
  {
    return;
  }
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
      this->TakePose(mover);
      this->Sets[mover.Surface].Place(this->Position);
      const std::int32_t gone = mover.Surface;
      this->Active.KeepSupports(
        [gone](const ActivePlane& plane) { return plane.Facet.Surface != gone; });
    }
    isMoving = isMoving || mover.Pose != mover.Motion->Pose();
  }
  if (!isMoving)
  {
    return;
  }
  this->Budget.Triangles = LargestNumberOfTriangles;
  const Vector before = this->Position;
  double part = 1.0;
  double done = 0.0;
  while (this->IsPlaced && !this->IsSplit && done < 1.0)
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
      this->IsSplit = true;
    }
  }
  for (Mover& mover : this->Movers)
  {
    this->TakePose(mover);
  }
  this->Carried += this->Position - before;
}

/// Takes all surfaces to a fraction of this tick's motion, and the god-object with them. False,
/// with nothing changed, where there is no certain way for it.
bool GodObject::Implementation::Step(double fraction)
{
  ActivePlanes planes = this->Active;
  planes.KeepSupports(
    [this](const ActivePlane& plane) { return !plane.IsFar && this->IsOver(plane); });
  const ActivePlanes before = this->Active;
  const std::int32_t holder =
    this->Active.SupportSize() > 0 ? this->Active.Support(0).Facet.Surface : -1;
  Vector wish = this->Position;
  for (Mover& mover : this->Movers)
  {
    WorkingSet& set = this->Sets[mover.Surface];
    const RigidPose& target = mover.Motion->Pose();
    mover.Before = set.Frame();
    if (target != mover.Pose)
    {
      set.SetFrame(this->FrameOf(mover.Surface,
        fraction < 1.0 ? Interpolated(mover.Pose, target, mover.Pivot, fraction) : target));
      if (mover.Surface == holder)
      {
        wish = set.Frame().PointToScene(set.LocalPosition());
      }
    }
  }
  const auto renew = [this](ActivePlane& plane) { this->Sets[plane.Facet.Surface].Renew(plane); };
  this->Active.Renew(renew);
  planes.Renew(renew);
  if (!this->MoveAll(wish, planes))
  {
    for (Mover& mover : this->Movers)
    {
      this->Sets[mover.Surface].SetFrame(mover.Before);
    }
    this->Active = before;
    return false;
  }
  if (planes.SupportSize() > 0)
  {
    this->Active = planes;
  }
  return true;
}

/// From where each surface has the god-object to one place for all of them: the nearest to the wish
/// that the planes and the facets met on the ways there allow. All or nothing.
bool GodObject::Implementation::MoveAll(const Vector& wish, ActivePlanes& planes)
{
  for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
  {
    Vector goal = wish;
    FacetHit hit;
    if (!planes.PushOut(goal) || !this->FindFirstHit(goal, planes, hit))
    {
      return false;
    }
    if (!hit)
    {
      if (!this->IsClear(goal))
      {
        return false;
      }
      this->MoveSets();
      this->Position = goal;
      return true;
    }
    if (hit.IsWaypoint || planes.Has(hit.Plane.Facet))
    {
      return false;
    }
    planes.Add(hit.Plane);
  }
  return false;
}

/// Brings a split god-object together where its surfaces allow that again; else each surface's own
/// goes to the HIP as far as that surface lets it. True when there is one god-object again.
bool GodObject::Implementation::Join(const Vector& hip)
{
  ActivePlanes planes;
  this->IsSplit = false;
  if (this->MoveAll(hip, planes))
  {
    this->Active = planes;
    return true;
  }
  bool isTogether = true;
  for (std::size_t i = 0; i < this->Sets.size(); ++i)
  {
    this->First = i;
    this->Last = i + 1;
    this->Position = this->Sets[i].Frame().PointToScene(this->Sets[i].LocalPosition());
    this->Active.Clear();
    this->WaySize = 1;
    this->PassesLeft = LargestNumberOfPasses;
    this->Walk(hip);
    isTogether =
      isTogether && this->Sets[i].LocalPosition() == this->Sets[i].Frame().PointToLocal(hip);
  }
  this->First = 0;
  this->Last = this->Sets.size();
  this->Active.Clear();
  this->Position = hip;
  this->WaySize = 1;
  this->IsSplit = !isTogether;
  return isTogether;
}
}
