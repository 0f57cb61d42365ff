// A god-object that is a ball on surfaces that move, deform, come and go, and have properties. In
// the drawings O is the ball and x the haptic interface point (HIP). Lengths are metres, a tick is
// a millisecond.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "MaterialTools.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"
#include "haptics/Tick/ContactTick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double R = 0.003;
constexpr double Tick = 0.001;
constexpr double Tight = 1e-10;
/// What a ball may be short of its radius, as a share of it.
constexpr double Short = 1e-6;

std::unique_ptr<GodObject> MakeBall(std::vector<TouchedSurface> surfaces, double radius = R)
{
  auto god = std::make_unique<GodObject>(std::move(surfaces), Tip::Ball);
  god->SetTipRadius(radius);
  return god;
}

std::shared_ptr<SurfaceMotion> Standing()
{
  return std::make_shared<SurfaceMotion>(RigidPose());
}

RigidPose Turned(const Vec3& axis, double radians, const Vec3& translation = {})
{
  const double s = std::sin(0.5 * radians);
  const Vec3 u = Unit(axis);
  return { translation, { std::cos(0.5 * radians), s * u[0], s * u[1], s * u[2] } };
}

void ExpectAt(const Contact& contact, const Vec3& position, double tolerance = Tight)
{
  EXPECT_NEAR(contact.Position[0], position[0], tolerance);
  EXPECT_NEAR(contact.Position[1], position[1], tolerance);
  EXPECT_NEAR(contact.Position[2], position[2], tolerance);
}

double Distance(const std::shared_ptr<const TriangleSurface>& surface, const GodObject& god, int i)
{
  return ExactQueries(surface, god.DeformFraction(i)).Distance(god.LocalPosition(i));
}
}

//      O
//  ---------  ^
//      x      |
TEST(BallOnMovingSurfaces, IsPushedByAPlane)
{
  const auto motion = Standing();
  const auto god = MakeBall({ { MakeSurface(Square(0.1, 8)), motion } });
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  god->Update({ hip[0], hip[1], 0.01 });
  god->Update(hip);
  for (int tick = 1; tick < 500; ++tick)
  {
    motion->MoveTo({ { 0, 0, 5e-5 * tick } }, 0.0);
    god->Advance(Tick);
    const Contact& contact = god->Update(hip);
    ASSERT_EQ(contact.NumberOfConstraints, 1);
    ExpectAt(contact, { hip[0], hip[1], R + 5e-5 * tick });
    ASSERT_NEAR(contact.SurfaceDisplacement[2], 5e-5, Tight);
  }
}

// A body that tumbles and flies about, at up to 0.1 m and 30 degrees a tick.
TEST(BallOnMovingSurfaces, OverlapsNothingAtAnySpeed)
{
  for (const double speed : { 1e-4, 1e-3, 1e-2, 0.1 })
  {
    const auto surface = MakeSurface(Star(2, 0.05, 0.3, 9), Side::Both);
    const auto motion = Standing();
    const auto god = MakeBall({ { surface, motion } });
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    god->Update({ 0, 0, 0.07 });
    RigidPose pose;
    Vec3 hip{ 0, 0, 0.05 };
    int touching = 0;
    for (int tick = 0; tick < 600; ++tick)
    {
      const Vec3 step = (speed * 0.5) * Vec3{ normal(random), normal(random), normal(random) };
      const Vec3 pull = -0.05 * pose.Translation;
      pose = Turned({ 1, 2, 3 }, 5.0 * speed * tick, pose.Translation + step + pull);
      motion->MoveTo(pose, 0.0);
      hip = 0.9 * hip + 0.1 * pose.Translation + 0.001 * Vec3{ normal(random), 0, normal(random) };
      god->Advance(Tick);
      const Contact& contact = god->Update(hip);
      touching += contact.IsTouching() ? 1 : 0;
      ASSERT_NE(contact.Status, UpdateStatus::Overloaded);
      if (contact.Status != UpdateStatus::Squeezed)
      {
        ASSERT_GE(Distance(surface, *god, 0), god->BallRadius() * (1.0 - Short))
          << speed << " m a tick, tick " << tick;
        ASSERT_FALSE(ExactQueries(surface).IsInside(god->LocalPosition(0)));
      }
      ASSERT_EQ(god->BallRadius(), R);
    }
    EXPECT_GT(touching, 10) << speed;
  }
}

