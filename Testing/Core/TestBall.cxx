// A god-object that is a ball, against closed forms. In the drawings O is the ball and x the haptic
// interface point (HIP). Lengths are metres.
#include "AnalyticSurfaces.h"
#include "ExactQueries.h"
#include "HipPath.h"
#include "Judge.h"
#include "ProfileSurfaces.h"
#include "RandomVectors.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double R = 0.003;
/// Of the sizes here, about 0.1 m.
constexpr double Tight = 1e-10;
constexpr double Pi = 3.14159265358979323846;

struct BallScene
{
  GodObject God;

  explicit BallScene(TriangleMesh mesh, Side side = Side::Front, double radius = R)
    : God({ MakeSurface(std::move(mesh), side) }, Tip::Ball)
  {
    this->God.SetTipRadius(radius);
  }
  const Contact& Go(const Vec3& hip) { return this->God.Update(hip); }
  /// The same HIP for so many ticks.
  const Contact& Rest(const Vec3& hip, int ticks)
  {
    for (int i = 1; i < ticks; ++i)
    {
      this->God.Update(hip);
    }
    return this->God.Update(hip);
  }
};

void ExpectAt(const Contact& contact, const Vec3& position, double tolerance = Tight)
{
  EXPECT_NEAR(contact.Position[0], position[0], tolerance);
  EXPECT_NEAR(contact.Position[1], position[1], tolerance);
  EXPECT_NEAR(contact.Position[2], position[2], tolerance);
}

/// A plate in z = 0 with a square hole about the origin.
TriangleMesh PlateWithHole(double halfSize, double halfHole)
{
  TriangleMesh mesh;
  const double s = halfSize;
  const double h = halfHole;
  mesh.Points = { { -s, -s, 0 }, { s, -s, 0 }, { s, s, 0 }, { -s, s, 0 }, { -h, -h, 0 },
    { h, -h, 0 }, { h, h, 0 }, { -h, h, 0 } };
  for (int i = 0; i < 4; ++i)
  {
    const int j = (i + 1) % 4;
    mesh.Triangles.push_back({ i, j, 4 + j });
    mesh.Triangles.push_back({ i, 4 + j, 4 + i });
  }
  return mesh;
}

/// On z = 0, of four sides; some corners are by a rounding off the axes.
TriangleMesh Pyramid(double size, double height)
{
  TriangleMesh mesh;
  mesh.Points = { { 0, 0, height }, { 0, 0, 0 } };
  for (int i = 0; i < 4; ++i)
  {
    const double angle = 0.5 * Pi * i;
    mesh.Points.push_back({ size * std::cos(angle), size * std::sin(angle), 0 });
    mesh.Triangles.push_back({ 0, 2 + i, 2 + (i + 1) % 4 });
    mesh.Triangles.push_back({ 1, 2 + (i + 1) % 4, 2 + i });
  }
  return mesh;
}
}

TEST(Ball, IsAtTheHipInFreeSpace)
{
  BallScene scene(Square(0.1));
  const Contact& contact = scene.Go({ 0.01, 0.02, 0.03 });
  EXPECT_EQ(contact.Status, UpdateStatus::Free);
  EXPECT_EQ(contact.Position, (Vec3{ 0.01, 0.02, 0.03 }));
}

//       O
//   ---------
//       x
TEST(Ball, StaysItsRadiusOverAPlane)
{
  BallScene scene(Square(0.1, 7));
  scene.Go({ 0.01, 0.02, 0.01 });
  const Contact& contact = scene.Go({ 0.013, 0.021, -0.002 });
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_EQ(contact.NumberOfConstraints, 1);
  ExpectAt(contact, { 0.013, 0.021, R });
  EXPECT_NEAR(contact.Constraints[0].Normal[2], 1.0, 1e-12);
  // It touches before its centre is there, and lets go.
  ExpectAt(scene.Go({ 0.02, 0, 0.5 * R }), { 0.02, 0, R });
  EXPECT_EQ(scene.Go({ 0.02, 0, 1.001 * R }).Status, UpdateStatus::Free);
}

