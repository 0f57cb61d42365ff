// What is in plain view is reached: nothing holds the god-object where nothing is. In the drawings
// o is the god-object and x the haptic interface point (HIP). Lengths are metres.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "haptics/Contact/GodObject.h"
#include "haptics/Surface/SurfaceDeformer.h"
#include "haptics/Surface/SurfaceMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace haptics;
using namespace haptics::testing;

namespace
{
using SurfacePointer = std::shared_ptr<const TriangleSurface>;
constexpr double Degree = 3.14159265358979323846 / 180.0;

TriangleMesh BoxFrom(const Vec3& low, const Vec3& high)
{
  const Vec3 half = 0.5 * (high - low);
  return Moved(Box(half[0], half[1], half[2]), 0.5 * (low + high));
}

/// Whether nothing that can be touched lies between the god-object and the HIP, nor between it and
/// places around the HIP: a cone of a thousandth. Exact.
bool IsInPlainView(const GodObject& god, const Vec3& hip)
{
  const Vec3 way = god.Current().Position - hip;
  const Vec3 u =
    Unit(Cross(way, std::abs(way[0]) < std::abs(way[1]) ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 }));
  const Vec3 v = Unit(Cross(way, u));
  for (std::size_t i = 0; i < god.Surfaces().size(); ++i)
  {
    const auto& surface = god.Surfaces()[i].Surface;
    const ExactQueries exact(surface);
    const Vec3 from = god.LocalPosition(static_cast<int>(i));
    const Vec3 to = hip - surface->Origin();
    if (exact.Crosses(from, to))
    {
      return false;
    }
    for (int k = 0; k < 6; ++k)
    {
      const double angle = 60.0 * Degree * k;
      const Vec3 aside = 0.001 * Length(way) * (std::cos(angle) * u + std::sin(angle) * v);
      if (exact.Crosses(from, to + aside))
      {
        return false;
      }
    }
  }
  return true;
}

/// A prism along z whose edge at the origin points to +x.
TriangleMesh Wedge(double degrees)
{
  const double s = std::sin(0.5 * degrees * Degree);
  const double c = std::cos(0.5 * degrees * Degree);
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, 0 }, { -c, s, 0 }, { -c, -s, 0 }, { 0, 0, 1 }, { -c, s, 1 },
    { -c, -s, 1 } };
  mesh.Triangles = { { 0, 2, 1 }, { 3, 4, 5 }, { 0, 1, 4 }, { 0, 4, 3 }, { 0, 5, 2 }, { 0, 3, 5 },
    { 1, 2, 5 }, { 1, 5, 4 } };
  return mesh;
}

/// A hand slides along x at a depth of 0.2 mm under z = 0, from -14 mm to 14 mm: the greatest
/// sideways displacement of the god-object from it, in contact.
double LargestDrag(const std::vector<TouchedSurface>& surfaces, double y = 0.001)
{
  GodObject god(surfaces);
  god.Place({ -0.014, y, 0.005 });
  double drag = 0.0;
  for (int i = 0; i <= 560; ++i)
  {
    const Contact& contact = god.Update({ -0.014 + 5e-5 * i, y, -0.0002 });
    EXPECT_EQ(contact.Status, UpdateStatus::Touching);
    drag = std::max(drag, std::hypot(contact.Displacement[0], contact.Displacement[1]));
  }
  return drag;
}

std::vector<TouchedSurface> AsOne(const std::vector<TriangleMesh>& parts, Side side)
{
  TriangleMesh all = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i)
  {
    all = Joined(all, parts[i]);
  }
  return { MakeSurface(all, side) };
}

std::vector<TouchedSurface> AsSeveral(const std::vector<TriangleMesh>& parts, Side side)
{
  std::vector<TouchedSurface> surfaces;
  for (const TriangleMesh& part : parts)
  {
    surfaces.emplace_back(MakeSurface(part, side));
  }
  return surfaces;
}
}

//   o ------> o
//  ____|   |____      however narrow the slot is that is crossed in one tick
//    x |   |  x
TEST(PlainView, ASlotCrossedInOneTickDoesNotHold)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    const double clearance = 1024.0 * 0x1p-53;
    for (const double width : { 10.0 * clearance, 1e3 * clearance, 1e-9, 1e-6, 1e-3, 0.02, 0.2 })
    {
      const std::vector<TriangleMesh> parts{ BoxFrom(
                                               { -0.5, -0.5, -0.1 }, { -0.5 * width, 0.5, 0.1 }),
        BoxFrom({ 0.5 * width, -0.5, -0.1 }, { 0.5, 0.5, 0.1 }) };
      for (const auto& surfaces : { AsOne(parts, side), AsSeveral(parts, side) })
      {
        for (const double x : { 0.4, 0.2, 0.12, 0.5 * width + 0.002 })
        {
          GodObject god(surfaces);
          god.Place({ -x, 0.01, 0.2 });
          god.Update({ -x, 0.01, 0.05 });
          god.Update({ x, 0.01, 0.05 });
          const Contact& contact = god.Update({ x, 0.01, 0.05 });
          EXPECT_LT(Length(contact.Displacement - Vec3{ 0, 0, 0.05 }), 1e-9)
            << "width " << width << ", x " << x;
        }
      }
    }
  }
}

