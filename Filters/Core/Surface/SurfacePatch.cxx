#include "haptics/Surface/SurfacePatch.h"

#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <tuple>

namespace haptics
{
namespace
{
/// Of the search for how far a god-object may go: a part in a million of a way.
constexpr int NumberOfHalvings = 20;
/// Of a region's size, for the rounding of what is asked of it.
constexpr double RoundingShare = 0x1p-40;
/// The same of a hollow's radius, which comes through other frames.
constexpr double HollowSlack = 1e-9;

auto Values(const SurfaceReport& r)
{
  return std::tie(r.BoundaryEdges, r.NonManifoldEdges, r.FlippedEdges, r.Components,
    r.InsideOutComponents, r.Closed, r.Oriented);
}
}

double PatchRegion::DistanceTo(const Vec3& point) const noexcept
{
  const Vector from = ToVector(this->From);
  const Vector way = ToVector(this->To) - from;
  const Vector x = ToVector(point) - from;
  const double squared = SquaredLength(way);
  const double along = squared > 0.0 ? std::clamp(glm::dot(x, way) / squared, 0.0, 1.0) : 0.0;
  return glm::length(x - along * way);
}

bool PatchRegion::MeetsBox(const Vec3& low, const Vec3& high) const noexcept
{
  // The line against the box grown by the radius, slab by slab.
  double enter = 0.0;
  double leave = 1.0;
  double squared = 0.0; // distance of From from the box
  for (int axis = 0; axis < 3; ++axis)
  {
    const double start = this->From[axis];
    const double way = this->To[axis] - start;
    const double least = low[axis] - this->Radius;
    const double most = high[axis] + this->Radius;
    const double off = std::max({ low[axis] - start, start - high[axis], 0.0 });
    squared += off * off;
    if (way == 0.0)
    {
      if (start < least || start > most)
      {
        return false;
      }
      continue;
    }
    const double first = (least - start) / way;
    const double last = (most - start) / way;
    enter = std::max(enter, std::min(first, last) - RoundingShare);
    leave = std::min(leave, std::max(first, last) + RoundingShare);
  }
  return enter <= leave &&
    (this->From != this->To || squared <= this->Radius * this->Radius * (1.0 + RoundingShare));
}

double PatchRegion::KnownPart(const Vec3& from, const Vec3& to, double margin) const noexcept
{
  const Vector start = ToVector(from);
  const Vector way = ToVector(to) - start;
  const double length = glm::length(way);
  const double radius = this->Radius * (1.0 - RoundingShare) - margin;
  // Convex along the way, so that a part that is known has nothing unknown before it.
  const auto isKnown = [&](double part)
  { return this->DistanceTo(ToVec3(start + part * way)) + part * length <= radius; };
  if (isKnown(1.0))
  {
    return 1.0;
  }
  double known = 0.0;
  double unknown = 1.0;
  for (int i = 0; i < NumberOfHalvings && isKnown(0.0); ++i)
  {
    const double middle = 0.5 * (known + unknown);
    (isKnown(middle) ? known : unknown) = middle;
  }
  return known;
}

bool WholeSurface::operator==(const WholeSurface& other) const noexcept
{
  const auto values = [](const WholeSurface& w)
  {
    return std::tie(
      w.Origin, w.Radius, w.Diagonal, w.LongestEdge, w.CrackWidth, w.Triangles, w.Version);
  };
  return values(*this) == values(other) && Values(this->Report) == Values(other.Report);
}

SurfacePatch::SurfacePatch(std::shared_ptr<const WholeSurface> whole, const PatchRegion& region,
  const PatchEnclosure& enclosure, double margin, const std::vector<std::int64_t>& ids)
  : Record(std::move(whole))
  , Known(region)
  , Sides(enclosure)
  , Ids(ids)
{
  this->Known.Radius -= margin;
  this->Sorted.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    this->Sorted.emplace_back(ids[i], static_cast<std::int32_t>(i));
  }
  std::sort(this->Sorted.begin(), this->Sorted.end());
}

bool SurfacePatch::HoldsNearest(const Vec3& place, double distance) const noexcept
{
  const double off = glm::length(ToVector(place) - ToVector(this->Sides.Middle));
  const double slack = HollowSlack * this->Sides.HollowRadius;
  return this->Known.DistanceTo(place) + distance <= this->Known.Radius ||
    (off <= slack && distance <= this->Sides.HollowRadius + slack);
}

std::int32_t SurfacePatch::Find(std::int64_t id) const noexcept
{
  const auto place = std::lower_bound(this->Sorted.begin(), this->Sorted.end(), id,
    [](const std::pair<std::int64_t, std::int32_t>& entry, std::int64_t wanted)
    { return entry.first < wanted; });
  return place != this->Sorted.end() && place->first == id ? place->second : -1;
}
}
