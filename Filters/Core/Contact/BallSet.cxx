#include "haptics/Contact/BallSet.h"

#include "haptics/Surface/CornerPrefetch.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// A facet is met at this share of the height that a ball is kept at: rounding along flat
/// neighbours is not a hit.
constexpr double MeetingHeight = 0.25;
/// And so near to where it is met, that is where.
constexpr double MetHeight = 0.125 * MeetingHeight;
/// Rounding of a motion, by its length.
constexpr double WayError = 8.0 * UnitRoundoff;
/// Newton's method doubles the digits; along a tangent it halves what is left.
constexpr int LargestNumberOfPlanes = 48;
/// How many facets a disk as wide as the margin has, so that gathering costs least: what lies under
/// a ball of radius r that touches, within a margin m, is in proportion to 2 r m + m^2, and serves
/// a motion of m. What else a gathering costs is as much as some facets do.
constexpr double FacetsOfMargin = 8.0;
constexpr std::int32_t FewTriangles = 256;
/// Within so many heights of a facet a centre has no side: it has been started there.
constexpr double NoSide = 0.125;
/// A direction that is across the normals of what is touched, as at the edge of a plate without
/// thickness, agrees with them.
constexpr double Agreement = 1e-7;
/// A cast is no longer than so many sizes of the surface: its rounding is below the height then.
constexpr double LongestCast = 16.0;
/// While facets move, twice the ball that they stay out of for certain, in radii.
constexpr double LeastWhileSwept = 0.99;
/// A motion that is to be known whole is gathered for up to so many margins.
constexpr double LongestGathered = 8.0;
/// The margin, in surface radii, that is tried first.
constexpr double FirstMargin = 0.125;
/// The way of a ball, in about the radius of what was gathered, after which that is separated anew.
constexpr float FarthestTravelled = 4.0F;
/// Corners where more facets meet are decided by the one that is asked.
constexpr std::int32_t LargestFan = 1024;
/// Nearer to an edge, in radii, than this a goal does not say in which direction from that it is.
constexpr double NearestTurn = 0.125;
/// Of the margin: less than this of a motion that is known is not worth a look of its own.
constexpr double LeastLookedAt = 0.5;
/// What is gathered for a long motion lies so much of the margin ahead: it reaches farther along
/// it.
constexpr double Ahead = 0.5;
/// What is inside of what meets a ball is smaller by rounding than what was asked for.
constexpr double Shrink = 1.0 - 0x1p-40;

/// After which share of a way, that approaches it, one is nearest to the line of the edge, or to
/// the corner, that is nearest where it starts; a facet's plane has no such place.
double NearestOnWay(
  const BallFacet& facet, const Separation& start, const Vector& way, double approach)
{
  if (start.Edge < 0 || !(start.Distance > 0.0 && approach > 0.0))
  {
    return HUGE_VAL;
  }
  double squared = SquaredLength(way);
  if (start.Corner < 0)
  {
    const double along = glm::dot(way, facet.Edges[start.Edge]);
    squared -= along * (along / facet.SquaredLengths[start.Edge]);
  }
  return squared > 0.0 ? start.Distance * approach / squared : HUGE_VAL;
}
}

/// Of the ball's centre, in the surface's frame.
struct BallSet::Motion
{
  Vector From;
  Vector Way;
  double Length;
  double Radius; ///< of the ball
  double Reach;  ///< from the centre, at which a facet is met
  double Height;
  double Known; ///< no facet can be missing up to here, 0 to 1
  bool IsPart;  ///< there is more of it than this

  /// Facets met within so much of the way are met at once.
  double Slack() const { return this->Length > 0.0 ? 0.125 * this->Height / this->Length : 0.0; }
};

BallSet::BallSet(const TriangleSurface& surface, std::int32_t index)
  : Surface(surface)
  , Index(index)
  , Triangles(std::min<std::size_t>(LargestNumberOfTriangles, surface.Triangles().size()))
  , Planes(static_cast<std::int32_t>(this->Triangles.size()))
  , KnownFacets(NumberOfKnownFacets)
{
  this->Restart();
}