//   \  o        pressed head-on, then around the edge: once it is in the open, it is free
//    > x
//   /
TEST(PlainView, AConvexEdgeOfAnyAngleHoldsNothingInTheOpen)
{
  for (const double scale : { 1.0, 1e-6, 1e6 })
  {
    for (const double degrees : { 0.5, 1.0, 5.0, 10.0, 20.0, 28.0, 28.1, 40.0, 60.0, 80.0, 90.0,
           100.0, 140.0, 152.0, 170.0, 179.0 })
    {
      const auto surface = [&](Side side)
      { return MakeSurface(Scaled(Wedge(degrees), scale), side); };
      for (const Side side : { Side::Front, Side::Both })
      {
        GodObject god({ surface(side) });
        god.Place({ 0.3 * scale, 0, 0.47 * scale });
        for (int k = 1; k <= 30; ++k)
        {
          god.Update({ (0.3 - 0.32 * k / 30.0) * scale, 0, 0.47 * scale });
        }
        for (int k = 0; k < 180; ++k)
        {
          const double angle = k * Degree;
          const Vec3 hip{ -0.02 * std::cos(angle) * scale, -0.02 * std::sin(angle) * scale,
            0.47 * scale };
          god.Update(hip);
          const Contact& contact = god.Update(hip);
          EXPECT_TRUE(contact.Penetration < 1e-9 * scale || !IsInPlainView(god, hip))
            << degrees << " degrees, at " << k << ", side " << static_cast<int>(side);
        }
      }
    }
  }
}

//      -> o            flush: the seam does not hold, be it one surface or several, one part
//  _______|_______     into the other or not, or the one that is slid to a little lower
//         |  x
TEST(PlainView, AFlushSeamOfSolidsDoesNotHold)
{
  for (const double overlap : { 0.0, 0.001 })
  {
    for (const double lower : { 0.0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6 })
    {
      for (const double tilt : { 0.0, 0.003 })
      {
        TriangleMesh right = BoxFrom({ -overlap, -0.01, -0.02 - lower }, { 0.02, 0.01, -lower });
        for (Vec3& p : right.Points)
        {
          p[0] += tilt * p[1];
        }
        const std::vector<TriangleMesh> parts{
          BoxFrom({ -0.02, -0.02, -0.02 }, { overlap, 0.02, 0 }), right
        };
        for (const Side side : { Side::Front, Side::Both })
        {
          // Where both sides are touched a wall that stands in the other solid is in nobody's way.
          EXPECT_LT(LargestDrag(AsOne(parts, side)), 1e-9) << overlap << ", " << lower;
          EXPECT_LT(LargestDrag(AsSeveral(parts, side)), 1e-9) << overlap << ", " << lower;
        }
      }
    }
  }
}

//   ___|____         three parts that meet in a T, and four in a cross: over the point where they
//      |   x         meet, next to it and along the seams
//   ___|____
TEST(PlainView, WhereThreeOrFourFlushPartsMeetNothingHolds)
{
  const TriangleMesh half = BoxFrom({ -0.02, -0.02, -0.02 }, { 0, 0.02, 0 });
  const TriangleMesh first = BoxFrom({ 0, -0.02, -0.02 }, { 0.02, 0, 0 });
  const TriangleMesh second = BoxFrom({ 0, 0, -0.02 }, { 0.02, 0.02, 0 });
  const TriangleMesh third = BoxFrom({ -0.02, -0.02, -0.02 }, { 0, 0, 0 });
  const TriangleMesh fourth = BoxFrom({ -0.02, 0, -0.02 }, { 0, 0.02, 0 });
  const std::vector<std::vector<TriangleMesh>> tables{ { half, first, second },
    { second, half, first }, { third, first, second, fourth }, { second, fourth, third, first } };
  for (const auto& parts : tables)
  {
    for (const Side side : { Side::Front, Side::Both })
    {
      for (const double y : { 0.0, 1e-15, -1e-15, 1e-12, 1e-6, 0.003, -0.003 })
      {
        EXPECT_LT(LargestDrag(AsOne(parts, side), y), 1e-9) << y;
        EXPECT_LT(LargestDrag(AsSeveral(parts, side), y), 1e-9) << y;
      }
    }
  }
}

//  =----o        next to the tip of a needle, however fine it is, the way is free
//       x
TEST(PlainView, ANeedleEndsAtItsTip)
{
  for (const double halfWidth : { 5e-2, 5e-3, 5e-4, 5e-5, 5e-6 })
  {
    TriangleMesh needle;
    needle.Points = { { 0, 0, 0 }, { 1, halfWidth, 0 }, { 1, -halfWidth, 0 } };
    needle.Triangles = { { 0, 2, 1 } };
    for (const double scale : { 1.0, 1e-6, 1e6 })
    {
      for (const Side side : { Side::Front, Side::Both })
      {
        const auto surface = MakeSurface(Scaled(needle, scale), side);
        for (const double x : { 1e-5, 1e-4, 1e-3, 1e-2, 5e-2, 0.2 })
        {
          GodObject god({ surface });
          god.Place({ -x * scale, 0, 0.1 * scale });
          EXPECT_EQ(god.Update({ -x * scale, 0, -0.05 * scale }).Status, UpdateStatus::Free)
            << halfWidth << ", " << x << ", scale " << scale;
        }
        GodObject god({ surface });
        const double within = 1e-9 / halfWidth * scale;
        god.Place({ within, 0, 0.1 * scale });
        EXPECT_EQ(god.Update({ within, 0, -0.05 * scale }).Status, UpdateStatus::Touching);
      }
    }
  }
}