TEST(Ball, SlidesOverAPlaneAsIfItHadNoEdges)
{
  BallScene scene(Square(0.1, 40));
  scene.Go({ 0.05, 0, 0.01 });
  for (int tick = 0; tick < 2000; ++tick)
  {
    const Vec3 hip{ 0.05 * std::cos(0.01 * tick), 0.05 * std::sin(0.01 * tick), -0.005 };
    const Contact& contact = scene.Go(hip);
    ExpectAt(contact, { hip[0], hip[1], R });
    ASSERT_EQ(contact.NumberOfConstraints, 1);
  }
}

// Around a sphere it goes on the sphere of R + r about each corner and no nearer than the facets'
// planes.
TEST(Ball, GoesAroundASphere)
{
  const double sphere = 0.05;
  BallScene scene(Icosphere(5, sphere));
  scene.Go({ 0, 0, 0.07 });
  for (int tick = 0; tick < 1000; ++tick)
  {
    const double a = 0.006 * tick;
    const Vec3 direction = Unit({ std::sin(a), 0.3 * std::sin(2.0 * a), std::cos(a) });
    const Contact& contact = scene.Go((sphere - 0.002) * direction);
    const double distance = Length(contact.Position);
    ASSERT_LE(distance, sphere + R + Tight);
    ASSERT_GE(distance, sphere * 0.9995 + R);
    // A facet leans by up to 1.2 degrees.
    ASSERT_GT(Dot(Unit(contact.Displacement), direction), 0.9997);
  }
}

// At a corner of the sphere that is pressed straight on, both are known exactly.
TEST(Ball, StandsOnASphereAndInOneAtRPlusAndMinusR)
{
  const double sphere = 0.05;
  const TriangleMesh mesh = Icosphere(3, sphere);
  const Vec3 corner = mesh.Points[7];
  BallScene outside(mesh);
  outside.Go(2.0 * corner);
  ExpectAt(outside.Go(0.999 * corner), (1.0 + R / sphere) * corner, 1e-9 * sphere);

  // In the hollow sphere a ball that is smaller comes to the middle of each facet.
  BallScene inside(InsideOut(mesh));
  inside.Go({ 0, 0, 0 });
  const Triangle& facet = mesh.Triangles[11];
  const Vec3 a = mesh.Points[facet[0]];
  const Vec3 normal = Unit(Cross(mesh.Points[facet[1]] - a, mesh.Points[facet[2]] - a));
  const double height = Dot(normal, a);
  ExpectAt(inside.Go(1.1 * sphere * normal), (height - R) * normal);
}

//          O
//        /
//     --x-+      the edge is a cylinder for its centre
//         |
TEST(Ball, RoundsAnEdge)
{
  const double half = 0.02;
  BallScene scene(Box(half, 0.05, half));
  scene.Go({ half + 0.01, 0, half + 0.01 });
  for (int i = 1; i < 90; ++i)
  {
    const double a = i * Pi / 180.0;
    const Vec3 out{ std::cos(a), 0, std::sin(a) };
    const Vec3 edge{ half, 0.001 * i - 0.045, half };
    const Contact& contact = scene.Rest(edge + 0.5 * R * out, 3);
    ExpectAt(contact, edge + R * out, 1e-9 * half);
    ASSERT_EQ(contact.NumberOfConstraints, 1) << i;
    ASSERT_NEAR(contact.Penetration, 0.5 * R, 1e-9 * half);
  }
}