void BallSet::Restart()
{
  this->IsGathered = false;
  this->Margin = FirstMargin * this->Surface.Radius();
  this->Most = FewTriangles;
}

double BallSet::HeightOver(const WorkingSet& set, double radius) const
{
  return 1024.0 * UnitRoundoff *
    (glm::length(set.Frame().Origin()) + this->Surface.Radius() + radius);
}

void BallSet::SetFacet(std::int32_t triangle, double fraction, BallFacet& facet) const
{
  const auto& corners = this->Surface.Triangles()[triangle];
  facet.Set(ToVector(this->Surface.PointAt(corners[0], fraction)),
    ToVector(this->Surface.PointAt(corners[1], fraction)),
    ToVector(this->Surface.PointAt(corners[2], fraction)));
}

BallFacet BallSet::FacetAt(std::int32_t triangle, double fraction) const
{
  BallFacet facet;
  this->SetFacet(triangle, fraction, facet);
  return facet;
}

/// Valid until the next call.
BallSet::KnownFacet& BallSet::Known(std::int32_t triangle)
{
  KnownFacet& known = this->KnownFacets[static_cast<std::uint32_t>(triangle) % NumberOfKnownFacets];
  if (known.Triangle != triangle || known.Shape != this->Shape)
  {
    known.Triangle = triangle;
    known.Shape = this->Shape;
    this->SetFacet(triangle, this->Fraction, known.Facet);
    known.IsSeparated = false;
  }
  return known;
}

/// With its plane as seen from x. Valid until the next call.
const BallSet::KnownFacet& BallSet::SeparatedFrom(std::int32_t triangle, const Vector& x)
{
  KnownFacet& known = this->Known(triangle);
  if (!known.IsSeparatedFrom(x))
  {
    known.SeparateFrom(x, this->IsOneSided(triangle));
  }
  return known;
}

/// Up to which part of a motion no facet within reach can be missing; negative: nowhere.
double BallSet::KnownPart(const Vector& from, const Vector& way, double reach) const
{
  const double inner = this->Radius - reach;
  const Vector x = from - this->Centre;
  const double c = SquaredLength(x) - inner * inner;
  if (!this->IsGathered || inner < 0.0 || c > 0.0)
  {
    return -1.0;
  }
  if (SquaredLength(x + way) <= inner * inner)
  {
    return 1.0;
  }
  const double a = SquaredLength(way);
  const double b = glm::dot(x, way);
  return std::clamp((-b + std::sqrt(std::max(b * b - a * c, 0.0))) / a, 0.0, 1.0) * Shrink;
}

/// Fills the list with all that meets a ball. False where the budget has ended; `isWhole`: whether
/// all fit.
bool BallSet::FindAround(const Vector& centre, double radius, WorkBudget& budget, bool& isWhole)
{
  // The engine's coordinates are for the surface's own size. Of a ball about a place outside of
  // that it is asked for what the ball has in common with the sphere that the surface lies in,
  // which is in a ball about the circle where they meet.
  Vector middle = centre;
  double size = radius;
  const double all = 1.001 * this->Surface.Radius();
  const double far = glm::length(centre);
  if (far > 1.5 * this->Surface.Radius())
  {
    const double along = 0.5 * ((far - radius) * (1.0 + radius / far) + all * (all / far));
    middle = (std::clamp(along, 0.0, all) / far) * centre;
    size =
      std::sqrt(std::max(all * all - SquaredLength(middle), 0.0)) + (all - this->Surface.Radius());
  }
  TriangleList found{ this->Triangles.data(),
    std::min(this->Most, static_cast<std::int32_t>(this->Triangles.size())) };
  this->Surface.Engine().FindInBall(ToVec3(middle), size, found);
  budget.Triangles -= found.Count;
  this->Count = found.Count;
  isWhole = !found.Overflow;
  return budget.Triangles > 0;
}

