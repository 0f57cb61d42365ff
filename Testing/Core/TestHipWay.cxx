// GodObject::SetSubstepLimit: the HIP's way within a tick.
#include "AnalyticSurfaces.h"
#include "MaterialTools.h"
#include "SurfacePath.h"
#include "Trial.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// A rough ball as large as in the hand, and the hand that strokes it.
constexpr double Radius = 0.05; // [m]
std::shared_ptr<const TriangleSurface> RoughBall()
{
  return MakeSurface(Star(6, Radius, 0.03, 4));
}

/// `step` a tick [m], along a curve that never closes.
std::vector<Vec3> StrokeAround(double step, int ticks, double depth)
{
  std::vector<Vec3> hips;
  for (int i = 0; i < ticks; ++i)
  {
    const double s = step / Radius * i;
    const Vec3 outwards{ std::cos(s), std::sin(s) * std::cos(0.13 * s),
      std::sin(s) * std::sin(0.13 * s) };
    hips.push_back((Radius - depth) * outwards);
  }
  return hips;
}

/// Of a god-object that comes from outside and then gets every HIP in so many steps.
std::vector<Vec3> Trace(const std::shared_ptr<const TriangleSurface>& surface,
  const std::vector<Vec3>& hips, int pieces, int steps = 1)
{
  GodObject god({ surface });
  god.SetSubstepLimit(pieces);
  god.Update(1.2 * hips[0]);
  god.Update(hips[0]);
  std::vector<Vec3> trace{ god.Current().Position };
  for (std::size_t i = 1; i < hips.size(); ++i)
  {
    for (int k = 1; k <= steps; ++k)
    {
      const double s = static_cast<double>(k) / steps;
      god.Update(k == steps ? hips[i] : hips[i - 1] + s * (hips[i] - hips[i - 1]));
    }
    trace.push_back(god.Current().Position);
  }
  return trace;
}

double ShareApart(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double distance)
{
  int apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    apart += Length(a[i] - b[i]) > distance ? 1 : 0;
  }
  return static_cast<double>(apart) / static_cast<double>(a.size());
}
}

TEST(HipWay, OnRoughGroundComesNearerToASlowHandThePiecesItMayHave)
{
  const auto surface = RoughBall();
  const std::vector<Vec3> hips = StrokeAround(2e-4, 4000, 5e-3); // 0.2 m/s
  const std::vector<Vec3> slow = Trace(surface, hips, 1, 256);
  const double one = ShareApart(Trace(surface, hips, 1), slow, 1e-3);
  const double sixteen = ShareApart(Trace(surface, hips, 16), slow, 1e-3);
  EXPECT_GT(one, 0.01);
  EXPECT_LT(sixteen, 0.5 * one);
}

TEST(HipWay, OfOneHandHangsLessOnTheSamplingRate)
{
  const auto surface = RoughBall();
  const std::vector<Vec3> fine = StrokeAround(5e-5, 16000, 5e-3); // 0.2 m/s at 4 kHz
  std::vector<Vec3> coarse;
  for (std::size_t i = 0; i < fine.size(); i += 8)
  {
    coarse.push_back(fine[i]); // 500 Hz
  }
  const auto apart = [&](int pieces)
  {
    const std::vector<Vec3> often = Trace(surface, fine, pieces);
    std::vector<Vec3> there;
    for (std::size_t i = 0; i < often.size(); i += 8)
    {
      there.push_back(often[i]);
    }
    return ShareApart(Trace(surface, coarse, pieces), there, 1e-3);
  };
  const double one = apart(1);
  EXPECT_GT(one, 0.01);
  EXPECT_LT(apart(16), 0.6 * one);
}

TEST(HipWay, IsOnePieceOnSmoothGroundInFreeSpaceAndAtRest)
{
  const auto sphere = MakeSurface(Icosphere(5, Radius));
  const std::vector<Vec3> hips = StrokeAround(2e-4, 2000, 1e-3);
  EXPECT_EQ(Trace(sphere, hips, 1), Trace(sphere, hips, 16)); // to the last bit

  GodObject god({ RoughBall() });
  god.SetSubstepLimit(16);
  int corners = 0;
  for (int i = 0; i < 100; ++i)
  {
    god.Update({ 0.08, 1e-3 * i, 0.0 });
    god.Way(corners);
    EXPECT_LE(corners, 2);
  }
  for (int i = 0; i < 20; ++i)
  {
    god.Update({ 0.045, 1e-3, 2e-3 });
  }
  const Vec3 rest = god.Current().Position;
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 now = god.Update({ 0.045, 1e-3, 2e-3 }).Position;
    EXPECT_LT(Length(now - rest), 1e-17); // the last bits, as in one step: two planes hold it
    god.Way(corners);
    EXPECT_LE(corners, 3);
  }
}

