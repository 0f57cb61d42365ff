// A god-object on surfaces that change all at once: other points, other triangles. Lengths are
// metres.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace haptics;
using namespace haptics::testing;

namespace
{
using SurfacePointer = std::shared_ptr<const TriangleSurface>;

/// A list of one surface, which is the same for its user whatever its geometry.
std::vector<TouchedSurface> Listed(SurfacePointer surface)
{
  std::vector<TouchedSurface> list{ std::move(surface) };
  list.front().Identity = 1;
  return list;
}

std::unique_ptr<GodObject> Changed(const GodObject& before, SurfacePointer surface)
{
  auto god = std::make_unique<GodObject>(Listed(std::move(surface)));
  god->Continue(before);
  return god;
}

/// A contour as a time step shows it: a bumpy ball whose triangles have nothing in common with the
/// last step's.
TriangleMesh Contour(int step, double radius)
{
  TriangleMesh mesh = Icosphere(3 + step % 2, radius);
  const double turn = 0.7 * step;
  for (Vec3& p : mesh.Points)
  {
    const Vec3 u = Unit(p);
    const double bumps = 1.0 + 0.03 * std::sin(5.0 * u[0]) * std::sin(6.0 * u[1] + 1.0);
    p = { bumps * (std::cos(turn) * p[0] - std::sin(turn) * p[1]),
      bumps * (std::sin(turn) * p[0] + std::cos(turn) * p[1]), bumps * p[2] };
  }
  return mesh;
}

/// Where a god-object that rests at `place` in front of `before` is when that is now `after`.
Vec3 PlaceAfter(const SurfacePointer& before, const Vec3& place, SurfacePointer after)
{
  GodObject god(Listed(before));
  god.Update(place);
  return Changed(god, std::move(after))->Update(place).Position;
}
}

TEST(ChangingSurfaces, OneOfManyTrianglesThatGrowsFarOverTheHandHasItOutside)
{
  const Vec3 place = 0.039 * Unit({ 0.3, -0.5, 0.8 });
  const auto fine = MakeSurface(Icosphere(7, 0.08)); // 60,000 triangles are within 80 mm of it
  EXPECT_GE(Length(PlaceAfter(MakeSurface(Icosphere(3, 0.03)), place, fine)), 0.0799);
}

TEST(ChangingSurfaces, OneOfManyTrianglesThatBecomesABoxHasTheHandOutside)
{
  // On the far side of the first ray that is asked along, so that it passes the whole surface.
  const Vec3 place = -0.0501 * Unit({ 0.57, 0.61, 0.55 });
  const Vec3 now =
    PlaceAfter(MakeSurface(Star(6, 0.05, 0.4, 5)), place, MakeSurface(Box(0.08, 0.08, 0.08, 1)));
  EXPECT_GE(std::max({ std::abs(now[0]), std::abs(now[1]), std::abs(now[2]) }), 0.08);
}

//   x o )  ->  (x  o): each time step other triangles, growing over the god-object and shrinking
TEST(ChangingSurfaces, ATimeSeriesOfContoursIsStroked)
{
  constexpr int steps = 60;
  constexpr int ticksAStep = 33; // 30 Hz
  SurfacePointer surface = MakeSurface(Contour(0, 0.03));
  auto god = std::make_unique<GodObject>(Listed(surface));
  god->Update({ 0.0, 0.0, 0.05 });
  double before = 0.0;
  int swallowed = 0;
  for (int step = 0; step < steps; ++step)
  {
    const double radius = 0.03 + 0.002 * std::sin(0.3 * step);
    const SurfacePointer last = surface;
    surface = MakeSurface(Contour(step, radius));
    swallowed +=
      step > 0 && ExactQueries(surface).IsInside(god->Current().Position - surface->Origin());
    god = Changed(*god, surface);
    const ExactQueries exact(surface);
    for (int tick = 0; tick < ticksAStep; ++tick)
    {
      const double a = 0.002 * (step * ticksAStep + tick);
      const Vec3 hip = 0.026 * Unit({ std::sin(a), 0.3 * std::sin(1.7 * a), std::cos(a) });
      const Contact& contact = god->Update(hip);
      ASSERT_FALSE(exact.IsInside(god->LocalPosition(0))) << "step " << step << ", tick " << tick;
      if (step > 0)
      {
        ASSERT_EQ(contact.Status, UpdateStatus::Touching);
        // No pop: the contour grows by up to 0.6 mm a step, its bumps turn, its facets are 1 mm
        // flat.
        ASSERT_LT(std::abs(contact.Penetration - before), 0.0025) << "step " << step;
      }
      before = contact.Penetration;
    }
  }
  EXPECT_GT(swallowed, 10); // the test is of some use
}