/// Gathers the facets within reach of the centre and of the way `wanted` around it, or around a
/// place that is `ahead` of it, less than 1, by that way; of a shorter one, but a quarter of
/// `length`, if they are many. False where the budget ends, or not even those within reach fit.
bool BallSet::Gather(const WorkingSet& set, double reach, double length, double wanted,
  const Vector& ahead, WorkBudget& budget)
{
  this->IsGathered = false;
  const Vector& x = set.LocalPosition();
  const double least = 0x1p-20 * reach;
  for (;;)
  {
    bool isWhole = false;
    if (!this->FindAround(x + wanted * ahead, reach + wanted, budget, isWhole))
    {
      return false;
    }
    if (isWhole)
    {
      break;
    }
    if (wanted > 0.25 * length && wanted > 1e-3 * reach)
    {
      wanted *= 0.5;
      this->Margin = wanted;
    }
    else if (this->Most < LargestNumberOfTriangles)
    {
      this->Most *= 4;
    }
    else if (wanted > least)
    {
      wanted *= 0.5;
    }
    else
    {
      return false;
    }
  }
  this->Centre = x + wanted * ahead;
  this->Radius = (reach + wanted) * Shrink;
  this->Load(set);
  this->IsGathered = true;
  const double best =
    std::sqrt(FacetsOfMargin * wanted * (2.0 * reach + wanted) / (this->Count + 1.0));
  this->Margin = std::clamp(
    std::clamp(best, 0.5 * wanted, 2.0 * wanted), least, std::max(least, this->Surface.Radius()));
  if (this->Count < this->Most / 8)
  {
    this->Most = std::max(FewTriangles, this->Most / 2);
  }
  return true;
}

/// Separates the facets in the list from the ball's centre, as they are now.
void BallSet::Load(const WorkingSet& set)
{
  if (this->Fraction != set.Fraction())
  {
    this->Fraction = set.Fraction();
    ++this->Shape;
  }
  this->Last = set.LocalPosition();
  this->Planes.Restart(this->Last, this->Radius);
  if (this->Fraction >= 1.0)
  {
    const Vec3* const points = this->Surface.Points().data();
    this->AddPlanes([points](std::int32_t point) -> const Vec3& { return points[point]; });
    return;
  }
  this->AddPlanes(
    [this](std::int32_t point) { return this->Surface.PointAt(point, this->Fraction); });
}

template <class PointOf>
void BallSet::AddPlanes(const PointOf& pointOf)
{
  PrefetchCorners(this->Surface, this->Triangles.data(), this->Count);
  // Two groups at a time, as what has just been written in pieces is waited for where it is read as
  // a whole.
  constexpr std::int32_t width = SeparatingPlanes::Width;
  SeparatingPlanes::Corners corners[2]{};
  for (std::int32_t first = 0; first < this->Count; first += 2 * width)
  {
    const std::int32_t rest = this->Count - first;
    const std::int32_t counts[2] = { std::min(rest, width), std::clamp(rest - width, 0, width) };
    const std::int32_t* triangle = &this->Triangles[first];
    for (int group = 0; group < 2; ++group)
    {
      for (std::int32_t lane = 0; lane < counts[group]; ++lane)
      {
        const auto& [a, b, c] = this->Surface.Triangles()[*triangle++];
        corners[group].Set(lane, pointOf(a), pointOf(b), pointOf(c));
      }
    }
    for (int group = 0; group < 2 && counts[group] > 0; ++group)
    {
      this->Planes.Add(corners[group], counts[group]);
    }
  }
}

/// Has the plane of a facet from where the ball's centre is serve the next motions.
void BallSet::Remember(std::int32_t i, const KnownFacet& known)
{
  const Separation& plane = known.Plane;
  if (plane.Edge < 0 && plane.Height < 0.0 && plane.Distance < 0.0)
  {
    // Behind what has only a front it is clear of that by the back's plane.
    const Separation back = known.Facet.Separate(false, known.From);
    this->Planes.Set(i, back.Normal, back.Distance);
    return;
  }
  this->Planes.Set(i, plane.Normal, plane.Distance);
}

/// The ball's centre has come here, on whatever way.
void BallSet::Follow(const WorkingSet& set)
{
  const Vector& x = set.LocalPosition();
  if (this->Fraction != set.Fraction() || this->Planes.Travelled() > FarthestTravelled)
  {
    this->Load(set);
    return;
  }
  if (x != this->Last)
  {
    this->Planes.Travel(x, glm::length(x - this->Last));
    this->Last = x;
  }
}