// Triangles whose third corner was computed on the edge of the other two: as thin as rounding. A
// hand whose way goes through one, found by exact arithmetic, is held by it.
TEST(PlainView, ATriangleAsThinAsRoundingHoldsWhatGoesThroughIt)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share;
  const auto anywhere = [&] { return Vec3{ normal(random), normal(random), normal(random) }; };
  int aimed = 0;
  for (int run = 0; run < 2000; ++run)
  {
    const double scale = run % 3 == 0 ? 1.0 : run % 3 == 1 ? 1e-6 : 1e6;
    const Vec3 origin = anywhere();
    TriangleMesh mesh;
    mesh.Points = { scale * (origin + anywhere()), scale * (origin + anywhere()), {} };
    mesh.Points[2] = mesh.Points[0] + share(random) * (mesh.Points[1] - mesh.Points[0]);
    mesh.Triangles = { { 0, 1, 2 } };
    std::string error;
    SurfaceOptions options;
    options.TouchedSide = Side::Both;
    const auto surface = TriangleSurface::Build(mesh, options, error);
    if (!surface)
    {
      continue; // in one line, to the last bit
    }
    double weights[3] = { share(random), share(random), share(random) };
    const double sum = weights[0] + weights[1] + weights[2];
    Vec3 at{};
    for (int k = 0; k < 3; ++k)
    {
      at = at + (weights[k] / sum) * mesh.Points[k];
    }
    const Vec3 half = (1e-4 * scale) * Unit(anywhere());
    const ExactQueries exact(surface);
    if (!exact.Crosses(at + half - surface->Origin(), at - half - surface->Origin()))
    {
      continue;
    }
    ++aimed;
    GodObject god({ surface });
    god.Place(at + half);
    EXPECT_EQ(god.Update(at - half).Status, UpdateStatus::Touching) << "run " << run;
    EXPECT_GT(god.Current().NumberOfConstraints, 0);
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    for (int i = 0; i + 1 < corners; ++i)
    {
      EXPECT_FALSE(exact.Crosses(way[i], way[i + 1])) << "run " << run << ", piece " << i;
    }
  }
  EXPECT_GT(aimed, 200);
}

//    \ | /      triangles that meet in one point, touched from both sides: pressed near it, then
//    the
//   o -x-       hand goes away
TEST(PlainView, APointWhereTrianglesMeetHoldsNothingInTheOpen)
{
  int contacts = 0;
  for (const unsigned seed : { 0u, 1u, 2u })
  {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share;
    const auto anywhere = [&](double size) {
      return size * Vec3{ normal(random), normal(random), normal(random) };
    };
    for (int run = 0; run < 4000; ++run)
    {
      const int count = 2 + static_cast<int>(random() % 3);
      std::vector<double> angles(2 * count);
      std::generate(angles.begin(), angles.end(), [&] { return 360.0 * Degree * share(random); });
      std::sort(angles.begin(), angles.end());
      TriangleMesh mesh;
      mesh.Points.push_back({ 0, 0, 0 });
      for (const double angle : angles)
      {
        mesh.Points.push_back({ std::cos(angle), std::sin(angle), 0.3 * normal(random) });
      }
      const int step = share(random) < 0.5 ? 2 : 1;
      for (int i = 0; i + 1 < 2 * count; i += step)
      {
        mesh.Triangles.push_back({ 0, 1 + i, 2 + i });
      }
      const Vec3 away = Unit(anywhere(1.0));
      const Vec3 path[4] = { 0.5 * away, anywhere(0.02) - 0.05 * away, anywhere(0.1) - 0.1 * away,
        anywhere(0.3) - 0.05 * away };
      GodObject god({ MakeSurface(mesh, Side::Both) });
      for (const Vec3& hip : path)
      {
        god.Update(hip);
        god.Update(hip);
        if (god.Current().Penetration > 0.02)
        {
          ++contacts;
          EXPECT_FALSE(IsInPlainView(god, hip)) << "seed " << seed << ", run " << run;
        }
      }
    }
  }
  EXPECT_GT(contacts, 4000);
}

//  ___|o|___     a slit in a sheet: its middle is open from ten clearances on, its sides hold
TEST(PlainView, ASlitInASheetIsOpenFromTenClearancesOn)
{
  const double clearance = 1024.0 * 0x1p-53 * std::sqrt(2.0);
  for (const double width : { 10.0 * clearance, 1e-9, 1e-6, 1e-3, 0.1 })
  {
    const auto half = [&](double from, double to)
    {
      TriangleMesh mesh;
      mesh.Points = { { from, -1, 0 }, { to, -1, 0 }, { to, 1, 0 }, { from, 1, 0 } };
      mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
      return mesh;
    };
    const auto sheet = Joined(half(-1.0, -0.5 * width), half(0.5 * width, 1.0));
    for (const double scale : { 1.0, 1e-6, 1e6 })
    {
      GodObject god({ MakeSurface(Scaled(sheet, scale), Side::Both) });
      for (const double side : { 1.0, -1.0, 1.0 })
      {
        EXPECT_EQ(god.Update({ 0, 0.1 * scale, 0.05 * side * scale }).Status, UpdateStatus::Free)
          << width << ", scale " << scale;
      }
      const double aside = 0.5 * width + 0.01;
      god.Place({ aside * scale, 0.1 * scale, 0.05 * scale });
      EXPECT_EQ(
        god.Update({ aside * scale, 0.1 * scale, -0.05 * scale }).Status, UpdateStatus::Touching);
    }
  }
}

