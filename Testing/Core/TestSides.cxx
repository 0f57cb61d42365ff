// Surfaces some of whose triangles are touched from their front, others from both sides. Lengths
// are metres. The programs HapticsSoak and HapticsMotionSoak have more, at random.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
using SurfacePointer = std::shared_ptr<const TriangleSurface>;
constexpr double Tick = 0.001; // [s]

SurfacePointer MakeMixed(const TriangleMesh& fronts, const TriangleMesh& boths)
{
  return MakeSurface(Joined(Sided(fronts, Side::Front), Sided(boths, Side::Both)), Side::Automatic);
}

/// A square in z = 0 whose triangles have only fronts where x < 0, and backs elsewhere.
TriangleMesh HalfAndHalf(double halfSize, int cells)
{
  TriangleMesh mesh = Square(halfSize, cells);
  for (const Triangle& t : mesh.Triangles)
  {
    const double middle = mesh.Points[t[0]][0] + mesh.Points[t[1]][0] + mesh.Points[t[2]][0];
    mesh.Sides.push_back(middle < 0.0 ? Side::Front : Side::Both);
  }
  return mesh;
}

/// A box of half size 0.02 with a sheet of half size 0.03 through its middle.
SurfacePointer SheetThroughBox()
{
  return MakeMixed(Box(0.02, 0.02, 0.02, 4), Square(0.03, 4));
}

UpdateStatus AfterWay(const SurfacePointer& surface, const Vec3& from, const Vec3& to)
{
  GodObject god({ surface });
  god.Place(from);
  return god.Update(to).Status;
}

std::vector<TouchedSurface> Listed(SurfacePointer surface)
{
  std::vector<TouchedSurface> list{ std::move(surface) };
  list.front().Identity = 1;
  return list;
}
}

TEST(Sides, OfATriangleAreReportedAndWhereAllAreAlikeNothingIsStored)
{
  const auto mixed = MakeSurface(HalfAndHalf(1.0, 2), Side::Front);
  EXPECT_EQ(mixed->TouchedSide(), Side::Mixed);
  for (std::size_t i = 0; i < mixed->Triangles().size(); ++i)
  {
    const Triangle& t = mixed->Triangles()[i];
    const double middle =
      mixed->Points()[t[0]][0] + mixed->Points()[t[1]][0] + mixed->Points()[t[2]][0];
    EXPECT_EQ(mixed->TouchesBack(static_cast<std::int32_t>(i)), middle > 0.0);
  }
  const auto both = MakeSurface(Sided(Square(1.0), Side::Both), Side::Front);
  EXPECT_EQ(both->TouchedSide(), Side::Both);
  EXPECT_TRUE(both->TouchesBack(0));
  EXPECT_GT(mixed->MemoryBytes() - MakeSurface(Square(1.0, 2), Side::Front)->MemoryBytes(), 0u);
}

TEST(Sides, AutomaticIsWhatTheWholeSurfaceComesTo)
{
  EXPECT_EQ(
    MakeSurface(Sided(Icosphere(1, 1.0), Side::Automatic), Side::Both)->TouchedSide(), Side::Front);
  EXPECT_EQ(
    MakeSurface(Sided(Square(1.0), Side::Automatic), Side::Front)->TouchedSide(), Side::Both);
  TriangleMesh mesh = Sided(Square(1.0), Side::Automatic);
  mesh.Sides[0] = Side::Front;
  const auto mixed = MakeSurface(mesh, Side::Front);
  EXPECT_EQ(mixed->TouchedSide(), Side::Mixed);
  EXPECT_FALSE(mixed->TouchesBack(0));
  EXPECT_TRUE(mixed->TouchesBack(1));
}

TEST(Sides, ThatMakeNoSenseAreRefused)
{
  TriangleMesh mesh = Square(1.0);
  std::string error;
  mesh.Sides = { Side::Front };
  EXPECT_FALSE(TriangleSurface::Build(mesh, {}, error));
  EXPECT_EQ(error, "1 sides were given for 2 triangles");
  mesh.Sides = { Side::Front, Side::Mixed };
  EXPECT_FALSE(TriangleSurface::Build(mesh, {}, error));
  EXPECT_EQ(error, "the side to touch must be Front, Both or Automatic");
  mesh.Sides.clear();
  SurfaceOptions options;
  options.TouchedSide = Side::Mixed;
  EXPECT_FALSE(TriangleSurface::Build(mesh, options, error));
}

