#include "haptics/Filters/PolygonSplitter.h"

#include "haptics/Math/Vec3Operations.h"

#include <cmath>
#include <utility>

namespace haptics
{
namespace
{
/// Sign of a b - c d, exact while nothing underflows.
int SignOfDifference(double a, double b, double c, double d)
{
  const double ab = a * b;
  const double cd = c * d;
  if (std::abs(ab - cd) > 0x1p-51 * (std::abs(ab) + std::abs(cd)))
  {
    return ab > cd ? 1 : -1;
  }
  // Each product is its rounded value plus a remainder that float64 holds exactly.
  const double abRest = std::fma(a, b, -ab);
  const double cdRest = std::fma(c, d, -cd);
  const double difference = (ab - cd) + (abRest - cdRest);
  return (difference > 0.0) - (difference < 0.0);
}

double SquaredNorm(const Vec3& a)
{
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}
}

bool HasArea(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 u = Minus(b, a);
  const Vec3 v = Minus(c, a);
  if (!(SquaredNorm(Cross(u, v)) > 0.0))
  {
    return false;
  }
  return SignOfDifference(u[1], v[2], u[2], v[1]) != 0 ||
    SignOfDifference(u[2], v[0], u[0], v[2]) != 0 || SignOfDifference(u[0], v[1], u[1], v[0]) != 0;
}

/// Lays the corners into the coordinate plane that faces the mean (Newell) normal most, counter-
/// clockwise. Two coordinates stay as they are: no rounding. False: the signed area is zero.
bool PolygonSplitter::Project(const std::vector<Vec3>& corners)
{
  const int count = static_cast<int>(corners.size());
  Vec3 normal{};
  for (int i = 1; i + 1 < count; ++i)
  {
    const Vec3 part = Cross(Minus(corners[i], corners[0]), Minus(corners[i + 1], corners[0]));
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] += part[axis];
    }
  }
  int drop = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    drop = std::abs(normal[axis]) > std::abs(normal[drop]) ? axis : drop;
  }
  int x = (drop + 1) % 3;
  int y = (drop + 2) % 3;
  if (normal[drop] < 0.0)
  {
    std::swap(x, y);
  }
  this->Corners.resize(count);
  for (int i = 0; i < count; ++i)
  {
    this->Corners[i] = { corners[i][x], corners[i][y], (i + count - 1) % count, (i + 1) % count,
      0.0, 0, false };
  }
  this->First = 0;
  return normal[drop] != 0.0;
}

int PolygonSplitter::Turn(int a, int b, int c) const
{
  const Corner& p = this->Corners[a];
  const Corner& q = this->Corners[b];
  const Corner& r = this->Corners[c];
  return SignOfDifference(q.X - p.X, r.Y - p.Y, q.Y - p.Y, r.X - p.X);
}

/// Whether the closed triangle holds the point. A point that coincides with a corner, as the ends
/// of a bridge to a hole do, is none in the way.
bool PolygonSplitter::Holds(int a, int b, int c, int point) const
{
  const Corner& p = this->Corners[point];
  for (const int corner : { a, b, c })
  {
    if (p.X == this->Corners[corner].X && p.Y == this->Corners[corner].Y)
    {
      return false;
    }
  }
  return this->Turn(a, b, point) >= 0 && this->Turn(b, c, point) >= 0 &&
    this->Turn(c, a, point) >= 0;
}

void PolygonSplitter::Judge(int corner, const std::vector<Vec3>& corners)
{
  Corner& tip = this->Corners[corner];
  tip.Diagonal = SquaredNorm(Minus(corners[tip.Next], corners[tip.Previous]));
  tip.Ear = tip.Turn > 0;
  // Only corners that are not convex can lie inside an ear.
  for (int i = this->Corners[tip.Next].Next; tip.Ear && i != tip.Previous;
       i = this->Corners[i].Next)
  {
    tip.Ear = this->Corners[i].Turn > 0 || !this->Holds(tip.Previous, corner, tip.Next, i);
  }
}

int PolygonSplitter::BestEar() const
{
  int best = -1;
  int i = this->First;
  do
  {
    if (this->Corners[i].Ear &&
      (best < 0 || this->Corners[i].Diagonal < this->Corners[best].Diagonal))
    {
      best = i;
    }
    i = this->Corners[i].Next;
  } while (i != this->First);
  return best;
}

int PolygonSplitter::AnyStraight() const
{
  int i = this->First;
  do
  {
    if (this->Corners[i].Turn == 0)
    {
      return i;
    }
    i = this->Corners[i].Next;
  } while (i != this->First);
  return -1;
}

void PolygonSplitter::MakeFan(int count)
{
  this->Output.clear();
  for (int i = 1; i + 1 < count; ++i)
  {
    this->Output.push_back({ 0, i, i + 1 });
  }
}

PolygonSplitter::Result PolygonSplitter::Split(const std::vector<Vec3>& corners)
{
  const int count = static_cast<int>(corners.size());
  if (count == 3)
  {
    this->MakeFan(3);
    return Result::Split;
  }
  if (!this->Project(corners))
  {
    this->MakeFan(count);
    return Result::Folded;
  }
  this->Output.clear();
  for (int i = 0; i < count; ++i)
  {
    this->Corners[i].Turn = this->Turn(this->Corners[i].Previous, i, this->Corners[i].Next);
  }
  const auto judgeAll = [&]()
  {
    int i = this->First;
    do
    {
      this->Judge(i, corners);
      i = this->Corners[i].Next;
    } while (i != this->First);
  };
  judgeAll();
  for (int left = count; left > 3; --left)
  {
    int tip = this->BestEar();
    if (tip < 0)
    {
      // A corner that has become convex may have freed others.
      judgeAll();
      tip = this->BestEar();
    }
    if (tip < 0)
    {
      tip = this->AnyStraight();
    }
    if (tip < 0)
    {
      this->MakeFan(count);
      return Result::Folded;
    }
    const int before = this->Corners[tip].Previous;
    const int after = this->Corners[tip].Next;
    this->Output.push_back({ before, tip, after });
    this->Corners[before].Next = after;
    this->Corners[after].Previous = before;
    this->First = before;
    for (const int i : { before, after })
    {
      this->Corners[i].Turn = this->Turn(this->Corners[i].Previous, i, this->Corners[i].Next);
    }
    this->Judge(before, corners);
    this->Judge(after, corners);
  }
  const int last = this->First;
  const LocalTriangle rest{ this->Corners[last].Previous, last, this->Corners[last].Next };
  if (this->Turn(rest[0], rest[1], rest[2]) < 0)
  {
    this->MakeFan(count);
    return Result::Folded;
  }
  this->Output.push_back(rest);
  return Result::Split;
}
}
