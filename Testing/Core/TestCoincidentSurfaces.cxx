// Where several surfaces lie along each other all of their materials count, in whatever order they
// were added, and the material is continuous where one of them ends.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"

#include "haptics/Material/ForceProfile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001; // [s]
constexpr double Depth = 0.002;
constexpr double CrackWidth = 4e-6; ///< a clearance of 1e-6 m: much more than rounding
constexpr double Clearance = CrackWidth / 4.0;
constexpr double Same = 1e-9;

struct Plate
{
  double Low, High; ///< its ends along x
  double Height;
  double Stiffness; ///< below 0: plain
  double Friction = 0.0;
  int Cells = 1;
};

TouchedSurface Touchable(
  const Plate& plate, double crackWidth = CrackWidth, Side side = Side::Front)
{
  const double half = 0.5 * (plate.High - plate.Low);
  SurfaceOptions options;
  options.TouchedSide = side;
  options.CrackWidth = crackWidth;
  std::string error;
  const std::shared_ptr<const TriangleSurface> surface = TriangleSurface::Build(
    Moved(Square(half, plate.Cells), { plate.Low + half, 0.0, plate.Height }), options, error);
  EXPECT_NE(surface, nullptr) << error;
  if (plate.Stiffness < 0.0)
  {
    return { surface };
  }
  return haptics::testing::Touchable(
    surface, Everywhere(plate.Stiffness, 0.0, plate.Friction, plate.Friction, 0.0));
}

/// A hand over several plates; the force of the last tick in newtons.
class Hand
{
public:
  Hand(const std::vector<Plate>& plates, bool isReversed, double crackWidth = CrackWidth)
    : God(Made(plates, isReversed, crackWidth))
  {
  }

  Vec3 Move(const Vec3& hip)
  {
    return this->Force.Update(this->God.Update(hip), Tick, 500.0, MaterialLimits());
  }
  /// A touch of its own, pressed straight down at x.
  Vec3 PressAt(double x)
  {
    this->Move({ x, 0.0013, 0.001 });
    return this->Move({ x, 0.0013, -Depth });
  }
  const Contact& Touch() const { return this->God.Current(); }

private:
  static std::vector<TouchedSurface> Made(
    const std::vector<Plate>& plates, bool isReversed, double crackWidth)
  {
    std::vector<TouchedSurface> surfaces;
    for (const Plate& plate : plates)
    {
      surfaces.push_back(Touchable(plate, crackWidth));
    }
    if (isReversed)
    {
      std::reverse(surfaces.begin(), surfaces.end());
    }
    return surfaces;
  }

  GodObject God;
  SurfaceForce Force;
};

const std::vector<double> CrackWidths{ 0.0, CrackWidth };
}

TEST(CoincidentSurfaces, ShareTheContactEqually)
{
  for (const double width : CrackWidths)
  {
    for (const bool isReversed : { false, true })
    {
      Hand hand(
        { { -0.1, 0.1, 0.0, 200.0, 0.2 }, { -0.13, 0.11, 0.0, 800.0, 0.6, 7 } }, isReversed, width);
      const Vec3 force = hand.PressAt(0.003);
      EXPECT_NEAR(force[2], 500.0 * Depth, 1e-8 + 800.0 * Clearance);
      EXPECT_DOUBLE_EQ(hand.Touch().Material.Stiffness, 500.0);
      EXPECT_DOUBLE_EQ(hand.Touch().Material.StaticFriction, 0.4);
    }
  }
}

TEST(CoincidentSurfaces, APlainOneCountsWithTheServosStiffness)
{
  for (const bool isReversed : { false, true })
  {
    Hand hand({ { -0.1, 0.1, 0.0, 900.0 }, { -0.1, 0.1, 0.0, -1.0 } }, isReversed);
    EXPECT_NEAR(hand.PressAt(0.003)[2], 700.0 * Depth, 900.0 * Clearance * 1.1);
    EXPECT_DOUBLE_EQ(hand.Touch().Material.PlainShare, 0.5);
    EXPECT_DOUBLE_EQ(hand.Touch().Material.Stiffness, 450.0);
  }
}

