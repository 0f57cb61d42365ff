#include "Scenes.h"

#include "AnalyticSurfaces.h"
#include "CertifiedMethod.h"
#include "MaterialTools.h"
#include "PaperMethod.h"
#include "ProfileSurfaces.h"
#include "VectorFields.h"
#include "haptics/Contact/GodObject.h"

#include <algorithm>
#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;
constexpr double TickTime = 1e-3;          // [s]
constexpr double StrongMotors = 1e4;       // [N]: what the surface asks for is what acts
constexpr double SurfaceStiffness = 500.0; // [N/m]

/// The HIP is where the path says: a hand that no force moves.
Trace Along(ContactMethod& method, const std::vector<Vec3>& path, double stiffness)
{
  Trace trace;
  method.Place(path.front());
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const Vec3 held = method.Update(path[i]);
    trace.push_back({ TickTime * i, path[i], held, stiffness * (held - path[i]), 0.0, 0.0 });
  }
  return trace;
}

/// Appends a straight way in so many ticks.
void GoTo(std::vector<Vec3>& path, const Vec3& to, int ticks)
{
  const Vec3 from = path.back();
  for (int i = 1; i <= ticks; ++i)
  {
    path.push_back(from + (static_cast<double>(i) / ticks) * (to - from));
  }
}
}

Trace Pressed(ContactMethod& method, double stiffness, double delay, int ticks)
{
  BodyParameters body;
  body.Mass = delay > 0.0 ? 0.02 : 0.008; // the formulas are for friction small over the delay
  body.Damping = 0.35;
  body.Delay = delay;
  body.MaximumForce = StrongMotors;
  body.HandStiffness = 1.0;
  body.HandDamping = 0.0;
  ClosedLoop loop(method, body);
  loop.Stiffness = stiffness;
  loop.Place({ 0, 0.001, 0.001 });
  loop.Pull({ 0, 0.001, -1.0 });
  loop.Run(ticks);
  return loop.Ticks;
}

Trace OverRidge(ContactMethod& method, double stiffness)
{
  BodyParameters body; // an Omni in a hand
  body.Mass = 0.045;
  body.Damping = 0.1;
  body.CoulombFriction = 0.26;
  body.EncoderResolution = 5.5e-5;
  body.HandStiffness = 300.0;
  body.HandDamping = 3.0;
  ClosedLoop loop(method, body);
  loop.Stiffness = stiffness;
  loop.Place({ 0.0002, 0.001, 0.002 });
  loop.Follow(
    [](double t) -> Vec3
    {
      const double depth = std::min(0.03 * t, 0.006);
      const double across = t < 1.0 ? 0.004 * std::sin(4.0 * M_PI * t) : 0.0;
      return { across, 0.001, 0.002 - depth };
    });
  loop.Run(2000);
  return loop.Ticks;
}

Trace DownGroove(ContactMethod& method, double degrees)
{
  // Half-way down the groove, 3 mm into the left wall, then down and across.
  const double wall = 0.02 * std::tan(0.5 * degrees * Degree);
  std::vector<Vec3> path{ { 0, 0.001, 0.02 } };
  GoTo(path, { -wall - 0.003, 0.001, 0.02 }, 100);
  GoTo(path, { -0.003, 0.001, -0.006 }, 250);
  GoTo(path, { 0.006, 0.001, -0.006 }, 150);
  return Along(method, path, SurfaceStiffness);
}

Trace ThroughPlate(ContactMethod& method, double thickness)
{
  BodyParameters body;
  body.Mass = 0.05;
  body.Damping = 2.0;
  body.MaximumForce = StrongMotors;
  body.HandStiffness = 1.0; // pulled from far: a force that does not depend on where the body is
  body.HandDamping = 0.0;
  ClosedLoop loop(method, body);
  loop.Stiffness = SurfaceStiffness;
  const double start = 0.5 * thickness + 0.001;
  loop.Place({ 0.001, 0.002, start });
  loop.Follow(
    [start](double t) -> Vec3 {
      return { 0.001, 0.002, start - 5.0 * std::min(t / 0.8, 1.0) };
    });
  loop.Run(1000);
  return loop.Ticks;
}