//   o x
//    \|/      a cone's or pyramid's tip, pressed head-on, then the hand goes around it into the
//    open / \.
TEST(PlainView, TheTipOfAConeHoldsNothingInTheOpen)
{
  for (const int sides : { 3, 4, 7, 100 })
  {
    for (const double radius : { 0.001, 0.02, 0.1, 0.5 })
    {
      TriangleMesh cone;
      cone.Points = { { 0, 0, 0.1 }, { 0, 0, 0 } };
      for (int i = 0; i < sides; ++i)
      {
        const double a = 360.0 * Degree * i / sides;
        cone.Points.push_back({ radius * std::cos(a), radius * std::sin(a), 0 });
        const int next = 2 + (i + 1) % sides;
        cone.Triangles.push_back({ 0, 2 + i, next });
        cone.Triangles.push_back({ 1, next, 2 + i });
      }
      for (const double scale : { 1.0, 1e-6, 1e6 })
      {
        for (const Side side : { Side::Front, Side::Both })
        {
          GodObject god({ MakeSurface(Scaled(cone, scale), side) });
          god.Place({ 0, 0, 0.2 * scale });
          god.Update({ 0, 0, 0.09 * scale });
          for (int k = 0; k <= 60; ++k)
          {
            const double angle = 3.0 * k * Degree;
            const Vec3 hip{ 0.01 * std::sin(angle) * scale, 0.003 * std::sin(2 * angle) * scale,
              (0.1 - 0.01 * std::cos(angle)) * scale };
            god.Update(hip);
            const Contact& contact = god.Update(hip);
            EXPECT_TRUE(contact.Penetration < 1e-10 * scale || !IsInPlainView(god, hip))
              << sides << " sides, radius " << radius << ", scale " << scale << ", step " << k;
          }
        }
      }
    }
  }
}

//   o        x under the tip's other side: a tip where so many facets meet is one too, however
//    \\|//   near the god-object came to it
TEST(PlainView, TheTipOfAFineConeLetsGo)
{
  constexpr int Sides = 48;
  TriangleMesh cone;
  cone.Points = { { 0, 0, 0.5 }, { 0, 0, -0.5 } };
  for (int i = 0; i < Sides; ++i)
  {
    const double a = 360.0 * Degree * i / Sides;
    cone.Points.push_back({ 0.3 * std::cos(a), 0.3 * std::sin(a), -0.5 });
    const int next = 2 + (i + 1) % Sides;
    cone.Triangles.push_back({ 0, 2 + i, next });
    cone.Triangles.push_back({ 1, next, 2 + i });
  }
  GodObject god({ MakeSurface(cone, Side::Front) });
  for (int i = 0; i < Sides; ++i)
  {
    const Vec3& from = cone.Points[2 + i];
    god.Place(1.1 * from);
    god.Update(from);
    god.Update(from);
    god.Update(cone.Points[0]);
    god.Update(cone.Points[0]);
    const Vec3& hip = cone.Points[2 + (i + 7) % Sides];
    for (int tick = 0; tick < 4; ++tick)
    {
      god.Update(hip);
    }
    EXPECT_LT(god.Current().Penetration, 1e-12) << "from corner " << i;
  }
}

//       o
//    __/_\__     a sliver thinner than rounding lies along the edge of a roof, and the HIP is under
//   /   x   \    one of its slopes: the sliver is a part of the edge, no wire to hang on
TEST(PlainView, ASliverAlongAnEdgeHoldsNothing)
{
  for (const double height : { 1e-15, 1e-14 })
  {
    for (const Side side : { Side::Front, Side::Both })
    {
      const double slope = 0.2;
      TriangleMesh roof;
      roof.Points = { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, -slope }, { 0, 1, -slope },
        { 0.1, height, -slope * height } };
      roof.Triangles = { { 0, 2, 1 }, { 0, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 } };
      GodObject god({ MakeSurface(roof, side) });
      for (const double aside : { -2e-3, -1e-3, 1e-3, 2e-3 })
      {
        // Straight through the edge.
        const Vec3 hip{ 0.05, aside, -0.02 };
        god.Place({ 0.05, -aside, 0.02 });
        for (int tick = 0; tick < 8; ++tick)
        {
          god.Update(hip);
        }
        // On either slope; the edge itself is farther away than both.
        const double depth = god.Current().Penetration * std::hypot(1.0, slope);
        EXPECT_NEAR(std::abs(depth - 0.02), slope * std::abs(aside), 1e-9)
          << "height " << height << ", " << aside << " off the edge";
      }
    }
  }
}

