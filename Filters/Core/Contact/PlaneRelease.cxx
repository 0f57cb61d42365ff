#include "haptics/Contact/PlaneRelease.h"

#include "haptics/Contact/NarrowGap.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Planes to try: those that hold, and those of facets in the way of a try; of a goal that rests
/// those of facets near by, too.
constexpr int MostPlanes = 8;
constexpr int MostPlanesAtRest = 16;
/// So many clearances from the god-object is near by.
constexpr double NearBy = 64.0;
/// How far behind a plane a try ends, in its clearances: not so near that the next cast meets it
/// again.
constexpr double DepthBehind = 4.0;
/// A motion along planes has to come so much nearer to the goal, of its length.
constexpr double LeastDescent = 1e-3;
/// A goal rests that moves no more than this share of its distance in an update: less than one that
/// goes slowly in a thousand updates a tick.
constexpr double RestingShare = 1e-8;
/// Pulls with this cosine between them, a third of a thousandth, get the same answer; those of a
/// goal that does not rest with that one, a fiftieth: there it is not worth asking in each update.
constexpr double SameDirection = 1.0 - 5e-8;
constexpr double AlmostSameDirection = 1.0 - 2e-4;
/// A position is another one from so many clearances on.
constexpr double SamePlace = 0.25;
/// A pull that has grown by more than that has room for ways that were too long.
constexpr double SameLength = 2.0;
/// Where a goal rests, so many ways are tried in all directions that lead nearer to it, in each of
/// so many updates others; they are as long as what is near by: farther inside a facet than that,
/// the facet holds.
constexpr int WaysAround = 128;
constexpr int RoundsAtRest = 4;
constexpr std::int32_t MostLookedUpAtRest = 1 << 16; ///< triangles, each as often as it is

/// By their numbers, those of no facet (-1) last.
void SortThree(std::array<FacetId, 3>& facets)
{
  const auto put = [&](int i, int j)
  {
    const auto key = [&](int k)
    {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(facets[k].Surface)) << 32 |
        static_cast<std::uint32_t>(facets[k].Triangle);
    };
    if (key(j) < key(i))
    {
      std::swap(facets[i], facets[j]);
    }
  };
  put(0, 1);
  put(1, 2);
  put(0, 1);
}

/// The `i`th of `count` unit directions, evenly over the half-sphere about `ahead`, from there
/// outwards along a spiral (of Fibonacci) that begins towards `side`.
Vector DirectionAround(int i, int count, const Vector& ahead, const Vector& side)
{
  const double goldenAngle = M_PI * (3.0 - std::sqrt(5.0));
  const double along = 1.0 - (i + 0.5) / count;
  const double across = std::sqrt(1.0 - along * along);
  const Vector other = glm::cross(ahead, side);
  return along * ahead +
    across * (std::cos(goldenAngle * i) * side + std::sin(goldenAngle * i) * other);
}

/// A unit vector across `ahead`, that of `wish` where it is not along it.
Vector Across(const Vector& ahead, const Vector& wish)
{
  const Vector axis = std::abs(ahead.x) < 0.5 ? Vector(1, 0, 0) : Vector(0, 1, 0);
  const Vector across = wish - glm::dot(wish, ahead) * ahead;
  const double length = glm::length(across);
  return length > 1e-3 * glm::length(wish) && length > 0.0
    ? across / length
    : glm::normalize(axis - glm::dot(axis, ahead) * ahead);
}

/// The planes that a god-object tries to go along from where it is, on the way to a goal.
struct Tries
{
  Vector Position;
  Vector Pull; ///< to the goal
  double PullLength;
  std::array<ActivePlane, MostPlanesAtRest> Planes;
  /// From each of those that hold to where a try ends behind it, across the plane.
  std::array<double, 3> ToBehind;
  int Most = MostPlanes;
  int Held = 0; ///< so many of them hold it, the first
  int Size = 0;

  Tries(const Vector& position, const Vector& pull)
    : Position(position)
    , Pull(pull)
    , PullLength(glm::length(pull))
  {
  }

  void AddHolding(const ActivePlane& plane)
  {
    this->ToBehind[this->Held] =
      glm::dot(plane.Normal, this->Position - plane.Anchor) + DepthBehind * plane.Clearance;
    this->Planes[this->Held++] = plane;
    this->Size = this->Held;
  }
  void Add(const ActivePlane& plane)
  {
    const bool isKnown = std::any_of(this->Planes.begin(), this->Planes.begin() + this->Size,
      [&](const ActivePlane& other) { return other.Facet == plane.Facet; });
    if (!isKnown && this->Size < this->Most)
    {
      this->Planes[this->Size++] = plane;
    }
  }

