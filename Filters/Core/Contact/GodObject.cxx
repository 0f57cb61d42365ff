#include "haptics/Contact/GodObject.h"

#include "haptics/Contact/GodObjectImplementation.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// A refused motion is tried at 1, 1/2, ... 1/32 of its length.
constexpr int LargestNumberOfHalvings = 6;
/// A god-object is at its HIP when it is so many clearances from it: as near as what it touches
/// lets it come.
constexpr double NearEnough = 8.0;

/// Facets whose planes were let go of in a pass.
class FacetsPassedOver
{
public:
  bool Has(const FacetId& facet) const
  {
    return std::find(this->Facets.begin(), this->Facets.begin() + this->Count, facet) !=
      this->Facets.begin() + this->Count;
  }
  /// False where there are too many.
  bool Add(const FacetId& facet)
  {
    if (this->Count == static_cast<int>(this->Facets.size()))
    {
      return false;
    }
    this->Facets[this->Count++] = facet;
    return true;
  }

private:
  std::array<FacetId, LargestNumberOfCasts> Facets;
  int Count = 0;
};
}

GodObject::Implementation::Implementation(std::vector<TouchedSurface> surfaces)
  : Surfaces(std::move(surfaces))
{
  if (!this->Surfaces.empty())
  {
    const TouchedSurface& first = this->Surfaces.front();
    const Vec3& origin = first.Surface->Origin();
    this->Origin = ToVector(first.Motion ? first.Motion->Read().Pose.PointToWorld(origin) : origin);
  }
  this->HasProperties = std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const TouchedSurface& touched) { return touched.Properties != nullptr; });
  this->Sets.reserve(this->Surfaces.size());
  this->Scratch.resize(this->Surfaces.empty() ? 0 : WorkingSet::LargestNumberOfTriangles);
  for (const TouchedSurface& touched : this->Surfaces)
  {
    const auto index = static_cast<std::int32_t>(this->Sets.size());
    this->Sets.emplace_back(touched.Surface, index, this->FrameOf(index, RigidPose()));
    if (touched.IsGripped)
    {
      continue;
    }
    ++this->Felt;
    this->SharingUnit = std::max(this->SharingUnit, touched.Surface->Clearance());
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
  this->Last = this->Felt;
  this->Along.resize(this->Felt);
  this->LocalStarts.resize(this->Felt);
}

void GodObject::Implementation::Place(const Vector& position)
{
  const bool isFirst = !this->IsPlaced;
  this->Position = position;
  this->IsPlaced = true;
  this->IsSplit = false;
  this->Carried = Vector(0.0);
  this->Active.Clear();
  this->Cone.Reset();
  this->LastHip = position;
  this->HipBefore = position;
  this->Refused = {};
  for (Mover& mover : this->Movers)
  {
    this->TakePose(mover);
  }
  for (std::size_t i = 0; i < this->Felt; ++i)
  {
    this->Sets[i].Restart(position);
  }
  for (std::size_t i = this->Felt; isFirst && i < this->Sets.size(); ++i)
  {
    SurfaceMotion* const motion = this->Surfaces[i].Motion.get();
    this->Sets[i].SetFrame(
      this->FrameOf(static_cast<std::int32_t>(i), motion ? motion->Advance(0.0) : RigidPose()));
    this->Sets[i].Restart(position);
  }
}

void GodObject::Implementation::Update(const Vector& hip)
{
  this->Budget.Triangles = LargestNumberOfTriangles;
  this->IsOverloaded = false;
  this->Way[0] = ToVec3(this->Position);
  this->WaySize = 1;
  this->PieceStart = 0;
  this->ReleasesLeft = LargestNumberOfReleases;
  this->GoalMoved = glm::length(hip - this->LastHip);
  this->LastHip = hip;
  const Vector from = this->HipBefore;
  this->HipBefore = hip;
  if (this->IsSplit && !this->Join(hip))
  {
    return;
  }
  if (this->PiecesAllowed > 1 && from != hip)
  {
    this->Follow(from, hip);
    return;
  }
  this->Approach(hip);
}

/// To where the surfaces let a HIP have it, in one piece.
void GodObject::Implementation::Approach(const Vector& hip)
{
  this->PassesLeft = this->PassesAllowed;
  const auto before = this->Active.SupportFacets();
  if (this->HasProperties)
  {
    this->WalkWithFriction(hip);
  }
  else if (this->Walk(hip) && this->Active.SupportSize() == 1 && this->Active.IsKnownInside() &&
    this->Active.Support(0).IsCertainlyBelow(this->Position))
  {
    return; // it is held by the facet that is right below, with the HIP straight behind it
  }
  if (this->Position != hip && !this->IsChangeFound)
  {
    this->LookAhead(hip, before);
  }
}

