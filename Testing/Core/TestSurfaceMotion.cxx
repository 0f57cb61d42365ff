// How a surface moves between two updates of its pose. Lengths are metres.
#include "AnalyticSurfaces.h"
#include "haptics/Surface/SurfaceMotion.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001;

RigidPose TurnedAboutZ(double radians, const Vec3& translation = {})
{
  return { translation, { std::cos(0.5 * radians), 0, 0, std::sin(0.5 * radians) } };
}
}

TEST(RigidPose, TurnsAndMovesPointsThereAndBack)
{
  const RigidPose pose = TurnedAboutZ(0.5 * M_PI, { 1, 2, 3 });
  const Vec3 x = pose.PointToWorld({ 1, 0, 0 });
  EXPECT_LT(Length(x - Vec3{ 1, 3, 3 }), 1e-15);
  EXPECT_LT(Length(pose.PointToSurface(x) - Vec3{ 1, 0, 0 }), 1e-15);
}

TEST(SurfaceMotion, StandsStillUntilItIsSentSomewhere)
{
  SurfaceMotion motion(TurnedAboutZ(0.3, { 1, 2, 3 }));
  EXPECT_EQ(motion.Advance(Tick), TurnedAboutZ(0.3, { 1, 2, 3 }));
}

TEST(SurfaceMotion, GoesStraightAndArrivesExactlyAfterTheDuration)
{
  SurfaceMotion motion(RigidPose{});
  const RigidPose target{ { 0.1, 0.2, 0.3 } };
  ASSERT_TRUE(motion.MoveTo(target, 10 * Tick));
  for (int tick = 1; tick < 10; ++tick)
  {
    const RigidPose& pose = motion.Advance(Tick);
    EXPECT_LT(Length(pose.Translation - (0.1 * tick) * target.Translation), 1e-15);
  }
  EXPECT_EQ(motion.Advance(Tick * (1 + 1e-9)), target);
}

TEST(SurfaceMotion, TurnsEvenlyAboutThePivot)
{
  const Vec3 pivot{ 5, 0, 0 };
  SurfaceMotion motion(RigidPose{}, pivot);
  // A quarter turn about the pivot, which stays where it is.
  const RigidPose turn = TurnedAboutZ(0.5 * M_PI);
  ASSERT_TRUE(motion.MoveTo({ pivot - turn.VectorToWorld(pivot), turn.Rotation }, 1.0));
  for (int step = 1; step <= 10; ++step)
  {
    const RigidPose& pose = motion.Advance(0.1);
    EXPECT_LT(Length(pose.PointToWorld(pivot) - pivot), 1e-14);
    const double angle = 0.05 * M_PI * step;
    const Vec3 arm = pose.VectorToWorld({ 1, 0, 0 });
    EXPECT_LT(Length(arm - Vec3{ std::cos(angle), std::sin(angle), 0 }), 1e-14) << step;
  }
}

TEST(SurfaceMotion, GoesOnFromWhereItIsWhenAnUpdateComesEarlyAndWaitsWhenItIsLate)
{
  SurfaceMotion motion(RigidPose{});
  motion.MoveTo({ { 1, 0, 0 } }, 1.0);
  motion.Advance(0.5);
  motion.MoveTo({ { 2, 0, 0 } }, 1.0);
  EXPECT_NEAR(motion.Advance(0.5).Translation[0], 0.5 + 0.75, 1e-15);
  motion.Advance(0.6);
  EXPECT_EQ(motion.Advance(10.0).Translation[0], 2.0);
}

