// A god-object on surfaces whose points move. Lengths are metres, a tick is a millisecond.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001;
/// The god-object keeps 1024 roundings off the surface: at these sizes under this.
constexpr double Tight = 1e-12;

using SurfacePointer = std::shared_ptr<const TriangleSurface>;

/// The points of a snapshot in the world, each put elsewhere by `map`.
template <class Map>
std::vector<Vec3> Mapped(const std::vector<Vec3>& points, const Map& map)
{
  std::vector<Vec3> mapped;
  for (const Vec3& p : points)
  {
    mapped.push_back(map(p));
  }
  return mapped;
}

/// A deforming surface in a servo's hands: a new god-object for each snapshot, as a scene does it.
class Playing
{
public:
  explicit Playing(TriangleMesh mesh, Side side = Side::Front)
    : Points(mesh.Points)
    , Deformer(MakeSurface(std::move(mesh), side))
    , God(std::make_unique<GodObject>(std::vector<TouchedSurface>{ Deformer.Latest() }))
  {
  }

  /// Sends the points on to their rest places moved by `map`, over `ticks`.
  template <class Map>
  void Deform(const Map& map, int ticks)
  {
    std::string error;
    const SurfacePointer next =
      this->Deformer.Deform(Mapped(this->Points, map), ticks * Tick, error);
    ASSERT_TRUE(next) << error;
    auto god = std::make_unique<GodObject>(std::vector<TouchedSurface>{ next });
    god->Continue(*this->God);
    this->God = std::move(god);
  }
  const Contact& Next(const Vec3& hip)
  {
    this->God->Advance(Tick);
    return this->God->Update(hip);
  }

  std::vector<Vec3> Points; ///< at rest
  SurfaceDeformer Deformer;
  std::unique_ptr<GodObject> God;
};
}

//   o            S8 for points that move: a plane that rises evenly, updated at 30 Hz
//  ____  ^
//   x    |
TEST(DeformingSurfaces, PushARestingHipWithoutSteps)
{
  constexpr double stiffness = 700.0;
  constexpr double speed = 0.03;
  Playing plane(Square(0.1, 8));
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  plane.God->Update({ hip[0], hip[1], 0.001 });
  double before = stiffness * plane.God->Update(hip).Penetration;
  double largestStep = 0.0;
  for (int tick = 0; tick < 1000; ++tick)
  {
    if (tick % 33 == 0)
    {
      ASSERT_TRUE(plane.God->HasArrived());
      plane.Deform(
        [tick](const Vec3& p) {
          return p + Vec3{ 0, 0, speed * (tick + 33) * Tick };
        },
        33);
    }
    const Contact& contact = plane.Next(hip);
    const double force = stiffness * contact.Penetration;
    largestStep = std::max(largestStep, std::abs(force - before));
    before = force;
    ASSERT_EQ(contact.NumberOfConstraints, 1) << tick;
    ASSERT_NEAR(contact.Position[2], speed * Tick * (tick + 1), Tight) << "tick " << tick;
    ASSERT_NEAR(contact.SurfaceDisplacement[2], speed * Tick, Tight);
  }
  EXPECT_LE(largestStep, 0.05);
  EXPECT_NEAR(largestStep, stiffness * speed * Tick, 1e-6); // and no less: it does move
}

//  \.
//    \.      a sharp edge whose faces open and close and that goes to and fro, pressed head-on: a
//    hand
//  x  o  x   that comes out in front of it is free in that tick
//    /
//  /
TEST(DeformingSurfaces, HoldNothingInTheOpen)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    TriangleMesh wedge;
    const double s = 0.01;
    wedge.Points = { { 0, 0, -0.03 }, { -0.04, s, -0.03 }, { -0.04, -s, -0.03 }, { 0, 0, 0.03 },
      { -0.04, s, 0.03 }, { -0.04, -s, 0.03 } };
    wedge.Triangles = { { 0, 2, 1 }, { 3, 4, 5 }, { 0, 1, 4 }, { 0, 4, 3 }, { 0, 5, 2 },
      { 0, 3, 5 }, { 1, 2, 5 }, { 1, 5, 4 } };
    Playing playing(wedge, side);
    playing.God->Update({ 0.02, 0, 0 });
    int held = 0;
    for (int tick = 0; tick < 1000; ++tick)
    {
      if (tick % 20 == 0)
      {
        const double opening = 1.0 + 0.9 * std::sin(0.013 * tick);
        const double shift = 0.004 * std::sin(0.031 * tick);
        playing.Deform(
          [opening, shift](const Vec3& p) {
            return Vec3{ p[0] + shift, p[1] * opening, p[2] };
          },
          20);
      }
      const bool isOut = tick % 7 > 3;
      const double aside = 1e-4 * std::sin(0.7 * tick);
      const Contact& contact = playing.Next({ isOut ? 0.01 : -0.02, aside, 1e-3 });
      held += contact.Status == UpdateStatus::Touching;
      EXPECT_TRUE(!isOut || contact.Status == UpdateStatus::Free) << "tick " << tick;
    }
    EXPECT_GT(held, 400);
  }
}