//      o1     ____
//     _|_ |  |    |     1, 2: a sheet holds from above and from below, outside and inside the
//     box;
//     --------------    3: the box only from outside
//      2  |__|_3__|
TEST(Sides, EachPartIsTouchedFromItsOwn)
{
  const auto surface = SheetThroughBox();
  for (const double x : { 0.005, 0.025 }) // inside the box, outside it
  {
    for (const double side : { 1.0, -1.0 })
    {
      GodObject god({ surface });
      god.Place({ x, 0.003, 0.004 * side });
      const Contact& contact = god.Update({ x, 0.003, -0.004 * side });
      ASSERT_EQ(contact.Status, UpdateStatus::Touching) << x << ", " << side;
      EXPECT_NEAR(contact.Position[2], 0.0, 1e-9);
      EXPECT_NEAR(contact.Constraints[0].Normal[2], side, 1e-12);
      EXPECT_NEAR(contact.Penetration, 0.004, 1e-9);
    }
  }
  EXPECT_EQ(AfterWay(surface, { 0, 0, 0.03 }, { 0, 0, 0.01 }), UpdateStatus::Touching);
  EXPECT_EQ(AfterWay(surface, { 0, 0, 0.01 }, { 0, 0, 0.03 }), UpdateStatus::Free);
  EXPECT_EQ(AfterWay(surface, { 0.001, 0.002, 0.01 }, { 0.03, 0.002, 0.01 }), UpdateStatus::Free);
}

//  _____________
//  front ^ both     from below: the left half lets through, the right half holds, and the edge
//     x -> o x      between them too; from above all of it holds
TEST(Sides, AnEdgeBetweenTwoBelongsToTheOneThatHolds)
{
  const auto surface = MakeSurface(HalfAndHalf(0.04, 4));
  EXPECT_EQ(
    AfterWay(surface, { -0.011, 0.003, -0.01 }, { -0.011, 0.003, 0.01 }), UpdateStatus::Free);
  EXPECT_EQ(
    AfterWay(surface, { 0.011, 0.003, -0.01 }, { 0.011, 0.003, 0.01 }), UpdateStatus::Touching);
  EXPECT_EQ(AfterWay(surface, { 0.0, 0.003, -0.01 }, { 0.0, 0.003, 0.01 }), UpdateStatus::Touching);
  EXPECT_EQ(AfterWay(surface, { 0.0, 0.02, -0.01 }, { 0.0, 0.02, 0.01 }), UpdateStatus::Touching);
  EXPECT_EQ(AfterWay(surface, { 0.0, 0.003, 0.01 }, { 0.0, 0.003, -0.01 }), UpdateStatus::Touching);

  // Held under the right half, the hand slides to the left and comes up where it is let through.
  GodObject god({ surface });
  god.Place({ 0.02, 0.003, -0.01 });
  for (int i = 0; i <= 40; ++i)
  {
    const double x = 0.02 - 0.001 * i;
    const Contact& contact = god.Update({ x, 0.003, 0.002 });
    ASSERT_EQ(contact.Status, x > -1e-9 ? UpdateStatus::Touching : UpdateStatus::Free) << x;
  }
  // And from above it stays above on its way back.
  for (int i = 0; i <= 40; ++i)
  {
    const Contact& contact = god.Update({ -0.02 + 0.001 * i, 0.003, -0.002 });
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_GT(contact.Position[2], 0.0);
  }
}

// Random ways about a box in which a sheet stands: what is outside stays there, what is over the
// sheet stays there or comes around its rim; checked by closed forms that know nothing of
// triangles.
TEST(Sides, NothingLeaksWhereASheetStandsThroughASolid)
{
  const auto surface = SheetThroughBox();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-0.004, 0.004);
  const auto isInBox = [](const Vec3& p) {
    return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) < 0.02;
  };
  int contacts = 0;
  int restarts = 0;
  for (int run = 0; run < 40; ++run)
  {
    const bool startsInside = run % 4 == 0;
    GodObject god({ surface });
    Vec3 hip = startsInside ? Vec3{ 0.001, 0.002, 0.007 } : Vec3{ 0.024, 0.001, 0.005 };
    god.Place(hip);
    bool wasInside = startsInside;
    for (int tick = 0; tick < 500; ++tick)
    {
      for (double& x : hip)
      {
        x = std::clamp(x + step(random), -0.029, 0.029); // not around the sheet's rim
      }
      const Contact& contact = god.Update(hip);
      const bool isInside = isInBox(contact.Position);
      contacts += contact.Status == UpdateStatus::Touching;
      ASSERT_GT(contact.Position[2], 0.0) << "run " << run << ", tick " << tick;
      ASSERT_TRUE(wasInside || !isInside) << "run " << run << ", tick " << tick;
      restarts += wasInside && !isInside;
      wasInside = isInside;
    }
  }
  EXPECT_GT(contacts, 10000);
  EXPECT_GT(restarts, 5); // what was inside did come out
}