//  Where facets meet at a corner that is neither convex nor concave, no three planes are what is
//  free: a hand at rest is led on along any facet there.
TEST(PlainView, ACornerThatIsNeitherConvexNorConcaveDoesNotHold)
{
  struct Corner
  {
    Vec3 Place, Hip;
  };
  const Corner corners[] = {
    { { -0.23512957947147111, -0.19245813001503341, 0.37631278778090148 },
      { 0.5470066316101501, 0.60982259579211951, -0.30162775256363652 } },
    { { 0.30395816783366801, 0.34259205835947325, -0.01970075463642785 },
      { -0.59995773920312151, -0.33566857235345471, 0.3814480417195402 } },
  };
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    const auto surface = MakeSurface(Scaled(Star(3, 1.0, 0.7, 8), scale));
    for (const Corner& corner : corners)
    {
      GodObject god({ surface });
      god.Place(surface->Origin() + scale * corner.Place);
      for (int tick = 0; tick < 8; ++tick)
      {
        god.Update(surface->Origin() + scale * corner.Hip);
      }
      EXPECT_LT(god.Current().Penetration, 0.96 * scale * Length(corner.Place - corner.Hip));
    }
  }
}

//  Four sheets that meet in a point: near it two reach over each other's gap, each under the
//  other's plane. The hand goes between them.
TEST(PlainView, SheetsThatReachOverEachOtherDoNotHoldTogether)
{
  const Vec3 tip{ 4.4988286874425167, -1.498787241627225, -0.041994813316285962 };
  TriangleMesh sheets;
  sheets.Points = { tip, { 5.1827879726114006, -0.76926705943123519, -0.3959228057635264 },
    { 4.9834792827716665, -0.62407940443408449, 0.094856923931356307 },
    { 4.6153985991196294, -0.50560475301217167, 0.26512215283838086 },
    { 3.923401331841827, -2.316640136973569, -0.4132190903490115 },
    { 4.3251893700556288, -2.4835965569047644, -0.31909290148820568 },
    { 5.0942312625737873, -2.3022147576652632, -0.22620209634467317 },
    { 5.335903303037437, -2.0458759802488657, 0.02785250141084171 },
    { 5.4791398435896639, -1.6962461921294629, -0.3796278190587728 } };
  sheets.Triangles = { { 0, 1, 2 }, { 0, 3, 4 }, { 0, 5, 6 }, { 0, 7, 8 } };
  const Vec3 step{ 1.567086979498e-4, 1.779552937809e-4, -6.349685042254e-4 };
  SurfaceOptions options;
  options.TouchedSide = Side::Both;
  options.CrackWidth = 5.5e-12;
  std::string error;
  GodObject god({ TriangleSurface::Build(sheets, options, error) });
  god.Place({ 4.4983031017057401, -1.4993840863806000, -0.0398651906884979 });
  Vec3 hip{ 4.4986165191016392, -1.4990281757931578, -0.041135127696907949 };
  god.Update(hip);
  for (int tick = 0; tick < 4; ++tick)
  {
    hip = hip + step;
    god.Update(hip);
  }
  for (int tick = 0; tick < 8; ++tick)
  {
    god.Update(hip);
  }
  EXPECT_LT(god.Current().Penetration, 1e-6);
}

//  --------o->------      exactly in the plane of a sheet: nothing is crossed, so nothing
//                         holds; and what has come to rest in the sheet is in front of it
TEST(PlainView, AMotionInATrianglesPlaneCrossesNothing)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    for (const double leave : { 1.0, -1.0 })
    {
      GodObject god({ MakeSurface(Square(1.0), side) });
      god.Place({ -2, 0.1, 0 });
      EXPECT_EQ(god.Update({ 2, 0.2, 0 }).Status, UpdateStatus::Free);
      EXPECT_EQ(god.Update({ 0.3, 0.1, 0 }).Status, UpdateStatus::Free);
      EXPECT_EQ(god.Current().Position, (Vec3{ 0.3, 0.1, 0 }));
      const Contact& left = god.Update({ 0.3, 0.1, 0.05 * leave });
      // On it is in front of it.
      const bool isHeld = leave < 0.0;
      EXPECT_EQ(left.Status, isHeld ? UpdateStatus::Touching : UpdateStatus::Free) << leave;
    }
  }
}

