#include "HandStrokes.h"

#include "AnalyticSurfaces.h"
#include "BenchmarkSurfaces.h"
#include "FirstHit.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

namespace haptics::testing
{
const char* const HandStrokesHelp =
  R"(SURFACE  sphereL    20 * 4^L triangles, R = 1 m (L = 8: 1.3 million, 9: 5.2 million)
         cubeN      12 * N^2 triangles, a cube blown up to R = 1 m (N = 913: 10 million)
         noiseL     as sphereL, its points pulled in by up to an edge's length: rough
         starL      as sphereL, its points pulled in by up to 10 cm: spikes
         fiveL      five spheres of level L whose middles are 0.5 m apart: several surfaces
         NAME       a real surface, scaled to R = 1 m
STROKE   slide      20 mm deep, 1 mm a tick          fast     20 mm deep, 4 mm a tick
         deep       60 mm deep, 1 mm a tick
         wander     20 mm deep, 2 to 6 mm a tick, turning at random
         over       between 10 mm above and 10 mm below, up and down once in 200 ticks, 1 mm a tick
         plunge     from 60 mm above to 70 mm below at 5 mm a tick, and back, at random places
         near       1 mm above, 1 mm a tick           above    20 mm above, 1 mm a tick
         hold       20 mm deep, at rest but for a tremor of 55 um
)";

namespace
{
/// The length of an edge of Icosphere(level, 1), about.
double EdgeLength(int level)
{
  return 1.1 * std::ldexp(1.0, -level);
}

/// A cube of `cells`^2 squares a face, blown up to a sphere. AnalyticSurfaces' Box would take
/// minutes for millions of triangles: here only what lies on the cube's edges is looked up.
TriangleMesh CubeSphere(int cells)
{
  TriangleMesh mesh;
  mesh.Points.reserve(static_cast<std::size_t>(6) * cells * cells + 2);
  mesh.Triangles.reserve(static_cast<std::size_t>(12) * cells * cells);
  std::map<std::array<int, 3>, std::int32_t> rim;
  std::vector<std::int32_t> ids(static_cast<std::size_t>(cells + 1) * (cells + 1));
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2;
    for (int i = 0; i <= cells; ++i)
    {
      for (int j = 0; j <= cells; ++j)
      {
        std::array<int, 3> key{};
        key[axis] = face % 2 * cells;
        key[(axis + 1) % 3] = i;
        key[(axis + 2) % 3] = j;
        const auto fresh = static_cast<std::int32_t>(mesh.Points.size());
        const bool isOnRim = i % cells == 0 || j % cells == 0;
        const std::int32_t id = isOnRim ? rim.try_emplace(key, fresh).first->second : fresh;
        ids[static_cast<std::size_t>(i) * (cells + 1) + j] = id;
        if (id == fresh)
        {
          Vec3 p;
          for (int k = 0; k < 3; ++k)
          {
            p[k] = std::tan(M_PI / 4.0 * (2.0 * key[k] / cells - 1.0)); // squares of like size
          }
          mesh.Points.push_back(Unit(p));
        }
      }
    }
    for (int i = 0; i < cells; ++i)
    {
      for (int j = 0; j < cells; ++j)
      {
        const std::size_t at = static_cast<std::size_t>(i) * (cells + 1) + j;
        const std::int32_t a = ids[at];
        const std::int32_t c = ids[at + cells + 2];
        std::int32_t b = ids[at + cells + 1];
        std::int32_t d = ids[at + 1];
        if (face % 2 == 0)
        {
          std::swap(b, d); // so that all faces look outwards
        }
        mesh.Triangles.push_back({ a, b, c });
        mesh.Triangles.push_back({ a, c, d });
      }
    }
  }
  return mesh;
}

Vec3 RandomDirection(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  return Unit({ normal(random), normal(random), normal(random) });
}

/// Whether the surface is one of a kind whose names end with a number, and that number.
bool IsOfKind(const std::string& name, const std::string& kind, int& number)
{
  if (name.rfind(kind, 0) != 0 || name.size() == kind.size() ||
    name.find_first_not_of("0123456789", kind.size()) != std::string::npos)
  {
    return false;
  }
  number = std::atoi(name.c_str() + kind.size());
  return number > 0 || name == kind + "0";
}

/// How a stroke along a great circle goes.
struct SteadyStroke
{
  const char* Name;
  double Step;  ///< [m a tick]
  double Above; ///< the surface [m]
};
constexpr SteadyStroke SteadyStrokes[] = { { "slide", 1e-3, -20e-3 }, { "fast", 4e-3, -20e-3 },
  { "deep", 1e-3, -60e-3 }, { "near", 1e-3, 1e-3 }, { "above", 1e-3, 20e-3 },
  { "hold", 0.0, -20e-3 }, { "over", 1e-3, 0.0 } };

/// Lays a stroke over surfaces about the origin.
class StrokeMaker
{
public:
  StrokeMaker(const HandSurfaces& surfaces, bool isSphere, double tip)
    : Ray({ surfaces.begin(), surfaces.end() })
    , IsSphere(isSphere)
    , Tip(tip)
  {
    for (const auto& surface : surfaces)
    {
      this->Far = std::max(this->Far, 2.0 * (Length(surface->Origin()) + surface->Radius()));
    }
    this->U = Unit(Cross({ 0.3, 0.5, 0.81 }, { 0, 0, 1 }));
    this->V = Unit(Cross({ 0.3, 0.5, 0.81 }, this->U));
  }

