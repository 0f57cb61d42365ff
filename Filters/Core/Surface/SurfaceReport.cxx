#include "haptics/Surface/SurfaceReport.h"

#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <numeric>

namespace haptics
{
namespace
{
/// One triangle's use of an edge; equal edges become adjacent when sorted.
struct EdgeUse
{
  std::int32_t Low, High; ///< its end points, Low < High
  std::int32_t Triangle;
  std::int8_t Edge; ///< which edge of the triangle: 0-1, 1-2 or 2-0
  bool Ascending;   ///< the triangle runs from Low to High
};

std::vector<EdgeUse> SortedEdgeUses(
  std::size_t numberOfPoints, const std::vector<std::array<std::int32_t, 3>>& triangles)
{
  // A counting sort by the low end, then small sorts: linear on real meshes.
  std::vector<std::int32_t> start(numberOfPoints + 1, 0);
  for (const auto& t : triangles)
  {
    for (int e = 0; e < 3; ++e)
    {
      ++start[std::min(t[e], t[(e + 1) % 3]) + 1];
    }
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<EdgeUse> uses(3 * triangles.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (int e = 0; e < 3; ++e)
    {
      const std::int32_t from = triangles[i][e];
      const std::int32_t to = triangles[i][(e + 1) % 3];
      const std::int32_t low = std::min(from, to);
      uses[next[low]++] = { low, std::max(from, to), static_cast<std::int32_t>(i),
        static_cast<std::int8_t>(e), from < to };
    }
  }
  for (std::size_t p = 0; p < numberOfPoints; ++p)
  {
    std::sort(uses.begin() + start[p], uses.begin() + start[p + 1],
      [](const EdgeUse& a, const EdgeUse& b)
      { return a.High != b.High ? a.High < b.High : a.Triangle < b.Triangle; });
  }
  return uses;
}

/// Disjoint sets of triangles, with path halving.
class Pieces
{
public:
  explicit Pieces(std::size_t size)
    : Parent(size)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  std::int32_t Find(std::int32_t i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }
  void Join(std::int32_t i, std::int32_t j) { this->Parent[this->Find(i)] = this->Find(j); }

private:
  std::vector<std::int32_t> Parent;
};

struct Piece
{
  double SignedVolume = 0.0;
  Vector Low{ HUGE_VAL }, High{ -HUGE_VAL };
  bool Open = false;
};

bool StrictlyWithin(const Piece& inner, const Piece& outer)
{
  return glm::all(glm::lessThan(outer.Low, inner.Low)) &&
    glm::all(glm::lessThan(inner.High, outer.High));
}

/// Closed pieces that enclose a negative volume and are not the wall of a hollow in another piece.
std::int64_t CountInsideOut(const std::vector<Piece>& pieces)
{
  return std::count_if(pieces.begin(), pieces.end(),
    [&pieces](const Piece& piece)
    {
      return !piece.Open && piece.SignedVolume < 0.0 &&
        std::none_of(pieces.begin(), pieces.end(),
          [&piece](const Piece& outer)
          { return !outer.Open && outer.SignedVolume > 0.0 && StrictlyWithin(piece, outer); });
    });
}
}

SurfaceReport AnalyseSurface(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, Neighbours& neighbours)
{
  SurfaceReport report;
  neighbours.assign(triangles.size(), { BoundaryEdge, BoundaryEdge, BoundaryEdge });
  Pieces pieces(triangles.size());
  const std::vector<EdgeUse> uses = SortedEdgeUses(points.size(), triangles);
  std::vector<bool> open(triangles.size(), false);
  for (std::size_t first = 0, last; first < uses.size(); first = last)
  {
    last = first + 1;
    while (last < uses.size() && uses[last].Low == uses[first].Low &&
      uses[last].High == uses[first].High)
    {
      pieces.Join(uses[first].Triangle, uses[last].Triangle);
      ++last;
    }
    if (last - first == 1)
    {
      ++report.BoundaryEdges;
      open[uses[first].Triangle] = true;
    }
    else if (last - first == 2)
    {
      const EdgeUse& a = uses[first];
      const EdgeUse& b = uses[first + 1];
      neighbours[a.Triangle][a.Edge] = b.Triangle;
      neighbours[b.Triangle][b.Edge] = a.Triangle;
      report.FlippedEdges += a.Ascending == b.Ascending;
    }
    else
    {
      ++report.NonManifoldEdges;
      for (std::size_t use = first; use < last; ++use)
      {
        neighbours[uses[use].Triangle][uses[use].Edge] = NonManifoldEdge;
        open[uses[use].Triangle] = true;
      }
    }
  }

  std::vector<std::int32_t> index(triangles.size(), -1);
  std::vector<Piece> found;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    std::int32_t& piece = index[pieces.Find(static_cast<std::int32_t>(i))];
    if (piece < 0)
    {
      piece = static_cast<std::int32_t>(found.size());
      found.emplace_back();
    }
    Piece& p = found[piece];
    Vector corners[3];
    for (int k = 0; k < 3; ++k)
    {
      corners[k] = ToVector(points[triangles[i][k]]);
      p.Low = glm::min(p.Low, corners[k]);
      p.High = glm::max(p.High, corners[k]);
    }
    p.SignedVolume += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
    p.Open = p.Open || open[i];
  }
  report.Components = static_cast<std::int64_t>(found.size());
  report.Closed = report.BoundaryEdges == 0 && report.NonManifoldEdges == 0;
  report.Oriented = report.FlippedEdges == 0 && report.NonManifoldEdges == 0;
  report.InsideOutComponents = report.Oriented ? CountInsideOut(found) : 0;
  return report;
}
}