TEST(SurfaceMotion, TakesLongerWhereItWouldBeTooFast)
{
  SurfaceMotion motion(RigidPose{}, {}, 2.0);
  EXPECT_FALSE(motion.SetLargestSpeed(0.0));
  EXPECT_FALSE(motion.SetLargestSpeed(-1.0));
  EXPECT_FALSE(motion.SetLargestSpeed(std::nan("")));
  ASSERT_TRUE(motion.SetLargestSpeed(5.0));
  motion.MoveTo({ { 1, 0, 0 } }, 0.0); // 1 m in no time
  EXPECT_NEAR(motion.Advance(0.1).Translation[0], 0.5, 1e-15);
  EXPECT_TRUE(motion.Read().IsSlowed);
  EXPECT_TRUE(motion.Read().IsMoving);
  motion.Advance(0.2);
  EXPECT_FALSE(motion.Read().IsMoving);
  // Half a turn moves what is 2 m from the pivot by 2 pi.
  motion.MoveTo(TurnedAboutZ(M_PI, { 1, 0, 0 }), 0.0);
  motion.Advance(0.1 * 2.0 * M_PI);
  EXPECT_NEAR(motion.Read().Pose.VectorToWorld({ 1, 0, 0 })[0], 0.0, 1e-12);
  motion.Advance(10.0);
  motion.MoveTo(TurnedAboutZ(M_PI, { 1.1, 0, 0 }), 0.03);
  motion.Advance(Tick);
  EXPECT_FALSE(motion.Read().IsSlowed);
}

TEST(SurfaceMotion, JumpsAtOnceEvenWhenAnotherTargetFollowsBeforeTheServoLooks)
{
  SurfaceMotion motion(RigidPose{});
  ASSERT_TRUE(motion.JumpTo({ { 1, 0, 0 } }));
  ASSERT_TRUE(motion.MoveTo({ { 2, 0, 0 } }, 1.0));
  EXPECT_NEAR(motion.Advance(0.25).Translation[0], 1.25, 1e-15);
  EXPECT_EQ(motion.Jumps(), 1u);
}

TEST(SurfaceMotion, RefusesWhatIsNoPoseAndStaysAsItIs)
{
  SurfaceMotion motion(RigidPose{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(motion.MoveTo({ { nan, 0, 0 } }, 0.1));
  EXPECT_FALSE(motion.MoveTo({ { 0, inf, 0 } }, 0.1));
  EXPECT_FALSE(motion.MoveTo({ {}, { 0, 0, 0, 0 } }, 0.1));
  EXPECT_FALSE(motion.MoveTo({ {}, { 1, nan, 0, 0 } }, 0.1));
  EXPECT_FALSE(motion.MoveTo({ { 1, 0, 0 } }, -0.1));
  EXPECT_FALSE(motion.MoveTo({ { 1, 0, 0 } }, nan));
  EXPECT_FALSE(motion.JumpTo({ {}, { 0, 0, 0, 0 } }));
  EXPECT_EQ(motion.Advance(1.0), RigidPose{});
  // Time that does not go on moves nothing.
  motion.MoveTo({ { 1, 0, 0 } }, 1.0);
  EXPECT_EQ(motion.Advance(-1.0), RigidPose{});
  EXPECT_EQ(motion.Advance(nan), RigidPose{});
}

// Run it under the thread sanitizer for more than what is asserted here.
TEST(SurfaceMotion, IsNeverTornBetweenThreads)
{
  SurfaceMotion motion(RigidPose{});
  std::atomic<bool> done{ false };
  std::thread servo(
    [&]
    {
      while (!done)
      {
        // Targets have equal coordinates, so all that lies between them has.
        const Vec3 at = motion.Advance(Tick).Translation;
        ASSERT_EQ(at[0], at[1]);
        ASSERT_EQ(at[0], at[2]);
      }
    });
  for (int i = 1; i <= 20000; ++i)
  {
    const double x = i;
    motion.MoveTo({ { x, x, x } }, 0.01);
    const Vec3 seen = motion.Read().Pose.Translation;
    ASSERT_EQ(seen[0], seen[1]);
    ASSERT_EQ(seen[0], seen[2]);
  }
  done = true;
  servo.join();
  EXPECT_EQ(motion.Advance(1.0).Translation, (Vec3{ 20000, 20000, 20000 }));
}
