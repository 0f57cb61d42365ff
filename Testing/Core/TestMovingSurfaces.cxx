// A god-object on surfaces that move as rigid bodies, each on its own. In the drawings o is the
// god-object and x the haptic interface point (HIP). Lengths are metres, a tick is a millisecond.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001;
/// The god-object keeps 1024 roundings off the surface: at these sizes under this.
constexpr double Tight = 1e-12;

std::shared_ptr<SurfaceMotion> Standing(const RigidPose& pose = {})
{
  return std::make_shared<SurfaceMotion>(pose);
}

RigidPose Turned(const Vec3& axis, double radians, const Vec3& translation = {})
{
  const double s = std::sin(0.5 * radians);
  const Vec3 u = Unit(axis);
  return { translation, { std::cos(0.5 * radians), s * u[0], s * u[1], s * u[2] } };
}

Contact TickWith(GodObject& god, const Vec3& hip)
{
  god.Advance(Tick);
  return god.Update(hip);
}
}

//      o
//  ---------  ^      S8: pushed up evenly, though the pose is updated at 30 Hz only
//      x      |
TEST(MovingSurfaces, PushARestingHipWithoutSteps)
{
  constexpr double stiffness = 700.0;
  constexpr double speed = 0.03;
  const auto motion = Standing();
  GodObject god({ { MakeSurface(Square(0.1, 8)), motion } });
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  god.Update({ hip[0], hip[1], 0.001 });
  double before = stiffness * god.Update(hip).Penetration;
  double largestStep = 0.0;
  for (int tick = 0; tick < 1000; ++tick)
  {
    if (tick % 33 == 0)
    {
      motion->MoveTo({ { 0, 0, speed * (tick + 33) * Tick } }, 33 * Tick);
    }
    const Contact& contact = TickWith(god, hip);
    const double force = stiffness * contact.Penetration;
    largestStep = std::max(largestStep, std::abs(force - before));
    before = force;
    ASSERT_EQ(contact.NumberOfConstraints, 1);
    ASSERT_NEAR(contact.Position[2], motion->Pose().Translation[2], Tight) << "tick " << tick;
    ASSERT_NEAR(contact.SurfaceDisplacement[2], speed * Tick, Tight);
  }
  EXPECT_LE(largestStep, 0.05);
  EXPECT_NEAR(largestStep, stiffness * speed * Tick, 1e-6); // and no less: it does move
}

// CHAI3D loses its proxy behind a plane that rises by 50 um a tick.
TEST(MovingSurfaces, NothingPassesAtAnySpeed)
{
  for (const double step : { 1e-9, 1e-6, 5e-5, 3e-4, 1e-3, 5e-3, 0.1 })
  {
    for (const bool touching : { false, true })
    {
      const auto motion = Standing();
      GodObject god({ { MakeSurface(Square(3.0, 4), Side::Both), motion } });
      const double height = touching ? -1e-4 : 10.3 * step;
      god.Update({ 0.05, 0.025, 0.001 + 11 * step });
      god.Update({ 0.05, 0.025, height });
      double z = 0.0;
      for (int tick = 0; tick < 50; ++tick)
      {
        z += step;
        motion->MoveTo({ { 0.3 * z, 0, z } }, 0.0);
        const Contact& contact = TickWith(god, { 0.05, 0.025, height });
        ASSERT_NEAR(contact.Position[2], std::max(z, height), 1e-11) << step << " m a tick";
      }
    }
  }
}

