#include "SurfacePath.h"

#include "AnalyticSurfaces.h"
#include "RandomVectors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace haptics::testing
{
namespace
{
constexpr double OfHand = 20.0; ///< radii in a metre of the hand
constexpr double Encoder = 55e-6 * OfHand;

Vec3 UnitOrUp(const Vec3& v)
{
  const double length = Length(v);
  return length > 0.0 ? (1.0 / length) * v : Vec3{ 0, 0, 1 };
}
}

const char* SurfacePath::NameOf(Kind kind)
{
  static const char* const names[] = { "stroke", "along edges", "through corners", "in planes",
    "on corners", "tremor", "into folds", "jumps", "creep", "to and fro", "from inside", "leap",
    "swing" };
  return names[kind];
}

SurfacePath::SurfacePath(std::vector<Vec3> points, std::vector<Triangle> triangles)
  : Points(std::move(points))
{
  // Scaled, so that neither tiny nor huge surfaces leave float64's range.
  Vec3 low{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vec3 high = -1.0 * low;
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> sides;
  this->CornerNormals.resize(this->Points.size());
  this->EdgesOf.resize(this->Points.size());
  for (const Triangle& t : triangles)
  {
    const Vec3 normal =
      Cross(this->Points[t[1]] - this->Points[t[0]], this->Points[t[2]] - this->Points[t[0]]);
    if (!(Length(normal) > 0.0))
    {
      continue;
    }
    const auto index = static_cast<std::int32_t>(this->Triangles.size());
    this->Triangles.push_back(t);
    this->FacetNormals.push_back(Unit(normal));
    for (int i = 0; i < 3; ++i)
    {
      const Vec3& p = this->Points[t[i]];
      this->CornerNormals[t[i]] = this->CornerNormals[t[i]] + this->FacetNormals.back();
      sides[std::minmax(t[i], t[(i + 1) % 3])].push_back(index);
      for (int k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
  }
  this->Middle = 0.5 * (low + high);
  this->HalfBounds = 0.5 * (high - low);
  this->Radius = Length(this->HalfBounds);
  for (const auto& [ends, facets] : sides)
  {
    Edge edge{ ends.first, ends.second };
    for (const std::int32_t facet : facets)
    {
      edge.Normal = edge.Normal + this->FacetNormals[facet];
    }
    edge.Normal = UnitOrUp(edge.Normal);
    if (facets.size() == 2)
    {
      const Vec3& n = this->FacetNormals[facets[0]];
      Vec3 centre{};
      for (const std::int32_t corner : this->Triangles[facets[1]])
      {
        centre = centre + (1.0 / 3.0) * (this->Points[corner] - this->Points[ends.first]);
      }
      const Vec3& other = this->FacetNormals[facets[1]];
      edge.Bend = std::atan2(Length(Cross(n, other)), Dot(n, other));
      edge.Bend = Dot(n, centre) > 0.0 ? -edge.Bend : edge.Bend;
    }
    for (const std::int32_t end : { edge.From, edge.To })
    {
      if (this->EdgesOf[end].empty())
      {
        this->UsedCorners.push_back(end);
      }
      this->EdgesOf[end].push_back(static_cast<std::int32_t>(this->Edges.size()));
    }
    this->Edges.push_back(edge);
  }
  for (Vec3& normal : this->CornerNormals)
  {
    normal = UnitOrUp(normal);
  }
}

double SurfacePath::Uniform(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(this->Random);
}

double SurfacePath::AnyScale(double low, double high)
{
  return std::exp(this->Uniform(std::log(low), std::log(high)));
}

int SurfacePath::Integer(int low, int high)
{
  return std::uniform_int_distribution<int>(low, high)(this->Random);
}

/// Anywhere on a triangle.
Vec3 SurfacePath::Place(std::int32_t& triangle)
{
  triangle = this->Integer(0, static_cast<int>(this->Triangles.size()) - 1);
  const auto& [a, b, c] = this->Triangles[triangle];
  double s = this->Uniform(0.0, 1.0);
  double t = this->Uniform(0.0, 1.0);
  if (s + t > 1.0)
  {
    s = 1.0 - s;
    t = 1.0 - t;
  }
  const Vec3& p = this->Points[a];
  return p + s * (this->Points[b] - p) + t * (this->Points[c] - p);
}

const SurfacePath::Edge& SurfacePath::AnyEdge()
{
  return this->Edges[this->Integer(0, static_cast<int>(this->Edges.size()) - 1)];
}

const SurfacePath::Edge& SurfacePath::SharpEdge(double sign)
{
  const Edge* sharpest = &this->AnyEdge();
  for (int i = 0; i < 12; ++i)
  {
    const Edge& other = this->AnyEdge();
    sharpest = sign * other.Bend > sign * sharpest->Bend ? &other : sharpest;
  }
  return *sharpest;
}

void SurfacePath::Approach(std::vector<Vec3>& way, const Vec3& to, int ticks)
{
  const Vec3 from = way.back();
  for (int i = 1; i < ticks; ++i)
  {
    way.push_back(from + (static_cast<double>(i) / ticks) * (to - from));
  }
  way.push_back(to);
}

std::vector<Vec3> SurfacePath::Make(Kind kind, unsigned seed)
{
  this->Random.seed(seed * 64u + kind);
  const double r = this->Radius;
  const double sign = this->Integer(0, 3) == 0 ? -1.0 : 1.0; // from the back now and then
  const double lift = r * this->AnyScale(1e-4, 0.3);
  const double depth = r * this->AnyScale(1e-5, 0.2);
  std::vector<Vec3> way;
  std::int32_t triangle = 0;
  switch (kind)
  {
    case Stroke:
    case FromInside:
    {
      const Vec3 foot = this->Place(triangle);
      const Vec3 n = sign * this->FacetNormals[triangle];
      way.push_back(foot + (kind == FromInside ? -depth : lift) * n);
      Vec3 at = kind == FromInside ? foot + lift * n : foot - depth * n;
      this->Approach(way, at, this->Integer(1, 20));
      const double speed = r * this->AnyScale(1e-5, 2e-2);
      Vec3 velocity{};
      for (int i = 0; i < 150; ++i)
      {
        velocity = 0.9 * velocity + 0.3 * speed * NormalVector(this->Random);
        // Kept near the depth that was chosen.
        velocity = velocity - (0.05 * Dot(at - foot, n) + 0.05 * depth) * n;
        at = at + velocity;
        way.push_back(at);
      }
      break;
    }
    case AlongEdges:
    {
      std::int32_t corner = this->AnyEdge().From;
      const double depths[] = { 0.0, 0.0, 1e-9 * r, depth, depth, -1e-9 * r };
      const double under = depths[this->Integer(0, 5)];
      way.push_back(this->Points[corner] + lift * sign * this->CornerNormals[corner]);
      for (int hop = 0; hop < 12; ++hop)
      {
        const auto& edges = this->EdgesOf[corner];
        const Edge& edge = this->Edges[edges[this->Integer(0, static_cast<int>(edges.size()) - 1)]];
        const std::int32_t next = edge.From == corner ? edge.To : edge.From;
        const Vec3 down = -under * sign * edge.Normal;
        this->Approach(way, this->Points[corner] + down, 1);
        this->Approach(way, this->Points[next] + down, this->Integer(1, 20));
        corner = next;
      }
      break;
    }
    case ThroughCorners:
    {
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t corner =
          this->UsedCorners[this->Integer(0, static_cast<int>(this->UsedCorners.size()) - 1)];
        const Vec3& p = this->Points[corner];
        const Vec3 out =
          Unit(sign * this->CornerNormals[corner] + 0.4 * NormalVector(this->Random));
        const double height = r * this->AnyScale(1e-4, 0.3);
        way.push_back(p + height * out);
        const int ticks = this->Integer(1, 8);
        this->Approach(way, p, ticks);
        this->Approach(way, p - height * out, ticks);
        way.insert(way.end(), 4, way.back());
        this->Approach(way, p, this->Integer(1, 4));
        this->Approach(way, p + height * out, ticks);
      }
      break;
    }
    case InPlanes:
    {
      for (int i = 0; i < 4; ++i)
      {
        this->Place(triangle);
        const auto& corners = this->Triangles[triangle];
        const Vec3& p = this->Points[corners[0]];
        const Vec3& q = this->Points[corners[1]];
        const Vec3& r = this->Points[corners[2]];
        // Eighths are exact where the corners have few digits.
        const auto at = [&](int s, int t) { return p + (s / 8.0) * (q - p) + (t / 8.0) * (r - p); };
        const int s = this->Integer(-4, 12);
        const int t = this->Integer(-4, 12);
        way.push_back(at(-this->Integer(1, 8), this->Integer(-8, 8)));
        this->Approach(way, at(s, t), this->Integer(1, 8));
        this->Approach(way, at(this->Integer(9, 16), this->Integer(-8, 8)), this->Integer(1, 8));
        this->Approach(way, at(this->Integer(1, 3), this->Integer(1, 3)), this->Integer(1, 4));
        const Vec3 through = way.back() - sign * depth * this->FacetNormals[triangle];
        this->Approach(way, through, this->Integer(1, 3));
        way.insert(way.end(), 3, way.back());
      }
      break;
    }
    case OnCorners:
    {
      std::int32_t corner =
        this->UsedCorners[this->Integer(0, static_cast<int>(this->UsedCorners.size()) - 1)];
      way.push_back(this->Points[corner] + lift * sign * this->CornerNormals[corner]);
      for (int hop = 0; hop < 50; ++hop)
      {
        way.insert(way.end(), this->Integer(1, 3), this->Points[corner]);
        if (this->Integer(0, 7) == 0)
        {
          corner =
            this->UsedCorners[this->Integer(0, static_cast<int>(this->UsedCorners.size()) - 1)];
        }
        else
        {
          const auto& edges = this->EdgesOf[corner];
          const Edge& edge =
            this->Edges[edges[this->Integer(0, static_cast<int>(edges.size()) - 1)]];
          corner = edge.From == corner ? edge.To : edge.From;
        }
      }
      break;
    }
    case Tremor:
    {
      const Vec3 foot = this->Place(triangle);
      const Vec3 n = sign * this->FacetNormals[triangle];
      way.push_back(foot + lift * n);
      Vec3 base = foot - depth * n;
      const double step = Encoder * r;
      for (int i = 0; i < 150; ++i)
      {
        base = base + 0.05 * step * NormalVector(this->Random);
        Vec3 hip = base + step * NormalVector(this->Random);
        for (int k = 0; k < 3; ++k)
        {
          hip[k] = this->Middle[k] + step * std::round((hip[k] - this->Middle[k]) / step);
        }
        way.push_back(hip);
      }
      break;
    }
    case IntoFolds:
    {
      const Edge& edge = this->SharpEdge(-sign);
      const Vec3& p = this->Points[edge.From];
      const Vec3 along = this->Points[edge.To] - p;
      const Vec3 n = sign * edge.Normal;
      const Vec3 across = UnitOrUp(Cross(along, n));
      const double wide = std::min(lift, Length(along));
      const double turns = this->Uniform(2.0, 12.0);
      way.push_back(p + 0.5 * along + wide * n);
      for (int i = 0; i < 150; ++i)
      {
        const double t = i / 150.0;
        const double angle = 2.0 * M_PI * turns * t;
        way.push_back(p + (0.2 + 0.6 * t) * along +
          (wide * (1.0 - t) * std::cos(angle) - depth * t) * n +
          (wide * (1.0 - t) * std::sin(angle)) * across);
      }
      break;
    }
    case Jumps:
    {
      const bool isNear = this->Integer(0, 1) == 1;
      const Vec3 foot = this->Place(triangle);
      way.push_back(foot + lift * sign * this->FacetNormals[triangle]);
      for (int i = 0; i < 80; ++i)
      {
        Vec3 hip = foot + (lift + depth) * NormalVector(this->Random);
        for (int k = 0; k < 3 && !isNear; ++k)
        {
          hip[k] =
            this->Middle[k] + this->Uniform(-1.2, 1.2) * std::max(this->HalfBounds[k], 0.2 * r);
        }
        way.insert(way.end(), this->Integer(1, 2), hip);
      }
      break;
    }
    case Creep:
    {
      const Edge& edge = this->SharpEdge(sign);
      const Vec3& p = this->Points[edge.From];
      const Vec3 along = this->Points[edge.To] - p;
      const Vec3 n = sign * edge.Normal;
      const Vec3 foot = p + (this->Integer(0, 2) == 0 ? 0.0 : this->Uniform(0.0, 1.0)) * along;
      way.push_back(foot + lift * n);
      this->Approach(way, foot - depth * n, this->Integer(1, 10));
      const Vec3 step = 1e-9 * r * UnitOrUp(NormalVector(this->Random));
      Vec3 hip = way.back();
      for (int i = 0; i < 100; ++i)
      {
        hip = hip + step;
        way.push_back(hip);
      }
      break;
    }
    case ToAndFro:
    {
      const Edge& edge = this->SharpEdge(sign);
      const Vec3& p = this->Points[edge.From];
      const Vec3 along = this->Points[edge.To] - p;
      const Vec3 n = sign * edge.Normal;
      const Vec3 across = UnitOrUp(Cross(along, n));
      const double wide = r * this->AnyScale(1e-5, 0.2);
      const double period = this->Uniform(2.0, 30.0);
      const double under = this->Integer(0, 3) == 0 ? -depth : depth;
      way.push_back(p + 0.5 * along + std::max(lift, depth) * n + wide * across);
      for (int i = 0; i < 120; ++i)
      {
        way.push_back(p + (0.2 + 0.005 * i) * along - under * n +
          (wide * std::cos(2.0 * M_PI * i / period)) * across);
      }
      break;
    }
    case Leap:
    {
      for (int i = 0; i < 6; ++i)
      {
        const Vec3 foot = this->Place(triangle);
        const Vec3 n = sign * this->FacetNormals[triangle];
        std::int32_t other = 0;
        Vec3 landing = this->Place(other);
        for (int k = 0; k < 8; ++k)
        {
          std::int32_t candidate = 0;
          const Vec3 place = this->Place(candidate);
          // Rather a near one that faces the same way.
          if (Length(place - foot) < Length(landing - foot) ||
            Dot(this->FacetNormals[other], n) < 0.0)
          {
            landing = place;
            other = candidate;
          }
        }
        way.push_back(foot + lift * n);
        way.push_back(foot - depth * n);
        way.push_back(landing - depth * sign * this->FacetNormals[other]);
        way.insert(way.end(), 12, way.back());
      }
      break;
    }
    default: // Swing
    {
      const Edge& edge = this->SharpEdge(sign);
      const Vec3& p = this->Points[edge.From];
      const Vec3 along = this->Points[edge.To] - p;
      const bool isCorner = this->Integer(0, 2) == 0;
      const Vec3 n = sign * (isCorner ? this->CornerNormals[edge.From] : edge.Normal);
      const Vec3 foot = isCorner ? p : p + this->Uniform(0.1, 0.9) * along;
      const Vec3 across = UnitOrUp(Cross(isCorner ? NormalVector(this->Random) : along, n));
      way.push_back(foot + lift * n);
      this->Approach(way, foot - depth * n, this->Integer(1, 20));
      const double step = this->Uniform(0.5, 6.0) * M_PI / 180.0;
      for (int i = 0; i * step < M_PI; ++i)
      {
        way.push_back(
          foot - (depth * std::cos(i * step)) * n + (depth * std::sin(i * step)) * across);
      }
      break;
    }
  }
  return way;
}
}
