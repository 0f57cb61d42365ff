#include "BallTrial.h"

#include "AnalyticSurfaces.h"
#include "haptics/Math/VectorMath.h"
#include "haptics/Surface/SurfaceSide.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace haptics::testing
{
namespace
{
using Real = long double;
using Triple = std::array<Real, 3>;

/// What a ball may be short of its radius, as a share of it.
constexpr double Short = 1e-6;
/// Smaller balls, of who starts on a triangle, are rounding's: only what they cross is judged.
constexpr double SmallestJudged = 1e-12;
/// So many ticks at rest: one that overlaps grows for 128 of them, and a corner is approached by a
/// share of what is left in each.
constexpr int TicksOfRest = 200;
/// A way that leads less steeply to the HIP than this leads nowhere.
constexpr double Steep = 2e-3;

Triple Minus(const Triple& a, const Triple& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
Triple Plus(const Triple& a, Real s, const Triple& b)
{
  return { a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2] };
}
Real Product(const Triple& a, const Triple& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Triple Across(const Triple& a, const Triple& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
Triple Long(const Vec3& v)
{
  return { v[0], v[1], v[2] };
}
Real Clamped(Real x)
{
  return std::clamp(x, Real(0), Real(1));
}

/// The point of a triangle that is nearest to x.
Triple NearestTo(const Triple& x, const Triple (&t)[3])
{
  const Triple normal = Across(Minus(t[1], t[0]), Minus(t[2], t[0]));
  const Real squared = Product(normal, normal);
  bool isOver = squared > 0;
  Triple best = t[0];
  Real least = HUGE_VALL;
  for (int k = 0; k < 3; ++k)
  {
    const Triple& a = t[k];
    const Triple edge = Minus(t[(k + 1) % 3], a);
    isOver = isOver && Product(Across(normal, edge), Minus(x, a)) >= 0;
    const Real length = Product(edge, edge);
    const Real s = length > 0 ? Clamped(Product(Minus(x, a), edge) / length) : 0;
    const Triple point = Plus(a, s, edge);
    const Triple away = Minus(x, point);
    if (Product(away, away) < least)
    {
      least = Product(away, away);
      best = point;
    }
  }
  return isOver ? Plus(x, -Product(normal, Minus(x, t[0])) / squared, normal) : best;
}

Real SquaredDistance(const Triple& x, const Triple (&t)[3])
{
  const Triple away = Minus(x, NearestTo(x, t));
  return Product(away, away);
}

/// Of two segments, by the least of all places where one of them ends or both are free.
Real SquaredDistance(const Triple& p, const Triple& q, const Triple& a, const Triple& b)
{
  const Triple u = Minus(q, p);
  const Triple v = Minus(b, a);
  const Triple w = Minus(p, a);
  const Real uu = Product(u, u);
  const Real uv = Product(u, v);
  const Real vv = Product(v, v);
  const auto at = [&](Real s, Real t)
  {
    const Triple d = Plus(Plus(w, s, u), -t, v);
    return Product(d, d);
  };
  const auto onSecond = [&](Real s)
  { return at(s, vv > 0 ? Clamped((Product(w, v) + s * uv) / vv) : 0); };
  const auto onFirst = [&](Real t)
  { return at(uu > 0 ? Clamped((t * uv - Product(w, u)) / uu) : 0, t); };
  Real least = std::min({ onSecond(0), onSecond(1), onFirst(0), onFirst(1) });
  const Real determinant = uu * vv - uv * uv;
  if (determinant > 0)
  {
    const Real s = (uv * Product(w, v) - vv * Product(w, u)) / determinant;
    if (s > 0 && s < 1)
    {
      least = std::min(least, onSecond(s));
    }
  }
  return least;
}
}

BallCount& BallCount::operator+=(const BallCount& other)
{
  this->Ticks += other.Ticks;
  this->Contacts += other.Contacts;
  this->Pieces += other.Pieces;
  this->Overlaps += other.Overlaps;
  this->Crossings += other.Crossings;
  this->Away += other.Away;
  this->Rests += other.Rests;
  this->Phantoms += other.Phantoms;
  this->Stuck += other.Stuck;
  this->Shrunk += other.Shrunk;
  this->Overloads += other.Overloads;
  return *this;
}

bool BallCount::IsGood() const
{
  return this->Overlaps == 0 && this->Crossings == 0 && this->Away == 0 && this->Phantoms == 0 &&
    this->Stuck * 10000 <= std::max(this->Rests, 10000L);
}

BallTrial::BallTrial(std::vector<TouchedSurface> surfaces, double radius, int restEvery)
  : Ball(surfaces, Tip::Ball)
  , Radius(radius)
  , RestEvery(restEvery)
{
  this->Ball.SetTipRadius(radius);
  for (const TouchedSurface& touched : surfaces)
  {
    const TriangleSurface& surface = *touched.Surface;
    double volume = 0.0;
    for (const auto& [a, b, c] : surface.Triangles())
    {
      volume += Dot(surface.Points()[a], Cross(surface.Points()[b], surface.Points()[c]));
    }
    this->Parts.push_back({ touched.Surface, std::make_shared<Judge>(surface),
      surface.Origin() - surfaces.front().Surface->Origin(), volume < 0.0 });
    this->Size = std::max(this->Size, surface.Radius());
  }
}

void BallTrial::Report(
  long& counter, const char* what, const Vec3& from, const Vec3& to, const Vec3& hip)
{
  ++counter;
  if (this->OnFault)
  {
    this->OnFault(what, from, to, hip);
  }
}

void BallTrial::Place(const Vec3& position)
{
  const Vec3 world = this->Ball.WayOrigin() + position;
  this->Ball.Place(world);
  this->Ball.Update(world);
  int corners = 0;
  const Vec3* const way = this->Ball.Way(corners);
  this->Now = way[corners - 1];
}

/// Whether a place is within what is closed and has only a front: there nothing of that counts.
bool BallTrial::IsInside(const Part& part, const Vec3& x) const
{
  if (part.Snapshot->Enclosing().OneSided != Encloser::Front)
  {
    return false;
  }
  this->Scratch.resize(1 << 15);
  WorkBudget budget{ 1 << 20 };
  SurfaceSide side(*part.Snapshot, 1.0,
    TriangleList{ this->Scratch.data(), static_cast<std::int32_t>(this->Scratch.size()) }, budget);
  Enclosed enclosed;
  // Inside out, what is around it all is solid.
  return !side.CountEnclosing(ToVector(x), enclosed) ||
    (part.IsInsideOut ? enclosed.Front == 0 : enclosed.Front > 0);
}

/// The least distance of a segment from what a ball keeps out of; HUGE_VAL beyond `reach`.
double BallTrial::Distance(const Vec3& from, const Vec3& to, double reach) const
{
  Real least = HUGE_VALL;
  for (const Part& part : this->Parts)
  {
    const Vec3 start = from - part.Offset;
    const Vec3 end = to - part.Offset;
    const bool isInside = this->IsInside(part, start);
    for (const std::int32_t i : part.Surface->FindNear(start, end, reach))
    {
      const Triangle& corners = part.Surface->Triangles()[i];
      const Triple t[3] = { Long(part.Surface->Points()[corners[0]]),
        Long(part.Surface->Points()[corners[1]]), Long(part.Surface->Points()[corners[2]]) };
      const Triple p = Long(start);
      const Triple q = Long(end);
      if (!part.Surface->HasBack(i) && part.Snapshot->EncloserOf(i) != Encloser::Front)
      {
        continue; // what encloses nothing has no outside: only what crosses it is judged
      }
      if (!part.Surface->HasBack(i) && isInside)
      {
        continue;
      }
      Real squared = std::min(SquaredDistance(p, t), SquaredDistance(q, t));
      for (int k = 0; k < 3; ++k)
      {
        squared = std::min(squared, SquaredDistance(p, q, t[k], t[(k + 1) % 3]));
      }
      least = std::min(least, squared);
    }
  }
  return static_cast<double>(std::sqrt(least));
}

/// Unit directions to x from all that is within `reach` and counts.
std::vector<Vec3> BallTrial::Normals(const Vec3& x, double reach) const
{
  std::vector<Vec3> normals;
  for (const Part& part : this->Parts)
  {
    const Vec3 at = x - part.Offset;
    const bool isInside = this->IsInside(part, at);
    for (const std::int32_t i : part.Surface->FindNear(at, at, reach))
    {
      const Triangle& corners = part.Surface->Triangles()[i];
      const Triple t[3] = { Long(part.Surface->Points()[corners[0]]),
        Long(part.Surface->Points()[corners[1]]), Long(part.Surface->Points()[corners[2]]) };
      const Triple facet = Across(Minus(t[1], t[0]), Minus(t[2], t[0]));
      const bool isBehind = Product(facet, Minus(Long(at), t[0])) < 0;
      const Triple away = Minus(Long(at), NearestTo(Long(at), t));
      const Real distance = std::sqrt(Product(away, away));
      const bool counts = part.Surface->HasBack(i) ||
        (part.Snapshot->EncloserOf(i) == Encloser::Front ? !isInside : !isBehind);
      if (distance > 0 && distance <= reach && counts)
      {
        normals.push_back({ static_cast<double>(away[0] / distance),
          static_cast<double>(away[1] / distance), static_cast<double>(away[2] / distance) });
      }
    }
  }
  return normals;
}

void BallTrial::JudgeWay(const Vec3* way, int corners, double radius, const Vec3& hip)
{
  for (int i = 0; i + 1 < corners; ++i)
  {
    ++this->Counted.Pieces;
    // One that has come through a back on the way may go on as near as that left it.
    const double keeps =
      i == 0 ? radius : std::min(radius, this->Distance(way[i], way[i], radius) * (1.0 - Short));
    if (keeps > SmallestJudged * this->Size && this->Distance(way[i], way[i + 1], keeps) < keeps)
    {
      this->Report(this->Counted.Overlaps, "overlap", way[i], way[i + 1], hip);
    }
    // Who starts or ends exactly on a triangle has no side.
    const Vec3 start = way[i] + 1e-9 * (way[i + 1] - way[i]);
    const Vec3 end = way[i + 1] - 1e-9 * (way[i + 1] - way[i]);
    for (const Part& part : this->Parts)
    {
      if (part.Surface->Crosses(start - part.Offset, end - part.Offset))
      {
        this->Report(this->Counted.Crossings, "crossing", way[i], way[i + 1], hip);
      }
    }
  }
}

void BallTrial::Lead(const Vec3& hip)
{
  const double before = this->Ball.BallRadius();
  const Vec3 from = this->Now;
  const Vec3 world = this->Ball.WayOrigin() + hip;
  const Vec3 goal = world - this->Ball.WayOrigin();
  this->Ball.Update(world);
  ++this->Counted.Ticks;
  const double radius = std::min(before, this->Ball.BallRadius()) * (1.0 - Short);
  this->Counted.Shrunk += this->Ball.BallRadius() < this->Radius;
  int corners = 0;
  const Vec3* const way = this->Ball.Way(corners);
  this->JudgeWay(way, corners, radius, goal);
  this->Now = way[corners - 1];
  const double grown = Length(this->Ball.Current().SurfaceDisplacement);
  if (Length(this->Now - goal) > Length(from - goal) * (1.0 + 1e-9) + grown + 1e-12 * this->Size)
  {
    this->Report(this->Counted.Away, "away", from, this->Now, goal);
  }
}

void BallTrial::Tick(const Vec3& hip)
{
  this->Lead(hip);
  const UpdateStatus status = this->Ball.Current().Status;
  this->Counted.Overloads += status == UpdateStatus::Overloaded;
  if (status != UpdateStatus::Touching)
  {
    return;
  }
  ++this->Counted.Contacts;
  if (this->RestEvery > 0 && ++this->SinceRest >= this->RestEvery)
  {
    this->SinceRest = 0;
    this->LookAtRest(hip);
  }
}

void BallTrial::LookAtRest(const Vec3& hip)
{
  for (int tick = 0; tick < TicksOfRest; ++tick)
  {
    const Vec3 before = this->Now;
    this->Lead(hip);
    if (this->Now == before)
    {
      break;
    }
  }
  const Vec3 pull = hip - this->Now;
  const double radius = this->Ball.BallRadius();
  if (this->Ball.Current().Status != UpdateStatus::Touching || Length(pull) < 1e-6 * radius ||
    radius <= SmallestJudged * this->Size)
  {
    return;
  }
  for (const Part& part : this->Parts)
  {
    const TriangleSurface& surface = *part.Snapshot;
    bool isOpen = false; // one that encloses nothing, and has only a front
    for (std::size_t i = 0; i < surface.Triangles().size() && !isOpen; ++i)
    {
      const auto triangle = static_cast<std::int32_t>(i);
      isOpen = !surface.TouchesBack(triangle) && surface.EncloserOf(triangle) != Encloser::Front;
    }
    // Of several solids in one nobody has said which one it is in.
    if (isOpen || this->IsInside(part, this->Now - part.Offset))
    {
      return;
    }
  }
  ++this->Counted.Rests;
  const double clear = radius * (1.0 + 1e-9) + 1e-12 * this->Size;
  if (this->Distance(this->Now, hip, clear) >= clear)
  {
    this->Report(this->Counted.Phantoms, "phantom", this->Now, hip, hip);
    return;
  }
  // What is left of the pull where nothing that is touched pushes: Hildreth's method.
  const std::vector<Vec3> normals = this->Normals(this->Now, radius * (1.0 + Short));
  std::vector<double> pushes(normals.size(), 0.0);
  Vec3 free = pull;
  for (int round = 0; round < 1000; ++round)
  {
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      const double more = std::max(-pushes[i], -Dot(normals[i], free));
      pushes[i] += more;
      free = free + more * normals[i];
    }
  }
  if (Length(free) < Steep * Length(pull))
  {
    return;
  }
  const Vec3 to = this->Now + (1e-3 * radius / Length(free)) * free;
  const double enough = radius * (1.0 - 1e-9);
  if (Length(to - hip) < Length(pull) && this->Distance(this->Now, to, enough) >= enough)
  {
    this->Report(this->Counted.Stuck, "stuck", this->Now, to, hip);
  }
}
}