namespace
{
/// How many of 5000 ticks a god-object of a moving frame lies elsewhere in than that of a still
/// one.
int TicksElsewhere(int substeps)
{
  const auto surface = MakeSurface(Star(4, 0.03, 0.1, 5));
  const auto motion = Standing();
  GodObject still({ surface });
  GodObject moving({ { surface, motion } });
  still.SetSubstepLimit(substeps);
  moving.SetSubstepLimit(substeps);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  RigidPose pose;
  Vec3 axis{ 1, 0, 0 };
  Vec3 place{};
  Vec3 direction{ 0, 0, 1 };
  double angle = 0.0;
  still.Update({ 0, 0, 0.05 });
  moving.Update({ 0, 0, 0.05 });
  int contacts = 0;
  int elsewhere = 0;
  for (int tick = 0; tick < 5000; ++tick)
  {
    // A stroke over the star, and a motion that turns and drifts at up to 1 m/s.
    direction = Unit(direction + 0.03 * Vec3{ normal(random), normal(random), normal(random) });
    axis = Unit(axis + 0.01 * Vec3{ normal(random), normal(random), normal(random) });
    angle += 0.002;
    place = place + 0.0003 * Vec3{ normal(random), normal(random), normal(random) };
    pose = Turned(axis, angle, place);
    motion->MoveTo(pose, 0.0);
    const Vec3 hip = 0.024 * direction;
    const Contact& a = still.Update(hip);
    const Contact& b = TickWith(moving, pose.PointToWorld(hip));
    if (tick < 2)
    {
      continue; // the way to the first contact is straight in one frame only
    }
    elsewhere += Length(b.Position - pose.PointToWorld(a.Position)) >= 1e-9 ||
        Length(b.Displacement - pose.VectorToWorld(a.Displacement)) >= 1e-9
      ? 1
      : 0;
    contacts += b.Status == UpdateStatus::Touching;
  }
  EXPECT_GT(contacts, 4900);
  return elsewhere;
}
}

//     o->               A moving frame is a still frame seen from elsewhere.
//   .--.   .--.
//  (    ) (  o>)
//   `--'   `--'
TEST(MovingSurfaces, AMovingFrameIsAStillFrameSeenFromElsewhere)
{
  EXPECT_EQ(TicksElsewhere(1), 0);
  // In a corner with several ways out roundings may choose: 17 of 60,000 ticks by other seeds.
  EXPECT_LE(TicksElsewhere(4), 2);
}

//  \     /      two walls of a valley, each moving on its own: the god-object stays in both
//   \ o /
//    \ /  x
TEST(MovingSurfaces, HoldTogetherEachWithItsOwnMotion)
{
  const double slope = 0.25 * M_PI;
  // Faces +x and up, and -x and up.
  const auto left = Standing(Turned({ 0, 1, 0 }, slope));
  const auto right = Standing(Turned({ 0, 1, 0 }, -slope));
  GodObject god({ { MakeSurface(Square(0.2, 3)), left }, { MakeSurface(Square(0.2, 3)), right } });
  const Vec3 hip{ 0.001, 0.002, -0.1 };
  god.Update({ 0, 0, 0.1 });
  for (int tick = 1; tick < 500; ++tick)
  {
    const double a = 0.02 * std::sin(0.02 * tick);
    const double b = 0.01 * std::sin(0.05 * tick);
    left->MoveTo(Turned({ 0, 1, 0 }, slope, { a, 0, 0 }), 0.0);
    right->MoveTo(Turned({ 0, 1, 0 }, -slope, { b, 0, 0 }), 0.0);
    const Contact& contact = TickWith(god, hip);
    // The walls x - a = -z and x - b = z meet at x = (a + b) / 2, z = (a - b) / 2.
    ASSERT_EQ(contact.NumberOfConstraints, 2) << tick;
    ASSERT_NEAR(contact.Position[0], 0.5 * (a + b), 1e-11) << tick;
    ASSERT_NEAR(contact.Position[1], hip[1], 1e-11) << tick;
    ASSERT_NEAR(contact.Position[2], 0.5 * (a - b), 1e-11) << tick;
  }
}

//  =========  |       Two plates close in on the god-object, pass through each other, and open
//      o      v       again: no force between, and nothing was passed.
//  =========
TEST(MovingSurfaces, SqueezeWithoutForceAndLetGoOnTheSameSide)
{
  const auto lid = Standing(Turned({ 1, 0, 0 }, M_PI, { 0, 0, 0.01 }));
  GodObject god({ MakeSurface(Square(0.1, 4)), { MakeSurface(Square(0.1, 4)), lid } });
  const Vec3 hip{ 0.01, 0.02, -0.002 };
  god.Update({ 0.01, 0.02, 0.005 });
  god.Update(hip);
  const auto lower = [&](double z)
  {
    lid->MoveTo(Turned({ 1, 0, 0 }, M_PI, { 0, 0, z }), 0.0);
    return TickWith(god, hip);
  };
  for (int tick = 1; tick < 10; ++tick)
  {
    const Contact contact = lower(0.01 - 0.001 * tick);
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_NEAR(contact.Position[2], 0.0, Tight);
  }
  for (int tick = 0; tick < 10; ++tick)
  {
    const Contact contact = lower(-0.001 * tick - 0.0005);
    ASSERT_EQ(contact.Status, UpdateStatus::Squeezed);
    ASSERT_EQ(contact.NumberOfConstraints, 0);
    ASSERT_EQ(contact.Displacement, (Vec3{ 0, 0, 0 }));
  }
  for (int tick = 0; tick < 5; ++tick)
  {
    const Contact contact = lower(0.001 + 0.001 * tick);
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_NEAR(contact.Position[2], 0.0, Tight);
    // Its way begins where the two came together, not at the hand, below what holds it.
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    for (int i = 0; i < corners; ++i)
    {
      ASSERT_NEAR(way[i][2] + god.WayOrigin()[2], 0.0, Tight) << "tick " << tick << ", " << i;
    }
  }
}

