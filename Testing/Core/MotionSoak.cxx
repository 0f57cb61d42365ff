// Moves a god-object along random ways among surfaces that move and deform at random, and asks
// exact arithmetic in every tick whether it is on the side where it was, and whether what holds it
// is there. Prints a table; exits with 1 when anything leaked or popped. `--help` says how to run
// it for long.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "HipPath.h"
#include "Judge.h"
#include "SoakOptions.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001; // [s]
/// Where a surface pushes the god-object along others it goes farther than the surface does.
constexpr double LargestPush = 50.0;

struct Part
{
  std::function<TriangleMesh()> Make;
  Side TouchedSide;
  double Drift; ///< speed of the motions [m/s]; 0: stands still
  double Wave;  ///< share of the radius that points move; 0: rigid
};

struct Scene
{
  const char* Name;
  std::vector<Part> Parts;
};

TriangleMesh Ball()
{
  return Icosphere(3, 0.03);
}

const std::vector<Scene>& AllScenes()
{
  static const std::vector<Scene> scenes = {
    { "star, slowly", { { [] { return Star(3, 0.03, 0.4, 3); }, Side::Front, 0.03, 0.0 } } },
    { "star, fast", { { [] { return Star(3, 0.03, 0.4, 3); }, Side::Front, 3.0, 0.0 } } },
    { "star from both sides", { { [] { return Star(3, 0.03, 0.4, 5); }, Side::Both, 1.0, 0.0 } } },
    { "plate of 1 um", { { [] { return Box(0.03, 0.03, 0.5e-6, 4); }, Side::Front, 1.0, 0.0 } } },
    { "torus, far away",
      { { [] {
           return Moved(Torus(0.025, 0.008, 32, 16), { 5e5, 4e6, 100 });
         },
        Side::Front, 0.5, 0.0 } } },
    { "two balls and a box",
      { { Ball, Side::Front, 0.3, 0.0 }, { Ball, Side::Front, 1.0, 0.0 },
        { [] { return Box(0.03, 0.03, 0.01, 3); }, Side::Front, 0.0, 0.0 } } },
    { "ball that waves", { { Ball, Side::Front, 0.0, 0.1 } } },
    { "ball that shakes", { { Ball, Side::Front, 0.0, 0.6 } } },
    { "star that waves", { { [] { return Star(3, 0.03, 0.4, 3); }, Side::Front, 0.0, 0.2 } } },
    { "waves from both sides", { { Ball, Side::Both, 0.0, 0.2 } } },
    { "star of sides by chance that waves",
      { { [] { return SidedAtRandom(Star(3, 0.03, 0.4, 3), 1); }, Side::Automatic, 0.3, 0.2 } } },
    { "waves that drift", { { Ball, Side::Front, 0.5, 0.2 } } },
    { "inside of a ball that waves",
      { { [] { return InsideOut(Icosphere(3, 0.03)); }, Side::Front, 0.1, 0.2 } } },
    { "two that wave and drift",
      { { Ball, Side::Front, 0.3, 0.2 }, { Ball, Side::Front, 0.3, 0.1 } } },
  };
  return scenes;
}

struct Tally
{
  long Ticks = 0, Contacts = 0, Leaks = 0, Pops = 0, Away = 0, Phantoms = 0, Squeezed = 0,
       Overloads = 0;
};

/// One part of a scene and how it moves.
class Actor
{
public:
  Actor(const Part& part, unsigned seed)
    : Kind(part)
    , Random(seed)
    , Rest(part.Make().Points)
    , Deformer(MakeSurface(part.Make(), part.TouchedSide))
    , Motion(part.Drift > 0.0 ? std::make_shared<SurfaceMotion>(RigidPose{},
                                  Deformer.Latest()->Origin(), Deformer.Latest()->Radius())
                              : nullptr)
  {
  }

  TouchedSurface Surface() const { return { this->Deformer.Latest(), this->Motion }; }

