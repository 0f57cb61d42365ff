#include "GodObject.h"

#include "WorkingSet.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Fig. 5's two-step transition over a convex edge is made within one update by passes; each lets
/// go of the planes that held only beyond their facets. Two or three do on a slide; a god-object
/// that slips off a round body in one tick takes more, and every tick that needs fewer pays none.
#ifdef HAPTICS_LARGEST_NUMBER_OF_PASSES // by Testing/Benchmarks, to compare
constexpr int LargestNumberOfPasses = HAPTICS_LARGEST_NUMBER_OF_PASSES;
#else
constexpr int LargestNumberOfPasses = 16;
#endif
/// A pass meets at most a few facets; more come of rounding.
constexpr int LargestNumberOfCasts = 12;
/// A refused motion is tried at 1, 1/2, ... 1/32 of its length.
constexpr int LargestNumberOfHalvings = 6;
/// Triangles looked up in one update, all passes and surfaces together: a few dozen in practice,
/// and a few milliseconds at the most.
constexpr std::int64_t LargestNumberOfTriangles = 1 << 17;

/// Each cast makes at most one motion.
constexpr int LargestWay = LargestNumberOfPasses * LargestNumberOfCasts + 1;
}

class GodObject::Implementation
{
public:
  explicit Implementation(std::vector<TouchedSurface> surfaces)
    : Surfaces(std::move(surfaces))
  {
    if (!this->Surfaces.empty())
    {
      this->Origin = ToVector(this->Surfaces.front().Surface->Origin());
    }
    this->Sets.reserve(this->Surfaces.size());
    for (const TouchedSurface& touched : this->Surfaces)
    {
      const auto index = static_cast<std::int32_t>(this->Sets.size());
      this->Sets.emplace_back(
        touched.Surface, index, ToVector(touched.Surface->Origin()) - this->Origin);
    }
  }

  void Place(const Vector& position)
  {
    this->Position = position;
    this->IsPlaced = true;
    this->Active.Clear();
    for (WorkingSet& set : this->Sets)
    {
      set.Place(position);
    }
  }

  void Update(const Vector& hip)
  {
    this->Budget.Triangles = LargestNumberOfTriangles;
    this->IsOverloaded = false;
    this->Way[0] = ToVec3(this->Position);
    this->WaySize = 1;
    for (int pass = 0; pass < LargestNumberOfPasses; ++pass)
    {
      const Vector before = this->Position;
      const bool arrived = this->Pass(hip);
      if (this->IsOverloaded || this->Position == hip || (arrived && this->IsSupported()))
      {
        break;
      }
      if (SquaredLength(this->Position - before) <= 1e-18 * SquaredLength(hip - before))
      {
        break;
      }
    }
  }

  std::vector<TouchedSurface> Surfaces;
  Vector Origin{ 0 };   ///< of the scene frame, in the world
  Vector Position{ 0 }; ///< scene frame
  bool IsPlaced = false;
  bool IsOverloaded = false;
  ActivePlanes Active;
  Contact Result;
  std::array<Vec3, LargestWay> Way;
  int WaySize = 0;

private:
  /// Moves to the nearest point to the HIP that the facets met on the way allow.
  /// True if it came there.
  bool Pass(const Vector& hip)
  {
    // The facets that the god-object lies on hold it still: the cast to the HIP would meet them
    // first, so it is left out.
    this->Active.KeepSupports(
      [this](const ActivePlane& plane) { return !plane.IsFar && this->IsOver(plane); });
    Vector goal = this->Active.IsEmpty() ? hip : this->Active.Nearest(this->Position, hip);
    for (int cast = 0; cast < LargestNumberOfCasts; ++cast)
    {
      FacetHit hit;
      for (WorkingSet& set : this->Sets)
      {
        FacetHit other;
        if (!set.FindFirstHit(goal, this->Active, this->Budget, other))
        {
          this->IsOverloaded = true;
          return false;
        }
        if (other.Fraction < hit.Fraction)
        {
          hit = other;
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
      this->Active.Add(hit.Plane);
      goal = this->Active.Nearest(this->Position, hip);
    }
    return false;
  }

  /// Makes the motion, or the largest tried part of it that is certified to cross nothing.
  /// True if all of it was made.
  bool MoveTowards(const Vector& target)
  {
    Vector step = target - this->Position;
    Vector to = target;
    for (int halving = 0; halving < LargestNumberOfHalvings; ++halving)
    {
      const bool isClear = std::all_of(
        this->Sets.begin(), this->Sets.end(), [&to](WorkingSet& set) { return set.IsClear(to); });
      if (isClear)
      {
        for (WorkingSet& set : this->Sets)
        {
          set.Move();
        }
        this->Position = to;
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
  bool IsSupported() const
  {
    for (int i = 0; i < this->Active.SupportSize(); ++i)
    {
      if (!this->IsOver(this->Active.Support(i)))
      {
        return false;
      }
    }
    return true;
  }

  bool IsOver(const ActivePlane& plane) const
  {
    return this->Sets[plane.Facet.Surface].Covers(plane, this->Position);
  }

  std::vector<WorkingSet> Sets;
  WorkBudget Budget;
};

GodObject::GodObject(std::vector<TouchedSurface> surfaces)
  : Internal(new Implementation(std::move(surfaces)))
{
}

GodObject::~GodObject() = default;

void GodObject::Place(const Vec3& hip) noexcept
{
  const Vector position = ToVector(hip) - this->Internal->Origin;
  this->Internal->Place(position);
  this->Internal->Result = {};
  this->Internal->Result.Hip = hip;
  this->Internal->Result.Position = hip;
}

void GodObject::Continue(const GodObject& previous) noexcept
{
  if (previous.Internal->IsPlaced)
  {
    this->Internal->Place(
      previous.Internal->Position + (previous.Internal->Origin - this->Internal->Origin));
    this->Internal->Result = previous.Internal->Result;
  }
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

  const Vector displacement = god.Position - goal;
  result.Hip = hip;
  result.Position = ToVec3(god.Position + god.Origin);
  result.Displacement = ToVec3(displacement);
  result.Penetration = glm::length(displacement);
  result.NumberOfConstraints = 0;
  result.Status = god.IsOverloaded ? UpdateStatus::Overloaded
    : god.Position == goal         ? UpdateStatus::Free
                                   : UpdateStatus::Touching;
  if (result.Status != UpdateStatus::Free)
  {
    result.NumberOfConstraints = god.Active.SupportSize();
    for (int i = 0; i < result.NumberOfConstraints; ++i)
    {
      const ActivePlane& plane = god.Active.Support(i);
      result.Constraints[i] = { ToVec3(plane.Normal), plane.Facet.Surface, plane.Facet.Triangle };
    }
  }
  return result;
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

const std::vector<TouchedSurface>& GodObject::Surfaces() const noexcept
{
  return this->Internal->Surfaces;
}
}