bool BallSet::FindFirstHit(const WorkingSet& set, const Vector& goal, double radius, bool inParts,
  WorkBudget& budget, FacetHit& hit)
{
  const Vector to = set.Frame().PointToLocal(goal);
  this->IsThrough = false;
  if (set.IsSweeping())
  {
    return this->FindSwept(set, to, radius, budget, hit);
  }
  Motion motion;
  motion.From = set.LocalPosition();
  motion.Way = to - motion.From;
  motion.Length = glm::length(motion.Way);
  motion.Radius = radius;
  motion.Height = this->HeightOver(set, radius);
  motion.Reach = radius + MeetingHeight * motion.Height;

  // From outside the sphere that nothing reaches out of, the first that can be met is there.
  const double outer = this->Surface.Radius() + motion.Reach;
  const double far = glm::length(motion.From);
  if (far > outer)
  {
    const double towards = -glm::dot(motion.From, motion.Way);
    const double nearest = towards > 0.0 ? towards / SquaredLength(motion.Way) : 0.0;
    const double reached = outer + WayError * (far + motion.Length);
    // From far out it is known badly where that is: the ball goes nearer, and looks again.
    const double enter = nearest - reached / motion.Length;
    if (towards <= 0.0 || enter > 1.0 || glm::length(motion.From + nearest * motion.Way) > reached)
    {
      return true;
    }
    if (enter * motion.Length > 0.5 * this->Surface.Radius())
    {
      hit.Fraction = enter * Shrink;
      hit.IsWaypoint = true;
      return true;
    }
  }
  const double longest = LongestCast * (this->Surface.Radius() + radius);
  const double share = motion.Length > longest ? longest / motion.Length : 1.0;
  motion.Way *= share;
  motion.Length *= share;
  motion.Reach += WayError * motion.Length;
  motion.IsPart = share < 1.0;
  motion.Known = this->KnownPart(motion.From, motion.Way, motion.Reach);
  // What is known is looked at first: over rough ground the ball is stopped there as a rule.
  if (motion.Known >= 1.0 || motion.Known * motion.Length >= LeastLookedAt * this->Margin)
  {
    this->Cast(set, motion, hit);
  }
  if (motion.Known < 1.0 && !(hit.Fraction + motion.Slack() < motion.Known))
  {
    const double most = inParts ? this->Margin : LongestGathered * this->Margin;
    const double wanted = std::clamp(1.5 * motion.Length, this->Margin, most);
    const Vector ahead =
      wanted < motion.Length ? (Ahead / motion.Length) * motion.Way : Vector(0.0);
    if (!this->Gather(set, motion.Reach, motion.Length, wanted, ahead, budget))
    {
      return false;
    }
    motion.Known = this->KnownPart(motion.From, motion.Way, motion.Reach);
    this->Cast(set, motion, hit);
  }
  hit.Fraction *= share;
  return true;
}

/// The first facet that is met as far as is known.
void BallSet::Cast(const WorkingSet& set, const Motion& motion, FacetHit& hit)
{
  this->Follow(set);
  this->IsThrough = false;
  hit = FacetHit();
  if (motion.Known < 1.0 || motion.IsPart)
  {
    hit.Fraction = motion.Known;
    hit.IsWaypoint = true;
  }
  const double slack = motion.Slack();
  this->Planes.VisitNear(
    motion.Way, motion.Length, motion.Reach, [&] { return hit.Fraction + slack; },
    [&](std::int32_t i) { this->Meet(i, set, motion, hit); });
}

/// Whether a facet is touched from outside at what is nearest to x.
bool BallSet::IsTouched(std::int32_t i, const Separation& plane, const Vector& x, double height)
{
  const std::int32_t triangle = this->Triangles[i];
  if (this->Known(triangle).Facet.Normal == Vector(0.0))
  {
    return false; // one without area is never touched
  }
  if (!this->IsOneSided(triangle))
  {
    return true;
  }
  if (plane.Corner >= 0)
  {
    return this->IsCornerTouched(triangle, plane, x, height);
  }
  return plane.Edge >= 0 ? this->IsEdgeTouched(triangle, plane, x, height)
                         : plane.Height >= -NoSide * height;
}