//    -> o          the same seam in single precision, and while the parts are carried along
TEST(PlainView, AFlushSeamThatMovesOrIsStoredInSinglePrecisionDoesNotHold)
{
  const auto left = BoxFrom({ -0.02, -0.02, -0.02 }, { 0, 0.02, 0 });
  const auto right = BoxFrom({ 0, -0.01, -0.02 }, { 0.02, 0.01, 0 });
  const auto single = [](TriangleMesh mesh)
  {
    for (Vec3& p : mesh.Points)
    {
      for (double& x : p)
      {
        x = static_cast<float>(x + 0.1);
      }
    }
    return mesh;
  };
  SurfaceOptions options;
  options.TouchedSide = Side::Front;
  options.CrackWidth = 1e-7;
  std::string error;
  const Vec3 shift{ 0.1, 0.1, 0.1f };
  std::vector<TouchedSurface> still;
  for (const TriangleMesh& part : { left, right })
  {
    still.emplace_back(TriangleSurface::Build(single(part), options, error));
  }
  const auto motion = std::make_shared<SurfaceMotion>(RigidPose());
  GodObject stored(still);
  GodObject moving({ { MakeSurface(left), motion }, { MakeSurface(right), motion } });
  stored.Place(shift + Vec3{ -0.014, 0.001, 0.005 });
  moving.Place({ -0.014, 0.001, 0.005 });
  for (int i = 0; i <= 560; ++i)
  {
    const Vec3 hip{ -0.014 + 5e-5 * i, 0.001, -0.0002 };
    const Vec3& slid = stored.Update(shift + hip).Displacement;
    EXPECT_LT(std::hypot(slid[0], slid[1]), 1e-7) << i;
    const Vec3 by{ 1e-5 * i, 2e-5 * i, -1e-5 * i };
    motion->MoveTo({ by, { 1, 0, 0, 0 } }, 0.0);
    moving.Advance(0.001);
    const Vec3& carried = moving.Update(hip + by).Displacement;
    EXPECT_LT(std::hypot(carried[0], carried[1]), 1e-9) << i;
  }
}

//   ____o     over the rim, to within a clearance, with the HIP in the wall's very plane: what the
//       |     HIP does when it gets there must not decide whether it is let go of at rest
//       x
TEST(PlainView, AnEdgeOverWhichTheHipIsInTheWallLetsGoOfAHandAtRest)
{
  for (const double scale : { 1.0, 1e-6, 1e6 })
  {
    const auto surface = MakeSurface(Scaled(Box(0.5, 0.5, 0.5), scale), Side::Automatic);
    for (const double inside : { 0.0, 0.4, 1.0 }) // clearances
    {
      const double x = 0.5 * scale - inside * surface->Clearance();
      for (const bool creeps : { false, true })
      {
        GodObject god({ surface });
        god.Place({ x, 0.13 * scale, 0.6 * scale });
        // Pressed by a clearance's depth, where no way is short enough; then deep.
        for (int i = 0; i < 3; ++i)
        {
          god.Update({ x, 0.13 * scale, 0.5 * scale });
        }
        for (int i = 0; creeps && i < 20; ++i)
        {
          god.Update({ x, 0.13 * scale, (0.3 - 1e-4 * i) * scale });
        }
        const Vec3 hip = { x, 0.13 * scale, 0.2 * scale };
        for (int i = 0; i < 8; ++i)
        {
          god.Update(hip);
        }
        EXPECT_LE(god.Current().Penetration, 8.0 * surface->Clearance())
          << scale << ", " << inside << ", " << creeps;
      }
    }
    // Farther inside than what it is kept off, it is held: the facet is there.
    GodObject god({ surface });
    const Vec3 hip = { 0.499 * scale, 0.13 * scale, 0.2 * scale };
    god.Place({ hip[0], hip[1], 0.6 * scale });
    for (int i = 0; i < 8; ++i)
    {
      god.Update(hip);
    }
    EXPECT_NEAR(god.Current().Penetration, 0.3 * scale, 1e-9 * scale);
  }
}

// Corners with ridges and folds, at rest: three planes hold, but between two ridges there is a way
// that is along neither a facet nor two. Places and HIPs are those of a soak.
TEST(PlainView, ACornerOfSpikesDoesNotHoldAHandAtRest)
{
  struct Hold
  {
    unsigned Seed;
    Side TouchedSide;
    Vec3 Place, Hip;
  };
  const Hold holds[] = {
    { 1, Side::Front, { 0.34068996163670912, 0.10263799812150388, -0.55124793755411294 },
      { -0.26071569776190995, 0.10139245239494955, 0.33020941964679051 } },
    { 2, Side::Front, { 0.20233408161794481, 0.20474476761951801, 0.046843797310228946 },
      { 0.13616300368861126, -0.68269616967847102, 0.87574482080376626 } },
    { 2, Side::Both, { -0.24290555903047079, -0.36872079248555062, 0.16291216701776209 },
      { -0.55723330072413324, -0.56596517056077567, 0.13537771196558912 } },
    { 1, Side::Both, { 0.18155087055161578, 0.46843890816890449, 0.066723132580024921 },
      { -0.37175614369925314, 0.87241137613214215, -0.47635931270467124 } },
  };
  for (const Hold& hold : holds)
  {
    const auto surface = MakeSurface(Star(3, 1.0, 0.9, hold.Seed), hold.TouchedSide);
    GodObject god({ surface });
    god.Place(god.WayOrigin() + hold.Place);
    const Vec3 hip = god.WayOrigin() + hold.Hip;
    const double before = Length(hold.Hip - hold.Place);
    for (int i = 0; i < 6; ++i)
    {
      god.Update(hip);
    }
    EXPECT_LT(god.Current().Penetration, 0.98 * before) << hold.Seed;
    EXPECT_EQ(god.Current().Status, UpdateStatus::Touching);
  }
}

