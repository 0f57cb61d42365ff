#include "haptics/Filters/DuplicateTriangles.h"

#include <algorithm>
#include <tuple>

namespace haptics
{
namespace
{
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
  // Bins the triangles by their lowest corner, then looks for equal ones within each bin.
  std::vector<std::int32_t> start(mesh.Points.size() + 1, 0);
  for (const Triangle& t : triangles)
  {
    ++start[*std::min_element(t.begin(), t.end()) + 1];
  }
  for (std::size_t i = 1; i < start.size(); ++i)
  {
    start[i] += start[i - 1];
  }
  struct Entry
  {
    std::int32_t Second, Third, Index;
  };
  std::vector<Entry> entries(triangles.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const Triangle t = rotated(static_cast<std::int32_t>(i));
    entries[next[t[0]]++] = { t[1], t[2], static_cast<std::int32_t>(i) };
  }
  const auto sameCorners = [](const Entry& a, const Entry& b)
  { return a.Second == b.Second && a.Third == b.Third; };
  std::vector<bool> drop(triangles.size(), false);
  for (std::size_t bin = 0; bin + 1 < start.size(); ++bin)
  {
    const auto first = entries.begin() + start[bin];
    const auto last = entries.begin() + start[bin + 1];
    std::sort(first, last,
      [](const Entry& a, const Entry& b)
      { return std::tie(a.Second, a.Third, a.Index) < std::tie(b.Second, b.Third, b.Index); });
    auto kept = first;
    for (auto entry = first; entry != last; ++entry)
    {
      drop[entry->Index] = entry != first && sameCorners(*kept, *entry);
      kept = drop[entry->Index] ? kept : entry;
      if (drop[entry->Index] && !sides.empty())
      {
        sides[kept->Index] = Joined(sides[kept->Index], sides[entry->Index]);
      }
    }
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
  const auto dropped = static_cast<std::int64_t>(triangles.size() - kept);
  triangles.resize(kept);
  originalCells.resize(kept);
  originalCorners.resize(originalCorners.empty() ? 0 : kept);
  sides.resize(sides.empty() ? 0 : kept);
  return dropped;
}
}
