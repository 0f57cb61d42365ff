// Moves a god-object along random ways over surfaces that break methods, and checks every piece of
// every way with exact arithmetic. Prints a table; exits with 1 when anything leaked, moved away
// from the HIP, or stuck more often than allowed. `--help` tells how to run it for long.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "GodObject.h"
#include "HipPath.h"
#include "SoakOptions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
struct Scene
{
  const char* Name;
  std::function<TriangleMesh()> Make;
  Side TouchedSide;
  double Reach; ///< the ways go as far as this from the origin [m]
};

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

const std::vector<Scene>& AllScenes()
{
  static const std::vector<Scene> scenes = {
    { "sphere", [] { return Icosphere(4, 0.03); }, Side::Front, 0.03 },
    { "inside of a sphere", [] { return InsideOut(Icosphere(4, 0.03)); }, Side::Front, 0.03 },
    { "box, along its lines", [] { return Box(0.03, 0.03, 0.03, 8); }, Side::Front, 0.03 },
    { "plate of 1 mm", [] { return Box(0.03, 0.03, 0.0005, 8); }, Side::Front, 0.03 },
    { "plate of 1 um", [] { return Box(0.03, 0.03, 0.5e-6, 4); }, Side::Front, 0.03 },
    { "star", [] { return Star(3, 0.04, 0.4, 3); }, Side::Front, 0.04 },
    { "star from both sides", [] { return Star(3, 0.04, 0.4, 3); }, Side::Both, 0.04 },
    { "fine noise", [] { return Star(5, 0.03, 0.02, 4); }, Side::Front, 0.03 },
    { "torus", [] { return Torus(0.025, 0.008, 64, 32); }, Side::Front, 0.033 },
    { "torus, far away",
      [] {
        return Moved(Torus(0.025, 0.008, 64, 32), { 5e5, 4e6, 100 });
      },
      Side::Front, 0.033 },
    { "groove of 5 degrees", [] { return Groove(5.0, 0.03); }, Side::Front, 0.03 },
    { "groove of 0.2 degrees", [] { return Groove(0.2, 0.03); }, Side::Both, 0.03 },
    { "nested sheets", Nested, Side::Front, 0.03 },
    { "nested sheets from both sides", Nested, Side::Both, 0.03 },
    { "boxes sharing an edge", SharedEdgeBoxes, Side::Both, 0.03 },
    { "star of sides by chance", [] { return SidedAtRandom(Star(3, 0.04, 0.4, 3), 1); },
      Side::Automatic, 0.04 },
    { "soup of sides by chance", [] { return SidedAtRandom(Scaled(Soup(400, 0.4, 7), 0.03), 2); },
      Side::Automatic, 0.04 },
    { "sheet through a solid",
      [] { return FrontAndBoth(Box(0.02, 0.02, 0.02, 4), Square(0.03, 4)); }, Side::Automatic,
      0.03 },
    { "sheets in and on a ball",
      []
      {
        return FrontAndBoth(
          Icosphere(3, 0.02), Joined(Square(0.012, 2), Moved(Square(0.03, 2), { 0, 0, 0.02 })));
      },
      Side::Automatic, 0.03 },
    { "solid and walls at an edge",
      []
      {
        TriangleMesh mesh = SharedEdgeBoxes();
        mesh.Sides.assign(mesh.Triangles.size(), Side::Both);
        std::fill(mesh.Sides.begin(), mesh.Sides.begin() + mesh.Sides.size() / 2, Side::Front);
        return mesh;
      },
      Side::Automatic, 0.03 },
    { "soup", [] { return Scaled(Soup(400, 0.4, 7), 0.03); }, Side::Both, 0.04 },
    { "slivers", [] { return Scaled(Icosphere(3, 1.0), 0.03); }, Side::Front, 0.03 },
  };
  return scenes;
}

struct Tally
{
  long Ticks = 0, Contacts = 0, Leaks = 0, Away = 0, Stalls = 0, DoubleStalls = 0, Overloads = 0;
};

/// Takes from `pull` what the normals span, one after another (Gram-Schmidt).
/// `lastPushes`: the last normal's share is against the pull.
double Remainder(const Vec3& pull, const std::vector<Vec3>& normals, bool& lastPushes)
{
  std::vector<Vec3> basis;
  Vec3 rest = pull;
  for (const Vec3& n : normals)
  {
    Vec3 direction = n;
    for (const Vec3& b : basis)
    {
      direction = direction - Dot(direction, b) * b;
    }
    direction = Unit(direction);
    const double share = Dot(rest, direction);
    lastPushes = share <= 0.0;
    rest = rest - share * direction;
    basis.push_back(direction);
  }
  return Length(rest);
}

