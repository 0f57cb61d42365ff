// An update in the servo thread may not allocate: this program counts every malloc.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"
#include "haptics/Math/Predicates.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
thread_local bool IsCounting = false;
thread_local long Allocations = 0;
}

extern "C" void* __libc_malloc(std::size_t size);

// Replaces the C library's for the whole program, operator new included.
extern "C" void* malloc(std::size_t size)
{
  Allocations += IsCounting;
  return __libc_malloc(size);
}

TEST(ServoSafety, TheCounterCounts)
{
  IsCounting = true;
  Allocations = 0;
  // Volatile, as a compiler may leave out what is allocated and freed unseen: GCC 16 does.
  void* volatile memory = std::malloc(1 << 20);
  std::free(memory);
  std::vector<int>* volatile numbers = new std::vector<int>(1000);
  delete numbers;
  IsCounting = false;
  EXPECT_GE(Allocations, 2);
}

TEST(ServoSafety, NoUpdateAllocates)
{
  const std::vector<TouchedSurface> surfaces = { MakeSurface(Star(4, 1.0, 0.4, 3)),
    MakeSurface(Box(1, 1, 1, 8)), MakeSurface(Soup(500, 0.4, 2), Side::Both),
    MakeSurface(Square(1.0, 4), Side::Both), MakeSurface(Icosphere(6, 1.0)),
    MakeSurface(Square(1.0), Side::Both, EngineKind::BruteForce) };
  for (std::size_t i = 0; i < 2 * surfaces.size(); ++i)
  {
    GodObject god({ surfaces[i / 2] }, Tip::Ball);
    god.SetTipRadius(i % 2 == 0 ? 0.0 : 0.03);
    god.Update({ 2, 2, 2 });
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    Vec3 hip{};
    long total = 0;
    for (int tick = 0; tick < 20000; ++tick)
    {
      // Slides, exactly along mesh lines at times, with jumps: exact arithmetic is needed in some.
      if (tick % 100 == 0)
      {
        hip = { normal(random), normal(random), normal(random) };
      }
      const double step = 0.01 * normal(random);
      hip[tick % 3] += tick % 500 < 250 ? step : std::round(step * 256.0) / 256.0;
      if (tick % 500 == 250)
      {
        hip = { 0.25, 0.5, 0.75 };
      }
      IsCounting = true;
      Allocations = 0;
      god.Update(hip);
      IsCounting = false;
      total += Allocations;
    }
    EXPECT_EQ(total, 0);
  }
}

TEST(ServoSafety, NoPropertyAllocates)
{
  const auto surface = MakeSurface(Icosphere(3, 0.05));
  PropertyValues values = Everywhere(400.0, 1.0, 0.5, 0.3, 0.2);
  values[Property::Stiffness] =
    AtPoints(*surface, [](const Vec3& p) { return 400.0 + 4000.0 * p[0]; });
  values.Shading = true;
  MaterialHand hand(Touchable(surface, values), { 0.06, 0, 0 });
  IsCounting = true;
  Allocations = 0;
  for (int tick = 0; tick < 5000; ++tick)
  {
    const double a = 2e-3 * tick;
    hand.Move({ 0.048 * std::cos(a), 0.048 * std::sin(a), 0.01 * std::sin(0.3 * a) });
  }
  IsCounting = false;
  EXPECT_EQ(Allocations, 0);
  EXPECT_NE(hand.Last, Vec3{});
}

TEST(ServoSafety, SharingAContactAllocatesNothing)
{
  const auto surface = MakeSurface(Icosphere(3, 0.05));
  GodObject god({ Touchable(surface, Everywhere(400.0, 1.0, 0.5, 0.3, 0.2)), { surface },
    Touchable(MakeSurface(Icosphere(4, 0.05)), Rough(0.3, 0.2)) });
  god.Update({ 0.06, 0, 0 });
  IsCounting = true;
  Allocations = 0;
  int shared = 0;
  for (int tick = 0; tick < 5000; ++tick)
  {
    const double a = 2e-3 * tick;
    const Contact& contact =
      god.Update({ 0.048 * std::cos(a), 0.048 * std::sin(a), 0.01 * std::sin(0.3 * a) });
    shared += contact.Material.PlainShare > 0.0 && contact.Material.PlainShare < 1.0;
  }
  IsCounting = false;
  EXPECT_EQ(Allocations, 0);
  EXPECT_GT(shared, 0);
}