  /// Sends it elsewhere now and then, sooner or later than it has arrived.
  void Steer()
  {
    if (!this->Motion || this->NextSteer-- > 0)
    {
      return;
    }
    this->NextSteer = this->Integer(1, 40);
    const double duration = this->Integer(0, 40) * Tick;
    const double reach = this->Kind.Drift * std::max(duration, Tick);
    const Vec3 origin = this->Deformer.Latest()->Origin();
    const double radius = this->Deformer.Latest()->Radius();
    const Vec3 turn = (0.5 * reach / radius) * this->Normals();
    for (int i = 0; i < 3; ++i)
    {
      this->Turn[i + 1] += turn[i];
    }
    const double length = std::sqrt(this->Turn[0] * this->Turn[0] + this->Turn[1] * this->Turn[1] +
      this->Turn[2] * this->Turn[2] + this->Turn[3] * this->Turn[3]);
    for (double& x : this->Turn)
    {
      x /= length;
    }
    this->Place = 0.9 * this->Place + 0.5 * reach * this->Normals();
    RigidPose pose{ {}, this->Turn };
    pose.Translation = origin + this->Place - pose.VectorToWorld(origin);
    this->Motion->MoveTo(pose, duration);
  }

  /// Sends its points elsewhere; true where there is a new snapshot. Where the last has arrived
  /// only.
  bool Deform()
  {
    if (this->Kind.Wave == 0.0 || this->NextWave-- > 0)
    {
      return false;
    }
    const int ticks = this->Integer(1, 33);
    this->NextWave = ticks;
    const Vec3 origin = this->Deformer.Latest()->Origin();
    const Vec3 k = (200.0 * this->Normals());
    const double phase = this->Normal();
    const double size = this->Kind.Wave * std::abs(this->Normal()) / 3.0;
    std::vector<Vec3> points;
    for (const Vec3& p : this->Rest)
    {
      const Vec3 x = p - origin;
      // Never inside out, whatever the wave.
      points.push_back(
        origin + (1.0 + std::clamp(size * std::sin(Dot(k, x) + phase), -0.7, 0.7)) * x);
    }
    std::string error;
    if (!this->Deformer.Deform(std::move(points), ticks * Tick, error))
    {
      std::printf("%s\n", error.c_str());
      std::exit(1);
    }
    return true;
  }

private:
  double Normal() { return std::normal_distribution<double>()(this->Random); }
  Vec3 Normals()
  {
    const double x = this->Normal();
    const double y = this->Normal();
    return { x, y, this->Normal() };
  }
  int Integer(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Random);
  }
  Part Kind;
  std::mt19937 Random;
  std::vector<Vec3> Rest;
  SurfaceDeformer Deformer;
  std::shared_ptr<SurfaceMotion> Motion;
  std::array<double, 4> Turn{ 1, 0, 0, 0 };
  Vec3 Place{};
  int NextSteer = 0;
  int NextWave = 3;
};

/// Where all points of a surface are, in the world.
std::vector<Vec3> PointsInWorld(const GodObject& god, int surface)
{
  const TouchedSurface& touched = god.Surfaces()[surface];
  const RigidPose pose = touched.Motion ? touched.Motion->Pose() : RigidPose();
  const double fraction = god.DeformFraction(surface);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < touched.Surface->Points().size(); ++i)
  {
    const Vec3 local = touched.Surface->PointAt(static_cast<std::int32_t>(i), fraction);
    points.push_back(pose.PointToWorld(local + touched.Surface->Origin()));
  }
  return points;
}