// In the tick in which the HIP is there, however far around that is.
TEST(Ball, ComesAroundAnEdgeOrACornerInOneTick)
{
  const double half = 0.02;
  for (const double share : { 0.2, 0.5, 0.7 })
  {
    BallScene edges(Box(half, 0.05, half));
    BallScene corners(Box(half, half, half));
    const Vec3 edge{ half, 0.003, half };
    const Vec3 corner{ half, half, half };
    edges.Go(2.0 * edge);
    corners.Go(2.0 * corner);
    for (int i = 0; i < 20; ++i)
    {
      const double a = (i % 2 == 0 ? 15.0 + i : 75.0 - i) * Pi / 180.0;
      const Vec3 out{ std::cos(a), 0, std::sin(a) };
      ExpectAt(edges.Go(edge + share * R * out), edge + R * out, 1e-9 * half);
      const Vec3 away = Unit(out + Vec3{ 0.0, 0.7, 0.0 });
      ExpectAt(corners.Go(corner + share * R * away), corner + R * away, 1e-9 * half);
    }
  }
}

TEST(Ball, RoundsACorner)
{
  const double half = 0.02;
  BallScene scene(Box(half, half, half, 3));
  const Vec3 corner{ half, half, half };
  scene.Go(1.5 * corner);
  for (int i = 0; i < 200; ++i)
  {
    const double a = 0.05 + 1.45 * i / 199.0;
    const double b = 0.05 + 0.7 * (1.0 + std::sin(0.1 * i));
    const Vec3 out{ std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b) };
    ExpectAt(scene.Rest(corner + 0.6 * R * out, 4), corner + R * out, 1e-9 * half);
  }
}

//     \  O  /
//      \   /     tangent to both walls
//       \ /
TEST(Ball, TouchesBothWallsOfAGroove)
{
  for (const double degrees : { 170.0, 120.0, 90.0, 60.0, 30.0, 10.0, 2.0 })
  {
    // High enough that the walls reach to where the ball lies.
    const double high = R / std::sin(degrees * Pi / 360.0);
    const double size = std::max(0.05, 2.0 * high);
    BallScene scene(Groove(degrees, size));
    scene.Go({ 0, 0, 1.5 * high });
    const Contact& contact = scene.Go({ 0, 0.001, -0.001 });
    ExpectAt(contact, { 0, 0.001, high }, 1e-9 * size);
    EXPECT_EQ(contact.NumberOfConstraints, 2) << degrees;
  }
}

TEST(Ball, TouchesThreeSidesOfACorner)
{
  BallScene scene(InsideCorner(0.05));
  scene.Go({ 0.02, 0.02, 0.02 });
  const Contact& contact = scene.Go({ -0.001, -0.002, -0.003 });
  ExpectAt(contact, { R, R, R });
  EXPECT_EQ(contact.NumberOfConstraints, 3);
}

//     O --> x-------   a triangle as thin as rounding ends where it ends
TEST(Ball, StopsAtTheTipOfANeedle)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (int i = 0; i < 300; ++i)
  {
    const Vec3 a = 0.05 * Unit(NormalVector(random));
    const Vec3 b = 0.05 * Unit(NormalVector(random));
    TriangleMesh needle;
    needle.Points = { a, b, a + place(random) * (b - a) };
    needle.Triangles = { { 0, 1, 2 } };
    std::string error;
    SurfaceOptions options;
    options.TouchedSide = Side::Both;
    const auto surface = TriangleSurface::Build(needle, options, error);
    if (!surface)
    {
      continue; // the three are on one line
    }
    GodObject god({ surface }, Tip::Ball);
    god.SetTipRadius(R);
    const Vec3 along = Unit(b - a);
    god.Update(b + 0.05 * along);
    EXPECT_EQ(god.Update(b + 0.04 * along).Status, UpdateStatus::Free) << i;
    ExpectAt(god.Update(b - 0.001 * along), b + R * along, 1e-6 * R);
    // From next to it, in any plane through it.
    const Vec3 middle = a + place(random) * (b - a);
    const Vec3 across = Unit(Cross(along, NormalVector(random)));
    god.Place(middle + 0.05 * across);
    god.Update(middle + 0.05 * across);
    ExpectAt(god.Update(middle - 0.001 * across), middle + R * across, 1e-6 * R);
  }
}

