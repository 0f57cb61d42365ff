#include "haptics/Filters/EqualPoints.h"

#include "haptics/Math/ParallelFor.h"

#include <cstring>
#include <utility>

namespace haptics
{
namespace
{
constexpr std::size_t PointsPerPiece = 1 << 15;

/// Adding 0 makes -0 and 0, which are equal, the same bits.
Vec3 Relative(const PointReader& points, std::size_t i, const Vec3& origin)
{
  const Vec3 p = points.At(static_cast<vtkIdType>(i));
  return { (p[0] - origin[0]) + 0.0, (p[1] - origin[1]) + 0.0, (p[2] - origin[2]) + 0.0 };
}

std::uint32_t Hash(const Vec3& p)
{
  constexpr std::uint64_t factors[] = { 0x9e3779b97f4a7c15u, 0xbf58476d1ce4e5b9u,
    0x94d049bb133111ebu };
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &p[k], sizeof(bits));
    // Regular grids differ in few bits, the upper ones: bring them down, and spread them.
    hash = (hash ^ bits ^ (bits >> 32)) * factors[k];
    hash ^= hash >> 29;
  }
  return static_cast<std::uint32_t>((hash * factors[0]) >> 32);
}

/// A point by its hash.
struct Hashed
{
  std::uint32_t Hash;
  std::int32_t Point = -1; ///< -1: none
};

/// All points of interest by the shares that their hashes belong to: what is equal is in one share.
/// A share has its points in their order.
class Shares
{
public:
  Shares(const std::vector<std::uint32_t>& hashes, const std::vector<std::int32_t>& interest)
  {
    while (this->Count < LargestCount && this->Count * PointsPerShare < hashes.size())
    {
      this->Count *= 2;
    }
    const std::size_t pieces = (hashes.size() + PointsPerPiece - 1) / PointsPerPiece;
    std::vector<std::uint32_t> next(pieces * this->Count, 0); // for each piece, for each share
    const auto visit = [&](const auto& take)
    {
      ParallelFor(hashes.size(), PointsPerPiece,
        [&](std::size_t first, std::size_t last)
        {
          std::uint32_t* const own = &next[first / PointsPerPiece * this->Count];
          for (std::size_t i = first; i < last; ++i)
          {
            if (interest[i] >= 0)
            {
              take(own[hashes[i] & (this->Count - 1)]++, i);
            }
          }
        });
    };
    visit([](std::uint32_t, std::size_t) {});
    std::uint32_t begin = 0;
    for (std::size_t share = 0; share < this->Count; ++share)
    {
      this->Begin.push_back(begin);
      for (std::size_t piece = 0; piece < pieces; ++piece)
      {
        begin += std::exchange(next[piece * this->Count + share], begin);
      }
    }
    this->Begin.push_back(begin);
    this->Points.resize(begin);
    visit(
      [&](std::uint32_t place, std::size_t i) {
        this->Points[place] = { hashes[i], static_cast<std::int32_t>(i) };
      });
  }

  std::size_t NumberOfShares() const { return this->Count; }

  /// Calls found(point, first equal point) for all points of a share: by a hash table with open
  /// addressing, small enough to stay in a core's cache.
  template <class Equal, class Found>
  void FindFirst(
    std::size_t share, std::vector<Hashed>& table, const Equal& isEqual, const Found& found) const
  {
    const std::size_t count = this->Begin[share + 1] - this->Begin[share];
    std::size_t capacity = 16;
    while (capacity < 2 * count)
    {
      capacity *= 2;
    }
    table.assign(capacity, {});
    for (std::size_t k = this->Begin[share]; k < this->Begin[share + 1]; ++k)
    {
      const Hashed& point = this->Points[k];
      std::size_t slot = (point.Hash / this->Count) & (capacity - 1);
      while (table[slot].Point >= 0 &&
        (table[slot].Hash != point.Hash || !isEqual(table[slot].Point, point.Point)))
      {
        slot = (slot + 1) & (capacity - 1);
      }
      if (table[slot].Point < 0)
      {
        table[slot] = point;
      }
      found(point.Point, table[slot].Point);
    }
  }

private:
  static constexpr std::size_t PointsPerShare = 1 << 14;
  static constexpr std::size_t LargestCount = 1 << 10;

  std::size_t Count = 1; ///< a power of two
  std::vector<std::uint32_t> Begin;
  std::vector<Hashed> Points;
};
}

bool FindEqualPoints(const PointReader& points, const Vec3& origin,
  std::vector<std::int32_t>& firstEqual, const ProgressCall& progress)
{
  std::vector<std::uint32_t> hashes(firstEqual.size());
  ParallelFor(hashes.size(), PointsPerPiece,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        hashes[i] = firstEqual[i] < 0 ? 0 : Hash(Relative(points, i, origin));
      }
    });
  const Shares shares(hashes, firstEqual);
  const auto isEqual = [&](std::int32_t a, std::int32_t b)
  { return Relative(points, a, origin) == Relative(points, b, origin); };
  return ParallelFor(
    shares.NumberOfShares(), 8,
    [&](std::size_t first, std::size_t last)
    {
      std::vector<Hashed> table;
      for (std::size_t share = first; share < last; ++share)
      {
        shares.FindFirst(share, table, isEqual,
          [&](std::int32_t point, std::int32_t equal) { firstEqual[point] = equal; });
      }
    },
    progress);
}
}