/// Moves to the nearest point to the goal that the surfaces let it reach. True if it came there.
bool GodObject::Implementation::Walk(const Vector& goal)
{
  while (this->PassesLeft-- > 0)
  {
    const Vector before = this->Position;
    const bool arrived = this->Pass(goal);
    if (this->Position == goal)
    {
      return true;
    }
    if (this->IsOverloaded || this->IsChangeFound)
    {
      return false;
    }
    const bool isSupported = arrived && this->IsSupported();
    const bool isHeld =
      isSupported || SquaredLength(this->Position - before) <= 1e-18 * SquaredLength(goal - before);
    if (isHeld && !this->Release(goal))
    {
      return isSupported;
    }
  }
  return false;
}

/// The first facet that any surface has in the way. False: more to look at than a tick may.
bool GodObject::Implementation::FindFirstHit(
  const Vector& goal, const ActivePlanes& planes, FacetHit& hit)
{
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    if (i == this->First)
    {
      if (!this->Sets[i].FindFirstHit(goal, planes, this->Budget, hit))
      {
        return false;
      }
      continue;
    }
    FacetHit other;
    if (!this->Sets[i].FindFirstHit(goal, planes, this->Budget, other))
    {
      return false;
    }
    hit.Take(other);
  }
  return true;
}

bool GodObject::Implementation::IsClear(const Vector& to)
{
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    if (!this->Sets[i].IsClear(to))
    {
      return false;
    }
  }
  return true;
}

/// To the target of the last IsClear.
void GodObject::Implementation::MoveSets()
{
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    this->Sets[i].Move();
  }
}

/// Moves to the nearest point to the HIP that the facets met on the way allow.
/// True if it came there.
bool GodObject::Implementation::Pass(const Vector& hip)
{
  // The facets that the god-object lies on hold it still: the cast to the HIP would meet them
  // first, so it is left out.
  this->KeepSupports(false);
  Vector goal = this->Active.IsEmpty() ? hip : this->Active.Nearest(this->Position, hip);
  FacetsPassedOver passed;
  for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
  {
    FacetHit hit;
    if (!this->FindFirstHit(goal, this->Active, hit))
    {
      this->IsOverloaded = true;
      return false;
    }
    if (this->LooksForChange)
    {
      this->LooksForChange = false;
      this->IsChangeFound = this->ChangesOnWay(goal, hip, hit);
      if (this->IsChangeFound)
      {
        return false;
      }
    }
    if (!hit)
    {
      const bool arrived = this->MoveTowards(goal);
      if (arrived || this->Active.SupportSize() == 0)
      {
        return arrived;
      }
      const Vector next = this->Active.Nearest(this->Position, hip);
      if (next == goal)
      {
        return false;
      }
      goal = next;
      continue;
    }
    if (hit.Fraction > 0.0)
    {
      this->MoveTowards(this->Position + hit.Fraction * (goal - this->Position));
    }
    if (hit.IsWaypoint)
    {
      continue;
    }
    if (this->Active.Has(hit.Plane.Facet))
    {
      return false;
    }
    // One that was met beyond its facet's edge, which is under the new one, is in nobody's way.
    // Where two are under each other, the one that is met again has both stay.
    if (!passed.Has(hit.Plane.Facet))
    {
      this->Active.Keep(
        [&](const ActivePlane& plane)
        {
          const bool isPassedOver =
            this->Sets[plane.Facet.Surface].IsPassedOver(plane, this->Position, hit.Plane);
          return !isPassedOver || !passed.Add(plane.Facet);
        });
    }
    this->Active.Add(hit.Plane);
    goal = this->Active.Nearest(this->Position, hip);
  }
  return false;
}

/// Makes the motion, or the largest tried part of it that is certified to cross nothing.
/// True if all of it was made.
bool GodObject::Implementation::MoveTowards(const Vector& target)
{
  Vector step = target - this->Position;
  Vector to = target;
  for (int halving = 0; halving < LargestNumberOfHalvings; ++halving)
  {
    if (this->IsClear(to))
    {
      this->MoveSets();
      this->Position = to;
      this->Active.SetKnownOver(false);
      this->Way[this->WaySize++] = ToVec3(to);
      return halving == 0;
    }
    step *= 0.5;
    to = this->Position + step;
  }
  return false;
}

