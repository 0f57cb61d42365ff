#include "haptics/Filters/PointMerger.h"

#include <cmath>
#include <cstring>

namespace haptics
{
namespace
{
std::uint64_t Mix(std::uint64_t bits)
{
  // The finaliser of SplitMix64: regular grids differ in few bits.
  bits ^= bits >> 30;
  bits *= 0xbf58476d1ce4e5b9u;
  bits ^= bits >> 27;
  bits *= 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

std::uint64_t Hash(const Vec3& cell)
{
  std::uint64_t hash = 0;
  for (const double x : cell)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    hash = Mix(hash + 0x9e3779b97f4a7c15u + bits);
  }
  return hash;
}
}

PointMerger::PointMerger(std::size_t expectedPoints, double tolerance)
  : Tolerance(tolerance)
{
  this->Merged.reserve(expectedPoints);
  std::size_t capacity = 16;
  while (capacity < 2 * expectedPoints)
  {
    capacity *= 2;
  }
  this->Table.assign(capacity, -1);
}

Vec3 PointMerger::Cell(const Vec3& point) const
{
  // Adding 0 makes -0 and 0, which are equal, the same bits.
  if (this->Tolerance == 0.0)
  {
    return { point[0] + 0.0, point[1] + 0.0, point[2] + 0.0 };
  }
  return { std::floor(point[0] / this->Tolerance) + 0.0,
    std::floor(point[1] / this->Tolerance) + 0.0, std::floor(point[2] / this->Tolerance) + 0.0 };
}

std::size_t PointMerger::Slot(const Vec3& cell) const
{
  const std::size_t mask = this->Table.size() - 1;
  std::size_t slot = Hash(cell) & mask;
  while (this->Table[slot] >= 0 && this->Cell(this->Merged[this->Table[slot]]) != cell)
  {
    slot = (slot + 1) & mask;
  }
  return slot;
}

std::int32_t PointMerger::FindNear(const Vec3& point, const Vec3& cell) const
{
  std::int32_t nearest = -1;
  double limit = this->Tolerance * this->Tolerance;
  for (int neighbour = 0; neighbour < 27; ++neighbour)
  {
    const int step[] = { neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1 };
    const Vec3 other{ cell[0] + step[0], cell[1] + step[1], cell[2] + step[2] };
    for (std::int32_t i = this->Table[this->Slot(other)]; i >= 0; i = this->Next[i])
    {
      double squared = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double difference = this->Merged[i][axis] - point[axis];
        squared += difference * difference;
      }
      if (squared < limit || (squared == limit && nearest < 0))
      {
        limit = squared;
        nearest = i;
      }
    }
  }
  return nearest;
}

std::int32_t PointMerger::Insert(const Vec3& point)
{
  const Vec3 cell = this->Cell(point);
  std::size_t slot = this->Slot(cell);
  const std::int32_t found =
    this->Tolerance == 0.0 ? this->Table[slot] : this->FindNear(point, cell);
  if (found >= 0)
  {
    return found;
  }
  if (2 * (this->Merged.size() + 1) > this->Table.size())
  {
    this->Grow();
    slot = this->Slot(cell);
  }
  const auto added = static_cast<std::int32_t>(this->Merged.size());
  this->Merged.push_back(point);
  if (this->Tolerance > 0.0)
  {
    this->Next.push_back(this->Table[slot]);
  }
  this->Table[slot] = added;
  return added;
}

void PointMerger::Grow()
{
  std::vector<std::int32_t> old(2 * this->Table.size(), -1);
  old.swap(this->Table);
  for (const std::int32_t first : old)
  {
    if (first >= 0)
    {
      this->Table[this->Slot(this->Cell(this->Merged[first]))] = first;
    }
  }
}
}
