#include "haptics/Contact/ActivePlanes.h"

#include "haptics/Contact/ConstraintSolver.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// Planes closer to parallel than this squared sine have no usable line in common: one of them is
/// left out, as it holds wherever the other does. (1e-12 rad; directions err by 1e-16.)
constexpr double Parallel = 1e-24;
/// A god-object that keeps this share of the clearance, or more, lacks what rounding has worn down.
constexpr double WornHeight = 0.9375;
/// More than rounding of any point that is worked out here, as a share of the longest way.
constexpr double ShareOfWay = 0x1p-24;
/// A step of so many roundings of where it begins, or of the wish, is none: so what is held, and
/// whose hand rests, is at rest.
constexpr double RoundingsAtRest = 4.0;

bool IsRounding(const Vector& step, const Vector& from, const Vector& wish)
{
  constexpr double share = RoundingsAtRest * UnitRoundoff;
  return SquaredLength(step) <= share * share * (SquaredLength(from) + SquaredLength(wish));
}

/// A plane relative to `from`, which is so high over it: the least that is to be left of its
/// clearance, or all of that if `raise` is asked for and rounding has worn it down.
Plane<double> PlaneFrom(const ActivePlane& plane, double height, bool raise)
{
  const bool lift =
    raise && (height < 0.5 * plane.Clearance || height > WornHeight * plane.Clearance);
  return { { plane.Normal.x, plane.Normal.y, plane.Normal.z },
    lift ? plane.Clearance - height : std::min(plane.Clearance - height, 0.0) };
}

/// Whether a point keeps a plane but for rounding.
bool Keeps(const double y[3], const Plane<double>& plane, double clearance)
{
  const double size = std::max({ std::abs(y[0]), std::abs(y[1]), std::abs(y[2]) });
  return !(Dot(plane.Normal, y) < plane.Offset - (0.125 * clearance + 16.0 * UnitRoundoff * size));
}

/// Whether two or three planes push so much in the point y nearest to a wish on all of them that
/// the nearest point z on fewer, or none, lies behind one of the others, farther than `slack`.
///
/// With unit normals n, multipliers m and what z lacks of the others, d, the rule of Pythagoras for
/// wish, z and y says that |z - y|^2 is the sum of m d; and z - y is the part of the sum of m n
/// along what z is on. So |z - y|^2 >= (max m)^2 V, where V is 1, the squared sine between two
/// planes or the squared volume that three normals span, and some d >= (max m) V / 3.
bool DoAllPush(const std::array<Plane<double>, ActivePlanes::Capacity>& planes, int count,
  const double m[3], double slack)
{
  // Rounding grows as V falls; from here on it is far below any slack.
  constexpr double leastVolume = 0x1p-10;
  const double* const a = planes[0].Normal;
  const double* const b = planes[1].Normal;
  const double line[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0] };
  const double spanned = Dot(line, count == 2 ? line : planes[2].Normal);
  const double volume = count == 2 ? spanned : spanned * spanned;
  const double least = std::min({ m[0], m[1], m[count - 1] });
  return volume > leastVolume && least * volume > 4.0 * slack;
}
}

void ActivePlanes::Clear()
{
  this->Count = 0;
  this->NumberOfSupports = 0;
  this->IsOverAll = false;
}

bool ActivePlanes::Has(const FacetId& facet) const
{
  return std::any_of(this->Planes.begin(), this->Planes.begin() + this->Count,
    [&facet](const ActivePlane& plane) { return plane.Facet == facet; });
}

bool ActivePlanes::PassesOver(const Vector& point, const FacetId& facet) const
{
  return std::any_of(this->Planes.begin(), this->Planes.begin() + this->Count,
    [&](const ActivePlane& plane) { return !(plane.Facet == facet) && plane.PassesOver(point); });
}

void ActivePlanes::Add(const ActivePlane& plane)
{
  this->IsOverAll = false;
  if (this->Count < Capacity)
  {
    this->Planes[this->Count++] = plane;
    return;
  }
  // At most three of the six support: one of the first four is free.
  const auto supports = [this](int i)
  {
    const auto end = this->Supports.begin() + this->NumberOfSupports;
    return std::find(this->Supports.begin(), end, i) != end;
  };
  int slot = 0;
  while (supports(slot))
  {
    ++slot;
  }
  this->Planes[slot] = plane;
}

Vector ActivePlanes::Nearest(const Vector& from, const Vector& hip)
{
  const Vector wish = hip - from;
  Vector step(0.0);
  // A god-object is lifted back to the clearance where rounding has worn that down, so that what
  // it meets at an edge does not depend on roundings; where it is not even half, as far as the
  // planes leave room for it.
  if (!this->Solve(wish, true, from, step) && !this->Solve(wish, false, from, step))
  {
    return from;
  }
  if (this->NumberOfSupports == 0)
  {
    return hip; // exactly: free space has no force
  }
  if (IsRounding(step, from, wish))
  {
    return from;
  }
  // `from` is allowed: a nearest point farther from the HIP than it is rounding's.
  return SquaredLength(step - wish) <= SquaredLength(wish) * (1.0 + 1e-12) ? from + step : from;
}

bool ActivePlanes::PushOut(Vector& point)
{
  Vector step(0.0);
  if (!this->Solve(Vector(0.0), true, point, step))
  {
    return false;
  }
  point += step;
  return true;
}