//     ---  O  ---
//           x         it sits on the rim
TEST(Ball, StaysOnAHoleThatIsNarrowerThanItself)
{
  const double hole = 0.6 * R;
  for (const Side side : { Side::Front, Side::Both })
  {
    BallScene scene(PlateWithHole(0.05, hole), side);
    scene.Go({ 0.0001, -0.0002, 0.01 });
    const Contact& contact = scene.Rest({ 0, 0, -0.01 }, 10);
    ExpectAt(contact, { 0, 0, std::sqrt(R * R - hole * hole) }, 1e-9 * 0.05);
    EXPECT_GE(contact.NumberOfConstraints, 2);
  }
}

TEST(Ball, FallsThroughAHoleThatIsWider)
{
  BallScene scene(PlateWithHole(0.05, 1.001 * R), Side::Both);
  scene.Go({ 0, 0, 0.01 });
  EXPECT_EQ(scene.Go({ 0, 0, -0.01 }).Status, UpdateStatus::Free);
}

// A crack between facets that share no corner does not exist for it.
TEST(Ball, RollsOverCracks)
{
  BallScene scene(Cracked(Square(0.1, 20), 1e-4), Side::Both);
  scene.Go({ 0.013, 0.017, 0.01 });
  for (int tick = 0; tick < 1000; ++tick)
  {
    const Vec3 hip{ 0.05 * std::cos(0.01 * tick), 0.05 * std::sin(0.013 * tick), -0.01 };
    const Contact& contact = scene.Go(hip);
    const double deepest = R - std::sqrt(R * R - 1e-8); // where it sinks into four corners' gap
    ASSERT_GT(contact.Position[2], R - deepest - Tight);
    ASSERT_LT(contact.Position[2], R + Tight);
  }
}

//    O -->  __x__     back within the plane of a facet that it has left, it goes up to that
//          /     |
TEST(Ball, ComesBackToAFacetWithinItsPlane)
{
  const TriangleMesh mesh = Pyramid(1.0, 0.5);
  const double radius = 0.0144;
  BallScene scene(mesh, Side::Front, radius);
  const auto& surface = scene.God.Surfaces().front().Surface;
  const ExactQueries exact(surface);
  std::mt19937 random(22);
  // Sixteenths: some places are exactly within the plane, others a rounding off it.
  const auto share = [&random](int from, int to)
  { return (from + static_cast<int>(random() % (to - from))) / 16.0; };
  for (int i = 0; i < 400; ++i)
  {
    const auto& [a, b, c] = mesh.Triangles[random() % mesh.Triangles.size()];
    const Vec3 u = mesh.Points[b] - mesh.Points[a];
    const Vec3 v = mesh.Points[c] - mesh.Points[a];
    const double s = share(1, 12);
    const double t = share(1, 16) * (1.0 - s);
    const Vec3 on = mesh.Points[a] + s * u + t * v;
    const double beyond = share(17, 40);
    const double aside = share(-20, 20);
    const Vec3 off = mesh.Points[a] + beyond * u + aside * v;
    const Vec3 over = on + 2.0 * radius * Unit(Cross(u, v));
    scene.God.Place(over);
    for (const Vec3& hip : { over, on, 0.5 * (on + off), off, off + (off - on), off })
    {
      scene.Go(hip);
    }
    const Contact& contact = scene.Go(on);
    ASSERT_EQ(contact.Status, UpdateStatus::Touching);
    ASSERT_LE(exact.Distance(contact.Position - surface->Origin()), radius * (1.0 + 1e-6)) << i;
  }
}

