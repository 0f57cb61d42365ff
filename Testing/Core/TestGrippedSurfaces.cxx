// Surfaces that the hand carries: no contact while it does, and never lost afterwards. In the
// drawings o is the god-object. Lengths are metres, a tick is a millisecond.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001;
constexpr double Tight = 1e-12;

using SurfacePointer = std::shared_ptr<const TriangleSurface>;

/// A part that moves, and a wall that stands at x = 0.1 and faces it.
//
//     .--o             |
//    ( part )          | wall
//     `----'           |
struct Bench
{
  SurfacePointer Part;
  std::shared_ptr<SurfaceMotion> Motion = std::make_shared<SurfaceMotion>(RigidPose());
  SurfacePointer Wall;
  std::uint64_t Identity = 2; ///< of the part
  std::unique_ptr<GodObject> God;

  explicit Bench(TriangleMesh part)
    : Part(MakeSurface(std::move(part)))
  {
    TriangleMesh wall = Square(1.0, 4); // faces +z
    for (Vec3& p : wall.Points)
    {
      p = { 0.1 - p[2], p[1], p[0] }; // a turn: faces -x
    }
    this->Wall = MakeSurface(std::move(wall));
    this->God = this->Made(false);
  }
  std::unique_ptr<GodObject> Made(bool isGripped) const
  {
    TouchedSurface wall(this->Wall);
    wall.Identity = 1;
    TouchedSurface part(this->Part, this->Motion);
    part.Identity = this->Identity;
    part.IsGripped = isGripped;
    return std::make_unique<GodObject>(std::vector<TouchedSurface>{ wall, part });
  }
  /// Publishes anew, as a scene does; true where nothing has changed at once.
  bool Publish(bool isGripped)
  {
    auto next = this->Made(isGripped);
    const bool isSeamless = next->Continue(*this->God);
    this->God = std::move(next);
    return isSeamless;
  }
  const Contact& MoveTo(const Vec3& hip)
  {
    this->God->Advance(Tick);
    return this->God->Update(hip);
  }
  /// Whether the god-object is inside the part, as exact arithmetic has it.
  bool IsInside() const { return ExactQueries(this->Part).IsInside(this->God->LocalPosition(1)); }
};

RigidPose At(const Vec3& translation)
{
  RigidPose pose;
  pose.Translation = translation;
  return pose;
}
}

TEST(GrippedSurfaces, DoNotHoldAndOthersDo)
{
  Bench bench(Box(0.02, 0.02, 0.02));
  bench.MoveTo({ 0.003, 0.005, 0.03 });
  ASSERT_EQ(bench.MoveTo({ 0.003, 0.005, 0.018 }).NumberOfConstraints, 1);
  EXPECT_FALSE(bench.Publish(true)) << "the force starts softly";
  EXPECT_EQ(bench.MoveTo({ 0.003, 0.005, 0.018 }).Status, UpdateStatus::Free);
  EXPECT_EQ(bench.MoveTo({ 0.0, 0.0, 0.0 }).Status, UpdateStatus::Free) << "through the part";
  const Contact& contact = bench.MoveTo({ 0.102, 0.0, 0.0 });
  EXPECT_EQ(contact.NumberOfConstraints, 1);
  EXPECT_EQ(contact.Constraints[0].Surface, 0);
  EXPECT_NEAR(contact.Displacement[0], -0.002, Tight);
}