// A facet thinner than its clearance is met as a line, by a plane that is turned to where it is met
// from: what was learned of it where it was pressed from above says nothing of where it is passed
// by.
TEST(PlainView, AFacetThatWasPressedHoldsNothingWhereItIsPassedBy)
{
  const double width = 0.0029258720933541690;
  TriangleMesh mesh;
  mesh.Points = { { -0.5, 0, 0 }, { 0.5, 0, 0 }, { -0.064659218944795385, width, 0 } };
  mesh.Triangles = { { 0, 1, 2 } };
  for (const Side side : { Side::Front, Side::Both })
  {
    SurfaceOptions options;
    options.TouchedSide = side;
    options.CrackWidth = 0.012;
    std::string error;
    const auto surface = TriangleSurface::Build(mesh, options, error);
    ASSERT_TRUE(surface) << error;
    const ExactQueries exact(surface);
    int passed = 0;
    for (int i = 0; i < 121; ++i)
    {
      GodObject god({ surface });
      const double x = -0.064215624984843192;
      god.Place({ x, 0.0013277054127025442, 0.1 });
      for (int tick = 0; tick < 12; ++tick)
      {
        god.Update({ x + (tick % 2 ? 2e-3 : -2e-3), 0.5 * width + 1e-4 * (tick % 3 - 1), -0.006 });
      }
      god.Update({ x, -0.044231605704643982, 0.088949473602359094 });
      const double aside = 5e-5 * (i - 60);
      const Vec3 hip = { -0.064570996646709705, 0.047644221149713895 + 0.88 * aside,
        -0.084202492003628698 + 0.47 * aside };
      for (int tick = 0; tick < 4; ++tick)
      {
        god.Update(hip);
      }
      if (!exact.Crosses(god.LocalPosition(0), hip - surface->Origin()))
      {
        EXPECT_LE(god.Current().Penetration, 8.0 * surface->Clearance()) << i;
        ++passed;
      }
    }
    EXPECT_GT(passed, 50);
  }
}

// GodObject.h's theorem, with its number: in plain view the god-object is at the HIP, to within 8
// clearances, in that update or in the next ones at rest.
TEST(PlainView, IsReachedToWithinEightClearances)
{
  int views = 0;
  for (const double scale : { 1.0, 1e-6, 1e6 })
  {
    const TriangleMesh meshes[] = { Star(2, 1.0, 0.7, 3), Soup(60, 0.8, 5), Wedge(28.0),
      Box(0.5, 0.5, 0.1), Joined(Square(0.9), Moved(Square(0.9), { 0.05, 0.02, 1e-9 })) };
    for (const TriangleMesh& mesh : meshes)
    {
      for (const Side side : { Side::Front, Side::Both })
      {
        const auto surface = MakeSurface(Scaled(mesh, scale), side);
        GodObject god({ surface });
        std::mt19937 random(1);
        std::uniform_real_distribution<double> anywhere(-1.1, 1.1);
        god.Place({ 3.0 * scale, 0, 0 });
        for (int i = 0; i < 150; ++i)
        {
          const double x = anywhere(random) * scale;
          const double y = anywhere(random) * scale;
          const Vec3 hip = { x, y, anywhere(random) * scale };
          for (int tick = 0; tick < 3; ++tick)
          {
            god.Update(hip);
          }
          if (IsInPlainView(god, hip))
          {
            ++views;
            EXPECT_LE(god.Current().Penetration, 8.0 * surface->Clearance())
              << "scale " << scale << ", side " << static_cast<int>(side) << ", HIP " << i;
          }
        }
      }
    }
  }
  EXPECT_GT(views, 1000);
}

//  -> o          flush parts, in one and in several surfaces, at scales from 1e-6 to 1e6: a step
//  ______|____   lower, overlapping, three that meet in a T, and slots
TEST(PlainView, FlushPartsAndSlotsAreTheSameAtEveryScale)
{
  for (const double scale : { 1e-6, 1e-3, 1e3, 1e6 })
  {
    const auto scaled = [scale](std::vector<TriangleMesh> parts)
    {
      for (TriangleMesh& part : parts)
      {
        part = Scaled(part, scale);
      }
      return parts;
    };
    const TriangleMesh left = BoxFrom({ -0.5, -0.5, -0.1 }, { 0, 0.5, 0.1 });
    const std::vector<std::vector<TriangleMesh>> tables{
      { left, BoxFrom({ 0, -0.5, -0.1 }, { 0.5, 0.5, 0.1 }) },
      { left, BoxFrom({ 0, -0.5, -0.1 }, { 0.5, 0.5, 0.1 - 1e-9 }) },
      { left, BoxFrom({ 0, -0.5, -0.1 }, { 0.5, 0.5, 0.1 - 1e-6 }) },
      { BoxFrom({ -0.5, -0.5, -0.1 }, { 0.1, 0.5, 0.1 }),
        BoxFrom({ -0.1, -0.5, -0.1 }, { 0.5, 0.5, 0.1 }) },
      { left, BoxFrom({ 0, -0.5, -0.1 }, { 0.5, 0.01, 0.1 }),
        BoxFrom({ 0, 0.01, -0.1 }, { 0.5, 0.5, 0.1 }) },
      { BoxFrom({ -0.5, -0.5, -0.1 }, { -1e-3, 0.5, 0.1 }),
        BoxFrom({ 1e-3, -0.5, -0.1 }, { 0.5, 0.5, 0.1 }) },
    };
    for (const auto& table : tables)
    {
      for (const Side side : { Side::Front, Side::Both })
      {
        for (const auto& surfaces : { AsOne(scaled(table), side), AsSeveral(scaled(table), side) })
        {
          // In steps, along the seam's own line, and in one.
          for (const int steps : { 1, 37 })
          {
            for (const double y : { 0.01, 0.0, 0.2 })
            {
              GodObject god(surfaces);
              god.Place({ -0.3 * scale, y * scale, 0.2 * scale });
              god.Update({ -0.3 * scale, y * scale, 0.05 * scale });
              for (int i = 1; i <= steps; ++i)
              {
                god.Update({ (-0.3 + 0.6 * i / steps) * scale, y * scale, 0.05 * scale });
              }
              const Contact& contact = god.Update({ 0.3 * scale, y * scale, 0.05 * scale });
              EXPECT_LT(Length(contact.Displacement - Vec3{ 0, 0, 0.05 * scale }), 1.1e-6 * scale)
                << scale << ", " << steps << " steps";
            }
          }
        }
      }
    }
  }
}