//      |
//      v
//   -------
//      O         two plates that close in on it leave no place, and give it free again
//   -------
TEST(BallOnMovingSurfaces, IsSqueezedByPlatesThatAreNearerThanItIsWide)
{
  const auto motion = Standing();
  const auto below = MakeSurface(Square(0.1, 3), Side::Both);
  const auto above = MakeSurface(Moved(Square(0.1, 5), { 0, 0, 0.02 }), Side::Both);
  const auto god = MakeBall({ { below }, { above, motion } });
  const Vec3 hip{ 0.01, 0.02, 0.004 };
  god->Update(hip);
  bool wasSqueezed = false;
  for (int tick = 1; tick <= 360; ++tick)
  {
    const double gap = 0.02003 - 1e-4 * std::min(tick, 360 - tick);
    motion->MoveTo({ { 0, 0, gap - 0.02 } }, 0.0);
    god->Advance(Tick);
    const Contact& contact = god->Update(hip);
    const bool isSqueezed = contact.Status == UpdateStatus::Squeezed;
    ASSERT_EQ(isSqueezed, gap < 2.0 * R) << gap;
    wasSqueezed = wasSqueezed || isSqueezed;
    if (!isSqueezed)
    {
      ExpectAt(contact, { 0.01, 0.02, std::min(hip[2], gap - R) });
    }
  }
  EXPECT_TRUE(wasSqueezed);
  god->Update({ 0.01, 0.02, -0.01 });
  ExpectAt(god->Update({ 0.01, 0.02, -0.01 }), { 0.01, 0.02, R });
}

// A sheet whose points wave, by up to a tenth of a radius a tick.
TEST(BallOnDeformingSurfaces, OverlapsNothingAtTheEndOfATick)
{
  const TriangleMesh mesh = Square(0.05, 12);
  SurfaceDeformer deformer(MakeSurface(mesh, Side::Both));
  auto god = MakeBall({ deformer.Latest() });
  god->Update({ 0.003, 0.002, 0.03 });
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Vec3 hip{ 0.003, 0.002, -0.02 };
  int touching = 0;
  for (int shape = 0; shape < 40; ++shape)
  {
    std::vector<Vec3> points;
    for (const Vec3& p : mesh.Points)
    {
      const double wave = 0.008 * std::sin(60.0 * p[0] + shape) * std::cos(50.0 * p[1] - shape);
      points.push_back({ p[0] + 0.1 * wave, p[1], wave });
    }
    std::string error;
    const auto next = deformer.Deform(points, 40 * Tick, error);
    ASSERT_TRUE(next) << error;
    auto renewed = MakeBall({ next });
    renewed->Continue(*god);
    god = std::move(renewed);
    for (int tick = 0; tick < 40; ++tick)
    {
      hip[0] = std::clamp(hip[0] + 2e-4 * normal(random), -0.03, 0.03);
      hip[1] = std::clamp(hip[1] + 2e-4 * normal(random), -0.03, 0.03);
      god->Advance(Tick);
      const Contact& contact = god->Update(hip);
      touching += contact.IsTouching() ? 1 : 0;
      ASSERT_GE(Distance(next, *god, 0), R * (1.0 - Short)) << shape << " " << tick;
      ASSERT_GT(contact.Position[2], -0.008) << "it is through";
    }
  }
  EXPECT_EQ(touching, 40 * 40);
}

// A plane that rises evenly takes it along as a rigid one does.
TEST(BallOnDeformingSurfaces, IsPushedByAPlane)
{
  TriangleMesh mesh = Square(0.1, 8);
  SurfaceDeformer deformer(MakeSurface(mesh));
  auto god = MakeBall({ deformer.Latest() });
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  god->Update({ hip[0], hip[1], 0.01 });
  god->Update(hip);
  for (Vec3& p : mesh.Points)
  {
    p[2] += 0.01;
  }
  std::string error;
  const auto next = deformer.Deform(mesh.Points, 100 * Tick, error);
  ASSERT_TRUE(next) << error;
  auto renewed = MakeBall({ next });
  EXPECT_TRUE(renewed->Continue(*god));
  for (int tick = 1; tick <= 100; ++tick)
  {
    renewed->Advance(Tick);
    ExpectAt(renewed->Update(hip), { hip[0], hip[1], R + 1e-4 * tick });
  }
}