TEST(ServoSafety, NothingThatMovesAllocates)
{
  const auto ball = MakeSurface(Icosphere(4, 0.05));
  const auto motion = std::make_shared<SurfaceMotion>(RigidPose{});
  SurfaceDeformer deformer(ball);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto list = [&](const std::shared_ptr<const TriangleSurface>& surface)
  {
    std::vector<TouchedSurface> surfaces = { surface,
      { MakeSurface(Star(3, 0.04, 0.4, 3)), motion } };
    surfaces.front().Identity = 1;
    return surfaces;
  };
  auto god = std::make_unique<GodObject>(list(ball));
  god->Update({ 0.1, 0, 0 });
  long total = 0;
  int touching = 0;
  for (int tick = 0; tick < 1500; ++tick)
  {
    std::unique_ptr<GodObject> next;
    if (tick % 20 == 0 && god->HasArrived())
    {
      // Points move; now and then the surface changes all at once.
      const double size = 1.0 + 0.05 * normal(random);
      std::vector<Vec3> points;
      for (const Vec3& p : ball->Points())
      {
        points.push_back(size * p);
      }
      std::string error;
      const auto deformed = deformer.Deform(points, 0.015, error);
      ASSERT_TRUE(deformed) << error;
      next = std::make_unique<GodObject>(
        list(tick % 200 == 100 ? MakeSurface(Icosphere(3, 0.05 * size)) : deformed));
      motion->MoveTo({ { 0.05 + 0.01 * normal(random), 0.01 * normal(random), 0 } }, 0.01);
    }
    const double a = 2e-3 * tick;
    const Vec3 hip{ 0.046 * std::cos(a), 0.046 * std::sin(a), 0.01 * std::sin(0.3 * a) };
    IsCounting = true;
    Allocations = 0;
    if (next)
    {
      next->Continue(*god);
      next.swap(god);
    }
    god->Advance(0.001);
    touching += god->Update(hip).Status == UpdateStatus::Touching;
    IsCounting = false;
    total += Allocations;
  }
  EXPECT_EQ(total, 0);
  EXPECT_GT(touching, 1000);
}

/// Numbers from 1 down to 2^-spread, and as many of either sign.
class Numbers
{
public:
  explicit Numbers(int spread)
    : Exponent(-spread, 0)
  {
  }
  double operator()()
  {
    return std::ldexp(this->Mantissa(this->Random), this->Exponent(this->Random));
  }

private:
  std::mt19937 Random{ 9 };
  std::uniform_real_distribution<double> Mantissa{ -1.0, 1.0 };
  std::uniform_int_distribution<int> Exponent;
};

TEST(ServoSafety, NoPredicateAllocatesOverTheSizesThatASurfaceKeeps)
{
  const int least = std::ilogb(NegligibleShare);
  Numbers number(-least);
  long total = 0;
  for (int k = 0; k < 100000; ++k)
  {
    // In one plane, so that nothing but exact arithmetic decides.
    const Vector a{ number(), number(), number() };
    const Vector d{ number(), number(), number() };
    IsCounting = true;
    Allocations = 0;
    const int side = Orientation(a, 2.0 * a, -4.0 * a, d);
    IsCounting = false;
    total += Allocations;
    ASSERT_EQ(side, 0);
  }
  EXPECT_EQ(total, 0);
}

TEST(ServoSafety, ASurfaceKeepsNoNumbersThatAreAllButZero)
{
  // A table as rotations leave it: what should be 0 is noise of any size.
  TriangleMesh table = Square(1.0, 8);
  Numbers noise(1000);
  for (Vec3& p : table.Points)
  {
    p = { p[0] + noise(), p[1] + noise(), noise() };
  }
  const auto surface = MakeSurface(table, Side::Both);
  GodObject god({ surface });
  long zeros = 0;
  const auto check = [&](const Vec3& p)
  {
    for (const double x : p)
    {
      zeros += x == 0.0;
      EXPECT_TRUE(x == 0.0 || std::abs(x) >= NegligibleShare * surface->Radius()) << x;
    }
  };
  std::for_each(surface->Points().begin(), surface->Points().end(), check);
  for (int i = 0; i < 1000; ++i)
  {
    god.Place({ noise(), noise(), noise() });
    check(god.LocalPosition(0));
  }
  EXPECT_GT(zeros, 1000);
}