// The premise of K <= 2b/T is of the whole tick, whatever its pieces do; with friction too.
TEST(HipWay, NeverTakesTheGodObjectFartherFromTheHip)
{
  for (const double friction : { 0.0, 0.3 })
  {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const auto surface = RoughBall();
    GodObject god({ friction > 0.0 ? Touchable(surface, Rough(friction, 0.8 * friction))
                                   : TouchedSurface{ surface } });
    god.SetSubstepLimit(16);
    Vec3 hip{ 1.2 * Radius, 0.0, 0.0 };
    Vec3 before = god.Update(hip).Position;
    for (int tick = 0; tick < 20000; ++tick)
    {
      const Vec3 push{ normal(random), normal(random), normal(random) };
      hip = hip + 1e-3 * push;
      hip = (Radius * (0.93 + 0.05 * std::sin(0.05 * tick)) / Length(hip)) * hip;
      const Vec3 now = god.Update(hip).Position;
      ASSERT_LE(Length(now - hip), Length(before - hip) * (1.0 + 1e-9)) << tick;
      before = now;
    }
  }
}

TEST(HipWay, CrossesNothingWhateverItsPieces)
{
  for (const unsigned seed : { 1u, 2u, 3u })
  {
    const TriangleMesh mesh = Star(4, 1.0, 0.3, seed);
    const std::vector<TouchedSurface> surfaces{ { MakeSurface(mesh) } };
    GodObjectFollower god(surfaces, GodObject::LargestNumberOfSubsteps);
    GodObjectFollower probe(surfaces, GodObject::LargestNumberOfSubsteps);
    Trial::Settings settings = Trial::SettingsOf(surfaces);
    settings.PressEvery = 0;
    Trial trial(Trial::PartsOf(surfaces), god, probe, settings);
    SurfacePath path(mesh.Points, mesh.Triangles);
    for (int i = 0; i < 3 * SurfacePath::NumberOfKinds; ++i)
    {
      const auto kind = static_cast<SurfacePath::Kind>(i % SurfacePath::NumberOfKinds);
      const std::vector<Vec3> hips = path.Make(kind, seed + static_cast<unsigned>(i));
      if (trial.Place(hips[0]))
      {
        for (std::size_t k = 1; k < hips.size(); ++k)
        {
          trial.Tick(hips[k]);
        }
      }
    }
    EXPECT_GT(trial.Count().Contacts, 1000);
    for (const Fault fault : { Fault::Crossing, Fault::Graze, Fault::Gap, Fault::Away })
    {
      EXPECT_EQ(trial.Count()[fault], 0) << NameOf(fault) << ", seed " << seed;
    }
  }
}

//    _____|  |_____     each hand comes from the left, over a slot that it crosses within a tick,
//    and
//      x ------> x      one that stops in it
TEST(HipWay, FallsIntoASlotThatTheHandStopsInAndIntoNoneThatItCrosses)
{
  const auto plate = [](double left, double right)
  {
    const double half = 0.5 * (right - left);
    return Moved(Box(half, 0.5, 0.1), { left + half, 0.0, -0.1 });
  };
  for (const double width : { 1e-9, 1e-6, 1e-3 })
  {
    const auto surface = MakeSurface(Joined(plate(-0.5, -0.5 * width), plate(0.5 * width, 0.5)));
    for (const double end : { 0.01, 0.0 })
    {
      GodObject god({ surface });
      god.SetSubstepLimit(16);
      god.Place({ -0.01, 0.003, 0.02 });
      god.Update({ -0.01, 0.003, -0.05 });
      const Contact& contact = god.Update({ end, 0.003, -0.05 });
      EXPECT_NEAR(contact.Displacement[0], 0.0, 1e-12) << width;
      EXPECT_NEAR(contact.Displacement[2], end > 0.0 ? 0.05 : 0.0, 1e-9) << width;
    }
  }
}

TEST(HipWay, LimitIsClamped)
{
  const auto surface = RoughBall();
  const std::vector<Vec3> hips = StrokeAround(5e-4, 200, 2e-3);
  EXPECT_EQ(Trace(surface, hips, -5), Trace(surface, hips, 1));
  EXPECT_EQ(Trace(surface, hips, 1000), Trace(surface, hips, GodObject::LargestNumberOfSubsteps));
}
