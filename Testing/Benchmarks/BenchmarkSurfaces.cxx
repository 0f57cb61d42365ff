#include "BenchmarkSurfaces.h"
#include "RandomVectors.h"

#include "AnalyticSurfaces.h"
#include "FirstHit.h"
#include "MeshToPolyData.h"
#include "ProfileSurfaces.h"

#include "vtkGodObjectFilter.h"
#include "vtkNew.h"
#include "vtkSTLReader.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace haptics::testing
{
namespace
{
constexpr double TickTime = 1e-3;  // [s]
constexpr double Encoder = 5.5e-5; // [m]
constexpr double Hand = 0.05;      // radius to which real surfaces are scaled [m]

vtkSmartPointer<vtkPolyData> ReadFile(const std::string& stem)
{
  if (std::ifstream(stem + ".stl").good())
  {
    vtkNew<vtkSTLReader> reader;
    reader->SetFileName((stem + ".stl").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  if (std::ifstream(stem + ".vtp").good())
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((stem + ".vtp").c_str());
    reader->Update();
    return reader->GetOutput();
  }
  return nullptr;
}

/// A terrain is touched from above.
TriangleMesh FacingUp(TriangleMesh mesh)
{
  double up = 0.0;
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    up += Cross(mesh.Points[b] - mesh.Points[a], mesh.Points[c] - mesh.Points[a])[2];
  }
  return up < 0.0 ? InsideOut(std::move(mesh)) : mesh;
}
}

TriangleMesh ReadSurface(const std::string& folder, const std::string& name, double radius)
{
  const vtkSmartPointer<vtkPolyData> read = ReadFile(folder + "/" + name);
  if (!read)
  {
    std::fprintf(stderr, "No %s in %s: python3 Data/get_surfaces.py --output %s %s\n", name.c_str(),
      folder.c_str(), folder.c_str(), name.c_str());
    return {};
  }
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(read);
  filter->Update();
  TriangleMesh mesh = ToMesh(filter->GetOutput());
  const Vec3 origin = filter->GetSurface()->Origin();
  mesh = Scaled(Moved(std::move(mesh), -1.0 * origin), radius / filter->GetSurface()->Radius());
  return name == "fault" ? FacingUp(std::move(mesh)) : mesh;
}

std::vector<BenchmarkSurface> AllBenchmarkSurfaces(const std::string& folder)
{
  const auto saddle = [](double x, double y) { return 8.0 * (x * x - y * y); };
  std::vector<BenchmarkSurface> all = {
    { "sphere 320", "analytic", [] { return Icosphere(2, 0.03); }, StrokeKind::Path,
      HipPath::Smooth, 0.03 },
    { "sphere 5,120", "analytic", [] { return Icosphere(4, 0.03); }, StrokeKind::Path,
      HipPath::Smooth, 0.03 },
    { "sphere 20,480", "analytic", [] { return Icosphere(5, 0.03); }, StrokeKind::Path,
      HipPath::Smooth, 0.03 },
    { "sphere, at its edges", "analytic", [] { return Icosphere(4, 0.03); }, StrokeKind::Edges,
      HipPath::Smooth, 0.03 },
    { "box", "analytic", [] { return Box(0.03, 0.03, 0.03, 8); }, StrokeKind::Around,
      HipPath::Smooth, 0.03 },
    { "box, along its lines", "analytic", [] { return Box(0.03, 0.03, 0.03, 8); }, StrokeKind::Path,
      HipPath::AlongLines, 0.03 },
    { "plate of 1 mm", "analytic", [] { return Box(0.03, 0.03, 0.0005, 8); }, StrokeKind::Above,
      HipPath::Smooth, 0.03 },
    { "star", "analytic", [] { return Star(3, 0.04, 0.4, 3); }, StrokeKind::Around, HipPath::Smooth,
      0.04 },
    { "torus", "analytic", [] { return Torus(0.025, 0.008, 64, 32); }, StrokeKind::Path,
      HipPath::Smooth, 0.033 },
    { "groove of 60 deg", "analytic", [] { return GroovedBlock(60, 0.03); }, StrokeKind::Above,
      HipPath::Smooth, 0.02 },
    { "groove of 10 deg", "analytic", [] { return GroovedBlock(10, 0.03); }, StrokeKind::Above,
      HipPath::Smooth, 0.005 },
    { "saddle", "analytic", [saddle] { return HeightBlock(saddle, 0.03, 32); }, StrokeKind::Above,
      HipPath::Smooth, 0.025 },
    { "t13", "CAD", {}, StrokeKind::Around, HipPath::Smooth, Hand },
    { "gearbox", "CAD", {}, StrokeKind::Around, HipPath::Smooth, Hand },
    { "pial", "medical", {}, StrokeKind::Around, HipPath::Smooth, Hand },
    { "fault", "scientific", {}, StrokeKind::Above, HipPath::Smooth, 0.5 * Hand, 0.003 },
  };
  for (BenchmarkSurface& surface : all)
  {
    if (!surface.Make)
    {
      const std::string name = surface.Name;
      surface.Make = [folder, name] { return ReadSurface(folder, name, Hand); };
    }
  }
  return all;
}

namespace
{
/// The hand's height over a surface, by rays.
class RayedStroke
{
public:
  RayedStroke(const BenchmarkSurface& surface, const TriangleMesh& mesh, unsigned seed)
    : Ray({ MakeSurface(mesh) })
    , IsAbove(surface.Strokes == StrokeKind::Above)
    , Reach(surface.Reach)
    , Deepest(surface.Deepest)
    , Far(2.0 * Ray.Surfaces().front().Surface->Radius())
    , Random(seed)
  {
    this->Direction = Unit(NormalVector(this->Random));
    this->Height = this->HeightAt();
  }

  Vec3 Next()
  {
    ++this->Tick;
    this->Wander();
    // Smoothed, as a hand does not jump into a hole.
    this->Height += 0.02 * (this->HeightAt() - this->Height);
    const double breath = 0.5 - 0.5 * std::cos(2.0 * M_PI * 0.7 * TickTime * this->Tick);
    const double depth = -0.25 * this->Deepest + 1.25 * this->Deepest * breath;
    Vec3 hip = this->IsAbove ? Vec3{ this->Place[0], this->Place[1], this->Height - depth }
                             : (this->Height - depth) * this->Direction;
    for (double& x : hip)
    {
      x = Encoder * std::floor(x / Encoder);
    }
    return hip;
  }

private:
  void Wander()
  {
    if (this->IsAbove)
    {
      // A random walk of the velocity, to about 0.1 m/s, turned back at the reach.
      this->Velocity = 0.995 * this->Velocity + 0.006 * NormalVector(this->Random);
      for (int k = 0; k < 2; ++k)
      {
        const double next = this->Place[k] + TickTime * this->Velocity[k];
        if (std::abs(next) > this->Reach)
        {
          this->Velocity[k] = -this->Velocity[k];
        }
        this->Place[k] += TickTime * this->Velocity[k];
      }
      return;
    }
    this->Velocity = 0.995 * this->Velocity + 0.25 * NormalVector(this->Random);
    this->Direction = Unit(this->Direction + TickTime * Cross(this->Velocity, this->Direction));
  }

  double HeightAt()
  {
    if (this->IsAbove)
    {
      const Vec3 top{ this->Place[0], this->Place[1], this->Far };
      const Vec3 bottom{ this->Place[0], this->Place[1], -this->Far };
      return this->Far - FirstHit(this->Ray, top, bottom);
    }
    return this->Far - FirstHit(this->Ray, this->Far * this->Direction, { 0, 0, 0 });
  }

  GodObject Ray;
  bool IsAbove;
  double Reach;
  double Deepest;
  double Far;
  std::mt19937 Random;
  long Tick = 0;
  Vec3 Place{};
  Vec3 Velocity{};
  Vec3 Direction{};
  double Height = 0.0;
};
}

namespace
{
/// Five ticks each: far out, a millimetre above an edge that faces up, 5 mm below it at a slant,
/// a little aside, and far out again.
std::vector<Vec3> ThroughEdges(
  const BenchmarkSurface& surface, const TriangleMesh& mesh, int ticks, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> pick(0, mesh.Triangles.size() - 1);
  std::uniform_real_distribution<double> share(0.05, 0.95);
  std::vector<Vec3> hips;
  while (static_cast<int>(hips.size()) < ticks)
  {
    const Triangle& triangle = mesh.Triangles[pick(random)];
    const Vec3& a = mesh.Points[triangle[0]];
    const Vec3& b = mesh.Points[triangle[1]];
    const Vec3 at = a + share(random) * (b - a);
    const Vec3 up = Unit(at);
    if (up[2] < 0.5)
    {
      continue; // so that ways far out pass by the shape
    }
    const Vec3 slant = Unit(up + 0.4 * Unit({ share(random), -share(random), 0.1 }));
    hips.push_back((3.0 * surface.Reach) * up);
    hips.push_back(at + 0.001 * slant);
    hips.push_back(at - 0.005 * slant);
    hips.push_back(at - 0.005 * slant + 1e-4 * Unit(b - a));
    hips.push_back((3.0 * surface.Reach) * up);
  }
  return hips;
}
}

std::vector<Vec3> MakeStroke(
  const BenchmarkSurface& surface, const TriangleMesh& mesh, int ticks, unsigned seed)
{
  if (surface.Strokes == StrokeKind::Edges)
  {
    return ThroughEdges(surface, mesh, ticks, seed);
  }
  std::vector<Vec3> hips;
  if (surface.Strokes == StrokeKind::Path)
  {
    HipPath path(surface.Path, surface.Reach, seed);
    for (int tick = 0; tick < ticks; ++tick)
    {
      hips.push_back(path.Next());
    }
    return hips;
  }
  RayedStroke stroke(surface, mesh, seed);
  for (int tick = 0; tick < ticks; ++tick)
  {
    hips.push_back(stroke.Next());
  }
  return hips;
}
}