TEST(DeformingSurfaces, NothingPassesAtAnySpeed)
{
  for (const double step : { 1e-9, 1e-6, 5e-5, 3e-4, 1e-3, 5e-3, 0.1 })
  {
    for (const bool touching : { false, true })
    {
      Playing plane(Square(3.0, 4), Side::Both);
      const double height = touching ? -1e-4 : 10.3 * step;
      plane.God->Update({ 0.05, 0.025, 0.001 + 11 * step });
      plane.God->Update({ 0.05, 0.025, height });
      plane.Deform([step](const Vec3& p) { return p + (50 * step) * Vec3{ 0.3, 0, 1 }; }, 50);
      for (int tick = 1; tick <= 50; ++tick)
      {
        const Contact& contact = plane.Next({ 0.05, 0.025, height });
        ASSERT_NEAR(contact.Position[2], std::max(tick * step, height), 1e-10)
          << step << " m a tick, tick " << tick;
      }
    }
  }
}

//   ~~~o~~~     waves run through under a hand that rests: it goes up and down with them, and stays
//      x        on the outside, while a new snapshot comes 60 times a second
TEST(DeformingSurfaces, WavesCarryAHandAndNeverPassIt)
{
  Playing ball(Icosphere(4, 0.05));
  ball.God->Update({ 0.0, 0.0, 0.06 });
  const Vec3 hip{ 0.0, 0.001, 0.043 };
  ball.God->Update(hip);
  double last = 0.0;
  double most = 0.0;
  for (int tick = 0; tick < 600; ++tick)
  {
    if (tick % 17 == 0)
    {
      const double phase = 0.02 * (tick + 17);
      ball.Deform([phase](const Vec3& p)
        { return (1.0 + 0.05 * std::sin(60.0 * p[0] + 80.0 * p[2] + phase)) * p; },
        17);
    }
    const Contact& contact = ball.Next(hip);
    const ExactQueries exact(ball.Deformer.Latest(), ball.God->DeformFraction(0));
    ASSERT_FALSE(exact.IsInside(ball.God->LocalPosition(0))) << "tick " << tick;
    ASSERT_LT(exact.Distance(ball.God->LocalPosition(0)), 1e-9) << "off the surface";
    if (tick > 0)
    {
      most = std::max(most, std::abs(contact.Penetration - last));
    }
    last = contact.Penetration;
  }
  // The waves move a point by 2.5 mm times 20 rad/s: 50 um a tick, and a slope takes some more.
  EXPECT_LT(most, 2e-4);
  EXPECT_GT(most, 2e-5);
  EXPECT_LE(
    ball.Deformer.NumberOfBuilds(), 1); // where the waves are highest; the rest was refitted
}

TEST(DeformingSurfaces, EnginesFindTrianglesWhereverTheyPass)
{
  for (const EngineKind kind : { EngineKind::BruteForce, EngineKind::Embree })
  {
    const TriangleMesh mesh = Icosphere(3, 0.05);
    SurfaceDeformer deformer(MakeSurface(mesh, Side::Front, kind));
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int step = 1; step < 6; ++step) // the third is a refit
    {
      std::string error;
      const SurfacePointer surface = deformer.Deform(
        Mapped(mesh.Points, [step](const Vec3& p) { return (1.0 + 0.2 * (step % 3)) * p; }), 0.01,
        error);
      ASSERT_TRUE(surface) << error;
      for (int trial = 0; trial < 500; ++trial)
      {
        const auto triangle =
          static_cast<std::int32_t>(share(random) * (surface->Triangles().size() - 1));
        const double fraction = share(random);
        const auto& [a, b, c] = surface->Triangles()[triangle];
        const Vec3 middle = (1.0 / 3.0) *
          (surface->PointAt(a, fraction) + surface->PointAt(b, fraction) +
            surface->PointAt(c, fraction));
        std::vector<std::int32_t> room(surface->Triangles().size());
        TriangleList found{ room.data(), static_cast<std::int32_t>(room.size()) };
        surface->Engine().FindInBall(middle, 1e-6, found);
        ASSERT_NE(
          std::find(room.begin(), room.begin() + found.Count, triangle), room.begin() + found.Count)
          << "step " << step << ", fraction " << fraction;
      }
    }
  }
}

