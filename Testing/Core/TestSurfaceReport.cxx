// The topology that several threads find, against one edge after the other.
#include "AnalyticSurfaces.h"
#include "haptics/Surface/SurfaceReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <utility>

using namespace haptics;
using namespace haptics::testing;

namespace
{
struct Use
{
  std::int32_t Triangle;
  int Edge;
  bool IsAscending;
};

SurfaceReport LookAtEachEdge(const TriangleMesh& mesh, Neighbours& neighbours)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Use>> edges;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (int e = 0; e < 3; ++e)
    {
      const std::int32_t a = mesh.Triangles[i][e];
      const std::int32_t b = mesh.Triangles[i][(e + 1) % 3];
      edges[std::minmax(a, b)].push_back({ static_cast<std::int32_t>(i), e, a < b });
    }
  }
  SurfaceReport report;
  neighbours.assign(mesh.Triangles.size(), { BoundaryEdge, BoundaryEdge, BoundaryEdge });
  std::vector<std::int32_t> piece(mesh.Triangles.size());
  std::iota(piece.begin(), piece.end(), 0);
  const auto find = [&piece](std::int32_t i)
  {
    while (piece[i] != i)
    {
      i = piece[i] = piece[piece[i]];
    }
    return i;
  };
  for (const auto& [ends, uses] : edges)
  {
    for (const Use& use : uses)
    {
      piece[find(use.Triangle)] = find(uses.front().Triangle);
      neighbours[use.Triangle][use.Edge] = uses.size() > 2 ? NonManifoldEdge : BoundaryEdge;
    }
    report.BoundaryEdges += uses.size() == 1;
    report.NonManifoldEdges += uses.size() > 2;
    if (uses.size() == 2)
    {
      report.FlippedEdges += uses[0].IsAscending == uses[1].IsAscending;
      neighbours[uses[0].Triangle][uses[0].Edge] = uses[1].Triangle;
      neighbours[uses[1].Triangle][uses[1].Edge] = uses[0].Triangle;
    }
  }
  std::set<std::int32_t> roots;
  for (std::size_t i = 0; i < piece.size(); ++i)
  {
    roots.insert(find(static_cast<std::int32_t>(i)));
  }
  report.Components = static_cast<std::int64_t>(roots.size());
  return report;
}

void ExpectRightReport(const TriangleMesh& mesh)
{
  Neighbours found;
  Neighbours right;
  const SurfaceReport report = AnalyseSurface(mesh.Points, mesh.Triangles, found);
  const SurfaceReport expected = LookAtEachEdge(mesh, right);
  EXPECT_EQ(found, right);
  EXPECT_EQ(report.BoundaryEdges, expected.BoundaryEdges);
  EXPECT_EQ(report.NonManifoldEdges, expected.NonManifoldEdges);
  EXPECT_EQ(report.FlippedEdges, expected.FlippedEdges);
  EXPECT_EQ(report.Components, expected.Components);
}
}

TEST(SurfaceReport, IsThatOfALookAtEachEdge)
{
  std::mt19937 random(1);
  TriangleMesh mesh = Icosphere(6, 1.0); // 81,920 triangles: several threads' work
  ExpectRightReport(mesh);
  std::shuffle(mesh.Triangles.begin(), mesh.Triangles.end(), random);
  ExpectRightReport(mesh);
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 97)
  {
    std::swap(mesh.Triangles[i][0], mesh.Triangles[i][1]); // flipped
  }
  for (std::size_t i = 5; i < mesh.Triangles.size(); i += 101)
  {
    mesh.Triangles.push_back(mesh.Triangles[i]); // edges of three and four
  }
  mesh.Triangles.erase(mesh.Triangles.begin(), mesh.Triangles.begin() + 3000); // holes
  ExpectRightReport(mesh);
}

TEST(SurfaceReport, CountsPiecesOfManyThreads)
{
  TriangleMesh mesh;
  for (int i = 0; i < 500; ++i)
  {
    mesh = Joined(std::move(mesh), Moved(Icosphere(2, 1.0), { 3.0 * i, 0, 0 }));
  }
  mesh = Joined(std::move(mesh), InsideOut(Moved(Icosphere(2, 1.0), { -3.0, 0, 0 })));
  mesh = Joined(std::move(mesh), InsideOut(Icosphere(2, 0.5))); // a hollow
  ExpectRightReport(mesh);
  std::mt19937 random(2);
  std::shuffle(mesh.Triangles.begin(), mesh.Triangles.end(), random);
  Neighbours neighbours;
  const SurfaceReport report = AnalyseSurface(mesh.Points, mesh.Triangles, neighbours);
  EXPECT_EQ(report.Components, 502);
  EXPECT_EQ(report.InsideOutComponents, 1);
}

/// At each of the calls in turn: nothing of what was not done yet may be looked at.
TEST(SurfaceReport, EndsWhereItIsStopped)
{
  const TriangleMesh mesh = Icosphere(6, 1.0);
  for (int calls = 1; calls < 8; ++calls)
  {
    int made = 0;
    double last = 0.0;
    Neighbours neighbours;
    AnalyseSurface(mesh.Points, mesh.Triangles, neighbours,
      [&](double fraction)
      {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        return ++made < calls;
      });
    EXPECT_LE(made, calls);
  }
}