//     ||  x  ||
//     || (O) ||   wider than the tube: it stays at the mouth
TEST(Ball, StaysOutOfATubeThatIsNarrowerThanItself)
{
  TriangleMesh tube;
  constexpr int Around = 24;
  const double inner = 0.8 * R;
  for (int ring = 0; ring < 2; ++ring)
  {
    for (int i = 0; i < Around; ++i)
    {
      const double a = 2.0 * Pi * i / Around;
      tube.Points.push_back({ inner * std::cos(a), inner * std::sin(a), -0.02 * ring });
    }
  }
  for (int i = 0; i < Around; ++i)
  {
    const int j = (i + 1) % Around;
    tube.Triangles.push_back({ i, j, Around + i });
    tube.Triangles.push_back({ j, Around + j, Around + i });
  }
  BallScene scene(tube, Side::Both);
  scene.Go({ 0, 0, 0.01 });
  const Contact& contact = scene.Rest({ 0, 0, -0.01 }, 20);
  // It rests on the edges of the rim, which are nearer to the axis than the corners.
  const double apothem = inner * std::cos(Pi / Around);
  ExpectAt(contact, { 0, 0, std::sqrt(R * R - apothem * apothem) }, 1e-9 * 0.02);

  BallScene thin(tube, Side::Both, 0.5 * R);
  thin.Go({ 0, 0, 0.01 });
  EXPECT_EQ(thin.Go({ 0, 0, -0.01 }).Status, UpdateStatus::Free);
}

//     ----------+ O     around a plate's rim it comes under it
TEST(Ball, GoesAroundAPlatesRim)
{
  for (const Side side : { Side::Front, Side::Both })
  {
    const double thick = 1e-4;
    BallScene scene(Box(0.02, 0.02, thick), side);
    scene.Go({ 0.01, 0, 0.01 });
    for (int i = 0; i <= 400; ++i)
    {
      const double a = Pi * i / 400.0 + 0.5 * Pi;
      const Vec3 out{ -std::cos(a), 0, std::sin(a) };
      scene.Go(Vec3{ 0.02, 0.003, 0 } + 0.7 * R * out);
    }
    // Under it, it stays there.
    const Contact& contact = scene.Go({ 0.01, 0.003, 0.005 });
    ExpectAt(contact, { 0.01, 0.003, -thick - R });
  }
}

// A plate without thickness, from both sides.
TEST(Ball, CrossesNoSheet)
{
  BallScene scene(Square(0.02, 3), Side::Both);
  scene.Go({ 0.001, 0.002, -0.01 });
  ExpectAt(scene.Go({ 0.001, 0.002, 0.03 }), { 0.001, 0.002, -R });
  ExpectAt(scene.Go({ 0.001, 0.002, -0.5 * R }), { 0.001, 0.002, -R });
}

TEST(Ball, IsTheSameAtEveryScale)
{
  for (const double scale : { 1e-9, 1e-3, 1.0, 1e3, 1e9 })
  {
    BallScene scene(Scaled(Box(0.02, 0.02, 0.02, 2), scale), Side::Front, R * scale);
    scene.Go(scale * Vec3{ 0.03, 0.01, 0.03 });
    const Vec3 edge{ 0.02, 0.01, 0.02 };
    const Vec3 out = Unit({ 1, 0, 2 });
    const Contact& contact = scene.Rest(scale * (edge + 0.5 * R * out), 3);
    ExpectAt(contact, scale * (edge + R * out), scale * 1e-9 * 0.02);
  }
}

// As the premise of K <= 2b/T.
TEST(Ball, NeverMovesAwayFromTheHip)
{
  BallScene scene(Star(4, 0.05, 0.1, 5));
  scene.Go({ 0, 0, 0.08 });
  Vec3 before = scene.God.Current().Position;
  for (int tick = 0; tick < 5000; ++tick)
  {
    const double a = 0.003 * tick;
    const double depth = 0.05 + 0.01 * std::sin(0.05 * tick);
    const Vec3 hip = depth * Unit({ std::sin(a), std::cos(0.7 * a), std::cos(a) });
    const double distance = Length(before - hip);
    const Contact& contact = scene.Go(hip);
    ASSERT_LE(Length(contact.Position - hip), distance * (1.0 + 1e-9)) << tick;
    before = contact.Position;
  }
}

