#include "haptics/Contact/GodObjectImplementation.h"

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
  const TriangleSurface& touched = *this->Surfaces[surface].Surface;
  return SurfaceFrame(pose, ToVector(touched.Origin()), touched.Radius(), this->Origin);
}

void GodObject::Implementation::TakePose(Mover& mover)
{
  mover.Pose = mover.Motion->Pose();
  mover.Jumps = mover.Motion->Jumps();
  this->Sets[mover.Surface].SetFrame(this->FrameOf(mover.Surface, mover.Pose));
}

/// The set of `previous` that a surface goes on from, or null. `isSame`: it is the same surface, or
/// deforms from where that one is.
const WorkingSet* GodObject::Implementation::FindPredecessor(
  std::int32_t surface, const Implementation& previous, bool& isSame) const
{
  const TouchedSurface& now = this->Surfaces[surface];
  const WorkingSet* found = nullptr;
  isSame = false;
  for (std::size_t j = 0; j < previous.Sets.size() && !isSame; ++j)
  {
    const TouchedSurface& then = previous.Surfaces[j];
    const WorkingSet& set = previous.Sets[j];
    isSame = now.Motion == then.Motion &&
      (now.Surface == then.Surface ||
        (now.Surface->Follows(*then.Surface) && set.Fraction() >= 1.0));
    if (isSame || (now.Identity != 0 && now.Identity == then.Identity))
    {
      found = &set;
    }
  }
  return found;
}

/// A motion that nobody has followed while the hand carried its surface ends where that is now.
void GodObject::Implementation::TakeFromHand(const Implementation& previous)
{
  for (const Mover& mover : this->Movers)
  {
    for (std::size_t i = previous.Felt; i < previous.Surfaces.size(); ++i)
    {
      if (previous.Surfaces[i].Motion.get() == mover.Motion)
      {
        mover.Motion->Advance(0.0);
      }
    }
  }
}

bool GodObject::Implementation::Continue(const Implementation& previous)
{
  this->TakeFromHand(previous);
  this->Place(previous.Position + (previous.Origin - this->Origin));
  this->HipBefore = previous.HipBefore + (previous.Origin - this->Origin);
  this->Budget.Triangles = LargestNumberOfTriangles;
  WorkBudget looks = this->Budget; // at sides; what is left of the other is for the motion
  const TriangleList scratch{ this->Scratch.data(),
    static_cast<std::int32_t>(this->Scratch.size()) };
  std::size_t same = 0;
  bool isElsewhere = previous.IsSplit;
  Vector wish = this->Position;
  for (WorkingSet& set : this->Sets)
  {
    const auto index = static_cast<std::int32_t>(&set - this->Sets.data());
    bool isSame = false;
    const WorkingSet* const before = this->FindPredecessor(index, previous, isSame);
    const auto surface =
      before ? static_cast<std::int32_t>(before - previous.Sets.data()) : std::int32_t{ -1 };
    if (isSame)
    {
      set.Continue(*before);
      same += previous.IsGripped(surface) == this->IsGripped(index) ? 1 : 0;
    }
    else if (before)
    {
      if (previous.IsGripped(surface) &&
        this->Surfaces[index].Motion == previous.Surfaces[surface].Motion)
      {
        set.Place(set.Frame().PointToScene(before->LocalPosition() +
          (ToVector(before->Surface().Origin()) - ToVector(set.Surface().Origin()))));
      }
      const ActivePlane* held = nullptr;
      for (int i = 0; i < previous.Active.SupportSize(); ++i)
      {
        const ActivePlane& plane = previous.Active.Support(i);
        held = plane.Facet.Surface == surface ? &plane : held;
      }
      if (!set.Succeed(*before, held, scratch, looks) && !this->IsGripped(index))
      {
        wish = set.Frame().PointToScene(set.LocalPosition());
      }
    }
    isElsewhere = isElsewhere ||
      (!this->IsGripped(index) && set.LocalPosition() != set.Frame().PointToLocal(this->Position));
  }
  // All of them agree on one place, each by a motion that it certifies.
  ActivePlanes planes;
  this->IsSplit = isElsewhere && !this->MoveAll(wish, planes);
  if (isElsewhere && planes.SupportSize() > 0)
  {
    this->Active = planes;
  }
  return same == this->Sets.size() && same == previous.Sets.size();
}

/// Where surfaces have changed all at once: goes to where they hold a hand that rests, so that what
/// this does to the spring counts as their own work, be it given or taken.
void GodObject::Implementation::Settle(const Implementation& previous)
{
  const Vector before = previous.Position + (previous.Origin - this->Origin);
  const bool isConcerned = previous.Result.NumberOfConstraints > 0 || this->Position != before;
  if (!this->IsSplit && !previous.IsSplit && isConcerned)
  {
    this->Update(ToVector(this->Result.Hip) - this->Origin);
    this->Carried += this->Position - before;
  }
}

/// Whether what encloses space encloses another place as it does the god-object's.
bool GodObject::Implementation::IsOnSameSide(const Vector& other)
{
  this->Budget.Triangles = LargestNumberOfTriangles;
  return std::all_of(this->Sets.begin(), this->Sets.begin() + this->Felt,
    [&](WorkingSet& set) { return set.IsOnSameSide(other, this->Budget); });
}

