#include "LocatorMethod.h"

#include "MeshToPolyData.h"
#include "haptics/Surface/Facet.h"

namespace haptics::testing
{
namespace
{
constexpr double Clearance = 1e-7; // [m]
constexpr int MostIterations = 12;
/// Facets met from behind that one cast steps through.
constexpr int MostBacks = 8;
}

LocatorMethod::LocatorMethod(
  const TriangleMesh& mesh, vtkAbstractCellLocator* locator, double tolerance)
  : Locator(locator)
  , Tolerance(tolerance)
{
  const auto corner = [&mesh](std::int32_t i) { return ToVector(mesh.Points[i]); };
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    const haptics::Facet facet(corner(a), corner(b), corner(c));
    this->Normals.push_back(facet.Normal);
    this->Anchors.push_back(facet.Corner[facet.Anchor]);
  }
  this->Locator->SetDataSet(ToPolyData(mesh));
  this->Locator->BuildLocator();
}

void LocatorMethod::Place(const Vec3& position)
{
  this->Position = ToVector(position);
}

/// The first facet met from its front on the way, or -1.
std::int32_t LocatorMethod::FirstFront(const Vector& from, const Vector& to)
{
  Vector start = from;
  for (int back = 0; back < MostBacks; ++back)
  {
    double t = 0.0;
    double x[3];
    double pcoords[3];
    int subId = 0;
    vtkIdType cell = -1;
    const Vec3 a = ToVec3(start);
    const Vec3 b = ToVec3(to);
    if (!this->Locator->IntersectWithLine(
          a.data(), b.data(), this->Tolerance, t, x, pcoords, subId, cell))
    {
      return -1;
    }
    if (glm::dot(this->Normals[cell], to - from) < 0.0)
    {
      return static_cast<std::int32_t>(cell);
    }
    const double rest = glm::length(to - start);
    const double step = t * rest + Clearance;
    if (step >= rest)
    {
      return -1;
    }
    start += (step / rest) * (to - start);
  }
  return -1;
}

Vec3 LocatorMethod::Update(const Vec3& hipPosition)
{
  const Vector hip = ToVector(hipPosition);
  this->Active.Clear();
  Vector goal = hip;
  for (int i = 0; i < MostIterations; ++i)
  {
    const std::int32_t met = this->FirstFront(this->Position, goal);
    if (met < 0)
    {
      this->Position = goal;
      break;
    }
    const FacetId facet{ 0, met };
    if (this->Active.Has(facet))
    {
      break;
    }
    ActivePlane plane;
    plane.Facet = facet;
    plane.Normal = this->Normals[met];
    plane.Anchor = this->Anchors[met];
    plane.Clearance = Clearance;
    this->Active.Add(plane);
    goal = this->Active.Nearest(this->Position, hip);
  }
  return this->Active.IsEmpty() ? hipPosition : ToVec3(this->Position);
}
}