TEST(MovingSurfaces, DoNoWorkOnASqueezedHandThatIsUpdatedLater)
{
  const auto lid = Standing(Turned({ 1, 0, 0 }, M_PI, { 0, 0, 0.01 }));
  GodObject god({ MakeSurface(Square(0.1, 4)), { MakeSurface(Square(0.1, 4)), lid } });
  const Vec3 hip{ 0.01, 0.02, 0.005 };
  god.Update(hip);
  lid->MoveTo(Turned({ 1, 0, 0 }, M_PI, { 0, 0, -0.001 }), 0.0); // takes it along, then squeezes
  EXPECT_EQ(TickWith(god, hip).Status, UpdateStatus::Squeezed);
  lid->MoveTo(Turned({ 1, 0, 0 }, M_PI, { 0, 0, 0.02 }), 0.0);
  const Contact& contact = TickWith(god, hip);
  EXPECT_EQ(contact.Status, UpdateStatus::Free);
  EXPECT_EQ(contact.SurfaceDisplacement, (Vec3{ 0, 0, 0 }));
}

TEST(MovingSurfaces, ASqueezedHandThatLeavesBothSurfacesIsFree)
{
  const auto block = Standing({ { 0, 0, 0.2 } });
  const auto box = [] { return MakeSurface(Box(0.05, 0.05, 0.05, 3)); };
  GodObject god({ box(), { box(), block } });
  god.Update({ 0, 0, 0.08 });
  god.Update({ 0, 0, 0.049 });
  block->MoveTo({ { 0, 0, 0.05 } }, 0.0); // 50 mm into the other
  EXPECT_EQ(TickWith(god, { 0, 0, 0.049 }).Status, UpdateStatus::Squeezed);
  // Out sideways: each surface leads its own god-object around its own edge.
  UpdateStatus status = UpdateStatus::Squeezed;
  for (int tick = 0; tick < 100; ++tick)
  {
    status = TickWith(god, { 0.0007 * tick, 0, 0.049 }).Status;
  }
  EXPECT_EQ(status, UpdateStatus::Free);
  // And back: it touches as if nothing had been.
  const Contact& contact = TickWith(god, { 0.049, 0, 0.02 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_NEAR(contact.Position[0], 0.05, Tight);
}

TEST(MovingSurfaces, DoNotPushWhatTheyJumpOver)
{
  const auto motion = Standing();
  GodObject god({ { MakeSurface(Square(0.1, 4), Side::Both), motion } });
  const Vec3 hip{ 0, 0, 0.01 };
  god.Update(hip);
  motion->JumpTo({ { 0, 0, 0.02 } });
  EXPECT_EQ(TickWith(god, hip).Status, UpdateStatus::Free);
  motion->MoveTo({ { 0, 0, 0.005 } }, 0.0);
  const Contact& contact = TickWith(god, hip);
  EXPECT_NEAR(contact.Position[2], 0.005, Tight);
  motion->JumpTo({ { 0, 0, 0.02 } }); // away from a god-object that it holds
  EXPECT_EQ(TickWith(god, hip).Status, UpdateStatus::Free);
}

TEST(MovingSurfaces, OfOneMotionMoveOnce)
{
  const auto motion = Standing();
  const auto floor = MakeSurface(Square(0.1, 2));
  const auto other = MakeSurface(Moved(Square(0.1, 2), { 1, 0, 0 }));
  GodObject god({ { floor, motion }, { other, motion } });
  god.Update({ 0, 0, 0.001 });
  motion->MoveTo({ { 0, 0, 0.01 } }, 10 * Tick);
  const Contact& contact = TickWith(god, { 0, 0, -0.001 });
  EXPECT_NEAR(contact.Position[2], 0.001, Tight);
}
