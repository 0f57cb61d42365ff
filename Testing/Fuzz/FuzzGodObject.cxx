// Any surfaces, any path, a point or a ball: every piece of the way is checked with exact
// arithmetic.
#include "ExactQueries.h"
#include "FuzzInput.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Math/VectorMath.h"
#include "haptics/Tick/SurfaceForce.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace haptics::fuzz
{
namespace
{
Vec3 Difference(const Vec3& a, const Vec3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Length(const Vec3& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

bool IsFinite(const Vec3& v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

TriangleMesh MakeMesh(FuzzInput& input)
{
  TriangleMesh mesh;
  const int numberOfPoints = input.Choice(16);
  for (int i = 0; i < numberOfPoints; ++i)
  {
    Vec3 point = input.Place();
    for (double& x : point)
    {
      // An area whose square underflows is none: no such triangle is touched.
      x = std::abs(x) < 1e-70 ? 0.0 : x;
    }
    mesh.Points.push_back(point);
  }
  const int numberOfTriangles = input.Choice(24);
  // One corner more than there are is a mistake to be refused.
  const int corners = numberOfPoints + (input.Byte() == 0 ? 1 : 0);
  for (int i = 0; i < numberOfTriangles && corners > 0; ++i)
  {
    mesh.Triangles.push_back(
      { input.Choice(corners), input.Choice(corners), input.Choice(corners) });
  }
  return mesh;
}

/// Says what an input means, so that a finding can be written down as a test.
bool IsPrinting()
{
  static const bool isPrinting = std::getenv("HAPTICS_FUZZ_PRINT") != nullptr;
  return isPrinting;
}

void Print(const char* name, const Vec3& v)
{
  std::fprintf(stderr, "%s { %.17g, %.17g, %.17g }\n", name, v[0], v[1], v[2]);
}

void Print(const TriangleMesh& mesh, const SurfaceOptions& options)
{
  std::fprintf(stderr, "surface, side %d, engine %d, crack width %.17g\n",
    static_cast<int>(options.TouchedSide), static_cast<int>(options.Engine), options.CrackWidth);
  for (const Vec3& point : mesh.Points)
  {
    Print("  point", point);
  }
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const auto& [a, b, c] = mesh.Triangles[i];
    const Side side = i < mesh.Sides.size() ? mesh.Sides[i] : options.TouchedSide;
    std::fprintf(stderr, "  triangle { %d, %d, %d }, side %d\n", a, b, c, static_cast<int>(side));
  }
}

std::shared_ptr<const TriangleSurface> MakeSurface(FuzzInput& input)
{
  SurfaceOptions options;
  options.TouchedSide = static_cast<Side>(input.Choice(3));
  options.Engine = input.Choice(2) ? EngineKind::Embree : EngineKind::BruteForce;
  if (input.Choice(8) == 7)
  {
    options.CrackWidth = input.Coordinate();
  }
  TriangleMesh mesh = MakeMesh(input);
  if (input.Choice(4) == 3)
  {
    // Now and then one too few, which is an error.
    const std::size_t missing = input.Choice(8) == 7 ? 1 : 0;
    while (mesh.Sides.size() + missing < mesh.Triangles.size())
    {
      mesh.Sides.push_back(static_cast<Side>(input.Choice(3)));
    }
  }
  if (IsPrinting())
  {
    Print(mesh, options);
  }
  std::string error;
  const auto surface = TriangleSurface::Build(std::move(mesh), options, error);
  Require(surface ? error.empty() : !error.empty(), "a surface or an error, never both or none");
  return surface;
}

/// A HIP for the next tick: somewhere, near the last one, or near a surface's point.
Vec3 NextHip(FuzzInput& input, const Vec3& last)
{
  switch (input.Choice(4))
  {
    case 0:
      return input.Place();
    case 1:
      return { input.AnyNumber(), input.AnyNumber(), input.AnyNumber() };
    default:
      return { last[0] + 0.01 * (input.Byte() - 128), last[1] + 0.01 * (input.Byte() - 128),
        last[2] + 0.01 * (input.Byte() - 128) };
  }
}

class Checker
{
public:
  explicit Checker(const std::vector<TouchedSurface>& surfaces)
  {
    for (const TouchedSurface& touched : surfaces)
    {
      const auto& surface = touched.Surface;
      this->Exact.emplace_back(surface);
      this->Offsets.push_back(Difference(surface->Origin(), surfaces.front().Surface->Origin()));
      this->Radii.push_back(surface->Radius());
      this->Reach = std::max(this->Reach, Length(this->Offsets.back()) + surface->Radius());
    }
  }

  void Check(const GodObject& god, const Vec3& hip, const Contact& contact)
  {
    Require(IsFinite(contact.Displacement), "the displacement is finite");
    Require(std::isfinite(contact.Penetration), "the penetration is finite");
    MaterialLimits limits;
    limits.MaximumForce = 3.3;
    const Vec3 force = SurfaceForce().Update(contact, 0.001, 500.0, limits);
    Require(IsFinite(force), "the force is finite");
    Require(Length(force) <= limits.MaximumForce * (1.0 + 1e-12), "the force is limited");
    Require(
      contact.NumberOfConstraints >= 0 && contact.NumberOfConstraints <= 3, "0 to 3 constraints");
    for (int i = 0; i < contact.NumberOfConstraints; ++i)
    {
      const Constraint& constraint = contact.Constraints[i];
      Require(std::abs(Length(constraint.Normal) - 1.0) < 1e-9, "normals have length 1");
      const auto& surface = god.Surfaces().at(constraint.Surface).Surface;
      Require(static_cast<std::size_t>(constraint.Triangle) < surface->Triangles().size(),
        "constraints name triangles");
    }
    if (contact.Status == UpdateStatus::InvalidHip)
    {
      Require(Length(force) == 0.0, "an invalid HIP asks for no force");
      return;
    }
    Require(IsFinite(hip), "a HIP that is not finite is invalid");
    Require(contact.Status != UpdateStatus::Overloaded, "few triangles are no overload");
    Require(contact.Status != UpdateStatus::Free || contact.Displacement == Vec3{},
      "free means at the HIP");
    Require(god.BallRadius() >= 0.0 && god.BallRadius() <= god.TipRadius(), "no ball is too large");
    this->CheckWay(god, Difference(hip, god.WayOrigin()), Length(contact.SurfaceDisplacement));
  }

private:
  /// As each surface has it: what is all but 0 there is 0.
  Vec3 Local(const Vec3& x, std::size_t k) const
  {
    return ToVec3(WithoutNegligible(
      ToVector(Difference(x, this->Offsets[k])), NegligibleShare * this->Radii[k]));
  }

  /// `carried`: by surfaces, or by a ball that grows.
  void CheckWay(const GodObject& god, const Vec3& goal, double carried)
  {
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    Require(corners > 0, "a way has a start");
    if (this->HasBefore)
    {
      Require(way[0] == this->Before, "ways join");
    }
    for (int i = 0; i + 1 < corners; ++i)
    {
      for (std::size_t k = 0; k < this->Exact.size(); ++k)
      {
        const Vec3 from = this->Local(way[i], k);
        const Vec3 to = this->Local(way[i + 1], k);
        Require(!this->Exact[k].Crosses(from, to), "no piece of the way crosses a triangle");
      }
    }
    const Vec3& now = way[corners - 1];
    const double before = Length(Difference(way[0], goal));
    Require(Length(Difference(now, goal)) <= before * (1.0 + 1e-9) + 1e-12 * this->Reach + carried,
      "the god-object never moves away from the HIP");
    this->Before = now;
    this->HasBefore = true;
  }

  std::vector<testing::ExactQueries> Exact;
  std::vector<Vec3> Offsets;
  std::vector<double> Radii;
  double Reach = 0.0;
  Vec3 Before{};
  bool HasBefore = false;
};
}

void TestOneInput(FuzzInput& input)
{
  std::vector<TouchedSurface> surfaces;
  const int wanted = 1 + (input.Choice(4) == 3 ? input.Choice(3) : 0);
  for (int i = 0; i < wanted; ++i)
  {
    if (const auto surface = MakeSurface(input))
    {
      surfaces.push_back(surface);
    }
  }
  if (surfaces.empty())
  {
    return;
  }
  const bool isBall = input.Choice(2) == 1;
  GodObject god(surfaces, isBall ? Tip::Ball : Tip::Point);
  god.SetTipRadius(isBall ? input.Coordinate() : 0.0);
  Checker checker(surfaces);
  Vec3 hip{};
  for (int tick = 0; tick < 64 && !input.IsEmpty(); ++tick)
  {
    hip = NextHip(input, IsFinite(hip) ? hip : Vec3{});
    if (isBall && input.Choice(16) == 15)
    {
      god.SetTipRadius(input.AnyNumber());
    }
    const Contact& contact = god.Update(hip);
    if (IsPrinting())
    {
      Print("hip", hip);
      Print("  god-object", contact.Position);
      std::fprintf(stderr, "  tip %.17g, ball %.17g\n", god.TipRadius(), god.BallRadius());
    }
    checker.Check(god, hip, contact);
  }
}
}