/// How much of the pull from the god-object to the HIP its constraints leave unanswered, 0 to 1.
/// The multiplier of the last normal has the sign of what Gram-Schmidt leaves along it, so the
/// pull is answered when that holds with each normal put last.
double UnansweredPull(const Contact& contact)
{
  const Vec3 pull = -1.0 * contact.Displacement;
  double best = Length(pull);
  for (int subset = 1; subset < 1 << contact.NumberOfConstraints; ++subset)
  {
    std::vector<Vec3> normals;
    for (int i = 0; i < contact.NumberOfConstraints; ++i)
    {
      if (subset & (1 << i))
      {
        normals.push_back(contact.Constraints[i].Normal);
      }
    }
    double worst = 0.0;
    for (std::size_t last = 0; last < normals.size(); ++last)
    {
      std::rotate(normals.begin(), normals.begin() + 1, normals.end());
      bool pushes = false;
      const double remainder = Remainder(pull, normals, pushes);
      worst = std::max(worst, pushes ? remainder : Length(pull));
    }
    best = std::min(best, worst);
  }
  return best / contact.Penetration;
}

void Run(const Scene& scene, HipPath::Kind kind, long ticks, unsigned seed, Tally& tally)
{
  const auto surface = MakeSurface(scene.Make(), scene.TouchedSide);
  const ExactQueries exact(surface);
  GodObject god({ surface });
  HipPath path(kind, scene.Reach, seed);
  const Vec3& origin = surface->Origin();
  const double radius = surface->Radius();
  Vec3 before{};
  bool stalledBefore = false;
  for (long tick = 0; tick < ticks; ++tick)
  {
    const Vec3 hip = origin + path.Next();
    if (tick % 20000 == 0)
    {
      god.Place(hip); // a restart, wherever that is: inside is free to leave
      before = hip - origin;
      stalledBefore = false;
    }
    const Contact& contact = god.Update(hip);
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    for (int i = 0; i + 1 < corners; ++i)
    {
      if (exact.Crosses(way[i], way[i + 1]))
      {
        ++tally.Leaks;
        std::printf(
          "LEAK  %s, %s, tick %ld, seed %u\n", scene.Name, HipPath::NameOf(kind), tick, seed);
      }
    }
    if (way[0] != before)
    {
      ++tally.Leaks; // the pieces of the way have to join
      std::printf(
        "GAP   %s, %s, tick %ld, seed %u\n", scene.Name, HipPath::NameOf(kind), tick, seed);
    }
    const Vec3 now = way[corners - 1];
    const Vec3 goal = hip - origin;
    if (Length(now - goal) > Length(before - goal) * (1.0 + 1e-9) + 1e-12 * radius)
    {
      ++tally.Away;
      std::printf("AWAY  %s, %s, tick %ld, seed %u: %g\n", scene.Name, HipPath::NameOf(kind), tick,
        seed, Length(now - goal) - Length(before - goal));
    }
    ++tally.Ticks;
    tally.Contacts += contact.Status == UpdateStatus::Touching;
    tally.Overloads += contact.Status == UpdateStatus::Overloaded;
    const bool stalled = contact.Status != UpdateStatus::Free &&
      contact.Penetration > 1e-6 * radius && Length(now - before) < 1e-9 * radius &&
      UnansweredPull(contact) > 1e-3;
    tally.Stalls += stalled;
    tally.DoubleStalls += stalled && stalledBefore;
    stalledBefore = stalled;
    before = now;
  }
}
}

int main(int argc, char* argv[])
{
  const SoakOptions options = SoakOptions::Parse(argc, argv, 4000, 450000);
  std::printf("%-32s %10s %10s %6s %6s %7s %7s %9s   (seed %u)\n", "scene", "ticks", "contacts",
    "leaks", "away", "stalls", "twice", "overloads", options.Seed);
  Tally all;
  for (const Scene& scene : AllScenes())
  {
    if (!options.Chooses(scene.Name))
    {
      continue;
    }
    Tally tally;
    for (int kind = 0; kind < HipPath::NumberOfKinds; ++kind)
    {
      Run(scene, static_cast<HipPath::Kind>(kind), options.Ticks, options.Seed + kind, tally);
    }
    const auto print = [](const char* name, const Tally& t)
    {
      std::printf("%-32s %10ld %10ld %6ld %6ld %7ld %7ld %9ld\n", name, t.Ticks, t.Contacts,
        t.Leaks, t.Away, t.Stalls, t.DoubleStalls, t.Overloads);
      std::fflush(stdout);
    };
    print(scene.Name, tally);
    all.Ticks += tally.Ticks;
    all.Contacts += tally.Contacts;
    all.Leaks += tally.Leaks;
    all.Away += tally.Away;
    all.Stalls += tally.Stalls;
    all.DoubleStalls += tally.DoubleStalls;
    all.Overloads += tally.Overloads;
    if (&scene == &AllScenes().back())
    {
      print("all", all);
    }
  }
  const bool good = all.Leaks == 0 && all.Away == 0 && all.DoubleStalls == 0 &&
    all.Stalls * 100000 <= std::max(all.Ticks, 100000L) && all.Ticks > 0;
  return good ? 0 : 1;
}