//      (O)      put where it overlaps, it grows and is pushed out, slowly and the nearest way
//     ----
TEST(Ball, ThatStartsInOverlapIsPushedOutSlowly)
{
  BallScene scene(Square(0.1), Side::Both);
  double before = scene.Go({ 0, 0, 0.4 * R }).Position[2];
  EXPECT_NEAR(before, (0.4 + 1.0 / 128.0) * R, Tight);
  for (int tick = 0; tick < 100; ++tick)
  {
    const Contact& contact = scene.Go({ 0, 0, 0.1 * R });
    ASSERT_NEAR(contact.Position[2], std::min(R, before + R / 128.0), Tight);
    ASSERT_NEAR(scene.God.BallRadius(), contact.Position[2], Tight);
    ASSERT_NEAR(contact.SurfaceDisplacement[2], contact.Position[2] - before, Tight);
    before = contact.Position[2];
  }
  EXPECT_NEAR(before, R, Tight);
  EXPECT_EQ(scene.God.BallRadius(), R);
}

TEST(Ball, ThatStartsInOverlapIsFreeToLeaveAndComesNoDeeper)
{
  BallScene scene(Square(0.1), Side::Both);
  scene.Go({ 0, 0, 0.4 * R });
  EXPECT_GE(scene.Go({ 0.001, 0, 0.1 * R }).Position[2], 0.4 * R);
  EXPECT_EQ(scene.Go({ 0.001, 0, 0.7 * R }).Status, UpdateStatus::Free);
  EXPECT_GE(scene.Go({ 0.001, 0, 0.1 * R }).Position[2], 0.7 * R);
  scene.Go({ 0.001, 0, 2.0 * R });
  ExpectAt(scene.Go({ 0.001, 0, 0.1 * R }), { 0.001, 0, R });
  EXPECT_EQ(scene.God.BallRadius(), R);
}

// As near to an edge as rounding, which has no direction there but across the edge.
TEST(Ball, GrowsAlsoFromAnEdge)
{
  for (const double off : { 1e-8, 1e-11, 1e-14 })
  {
    BallScene scene(Box(0.02, 0.05, 0.02));
    const Vec3 edge{ 0.02, 0.0137, 0.02 };
    const Vec3 out = Unit({ 1.0, 0.0, 0.6 });
    scene.Go(edge + off * out);
    ExpectAt(scene.Rest(edge + 0.5 * R * out, 140), edge + R * out, 1e-9 * 0.02);
  }
}

// What has only a front is left through it; behind it nothing is.
TEST(Ball, LeavesASolidThroughItsFront)
{
  BallScene scene(Box(0.02, 0.02, 0.02));
  scene.Go({ 0, 0, 0 });
  EXPECT_EQ(scene.Go({ 0.001, 0.002, 0.019 }).Status, UpdateStatus::Free);
  const Contact& contact = scene.Go({ 0.001, 0.002, 0.0205 });
  EXPECT_GE(contact.Position[2], 0.0205);
  EXPECT_GE(scene.Go({ 0.001, 0.002, 0.019 }).Position[2], 0.0205);
  ExpectAt(scene.Rest({ 0.001, 0.002, 0.019 }, 130), { 0.001, 0.002, 0.02 + R });
}

//     +------
//     | (O) x      an edge that is a groove from outside is none from inside
//     |   +--
TEST(Ball, IsHeldByNoEdgeOfWhatItIsIn)
{
  BallScene scene(GroovedBlock(60.0, 0.02));
  // Under the crease, which is at the origin, from one side to the other.
  scene.Go({ -0.01, 0.003, -0.5 * R });
  for (int tick = 0; tick <= 100; ++tick)
  {
    const Vec3 hip{ -0.01 + 2e-4 * tick, 0.003, -0.5 * R };
    ASSERT_EQ(scene.Go(hip).Status, UpdateStatus::Free) << tick;
  }
}

