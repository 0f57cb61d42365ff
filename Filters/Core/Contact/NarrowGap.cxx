#include "haptics/Contact/NarrowGap.h"

#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Surface/Facet.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
namespace
{
/// Two lips are seen in directions more apart than this.
constexpr double LargestCosine = 0.5;
/// Lips go on along each other for so many times the gap's width, or they are none.
constexpr double LengthOfGap = 16.0;
/// So many widths from an edge is on it.
constexpr double Aside = 1.0 / 16.0;

double SquaredDistanceToSegment(const Vector& x, const Vector& from, const Vector& to)
{
  return SquaredLength(x - NearestOnSegment(from, to, x));
}

Vector NearestOn(const std::array<Vector, 3>& corners, const Vector& x)
{
  return x + NearestToOrigin(corners[0] - x, corners[1] - x, corners[2] - x);
}

/// The nearest point of the segment from `a` to `b` to that from `p` to `q`, and the point nearest
/// to it there (Ericson, Real-Time Collision Detection, 2005, 5.1.9).
void NearestOfSegments(const Vector& a, const Vector& b, const Vector& p, const Vector& q,
  Vector& onFirst, Vector& onSecond)
{
  const Vector u = b - a;
  const Vector v = q - p;
  const Vector w = a - p;
  const double uu = glm::dot(u, u);
  const double vv = glm::dot(v, v);
  const double uv = glm::dot(u, v);
  const double uw = glm::dot(u, w);
  const double vw = glm::dot(v, w);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 0.0 ? std::clamp((uv * vw - uw * vv) / determinant, 0.0, 1.0) : 0.0;
  double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
  if (t < 0.0 || t > 1.0)
  {
    t = std::clamp(t, 0.0, 1.0);
    s = uu > 0.0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
  }
  onFirst = a + s * u;
  onSecond = p + t * v;
}
}

void NarrowGap::Add(const Vector& a, const Vector& b, const Vector& c,
  const std::array<bool, 3>& areOpen, double width)
{
  Lip lip{ { a, b, c }, a, Vector(0.0), width, {} };
  double least = HUGE_VAL;
  const auto take = [&](const Vector& onFacet, const Vector& onWay)
  {
    const double squared = SquaredLength(onFacet - onWay);
    if (squared < least)
    {
      least = squared;
      lip.Nearest = onFacet;
      lip.Offset = onFacet - onWay;
    }
  };
  for (const Vector& end : { this->From, this->To })
  {
    take(NearestOn(lip.Corners, end), end);
  }
  for (int k = 0; k < 3; ++k)
  {
    Vector onFacet;
    Vector onWay;
    NearestOfSegments(
      lip.Corners[k], lip.Corners[(k + 1) % 3], this->From, this->To, onFacet, onWay);
    take(onFacet, onWay);
  }
  if (least > width * width)
  {
    return;
  }
  const double aside = Aside * width;
  for (int k = 0; k < 3; ++k)
  {
    lip.AreOpen[k] = areOpen[k] &&
      SquaredDistanceToSegment(lip.Nearest, lip.Corners[k], lip.Corners[(k + 1) % 3]) <=
        aside * aside;
  }
  this->HasOpen = this->HasOpen || lip.IsOpen();
  if (this->Count == Capacity)
  {
    this->IsFull = true;
    return;
  }
  this->Lips[this->Count++] = lip;
}

/// Whether, along an open edge of the lip from its nearest point on, the other one stays within
/// `width`.
bool NarrowGap::StaysNear(const Lip& lip, const Lip& other, double width)
{
  const double length = LengthOfGap * lip.Width;
  for (int k = 0; k < 3; ++k)
  {
    if (!lip.AreOpen[k])
    {
      continue;
    }
    const Vector& from = lip.Corners[k];
    const Vector& to = lip.Corners[(k + 1) % 3];
    const double edge = glm::length(to - from);
    const Vector along = edge > 0.0 ? (to - from) / edge : Vector(0.0);
    const double at = glm::dot(lip.Nearest - from, along);
    for (const double end : { std::max(at - length, 0.0), std::min(at + length, edge) })
    {
      const Vector point = from + end * along;
      if (std::abs(end - at) > 0.5 * length &&
        SquaredLength(NearestOn(other.Corners, point) - point) <= width * width)
      {
        return true;
      }
    }
  }
  return false;
}

bool NarrowGap::IsFound() const
{
  if (!this->HasOpen)
  {
    return false;
  }
  for (int i = 0; i < this->Count; ++i)
  {
    for (int j = i + 1; j < this->Count; ++j)
    {
      const Lip& a = this->Lips[i];
      const Lip& b = this->Lips[j];
      const double width = std::min(a.Width, b.Width);
      const auto isShared = [&b](const Vector& corner)
      { return std::find(b.Corners.begin(), b.Corners.end(), corner) != b.Corners.end(); };
      if ((!a.IsOpen() && !b.IsOpen()) ||
        std::count_if(a.Corners.begin(), a.Corners.end(), isShared) > 1 ||
        SquaredLength(a.Nearest - b.Nearest) > width * width ||
        glm::dot(a.Offset, b.Offset) >
          LargestCosine * glm::length(a.Offset) * glm::length(b.Offset))
      {
        continue;
      }
      if (StaysNear(a, b, width) || StaysNear(b, a, width))
      {
        return true;
      }
    }
  }
  return this->IsFull;
}
}
