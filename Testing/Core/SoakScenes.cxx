#include "SoakScenes.h"

#include "AnalyticSurfaces.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace haptics::testing
{
namespace
{
TriangleMesh Nested()
{
  TriangleMesh sheets;
  for (int i = 0; i < 8; ++i)
  {
    sheets = Joined(sheets, Moved(Square(0.03, 2), { 0, 0, -0.0002 * i }));
  }
  return sheets;
}

TriangleMesh FrontAndBoth(const TriangleMesh& fronts, const TriangleMesh& boths)
{
  return Joined(Sided(fronts, Side::Front), Sided(boths, Side::Both));
}

TriangleMesh SharedEdgeBoxes()
{
  // Two boxes with one edge in common: four triangles on it.
  TriangleMesh mesh = Box(0.01, 0.01, 0.01, 2);
  const TriangleMesh other = Moved(Box(0.01, 0.01, 0.01, 2), { 0.02, 0.02, 0 });
  std::vector<std::int32_t> renamed;
  for (const Vec3& p : other.Points)
  {
    const auto same = std::find_if(
      mesh.Points.begin(), mesh.Points.end(), [&p](const Vec3& q) { return Length(p - q) < 1e-9; });
    renamed.push_back(static_cast<std::int32_t>(same - mesh.Points.begin()));
    if (same == mesh.Points.end())
    {
      mesh.Points.push_back(p);
    }
  }
  for (const auto& [a, b, c] : other.Triangles)
  {
    mesh.Triangles.push_back({ renamed[a], renamed[b], renamed[c] });
  }
  return mesh;
}

/// From low to high, two triangles a face.
TriangleMesh BoxOf(const Vec3& low, const Vec3& high, int cells = 1)
{
  TriangleMesh mesh = Box(0.5, 0.5, 0.5, cells);
  for (Vec3& p : mesh.Points)
  {
    for (int k = 0; k < 3; ++k)
    {
      // Its faces exactly where they are given.
      p[k] = p[k] == -0.5 ? low[k]
        : p[k] == 0.5     ? high[k]
                          : low[k] + (p[k] + 0.5) * (high[k] - low[k]);
    }
  }
  return mesh;
}

/// Two boxes side by side with a gap of `width`; the right one's top is lower by `step`.
std::vector<TriangleMesh> TwoBoxes(double width, double step, int cells = 1)
{
  return { BoxOf({ -0.5, -0.5, -0.1 }, { -0.5 * width, 0.5, 0.1 }, cells),
    BoxOf({ 0.5 * width, -0.5, -0.1 }, { 0.5, 0.5, 0.1 - step }, cells) };
}

TriangleMesh JoinedAll(const std::vector<TriangleMesh>& parts)
{
  TriangleMesh all;
  for (const TriangleMesh& part : parts)
  {
    all = Joined(all, part);
  }
  return all;
}

/// A prism along z with its sharp edge at the origin, of so many degrees.
TriangleMesh Wedge(double degrees)
{
  const double s = std::sin(0.5 * degrees * M_PI / 180.0);
  const double c = std::cos(0.5 * degrees * M_PI / 180.0);
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, 0 }, { -c, s, 0 }, { -c, -s, 0 }, { 0, 0, 1 }, { -c, s, 1 },
    { -c, -s, 1 } };
  mesh.Triangles = { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4 }, { 0, 4, 1 }, { 0, 2, 5 }, { 0, 5, 3 },
    { 1, 4, 5 }, { 1, 5, 2 } };
  for (Triangle& t : mesh.Triangles)
  {
    Vec3 middle{};
    for (const Vec3& p : mesh.Points)
    {
      middle = middle + (1.0 / 6.0) * p;
    }
    const Vec3& a = mesh.Points[t[0]];
    if (Dot(Cross(mesh.Points[t[1]] - a, mesh.Points[t[2]] - a), middle - a) > 0.0)
    {
      std::swap(t[1], t[2]);
    }
  }
  return mesh;
}

/// Triangles that meet in one point; every second sector, or all but one.
TriangleMesh Fan(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const int n = 2 + static_cast<int>(random() % 3);
  const bool isOpen = random() % 2 == 0;
  std::vector<double> angles;
  for (int i = 0; i < 2 * n; ++i)
  {
    angles.push_back(std::uniform_real_distribution<double>(0.0, 2.0 * M_PI)(random));
  }
  std::sort(angles.begin(), angles.end());
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, 0 } };
  for (const double angle : angles)
  {
    mesh.Points.push_back({ std::cos(angle), std::sin(angle), 0.3 * normal(random) });
  }
  for (int i = 0; i + 1 < 2 * n; i += isOpen ? 2 : 1)
  {
    mesh.Triangles.push_back({ 0, 1 + i, 2 + i });
  }
  return mesh;
}

