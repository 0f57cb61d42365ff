#include "haptics/Surface/SurfaceReport.h"

#include "haptics/Math/LargePages.h"
#include "haptics/Math/ParallelFor.h"
#include "haptics/Math/VectorMath.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace haptics
{
namespace
{
using Triangles = std::vector<std::array<std::int32_t, 3>>;

/// Triangles or points that a thread takes at once.
constexpr std::size_t PieceSize = 1 << 14;

/// One triangle's use of an edge. Uses are binned by the edge's lower end point, and sorted in a
/// bin.
struct EdgeUse
{
  std::int32_t High; ///< the higher end point
  std::int32_t Use;  ///< 3 * triangle + which of its edges 0-1, 1-2, 2-0

  std::int32_t Triangle() const { return this->Use / 3; }
  std::int32_t Edge() const { return this->Use % 3; }
  bool operator<(const EdgeUse& other) const
  {
    return this->High != other.High ? this->High < other.High : this->Use < other.Use;
  }
};

/// All uses of edges by their lower end point: a counting sort by several threads. What is in a bin
/// has no order of its own, and gets one when it is sorted.
class EdgeBins
{
public:
  EdgeBins(std::size_t numberOfPoints, const Triangles& triangles, const ProgressCall& progress)
    : End(numberOfPoints + 1)
    , Uses(new EdgeUse[3 * triangles.size()])
  {
    ParallelFor(triangles.size(), PieceSize,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          const auto& t = triangles[i];
          for (int e = 0; e < 3; ++e)
          {
            this->End[std::min(t[e], t[(e + 1) % 3])].fetch_add(1, std::memory_order_relaxed);
          }
        }
      });
    // Now the number in each bin; then where it begins, and once filled where it ends.
    std::int32_t begin = 0;
    for (std::atomic<std::int32_t>& end : this->End)
    {
      begin += end.exchange(begin, std::memory_order_relaxed);
    }
    this->Filled = ParallelFor(
      triangles.size(), PieceSize,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          const auto& t = triangles[i];
          for (int e = 0; e < 3; ++e)
          {
            const auto [low, high] = std::minmax(t[e], t[(e + 1) % 3]);
            this->Uses[this->End[low].fetch_add(1, std::memory_order_relaxed)] = { high,
              static_cast<std::int32_t>(3 * i) + e };
          }
        }
      },
      progress);
  }

  /// False where it was stopped: then there is nothing to visit.
  bool IsFilled() const { return this->Filled; }

  /// Sorts the bin of a point, and calls `take(first, last)` for the uses of each of its edges.
  template <class Take>
  void VisitEdges(std::size_t point, const Take& take)
  {
    EdgeUse* first =
      this->Uses.get() + (point == 0 ? 0 : this->End[point - 1].load(std::memory_order_relaxed));
    EdgeUse* const end = this->Uses.get() + this->End[point].load(std::memory_order_relaxed);
    std::sort(first, end);
    while (first != end)
    {
      EdgeUse* last = first + 1;
      while (last != end && last->High == first->High)
      {
        ++last;
      }
      take(first, last);
      first = last;
    }
  }

private:
  std::vector<std::atomic<std::int32_t>> End;
  std::unique_ptr<EdgeUse[]> Uses; // which nobody needs to clear
  bool Filled = false;
};