  /// Along none, one or two planes (-1: none) as far as it takes to be behind those that hold and
  /// are not gone along. False where that leads no nearer to the goal.
  bool FindStep(int first, int second, Vector& step) const
  {
    Vector along = this->Pull;
    if (second >= 0)
    {
      const Vector crease = glm::cross(this->Planes[first].Normal, this->Planes[second].Normal);
      const double squared = SquaredLength(crease);
      along = squared > 1e-20 ? (glm::dot(along, crease) / squared) * crease : Vector(0.0);
    }
    else if (first >= 0)
    {
      const Vector& normal = this->Planes[first].Normal;
      along -= glm::dot(along, normal) * normal;
    }
    const double reach = glm::length(along);
    if (!(reach > LeastDescent * this->PullLength))
    {
      return false;
    }
    along /= reach;
    double length = this->Held == 0 ? reach : 0.0;
    for (int i = 0; i < this->Held; ++i)
    {
      const double approach = -glm::dot(this->Planes[i].Normal, along);
      if (i != first && i != second && approach > 1e-6)
      {
        length = std::max(length, this->ToBehind[i] / approach);
      }
    }
    if (first < 0)
    {
      length = std::min(length, reach); // to the goal itself
    }
    step = length * along;
    return length > 0.0 && length <= reach;
  }

  /// Whether a place is behind a plane that holds, farther than any of them is kept off: short of
  /// that, nearer to the goal is only nearer to the planes.
  bool IsBehindOne(const Vector& place) const
  {
    return std::any_of(this->Planes.begin(), this->Planes.begin() + this->Held,
      [&](const ActivePlane& plane)
      { return glm::dot(plane.Normal, place - plane.Anchor) < -DepthBehind * plane.Clearance; });
  }
};
}

/// Where a short motion that ends behind planes that hold the god-object is certified to touch
/// nothing, what is there of them is not in the way. It is tried towards the goal, along each plane
/// and along two; a facet in the way of one try is a plane to go along in the next, and where the
/// goal rests, so is any facet near by. All lead nearer to the goal, so the update stays monotone.
bool PlaneRelease::Release(const Vector& goal)
{
  const Vector pull = goal - this->God.Position;
  if (this->Left <= 0 || !this->MayBeReleased(pull))
  {
    return false;
  }
  --this->Left;
  Tries tries(this->God.Position, pull);
  for (int i = 0; i < this->God.Active.SupportSize(); ++i)
  {
    const ActivePlane& plane = this->God.Active.Support(i);
    if (plane.IsOfWire)
    {
      return false; // it is let go of where the goal is in plain view
    }
    tries.AddHolding(plane);
  }
  const auto tryStep = [&](const Vector& step, ActivePlane& inTheWay)
  {
    const Vector to = this->God.Position + step;
    for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
    {
      if (!this->God.Around.Sets[i].IsClearNear(to, inTheWay))
      {
        if (inTheWay.Facet.Triangle >= 0)
        {
          tries.Add(inTheWay);
        }
        return false;
      }
    }
    if (!this->IsNoGap(to))
    {
      return false;
    }
    this->God.MoveTo(to);
    this->God.Active.Clear();
    return true;
  };
  const bool isSurfaceStill = this->God.Around.IsOneAtRest();
  const auto attempt = [&](int first, int second)
  {
    Vector step;
    if (!tries.FindStep(first, second, step))
    {
      return false;
    }
    ActivePlane inTheWay;
    if (second < 0 || !isSurfaceStill)
    {
      return tryStep(step, inTheWay);
    }
    const FacetId& one = tries.Planes[first].Facet;
    const FacetId& other = tries.Planes[second].Facet;
    if (const ActivePlane* const known = this->Blocked.Find(one, other, step))
    {
      tries.Add(*known);
      return false;
    }
    const bool isMade = tryStep(step, inTheWay);
    if (!isMade && inTheWay.Facet.Triangle >= 0)
    {
      this->Blocked.Add(one, other, step, inTheWay);
    }
    return isMade;
  };
  int tried = 0;
  const auto attemptAll = [&]
  {
    for (; tried < tries.Size; ++tried) // tries add planes
    {
      if (attempt(tried, -1))
      {
        return true;
      }
      for (int other = 0; other < tried; ++other)
      {
        if (attempt(other, tried))
        {
          return true;
        }
      }
    }
    return false;
  };
  const auto attemptAround = [&]
  {
    const double distance = glm::length(pull);
    const Vector ahead = pull / distance;
    const Vector side = Across(ahead, tries.Planes[0].Anchor - this->God.Position);
    double length = 0.0;
    for (int i = 0; i < tries.Held; ++i)
    {
      length = std::max(length, NearBy * tries.Planes[i].Clearance);
    }
    std::int32_t gathered = 0;
    for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
    {
      gathered += this->God.Around.Sets[i].GatheredTriangles();
    }
    // Fewer where a great many triangles meet, so that the update stays as short as any.
    const int most = std::min(WaysAround, MostLookedUpAtRest / std::max(gathered, 1));
    constexpr int count = RoundsAtRest * WaysAround;
    for (int k = 0; k < most && tries.Held > 0; ++k)
    {
      const int i = this->Refused.Rounds - 1 + RoundsAtRest * (k * (WaysAround / most));
      const Vector direction = DirectionAround(i, count, ahead, side);
      const Vector step = length * direction;
      if (length > glm::dot(direction, pull))
      {
        return false; // this, and all that come after it, would go on beyond the foot of the goal
      }
      ActivePlane inTheWay;
      if (tries.IsBehindOne(this->God.Position + step) && tryStep(step, inTheWay))
      {
        return true;
      }
    }
    return false;
  };
  const bool isRepeated = this->Refused.Rounds > 1;
  if (!isRepeated && (attempt(-1, -1) || attemptAll()))
  {
    return true;
  }
  if (this->Refused.Rounds == 0)
  {
    return false; // the goal is on its way
  }
  tries.Most = MostPlanesAtRest;
  int near = 0;
  bool isRimNear = false;
  bool isGapNear = false;
  for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
  {
    this->God.Around.Sets[i].VisitNear(NearBy,
      [&](const ActivePlane& plane)
      {
        ++near;
        tries.Add(plane);
      });
    const WorkingSet::Rims rims = this->God.Around.Sets[i].FindRimsNear(NearBy);
    isGapNear =
      isGapNear || rims == WorkingSet::Rims::Apart || (isRimNear && rims != WorkingSet::Rims::None);
    isRimNear = isRimNear || rims != WorkingSet::Rims::None;
  }
  this->Left = 0;
  if (!isRepeated && attemptAll())
  {
    return true;
  }
  // Where there is nothing around but what holds it there is no way around either; and where cracks
  // meet there is a hole that facets close by reaching over it, wider than the crack width.
  if (isGapNear || (near == tries.Held && !isRimNear))
  {
    this->Refused.Rounds = RoundsAtRest;
    return false;
  }
  return attemptAround();
}

