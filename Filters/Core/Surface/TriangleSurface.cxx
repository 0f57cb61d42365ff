#include "haptics/Surface/TriangleSurface.h"

#include "haptics/Surface/Facet.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

namespace haptics
{
namespace
{
std::string FindFault(const TriangleMesh& mesh, const SurfaceOptions& options)
{
  if (mesh.Triangles.empty())
  {
    return "the surface has no triangle";
  }
  if (!std::isfinite(options.CrackWidth) || options.CrackWidth < 0.0)
  {
    return "the crack width must be finite and not negative";
  }
  if (!mesh.Sides.empty() && mesh.Sides.size() != mesh.Triangles.size())
  {
    return std::to_string(mesh.Sides.size()) + " sides were given for " +
      std::to_string(mesh.Triangles.size()) + " triangles";
  }
  const auto isMixed = [](Side side) { return side == Side::Mixed; };
  if (isMixed(options.TouchedSide) || std::any_of(mesh.Sides.begin(), mesh.Sides.end(), isMixed))
  {
    return "the side to touch must be Front, Both or Automatic";
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Vec3& p = mesh.Points[i];
    // Not less is also how NaN answers.
    if (!(std::abs(p[0]) < LargestCoordinate && std::abs(p[1]) < LargestCoordinate &&
          std::abs(p[2]) < LargestCoordinate))
    {
      return "point " + std::to_string(i) + " is not finite, or beyond 1e70";
    }
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (const std::int32_t corner : mesh.Triangles[i])
    {
      if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.Points.size())
      {
        return "triangle " + std::to_string(i) + " names point " + std::to_string(corner) +
          ", which is not one of the " + std::to_string(mesh.Points.size());
      }
    }
  }
  return {};
}

/// Whether a - b has no rounding (Knuth's two-sum).
bool IsExactDifference(double a, double b)
{
  const double difference = a - b;
  const double minusB = difference - a;
  return a - (difference - minusB) == 0.0 && b + minusB == 0.0;
}

/// Moves the origin to the middle of the used points, in each coordinate in which that rounds none
/// of them: so it is where the middle is twice as far out as they reach from it (Sterbenz), and
/// where they have few digits. A triangle as thin as rounding would not be the same after it.
/// Returns a bound on their distance from the origin.
double Recentre(TriangleMesh& mesh, Vec3& origin)
{
  Vector low(HUGE_VAL);
  Vector high(-HUGE_VAL);
  for (const Triangle& t : mesh.Triangles)
  {
    for (const std::int32_t corner : t)
    {
      const Vector p = ToVector(mesh.Points[corner]);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const Vector middle = low + 0.5 * (high - low);
  Vector shift = middle;
  for (const Triangle& t : mesh.Triangles)
  {
    for (const std::int32_t corner : t)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        if (!IsExactDifference(mesh.Points[corner][axis], shift[axis]))
        {
          shift[axis] = 0.0;
        }
      }
    }
  }
  origin = ToVec3(shift);
  const double radius =
    (0.5 * glm::length(high - low) + glm::length(middle - shift)) * (1.0 + 0x1p-40);
  for (Vec3& p : mesh.Points)
  {
    p = ToVec3(WithoutNegligible(ToVector(p) - shift, NegligibleShare * radius));
  }
  return radius;
}

/// Whether these triangles alone are a surface that encloses space.
bool Enclose(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
{
  Neighbours neighbours;
  const SurfaceReport found = AnalyseSurface(points, triangles, neighbours);
  return found.Closed && found.Oriented;
}
}

Side TriangleSurface::ChooseSides(
  const std::vector<Vec3>& points, std::vector<Side> asked, Side forAll, Topology& topology)
{
  const SurfaceReport& found = topology.Found;
  Enclosure& encloses = topology.Encloses;
  const bool isClosed = found.Closed && found.Oriented;
  const Side automatic = isClosed && found.InsideOutComponents == 0 ? Side::Front : Side::Both;
  std::replace(asked.begin(), asked.end(), Side::Automatic, automatic);
  if (std::adjacent_find(asked.begin(), asked.end(), std::not_equal_to<>()) == asked.end())
  {
    const Side side = !asked.empty() ? asked.front()
      : forAll == Side::Automatic    ? automatic
                                     : forAll;
    encloses.Fronts = isClosed && side == Side::Front ? Encloser::Front : Encloser::None;
    encloses.Boths = isClosed && side == Side::Both ? Encloser::Both : Encloser::None;
    return side;
  }
  std::vector<Triangle> fronts;
  std::vector<Triangle> boths;
  topology.HasBack.reserve(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const bool hasBack = asked[i] == Side::Both;
    topology.HasBack.push_back(hasBack);
    (hasBack ? boths : fronts).push_back(topology.Triangles[i]);
  }
  encloses.Fronts = Enclose(points, fronts) ? Encloser::Front : Encloser::None;
  encloses.Boths = Enclose(points, boths) ? Encloser::Both : Encloser::None;
  if (isClosed && encloses == Enclosure())
  {
    // A solid some of whose walls hold what is inside: through the others it can leave.
    encloses.Fronts = encloses.Boths = Encloser::Front;
  }
  return Side::Mixed;
}

TriangleSurface::TriangleSurface()
{
  static std::atomic<std::uint64_t> last{ 0 };
  this->Number = ++last;
}

bool TriangleSurface::Measure(const TriangleSurface* start)
{
  double squaredRadius = 0.0;
  double squaredEdge = 0.0;
  Vector low(HUGE_VAL);
  Vector high(-HUGE_VAL);
  const std::vector<Vec3>& points = this->Points();
  for (const Triangle& t : this->Triangles())
  {
    const Vector a = ToVector(points[t[0]]);
    const Vector b = ToVector(points[t[1]]);
    const Vector c = ToVector(points[t[2]]);
    squaredRadius =
      std::max({ squaredRadius, SquaredLength(a), SquaredLength(b), SquaredLength(c) });
    low = glm::min(low, glm::min(a, glm::min(b, c)));
    high = glm::max(high, glm::max(a, glm::max(b, c)));
    const double longest =
      std::max({ SquaredLength(c - b), SquaredLength(a - c), SquaredLength(b - a) });
    // Whether it has an area is asked of those few that are longer than all before.
    if (longest > squaredEdge && Facet(a, b, c).HasArea())
    {
      squaredEdge = longest;
    }
  }
  this->SurfaceDiagonal = glm::length(high - low);
  this->EndLongestEdge = std::sqrt(squaredEdge);
  this->EndRadius = std::sqrt(squaredRadius) * (1.0 + 0x1p-40);
  this->LongestEdge = std::max(this->EndLongestEdge, start ? start->EndLongestEdge : 0.0);
  if (start)
  {
    this->SurfaceRadius = std::max(this->EndRadius, start->EndRadius);
  }
  this->MinimumClearance = std::max(1024.0 * UnitRoundoff * this->SurfaceRadius,
    0.25 * std::min(this->CrackWidth, this->SurfaceRadius));
  return this->EndLongestEdge > 0.0;
}

EngineInput TriangleSurface::Input() const
{
  return { this->Points(), this->Triangles(), this->SurfaceRadius,
    LargestGrowth(this->MinimumClearance, this->LongestEdge), this->StartPoints() };
}

std::shared_ptr<const TriangleSurface> TriangleSurface::Build(
  TriangleMesh mesh, const SurfaceOptions& options, std::string& error)
{
  error = FindFault(mesh, options);
  if (!error.empty())
  {
    return nullptr;
  }
  std::shared_ptr<TriangleSurface> surface(new TriangleSurface);
  surface->SurfaceRadius = Recentre(mesh, surface->SurfaceOrigin);
  surface->CrackWidth = options.CrackWidth;
  surface->LocalPoints = std::make_shared<const std::vector<Vec3>>(std::move(mesh.Points));
  const auto topology = std::make_shared<Topology>();
  topology->Triangles = std::move(mesh.Triangles);
  surface->Shared = topology;
  if (!surface->Measure(nullptr))
  {
    error = "no triangle of the surface has an area";
    return nullptr;
  }
  topology->Found = AnalyseSurface(surface->Points(), topology->Triangles, topology->Adjacent);
  surface->Touched =
    ChooseSides(surface->Points(), std::move(mesh.Sides), options.TouchedSide, *topology);
  surface->Collision = MakeEngine(options.Engine, surface->Input());
  if (!surface->Collision)
  {
    error = options.Engine == EngineKind::Exact
      ? "the exact engine is in the library HapticsExactEngineGPL, which is not loaded"
      : "memory ran out while the collision engine was built";
    return nullptr;
  }
  return surface;
}

TriangleSurface::~TriangleSurface() = default;

std::size_t TriangleSurface::MemoryBytes() const
{
  return sizeof(*this) + (this->Deforms() ? 2 : 1) * this->Points().capacity() * sizeof(Vec3) +
    this->Triangles().capacity() * sizeof(Triangle) +
    this->AdjacentTriangles().capacity() * sizeof(Neighbours::value_type) +
    this->Shared->HasBack.capacity() + this->Collision->MemoryBytes();
}
}