/// Whether each plane that holds the god-object does so with its own facet. One that holds it
/// beyond its facet's edges has to be let go of: Fig. 5b.
bool GodObject::Implementation::IsSupported()
{
  if (this->Active.IsKnownOver())
  {
    return true;
  }
  bool areInside = true;
  for (int i = 0; i < this->Active.SupportSize(); ++i)
  {
    bool isInside = false;
    if (!this->IsOver(this->Active.Support(i), isInside))
    {
      return false;
    }
    areInside = areInside && isInside;
  }
  this->Active.SetKnownOver(true, areInside);
  return true;
}

/// Keeps of the planes that held the god-object those that do so with their own facets.
void GodObject::Implementation::KeepSupports(bool keepsFar)
{
  const bool isKnown = this->Active.IsKnownOver();
  bool areInside = !isKnown || this->Active.IsKnownInside();
  this->Active.KeepSupports(
    [&](const ActivePlane& plane)
    {
      if (plane.IsFar && !keepsFar)
      {
        return false;
      }
      bool isInside = true;
      const bool isKept = isKnown || this->IsOver(plane, isInside);
      areInside = areInside && isInside;
      return isKept;
    });
  this->Active.SetKnownOver(true, areInside);
}

bool GodObject::Implementation::IsOver(const ActivePlane& plane, bool& isInside) const
{
  return this->Sets[plane.Facet.Surface].Covers(plane, this->Position, this->Active, isInside);
}

/// What is in plain view is reached: goes to the HIP where no facet is in the straight way there
/// and that does not squeeze through a gap to be closed. So neither what facets reach over gaps nor
/// planes that hold together, though each alone would let go, hold where nothing is.
/// `before`: the facets that held it before this update. A line is met by what goes through it to
/// within rounding, and let go of in the next update.
void GodObject::Implementation::LookAhead(const Vector& hip, const std::array<FacetId, 3>& before)
{
  const int size = this->Active.SupportSize();
  if (this->IsOverloaded)
  {
    return;
  }
  double near = 0.0;
  for (int i = 0; i < size; ++i)
  {
    near = std::max(near, NearEnough * this->Active.Support(i).Clearance);
  }
  if (SquaredLength(hip - this->Position) <= near * near)
  {
    return;
  }
  for (int i = 0; i < size; ++i)
  {
    const ActivePlane& plane = this->Active.Support(i);
    const bool isNew = std::find(before.begin(), before.end(), plane.Facet) == before.end();
    if (this->Sets[plane.Facet.Surface].StandsInWay(plane, hip, isNew))
    {
      return;
    }
  }
  NarrowGap gap(this->Position, hip);
  for (std::size_t i = this->First; i < this->Last; ++i)
  {
    if (!this->Sets[i].IsOpen(hip, this->Budget, gap))
    {
      return;
    }
  }
  if (!gap.IsFound() && this->MoveTowards(hip))
  {
    this->Active.Clear();
  }
}

/// Tells the planes that hold the god-object, the one that pushes most first.
void GodObject::Implementation::ListConstraints()
{
  const Vector displacement = ToVector(this->Result.Displacement);
  std::array<double, 3> pushes{};
  this->Result.NumberOfConstraints = this->Active.SupportSize();
  for (int i = 0; i < this->Result.NumberOfConstraints; ++i)
  {
    const ActivePlane& plane = this->Active.Support(i);
    const double push = glm::dot(plane.Normal, displacement);
    int place = i;
    for (; place > 0 && pushes[place - 1] < push; --place)
    {
      pushes[place] = pushes[place - 1];
      this->Result.Constraints[place] = this->Result.Constraints[place - 1];
    }
    pushes[place] = push;
    this->Result.Constraints[place] = { ToVec3(plane.Normal), plane.Facet.Surface,
      plane.Facet.Triangle };
  }
}

GodObject::GodObject(std::vector<TouchedSurface> surfaces)
  : Internal(new Implementation(std::move(surfaces)))
{
}

GodObject::~GodObject() = default;

void GodObject::SetPassLimit(int passes)
{
  this->Internal->PassesAllowed = std::clamp(passes, 1, LargestNumberOfPasses);
}

void GodObject::SetPieceLimit(int pieces)
{
  this->Internal->PiecesAllowed = std::clamp(pieces, 1, LargestNumberOfPieces);
}

