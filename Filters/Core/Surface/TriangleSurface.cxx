#include "haptics/Surface/TriangleSurface.h"

#include "haptics/Math/CoordinateRange.h"
#include "haptics/Math/ParallelFor.h"
#include "haptics/Surface/Facet.h"
#include "haptics/Surface/TriangleBounds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <mutex>

namespace haptics
{
namespace
{
/// Points or triangles that a thread takes at once.
constexpr std::size_t PieceSize = 1 << 15;

/// The first index for which `isBad`, or `count`.
template <class Predicate>
std::size_t FirstBad(std::size_t count, const Predicate& isBad)
{
  std::atomic<std::size_t> firstBad{ count };
  ParallelFor(count, PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      std::size_t i = first;
      while (i < last && !isBad(i))
      {
        ++i;
      }
      std::size_t known = firstBad;
      while (i < last && i < known && !firstBad.compare_exchange_weak(known, i))
      {
      }
    });
  return firstBad;
}

///@{
/// The share of the time that the steps of a build have taken.
constexpr double ProgressOfMeasure = 0.1;
constexpr double ProgressOfTopology = 0.3;
///@}

std::string FindFault(const TriangleMesh& mesh, const SurfaceOptions& options)
{
  if (mesh.Triangles.empty() && !options.Whole)
  {
    return "the surface has no triangle";
  }
  if (options.Whole && mesh.Ids.size() != mesh.Triangles.size())
  {
    return std::to_string(mesh.Ids.size()) + " ids were given for " +
      std::to_string(mesh.Triangles.size()) + " triangles of a patch";
  }
  if (options.Whole && !(options.Whole->Radius > 0.0 && options.Region.Radius > 0.0))
  {
    return "a patch needs the radius of its surface, and one of its own, above 0";
  }
  if (options.DeformDuration &&
    (!options.Whole || options.Whole->Before == 0 || mesh.Starts.size() != mesh.Points.size()))
  {
    return "a patch deforms from another shape of its surface, and needs as many starts as points";
  }
  if (options.DeformDuration && options.Engine == EngineKind::Exact)
  {
    return "the exact engine cannot follow points that move: build the surface with another";
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
  const std::size_t badPoint = FirstBad(mesh.Points.size(),
    [&](std::size_t i) {
      return !IsInRange(mesh.Points[i]) || (options.DeformDuration && !IsInRange(mesh.Starts[i]));
    });
  if (badPoint < mesh.Points.size())
  {
    return "point " + std::to_string(badPoint) + " is not finite, or beyond 1e70";
  }
  const auto isNoPoint = [&mesh](std::int32_t corner)
  { return corner < 0 || static_cast<std::size_t>(corner) >= mesh.Points.size(); };
  const std::size_t badTriangle = FirstBad(mesh.Triangles.size(),
    [&](std::size_t i)
    {
      const Triangle& t = mesh.Triangles[i];
      return isNoPoint(t[0]) || isNoPoint(t[1]) || isNoPoint(t[2]);
    });
  if (badTriangle < mesh.Triangles.size())
  {
    const Triangle& t = mesh.Triangles[badTriangle];
    return "triangle " + std::to_string(badTriangle) + " names point " +
      std::to_string(*std::find_if(t.begin(), t.end(), isNoPoint)) + ", which is not one of the " +
      std::to_string(mesh.Points.size());
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
  std::mutex mutex;
  Vector low(HUGE_VAL);
  Vector high(-HUGE_VAL);
  ParallelFor(mesh.Triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      TriangleBounds bounds = BoundsOf(mesh.Points, mesh.Triangles[first]);
      for (std::size_t i = first + 1; i < last; ++i)
      {
        const TriangleBounds more = BoundsOf(mesh.Points, mesh.Triangles[i]);
        bounds = { glm::min(bounds.Low, more.Low), glm::max(bounds.High, more.High) };
      }
      const std::lock_guard<std::mutex> lock(mutex);
      low = glm::min(low, bounds.Low);
      high = glm::max(high, bounds.High);
    });
  const Vector middle = low + 0.5 * (high - low);
  std::atomic<bool> isRounded[3]{};
  ParallelFor(mesh.Triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        for (const std::int32_t corner : mesh.Triangles[i])
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            if (!IsExactDifference(mesh.Points[corner][axis], middle[axis]))
            {
              isRounded[axis].store(true, std::memory_order_relaxed);
            }
          }
        }
        if (isRounded[0] && isRounded[1] && isRounded[2])
        {
          return;
        }
      }
    });
  Vector shift;
  for (int axis = 0; axis < 3; ++axis)
  {
    shift[axis] = isRounded[axis] ? 0.0 : middle[axis];
  }
  origin = ToVec3(shift);
  const double radius = RadiusAbout(shift, low, high);
  ParallelFor(mesh.Points.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        Vec3& p = mesh.Points[i];
        p = ToVec3(WithoutNegligible(ToVector(p) - shift, NegligibleShare * radius));
      }
    });
  return radius;
}

