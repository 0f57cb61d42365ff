#include "haptics/Contact/Succession.h"

#include <algorithm>
#include <tuple>

namespace haptics
{
namespace
{
/// A cast that looks from far away ends at a waypoint, short of what it has found.
constexpr int LargestNumberOfLandings = 3;

bool AreAlike(const Material& a, const Material& b)
{
  const auto values = [](const Material& m)
  {
    return std::tie(m.IsPlain, m.IsShaded, m.Stiffness, m.PlainShare, m.Damping, m.StaticFriction,
      m.DynamicFriction, m.Texture);
  };
  return values(a) == values(b);
}
}

bool Succession::Run()
{
  this->God.Result = this->Before.Result;
  if (this->TakeOver())
  {
    return this->HasSameMaterial();
  }
  const bool isSeamless = this->Continue();
  this->StayInContact();
  if (!isSeamless)
  {
    this->Land();
    this->Settle();
  }
  return isSeamless && this->HasSameMaterial();
}

/// Goes on exactly as a god-object would with the surfaces that were there before, where these are
/// the same, or other patches of the same ones. False, with nothing done, where they are not.
bool Succession::TakeOver()
{
  if (!this->God.Around.HasPatches || this->Before.IsSplit ||
    this->God.Around.Sets.size() != this->Before.Around.Sets.size() ||
    this->God.Around.TouchableCount != this->Before.Around.TouchableCount ||
    this->God.Around.Balls.empty() != this->Before.Around.Balls.empty())
  {
    return false;
  }
  for (std::size_t i = 0; i < this->God.Around.Sets.size(); ++i)
  {
    const TouchedSurface& now = this->God.Around.Surfaces[i];
    const TouchedSurface& then = this->Before.Around.Surfaces[i];
    const SurfacePatch* const patch = now.Surface->Patch();
    const bool goesOn = now.Surface == then.Surface ||
      (now.Surface->IsOfSameWhole(*then.Surface) &&
        patch->Region().DistanceTo(ToVec3(this->Before.Around.Sets[i].LocalPosition())) +
            this->Before.Around.TipRadius <=
          patch->Region().Radius);
    if (!goesOn || now.Motion != then.Motion || now.Surface->Deforms() ||
      this->Before.Around.Sets[i].IsAstray())
    {
      return false;
    }
  }
  bool isHere = true;
  const auto find = [&](FacetId& facet)
  {
    if (facet.Surface >= 0 && facet.Triangle >= 0)
    {
      const TriangleSurface& now = *this->God.Around.Surfaces[facet.Surface].Surface;
      const TriangleSurface& then = *this->Before.Around.Surfaces[facet.Surface].Surface;
      facet.Triangle = &now == &then ? facet.Triangle : now.FindSame(then, facet.Triangle);
    }
    return facet.Triangle;
  };
  ActivePlanes active = this->Before.Active;
  active.Rename([&](FacetId& facet) { isHere = find(facet) >= 0 && isHere; });
  if (!isHere)
  {
    return false;
  }
  this->God.Active = active;
  for (std::size_t i = 0; i < this->God.Around.Sets.size(); ++i)
  {
    this->God.Around.Sets[i].TakeOver(this->Before.Around.Sets[i]);
  }
  for (BallSet& ball : this->God.Around.Balls)
  {
    ball.Restart();
  }
  this->Now.Moving.TakeOver(this->Previous.Moving);
  this->God.Around.Origin = this->Before.Around.Origin;
  this->God.Position = this->Before.Position;
  this->God.Around.TipRadius = this->Before.Around.TipRadius;
  this->God.Around.BallRadius = this->Before.Around.BallRadius;
  this->God.Around.IsFit = this->Before.Around.IsFit;
  this->God.IsPlaced = true;
  this->God.IsOverloaded = this->Before.IsOverloaded;
  this->God.SurfaceDisplacement = this->Before.SurfaceDisplacement;
  this->God.HipBefore = this->Before.HipBefore;
  this->Now.LastHip = this->Previous.LastHip;
  this->Now.Planes.GoalMoved = this->Previous.Planes.GoalMoved;
  this->God.Cone = this->Before.Cone;
  this->Now.Planes.Refused = this->Previous.Planes.Refused;
  for (FacetId& facet : this->Now.Planes.Refused.Facets)
  {
    find(facet);
  }
  this->God.Way[0] = ToVec3(this->God.Position);
  this->God.WaySize = 1;
  for (int i = 0; i < this->God.Result.NumberOfConstraints; ++i)
  {
    Constraint& constraint = this->God.Result.Constraints[i];
    FacetId facet{ constraint.Surface, constraint.Triangle };
    constraint.Triangle = find(facet);
  }
  this->Now.Materials.Update();
  return true;
}

/// Whether a surface is the same snapshot, or a patch of the same surface that knows the place
/// where the god-object is.
bool Succession::GoesOn(std::int32_t surface, const TouchedSurface& then) const
{
  const TriangleSurface& now = *this->God.Around.Surfaces[surface].Surface;
  return &now == then.Surface.get() ||
    (now.IsOfSameWhole(*then.Surface) &&
      this->God.Around.Sets[surface].IsKnown(this->God.Position, this->God.Around.TipRadius));
}

/// The set of `previous` that a surface goes on from, or null. `isSame`: it is the same surface, or
/// deforms from where that one is.
const WorkingSet* Succession::FindPredecessor(std::int32_t surface, bool& isSame) const
{
  const TouchedSurface& now = this->God.Around.Surfaces[surface];
  const WorkingSet* found = nullptr;
  isSame = false;
  for (std::size_t j = 0; j < this->Before.Around.Sets.size() && !isSame; ++j)
  {
    const TouchedSurface& then = this->Before.Around.Surfaces[j];
    const WorkingSet& set = this->Before.Around.Sets[j];
    isSame = now.Motion == then.Motion &&
      (this->GoesOn(surface, then) ||
        (now.Surface->Follows(*then.Surface) && set.Fraction() >= 1.0 &&
          this->God.Around.Sets[surface].IsKnown(this->God.Position, this->God.Around.TipRadius)));
    if (isSame || (now.Identity != 0 && now.Identity == then.Identity))
    {
      found = &set;
    }
  }
  return found;
}

bool Succession::Continue()
{
  this->Now.Moving.TakeFromHand(this->Before.Around);
  this->Now.Place(this->Before.Position + (this->Before.Around.Origin - this->God.Around.Origin));
  if (!this->God.Around.Balls.empty())
  {
    this->God.Around.TipRadius = this->Before.Around.TipRadius;
  }
  this->God.HipBefore =
    this->Before.HipBefore + (this->Before.Around.Origin - this->God.Around.Origin);
  this->God.Around.RenewBudget();
  WorkBudget looks =
    this->God.Around.Budget; // at sides; what is left of the other is for the motion
  const TriangleList scratch{ this->Now.Scratch.data(),
    static_cast<std::int32_t>(this->Now.Scratch.size()) };
  std::size_t same = 0;
  bool isElsewhere = this->Before.IsSplit;
  Vector wish = this->God.Position;
  for (WorkingSet& set : this->God.Around.Sets)
  {
    const auto index = static_cast<std::int32_t>(&set - this->God.Around.Sets.data());
    bool isSame = false;
    const WorkingSet* before = this->FindPredecessor(index, isSame);
    if (before && !isSame && !set.IsKnown(this->God.Position, this->God.Around.TipRadius))
    {
      set.StandBeyond(*before, scratch, looks);
      before = nullptr; // what is there now is not known
    }
    isSame = isSame && !(before && before->IsAstray());
    const auto surface = before
      ? static_cast<std::int32_t>(before - this->Before.Around.Sets.data())
      : std::int32_t{ -1 };
    if (before && isSame)
    {
      set.Continue(*before);
      same += this->Before.Around.IsGripped(surface) == this->God.Around.IsGripped(index) ? 1 : 0;
    }
    else if (before)
    {
      if (this->Before.Around.IsGripped(surface) &&
        this->God.Around.Surfaces[index].Motion == this->Before.Around.Surfaces[surface].Motion)
      {
        set.Place(set.Frame().PointToScene(before->LocalPosition() +
          (ToVector(before->Surface().Origin()) - ToVector(set.Surface().Origin()))));
      }
      const ActivePlane* held = nullptr;
      for (int i = 0; i < this->Before.Active.SupportSize(); ++i)
      {
        const ActivePlane& plane = this->Before.Active.Support(i);
        held = plane.Facet.Surface == surface ? &plane : held;
      }
      if (!set.ContinueAfterChange(*before, held, scratch, looks) &&
        !this->God.Around.IsGripped(index))
      {
        wish = set.Frame().PointToScene(set.LocalPosition());
      }
    }
    isElsewhere = isElsewhere ||
      (!this->God.Around.IsGripped(index) &&
        set.LocalPosition() != set.Frame().PointToLocal(this->God.Position));
  }
  // All of them agree on one place, each by a motion that it certifies.
  ActivePlanes planes;
  if (this->God.Around.IsBall())
  {
    this->God.Around.FitBall();
  }
  this->God.IsSplit = isElsewhere && !this->Now.Moving.MoveAll(wish, planes);
  if (isElsewhere && planes.SupportSize() > 0)
  {
    this->God.Active = planes;
  }
  return same == this->God.Around.Sets.size() && same == this->Before.Around.Sets.size();
}

/// Where surfaces have changed all at once: goes to where they hold a hand that rests, so that what
/// this does to the spring counts as their own work, be it given or taken.
void Succession::Settle()
{
  const Vector before =
    this->Before.Position + (this->Before.Around.Origin - this->God.Around.Origin);
  const bool isConcerned =
    this->Before.Result.NumberOfConstraints > 0 || this->God.Position != before;
  if (!this->God.IsSplit && !this->Before.IsSplit && isConcerned)
  {
    this->Now.Update(ToVector(this->God.Result.Hip) - this->God.Around.Origin);
    this->God.SurfaceDisplacement += this->God.Position - before;
  }
}

/// Keeps what held another god-object, at the same place, where the surface that did is still the
/// same or goes on deforming: so that one held by friction stays, whatever else comes and goes.
void Succession::StayInContact()
{
  this->God.Result.Material = haptics::Material();
  const Vector shift = this->Before.Around.Origin - this->God.Around.Origin;
  if (this->God.Position != this->Before.Position + shift)
  {
    return;
  }
  ActivePlanes kept;
  for (int i = 0; i < this->Before.Active.SupportSize(); ++i)
  {
    ActivePlane plane = this->Before.Active.Support(i);
    const TouchedSurface& then = this->Before.Around.Surfaces[plane.Facet.Surface];
    const auto now =
      std::find_if(this->God.Around.Surfaces.begin(), this->God.Around.Surfaces.end(),
        [&](const TouchedSurface& touched)
        {
          const auto index = static_cast<std::int32_t>(&touched - this->God.Around.Surfaces.data());
          return (this->GoesOn(index, then) || touched.Surface->Follows(*then.Surface)) &&
            touched.Motion == then.Motion && touched.IsGripped == then.IsGripped;
        });
    const bool isPatch = now != this->God.Around.Surfaces.end() && now->Surface != then.Surface &&
      now->Surface->Patch();
    const std::int32_t triangle =
      isPatch ? now->Surface->FindSame(*then.Surface, plane.Facet.Triangle) : plane.Facet.Triangle;
    if (now != this->God.Around.Surfaces.end() && triangle >= 0)
    {
      plane.Facet = { static_cast<std::int32_t>(now - this->God.Around.Surfaces.begin()),
        triangle };
      this->God.Around.RenewPlane(plane);
      kept.Add(plane);
    }
  }
  if (kept.IsEmpty())
  {
    return;
  }
  kept.Nearest(this->God.Position, ToVector(this->God.Result.Hip) - this->God.Around.Origin);
  this->God.Active = kept;
  this->God.Cone = this->Before.Cone;
  this->God.Result.NumberOfConstraints = kept.SupportSize();
  this->Now.Materials.Update();
}

/// Where what held another god-object by friction has been made anew: stands on what is there now,
/// straight below, so that friction goes on as it was.
void Succession::Land()
{
  const int supports = this->Before.Active.SupportSize();
  if (this->Before.Result.Material.StaticFriction <= 0.0 || supports == 0 || this->God.IsSplit ||
    this->God.Result.NumberOfConstraints == 0)
  {
    return;
  }
  const Vector hip = ToVector(this->God.Result.Hip) - this->God.Around.Origin;
  ActivePlanes planes = this->God.Active; // those that have pushed it, if any did
  this->God.WaySize = 1;
  for (int i = 0; i < supports && this->God.Active.IsEmpty(); ++i)
  {
    const Vector& normal = this->Before.Active.Support(i).Normal;
    for (int cast = 0; cast < LargestNumberOfLandings; ++cast)
    {
      const double depth = glm::dot(normal, this->God.Position - hip);
      const Vector goal = this->God.Position - std::max(depth, 0.0) * normal;
      FacetHit hit;
      if (!this->God.Around.FindFirstHit(goal, planes, hit) || !hit)
      {
        break;
      }
      this->God.MoveTowards(this->God.Position + hit.Fraction * (goal - this->God.Position));
      if (!hit.IsWaypoint)
      {
        planes.Add(hit.Plane);
        break;
      }
    }
  }
  if (planes.IsEmpty())
  {
    return;
  }
  planes.Nearest(this->God.Position, hip);
  this->God.Active = planes;
  this->God.Cone = this->Before.Cone;
  this->God.Result.NumberOfConstraints = planes.SupportSize();
  this->Now.Materials.Update();
}

/// Whether no surface has another material than before: a hand would notice that at once. (One that
/// has deformed has its properties anew, and they go on.) Of patches the hand knows what it
/// touches.
bool Succession::HasSameMaterial() const
{
  return std::equal(this->God.Around.Surfaces.begin(), this->God.Around.Surfaces.end(),
           this->Before.Around.Surfaces.begin(), this->Before.Around.Surfaces.end(),
           [](const TouchedSurface& a, const TouchedSurface& b)
           { return a.Surface != b.Surface || a.Properties == b.Properties; }) &&
    (!this->God.Around.HasPatches ||
      AreAlike(this->God.Result.Material, this->Before.Result.Material));
}
}