Trace AlongCracks(ContactMethod& method, int ticks)
{
  const double lines[] = { 0.0, 0.0075, -0.0075, 0.015 };
  std::vector<Vec3> path{ { 0, 0, 0.031 } };
  for (int i = 0; i < ticks; ++i)
  {
    const double y = lines[(i / 1000) % 4];
    path.push_back({ 0.02 * std::sin(0.00131 * i), y, 0.028 });
  }
  return Along(method, path, SurfaceStiffness);
}

Trace AcrossValley(ContactMethod& method, int ticks)
{
  std::vector<Vec3> path{ { -0.004, 0.001, 0.01 } };
  GoTo(path, { -0.004, 0.001, -0.02 }, 60);
  for (int i = 0; i < ticks; ++i)
  {
    path.push_back({ 5e-5 * i - 0.004, 0.001, -0.02 });
  }
  return Along(method, path, SurfaceStiffness);
}

Trace IntoSheets(ContactMethod& method)
{
  std::vector<Vec3> path{ { 0.003, 0.001, 0.001 } };
  GoTo(path, { 0.003, 0.001, -0.002 }, 5);
  GoTo(path, { 0.013, 0.001, -0.002 }, 200);
  return Along(method, path, SurfaceStiffness);
}

Trace OnRisingPlane(double duration, double tip)
{
  const auto motion = std::make_shared<SurfaceMotion>(RigidPose{});
  GodObject god({ { MakeSurface(Square(0.1, 8)), motion } }, tip > 0.0 ? Tip::Ball : Tip::Point);
  god.SetTipRadius(tip);
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  god.Update({ hip[0], hip[1], 0.001 });
  Trace trace;
  for (int tick = 0; tick < 400; ++tick)
  {
    if (tick % 33 == 0)
    {
      motion->MoveTo({ { 0, 0, 0.03 * TickTime * (tick + 33) } }, duration);
    }
    god.Advance(TickTime);
    const Vec3 held = god.Update(hip).Position;
    trace.push_back({ TickTime * tick, hip, held, 700.0 * (held - hip), 0.0, 0.0 });
  }
  return trace;
}

namespace
{
/// Where a hand has moved with forces of its own.
LoopTick TickOf(int tick, const Vec3& hip, const Vec3& displacement, const Vec3& force)
{
  return { TickTime * tick, hip, hip + displacement, force, 0.0, 0.0 };
}

/// Pressed 5 mm deep at x = -20 mm, along to 20 mm, let go.
std::vector<Vec3> AcrossTable()
{
  std::vector<Vec3> path{ { -0.02, 0.0013, 0.001 } };
  GoTo(path, { -0.02, 0.0013, -0.005 }, 100);
  GoTo(path, { 0.02, 0.0013, -0.005 }, 400);
  GoTo(path, { 0.02, 0.0013, 0.001 }, 100);
  return path;
}
}

Trace SoftToHard(bool plain, double tip)
{
  const auto table = MakeSurface(Square(0.05, 20));
  PropertyValues values;
  values[Property::Stiffness] = AtPoints(
    *table, [](const Vec3& p) { return 500.0 + 300.0 * std::clamp(p[0] / 0.01, -1.0, 1.0); });
  const std::vector<Vec3> path = AcrossTable();
  MaterialHand hand(Touchable(table, values), path.front(), SurfaceStiffness, tip);
  Trace trace;
  for (std::size_t tick = 0; tick < path.size(); ++tick)
  {
    const Vec3 force = hand.Move(path[tick]);
    const Contact& contact = hand.God.Current();
    trace.push_back(TickOf(static_cast<int>(tick), path[tick], contact.Displacement,
      plain ? contact.Material.Stiffness * contact.Displacement : force));
  }
  return trace;
}