//    \ O /      the walls are surfaces of their own
TEST(BallOnSeveralSurfaces, TouchesThemInAnyOrder)
{
  TriangleMesh left = Square(0.1, 4);
  TriangleMesh right = left;
  for (std::size_t i = 0; i < left.Points.size(); ++i)
  {
    const Vec3 p = left.Points[i];
    left.Points[i] = { p[2] + 0.6 * p[0], p[1], -0.8 * p[0] };
    right.Points[i] = { -p[2] + 0.6 * p[0], p[1], 0.8 * p[0] };
  }
  const auto a = MakeSurface(left, Side::Both);
  const auto b = MakeSurface(right, Side::Both);
  for (const bool isTurned : { false, true })
  {
    const auto god = isTurned ? MakeBall({ { b }, { a } }) : MakeBall({ { a }, { b } });
    god->Update({ 0, 0, 0.05 });
    const Contact& contact = god->Update({ 0, 0.002, -0.01 });
    ExpectAt(contact, { 0, 0.002, R / 0.6 });
    EXPECT_EQ(contact.NumberOfConstraints, 2);
    EXPECT_NE(contact.Constraints[0].Surface, contact.Constraints[1].Surface);
  }
}

//      O------->       sticks within the cone, slides at its side
//     x
TEST(BallWithFriction, SticksAndSlides)
{
  const auto surface = MakeSurface(Square(0.1, 9));
  const auto god = MakeBall({ Touchable(surface, Rough(0.5, 0.3)) });
  god->Update({ 0.01, 0, 0.01 });
  const Vec3 start = god->Update({ 0.01, 0, R - 0.002 }).Position;
  for (int tick = 0; tick < 2000; ++tick)
  {
    const double way = 1e-6 * tick;
    const Contact& contact = god->Update({ 0.01 + way, 0, R - 0.002 });
    if (way < 0.5 * 0.002 - 1e-8)
    {
      ASSERT_EQ(contact.Position, start) << tick;
    }
    if (way > 0.5 * 0.002 + 1e-8)
    {
      ASSERT_NEAR(contact.Position[0], 0.01 + way - 0.3 * 0.002, 1e-8) << tick;
    }
  }
}

//       O
//      / \     what it touches counts, not what is under its centre
TEST(BallWithMaterials, HasTheMaterialOfThePlaceThatItTouches)
{
  TriangleMesh slope = Square(0.1, 1);
  for (Vec3& p : slope.Points)
  {
    p = { 0.8 * p[0], p[1], 0.6 * p[0] };
  }
  const auto surface = MakeSurface(slope);
  PropertyValues values;
  values[Property::Stiffness] =
    AtPoints(*surface, [](const Vec3& p) { return 1000.0 + 8000.0 * p[0]; });
  const auto god = MakeBall({ Touchable(surface, values) });
  god->Update({ 0, 0, 0.02 });
  const Vec3 normal{ -0.6, 0, 0.8 };
  const Vec3 place{ 0.016, 0.01, 0.012 };
  ContactTick tick;
  const WorkspaceTransform same;
  SurfaceForce law;
  const Vec3 hip = place + (R - 0.001) * normal;
  const Contact& contact = tick.Touch(*god, hip, hip, same);
  ExpectAt(contact, place + R * normal);
  EXPECT_NEAR(contact.Material.Stiffness, 1000.0 + 8000.0 * place[0], 1e-3);
  TickRecord record;
  tick.Record(*god, {}, law, record);
  const Triangle& corners = surface->Triangles()[record.Constraints[0].Triangle];
  Vec3 touched{};
  for (int i = 0; i < 3; ++i)
  {
    touched = touched + record.Weights[i] * surface->Points()[corners[i]];
  }
  EXPECT_LT(Length(touched - (place - surface->Origin())), Tight);
  EXPECT_LT(Length(record.Local - (place - surface->Origin())), Tight);
}

