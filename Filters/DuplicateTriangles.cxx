#include "haptics/Filters/DuplicateTriangles.h"

#include "haptics/Math/ParallelFor.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <tuple>

namespace haptics
{
namespace
{
/// Triangles or points that a thread takes at once.
constexpr std::size_t PieceSize = 1 << 14;

/// The side of two triangles in one. What Automatic comes to is not known yet.
Side Joined(Side a, Side b)
{
  return a == b ? a : a == Side::Both || b == Side::Both ? Side::Both : Side::Automatic;
}
}

std::int64_t DropDuplicateTriangles(
  TriangleMesh& mesh, std::vector<vtkIdType>& originalCells, std::vector<Triangle>& originalCorners)
{
  std::vector<Triangle>& triangles = mesh.Triangles;
  std::vector<Side>& sides = mesh.Sides;
  const auto rotated = [&triangles](std::int32_t index)
  {
    Triangle t = triangles[index];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  // Bins the triangles by their lowest corner, then looks for equal ones within each bin. What is
  // in a bin has no order of its own, and gets one when it is sorted.
  std::vector<std::atomic<std::int32_t>> end(mesh.Points.size() + 1);
  ParallelFor(triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const Triangle& t = triangles[i];
        end[*std::min_element(t.begin(), t.end())].fetch_add(1, std::memory_order_relaxed);
      }
    });
  std::int32_t begin = 0;
  for (std::atomic<std::int32_t>& bin : end)
  {
    begin += bin.exchange(begin, std::memory_order_relaxed);
  }
  struct Entry
  {
    std::int32_t Second, Third, Index;
  };
  const std::unique_ptr<Entry[]> entries(new Entry[triangles.size()]); // not cleared
  ParallelFor(triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const Triangle t = rotated(static_cast<std::int32_t>(i));
        entries[end[t[0]].fetch_add(1, std::memory_order_relaxed)] = { t[1], t[2],
          static_cast<std::int32_t>(i) };
      }
    });
  const auto sameCorners = [](const Entry& a, const Entry& b)
  { return a.Second == b.Second && a.Third == b.Third; };
  std::vector<std::uint8_t> drop(triangles.size(), 0);
  std::atomic<std::size_t> dropped{ 0 };
  ParallelFor(mesh.Points.size(), PieceSize,
    [&](std::size_t firstBin, std::size_t lastBin)
    {
      for (std::size_t bin = firstBin; bin < lastBin; ++bin)
      {
        Entry* const first = entries.get() + (bin == 0 ? 0 : end[bin - 1].load());
        Entry* const last = entries.get() + end[bin].load();
        std::sort(first, last,
          [](const Entry& a, const Entry& b)
          { return std::tie(a.Second, a.Third, a.Index) < std::tie(b.Second, b.Third, b.Index); });
        const Entry* kept = first;
        for (const Entry* entry = first; entry != last; ++entry)
        {
          if (entry == first || !sameCorners(*kept, *entry))
          {
            kept = entry;
            continue;
          }
          drop[entry->Index] = 1;
          ++dropped;
          if (!sides.empty())
          {
            sides[kept->Index] = Joined(sides[kept->Index], sides[entry->Index]);
          }
        }
      }
    });
  if (dropped == 0)
  {
    return 0;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (!drop[i])
    {
      triangles[kept] = triangles[i];
      originalCells[kept] = originalCells[i];
      if (!originalCorners.empty())
      {
        originalCorners[kept] = originalCorners[i];
      }
      if (!sides.empty())
      {
        sides[kept] = sides[i];
      }
      ++kept;
    }
  }
  triangles.resize(kept);
  originalCells.resize(kept);
  originalCorners.resize(originalCorners.empty() ? 0 : kept);
  sides.resize(sides.empty() ? 0 : kept);
  return static_cast<std::int64_t>(dropped);
}
}