/// The radius of the bounds, which a surface has when it is built, is no growth of anything.
TEST(DeformingSurfaces, TheFirstDeformationRefitsACopyOfTheEngineThatThereIs)
{
  const TriangleMesh mesh = Icosphere(4, 0.05);
  SurfaceDeformer deformer(MakeSurface(mesh, Side::Front, EngineKind::Embree));
  std::string error;
  for (int step = 1; step < 6; ++step)
  {
    ASSERT_TRUE(deformer.Deform(
      Mapped(mesh.Points, [step](const Vec3& p) { return (1.0 + 0.01 * step) * p; }), 0.01, error))
      << error;
  }
  EXPECT_EQ(deformer.NumberOfBuilds(), 0);
}

TEST(DeformingSurfaces, AnEngineThatHasLostItsOrderIsBuiltAnew)
{
  const TriangleMesh mesh = Square(0.1, 32);
  SurfaceDeformer deformer(MakeSurface(mesh, Side::Both));
  std::string error;
  for (int step = 0; step < 6; ++step)
  {
    ASSERT_TRUE(deformer.Deform(mesh.Points, 0.0, error));
  }
  const int before = deformer.NumberOfBuilds();
  // Every second point is thrown far away: no neighbours are left.
  int i = 0;
  ASSERT_TRUE(deformer.Deform(Mapped(mesh.Points,
                                [&i](const Vec3& p) {
                                  return ++i % 2 ? p : p + Vec3{ 0, 0, 0.1 };
                                }),
    0.0, error));
  EXPECT_EQ(deformer.NumberOfBuilds(), before + 1);
}

TEST(DeformingSurfaces, WhatCannotBeDeformedIsRefusedAndTheLastStays)
{
  const TriangleMesh mesh = Icosphere(2, 0.05);
  SurfaceDeformer deformer(MakeSurface(mesh));
  const SurfacePointer before = deformer.Latest();
  std::string error;
  std::vector<Vec3> points = mesh.Points;
  points.pop_back();
  EXPECT_FALSE(deformer.Deform(points, 0.01, error));
  EXPECT_NE(error.find("161 points were given for a surface of 162"), std::string::npos) << error;
  points = mesh.Points;
  points[7][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(deformer.Deform(points, 0.01, error));
  EXPECT_NE(error.find("point 7 is not finite"), std::string::npos) << error;
  for (const double duration : { -0.1, 1.5, std::nan("") })
  {
    EXPECT_FALSE(deformer.Deform(mesh.Points, duration, error));
    EXPECT_NE(error.find("duration"), std::string::npos) << error;
  }
  EXPECT_FALSE(deformer.Deform(std::vector<Vec3>(mesh.Points.size()), 0.01, error)); // a scale of 0
  EXPECT_NE(error.find("no triangle"), std::string::npos) << error;
  EXPECT_EQ(deformer.Latest(), before);
  EXPECT_TRUE(deformer.Deform(mesh.Points, 0.01, error)) << error;
}

// What is certain to miss does; what passes over is found, wherever it does.
TEST(SweptTriangle, FindsWhatPassesOverAPoint)
{
  const auto sweep = [](const Vec3& from, const Vec3& to)
  {
    // Rises by one while it drifts.
    Playing sheet(
      TriangleMesh{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 } } }, Side::Both);
    sheet.God->Update(from);
    sheet.Deform([](const Vec3& p) { return p + Vec3{ 0.1, 0, 1 }; }, 1);
    return sheet.Next(to).Status;
  };
  EXPECT_EQ(sweep({ 0.3, 0.3, 0.5 }, { 0.3, 0.3, 0.5 }), UpdateStatus::Touching);
  EXPECT_EQ(sweep({ 0.9, 0.9, 0.5 }, { 0.9, 0.9, 0.5 }), UpdateStatus::Free);
  EXPECT_EQ(sweep({ -0.1, 0.3, 0.5 }, { -0.1, 0.3, 0.5 }), UpdateStatus::Free);
  EXPECT_EQ(sweep({ 0.3, 0.3, 1.5 }, { 0.3, 0.3, 1.5 }), UpdateStatus::Free);
  EXPECT_EQ(sweep({ 0.3, 0.3, -0.5 }, { 0.3, 0.3, -0.5 }), UpdateStatus::Free);
}