/// Disjoint sets of triangles, each known by the lowest one in it, which several threads may join
/// at once (Anderson and Woll, 1991, with path halving).
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : Parent(size)
  {
    for (std::size_t i = 0; i < size; ++i)
    {
      this->Parent[i].store(static_cast<std::int32_t>(i), std::memory_order_relaxed);
    }
  }

  std::int32_t Find(std::int32_t i)
  {
    for (;;)
    {
      std::int32_t parent = this->Parent[i].load(std::memory_order_relaxed);
      const std::int32_t above = this->Parent[parent].load(std::memory_order_relaxed);
      if (parent == above)
      {
        return parent;
      }
      this->Parent[i].compare_exchange_weak(parent, above, std::memory_order_relaxed);
      i = above;
    }
  }

  void Join(std::int32_t i, std::int32_t j)
  {
    for (;;)
    {
      i = this->Find(i);
      j = this->Find(j);
      if (i == j)
      {
        return;
      }
      auto [low, high] = std::minmax(i, j);
      std::int32_t root = high;
      if (this->Parent[high].compare_exchange_strong(root, low, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

private:
  std::vector<std::atomic<std::int32_t>> Parent;
};

struct Piece
{
  double SignedVolume = 0.0;
  Vector Low{ HUGE_VAL }, High{ -HUGE_VAL };
  bool Open = false;

  void Add(const Piece& other)
  {
    this->SignedVolume += other.SignedVolume;
    this->Low = glm::min(this->Low, other.Low);
    this->High = glm::max(this->High, other.High);
    this->Open = this->Open || other.Open;
  }
};

Piece PieceOf(const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& triangle,
  const std::array<std::int32_t, 3>& neighbours)
{
  const Vector a = ToVector(points[triangle[0]]);
  const Vector b = ToVector(points[triangle[1]]);
  const Vector c = ToVector(points[triangle[2]]);
  return { glm::dot(a, glm::cross(b, c)) / 6.0, glm::min(a, glm::min(b, c)),
    glm::max(a, glm::max(b, c)), *std::min_element(neighbours.begin(), neighbours.end()) < 0 };
}

/// The pieces that triangles are connected to, in the order of their lowest triangles.
std::vector<Piece> FindPieces(const std::vector<Vec3>& points, const Triangles& triangles,
  const Neighbours& neighbours, DisjointSets& sets)
{
  // Each thread adds up triangles that follow on each other and are of one piece; sums are added in
  // the order of the triangles, so that they are the same for any number of threads.
  using Run = std::pair<std::int32_t, Piece>;
  std::vector<std::vector<Run>> runs((triangles.size() + PieceSize - 1) / PieceSize);
  ParallelFor(triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      std::vector<Run>& own = runs[first / PieceSize];
      for (std::size_t i = first; i < last; ++i)
      {
        const std::int32_t root = sets.Find(static_cast<std::int32_t>(i));
        if (own.empty() || own.back().first != root)
        {
          own.emplace_back(root, Piece());
        }
        own.back().second.Add(PieceOf(points, triangles[i], neighbours[i]));
      }
    });
  std::vector<Piece> found;
  std::unordered_map<std::int32_t, std::size_t> index;
  for (const std::vector<Run>& own : runs)
  {
    for (const auto& [root, piece] : own)
    {
      const auto [entry, isNew] = index.try_emplace(root, found.size());
      if (isNew)
      {
        found.emplace_back();
      }
      found[entry->second].Add(piece);
    }
  }
  return found;
}

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
  const std::vector<std::array<std::int32_t, 3>>& triangles, Neighbours& neighbours,
  const ProgressCall& progress)
{
  SurfaceReport report;
  ReserveLargePages(neighbours, triangles.size());
  neighbours.assign(triangles.size(), { BoundaryEdge, BoundaryEdge, BoundaryEdge });
  DisjointSets sets(triangles.size());
  {
    EdgeBins bins(points.size(), triangles, PartOf(progress, 0.2, 0.5));
    std::mutex reportMutex;
    const bool isDone = bins.IsFilled() &&
      ParallelFor(
        points.size(), PieceSize,
        [&](std::size_t firstPoint, std::size_t lastPoint)
        {
          SurfaceReport found;
          const auto take = [&](const EdgeUse* first, const EdgeUse* last)
          {
            for (const EdgeUse* use = first + 1; use < last; ++use)
            {
              sets.Join(first->Triangle(), use->Triangle());
            }
            if (last - first == 1)
            {
              ++found.BoundaryEdges;
            }
            else if (last - first == 2)
            {
              const EdgeUse& a = first[0];
              const EdgeUse& b = first[1];
              neighbours[a.Triangle()][a.Edge()] = b.Triangle();
              neighbours[b.Triangle()][b.Edge()] = a.Triangle();
              const bool isAscending = triangles[a.Triangle()][a.Edge()] != a.High;
              found.FlippedEdges += isAscending == (triangles[b.Triangle()][b.Edge()] != b.High);
            }
            else
            {
              ++found.NonManifoldEdges;
              for (const EdgeUse* use = first; use < last; ++use)
              {
                neighbours[use->Triangle()][use->Edge()] = NonManifoldEdge;
              }
            }
          };
          for (std::size_t point = firstPoint; point < lastPoint; ++point)
          {
            bins.VisitEdges(point, take);
          }
          const std::lock_guard<std::mutex> lock(reportMutex);
          report.BoundaryEdges += found.BoundaryEdges;
          report.FlippedEdges += found.FlippedEdges;
          report.NonManifoldEdges += found.NonManifoldEdges;
        },
        PartOf(progress, 0.5, 0.9));
    if (!isDone)
    {
      return report;
    }
  }
  const std::vector<Piece> pieces = FindPieces(points, triangles, neighbours, sets);
  report.Components = static_cast<std::int64_t>(pieces.size());
  report.Closed = report.BoundaryEdges == 0 && report.NonManifoldEdges == 0;
  report.Oriented = report.FlippedEdges == 0 && report.NonManifoldEdges == 0;
  report.InsideOutComponents = report.Oriented ? CountInsideOut(pieces) : 0;
  return report;
}
}