//   o         a sheet half of which has only a front sweeps up past a hand that rests, and down
//  ===---  ^  again: the two-sided half takes it along both times, the other only upwards
TEST(Sides, OfASurfaceThatDeformsStay)
{
  for (const double x : { -0.011, 0.011 })
  {
    for (const double way : { 1.0, -1.0 })
    {
      SurfaceDeformer deformer(MakeSurface(HalfAndHalf(0.04, 4)));
      const Vec3 hip{ x, 0.003, 0.001 * way };
      GodObject before({ deformer.Latest() });
      before.Update(hip);
      std::vector<Vec3> points = deformer.Latest()->Points();
      for (Vec3& p : points)
      {
        p = deformer.Latest()->Origin() + p + Vec3{ 0, 0, 0.003 * way };
      }
      std::string error;
      const auto moved = deformer.Deform(points, 10 * Tick, error);
      ASSERT_TRUE(moved) << error;
      EXPECT_EQ(moved->TouchedSide(), Side::Mixed);
      GodObject god({ moved });
      god.Continue(before);
      for (int tick = 0; tick < 10; ++tick)
      {
        god.Advance(Tick);
        god.Update(hip);
      }
      const bool isHeld = x > 0.0 || way > 0.0;
      EXPECT_EQ(god.Current().Status, isHeld ? UpdateStatus::Touching : UpdateStatus::Free);
      EXPECT_NEAR(god.Current().Penetration, isHeld ? 0.002 : 0.0, 1e-9);
    }
  }
}

// A solid and a sheet in one surface, both built anew: the solid is found by counting, in which the
// sheet has no part, and the sheet by what it held.
TEST(Sides, OnlyWhatEnclosesIsCountedWhenASurfaceChanges)
{
  const auto make = [](int level, double radius, double height) {
    return MakeMixed(Icosphere(level, radius), Moved(Square(0.01, level), { 0, 0, height }));
  };
  // Swallowed by the ball, with the sheet nearer than the ball's outside.
  GodObject free(Listed(make(3, 0.03, 0.08)));
  free.Update({ 0, 0.001, 0.04 });
  GodObject swallowed(Listed(make(4, 0.05, 0.0405)));
  swallowed.Continue(free);
  EXPECT_EQ(swallowed.Update({ 0, 0.001, 0.04 }).Status, UpdateStatus::Touching);
  EXPECT_NEAR(Length(swallowed.Current().Position), 0.05, 1e-4);

  // Held by the sheet from below, which jumps down onto the ball.
  GodObject held(Listed(make(3, 0.03, 0.05)));
  held.Place({ 0.001, 0.002, 0.04 });
  EXPECT_EQ(held.Update({ 0.001, 0.002, 0.055 }).Status, UpdateStatus::Touching);
  GodObject lowered(Listed(make(4, 0.03, 0.045)));
  lowered.Continue(held);
  EXPECT_EQ(lowered.Update({ 0.001, 0.002, 0.055 }).Status, UpdateStatus::Touching);
  EXPECT_NEAR(lowered.Current().Position[2], 0.045, 1e-9);

  // Held by the ball from above, while the sheet comes down close over it: it stays below the
  // sheet.
  GodObject pressed(Listed(make(3, 0.03, 0.05)));
  pressed.Place({ 0, 0.001, 0.04 });
  pressed.Update({ 0, 0.001, 0.02 });
  GodObject between(Listed(make(4, 0.0295, 0.031)));
  between.Continue(pressed);
  EXPECT_EQ(between.Update({ 0, 0.001, 0.02 }).Status, UpdateStatus::Touching);
  EXPECT_LT(between.Current().Position[2], 0.031);
  EXPECT_GT(between.Current().Position[2], 0.0294);
}

//   |  |___          held from below by a sheet next to a solid, nearer to the solid than to where
//   the
//   |__| o           sheet is next
TEST(Sides, ASolidNextToASheetDoesNotHideThatTheSheetHasPassed)
{
  const auto make = [](int cells, double height)
  {
    return MakeMixed(Moved(Box(0.01, 0.01, 0.05, 2), { -0.011, 0, 0 }),
      Moved(Square(0.03, cells), { 0, 0, height }));
  };
  const Vec3 hip{ 0.0, 0.002, 0.01 };
  GodObject before(Listed(make(4, 0.005)));
  before.Place({ 0.0, 0.002, 0.0 });
  EXPECT_EQ(before.Update(hip).Status, UpdateStatus::Touching);
  GodObject after(Listed(make(3, 0.003)));
  after.Continue(before);
  EXPECT_EQ(after.Update(hip).Status, UpdateStatus::Touching);
  EXPECT_NEAR(after.Current().Position[2], 0.003, 1e-9);
}

// A solid some of whose walls hold from within is left through the others, and never entered.
TEST(Sides, ASolidWithSomeWallsOfBothIsStillASolidWhenItChanges)
{
  TriangleMesh small = SidedAtRandom(Icosphere(3, 0.03), 5);
  TriangleMesh large = SidedAtRandom(Icosphere(4, 0.05), 6);
  GodObject before(Listed(MakeSurface(small)));
  before.Update({ 0, 0.001, 0.04 });
  GodObject after(Listed(MakeSurface(large)));
  after.Continue(before);
  EXPECT_EQ(after.Update({ 0, 0.001, 0.04 }).Status, UpdateStatus::Touching);
  EXPECT_NEAR(Length(after.Current().Position), 0.05, 1e-4);
}