TEST(Ball, MayGrowAndShrinkInContact)
{
  BallScene scene(Square(0.1), Side::Front, 0.0);
  scene.Go({ 0, 0, 0.01 });
  ExpectAt(scene.Go({ 0, 0, -0.01 }), { 0, 0, 0 });
  scene.God.SetTipRadius(R);
  // It does not jump.
  ExpectAt(scene.Go({ 0, 0, -0.01 }), { 0, 0, R / 128.0 });
  ExpectAt(scene.Rest({ 0, 0, -0.01 }, 130), { 0, 0, R });
  scene.God.SetTipRadius(0.5 * R);
  ExpectAt(scene.Go({ 0, 0, -0.01 }), { 0, 0, 0.5 * R });
  scene.God.SetTipRadius(0.0);
  ExpectAt(scene.Go({ 0, 0, -0.01 }), { 0, 0, 0 });
}

// Bit for bit: one that may be a ball and is none.
TEST(Ball, OfNoRadiusIsThePoint)
{
  const auto surface = MakeSurface(Star(4, 0.05, 0.1, 5));
  GodObject point({ surface });
  GodObject ball({ surface }, Tip::Ball);
  for (const double radius : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-18,
         std::numeric_limits<double>::infinity() })
  {
    ball.SetTipRadius(radius);
    EXPECT_EQ(ball.TipRadius(), 0.0);
    for (int tick = 0; tick < 500; ++tick)
    {
      const double a = 0.003 * tick;
      const Vec3 hip = (0.05 + 0.01 * std::sin(0.05 * tick)) *
        Unit({ std::sin(a), std::cos(0.7 * a), std::cos(a) });
      ASSERT_EQ(point.Update(hip).Position, ball.Update(hip).Position);
    }
  }
}

// From anywhere, to anywhere.
TEST(Ball, GoesAnyWayInOneTick)
{
  BallScene scene(Icosphere(3, 0.05));
  scene.Go({ 1e6, 0, 0 });
  EXPECT_EQ(scene.Go({ -1e6, 1.0, 0 }).Status, UpdateStatus::Free);
  scene.Go({ 0, 0, 1e3 });
  const Contact& contact = scene.Rest({ 0, 0, 0.01 }, 3);
  EXPECT_EQ(contact.Status, UpdateStatus::Touching);
  EXPECT_NEAR(Length(contact.Position), 0.05 + R, 0.001);
  EXPECT_EQ(scene.Go({ 1e60, 0, 1e60 }).Status, UpdateStatus::Free);
  // From so far out that its own size is rounding.
  const Vec3 far{ -1e51, 3e50, -2e50 };
  scene.Go(far);
  EXPECT_EQ(scene.Go({ 0, 0, 0 }).Status, UpdateStatus::Touching);
  EXPECT_NEAR(Length(scene.Rest({ 0, 0, 0 }, 3).Position), 0.05 + R, 0.001);
}

// Of more triangles than one gathering holds, and from where none is near.
TEST(Ball, ComesFromAnyDistanceToManyTriangles)
{
  const auto surface = MakeSurface(Icosphere(6, 0.05));
  for (const double radius : { R, 0.06 })
  {
    for (double from = 0.055 + radius; from < 0.25; from += 0.0025)
    {
      GodObject god({ surface }, Tip::Ball);
      god.SetTipRadius(radius);
      god.Place({ 0, 0, from });
      god.Update({ 0, 0, 0.045 });
      const Contact& contact = god.Update({ 0, 0, 0.045 });
      ASSERT_EQ(contact.Status, UpdateStatus::Touching) << radius << " from " << from;
      ASSERT_NEAR(contact.Position[2], 0.05 + radius, 1e-6);
    }
  }
}

