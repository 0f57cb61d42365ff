#include "haptics/Filters/FlatTriangles.h"

#include "haptics/Filters/PolygonSplitter.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace haptics
{
namespace
{
double SquaredDistance(const Vec3& a, const Vec3& b)
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  }
  return sum;
}

/// Which triangle has the directed edge from one point to another, for the points that matter.
class EdgeMap
{
public:
  EdgeMap(const std::vector<Triangle>& flat, std::size_t numberOfPoints)
    : Matters(numberOfPoints, false)
  {
    for (const Triangle& t : flat)
    {
      for (const std::int32_t corner : t)
      {
        this->Matters[corner] = true;
      }
    }
  }

  void Add(const Triangle& t, std::int32_t index)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = t[i];
      const std::int32_t to = t[(i + 1) % 3];
      if (this->Matters[from] && this->Matters[to])
      {
        this->Triangles.emplace(Key(from, to), index);
      }
    }
  }

  void Remove(const Triangle& t, std::int32_t index)
  {
    for (int i = 0; i < 3; ++i)
    {
      const auto found = this->Triangles.find(Key(t[i], t[(i + 1) % 3]));
      if (found != this->Triangles.end() && found->second == index)
      {
        this->Triangles.erase(found);
      }
    }
  }

  /// -1 if there is none.
  std::int32_t Find(std::int32_t from, std::int32_t to) const
  {
    const auto found = this->Triangles.find(Key(from, to));
    return found == this->Triangles.end() ? -1 : found->second;
  }

private:
  static std::uint64_t Key(std::int32_t from, std::int32_t to)
  {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
  }

  std::vector<bool> Matters;
  std::unordered_map<std::uint64_t, std::int32_t> Triangles;
};

/// Turns p m q so that the middle point comes second.
void PutMiddleSecond(const std::vector<Vec3>& points, Triangle& t)
{
  int longest = 0;
  double length = -1.0;
  for (int i = 0; i < 3; ++i)
  {
    const double squared = SquaredDistance(points[t[i]], points[t[(i + 1) % 3]]);
    if (squared > length)
    {
      length = squared;
      longest = i;
    }
  }
  std::rotate(t.begin(), t.begin() + (longest + 1) % 3, t.end());
}
}

void CloseFlatTriangles(
  const std::vector<Vec3>& points, std::vector<Triangle> flat, CleanedMesh& cleaned)
{
  std::vector<Triangle>& triangles = cleaned.Mesh.Triangles;
  std::vector<vtkIdType>& originalCells = cleaned.OriginalCell;
  std::vector<Triangle>& corners = cleaned.OriginalCorners;
  EdgeMap flatEdges(flat, points.size());
  for (const Triangle& t : flat)
  {
    flatEdges.Add(t, 0);
  }
  EdgeMap edges(flat, points.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    edges.Add(triangles[i], static_cast<std::int32_t>(i));
  }
  for (Triangle& t : flat)
  {
    PutMiddleSecond(points, t);
  }
  const auto has = [&](std::int32_t from, std::int32_t to)
  { return edges.Find(from, to) >= 0 || flatEdges.Find(from, to) >= 0; };
  const auto close = [&](const Triangle& t)
  {
    const std::int32_t index = edges.Find(t[0], t[2]);
    if (index < 0 || !(has(t[1], t[0]) || has(t[2], t[1])))
    {
      return false;
    }
    Triangle facet = triangles[index];
    const auto turn = std::find(facet.begin(), facet.end(), t[0]) - facet.begin();
    std::rotate(facet.begin(), facet.begin() + turn, facet.end());
    const Triangle first{ t[0], t[1], facet[2] };
    const Triangle second{ t[1], t[2], facet[2] };
    if (!HasArea(points[first[0]], points[first[1]], points[first[2]]) ||
      !HasArea(points[second[0]], points[second[1]], points[second[2]]))
    {
      return false;
    }
    edges.Remove(facet, index);
    triangles[index] = first;
    edges.Add(first, index);
    edges.Add(second, static_cast<std::int32_t>(triangles.size()));
    triangles.push_back(second);
    if (!corners.empty())
    {
      Triangle own = corners[index];
      std::rotate(own.begin(), own.begin() + turn, own.end());
      const auto middle = static_cast<std::int32_t>(cleaned.OriginalPoint[t[1]]);
      corners[index] = { own[0], middle, own[2] };
      corners.push_back({ middle, own[1], own[2] });
    }
    originalCells.push_back(originalCells[index]);
    return true;
  };
  // Flat triangles can be neighbours: one closes only when the one across it has.
  std::size_t before = flat.size() + 1;
  while (flat.size() < before)
  {
    before = flat.size();
    flat.erase(std::remove_if(flat.begin(), flat.end(), close), flat.end());
  }
}
}