/// One plane is kept by the wish, or by the point of the plane that is nearest to it.
bool ActivePlanes::SolveOne(const Vector& wish, bool raise, const Vector& from, Vector& nearest)
{
  const ActivePlane& active = this->Planes[0];
  const Plane<double> plane =
    PlaneFrom(active, glm::dot(active.Normal, from - active.Anchor), raise);
  this->Supports = {};
  this->NumberOfSupports = 0;
  double y[3] = { wish.x, wish.y, wish.z };
  if (!Keeps(y, plane, active.Clearance))
  {
    const double multiplier = plane.Offset - Dot(plane.Normal, y);
    for (int k = 0; k < 3; ++k)
    {
      y[k] += multiplier * plane.Normal[k];
    }
    if (!Keeps(y, plane, active.Clearance))
    {
      return false;
    }
    this->NumberOfSupports = 1;
  }
  nearest = { y[0], y[1], y[2] };
  return true;
}

bool ActivePlanes::Solve(const Vector& wish, bool raise, const Vector& from, Vector& nearest)
{
  if (this->Count == 1)
  {
    return this->SolveOne(wish, raise, from, nearest);
  }
  // Relative to `from`, where the numbers are small and keep their digits.
  std::array<Plane<double>, Capacity> planes;
  double longest = std::abs(wish.x) + std::abs(wish.y) + std::abs(wish.z);
  double widest = 0.0;
  for (int i = 0; i < this->Count; ++i)
  {
    const ActivePlane& plane = this->Planes[i];
    const double height = glm::dot(plane.Normal, from - plane.Anchor);
    planes[i] = PlaneFrom(plane, height, raise);
    longest = std::max(longest, std::abs(height));
    widest = std::max(widest, plane.Clearance);
  }
  const auto keepsAll = [&](const double y[3])
  {
    for (int i = 0; i < this->Count; ++i)
    {
      if (!Keeps(y, planes[i], this->Planes[i].Clearance))
      {
        return false;
      }
    }
    return true;
  };

  // The nearest point on some of the planes, and how much each pushes.
  const auto project = [&](const std::array<int, 3>& supports, int size, double y[3], double m[3])
  {
    const Plane<double>* const chosen[3] = { &planes[supports[0]], &planes[supports[1]],
      &planes[supports[2]] };
    PlaneProjection<double> projection;
    if (!projection.Prepare(chosen, size, Parallel))
    {
      return false;
    }
    projection.Project(y, m);
    if (size > 1 && !IsRounding({ y[0], y[1], y[2] }, from, wish))
    {
      // The wish may be long and the planes nearly parallel: what rounding left is taken out, so
      // that the point keeps its planes to within a small part of the clearance.
      double corrections[3];
      projection.Project(y, corrections);
      for (int i = 0; i < size; ++i)
      {
        m[i] += corrections[i];
      }
    }
    return true;
  };

  // Where all planes push, and none only a little, no fewer can: see DoAllPush(). So it is in
  // corners, from one update to the next.
  if (this->Count == 2 || this->Count == 3)
  {
    const double slack = widest + ShareOfWay * longest;
    const std::array<int, 3> all{ 0, 1, this->Count - 1 };
    double y[3] = { wish.x, wish.y, wish.z };
    double multipliers[3];
    if (project(all, this->Count, y, multipliers) &&
      DoAllPush(planes, this->Count, multipliers, slack) && keepsAll(y))
    {
      nearest = { y[0], y[1], y[2] };
      this->Supports = all;
      this->NumberOfSupports = this->Count;
      return true;
    }
  }

  // Every equality solution of up to three planes is a candidate. One that keeps all planes and
  // pulls on none (no multiplier is negative) is the nearest, as the problem is convex; where
  // rounding leaves no such candidate, the nearest of those that keep all planes is taken.
  double best = HUGE_VAL;
  this->NumberOfSupports = 0;
  const auto isNearest = [&](const std::array<int, 3>& supports, int size)
  {
    double y[3] = { wish.x, wish.y, wish.z };
    double multipliers[3];
    if (!project(supports, size, y, multipliers) || !keepsAll(y))
    {
      return false;
    }
    const bool pushes =
      std::none_of(multipliers, multipliers + size, [](double m) { return m < 0.0; });
    const Vector step(y[0], y[1], y[2]);
    const double distance = SquaredLength(step - wish);
    if (pushes || distance < best)
    {
      best = distance;
      nearest = step;
      this->Supports = supports;
      this->NumberOfSupports = size;
    }
    return pushes;
  };
  if (isNearest({}, 0))
  {
    return true;
  }
  for (int i = 0; i < this->Count; ++i)
  {
    if (isNearest({ i }, 1))
    {
      return true;
    }
  }
  for (int i = 0; i < this->Count; ++i)
  {
    for (int j = i + 1; j < this->Count; ++j)
    {
      if (isNearest({ i, j }, 2))
      {
        return true;
      }
    }
  }
  for (int i = 0; i < this->Count; ++i)
  {
    for (int j = i + 1; j < this->Count; ++j)
    {
      for (int k = j + 1; k < this->Count; ++k)
      {
        if (isNearest({ i, j, k }, 3))
        {
          return true;
        }
      }
    }
  }
  return best < HUGE_VAL;
}
}
