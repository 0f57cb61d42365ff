#include "haptics/Scene/GeodesicPath.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace haptics
{
namespace
{
constexpr int CoarsePoints = 3; // on each edge of the whole surface
constexpr int FinePoints = 15;  // on each edge near the way that was found with the coarse ones
constexpr int MostSweeps = 400;
constexpr double StraightEnough = 1e-10; // of the length, gained by a sweep

double Distance(const Vec3& a, const Vec3& b)
{
  return std::sqrt(vtkMath::Distance2BetweenPoints(a.data(), b.data()));
}

Vec3 Between(const Vec3& a, const Vec3& b, double t)
{
  return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

/// Corners and points on edges, and which of them lie around a triangle. Local frame.
class Graph
{
public:
  struct Edge
  {
    std::int32_t From;
    std::int32_t To;
  };

  /// Of the triangles for which `isIn` is true.
  Graph(const TriangleSurface& surface, int pointsOnEdge, const std::vector<bool>& isIn)
    : Surface(surface)
    , PointsOnEdge(pointsOnEdge)
    , Corners(static_cast<std::int64_t>(surface.Points().size()))
    , TriangleEdges(surface.Triangles().size())
    , AroundCorner(surface.Points().size())
  {
    std::unordered_map<std::uint64_t, std::int32_t> known;
    known.reserve(2 * static_cast<std::size_t>(std::count(isIn.begin(), isIn.end(), true)));
    for (std::size_t t = 0; t < surface.Triangles().size(); ++t)
    {
      if (!isIn[t])
      {
        continue;
      }
      const Triangle& triangle = surface.Triangles()[t];
      for (std::size_t k = 0; k < 3; ++k)
      {
        const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
        const std::uint64_t key =
          static_cast<std::uint64_t>(low) << 32U | static_cast<std::uint64_t>(high);
        const auto found = known.try_emplace(key, static_cast<std::int32_t>(this->Edges.size()));
        if (found.second)
        {
          this->Edges.push_back({ low, high });
          this->AroundEdge.emplace_back();
        }
        this->TriangleEdges[t][k] = found.first->second;
        this->AroundEdge[static_cast<std::size_t>(found.first->second)].push_back(
          static_cast<std::int32_t>(t));
        this->AroundCorner[static_cast<std::size_t>(triangle[k])].push_back(
          static_cast<std::int32_t>(t));
      }
    }
  }

  bool IsCorner(std::int64_t node) const { return node < this->Corners; }
  const Edge& EdgeOf(std::int64_t node) const { return this->Edges[this->EdgeIndex(node)]; }
  double PlaceOnEdge(std::int64_t node) const
  {
    return (1.0 + static_cast<double>((node - this->Corners) % this->PointsOnEdge)) /
      (this->PointsOnEdge + 1.0);
  }
  Vec3 Position(std::int64_t node) const
  {
    const std::vector<Vec3>& points = this->Surface.Points();
    if (this->IsCorner(node))
    {
      return points[static_cast<std::size_t>(node)];
    }
    const Edge& edge = this->EdgeOf(node);
    return Between(points[static_cast<std::size_t>(edge.From)],
      points[static_cast<std::size_t>(edge.To)], this->PlaceOnEdge(node));
  }
  const std::vector<std::int32_t>& TrianglesAround(std::int64_t node) const
  {
    return this->IsCorner(node) ? this->AroundCorner[static_cast<std::size_t>(node)]
                                : this->AroundEdge[this->EdgeIndex(node)];
  }
  template <class Visit>
  void VisitNodesOf(std::int32_t triangle, Visit visit) const
  {
    const auto t = static_cast<std::size_t>(triangle);
    for (std::size_t k = 0; k < 3; ++k)
    {
      visit(static_cast<std::int64_t>(this->Surface.Triangles()[t][k]));
      for (int i = 0; i < this->PointsOnEdge; ++i)
      {
        visit(this->Corners + std::int64_t{ this->TriangleEdges[t][k] } * this->PointsOnEdge + i);
      }
    }
  }

private:
  std::size_t EdgeIndex(std::int64_t node) const
  {
    return static_cast<std::size_t>((node - this->Corners) / this->PointsOnEdge);
  }

  const TriangleSurface& Surface;
  int PointsOnEdge;
  std::int64_t Corners;
  std::vector<Edge> Edges;
  std::vector<std::array<std::int32_t, 3>> TriangleEdges;
  std::vector<std::vector<std::int32_t>> AroundEdge;
  std::vector<std::vector<std::int32_t>> AroundCorner;
};

/// The nodes of a shortest way through the graph, from one end to the other; empty: there is none.
std::vector<std::int64_t> FindNodes(const Graph& graph, std::int32_t fromTriangle, const Vec3& from,
  std::int32_t toTriangle, const Vec3& to)
{
  struct Reached
  {
    double Length;
    std::int64_t Before;
  };
  struct Candidate
  {
    double Bound; // length so far and the straight rest
    std::int64_t Node;
    bool operator<(const Candidate& other) const { return this->Bound > other.Bound; }
  };
  std::unordered_map<std::int64_t, Reached> reached;
  std::priority_queue<Candidate> queue;
  const auto offer = [&](std::int64_t node, double length, std::int64_t before)
  {
    const auto found = reached.try_emplace(node, Reached{ length, before });
    if (found.second || length < found.first->second.Length)
    {
      found.first->second = { length, before };
      queue.push({ length + Distance(graph.Position(node), to), node });
    }
  };
  graph.VisitNodesOf(fromTriangle,
    [&](std::int64_t node) { offer(node, Distance(from, graph.Position(node)), -1); });
  while (!queue.empty())
  {
    const Candidate next = queue.top();
    queue.pop();
    const Vec3 here = graph.Position(next.Node);
    const double length = reached.at(next.Node).Length;
    if (next.Bound > length + Distance(here, to))
    {
      continue; // reached by a shorter way since
    }
    for (const std::int32_t triangle : graph.TrianglesAround(next.Node))
    {
      if (triangle == toTriangle) // the bound is exact, so no other way is shorter
      {
        std::vector<std::int64_t> nodes;
        for (std::int64_t node = next.Node; node >= 0; node = reached.at(node).Before)
        {
          nodes.push_back(node);
        }
        std::reverse(nodes.begin(), nodes.end());
        return nodes;
      }
      graph.VisitNodesOf(triangle,
        [&](std::int64_t node)
        {
          if (node != next.Node)
          {
            offer(node, length + Distance(here, graph.Position(node)), next.Node);
          }
        });
    }
  }
  return {};
}

/// Where the straight way between two points crosses an edge when the triangles are unfolded.
Vec3 Cross(const Vec3& before, const Vec3& after, const Vec3& from, const Vec3& to)
{
  const double length = Distance(from, to);
  const auto foot = [&](const Vec3& point, double& along, double& away)
  {
    along = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      along += (point[i] - from[i]) * (to[i] - from[i]);
    }
    along /= length * length;
    away = Distance(point, Between(from, to, along));
  };
  double t0 = 0.0;
  double d0 = 0.0;
  double t1 = 0.0;
  double d1 = 0.0;
  foot(before, t0, d0);
  foot(after, t1, d1);
  const double t = d0 + d1 > 0.0 ? t0 + (t1 - t0) * d0 / (d0 + d1) : 0.5 * (t0 + t1);
  return Between(from, to, std::clamp(t, 0.0, 1.0));
}

double Length(const std::vector<Vec3>& points)
{
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    length += Distance(points[i - 1], points[i]);
  }
  return length;
}

/// Slides every crossing along its edge; points[i + 1] is where nodes[i] is.
void Straighten(const TriangleSurface& surface, const Graph& graph,
  const std::vector<std::int64_t>& nodes, std::vector<Vec3>& points)
{
  double before = Length(points);
  for (int sweep = 0; sweep < MostSweeps; ++sweep)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      if (!graph.IsCorner(nodes[i]))
      {
        const Graph::Edge& edge = graph.EdgeOf(nodes[i]);
        points[i + 1] =
          Cross(points[i], points[i + 2], surface.Points()[static_cast<std::size_t>(edge.From)],
            surface.Points()[static_cast<std::size_t>(edge.To)]);
      }
    }
    const double after = Length(points);
    if (before - after <= StraightEnough * before)
    {
      return;
    }
    before = after;
  }
}