bool BallSet::IsEdgeTouched(
  std::int32_t triangle, const Separation& plane, const Vector& x, double height)
{
  const std::int32_t other = this->Surface.AdjacentTriangles()[triangle][plane.Edge];
  const bool isFront = plane.Height >= -NoSide * height;
  if (other < 0 || !this->IsOneSided(other))
  {
    return isFront;
  }
  const Triangle& corners = this->Surface.Triangles()[triangle];
  const Triangle& others = this->Surface.Triangles()[other];
  const auto place = std::find(others.begin(), others.end(), corners[plane.Edge]) - others.begin();
  const Vector normal = this->Known(triangle).Facet.Normal;
  const double doubt = this->Known(triangle).Facet.Doubt;
  const BallFacet& facet = this->Known(other).Facet;
  if (facet.Normal == Vector(0.0) || place == 3 ||
    others[(place + 2) % 3] != corners[(plane.Edge + 1) % 3])
  {
    return isFront; // they do not go on from each other
  }
  return glm::dot(normal + facet.Normal, plane.Normal) > -(Agreement + doubt + facet.Doubt) &&
    facet.Separate(false, x).Distance >= plane.Distance - MeetingHeight * height;
}

/// Goes from triangle to triangle around the corner.
bool BallSet::IsCornerTouched(
  std::int32_t triangle, const Separation& plane, const Vector& x, double height)
{
  const bool isFront = plane.Height >= -NoSide * height;
  const double nearest = plane.Distance - MeetingHeight * height;
  const std::int32_t corner = this->Surface.Triangles()[triangle][plane.Corner];
  Vector sum(0.0);
  double doubt = Agreement;
  std::int32_t here = triangle;
  int edge = plane.Corner; // to cross next: from this corner of the triangle on
  for (std::int32_t count = 0; count < LargestFan; ++count)
  {
    const Triangle& corners = this->Surface.Triangles()[here];
    const auto place =
      static_cast<int>(std::find(corners.begin(), corners.end(), corner) - corners.begin());
    const std::int32_t next = this->Surface.AdjacentTriangles()[here][edge];
    if (!this->IsOneSided(here) || next < 0)
    {
      return isFront; // nothing has an inside there
    }
    const BallFacet& facet = this->Known(here).Facet;
    if (facet.Normal != Vector(0.0))
    {
      if (here != triangle && facet.Separate(false, x).Distance < nearest)
      {
        return false; // that one may be touched, if any
      }
      const Vector* const places[3] = { &facet.A, &facet.B, &facet.C };
      const Vector u = *places[(place + 1) % 3] - *places[place];
      const Vector v = *places[(place + 2) % 3] - *places[place];
      const double angle = std::atan2(glm::dot(glm::cross(u, v), facet.Normal), glm::dot(u, v));
      sum += angle * facet.Normal;
      doubt += angle * facet.Doubt;
    }
    if (next == triangle)
    {
      return glm::dot(sum, plane.Normal) > -doubt;
    }
    // The next triangle is left by its other edge at the corner.
    const std::int32_t other = corners[edge == place ? (edge + 1) % 3 : edge];
    const Triangle& following = this->Surface.Triangles()[next];
    const auto at =
      static_cast<int>(std::find(following.begin(), following.end(), corner) - following.begin());
    if (at == 3)
    {
      return isFront;
    }
    edge = following[(at + 1) % 3] == other ? (at + 2) % 3 : at;
    here = next;
  }
  return isFront;
}

/// Cuts a motion behind where it passes a facet's plane from the back within the ball.
void BallSet::PassFromBehind(
  const BallFacet& facet, const Separation& start, const Motion& motion, FacetHit& hit)
{
  const double rise = glm::dot(facet.Normal, motion.Way);
  const double back = -NoSide * motion.Height;
  if (!(start.Height < back) || !(start.Height + rise >= back))
  {
    return;
  }
  const double t = std::min(-start.Height / rise, 1.0);
  if (t > hit.Fraction || t > motion.Known ||
    facet.Separate(true, motion.From + t * motion.Way).Distance >=
      motion.Radius - MeetingHeight * motion.Height)
  {
    return;
  }
  this->IsThrough = true;
  const double end = t + 0.5 * motion.Height / rise;
  if (end < std::min(hit.Fraction, motion.Known))
  {
    hit = FacetHit();
    hit.Fraction = end;
    hit.IsWaypoint = true;
  }
}