/// Whether a motion that is clear does not squeeze through a gap that facets close by reaching over
/// it. Certifies it again, so that it can be made.
bool PlaneRelease::IsNoGap(const Vector& to)
{
  NarrowGap gap(this->God.Position, to);
  for (std::size_t i = this->God.Around.First; i < this->God.Around.Last; ++i)
  {
    if (!this->God.Around.Sets[i].IsOpen(to, this->God.Around.Budget, gap))
    {
      return false;
    }
  }
  return !gap.IsFound() && this->God.Around.IsClear(to);
}

/// Whether a god-object that is held has to ask: not while it slides, so that a way does not hang
/// on how far planes are kept off, and not again what was refused. How fast the goal moves makes no
/// difference, so that one that is sampled more often gets the same answer.
bool PlaneRelease::MayBeReleased(const Vector& pull)
{
  double least = 0.0;
  for (int i = 0; i < this->God.Active.SupportSize(); ++i)
  {
    least = std::max(least, DepthBehind * this->God.Active.Support(i).Clearance);
  }
  const double moved = SquaredLength(this->God.Position - ToVector(this->God.Way[this->Start]));
  const double distance = glm::length(pull);
  if (moved > least * least && this->God.Active.SupportSize() < 3)
  {
    return false;
  }
  std::array<FacetId, 3> facets = this->God.Active.SupportFacets();
  SortThree(facets);
  const double same = SamePlace / DepthBehind * least;
  const bool isAtRest = this->GoalMoved <= RestingShare * distance;
  const double cosine = isAtRest ? SameDirection : AlmostSameDirection;
  const double before = glm::length(this->Refused.Pull);
  // As the surface sees it that holds: one that moves takes what was refused along.
  const SurfaceFrame& frame = this->God.Around.Sets[std::max(facets[0].Surface, 0)].Frame();
  const Vector localPosition = frame.PointToLocal(this->God.Position);
  const Vector localPull = frame.VectorToLocal(pull);
  const bool isSame = SquaredLength(localPosition - this->Refused.Position) <= same * same &&
    facets == this->Refused.Facets &&
    glm::dot(localPull, this->Refused.Pull) >= cosine * distance * before &&
    distance <= SameLength * before;
  if (!isSame)
  {
    this->Refused = { localPosition, localPull, facets, 0 };
  }
  // A moving goal has fewer tries: where it comes to rest, the others are due.
  const bool isDue = !isSame || (isAtRest && this->Refused.Rounds < RoundsAtRest);
  this->Refused.Rounds += isDue && isAtRest ? 1 : 0;
  if (isDue)
  {
    this->Blocked.StandAt(localPosition, same, facets);
  }
  return isDue;
}
}