//    |o|      a notch that narrows to a point, cut in a sheet from its rim: open where it is wider
//   __\/__    than ten clearances
TEST(PlainView, ANotchInASheetIsOpen)
{
  for (const double scale : { 1.0, 1e-6, 1e6 })
  {
    for (const double half : { 0.5, 0.01, 1e-5 }) // of its width at the rim
    {
      TriangleMesh sheet;
      sheet.Points = { { 0, 0, 0 }, { -half, 1, 0 }, { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 },
        { 1, 1, 0 }, { half, 1, 0 } };
      sheet.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 6 } };
      const auto surface = MakeSurface(Scaled(sheet, scale), Side::Both);
      for (const double y : { 0.9, 0.1, 1e-3, 20.0 * surface->Clearance() / (half * scale) })
      {
        GodObject god({ surface });
        for (const double side : { 1.0, -1.0, 1.0 })
        {
          EXPECT_EQ(god.Update({ 0, std::min(y, 0.9) * scale, 0.05 * side * scale }).Status,
            UpdateStatus::Free)
            << half << ", " << y << ", scale " << scale;
        }
      }
      GodObject god({ surface });
      god.Place({ 0, -0.1 * scale, 0.05 * scale });
      EXPECT_EQ(god.Update({ 0, -0.1 * scale, -0.05 * scale }).Status, UpdateStatus::Touching);
    }
  }
}

//   -> o         slivers of all widths among good triangles of one plane do not hold
TEST(PlainView, SliversAmongGoodTrianglesOfAPlaneDoNotHold)
{
  for (const double width : { 1e-3, 1e-6, 1e-9, 1e-12, 1e-14 })
  {
    TriangleMesh plate = Square(0.02, 4);
    const std::vector<Triangle> good = plate.Triangles;
    plate.Triangles.clear();
    for (const auto& [a, b, c] : good)
    {
      const Vec3& p = plate.Points[a];
      const Vec3& q = plate.Points[b];
      const Vec3 foot = p + 0.37 * (q - p);
      const auto inner = static_cast<std::int32_t>(plate.Points.size());
      plate.Points.push_back(foot + width * (plate.Points[c] - foot));
      plate.Triangles.insert(
        plate.Triangles.end(), { { a, b, inner }, { b, c, inner }, { c, a, inner } });
    }
    for (const Side side : { Side::Front, Side::Both })
    {
      for (const double y : { 0.001, 0.0, 0.01 })
      {
        EXPECT_LT(LargestDrag({ MakeSurface(plate, side) }, y), 1e-9) << width << ", " << y;
      }
    }
  }
}

//   -> o     ^   a flush seam of two parts that are deformed together, and lets go at its end
//  _____|_____
TEST(PlainView, AFlushSeamThatDeformsDoesNotHold)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    const TriangleMesh mesh = Joined(BoxFrom({ -0.02, -0.02, -0.02 }, { 0, 0.02, 0 }),
      BoxFrom({ 0, -0.02, -0.02 }, { 0.02, 0.02, 0 }));
    SurfaceDeformer deformer(MakeSurface(mesh, side));
    auto god = std::make_unique<GodObject>(std::vector<TouchedSurface>{ deformer.Latest() });
    god->Place({ -0.014, 0.001, 0.005 });
    double height = 0.0;
    for (int i = 0; i <= 560; ++i)
    {
      if (i % 20 == 0)
      {
        height += 0.0002;
        std::vector<Vec3> points = mesh.Points;
        for (Vec3& p : points)
        {
          p[2] += height;
        }
        std::string error;
        const auto next = deformer.Deform(points, 0.02, error);
        ASSERT_TRUE(next) << error;
        auto other = std::make_unique<GodObject>(std::vector<TouchedSurface>{ next });
        other->Continue(*god);
        god = std::move(other);
      }
      god->Advance(0.001);
      const Contact& contact = god->Update({ -0.014 + 5e-5 * i, 0.001, -0.0002 });
      EXPECT_EQ(contact.Status, UpdateStatus::Touching) << i;
      EXPECT_LT(std::hypot(contact.Displacement[0], contact.Displacement[1]), 1e-7) << i;
    }
    const double away = height + 0.01;
    god->Advance(0.001);
    EXPECT_EQ(god->Update({ 0.014, 0.001, away }).Status, UpdateStatus::Free);
  }
}