//   .--o--.   the part is let go of where it was carried to; the hand has gone on meanwhile:
//   |  x  |   into it, and is held where it was gripped
TEST(GrippedSurfaces, HoldAHandThatHasGoneIntoThemWhenTheyAreLetGo)
{
  Bench bench(Box(0.02, 0.02, 0.02));
  bench.MoveTo({ 0.003, 0.005, 0.03 });
  bench.MoveTo({ 0.003, 0.005, 0.018 });
  const Vec3 gripped = bench.God->LocalPosition(1);
  bench.Publish(true);
  const Vec3 by{ 0.04, -0.02, 0.05 };
  bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.02 });
  bench.Motion->JumpTo(At(by)); // set, and followed by nobody
  bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.019 });
  EXPECT_EQ(Length(bench.God->LocalPosition(1) - gripped), 0.0) << "bit for bit";
  bench.Publish(false);
  const Contact& contact = bench.MoveTo(by + Vec3{ 0.004, 0.005, 0.0185 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_NEAR(contact.Displacement[0], 0.0, Tight);
  EXPECT_NEAR(contact.Displacement[2], 0.0015, Tight);
  EXPECT_FALSE(bench.IsInside());
}

TEST(GrippedSurfaces, LetGoOfADistantHandPushNothing)
{
  Bench bench(Box(0.02, 0.02, 0.02));
  bench.MoveTo({ 0.003, 0.005, 0.03 });
  bench.MoveTo({ 0.003, 0.005, 0.018 });
  bench.Publish(true);
  bench.MoveTo({ 0.003, 0.005, 0.05 });
  bench.Publish(false);
  EXPECT_EQ(bench.MoveTo({ 0.003, 0.005, 0.05 }).Status, UpdateStatus::Free);
  EXPECT_EQ(bench.MoveTo({ 0.003, 0.005, 0.018 }).Status, UpdateStatus::Touching);
}

// The hand is placed anew while it carries a part, as when the workspace is scaled: the part keeps
// the point that it was gripped at.
TEST(GrippedSurfaces, KeepTheirPointWhenTheHandIsPlacedAnew)
{
  Bench bench(Box(0.02, 0.02, 0.02));
  bench.MoveTo({ 0.003, 0.005, 0.03 });
  bench.MoveTo({ 0.003, 0.005, 0.018 });
  const Vec3 gripped = bench.God->LocalPosition(1);
  bench.Publish(true);
  bench.God->Place({ 0.0, 0.0, 0.0 }); // within the part
  EXPECT_EQ(Length(bench.God->LocalPosition(1) - gripped), 0.0);
  bench.Publish(false);
  bench.MoveTo({ 0.0, 0.0, 0.0 });
  EXPECT_FALSE(bench.IsInside());
}

// Other points and triangles come while it is carried, and grow over the point that is gripped.
TEST(GrippedSurfaces, ThatChangeShapeMeanwhileKeepTheHandOutside)
{
  for (const bool sameUpdate : { false, true })
  {
    Bench bench(Icosphere(2, 0.02));
    bench.MoveTo({ 0.001, 0.002, 0.03 });
    bench.MoveTo({ 0.001, 0.002, 0.018 });
    bench.Publish(true);
    bench.MoveTo({ 0.05, 0.002, 0.02 });
    bench.Motion->JumpTo(At({ 0.049, 0.0, 0.0 }));
    bench.Part = MakeSurface(Icosphere(3, 0.022));
    if (!sameUpdate)
    {
      bench.Publish(true);
      EXPECT_EQ(bench.MoveTo({ 0.05, 0.002, 0.02 }).Status, UpdateStatus::Free);
    }
    bench.Publish(false);
    const Contact& contact = bench.MoveTo({ 0.05, 0.002, 0.02 });
    EXPECT_EQ(contact.Status, UpdateStatus::Touching);
    EXPECT_NEAR(contact.Penetration, 0.002, 2e-4);
    EXPECT_FALSE(bench.IsInside());
  }
}

// Another one in its place has nothing of the point that was gripped: the hand is where it is on
// it.
TEST(GrippedSurfaces, ThatOthersTakeThePlaceOfMeanwhileAreLetGoOfWhereTheHandIs)
{
  Bench bench(Box(0.02, 0.02, 0.02));
  bench.MoveTo({ 0.003, 0.005, 0.03 });
  bench.MoveTo({ 0.003, 0.005, 0.018 });
  bench.Publish(true);
  const Vec3 by{ 0.0, 0.0, -0.05 };
  bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.02 });
  bench.Motion->JumpTo(At(by));
  bench.Identity = 3;
  bench.Part = MakeSurface(Box(0.01, 0.01, 0.01));
  bench.Publish(true);
  bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.02 });
  bench.Publish(false);
  EXPECT_EQ(bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.015 }).Status, UpdateStatus::Free);
  EXPECT_NEAR(bench.MoveTo(by + Vec3{ 0.003, 0.005, 0.009 }).Displacement[2], 0.001, Tight);
}

// Of an open sheet nothing says which side a hand was on but the point where it was gripped.
TEST(GrippedSurfaces, ThatAreSheetsAndChangeMeanwhileKeepTheirSide)
{
  for (const bool sameUpdate : { false, true })
  {
    Bench bench(Square(0.03, 2));
    bench.MoveTo({ 0.001, 0.002, 0.01 });
    bench.MoveTo({ 0.001, 0.002, -0.001 });
    bench.Publish(true);
    bench.MoveTo({ 0.05, 0.002, 0.02 });
    bench.Motion->JumpTo(At({ 0.049, 0.0, 0.02 }));
    bench.Part = MakeSurface(Moved(Square(0.04, 3), { 0.005, 0, 0 })); // has another origin
    if (!sameUpdate)
    {
      bench.Publish(true);
    }
    bench.MoveTo({ 0.05, 0.002, 0.0188 });
    bench.Publish(false);
    EXPECT_NEAR(bench.MoveTo({ 0.05, 0.002, 0.0188 }).Displacement[2], 0.0012, Tight);
  }
}

// Random parts are gripped, carried with the picture's delay and let go of while the hand moves,
// some against the wall. Nothing is ever entered.
TEST(GrippedSurfaces, AreNeverEnteredHoweverTheyAreMoved)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int letGo = 0;
  int atTheWall = 0;
  int held = 0;
  for (int round = 0; round < 60; ++round)
  {
    Bench bench(Star(2, 0.03, 0.3, 100 + round));
    Vec3 middle{};
    Vec3 hip{ 0.05, 0.03, 0.03 };
    bench.MoveTo(hip);
    for (int carry = 0; carry < 5; ++carry)
    {
      for (int tick = 0; tick < 40; ++tick)
      {
        hip = hip + 0.2 * (middle + 0.01 * Vec3{ uniform(random), uniform(random), 0 } - hip);
        bench.MoveTo(hip);
        ASSERT_FALSE(bench.IsInside()) << "round " << round;
      }
      ASSERT_EQ(bench.God->Current().Status, UpdateStatus::Touching);
      const Vec3 from = bench.God->Current().Position - middle;
      bench.Publish(true);
      const Vec3 way = 0.005 * Vec3{ uniform(random), uniform(random), uniform(random) };
      for (int tick = 0; tick < 40; ++tick)
      {
        hip = hip + way;
        const Contact& contact = bench.MoveTo(hip);
        ASSERT_LE(contact.Position[0], 0.1);
        if (tick % 16 == 0)
        {
          middle = contact.Position - from;
          bench.Motion->JumpTo(At(middle));
        }
      }
      atTheWall += bench.God->Current().NumberOfConstraints > 0;
      bench.Publish(false);
      for (int tick = 0; tick < 10; ++tick)
      {
        held += bench.MoveTo(hip).NumberOfConstraints > 0 ? 1 : 0;
        ASSERT_FALSE(bench.IsInside()) << "round " << round << ", let go";
      }
      ++letGo;
    }
  }
  EXPECT_EQ(letGo, 300);
  EXPECT_GT(atTheWall, 30); // the test is of some use
  EXPECT_GT(held, 300);
}
