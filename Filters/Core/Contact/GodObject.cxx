#include "haptics/Contact/GodObject.h"

#include "haptics/Contact/SceneGodObject.h"
#include "haptics/Contact/Succession.h"
#include "haptics/Math/CoordinateRange.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace haptics
{
GodObject::GodObject(std::vector<TouchedSurface> surfaces, Tip tip)
  : Internal(new SceneGodObject(std::move(surfaces), tip))
{
}

GodObject::~GodObject() = default;

void GodObject::SetPassLimit(int passes)
{
  this->Internal->Walker.PassesAllowed = std::clamp(passes, 1, LargestNumberOfPasses);
}

void GodObject::SetSubstepLimit(int limit) noexcept
{
  this->Internal->Follower.SubstepsAllowed = std::clamp(limit, 1, LargestNumberOfSubsteps);
}

void GodObject::SetTipRadius(double radius) noexcept
{
  this->Internal->God.SetTipRadius(radius);
}

double GodObject::TipRadius() const noexcept
{
  return this->Internal->God.Around.TipRadius;
}

double GodObject::BallRadius() const noexcept
{
  return this->Internal->God.Around.BallRadius;
}

void GodObject::Place(const Vec3& hip) noexcept
{
  GodObjectState& god = this->Internal->God;
  this->Internal->Place(ToVector(hip) - god.Around.Origin);
  god.Result = {};
  god.Result.Hip = hip;
  god.Result.Position = hip;
}

bool GodObject::Continue(const GodObject& previous) noexcept
{
  return previous.Internal->God.IsPlaced && Succession(*this->Internal, *previous.Internal).Run();
}

void GodObject::Advance(double dt, bool isAwaited) noexcept
{
  this->Internal->Moving.Advance(dt, isAwaited ? Haste : 1.0);
}

bool GodObject::HasArrived() const noexcept
{
  return this->Internal->Moving.HasArrived();
}

const Contact& GodObject::Update(const Vec3& hip) noexcept
{
  GodObjectState& god = this->Internal->God;
  Contact& result = god.Result;
  if (!IsInRange(hip))
  {
    result.Status = UpdateStatus::InvalidHip;
    result.Displacement = {};
    result.Penetration = 0.0;
    result.NumberOfConstraints = 0;
    return result;
  }
  Vector goal = ToVector(hip) - god.Around.Origin;
  if (!god.IsPlaced)
  {
    this->Internal->Place(goal);
  }
  result.AwaitsData = false;
  result.IsAstray = false;
  if (god.Around.HasPatches)
  {
    const double known = god.Around.KnownPart(goal);
    result.AwaitsData = known < 1.0;
    result.IsAstray = god.Around.IsAstray();
    goal = result.AwaitsData ? god.Position + known * (goal - god.Position) : goal;
  }
  this->Internal->Update(goal);

  result.Hip = hip;
  result.SurfaceDisplacement = ToVec3(god.SurfaceDisplacement);
  god.SurfaceDisplacement = Vector(0.0);
  if (god.IsSplit)
  {
    result.Position = hip;
    result.Displacement = {};
    result.SurfaceDisplacement = {};
    result.Penetration = 0.0;
    result.NumberOfConstraints = 0;
    result.Status = UpdateStatus::Squeezed;
    if (const std::optional<Vector> place = god.Around.UnknownPlace())
    {
      result.Status = UpdateStatus::Free;
      result.AwaitsData = true;
      result.Position = ToVec3(*place + god.Around.Origin); // for the next patch to reach there
    }
    return result;
  }
  const Vector displacement = god.Position - goal;
  result.Position = ToVec3(god.Position + god.Around.Origin);
  result.Displacement = ToVec3(displacement);
  result.Penetration = glm::length(displacement);
  result.NumberOfConstraints = 0;
  result.Status = god.IsOverloaded ? UpdateStatus::Overloaded
    : god.Position == goal         ? UpdateStatus::Free
                                   : UpdateStatus::Touching;
  if (result.Status != UpdateStatus::Free)
  {
    if (god.Around.IsBall())
    {
      god.Around.RenewPlanes(god.Active);
    }
    god.ListConstraints();
  }
  this->Internal->Materials.Update();
  return result;
}

void GodObject::Jump(const Vec3& hip) noexcept
{
  GodObjectState& god = this->Internal->God;
  // In a patch, the way of the next Update() finds what there is between the two places.
  const bool isFree = god.Result.Status == UpdateStatus::Free && !god.Around.HasPatches;
  if (!god.IsPlaced ||
    (isFree && !god.IsSplit && god.Around.IsOnSameSide(ToVector(hip) - god.Around.Origin)))
  {
    this->Place(hip);
  }
  god.HipBefore = ToVector(hip) - god.Around.Origin; // nobody has moved it there
}

const Contact& GodObject::Hold() noexcept
{
  GodObjectState& god = this->Internal->God;
  const Vec3 here = ToVec3(god.Position + god.Around.Origin);
  if (god.IsSplit || !god.IsPlaced)
  {
    return this->Update(here);
  }
  god.Result = {};
  god.Result.Hip = here;
  god.Result.Position = here;
  god.SurfaceDisplacement = Vector(0.0);
  return god.Result;
}

const Contact& GodObject::Current() const noexcept
{
  return this->Internal->God.Result;
}

const Vec3* GodObject::Way(int& numberOfCorners) const noexcept
{
  numberOfCorners = this->Internal->God.WaySize;
  return this->Internal->God.Way.data();
}

Vec3 GodObject::WayOrigin() const noexcept
{
  return ToVec3(this->Internal->God.Around.Origin);
}

Vec3 GodObject::LocalPosition(int surface) const noexcept
{
  return ToVec3(this->Internal->God.Around.Sets[surface].LocalPosition());
}

Vec3 GodObject::LocalTouch(const Constraint& constraint) const noexcept
{
  return ToVec3(this->Internal->God.Around.LocalTouch(constraint));
}

double GodObject::DeformFraction(int surface) const noexcept
{
  return this->Internal->God.Around.Sets[surface].Fraction();
}

const std::vector<TouchedSurface>& GodObject::Surfaces() const noexcept
{
  return this->Internal->God.Around.Surfaces;
}
}