/// Where facets that share an edge or a corner contradict each other, as in a solid that is inside
/// out, the ball may be held by none of them there. Its centre crosses no front nevertheless: it
/// goes on as a point does. `met`: after which share of the motion the ball meets the facet. One
/// nearly within the facet's plane is close to that from long before, and goes on up to there.
void BallSet::StopInFront(std::int32_t triangle, const WorkingSet& set, const KnownFacet& known,
  const Motion& motion, double met, FacetHit& hit)
{
  const double height = known.Plane.Height;
  const double rise = glm::dot(known.Facet.Normal, motion.Way);
  if (height < -NoSide * motion.Height || height + rise >= MeetingHeight * motion.Height ||
    !(rise < 0.0))
  {
    return;
  }
  const double crossing = std::clamp(-height / rise, 0.0, 1.0);
  if (known.Facet.Separate(false, motion.From + crossing * motion.Way).Distance > motion.Height)
  {
    return;
  }
  FacetHit other;
  other.Fraction =
    std::max((2.0 * MeetingHeight * motion.Height - height) / rise, std::min(met, crossing));
  other.Slack = motion.Slack();
  other.Depth = -(height + rise);
  Separation front; // as if the centre touched
  front.Normal = known.Facet.Normal;
  front.Distance = motion.Radius;
  other.Plane = this->PlaneOf(
    triangle, set, front, motion.From + other.Fraction * motion.Way, motion.Radius, 0.0);
  this->IsThrough = true;
  hit.Take(other);
}

ActivePlane BallSet::PlaneOf(std::int32_t triangle, const WorkingSet& set, const Separation& plane,
  const Vector& x, double radius, double height) const
{
  ActivePlane active;
  active.Facet = { this->Index, triangle };
  active.Normal = set.Frame().VectorToScene(plane.Normal);
  active.Anchor = set.Frame().PointToScene(x - (plane.Distance - radius) * plane.Normal);
  active.Clearance = height;
  return active;
}

/// Whether a motion touches a facet before the hit, which it then is.
void BallSet::Meet(std::int32_t i, const WorkingSet& set, const Motion& motion, FacetHit& hit)
{
  const std::int32_t triangle = this->Triangles[i];
  const bool isOneSided = this->IsOneSided(triangle);
  KnownFacet& known = this->Known(triangle);
  const BallFacet& facet = known.Facet;
  if (!known.IsSeparatedFrom(motion.From))
  {
    known.SeparateFrom(motion.From, isOneSided);
    this->Remember(i, known);
  }
  // A motion is in front of a plane if both its ends are. What it lacks at the start it has been
  // fitted with, or it has to leave.
  const double enough = -0.5 * MeetingHeight * motion.Height;
  double over = known.Plane.Distance - motion.Reach;
  double approach = -glm::dot(known.Plane.Normal, motion.Way);
  if (isOneSided && known.Plane.Height < 0.0)
  {
    this->PassFromBehind(facet, known.Plane, motion, hit);
  }
  const double slack = motion.Slack();
  const bool isLate = approach > 0.0 && over > approach * (hit.Fraction + slack);
  if (over - approach >= enough || isLate)
  {
    return;
  }
  // So is one that comes along what is round, of the plane where it is nearest to that. That of an
  // edge that is passed says so at once, where Newton's method takes a dozen planes.
  const double met = MetHeight * motion.Height;
  const double end = std::min(hit.Fraction + slack, 1.0);
  const double nearest = std::min(NearestOnWay(facet, known.Plane, motion.Way, approach), end);
  const double clear = nearest < 1.0 ? met : enough;
  const Separation last = facet.Separate(isOneSided, motion.From + nearest * motion.Way);
  const double towards = -glm::dot(last.Normal, motion.Way);
  if (last.Distance + nearest * towards - motion.Reach >= clear &&
    last.Distance - (end - nearest) * towards - motion.Reach >= clear)
  {
    return;
  }
  // The facet's own plane separates as well, from where it is in front of that.
  const double above = facet.LeastHeight(motion.From) - motion.Reach;
  const double fall = -glm::dot(facet.Normal, motion.Way);
  if (over > met && fall > 0.0 && above * approach > over * fall)
  {
    over = above;
    approach = fall;
  }
  Separation plane = known.Plane;
  double t = 0.0;
  for (int k = 0; k < LargestNumberOfPlanes && over > met; ++k)
  {
    t += over / approach;
    if (t > hit.Fraction + slack)
    {
      return;
    }
    facet.Separate(isOneSided, motion.From + t * motion.Way, plane);
    over = plane.Distance - motion.Reach;
    approach = -glm::dot(plane.Normal, motion.Way);
    if (over - approach * (1.0 - t) >= enough)
    {
      return; // the rest of the motion is in front of this plane
    }
  }
  const Vector x = motion.From + t * motion.Way;
  if (!this->IsTouched(i, plane, x, motion.Height))
  {
    this->StopInFront(triangle, set, known, motion, t, hit);
    return;
  }
  FacetHit other;
  other.Fraction = t;
  other.Slack = slack;
  other.Depth = -(plane.Distance - motion.Reach) - glm::dot(plane.Normal, motion.Way) * (1.0 - t);
  other.Plane = this->PlaneOf(triangle, set, plane, x, motion.Radius, motion.Height);
  hit.Take(other);
}