/// See TriangleSurface::Clearance().
double ClearanceOf(double radius, double crackWidth)
{
  return std::max(1024.0 * UnitRoundoff * radius, 0.25 * std::min(crackWidth, radius));
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
    encloses.OneSided = isClosed && side == Side::Front ? Encloser::Front : Encloser::None;
    encloses.TwoSided = isClosed && side == Side::Both ? Encloser::Both : Encloser::None;
    return side;
  }
  std::vector<Triangle> oneSided;
  std::vector<Triangle> twoSided;
  topology.HasBack.reserve(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const bool hasBack = asked[i] == Side::Both;
    topology.HasBack.push_back(hasBack);
    (hasBack ? twoSided : oneSided).push_back(topology.Triangles[i]);
  }
  encloses.OneSided = Enclose(points, oneSided) ? Encloser::Front : Encloser::None;
  encloses.TwoSided = Enclose(points, twoSided) ? Encloser::Both : Encloser::None;
  if (isClosed && encloses == Enclosure())
  {
    // A solid some of whose walls hold what is inside: through the others it can leave.
    encloses.OneSided = encloses.TwoSided = Encloser::Front;
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
  std::mutex mutex;
  double squaredRadius = 0.0;
  double squaredEdge = 0.0;
  Vector low(HUGE_VAL);
  Vector high(-HUGE_VAL);
  const std::vector<Vec3>& points = this->Points();
  const std::vector<Triangle>& triangles = this->Triangles();
  ParallelFor(triangles.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      double radius = 0.0;
      double edge = 0.0;
      Vector lowest(HUGE_VAL);
      Vector highest(-HUGE_VAL);
      for (std::size_t i = first; i < last; ++i)
      {
        const Triangle& t = triangles[i];
        const Vector a = ToVector(points[t[0]]);
        const Vector b = ToVector(points[t[1]]);
        const Vector c = ToVector(points[t[2]]);
        radius = std::max({ radius, SquaredLength(a), SquaredLength(b), SquaredLength(c) });
        lowest = glm::min(lowest, glm::min(a, glm::min(b, c)));
        highest = glm::max(highest, glm::max(a, glm::max(b, c)));
        const double longest =
          std::max({ SquaredLength(c - b), SquaredLength(a - c), SquaredLength(b - a) });
        // Whether it has an area is asked of those few that are longer than all before.
        if (longest > edge && Facet(a, b, c).HasArea())
        {
          edge = longest;
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      squaredRadius = std::max(squaredRadius, radius);
      squaredEdge = std::max(squaredEdge, edge);
      low = glm::min(low, lowest);
      high = glm::max(high, highest);
    });
  this->SurfaceDiagonal = glm::length(high - low);
  this->EndLongestEdge = std::sqrt(squaredEdge);
  this->EndRadius = std::sqrt(squaredRadius) * (1.0 + 0x1p-40);
  this->LongestEdge = std::max(this->EndLongestEdge, start ? start->EndLongestEdge : 0.0);
  if (start)
  {
    this->SurfaceRadius = std::max(this->EndRadius, start->EndRadius);
  }
  this->MinimumClearance = ClearanceOf(this->SurfaceRadius, this->CrackWidth);
  return this->EndLongestEdge > 0.0;
}

void TriangleSurface::TakeFrame(TriangleMesh& mesh, const SurfaceOptions& options)
{
  const WholeSurface& whole = *options.Whole;
  const Vector origin = ToVector(whole.Origin);
  const double negligible =
    whole.Negligible > 0.0 ? whole.Negligible : NegligibleShare * whole.Radius;
  for (std::vector<Vec3>* const points : { &mesh.Points, &mesh.Starts })
  {
    for (Vec3& p : *points)
    {
      p = ToVec3(WithoutNegligible(ToVector(p) - origin, negligible));
    }
  }
  this->SurfaceOrigin = whole.Origin;
  this->SurfaceRadius = whole.Radius;
  this->EndRadius = whole.Radius;
  this->SurfaceDiagonal = whole.Diagonal;
  this->LongestEdge = whole.LongestEdge;
  this->EndLongestEdge = whole.LongestEdge;
  this->CrackWidth = whole.CrackWidth;
  this->MinimumClearance = ClearanceOf(whole.Radius, whole.CrackWidth);
  PatchRegion region = options.Region;
  region.From = ToVec3(ToVector(region.From) - origin);
  region.To = ToVec3(ToVector(region.To) - origin);
  PatchEnclosure enclosure = options.Enclosure;
  enclosure.Anchor = ToVec3(ToVector(enclosure.Anchor) - origin);
  enclosure.Middle = ToVec3(ToVector(enclosure.Middle) - origin);
  // What reaches beyond itself by as much may be missing at the region's rim.
  this->Part = std::make_shared<const SurfacePatch>(options.Whole, region, enclosure,
    2.0 * LargestGrowth(this->MinimumClearance, whole.LongestEdge), mesh.Ids);
}

std::int32_t TriangleSurface::FindSame(
  const TriangleSurface& other, std::int32_t triangle) const noexcept
{
  const bool follows = this->FollowsAsPatch(other);
  if (!follows && !this->IsOfSameWhole(other))
  {
    return -1;
  }
  const std::vector<Vec3>& points = follows ? *this->Start : this->Points();
  const std::int32_t found = this->Part->Find(other.Part->IdOf(triangle));
  if (found < 0)
  {
    return -1;
  }
  const Triangle& mine = this->Triangles()[found];
  const Triangle& theirs = other.Triangles()[triangle];
  const bool isSame = std::equal(mine.begin(), mine.end(), theirs.begin(),
    [&](std::int32_t a, std::int32_t b) { return points[a] == other.Points()[b]; });
  return isSame ? found : -1;
}

bool TriangleSurface::GoesOnFrom(const TriangleSurface& previous) const
{
  if (!this->FollowsAsPatch(previous))
  {
    return false;
  }
  // At a rim, of points of different parts that are one another one may have been kept.
  const auto isWithin = [&](const Vec3& p)
  { return this->Part->Knows(p) && previous.Part->Knows(p); };
  for (std::size_t i = 0; i < previous.Triangles().size(); ++i)
  {
    const std::int32_t same = this->Part->Find(previous.Part->IdOf(static_cast<std::int32_t>(i)));
    for (int k = 0; k < 3 && same >= 0; ++k)
    {
      const Vec3& before = previous.Points()[previous.Triangles()[i][k]];
      if (isWithin(before) && (*this->Start)[this->Triangles()[same][k]] != before)
      {
        return false;
      }
    }
  }
  return true;
}

std::shared_ptr<const TriangleSurface> TriangleSurface::AtRest() const
{
  // What the engine finds wherever triangles pass includes where they are.
  std::shared_ptr<TriangleSurface> resting(new TriangleSurface);
  const std::uint64_t number = resting->Number;
  *resting = *this;
  resting->Number = number;
  resting->Predecessor = 0;
  resting->Start = nullptr;
  resting->Duration = 0.0;
  return resting;
}

WholeSurface TriangleSurface::Whole() const
{
  if (this->Part)
  {
    return this->Part->Whole();
  }
  WholeSurface whole;
  whole.Origin = this->SurfaceOrigin;
  whole.Radius = this->SurfaceRadius;
  whole.Diagonal = this->SurfaceDiagonal;
  whole.LongestEdge = this->LongestEdge;
  whole.CrackWidth = this->CrackWidth;
  whole.Report = this->Report();
  whole.Triangles = static_cast<std::int64_t>(this->Triangles().size());
  whole.Version = this->Number;
  return whole;
}

EngineInput TriangleSurface::Input() const
{
  return { this->Points(), this->Triangles(), this->SurfaceRadius,
    LargestGrowth(this->MinimumClearance, this->LongestEdge), this->StartPoints() };
}

std::shared_ptr<const TriangleSurface> TriangleSurface::Build(TriangleMesh mesh,
  const SurfaceOptions& options, std::string& error, const ProgressCall& progress)
{
  error = FindFault(mesh, options);
  if (!error.empty())
  {
    return nullptr;
  }
  std::shared_ptr<TriangleSurface> surface(new TriangleSurface);
  if (options.Whole)
  {
    surface->TakeFrame(mesh, options);
  }
  else
  {
    surface->SurfaceRadius = Recentre(mesh, surface->SurfaceOrigin);
    surface->CrackWidth = options.CrackWidth;
  }
  surface->LocalPoints = std::make_shared<const std::vector<Vec3>>(std::move(mesh.Points));
  if (options.DeformDuration)
  {
    surface->Start = std::make_shared<const std::vector<Vec3>>(std::move(mesh.Starts));
    surface->Duration = *options.DeformDuration;
  }
  const auto topology = std::make_shared<Topology>();
  topology->Triangles = std::move(mesh.Triangles);
  surface->Shared = topology;
  if (!options.Whole && !surface->Measure(nullptr))
  {
    error = "no triangle of the surface has an area";
    return nullptr;
  }
  bool isStopped = false;
  const ProgressCall goOn = [&](double fraction)
  {
    isStopped = isStopped || !ReportProgress(progress, fraction);
    return !isStopped;
  };
  topology->Found = AnalyseSurface(surface->Points(), topology->Triangles, topology->Adjacent,
    PartOf(goOn, ProgressOfMeasure, ProgressOfTopology));
  if (isStopped)
  {
    return nullptr;
  }
  if (options.Whole)
  {
    topology->Found = options.Whole->Report;
  }
  const bool isUniform = mesh.Sides.empty();
  surface->ActualSide =
    ChooseSides(surface->Points(), std::move(mesh.Sides), options.TouchedSide, *topology);
  const bool isCounted =
    options.Enclosure.IsCounted && !(options.DeformDuration && options.Enclosure.IsSwept);
  if (options.Whole && !(isCounted && isUniform))
  {
    topology->Encloses = Enclosure(); // by the triangles of a patch alone it cannot be counted
  }
  EngineInput input = surface->Input();
  input.Progress = PartOf(goOn, ProgressOfTopology, 1.0);
  surface->Collision = MakeEngine(options.Engine, input);
  if (isStopped)
  {
    return nullptr;
  }
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