Trace Rubbed(double staticFriction, double dynamicFriction, double tip)
{
  const auto table = MakeSurface(Square(0.05, 20));
  std::vector<Vec3> path{ { 0, 0.0013, 0.001 } };
  GoTo(path, { 0, 0.0013, -0.004 }, 50);
  for (const double x : { 0.01, -0.01, 0.0 })
  {
    GoTo(path, { x, 0.0013, -0.004 }, 300);
  }
  MaterialHand hand(
    Touchable(table, Rough(staticFriction, dynamicFriction)), path.front(), SurfaceStiffness, tip);
  Trace trace;
  for (std::size_t tick = 0; tick < path.size(); ++tick)
  {
    const Vec3 force = hand.Move(path[tick]);
    trace.push_back(
      TickOf(static_cast<int>(tick), path[tick], hand.God.Current().Displacement, force));
  }
  return trace;
}

Trace IntoCorner(ContactMethod& method)
{
  // Box(0.02, ...): 4 mm under its top, then along to 2 mm from its side.
  std::vector<Vec3> path{ { 0.010, 0.001, 0.021 } };
  GoTo(path, { 0.010, 0.001, 0.016 }, 100);
  GoTo(path, { 0.018, 0.001, 0.016 }, 200);
  GoTo(path, { 0.010, 0.001, 0.016 }, 200);
  return Along(method, path, SurfaceStiffness);
}

Trace AroundEdge(ContactMethod& method)
{
  std::vector<Vec3> path{ { -0.004, 0.001, 0.001 } };
  GoTo(path, { -0.003, 0.001, -0.004 }, 10);
  GoTo(path, { 0.003, 0.001, -0.004 }, 20);
  GoTo(path, { 0.003, 0.001, -0.005 }, 5);
  return Along(method, path, SurfaceStiffness);
}

MethodPointer Certified(const TriangleMesh& mesh)
{
  return MakeCertified({ MakeSurface(mesh) });
}

MethodPointer CertifiedBall(const TriangleMesh& mesh, double radius)
{
  return MakeCertified({ MakeSurface(mesh) }, GodObject::LargestNumberOfPasses, radius);
}

MethodPointer Paper(const TriangleMesh& mesh, bool iterates, double grown)
{
  PaperOptions options;
  options.Iterates = iterates;
  options.Grown = grown;
  return std::make_unique<PaperMethod<double>>(mesh, options);
}

MethodPointer Nearest(const TriangleMesh& mesh)
{
  return std::make_unique<NearestSurface>(mesh);
}

MethodPointer CertifiedValley(double degrees, double tip)
{
  return MakeCertified(
    { MakeSurface(Slab(-0.5 * degrees, 0.1)), MakeSurface(Slab(0.5 * degrees, 0.1)) },
    GodObject::LargestNumberOfPasses, tip);
}

MethodPointer SummedValley(double degrees)
{
  std::vector<MethodPointer> fields;
  fields.push_back(Nearest(Slab(-0.5 * degrees, 0.1)));
  fields.push_back(Nearest(Slab(0.5 * degrees, 0.1)));
  return std::make_unique<SumOfFields>(std::move(fields));
}

namespace
{
template <class Run, class... Arguments>
std::function<Trace()> With(std::function<MethodPointer()> make, Run run, Arguments... arguments)
{
  return [=]
  {
    const MethodPointer method = make();
    return run(*method, arguments...);
  };
}
}