void GodObject::Place(const Vec3& hip) noexcept
{
  const Vector position = ToVector(hip) - this->Internal->Origin;
  this->Internal->Place(position);
  this->Internal->Result = {};
  this->Internal->Result.Hip = hip;
  this->Internal->Result.Position = hip;
}

bool GodObject::Continue(const GodObject& previous) noexcept
{
  if (!previous.Internal->IsPlaced)
  {
    return false;
  }
  this->Internal->Result = previous.Internal->Result;
  const bool isSeamless = this->Internal->Continue(*previous.Internal);
  this->Internal->StayInContact(*previous.Internal);
  if (!isSeamless)
  {
    this->Internal->Land(*previous.Internal);
    this->Internal->Settle(*previous.Internal);
  }
  return isSeamless && this->Internal->FeelsAs(*previous.Internal);
}

void GodObject::Advance(double dt, bool isAwaited) noexcept
{
  this->Internal->Advance(dt, isAwaited ? Haste : 1.0);
}

bool GodObject::HasArrived() const noexcept
{
  return this->Internal->HasArrived();
}

const Contact& GodObject::Update(const Vec3& hip) noexcept
{
  Implementation& god = *this->Internal;
  Contact& result = god.Result;
  const bool isValid = std::all_of(hip.begin(), hip.end(),
    [](double x) { return std::abs(x) < LargestCoordinate; }); // false for NaN
  if (!isValid)
  {
    result.Status = UpdateStatus::InvalidHip;
    result.Displacement = {};
    result.Penetration = 0.0;
    result.NumberOfConstraints = 0;
    return result;
  }
  const Vector goal = ToVector(hip) - god.Origin;
  if (!god.IsPlaced)
  {
    god.Place(goal);
  }
  god.Update(goal);

  result.Hip = hip;
  result.Carried = ToVec3(god.Carried);
  god.Carried = Vector(0.0);
  if (god.IsSplit)
  {
    result.Position = hip;
    result.Displacement = {};
    result.Carried = {};
    result.Penetration = 0.0;
    result.NumberOfConstraints = 0;
    result.Status = UpdateStatus::Squeezed;
    return result;
  }
  const Vector displacement = god.Position - goal;
  result.Position = ToVec3(god.Position + god.Origin);
  result.Displacement = ToVec3(displacement);
  result.Penetration = glm::length(displacement);
  result.NumberOfConstraints = 0;
  result.Status = god.IsOverloaded ? UpdateStatus::Overloaded
    : god.Position == goal         ? UpdateStatus::Free
                                   : UpdateStatus::Touching;
  if (result.Status != UpdateStatus::Free)
  {
    god.ListConstraints();
  }
  god.UpdateMaterial();
  return result;
}

void GodObject::Jump(const Vec3& hip) noexcept
{
  Implementation& god = *this->Internal;
  const bool isFree = god.Result.Status == UpdateStatus::Free;
  if (!god.IsPlaced || (isFree && !god.IsSplit && god.IsOnSameSide(ToVector(hip) - god.Origin)))
  {
    this->Place(hip);
  }
  god.HipBefore = ToVector(hip) - god.Origin; // nobody has moved it there
}

const Contact& GodObject::Hold() noexcept
{
  Implementation& god = *this->Internal;
  const Vec3 here = ToVec3(god.Position + god.Origin);
  if (god.IsSplit || !god.IsPlaced)
  {
    return this->Update(here);
  }
  god.Result = {};
  god.Result.Hip = here;
  god.Result.Position = here;
  god.Carried = Vector(0.0);
  return god.Result;
}

const Contact& GodObject::Current() const noexcept
{
  return this->Internal->Result;
}

const Vec3* GodObject::Way(int& numberOfCorners) const noexcept
{
  numberOfCorners = this->Internal->WaySize;
  return this->Internal->Way.data();
}

Vec3 GodObject::WayOrigin() const noexcept
{
  return ToVec3(this->Internal->Origin);
}

Vec3 GodObject::LocalPosition(int surface) const noexcept
{
  return ToVec3(this->Internal->Sets[surface].LocalPosition());
}

double GodObject::DeformFraction(int surface) const noexcept
{
  return this->Internal->Sets[surface].Fraction();
}

const std::vector<TouchedSurface>& GodObject::Surfaces() const noexcept
{
  return this->Internal->Surfaces;
}
}