/// A motion together with the facets. At its end all of them are held by planes again. Between,
/// that a ball of half the radius stays clear: distances change no faster than corners move.
bool BallSet::FindSwept(
  const WorkingSet& set, const Vector& to, double radius, WorkBudget& budget, FacetHit& hit)
{
  const Vector from = set.LocalPosition();
  const Vector way = to - from;
  const double height = this->HeightOver(set, radius);
  const double reach = radius + height + glm::length(way);
  if (this->KnownPart(from, Vector(0.0), reach) < 1.0 &&
    (!this->Gather(set, reach, 0.0, this->Margin, Vector(0.0), budget) ||
      this->KnownPart(from, Vector(0.0), reach) < 1.0))
  {
    return false;
  }
  this->Follow(set);
  for (std::int32_t i = 0; i < this->Count; ++i)
  {
    const std::int32_t triangle = this->Triangles[i];
    const BallFacet before = this->Known(triangle).Facet;
    const BallFacet after = this->FacetAt(triangle, set.NextFraction());
    if (before.Normal == Vector(0.0) || after.Normal == Vector(0.0))
    {
      continue;
    }
    const bool isOneSided = this->IsOneSided(triangle);
    const Separation first = this->SeparatedFrom(triangle, from).Plane;
    const Separation last = after.Separate(isOneSided, to);
    if (first.Distance < radius + MeetingHeight * height &&
      !this->IsTouched(i, first, from, height))
    {
      if (before.Normal != Vector(0.0))
      {
        hit.Fraction = 0.0;
        hit.IsWaypoint = true; // the ball is within what has only a front
      }
      continue;
    }
    const double moved = std::max({ glm::length(after.A - before.A - way),
      glm::length(after.B - before.B - way), glm::length(after.C - before.C - way) });
    const bool isPassed = first.Distance + last.Distance - moved < LeastWhileSwept * radius;
    if (isPassed && moved >= radius)
    {
      return false; // in parts of the tick
    }
    if (last.Distance >= radius + MeetingHeight * height && !isPassed)
    {
      continue;
    }
    FacetHit other;
    other.Fraction = 0.0;
    other.Depth = radius - last.Distance;
    other.Plane.Facet = { this->Index, triangle };
    other.Plane.Normal = set.Frame().VectorToScene(last.Normal);
    other.Plane.Anchor = set.Frame().PointToScene(to - (last.Distance - radius) * last.Normal);
    other.Plane.Clearance = height;
    hit.Take(other);
  }
  return true;
}

