// A hand's own noise must not make a resting contact buzz.
#include "AnalyticSurfaces.h"
#include "HandNoise.h"
#include "RandomVectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Size = 0.05;   // of what is touched [m]
constexpr double Depth = 0.002; // of the hand in it [m]
constexpr double Radii[] = { 0.0, 0.0005, 0.001, 0.003 };

/// Where a hand rests, as it comes along `Outwards` to `Point` and goes on by the depth. A ball
/// is held back by its radius more.
struct Place
{
  const char* Name;
  std::shared_ptr<const TriangleSurface> Surface;
  Vec3 Point{};
  Vec3 Outwards{};

  RestingForce ForceAt(double radius, unsigned seed, const HandNoise& noise = RestingHand) const
  {
    const Vec3 from = this->Point + (0.01 + radius) * this->Outwards;
    return Rest(
      this->Surface, from, this->Point + (radius - Depth) * this->Outwards, radius, noise, seed);
  }
};

std::vector<Place> SharpPlaces()
{
  const auto box = MakeSurface(Box(Size, Size, Size, 8));
  const auto groove = MakeSurface(Groove(90.0, Size));
  const auto ridge = MakeSurface(InsideOut(Groove(90.0, Size)), Side::Front);
  const auto inside = MakeSurface(InsideCorner(Size));
  return { { "face", box, { Size, 0.0013, 0.0021 }, { 1, 0, 0 } },
    { "edge", box, { Size, Size, 0.0021 }, Unit({ 1, 1, 0 }) },
    { "edge, from the side", box, { Size, Size, 0.0021 }, Unit({ 3, 1, 0 }) },
    { "corner", box, { Size, Size, Size }, Unit({ 1, 1, 1 }) },
    { "edge within a face", box, { Size, Size / 4, 0.0021 }, { 1, 0, 0 } },
    { "vertex within a face", box, { Size, Size / 4, Size / 4 }, { 1, 0, 0 } },
    { "groove", groove, { 0.0, 0.0013, 0.0 }, { 0, 0, 1 } },
    { "ridge", ridge, { 0.0, 0.0013, 0.0 }, { 0, 0, -1 } },
    { "inner corner", inside, { 0.0, 0.0, 0.0 }, Unit({ 1, 1, 1 }) } };
}
}

TEST(HandNoise, IsThatOfAHandAndItsEncoders)
{
  const std::vector<Vec3> hips = HoldStill({ 0.01, 0.02, 0.03 }, RestingHand, 4000, 1);
  int moves = 0;
  for (std::size_t i = 0; i < hips.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double steps = hips[i][k] / RestingHand.Encoder;
      ASSERT_NEAR(steps, std::round(steps), 1e-9);
      ASSERT_LT(std::abs(hips[i][k] - 0.01 * (k + 1)), 1e-4);
    }
    moves += i > 0 && hips[i] != hips[i - 1] ? 1 : 0;
  }
  EXPECT_GT(moves, 100);
}

// On a face the force is the spring's: what lies across does not count, and a rigid plane adds
// nothing.
TEST(HandNoise, OnAFaceIsTheHandsAlone)
{
  const Place face = SharpPlaces()[0];
  for (const double radius : Radii)
  {
    const RestingForce rest = face.ForceAt(radius, 7);
    EXPECT_TRUE(rest.IsTouching);
    EXPECT_NEAR(rest.Mean, 500.0 * Depth, 0.02);
    EXPECT_NEAR(rest.Gain, 1.0 / std::sqrt(3.0), 0.1) << radius;
    const RestingForce still = face.ForceAt(radius, 7, HandNoise());
    EXPECT_LT(still.Deviation, 1e-12) << radius;
  }
}

// Edges and corners, convex and concave: the god-object stays, or goes no farther than the hand.
TEST(HandNoise, DoesNotBuzzOnEdgesAndCorners)
{
  for (const Place& place : SharpPlaces())
  {
    for (const double radius : Radii)
    {
      const RestingForce rest = place.ForceAt(radius, 3);
      std::printf("%-22s tip %3.1f mm: %.3f N, deviation %.1f mN, gain %.2f, step %.1f mN\n",
        place.Name, 1e3 * radius, rest.Mean, 1e3 * rest.Deviation, rest.Gain, 1e3 * rest.Step);
      EXPECT_LT(rest.Gain, 2.0) << place.Name << ", tip " << radius;
      EXPECT_LT(rest.Step, 0.05) << place.Name << ", tip " << radius;
    }
  }
}

// Rough ground has knife's edges, where a point goes one way or another: few of its places may
// answer the hand's noise by more than the hand moves, and none by jumping to and fro. A ball
// larger than the hand is deep turns about an edge by r / (r - d) of what the hand moves: that is
// its form.
TEST(HandNoise, DoesNotBuzzOnRoughGround)
{
  const auto rough = MakeSurface(Star(6, Size, 0.03, 4));
  std::mt19937 random(11);
  constexpr int places = 60;
  int loud[4] = {};
  double worst[4] = {};
  double mean[4] = {};
  for (int i = 0; i < places; ++i)
  {
    const Vec3 outwards = Unit(NormalVector(random));
    const Place place{ "rough", rough, 0.985 * Size * outwards, outwards };
    for (int k = 0; k < 4; ++k)
    {
      const RestingForce rest = place.ForceAt(Radii[k], 100u + static_cast<unsigned>(i));
      loud[k] += rest.Gain > 2.0 ? 1 : 0;
      worst[k] = std::max(worst[k], rest.Step);
      mean[k] += rest.Gain / places;
    }
  }
  for (int k = 0; k < 4; ++k)
  {
    std::printf("rough ground, tip %3.1f mm: mean gain %.2f, over 2 at %d of %d places, largest "
                "step %.1f mN\n",
      1e3 * Radii[k], mean[k], loud[k], places, 1e3 * worst[k]);
    EXPECT_LT(worst[k], 0.1) << Radii[k];
    if (2.0 * Radii[k] <= Depth)
    {
      EXPECT_LE(loud[k], places / 20) << Radii[k];
    }
  }
}