// Larger than all that it touches: as good as a plane.
TEST(Ball, MayBeLargerThanTheSurface)
{
  for (const double radius : { 1.0, 1e4, 1e30 })
  {
    BallScene scene(Icosphere(2, 0.05), Side::Both, radius);
    const double size = scene.God.TipRadius();
    EXPECT_LE(size, radius);
    scene.Go({ 0, 0, 3.0 * size });
    EXPECT_NEAR(scene.Rest({ 0, 0, 0 }, 20).Position[2], 0.05 + size, 1e-9 * size);
  }
}

namespace
{
struct SoakScene
{
  const char* Name;
  TriangleMesh Mesh;
  Side TouchedSide;
  bool IsClosed;
  double Reach;
  double Radius;
};

/// Every way of a HIP, with each piece of the centre's way looked at by exact arithmetic. Adds up
/// the ticks in contact.
void ExpectNoOverlap(const SoakScene& scene, HipPath::Kind kind, int ticks, int& touching)
{
  const auto surface = MakeSurface(scene.Mesh, scene.TouchedSide);
  const ExactQueries exact(surface);
  const Judge judge(*surface);
  GodObject god({ surface }, Tip::Ball);
  god.SetTipRadius(scene.Radius);
  HipPath path(kind, scene.Reach, 3);
  god.Update(path.Next());
  for (int tick = 0; tick < ticks; ++tick)
  {
    const Vec3 from = god.LocalPosition(0);
    const double radius = god.BallRadius();
    const Vec3 hip = path.Next();
    const Contact& contact = god.Update(hip);
    ASSERT_NE(contact.Status, UpdateStatus::Overloaded);
    touching += contact.IsTouching() ? 1 : 0;
    int corners = 0;
    const Vec3* const way = god.Way(corners);
    Vec3 last = from;
    for (int i = 1; i < corners; ++i)
    {
      const Vec3 next = way[i] + (god.WayOrigin() - surface->Origin());
      ASSERT_FALSE(judge.Crosses(last, next)) << scene.Name << " " << tick;
      for (const double t : { 0.5, 1.0 })
      {
        const Vec3 x = last + t * (next - last);
        const bool isClear = exact.Distance(x) >= std::min(radius, god.BallRadius()) * (1.0 - 1e-6);
        ASSERT_TRUE(isClear || (scene.IsClosed && exact.IsInside(x)))
          << scene.Name << " " << HipPath::NameOf(kind) << " " << tick;
      }
      last = next;
    }
  }
}
}

class BallOverlaps : public ::testing::TestWithParam<HipPath::Kind>
{
};

TEST_P(BallOverlaps, Nothing)
{
  const SoakScene scenes[] = {
    { "sphere", Icosphere(2, 0.05), Side::Front, true, 0.05, 0.003 },
    { "star", Star(2, 0.05, 0.4, 7), Side::Front, true, 0.05, 0.004 },
    { "torus", Torus(0.04, 0.015, 16, 8), Side::Front, true, 0.05, 0.002 },
    { "plate", Box(0.05, 0.05, 1e-4, 4), Side::Front, true, 0.05, 0.003 },
    { "groove", GroovedBlock(40.0, 0.02), Side::Front, true, 0.04, 0.003 },
    { "sheet", Square(0.05, 8), Side::Both, false, 0.05, 0.001 },
    { "soup", Scaled(Soup(200, 0.4, 3), 0.05), Side::Both, false, 0.05, 0.002 },
    { "cracked", Cracked(Icosphere(2, 0.05), 1e-5), Side::Both, false, 0.05, 0.003 },
  };
  constexpr int Ticks = 300;
  int touching = 0;
  for (const SoakScene& scene : scenes)
  {
    ExpectNoOverlap(scene, this->GetParam(), Ticks, touching);
  }
  EXPECT_GT(touching, Ticks / 4);
}

INSTANTIATE_TEST_SUITE_P(Ways, BallOverlaps,
  ::testing::Values(HipPath::Smooth, HipPath::Jitter, HipPath::Jump, HipPath::Plunge),
  [](const auto& tested) { return HipPath::IdentifierOf(tested.param); });