  std::vector<Vec3> Steady(const SteadyStroke& stroke, std::size_t ticks)
  {
    const bool isHold = stroke.Step == 0.0;
    const bool isOver = stroke.Above == 0.0;
    std::vector<Vec3> hips;
    for (std::size_t tick = 0; tick < ticks; ++tick)
    {
      this->Turn(stroke.Step);
      const double breath =
        isOver ? 10e-3 * std::cos(2.0 * M_PI * static_cast<double>(tick) / 200.0) : 0.0;
      const Vec3 tremor = (isHold ? 55e-6 : 0.0) * RandomDirection(this->Random);
      hips.push_back(this->At(this->U, stroke.Above + breath) + tremor);
    }
    return hips;
  }

  std::vector<Vec3> Wander(std::size_t ticks)
  {
    std::vector<Vec3> hips;
    while (hips.size() < ticks)
    {
      const double angle = 0.6 * (this->Uniform(this->Random) - 0.5);
      this->V = Unit(std::cos(angle) * this->V + std::sin(angle) * Cross(this->U, this->V));
      this->Turn(2e-3 + 4e-3 * this->Uniform(this->Random));
      hips.push_back(this->At(this->U, -20e-3));
    }
    return hips;
  }

  std::vector<Vec3> Plunge(std::size_t ticks)
  {
    std::vector<Vec3> hips;
    while (hips.size() < ticks)
    {
      const Vec3 outwards = RandomDirection(this->Random);
      const double ground = (this->IsSphere ? 1.0 : this->Height(outwards)) + this->Tip;
      for (double above = 60e-3; above > -70e-3; above -= 5e-3)
      {
        hips.push_back((ground + above) * outwards);
      }
      for (double above = -70e-3; above < 60e-3; above += 5e-3)
      {
        hips.push_back((ground + above) * outwards);
      }
    }
    hips.resize(ticks);
    return hips;
  }

private:
  double Height(const Vec3& outwards)
  {
    return this->Far - FirstHit(this->Ray, this->Far * outwards, { 0, 0, 0 });
  }

  Vec3 At(const Vec3& outwards, double above)
  {
    // Smoothed, as a hand does not jump into a hole.
    const double ground = this->IsSphere ? 1.0 : this->Height(outwards);
    this->Smoothed += (this->Smoothed > 0.0 ? 0.02 : 1.0) * (ground - this->Smoothed);
    return (this->Smoothed + above + this->Tip) * outwards;
  }

  void Turn(double step)
  {
    const Vec3 from = this->U;
    this->U = Unit(this->U + step * this->V);
    this->V = Unit(this->V - step * from);
  }

  GodObject Ray;
  bool IsSphere;
  double Tip;
  double Far = 0.0;
  double Smoothed = 0.0; ///< height of the ground; 0: not known yet
  Vec3 U{};
  Vec3 V{};
  std::mt19937 Random{ 7 };
  std::uniform_real_distribution<double> Uniform{ 0.0, 1.0 };
};
}

std::vector<TriangleMesh> MakeHandSurfaces(const std::string& name, const std::string& folder)
{
  int number = 0;
  if (IsOfKind(name, "cube", number) && number <= 2000)
  {
    return { CubeSphere(std::max(1, number)) };
  }
  if (IsOfKind(name, "sphere", number) && number <= 9)
  {
    return { Icosphere(number, 1.0) };
  }
  if (IsOfKind(name, "noise", number) && number <= 9)
  {
    return { Star(number, 1.0, EdgeLength(number), 1) };
  }
  if (IsOfKind(name, "star", number) && number <= 9)
  {
    return { Star(number, 1.0, 0.1, 1) };
  }
  if (IsOfKind(name, "five", number) && number <= 8)
  {
    std::vector<TriangleMesh> meshes;
    for (int i = -2; i <= 2; ++i)
    {
      meshes.push_back(Moved(Icosphere(number, 1.0), { 0.5 * i, 0.1 * i, 0.0 }));
    }
    return meshes;
  }
  TriangleMesh mesh = ReadSurface(folder, name, 1.0);
  if (mesh.Triangles.empty())
  {
    std::fprintf(stderr, "There is no surface %s.\n", name.c_str());
    return {};
  }
  return { std::move(mesh) };
}

std::vector<Vec3> MakeHandStroke(const std::string& name, const std::string& surface,
  const HandSurfaces& surfaces, int ticks, double tip)
{
  const bool isSphere = surface.rfind("sphere", 0) == 0 || surface.rfind("cube", 0) == 0;
  StrokeMaker maker(surfaces, isSphere, tip);
  const auto count = static_cast<std::size_t>(ticks);
  for (const SteadyStroke& stroke : SteadyStrokes)
  {
    if (name == stroke.Name)
    {
      return maker.Steady(stroke, count);
    }
  }
  if (name == "wander")
  {
    return maker.Wander(count);
  }
  if (name == "plunge")
  {
    return maker.Plunge(count);
  }
  return {};
}
}