/// The triangles at the nodes of a way, and those that share a corner with them.
std::vector<bool> Surroundings(
  const TriangleSurface& surface, const Graph& graph, const std::vector<std::int64_t>& nodes)
{
  std::vector<bool> isNear(surface.Points().size(), false);
  for (const std::int64_t node : nodes)
  {
    for (const std::int32_t triangle : graph.TrianglesAround(node))
    {
      for (const std::int32_t corner : surface.Triangles()[static_cast<std::size_t>(triangle)])
      {
        isNear[static_cast<std::size_t>(corner)] = true;
      }
    }
  }
  std::vector<bool> isIn(surface.Triangles().size());
  std::transform(surface.Triangles().begin(), surface.Triangles().end(), isIn.begin(),
    [&isNear](const Triangle& triangle)
    {
      return std::any_of(triangle.begin(), triangle.end(),
        [&isNear](std::int32_t corner) { return isNear[static_cast<std::size_t>(corner)]; });
    });
  return isIn;
}

/// A way through the graph's nodes, straightened.
std::vector<Vec3> FindWay(const TriangleSurface& surface, const Graph& graph,
  const std::vector<std::int64_t>& nodes, const Vec3& from, const Vec3& to)
{
  std::vector<Vec3> points{ from };
  for (const std::int64_t node : nodes)
  {
    points.push_back(graph.Position(node));
  }
  points.push_back(to);
  Straighten(surface, graph, nodes, points);
  return points;
}
}

GeodesicPath FindGeodesicPath(
  const TriangleSurface& surface, const SurfacePoint& from, const SurfacePoint& to)
{
  GeodesicPath path;
  const Vec3& origin = surface.Origin();
  const auto local = [&](const Vec3& p) -> Vec3 {
    return { p[0] - origin[0], p[1] - origin[1], p[2] - origin[2] };
  };
  const Vec3 begin = local(from.Position);
  const Vec3 end = local(to.Position);
  path.Points = { begin, end };
  if (from.Triangle != to.Triangle)
  {
    std::vector<bool> isIn(surface.Triangles().size(), true);
    const Graph coarse(surface, CoarsePoints, isIn);
    std::vector<std::int64_t> nodes = FindNodes(coarse, from.Triangle, begin, to.Triangle, end);
    if (nodes.empty())
    {
      return { std::numeric_limits<double>::infinity(), {} };
    }
    path.Points = FindWay(surface, coarse, nodes, begin, end);

    // The coarse points may take it round the wrong side of a corner, where no sliding helps.
    const Graph fine(surface, FinePoints, Surroundings(surface, coarse, nodes));
    nodes = FindNodes(fine, from.Triangle, begin, to.Triangle, end);
    std::vector<Vec3> points = FindWay(surface, fine, nodes, begin, end);
    if (!nodes.empty() && Length(points) < Length(path.Points))
    {
      path.Points = std::move(points);
    }
  }
  path.Length = Length(path.Points);
  for (Vec3& point : path.Points)
  {
    point = { point[0] + origin[0], point[1] + origin[1], point[2] + origin[2] };
  }
  return path;
}
}