//   ( x )  the same hand, not touching, swallowed at once: on the nearest place outside
TEST(ChangingSurfaces, AFreeHandThatIsSwallowedIsOutside)
{
  GodObject before(Listed(MakeSurface(Icosphere(3, 0.03))));
  before.Update({ 0, 0.001, 0.04 });
  const auto god = Changed(before, MakeSurface(Icosphere(4, 0.05)));
  const Contact& contact = god->Update({ 0, 0.001, 0.04 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_NEAR(Length(contact.Position), 0.05, 1e-4);
  EXPECT_LT(Length(contact.Position - Vec3{ 0, 0.00125, 0.05 }), 2e-3);
}

TEST(ChangingSurfaces, AHandThatWasInsideIsLeftInside)
{
  GodObject before(Listed(MakeSurface(Icosphere(3, 0.03))));
  before.Update({ 0, 0.001, 0.01 });
  const auto god = Changed(before, MakeSurface(Icosphere(4, 0.04)));
  EXPECT_EQ(god->Update({ 0, 0.001, 0.01 }).Status, UpdateStatus::Free);
}

TEST(ChangingSurfaces, ASurfaceThatIsNewDoesNotPush)
{
  GodObject before(std::vector<TouchedSurface>{});
  before.Update({ 0, 0, 0.01 });
  const auto god = Changed(before, MakeSurface(Icosphere(3, 0.03)));
  EXPECT_EQ(god->Update({ 0, 0, 0.01 }).Status, UpdateStatus::Free);
}

//  ---o---        an open sheet held from above jumps up, with other triangles, and down again
//     x
TEST(ChangingSurfaces, AnOpenSheetKeepsTheSideThatItWasHeldFrom)
{
  for (const double side : { 1.0, -1.0 }) // from its front, from its back
  {
    auto god = std::make_unique<GodObject>(Listed(MakeSurface(Square(0.1, 4), Side::Both)));
    const Vec3 hip{ 0.011, 0.007, -0.001 * side };
    god->Update({ hip[0], hip[1], 0.01 * side });
    god->Update(hip);
    int cells = 5;
    for (const double height : { 0.0007, 0.0021, -0.0003, 0.0012 })
    {
      god = Changed(
        *god, MakeSurface(Moved(Square(0.1, cells++), { 0, 0, side * height }), Side::Both));
      const Contact& contact = god->Update(hip);
      ASSERT_EQ(contact.Status, UpdateStatus::Touching) << height;
      ASSERT_NEAR(contact.Position[2], side * height, 1e-12);
    }
  }
}

TEST(ChangingSurfaces, WhatIsOutsideTheRimOfASheetStaysFree)
{
  GodObject before(Listed(MakeSurface(Square(0.1, 4), Side::Both)));
  before.Update({ 0.12, 0, 0.0001 });
  const auto god = Changed(before, MakeSurface(Moved(Square(0.1, 3), { 0, 0, 0.001 }), Side::Both));
  EXPECT_EQ(god->Update({ 0.12, 0, 0.0001 }).Status, UpdateStatus::Free);
}

TEST(ChangingSurfaces, OthersHoldTheGodObjectThatIsPushed)
{
  // A ball grows under a fixed lid: the god-object is pushed out of the ball, and not through the
  // lid.
  const auto lid = MakeSurface(InsideOut(Moved(Square(0.2, 4), { 0, 0, 0.045 })));
  std::vector<TouchedSurface> list = Listed(MakeSurface(Icosphere(3, 0.03)));
  list.emplace_back(lid);
  GodObject before(list);
  before.Update({ 0, 0, 0.04 });
  list.front().Surface = MakeSurface(Icosphere(4, 0.05));
  GodObject god(list);
  god.Continue(before);
  // Only outside the lens that the two have in common there is a place.
  EXPECT_EQ(god.Update({ 0, 0, 0.04 }).Status, UpdateStatus::Touching);
  EXPECT_LT(god.LocalPosition(1)[2], 0.0);
  EXPECT_FALSE(ExactQueries(list.front().Surface).IsInside(god.LocalPosition(0)));
  EXPECT_NEAR(Length(god.LocalPosition(0)), 0.05, 1e-4);
}

// A hand at rest: all that a change does to the spring is reported as the surfaces' work.
TEST(ChangingSurfaces, WhatAChangeDoesToAHandAtRestIsTheSurfacesWork)
{
  const Vec3 hip{ 0.004, -0.003, 0.026 };
  auto god = std::make_unique<GodObject>(Listed(MakeSurface(Contour(0, 0.03))));
  god->Update(1.5 * hip);
  god->Update(hip);
  int grown = 0;
  int shrunk = 0;
  for (int step = 1; step < 40; ++step)
  {
    const Vec3 before = god->Current().Position;
    god = Changed(*god, MakeSurface(Contour(step, 0.03 + 0.002 * std::sin(0.7 * step))));
    const Contact& contact = god->Update(hip);
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_LT(Length(contact.Position - before - contact.SurfaceDisplacement), 1e-12)
      << "step " << step;
    const double way = Length(contact.Position - hip) - Length(before - hip);
    grown += way > 1e-4;
    shrunk += way < -1e-4;
    ASSERT_EQ(Length(god->Update(hip).SurfaceDisplacement), 0.0);
  }
  EXPECT_GT(grown, 10);
  EXPECT_GT(shrunk, 10);
  GodObject free(std::vector<TouchedSurface>{});
  free.Continue(*god);
  const Vec3 before = god->Current().Position;
  EXPECT_LT(Length(free.Update(hip).SurfaceDisplacement - (hip - before)), 1e-12) << "it is gone";
}