/// Many fans side by side.
TriangleMesh Fans(unsigned seed)
{
  TriangleMesh all;
  for (unsigned i = 0; i < 36; ++i)
  {
    all = Joined(all, Moved(Fan(36 * seed + i), { 3.0 * (i % 6), 3.0 * (i / 6), 0.0 }));
  }
  return all;
}

/// Triangles whose third corner lies on the edge of the others but for rounding.
TriangleMesh Needles(int count, unsigned seed)
{
  TriangleMesh mesh = Soup(count, 0.5, seed);
  std::mt19937 random(seed);
  for (const auto& [a, b, c] : mesh.Triangles)
  {
    const double share = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    mesh.Points[c] = mesh.Points[a] + share * (mesh.Points[b] - mesh.Points[a]);
  }
  return mesh;
}

/// A ball with a corner near an edge of each triangle: slivers among good ones.
TriangleMesh SliverBall(double height, unsigned seed)
{
  TriangleMesh ball = Icosphere(2, 1.0);
  std::mt19937 random(seed);
  TriangleMesh mesh;
  mesh.Points = ball.Points;
  for (const auto& [a, b, c] : ball.Triangles)
  {
    const double share = std::uniform_real_distribution<double>(0.1, 0.9)(random);
    const Vec3 foot = mesh.Points[a] + share * (mesh.Points[b] - mesh.Points[a]);
    const auto inner = static_cast<std::int32_t>(mesh.Points.size());
    mesh.Points.push_back(foot + height * (mesh.Points[c] - foot));
    mesh.Triangles.insert(
      mesh.Triangles.end(), { { a, b, inner }, { b, c, inner }, { c, a, inner } });
  }
  return mesh;
}

/// A cone standing on z = 0, pointed upwards, or a pyramid of few sides.
TriangleMesh Cone(int sides, double radius, double height)
{
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, height }, { 0, 0, 0 } };
  for (int i = 0; i < sides; ++i)
  {
    const double angle = 2.0 * M_PI * i / sides;
    mesh.Points.push_back({ radius * std::cos(angle), radius * std::sin(angle), 0.0 });
    const int next = 2 + (i + 1) % sides;
    mesh.Triangles.push_back({ 0, 2 + i, next });
    mesh.Triangles.push_back({ 1, next, 2 + i });
  }
  return mesh;
}