TEST(CoincidentSurfaces, ThreeOfThemGiveTheSameInEveryOrder)
{
  std::vector<Plate> plates{ { -0.1, 0.1, 0.0, 200.0, 0.3, 3 },
    { -0.12, 0.1, -0.5 * Clearance, 500.0, 0.0, 5 }, { -0.1, 0.14, 0.0, 1100.0, 0.6, 8 } };
  std::vector<int> order{ 0, 1, 2 };
  std::vector<Vec3> first;
  do
  {
    Hand hand({ plates[order[0]], plates[order[1]], plates[order[2]] }, false);
    std::vector<Vec3> forces{ hand.PressAt(0.0021) };
    EXPECT_NEAR(hand.Touch().Material.Stiffness, 600.0, 1e-9);
    for (int i = 1; i <= 300; ++i)
    {
      forces.push_back(hand.Move({ 0.0021 + 1e-5 * i, 0.0013, -Depth }));
    }
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      EXPECT_NEAR(Length(forces[i] - first[i]), 0.0, Same) << "tick " << i;
    }
    if (first.empty())
    {
      first = forces;
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(CoincidentSurfaces, OneThatIsLowerCountsLessAndThenNoLonger)
{
  double last = 500.0;
  for (const double gap : { 0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 20.0 })
  {
    double stiffness[2] = {};
    for (const bool isReversed : { false, true })
    {
      Hand hand({ { -0.1, 0.1, 0.0, 200.0 }, { -0.1, 0.1, -gap * Clearance, 800.0 } }, isReversed);
      hand.PressAt(0.003);
      stiffness[isReversed] = hand.Touch().Material.Stiffness;
    }
    EXPECT_NEAR(stiffness[0], stiffness[1], 1e-6) << gap << " clearances";
    EXPECT_LE(stiffness[0], last + 1e-9) << gap << " clearances";
    EXPECT_LT(last - stiffness[0], 110.0) << gap << " clearances";
    if (gap <= 0.5)
    {
      EXPECT_DOUBLE_EQ(stiffness[0], 500.0);
    }
    last = stiffness[0];
  }
  EXPECT_DOUBLE_EQ(last, 200.0);
}

TEST(CoincidentSurfaces, BlendContinuouslyOverASeam)
{
  for (const double step : { 0.0, -0.5 * Clearance })
  {
    const std::vector<Plate> plates{ { -0.1, 0.0, 0.0, 200.0 }, { 0.0, 0.1, step, 800.0 } };
    Hand there(plates, false);
    Hand back(plates, true);
    // Each press is a touch of its own: the force at a place, with no tank in between.
    const double stride = 0.1 * Clearance;
    double last = 200.0;
    double largest = 0.0;
    for (int i = -150; i <= 150; ++i)
    {
      there.PressAt(i * stride);
      back.PressAt(i * stride);
      const double stiffness = there.Touch().Material.Stiffness;
      EXPECT_NEAR(stiffness, back.Touch().Material.Stiffness, 1e-6) << i;
      EXPECT_GE(stiffness, last - 1e-6) << i;
      largest = std::max(largest, stiffness - last);
      last = stiffness;
    }
    EXPECT_DOUBLE_EQ(last, 800.0);
    // 600 N/m over about 12 clearances, at most twice as steep in a place.
    EXPECT_LT(largest, 2.0 * 600.0 * stride / (12.0 * Clearance));
  }
}

TEST(CoincidentSurfaces, GiveTheSameForceOverASeamInBothOrders)
{
  for (const double friction : { 0.0, 0.3 })
  {
    const std::vector<Plate> plates{ { -0.1, 0.0, 0.0, 200.0, friction },
      { 0.0, 0.1, 0.0, 800.0, 2.0 * friction } };
    Hand there(plates, false);
    Hand back(plates, true);
    there.PressAt(-0.005);
    back.PressAt(-0.005);
    Vec3 last = there.Move({ -0.005, 0.0013, -Depth });
    back.Move({ -0.005, 0.0013, -Depth });
    double step = 0.0;
    for (int i = 1; i <= 1500; ++i)
    {
      const Vec3 hip{ -0.005 + 5e-5 * i, 0.0013, -Depth };
      const Vec3 force = there.Move(hip);
      ASSERT_NEAR(Length(force - back.Move(hip)), 0.0, Same) << i;
      step = std::max(step, std::abs(force[2] - last[2]));
      last = force;
    }
    EXPECT_GT(last[2], 0.99 * 800.0 * Depth);
    EXPECT_LT(step, 0.1); // of 1.2 N: not the seam alone, the tank spreads it over the way
  }
}

TEST(CoincidentSurfaces, AWallNextToAFloorHasAMaterialOfItsOwn)
{
  SurfaceOptions options;
  options.TouchedSide = Side::Front;
  std::string error;
  const TriangleMesh corner = InsideCorner(0.1);
  // Each square of the corner as a surface of its own: near each other, but not along.
  std::vector<TouchedSurface> surfaces;
  for (std::size_t i = 0; i < corner.Triangles.size(); ++i)
  {
    TriangleMesh one{ corner.Points, { corner.Triangles[i] } };
    const std::shared_ptr<const TriangleSurface> surface =
      TriangleSurface::Build(one, options, error);
    ASSERT_NE(surface, nullptr) << error;
    const Vec3& p = corner.Points[corner.Triangles[i][0]];
    const Vec3 normal =
      Cross(corner.Points[corner.Triangles[i][1]] - p, corner.Points[corner.Triangles[i][2]] - p);
    surfaces.push_back(haptics::testing::Touchable(surface,
      Everywhere(std::abs(normal[2]) > 0.5 * Length(normal) ? 1000.0 : 100.0, 0.0, 0.0, 0.0, 0.0)));
  }
  GodObject god(std::move(surfaces));
  god.Update({ 0.02, 0.01, 0.01 });
  god.Update({ 0.02, -0.003, -0.001 }); // three quarters of the push on the wall
  const Contact& contact = god.Current();
  ASSERT_EQ(contact.NumberOfConstraints, 2);
  EXPECT_NEAR(contact.Material.Stiffness, 0.75 * 100.0 + 0.25 * 1000.0, 1e-3);
}

TEST(CoincidentSurfaces, CountOnlyOnTheSideThatHolds)
{
  // One that is touched from both sides, and one on it that has a front only.
  for (const bool isReversed : { false, true })
  {
    std::vector<TouchedSurface> surfaces{ Touchable(
                                            { -0.1, 0.1, 0.0, 200.0 }, CrackWidth, Side::Both),
      Touchable({ -0.1, 0.1, 0.0, 800.0 }) };
    if (isReversed)
    {
      std::swap(surfaces[0], surfaces[1]);
    }
    GodObject god(surfaces);
    for (const double side : { 1.0, -1.0 })
    {
      const Vec3 off{ 0.003, 0.0013, side * Depth };
      const Vec3 pressed{ 0.003, 0.0013, -side * Depth };
      god.Place(off);
      god.Update(off);
      const Contact& contact = god.Update(pressed);
      ASSERT_EQ(contact.NumberOfConstraints, 1);
      EXPECT_DOUBLE_EQ(contact.Material.Stiffness, side > 0.0 ? 500.0 : 200.0);
    }
  }
}

TEST(CoincidentSurfaces, HaveTheSteepestProfileInEitherOrder)
{
  std::string error;
  const TouchedSurface plain = Touchable({ -0.1, 0.1, 0.0, -1.0 });
  std::vector<TouchedSurface> surfaces{ plain };
  for (const double force : { 1.0, 3.0 })
  {
    PropertyValues values;
    values.Profile = ForceProfile::Build({ 0.0, force }, 0.01, error);
    ASSERT_NE(values.Profile, nullptr) << error;
    surfaces.push_back(haptics::testing::Touchable(plain.Surface, values));
  }
  for (int i = 0; i < 3; ++i)
  {
    std::rotate(surfaces.begin(), surfaces.begin() + 1, surfaces.end());
    GodObject god(surfaces);
    god.Update({ 0.003, 0.0013, 0.001 });
    const Contact& contact = god.Update({ 0.003, 0.0013, -Depth });
    ASSERT_NE(contact.Material.Profile, nullptr);
    EXPECT_NEAR(contact.Material.Profile->SteepestSlope(), 300.0, 1e-9);
  }
}

TEST(CoincidentSurfaces, StayStuckByTheSharedFrictionThroughAnExchangeElsewhere)
{
  for (const bool isReversed : { false, true })
  {
    std::vector<TouchedSurface> surfaces{ Touchable({ -0.1, 0.1, 0.0, 500.0, 0.0 }),
      Touchable({ -0.1, 0.1, 0.0, 500.0, 1.0 }) };
    if (isReversed)
    {
      std::swap(surfaces[0], surfaces[1]);
    }
    GodObject god(surfaces);
    god.Update({ 0.0, 0.0013, 0.001 });
    god.Update({ 0.0, 0.0013, -Depth });
    // Within the mean cone of 0.5, and not within any other.
    const Vec3 held{ 0.45 * Depth, 0.0013, -Depth };
    EXPECT_EQ(god.Update(held).Position[0], 0.0);
    surfaces.push_back(Touchable({ 0.5, 0.6, 0.0, 100.0 }));
    GodObject next(surfaces);
    next.Continue(god);
    EXPECT_DOUBLE_EQ(next.Current().Material.StaticFriction, 0.5);
    EXPECT_NEAR(next.Update(held).Position[0], 0.0, 1e-12);
    EXPECT_GT(next.Update({ 0.55 * Depth, 0.0013, -Depth }).Position[0], 0.0);
  }
}
