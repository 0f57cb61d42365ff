#include "haptics/Filters/PolygonSplitter.h"

#include "haptics/Math/Vec3Operations.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
  CornerGrid::Place low{ corners[0][x], corners[0][y] };
  CornerGrid::Place high = low;
  for (int i = 0; i < count; ++i)
  {
    this->Corners[i] = { corners[i][x], corners[i][y], (i + count - 1) % count, (i + 1) % count,
      0.0, 1, false, None, None, None, None };
    low = { std::min(low[0], corners[i][x]), std::min(low[1], corners[i][y]) };
    high = { std::max(high[0], corners[i][x]), std::max(high[1], corners[i][y]) };
  }
  this->Grid.Restart(count, low, high);
  this->Ears.clear();
  this->Straight.clear();
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

/// A corner in the way of the ear at `corner`, or None. `likely`: one to try first, or None.
int PolygonSplitter::FindBlocker(int corner, int likely) const
{
  const int before = this->Corners[corner].Previous;
  const int after = this->Corners[corner].Next;
  const auto isInTheWay = [&](int i)
  { return i != before && i != corner && i != after && this->Holds(before, corner, after, i); };
  for (const int i : { likely, this->Corners[after].Next, this->Corners[before].Previous })
  {
    if (i != None && this->Grid.Has(i) && isInTheWay(i))
    {
      return i;
    }
  }
  const auto place = [this](int i) {
    return CornerGrid::Place{ this->Corners[i].X, this->Corners[i].Y };
  };
  return this->Grid.Find(place(before), place(corner), place(after), isInTheWay);
}

void PolygonSplitter::SetTurn(int corner)
{
  Corner& tip = this->Corners[corner];
  tip.Turn = this->Turn(tip.Previous, corner, tip.Next);
  tip.Diagonal = SquaredNorm(Minus((*this->Given)[tip.Next], (*this->Given)[tip.Previous]));
  if (tip.Turn == 0)
  {
    this->Straight.push_back(corner);
  }
  const bool isInTheWay = tip.Turn <= 0;
  if (isInTheWay && !this->Grid.Has(corner))
  {
    this->Grid.Insert(corner, { tip.X, tip.Y });
  }
  else if (!isInTheWay && this->Grid.Has(corner))
  {
    this->Grid.Remove(corner);
    this->FreeWaiting(corner);
  }
}

void PolygonSplitter::Judge(int corner)
{
  Corner& tip = this->Corners[corner];
  const int likely = tip.Blocker;
  this->StopWaiting(corner);
  const int blocker = tip.Turn > 0 ? this->FindBlocker(corner, likely) : None;
  tip.IsEar = tip.Turn > 0 && blocker == None;
  if (tip.IsEar)
  {
    this->Ears.emplace_back(tip.Diagonal, corner);
    std::push_heap(this->Ears.begin(), this->Ears.end(), std::greater<>());
  }
  else if (blocker != None)
  {
    this->Wait(corner, blocker);
  }
}

void PolygonSplitter::Wait(int corner, int blocker)
{
  Corner& tip = this->Corners[corner];
  tip.Blocker = blocker;
  tip.PreviousWaiting = None;
  tip.NextWaiting = this->Corners[blocker].FirstWaiting;
  if (tip.NextWaiting != None)
  {
    this->Corners[tip.NextWaiting].PreviousWaiting = corner;
  }
  this->Corners[blocker].FirstWaiting = corner;
}

void PolygonSplitter::StopWaiting(int corner)
{
  Corner& tip = this->Corners[corner];
  if (tip.Blocker == None)
  {
    return;
  }
  (tip.PreviousWaiting == None ? this->Corners[tip.Blocker].FirstWaiting
                               : this->Corners[tip.PreviousWaiting].NextWaiting) = tip.NextWaiting;
  if (tip.NextWaiting != None)
  {
    this->Corners[tip.NextWaiting].PreviousWaiting = tip.PreviousWaiting;
  }
  tip.Blocker = None;
}