const std::vector<Scene>& AllScenes()
{
  constexpr double Limit = 700.0;              // 2b/T of the pressed body [N/m]
  constexpr double LimitAt5ms = 0.35 / 5.5e-3; // b / (T/2 + 5 ms)
  const char* const ours = "this project";
  static const std::vector<Scene> scenes = {
    { "S1", "A plane, pressed by 1 N: stiffness below and above 2b/T", "K = 0.5 (2b/T)",
      "K = 1.2 (2b/T)", With([] { return Certified(Square(0.1)); }, Pressed, 0.5 * Limit, 0.0, 400),
      With([] { return Certified(Square(0.1)); }, Pressed, 1.2 * Limit, 0.0, 400),
      With([] { return CertifiedBall(Square(0.1)); }, Pressed, 0.5 * Limit, 0.0, 400), { 0, 0, 1 },
      { { -0.004, 0 }, { 0.004, 0 } } },
    { "S2", "Fig. 3: a valley of normals 10 deg apart, pressed by 1 N, K = 0.6 (2b/T)", ours,
      "sum of fields", With([] { return CertifiedValley(10); }, Pressed, 0.6 * Limit, 0.0, 400),
      With([] { return SummedValley(10); }, Pressed, 0.6 * Limit, 0.0, 400),
      With([] { return CertifiedValley(10, TipRadius); }, Pressed, 0.6 * Limit, 0.0, 400),
      { 0, 0, 1 },
      { { -0.004, 0.004 * std::tan(5 * Degree) }, { 0, 0 },
        { 0.004, 0.004 * std::tan(5 * Degree) } } },
    { "S3", "A ridge of 10 deg, 4 mm below its edge, to and fro, then still, K = 1500 N/m", ours,
      "nearest surface", With([] { return Certified(Ridge(10, 0.05)); }, OverRidge, 1500.0),
      With([] { return Nearest(Ridge(10, 0.05)); }, OverRidge, 1500.0),
      With([] { return CertifiedBall(Ridge(10, 0.05)); }, OverRidge, 1500.0), { 1, 0, 0 },
      { { -0.0006, -0.00686 }, { 0, 0 }, { 0.0006, -0.00686 } } },
    { "S4", "Fig. 6: down the wall of a groove of 30 deg and across its crease", ours,
      "the paper, not iterated",
      With([] { return Certified(GroovedBlock(30, 0.03)); }, DownGroove, 30.0),
      With([] { return Paper(GroovedBlock(30, 0.03), false); }, DownGroove, 30.0),
      With([] { return CertifiedBall(GroovedBlock(30, 0.03)); }, DownGroove, 30.0), { 0, 0, 1 },
      { { -0.03 * std::tan(15 * Degree), 0.03 }, { 0, 0 },
        { 0.03 * std::tan(15 * Degree), 0.03 } } },
    { "S5", "Fig. 4: a plate of 4 mm, pressed by a force that grows to 5 N", ours,
      "nearest surface",
      With([] { return Certified(Box(0.05, 0.05, 0.002, 4)); }, ThroughPlate, 0.004),
      With([] { return Nearest(Box(0.05, 0.05, 0.002, 4)); }, ThroughPlate, 0.004),
      With([] { return CertifiedBall(Box(0.05, 0.05, 0.002, 4)); }, ThroughPlate, 0.004),
      { 0, 0, 1 }, { { -0.01, 0.002 }, { 0.012, 0.002 }, { 0.012, -0.002 }, { -0.01, -0.002 } } },
    { "S6", "Along cracks of 10 um between all triangles, 2 mm deep", ours, "the paper, iterated",
      With(
        []
        {
          SurfaceOptions options;
          options.TouchedSide = Side::Front;
          options.CrackWidth = 2e-5;
          std::string error;
          return MakeCertified(
            { TriangleSurface::Build(Cracked(Box(0.03, 0.03, 0.03, 8), 1e-5), options, error) });
        },
        AlongCracks, 2000),
      With([] { return Paper(Cracked(Box(0.03, 0.03, 0.03, 8), 1e-5), true); }, AlongCracks, 2000),
      With(
        [] { return CertifiedBall(Cracked(Box(0.03, 0.03, 0.03, 8), 1e-5)); }, AlongCracks, 2000),
      { 0, 0, 1 }, { { -0.03, 0.03 }, { 0.03, 0.03 } } },
    { "S7", "An obtuse valley of 150 deg, across its crease 20 mm deep", ours,
      "the paper, iterated", With([] { return Certified(Groove(150, 0.2)); }, AcrossValley, 1600),
      With([] { return Paper(Groove(150, 0.2), true); }, AcrossValley, 1600),
      With([] { return CertifiedBall(Groove(150, 0.2)); }, AcrossValley, 1600), { 1, 0, 0 },
      { { -0.05, 0.05 * std::tan(15 * Degree) }, { 0, 0 }, { 0.1, 0.1 * std::tan(15 * Degree) } } },
    { "S8", "A plane that rises at 30 mm/s, updated 30 times a second, against a still hand", ours,
      "the mesh stepped", [] { return OnRisingPlane(33 * TickTime); },
      [] { return OnRisingPlane(0.0); }, [] { return OnRisingPlane(33 * TickTime, TipRadius); },
      { 0, 0, 1 }, { { 0.009, 0 }, { 0.017, 0 } } },
    { "S9", "From 200 to 800 N/m 5 mm deep, then let go: 7.5 mJ from nowhere, or none", ours,
      "a plain spring", [] { return SoftToHard(false); }, [] { return SoftToHard(true); },
      [] { return SoftToHard(false, TipRadius); }, { 0, 0, 1 }, { { -0.025, 0 }, { 0.025, 0 } } },
    { "S10", "Rubbed 4 mm deep: static friction 0.6, dynamic 0.35", ours, "no friction",
      [] { return Rubbed(0.6, 0.35); }, [] { return Rubbed(0.0, 0.0); },
      [] { return Rubbed(0.6, 0.35, TipRadius); }, { 1, 0, 0 }, { { -0.014, 0 }, { 0.014, 0 } } },
    { "S12", "A plane behind 5 ms of delay, pressed by 1 N", "K = 0.5 b/(T/2 + delay)",
      "K = 0.5 (2b/T)",
      With([] { return Certified(Square(0.1)); }, Pressed, 0.5 * LimitAt5ms, 5e-3, 900),
      With([] { return Certified(Square(0.1)); }, Pressed, 0.5 * Limit, 5e-3, 900),
      With([] { return CertifiedBall(Square(0.1)); }, Pressed, 0.5 * LimitAt5ms, 5e-3, 900),
      { 0, 0, 1 }, { { -0.004, 0 }, { 0.004, 0 } } },
    { "S13", "Eight sheets 0.2 mm apart, passed within 5 ms, then along them", ours,
      "the paper, not iterated", With([] { return Certified(Sheets(8, 2e-4, 0.05)); }, IntoSheets),
      With([] { return Paper(Sheets(8, 2e-4, 0.05), false); }, IntoSheets),
      With([] { return CertifiedBall(Sheets(8, 2e-4, 0.05)); }, IntoSheets), { 1, 0, 0 },
      { { 0.0, 0 }, { 0.016, 0 } } },
    { "Fig. 2", "Inside a square: from its top to where its side is nearer, and back", ours,
      "nearest surface", With([] { return Certified(Box(0.02, 0.02, 0.02)); }, IntoCorner),
      With([] { return Nearest(Box(0.02, 0.02, 0.02)); }, IntoCorner),
      With([] { return CertifiedBall(Box(0.02, 0.02, 0.02)); }, IntoCorner), { 1, 0, 0 },
      { { 0.006, 0.02 }, { 0.02, 0.02 }, { 0.02, 0.012 } } },
    { "Fig. 5", "Over a convex edge of 150 deg at 0.3 m/s, one step a tick", ours,
      "one pass a tick", With([] { return Certified(Ridge(150, 0.02)); }, AroundEdge),
      With([] { return MakeCertified({ MakeSurface(Ridge(150, 0.02)) }, 1); }, AroundEdge),
      With([] { return CertifiedBall(Ridge(150, 0.02)); }, AroundEdge), { 1, 0, 0 },
      { { -0.005, -0.005 * std::tan(15 * Degree) }, { 0, 0 },
        { 0.005, -0.005 * std::tan(15 * Degree) } } },
  };
  return scenes;
}
}