bool GodObject::Implementation::HasArrived() const
{
  return std::all_of(this->Deforming.begin(), this->Deforming.end(),
    [this](std::int32_t i) { return this->Sets[i].Fraction() >= 1.0; });
}

void GodObject::Implementation::Advance(double dt, double haste)
{
  if (this->Movers.empty() && this->Deforming.empty())
  {
    return;
  }
  this->Active.SetKnownOver(false);
  if (!this->MoveSurfaces(dt, haste))
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
  if (this->IsSplit)
  {
    this->StepApart();
  }
  this->Carried += this->Position - before;
}

/// Takes all motions and deformations on. True where a surface is elsewhere now than its set.
bool GodObject::Implementation::MoveSurfaces(double dt, double haste)
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
      this->TakePose(mover);
      this->Sets[mover.Surface].Place(this->Position);
      const std::int32_t gone = mover.Surface;
      this->Active.KeepSupports(
        [gone](const ActivePlane& plane) { return plane.Facet.Surface != gone; });
    }
    isMoving = isMoving || mover.Pose != mover.Motion->Pose();
  }
  for (const std::int32_t i : this->Deforming)
  {
    isMoving = isMoving || this->Sets[i].Fraction() < 1.0;
    this->Sets[i].BeginTick(haste * dt);
  }
  return isMoving;
}

/// Takes all surfaces to a part of this tick's motion, and the god-object with them. False, with
/// nothing changed, where there is no certain way for it.
bool GodObject::Implementation::Step(double part)
{
  ActivePlanes planes = this->Active;
  planes.KeepSupports(
    [this](const ActivePlane& plane)
    {
      bool isInside = false;
      return !plane.IsFar && this->IsOver(plane, isInside);
    });
  const ActivePlanes before = this->Active;
  for (Mover& mover : this->Movers)
  {
    WorkingSet& set = this->Sets[mover.Surface];
    const RigidPose& target = mover.Motion->Pose();
    mover.Before = set.Frame();
    if (target != mover.Pose)
    {
      set.SetFrame(this->FrameOf(
        mover.Surface, part < 1.0 ? Interpolated(mover.Pose, target, mover.Pivot, part) : target));
    }
  }
  for (const std::int32_t i : this->Deforming)
  {
    this->Sets[i].SweepTo(part);
  }
  Vector wish = this->Position;
  if (this->Active.SupportSize() > 0)
  {
    const ActivePlane& holder = this->Active.Support(0);
    const WorkingSet& set = this->Sets[holder.Facet.Surface];
    if (this->Surfaces[holder.Facet.Surface].Motion || set.Surface().Deforms())
    {
      wish = set.Frame().PointToScene(set.CarriedBy(holder));
    }
  }
  const auto renew = [this](ActivePlane& plane) { this->Sets[plane.Facet.Surface].Renew(plane); };
  this->Active.Renew(renew);
  planes.Renew(renew);
  if (this->MoveAll(wish, planes))
  {
    if (planes.SupportSize() > 0)
    {
      this->Active = planes;
    }
    return true;
  }
  for (Mover& mover : this->Movers)
  {
    this->Sets[mover.Surface].SetFrame(mover.Before);
  }
  for (const std::int32_t i : this->Deforming)
  {
    this->Sets[i].SweepNothing();
  }
  this->Active = before;
  return false;
}

/// A god-object that is split: each surface that deforms takes its own on with it.
void GodObject::Implementation::StepApart()
{
  this->Budget.Triangles = LargestNumberOfTriangles;
  const Vector before = this->Position;
  for (const std::int32_t i : this->Deforming)
  {
    WorkingSet& set = this->Sets[i];
    set.BeginRest();
    this->First = static_cast<std::size_t>(i);
    this->Last = this->First + 1;
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
      set.SkipTick(this->Budget);
    }
  }
  this->First = 0;
  this->Last = this->Felt;
  this->Position = before;
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
  this->IsSplit = false;
  const Vector before = this->Position;
  for (const Vector& wish : { before, hip })
  {
    ActivePlanes planes;
    if (this->MoveAll(wish, planes))
    {
      this->Carried += this->Position - before;
      this->Active = planes;
      return true;
    }
  }
  bool isTogether = true;
  for (std::size_t i = 0; i < this->Felt; ++i)
  {
    this->First = i;
    this->Last = i + 1;
    this->Position = this->Sets[i].Frame().PointToScene(this->Sets[i].LocalPosition());
    this->Active.Clear();
    this->WaySize = 1;
    this->PassesLeft = this->PassesAllowed;
    this->ReleasesLeft = LargestNumberOfReleases;
    this->Walk(hip);
    isTogether =
      isTogether && this->Sets[i].LocalPosition() == this->Sets[i].Frame().PointToLocal(hip);
  }
  this->First = 0;
  this->Last = this->Felt;
  this->Active.Clear();
  this->Position = hip;
  this->WaySize = 1;
  this->IsSplit = !isTogether;
  return isTogether;
}
}