//    \ O /     each wall counts by its push
TEST(BallWithMaterials, BlendsWhatItTouches)
{
  TriangleMesh floor = Square(0.1, 2);
  TriangleMesh wall = floor;
  for (Vec3& p : wall.Points)
  {
    p = { -p[2], p[1], p[0] };
  }
  const auto low = MakeSurface(floor, Side::Both);
  const auto side = MakeSurface(wall, Side::Both);
  const auto god = MakeBall({ Touchable(low, Everywhere(200.0, 0, 0, 0, 0)),
    Touchable(side, Everywhere(800.0, 0, 0, 0, 0)) });
  god->Update({ 0.03, 0, 0.03 });
  const Contact& contact = god->Update({ R - 0.001, 0, R - 0.003 });
  ExpectAt(contact, { R, 0, R });
  EXPECT_NEAR(contact.Material.Stiffness, 0.75 * 200.0 + 0.25 * 800.0, 1e-3);
}

// As for a point: no contact while it is gripped, and on its side when let go of.
TEST(BallWithGrippedSurfaces, KeepsItsSide)
{
  const auto part = MakeSurface(Box(0.02, 0.02, 0.02, 2));
  const auto wall = MakeSurface(Moved(Square(1.0, 4), { 0, 0, -0.05 }));
  const auto motion = Standing();
  const auto made = [&](bool isGripped)
  {
    TouchedSurface held(part, motion);
    held.Identity = 2;
    held.IsGripped = isGripped;
    TouchedSurface still(wall);
    still.Identity = 1;
    return MakeBall({ still, held });
  };
  auto god = made(false);
  god->Update({ 0, 0, 0.05 });
  ExpectAt(god->Update({ 0.001, 0, 0.021 }), { 0.001, 0, 0.02 + R });
  auto gripped = made(true);
  EXPECT_FALSE(gripped->Continue(*god));
  for (int tick = 1; tick <= 100; ++tick)
  {
    motion->MoveTo({ { 2e-4 * tick, 0, 1e-4 * tick } }, 0.0);
    gripped->Advance(Tick);
    const Vec3 hip{ 0.001 + 2e-4 * tick, 0, 0.02 + R + 1e-4 * tick };
    EXPECT_EQ(gripped->Update(hip).Status, UpdateStatus::Free);
  }
  auto free = made(false);
  free->Continue(*gripped);
  const Contact& contact = free->Update({ 0.021, 0, 0.02 });
  ExpectAt(contact, { 0.021, 0, 0.03 + R }, 1e-9);
  EXPECT_EQ(free->BallRadius(), R);
}

// One that has been there is still touched when others come and go.
TEST(BallOnChangingSurfaces, StaysWhereItIs)
{
  const auto box = MakeSurface(Box(0.02, 0.02, 0.02, 2));
  const auto other = MakeSurface(Moved(Square(0.1, 3), { 0, 0, -0.03 }));
  const auto god = MakeBall({ { box } });
  god->Update({ 0, 0, 0.05 });
  const Vec3 hip{ 0.003, 0.001, 0.015 };
  const Vec3 before = god->Update(hip).Position;
  const auto next = MakeBall({ { box }, { other } });
  next->Continue(*god);
  ExpectAt(next->Update(hip), before, 0.0);
}

// One that comes up where it is has it outside: a ball as large as fits, which then grows.
TEST(BallOnChangingSurfaces, IsOutsideOfWhatGrowsOverIt)
{
  const auto made = [](double radius)
  {
    std::vector<TouchedSurface> list{ MakeSurface(Icosphere(3, radius)) };
    list.front().Identity = 1;
    return MakeBall(std::move(list));
  };
  const auto god = made(0.03);
  const Vec3 hip{ 0.001, 0.002, 0.04 };
  god->Update(hip);
  const auto next = made(0.05);
  next->Continue(*god);
  EXPECT_GT(Length(next->Update(hip).Position), 0.0495);
  next->Update({ 0, 0, 0.06 });
  next->Update({ 0, 0, 0.06 });
  EXPECT_EQ(next->BallRadius(), R);
  EXPECT_GT(Length(next->Update(hip).Position), 0.0495 + R);
}