/// A corner is out of the way: who waited for it is to be judged anew.
void PolygonSplitter::FreeWaiting(int blocker)
{
  while (this->Corners[blocker].FirstWaiting != None)
  {
    const int corner = this->Corners[blocker].FirstWaiting;
    this->StopWaiting(corner);
    this->ToJudge.push_back(corner);
  }
}

int PolygonSplitter::NextEar()
{
  while (!this->Ears.empty())
  {
    const auto [diagonal, corner] = this->Ears.front();
    std::pop_heap(this->Ears.begin(), this->Ears.end(), std::greater<>());
    this->Ears.pop_back();
    if (this->IsThere(corner) && this->Corners[corner].IsEar &&
      this->Corners[corner].Diagonal == diagonal)
    {
      return corner;
    }
  }
  return None;
}

int PolygonSplitter::AnyStraight()
{
  while (!this->Straight.empty())
  {
    const int corner = this->Straight.back();
    this->Straight.pop_back();
    if (this->IsThere(corner) && this->Corners[corner].Turn == 0)
    {
      return corner;
    }
  }
  return None;
}

void PolygonSplitter::CutOff(int tip)
{
  const int before = this->Corners[tip].Previous;
  const int after = this->Corners[tip].Next;
  this->Output.push_back({ before, tip, after });
  this->Corners[before].Next = after;
  this->Corners[after].Previous = before;
  this->Corners[tip].Next = None;
  this->StopWaiting(tip);
  this->ToJudge.clear();
  if (this->Grid.Has(tip)) // it was straight
  {
    this->Grid.Remove(tip);
    this->FreeWaiting(tip);
  }
  for (const int i : { before, after })
  {
    this->SetTurn(i);
    this->ToJudge.push_back(i);
  }
  for (const int i : this->ToJudge)
  {
    if (this->IsThere(i))
    {
      this->Judge(i);
    }
  }
}

void PolygonSplitter::MakeFan(int count)
{
  this->Output.clear();
  for (int i = 1; i + 1 < count; ++i)
  {
    this->Output.push_back({ 0, i, i + 1 });
  }
}

PolygonSplitter::Result PolygonSplitter::Clip(int count, const GoOnCall& goOn)
{
  constexpr int stepsPerCall = 256;
  const auto isStopped = [&goOn](int step)
  { return step % stepsPerCall == stepsPerCall - 1 && goOn && !goOn(); };
  for (int i = 0; i < count; ++i)
  {
    this->SetTurn(i);
  }
  for (int i = 0; i < count; ++i)
  {
    if (isStopped(i))
    {
      return Result::Stopped;
    }
    this->Judge(i);
  }
  int last = 0;
  for (int left = count; left > 3; --left)
  {
    if (isStopped(left))
    {
      return Result::Stopped;
    }
    int tip = this->NextEar();
    tip = tip == None ? this->AnyStraight() : tip;
    if (tip == None)
    {
      return Result::Folded;
    }
    last = this->Corners[tip].Previous;
    this->CutOff(tip);
  }
  const LocalTriangle rest{ this->Corners[last].Previous, last, this->Corners[last].Next };
  this->Output.push_back(rest);
  return this->Turn(rest[0], rest[1], rest[2]) < 0 ? Result::Folded : Result::Split;
}

PolygonSplitter::Result PolygonSplitter::Split(
  const std::vector<Vec3>& corners, const GoOnCall& goOn)
{
  const int count = static_cast<int>(corners.size());
  if (count == 3)
  {
    this->MakeFan(3);
    return Result::Split;
  }
  this->Output.clear();
  this->Given = &corners;
  const Result result = this->Project(corners) ? this->Clip(count, goOn) : Result::Folded;
  this->Given = nullptr;
  if (result == Result::Folded)
  {
    this->MakeFan(count);
  }
  else if (result == Result::Stopped)
  {
    this->Output.clear();
  }
  return result;
}
}