/// All surfaces as they are now, in the world.
Judge JudgeInWorld(const GodObject& god)
{
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<bool> backs;
  for (std::size_t i = 0; i < god.Surfaces().size(); ++i)
  {
    const TriangleSurface& surface = *god.Surfaces()[i].Surface;
    const auto first = static_cast<std::int32_t>(points.size());
    const std::vector<Vec3> more = PointsInWorld(god, static_cast<int>(i));
    points.insert(points.end(), more.begin(), more.end());
    for (std::size_t t = 0; t < surface.Triangles().size(); ++t)
    {
      const auto& [a, b, c] = surface.Triangles()[t];
      triangles.push_back({ first + a, first + b, first + c });
      backs.push_back(surface.TouchesBack(static_cast<std::int32_t>(t)));
    }
  }
  return Judge(std::move(points), std::move(triangles), std::move(backs));
}

/// Whether the god-object is held in plain view of the HIP, also while all stands still for some
/// ticks.
bool IsPhantom(GodObject& god, const Vec3& hip)
{
  constexpr double clearances = 16.0;
  constexpr int rest = 8;
  double near = 0.0;
  double rounding = 0.0;
  for (const TouchedSurface& touched : god.Surfaces())
  {
    const double clearance = touched.Surface->Clearance();
    near = std::max(near, clearances * clearance);
    // Poses are rounded in the world.
    rounding = std::max(rounding, 0x1p-50 * Length(touched.Surface->Origin()) / clearance);
  }
  const Contact& contact = god.Current();
  const auto isHeld = [&]
  { return contact.Status == UpdateStatus::Touching && contact.Penetration > near; };
  if (rounding > 0.25 || !isHeld())
  {
    return false;
  }
  const Judge judge = JudgeInWorld(god);
  near = std::max(near, clearances * judge.LargestSliverClearance());
  for (int tick = 0; tick < rest && isHeld() && judge.IsInPlainView(hip, contact.Position); ++tick)
  {
    god.Update(hip);
  }
  return isHeld() && judge.IsInPlainView(hip, contact.Position);
}