/// A sheet with triangles cut out, and slits of `width` at its edge.
TriangleMesh NotchedSheet(double width, unsigned seed)
{
  std::mt19937 random(seed);
  TriangleMesh mesh = Square(1.0, 8);
  mesh.Triangles.erase(std::remove_if(mesh.Triangles.begin(), mesh.Triangles.end(),
                         [&](const Triangle&) { return random() % 5 == 0; }),
    mesh.Triangles.end());
  for (int i = 0; i < 8; ++i)
  {
    // A comb of teeth, each a triangle's breadth from the next.
    const double x = -1.0 + 0.25 * i;
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    mesh.Points.insert(mesh.Points.end(),
      { { x + 0.5 * width, 1.0, 0 }, { x + 0.25 - 0.5 * width, 1.0, 0 }, { x + 0.125, 1.5, 0 } });
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

TriangleMesh WithBacks(const TriangleMesh& mesh)
{
  return Joined(mesh, InsideOut(mesh));
}

TriangleMesh InFloat32(TriangleMesh mesh)
{
  for (Vec3& p : mesh.Points)
  {
    for (double& x : p)
    {
      x = static_cast<float>(x);
    }
  }
  return mesh;
}

/// A closed box whose top's middle edge has a corner more on one of its sides.
TriangleMesh TJunction()
{
  TriangleMesh mesh = BoxOf({ -0.5, -0.5, -0.1 }, { 0, 0.5, 0.1 });
  return Joined(mesh,
    JoinedAll(
      { BoxOf({ 0, -0.5, -0.1 }, { 0.5, 0.1, 0.1 }), BoxOf({ 0, 0.1, -0.1 }, { 0.5, 0.5, 0.1 }) }));
}

TriangleMesh FourParts(double step)
{
  return JoinedAll({ BoxOf({ -0.5, -0.5, -0.1 }, { 0, 0, 0.1 }),
    BoxOf({ 0, -0.5, -0.1 }, { 0.5, 0, 0.1 - step }), BoxOf({ 0, 0, -0.1 }, { 0.5, 0.5, 0.1 }),
    BoxOf({ -0.5, 0, -0.1 }, { 0, 0.5, 0.1 - 2.0 * step }) });
}

std::vector<TouchedSurface> One(const TriangleMesh& mesh, Side side)
{
  return { MakeSurface(mesh, side) };
}

std::vector<TouchedSurface> Each(const std::vector<TriangleMesh>& meshes, Side side)
{
  std::vector<TouchedSurface> surfaces;
  for (const TriangleMesh& mesh : meshes)
  {
    surfaces.push_back(MakeSurface(mesh, side));
  }
  return surfaces;
}

std::string Text(double x)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g", x);
  return text;
}

std::vector<SoakScene> MakeScenes()
{
  std::vector<SoakScene> scenes;
  const auto add =
    [&](const std::string& name, std::function<TriangleMesh()> make, Side side, double reach = 0.0)
  {
    scenes.push_back({ name, [make = std::move(make), side] { return One(make(), side); }, reach });
  };
  const auto addParts = [&](const std::string& name,
                          std::function<std::vector<TriangleMesh>()> make, Side side) {
    scenes.push_back({ name, [make = std::move(make), side] { return Each(make(), side); } });
  };
  const auto addBothWays = [&](const std::string& name, std::function<TriangleMesh()> make)
  {
    add(name, make, Side::Front);
    add(name + ", both sides", make, Side::Both);
  };

  add(
    "sphere", [] { return Icosphere(4, 0.03); }, Side::Front, 0.03);
  add(
    "inside of a sphere", [] { return InsideOut(Icosphere(4, 0.03)); }, Side::Front, 0.03);
  add(
    "box, along its lines", [] { return Box(0.03, 0.03, 0.03, 8); }, Side::Front, 0.03);
  add(
    "plate of 1 mm", [] { return Box(0.03, 0.03, 0.0005, 8); }, Side::Front, 0.03);
  add(
    "plate of 1 um", [] { return Box(0.03, 0.03, 0.5e-6, 4); }, Side::Front, 0.03);
  add(
    "star", [] { return Star(3, 0.04, 0.4, 3); }, Side::Front, 0.04);
  add(
    "star from both sides", [] { return Star(3, 0.04, 0.4, 3); }, Side::Both, 0.04);
  add(
    "fine noise", [] { return Star(5, 0.03, 0.02, 4); }, Side::Front, 0.03);
  add(
    "torus", [] { return Torus(0.025, 0.008, 64, 32); }, Side::Front, 0.033);
  add(
    "torus, far away",
    [] {
      return Moved(Torus(0.025, 0.008, 64, 32), { 5e5, 4e6, 100 });
    },
    Side::Front, 0.033);
  add(
    "groove of 5 degrees", [] { return Groove(5.0, 0.03); }, Side::Front, 0.03);
  add(
    "groove of 0.2 degrees", [] { return Groove(0.2, 0.03); }, Side::Both, 0.03);
  add("nested sheets", Nested, Side::Front, 0.03);
  add("nested sheets from both sides", Nested, Side::Both, 0.03);
  add("boxes sharing an edge", SharedEdgeBoxes, Side::Both, 0.03);
  add(
    "star of sides by chance", [] { return SidedAtRandom(Star(3, 0.04, 0.4, 3), 1); },
    Side::Automatic, 0.04);
  add(
    "soup of sides by chance", [] { return SidedAtRandom(Scaled(Soup(400, 0.4, 7), 0.03), 2); },
    Side::Automatic, 0.04);
  add(
    "sheet through a solid", [] { return FrontAndBoth(Box(0.02, 0.02, 0.02, 4), Square(0.03, 4)); },
    Side::Automatic, 0.03);
  add(
    "sheets in and on a ball",
    []
    {
      return FrontAndBoth(
        Icosphere(3, 0.02), Joined(Square(0.012, 2), Moved(Square(0.03, 2), { 0, 0, 0.02 })));
    },
    Side::Automatic, 0.03);
  add(
    "solid and walls at an edge",
    []
    {
      TriangleMesh mesh = SharedEdgeBoxes();
      mesh.Sides.assign(mesh.Triangles.size(), Side::Both);
      std::fill(mesh.Sides.begin(), mesh.Sides.begin() + mesh.Sides.size() / 2, Side::Front);
      return mesh;
    },
    Side::Automatic, 0.03);
  add(
    "soup", [] { return Scaled(Soup(400, 0.4, 7), 0.03); }, Side::Both, 0.04);
  add(
    "slivers", [] { return Scaled(Icosphere(3, 1.0), 0.03); }, Side::Front, 0.03);

  for (const double width : { 2e-12, 1e-9, 1e-6, 1e-3, 2e-2 })
  {
    addBothWays("slot of " + Text(width), [width] { return JoinedAll(TwoBoxes(width, 0.0, 2)); });
  }
  addParts(
    "slot of two surfaces", [] { return TwoBoxes(2e-2, 0.0); }, Side::Automatic);
  for (const double degrees : { 0.5, 5.0, 28.0, 60.0, 100.0, 140.0, 179.0 })
  {
    addBothWays("wedge of " + Text(degrees) + " degrees", [degrees] { return Wedge(degrees); });
  }
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    add(
      "fans " + std::to_string(seed), [seed] { return Fans(seed); }, Side::Both);
  }
  add(
    "needles", [] { return Needles(60, 1); }, Side::Both);
  add(
    "ball with slivers of 1e-9", [] { return SliverBall(1e-9, 1); }, Side::Front);
  addBothWays("ball with slivers of 1e-14", [] { return SliverBall(1e-14, 1); });
  for (const double width : { 1e-9, 1e-3 })
  {
    add(
      "sheet with slits of " + Text(width), [width] { return NotchedSheet(width, 1); }, Side::Both);
  }
  addBothWays("flush parts", [] { return JoinedAll(TwoBoxes(0.0, 0.0, 2)); });
  addParts(
    "flush parts, two surfaces", [] { return TwoBoxes(0.0, 0.0); }, Side::Automatic);
  for (const double step : { 1e-9, 1e-6, 1e-3 })
  {
    add(
      "flush parts, a step of " + Text(step), [step] { return JoinedAll(TwoBoxes(0.0, step)); },
      Side::Automatic);
  }
  add(
    "overlapping flush parts", [] { return JoinedAll(TwoBoxes(-0.1, 0.0, 2)); }, Side::Automatic);
  add(
    "four flush parts", [] { return FourParts(0.0); }, Side::Automatic);
  add(
    "four parts, steps of 1e-7", [] { return FourParts(1e-7); }, Side::Automatic);
  addBothWays("T-junction", TJunction);
  addBothWays("cone", [] { return Cone(48, 0.3, 1.0); });
  addBothWays("sharp cone", [] { return Cone(12, 0.01, 1.0); });
  addBothWays("pyramid", [] { return Cone(4, 1.0, 0.5); });
  for (const unsigned seed : { 1u, 2u })
  {
    addBothWays("spikes " + std::to_string(seed), [seed] { return Star(3, 1.0, 0.9, seed); });
  }
  add(
    "spikes inside out", [] { return InsideOut(Star(3, 1.0, 0.8, 5)); }, Side::Front);
  add(
    "double-sided spikes", [] { return WithBacks(Star(2, 1.0, 0.7, 6)); }, Side::Front);
  add(
    "soup in float32", [] { return InFloat32(Soup(300, 0.4, 9)); }, Side::Both);
  add(
    "soup from the front", [] { return Soup(300, 0.4, 10); }, Side::Front);
  for (const double scale : { 1e-6, 1e6 })
  {
    add(
      "spikes at scale " + Text(scale), [scale] { return Scaled(Star(3, 1.0, 0.7, 8), scale); },
      Side::Front);
    add(
      "soup at scale " + Text(scale), [scale] { return Scaled(Soup(300, 0.4, 11), scale); },
      Side::Both);
    add(
      "fans at scale " + Text(scale), [scale] { return Scaled(Fans(4), scale); }, Side::Both);
    add(
      "flush parts at scale " + Text(scale),
      [scale] { return Scaled(JoinedAll(TwoBoxes(0.0, 0.0, 2)), scale); }, Side::Automatic);
  }
  add(
    "spikes, far away",
    [] {
      return Moved(Star(3, 1.0, 0.7, 12), { 5e5, 4e6, 100 });
    },
    Side::Front);
  add(
    "fans, far away",
    [] {
      return Moved(Fans(5), { 5e5, 4e6, 100 });
    },
    Side::Both);
  return scenes;
}
}

const std::vector<SoakScene>& AllSoakScenes()
{
  static const std::vector<SoakScene> scenes = MakeScenes();
  return scenes;
}
}