/// Sees to it that all facets within reach of the centre are in the list.
bool BallSet::Require(const WorkingSet& set, double reach, WorkBudget& budget)
{
  const Vector& x = set.LocalPosition();
  if (this->KnownPart(x, Vector(0.0), reach) < 1.0 &&
    !this->Gather(set, reach, 0.0, this->Margin, Vector(0.0), budget))
  {
    return false;
  }
  this->Follow(set);
  return true;
}

double BallSet::LargestFit(const WorkingSet& set, double radius, WorkBudget& budget)
{
  const Vector& x = set.LocalPosition();
  const double height = this->HeightOver(set, radius);
  const double smallest = NoSide * height;
  if (glm::length(x) > this->Surface.Radius() + radius)
  {
    return radius;
  }
  double fit = radius;
  while (!this->Require(set, fit, budget))
  {
    fit *= 0.5;
    if (budget.Triangles <= 0 || fit < smallest)
    {
      return smallest;
    }
  }
  this->Planes.VisitWithin([&fit] { return fit; },
    [&](std::int32_t i)
    {
      const KnownFacet& known = this->SeparatedFrom(this->Triangles[i], x);
      const Separation plane = known.Plane;
      this->Remember(i, known);
      if (plane.Distance < fit && this->IsTouched(i, plane, x, height))
      {
        fit = plane.Distance;
      }
    });
  // A height less, so that it has room to move between what it touches.
  return fit < radius ? std::max(fit - height, 0.5 * std::max(fit, smallest)) : radius;
}

void BallSet::Renew(const WorkingSet& set, double radius, ActivePlane& plane)
{
  const Vector& x = set.LocalPosition();
  const std::int32_t triangle = plane.Facet.Triangle;
  const Separation now = set.NextFraction() == this->Fraction
    ? this->SeparatedFrom(triangle, x).Plane
    : this->FacetAt(triangle, set.NextFraction()).Separate(this->IsOneSided(triangle), x);
  plane.Normal = set.Frame().VectorToScene(now.Normal);
  plane.Anchor = set.Frame().PointToScene(x - (now.Distance - radius) * now.Normal);
  plane.Clearance = this->HeightOver(set, radius);
}

bool BallSet::FindLast(
  const WorkingSet& set, const Vector& goal, double radius, const FacetId& facet, ActivePlane& last)
{
  if (set.IsSweeping() || this->Fraction != set.Fraction())
  {
    return false;
  }
  const Vector x = set.Frame().PointToLocal(goal);
  const double height = this->HeightOver(set, radius);
  const BallFacet& known = this->Known(facet.Triangle).Facet;
  if (known.IsOver(x))
  {
    return false;
  }
  const Separation plane = known.Separate(this->IsOneSided(facet.Triangle), x);
  if (plane.Edge < 0 || plane.Distance < NearestTurn * radius || plane.Distance >= radius + height)
  {
    return false;
  }
  last = this->PlaneOf(facet.Triangle, set, plane, x, radius, height);
  return true;
}

Vector BallSet::PointAfterSweep(
  const WorkingSet& set, double radius, const ActivePlane& plane) const
{
  const Vector& x = set.LocalPosition();
  if (!set.IsSweeping())
  {
    return x;
  }
  const BallFacet before = this->FacetAt(plane.Facet.Triangle, set.Fraction());
  const BallFacet after = this->FacetAt(plane.Facet.Triangle, set.NextFraction());
  const Vector touched = x - radius * set.Frame().VectorToLocal(plane.Normal);
  const Vector areas{ glm::dot(before.Normal, glm::cross(before.C - before.B, touched - before.B)),
    glm::dot(before.Normal, glm::cross(before.A - before.C, touched - before.C)),
    glm::dot(before.Normal, glm::cross(before.B - before.A, touched - before.A)) };
  const Vector weights = glm::max(areas, Vector(0.0));
  const double sum = weights.x + weights.y + weights.z;
  if (!(sum > 0.0))
  {
    return x;
  }
  return x +
    (weights.x * (after.A - before.A) + weights.y * (after.B - before.B) +
      weights.z * (after.C - before.C)) /
    sum;
}
}