void Run(const Scene& scene, HipPath::Kind kind, long ticks, unsigned seed, Tally& tally)
{
  std::deque<Actor> actors;
  for (std::size_t i = 0; i < scene.Parts.size(); ++i)
  {
    actors.emplace_back(scene.Parts[i], seed * 31 + static_cast<unsigned>(i));
  }
  const auto list = [&actors]
  {
    std::vector<TouchedSurface> surfaces;
    for (const Actor& actor : actors)
    {
      surfaces.push_back(actor.Surface());
    }
    return surfaces;
  };
  auto god = std::make_unique<GodObject>(list());
  const Vec3 middle = god->Surfaces().front().Surface->Origin();
  HipPath path(kind, 0.035, seed);
  std::vector<bool> wasInside(actors.size());
  std::vector<std::vector<Vec3>> before(actors.size());
  Vec3 positionBefore{};
  bool wasSqueezed = false;
  for (long tick = 0; tick < ticks; ++tick)
  {
    const Vec3 hip = middle + path.Next();
    const bool isPlaced = tick % 5000 == 0; // a restart, wherever that is
    bool isNew = false;
    for (Actor& actor : actors)
    {
      actor.Steer();
      if (god->HasArrived())
      {
        isNew = actor.Deform() || isNew;
      }
    }
    if (isNew)
    {
      auto next = std::make_unique<GodObject>(list());
      next->Continue(*god);
      god = std::move(next);
    }
    god->Advance(Tick);
    if (isPlaced)
    {
      god->Place(hip);
      positionBefore = hip;
    }
    const Contact& contact = god->Update(hip);
    double motion = 0.0;
    for (int i = 0; i < static_cast<int>(actors.size()); ++i)
    {
      const TouchedSurface& touched = god->Surfaces()[i];
      const ExactQueries exact(touched.Surface, god->DeformFraction(i));
      const bool isInside = exact.IsInside(god->LocalPosition(i));
      // A solid is open to whom is inside it, and an empty room to whom is outside.
      const bool isRoom = touched.Surface->Report().InsideOutComponents > 0;
      const bool isLeak = touched.Surface->TouchedSide() == Side::Both ? isInside != wasInside[i]
        : isRoom                                                       ? wasInside[i] && !isInside
                                                                       : !wasInside[i] && isInside;
      if (isLeak && !isPlaced)
      {
        ++tally.Leaks;
        std::printf("LEAK  %s, %s, tick %ld, seed %u, surface %d\n", scene.Name,
          HipPath::NameOf(kind), tick, seed, i);
      }
      wasInside[i] = isInside;
      std::vector<Vec3> now = PointsInWorld(*god, i);
      for (std::size_t k = 0; k < now.size() && !before[i].empty(); ++k)
      {
        motion = std::max(motion, Length(now[k] - before[i][k]));
      }
      before[i] = std::move(now);
    }
    const double size = 1e-9;
    // After a squeeze there is a place again somewhere, and not where it was.
    if (!isPlaced && !wasSqueezed &&
      Length(contact.SurfaceDisplacement) > LargestPush * motion + size)
    {
      ++tally.Pops;
      std::printf("POP   %s, %s, tick %ld, seed %u: %g, surfaces moved %g\n", scene.Name,
        HipPath::NameOf(kind), tick, seed, Length(contact.SurfaceDisplacement), motion);
    }
    const bool isSqueezed = contact.Status == UpdateStatus::Squeezed;
    wasSqueezed = isSqueezed;
    const Vec3 carried = positionBefore + contact.SurfaceDisplacement;
    if (!isPlaced && !isSqueezed &&
      Length(contact.Position - hip) > Length(carried - hip) * (1.0 + 1e-9) + 1e-9)
    {
      ++tally.Away;
      std::printf("AWAY  %s, %s, tick %ld, seed %u: %g\n", scene.Name, HipPath::NameOf(kind), tick,
        seed, Length(contact.Position - hip) - Length(carried - hip));
    }
    ++tally.Ticks;
    if (IsPhantom(*god, hip))
    {
      ++tally.Phantoms;
      std::printf("PHANTOM  %s, %s, tick %ld, seed %u: at { %.17g, %.17g, %.17g }, "
                  "HIP { %.17g, %.17g, %.17g }\n",
        scene.Name, HipPath::NameOf(kind), tick, seed, contact.Position[0], contact.Position[1],
        contact.Position[2], hip[0], hip[1], hip[2]);
    }
    positionBefore = contact.Position;
    tally.Contacts += contact.Status == UpdateStatus::Touching;
    tally.Squeezed += isSqueezed;
    tally.Overloads += contact.Status == UpdateStatus::Overloaded;
  }
}
}

int main(int argc, char* argv[])
{
  const SoakOptions options = SoakOptions::Parse(argc, argv, 400, 40000);
  std::printf("%-32s %10s %10s %6s %6s %6s %8s %9s %9s   (seed %u)\n", "scene", "ticks", "contacts",
    "leaks", "pops", "away", "phantoms", "squeezed", "overloads", options.Seed);
  Tally all;
  const auto print = [](const char* name, const Tally& t)
  {
    std::printf("%-32s %10ld %10ld %6ld %6ld %6ld %8ld %9ld %9ld\n", name, t.Ticks, t.Contacts,
      t.Leaks, t.Pops, t.Away, t.Phantoms, t.Squeezed, t.Overloads);
    std::fflush(stdout);
  };
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
    print(scene.Name, tally);
    all.Ticks += tally.Ticks;
    all.Contacts += tally.Contacts;
    all.Leaks += tally.Leaks;
    all.Pops += tally.Pops;
    all.Away += tally.Away;
    all.Phantoms += tally.Phantoms;
    all.Squeezed += tally.Squeezed;
    all.Overloads += tally.Overloads;
  }
  print("all", all);
  return all.Ticks > 0 && all.Leaks == 0 && all.Pops == 0 && all.Away == 0 && all.Phantoms == 0 ? 0
                                                                                                : 1;
}
