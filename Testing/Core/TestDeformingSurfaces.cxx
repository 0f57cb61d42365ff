// A god-object on surfaces whose points move. Lengths are metres, a tick is a millisecond.
#include "AnalyticSurfaces.h"
#include "GodObject.h"
#include "SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Tick = 0.001;
/// The god-object keeps 1024 roundings off the surface: at these sizes under this.
constexpr double Tight = 1e-12;

using SurfacePointer = std::shared_ptr<const TriangleSurface>;

/// The points of a snapshot in the world, each put elsewhere by `map`.
template <class Map>
std::vector<Vec3> Mapped(const std::vector<Vec3>& points, const Map& map)
{
  std::vector<Vec3> mapped;
  for (const Vec3& p : points)
  {
    mapped.push_back(map(p));
  }
  return mapped;
}

/// A deforming surface in a servo's hands: a new god-object for each snapshot, as a scene does it.
class Playing
{
public:
  explicit Playing(TriangleMesh mesh, Side side = Side::Front)
    : Points(mesh.Points)
    , Deformer(MakeSurface(std::move(mesh), side))
    , God(std::make_unique<GodObject>(std::vector<TouchedSurface>{ Deformer.Latest() }))
  {
  }

  /// Sends the points on to their rest places moved by `map`, over `ticks`.
  template <class Map>
  void Deform(const Map& map, int ticks)
  {
    std::string error;
    const SurfacePointer next =
      this->Deformer.Deform(Mapped(this->Points, map), ticks * Tick, error);
    ASSERT_TRUE(next) << error;
    auto god = std::make_unique<GodObject>(std::vector<TouchedSurface>{ next });
    god->Continue(*this->God);
    this->God = std::move(god);
  }
  const Contact& Next(const Vec3& hip)
  {
    this->God->Advance(Tick);
    return this->God->Update(hip);
  }

  std::vector<Vec3> Points; ///< at rest
  SurfaceDeformer Deformer;
  std::unique_ptr<GodObject> God;
};
}

//   o            S8 for points that move: a plane that rises evenly, updated at 30 Hz
//  ____  ^
//   x    |
TEST(DeformingSurfaces, PushARestingHipWithoutSteps)
{
  constexpr double stiffness = 700.0;
  constexpr double speed = 0.03;
  Playing plane(Square(0.1, 8));
  const Vec3 hip{ 0.013, 0.007, -0.001 };
  plane.God->Update({ hip[0], hip[1], 0.001 });
  double before = stiffness * plane.God->Update(hip).Penetration;
  double largestStep = 0.0;
  for (int tick = 0; tick < 1000; ++tick)
  {
    if (tick % 33 == 0)
    {
      ASSERT_TRUE(plane.God->HasArrived());
      plane.Deform(
        [tick](const Vec3& p) {
          return p + Vec3{ 0, 0, speed * (tick + 33) * Tick };
        },
        33);
    }
    const Contact& contact = plane.Next(hip);
    const double force = stiffness * contact.Penetration;
    largestStep = std::max(largestStep, std::abs(force - before));
    before = force;
    ASSERT_EQ(contact.NumberOfConstraints, 1) << tick;
    ASSERT_NEAR(contact.Position[2], speed * Tick * (tick + 1), Tight) << "tick " << tick;
    ASSERT_NEAR(contact.Carried[2], speed * Tick, Tight);
  }
  EXPECT_LE(largestStep, 0.05);
  EXPECT_NEAR(largestStep, stiffness * speed * Tick, 1e-6); // and no less: it does move
}

TEST(DeformingSurfaces, NothingPassesAtAnySpeed)
{
  for (const double step : { 1e-9, 1e-6, 5e-5, 3e-4, 1e-3, 5e-3, 0.1 })
  {
    for (const bool touching : { false, true })
    {
      Playing plane(Square(3.0, 4), Side::Both);
      const double height = touching ? -1e-4 : 10.3 * step;
      plane.God->Update({ 0.05, 0.025, 0.001 + 11 * step });
      plane.God->Update({ 0.05, 0.025, height });
      plane.Deform([step](const Vec3& p) { return p + (50 * step) * Vec3{ 0.3, 0, 1 }; }, 50);
      for (int tick = 1; tick <= 50; ++tick)
      {
        const Contact& contact = plane.Next({ 0.05, 0.025, height });
        ASSERT_NEAR(contact.Position[2], std::max(tick * step, height), 1e-10)
          << step << " m a tick, tick " << tick;
      }
    }
  }
}
