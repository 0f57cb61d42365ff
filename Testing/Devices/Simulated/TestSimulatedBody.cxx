#include "haptics/Devices/Simulated/SimulatedBody.h"

#include <gtest/gtest.h>

#include <cmath>

using haptics::BodyParameters;
using haptics::DevicePoint;
using haptics::SimulatedBody;

// What is solved in closed form agrees to a few roundings of float64.
namespace
{
constexpr double Period = 0.001;
constexpr double Rounding = 1e-13;

/// A body that nobody holds.
BodyParameters Free()
{
  BodyParameters body;
  body.Mass = 0.05;
  body.Damping = 0.0;
  body.MaximumForce = 10.0;
  body.HandStiffness = 0.0;
  body.HandDamping = 0.0;
  return body;
}

void Advance(SimulatedBody& body, int ticks, const DevicePoint& target = {})
{
  for (int i = 0; i < ticks; ++i)
  {
    body.Advance(body.GetTime() + Period, target);
  }
}

TEST(SimulatedBody, FliesAsUnderAConstantForceWithViscousFriction)
{
  BodyParameters parameters = Free();
  parameters.Damping = 0.7;
  SimulatedBody body(parameters);
  body.Place(0.0, { 0.0, 0.0, 0.01 });
  body.Ask({ 0.0, 0.0, 2.0 });
  Advance(body, 100);
  const double tau = 0.05 / 0.7;
  const double speed = 2.0 / 0.7 * -std::expm1(-0.1 / tau);
  EXPECT_NEAR(body.GetVelocity()[2], speed, 100 * Rounding);
  EXPECT_NEAR(body.GetPosition()[2], 0.01 + 2.0 / 0.7 * 0.1 - tau * speed, 100 * Rounding);
  EXPECT_EQ(body.GetPosition()[0], 0.0);
}

TEST(SimulatedBody, SwingsOnTheHandsSpringForEverWithoutDamping)
{
  BodyParameters parameters = Free();
  parameters.HandStiffness = 500.0;
  SimulatedBody body(parameters);
  body.Place(0.0, {});
  const double force = 1.0;
  body.Ask({ force, 0.0, 0.0 });
  Advance(body, 100000); // 100 s, 1600 swings
  const double omega = std::sqrt(500.0 / 0.05);
  EXPECT_NEAR(body.GetPosition()[0], force / 500.0 * (1.0 - std::cos(omega * 100.0)), 1e-9);
}

TEST(SimulatedBody, MovesAlikeWhateverTheTicks)
{
  // Friction of both kinds, sticking and turning, a hand that pulls along a moving target.
  BodyParameters parameters = Free();
  parameters.Damping = 0.3;
  parameters.CoulombFriction = 0.2;
  parameters.HandStiffness = 200.0;
  parameters.HandDamping = 1.0;
  SimulatedBody coarse(parameters);
  SimulatedBody fine(parameters);
  coarse.Place(0.0, {});
  fine.Place(0.0, {});
  for (int i = 1; i <= 50; ++i)
  {
    const double time = 0.01 * i;
    const DevicePoint from{ 0.01 * std::sin(40.0 * (time - 0.01)), 0.0, 0.0 };
    const DevicePoint to{ 0.01 * std::sin(40.0 * time), 0.0, 0.0 };
    coarse.Advance(time, to);
    for (int part = 1; part <= 16; ++part)
    {
      const double s = part / 16.0;
      fine.Advance(time - 0.01 + 0.01 * s, { from[0] + s * (to[0] - from[0]), 0.0, 0.0 });
    }
    ASSERT_NEAR(coarse.GetPosition()[0], fine.GetPosition()[0], 1e-10) << "at " << time << " s";
    ASSERT_NEAR(coarse.GetVelocity()[0], fine.GetVelocity()[0], 1e-8) << "at " << time << " s";
  }
}

TEST(SimulatedBody, SlidesToRestByCoulombFrictionAndStaysThere)
{
  BodyParameters parameters = Free();
  parameters.CoulombFriction = 0.5;
  SimulatedBody body(parameters);
  body.Place(0.0, {});
  body.Ask({ 1.5, 0.0, 0.0 }); // 1 N beyond friction for 10 ms: 0.2 m/s, 1 mm
  Advance(body, 10);
  EXPECT_NEAR(body.GetVelocity()[0], 0.2, Rounding);
  EXPECT_NEAR(body.GetPosition()[0], 0.001, Rounding);
  body.Ask({});
  Advance(body, 100);
  EXPECT_EQ(body.GetVelocity()[0], 0.0);
  EXPECT_NEAR(body.GetPosition()[0], 0.001 + 0.5 * 0.05 * 0.04 / 0.5, 1e-12);
  const double rest = body.GetPosition()[0];
  body.Ask({ -0.5, 0.0, 0.0 });
  Advance(body, 100);
  EXPECT_EQ(body.GetPosition()[0], rest) << "0.5 N do not move it";
  body.Ask({ -0.51, 0.0, 0.0 });
  Advance(body, 100);
  EXPECT_NEAR(body.GetPosition()[0], rest - 0.5 * 0.01 / 0.05 * 0.01, 1e-12);
}

TEST(SimulatedBody, BreaksAwayWhenTheHandsPullExceedsFriction)
{
  BodyParameters parameters = Free();
  parameters.CoulombFriction = 0.5;
  parameters.HandStiffness = 100.0;
  SimulatedBody body(parameters);
  body.Place(0.0, {});
  body.Advance(1.0, { 0.005, 0.0, 0.0 }); // 100 N/m times 5 mm: just not
  EXPECT_EQ(body.GetPosition()[0], 0.0);
  body.Advance(2.0, { 0.010, 0.0, 0.0 });
  EXPECT_GT(body.GetPosition()[0], 0.003);
}

TEST(SimulatedBody, ActsOnAForceAfterItsDelayToTheNanosecond)
{
  BodyParameters parameters = Free();
  parameters.Delay = 0.00237;
  SimulatedBody body(parameters);
  body.Place(0.0, {});
  body.Ask({ 1.0, 0.0, 0.0 });
  Advance(body, 2);
  EXPECT_EQ(body.GetPosition()[0], 0.0);
  Advance(body, 8);
  const double time = 0.010 - 0.00237;
  EXPECT_NEAR(body.GetPosition()[0], 0.5 * 1.0 / 0.05 * time * time, Rounding);
}

TEST(SimulatedBody, JittersWithinItsBoundsAndAlikeInEveryRun)
{
  BodyParameters parameters = Free();
  parameters.Jitter = 0.004;
  SimulatedBody body(parameters);
  double last[2] = {};
  for (double& speed : last)
  {
    body.Place(0.0, {});
    body.Ask({ 1.0, 0.0, 0.0 });
    Advance(body, 10);
    speed = body.GetVelocity()[0];
    EXPECT_GT(speed, 1.0 / 0.05 * 0.006);
    EXPECT_LE(speed, 1.0 / 0.05 * 0.010 + Rounding);
  }
  EXPECT_EQ(last[0], last[1]);
}

TEST(SimulatedBody, ReportsPositionsInStepsOfItsEncoders)
{
  BodyParameters parameters = Free();
  parameters.EncoderResolution = 55e-6;
  SimulatedBody body(parameters);
  body.Place(0.0, { 80e-6, -80e-6, 20e-6 });
  EXPECT_NEAR(body.GetMeasuredPosition()[0], 55e-6, 1e-18);
  EXPECT_NEAR(body.GetMeasuredPosition()[1], -55e-6, 1e-18);
  EXPECT_EQ(body.GetMeasuredPosition()[2], 0.0);
  EXPECT_EQ(body.GetPosition()[2], 20e-6);
}

TEST(SimulatedBody, GivesNoMoreThanItsMotorsCan)
{
  BodyParameters parameters = Free();
  parameters.MaximumForce = 3.0;
  SimulatedBody body(parameters);
  body.Place(0.0, {});
  body.Ask({ 30.0, 40.0, 0.0 });
  Advance(body, 10);
  EXPECT_NEAR(body.GetVelocity()[0], 1.8 / 0.05 * 0.01, Rounding);
  EXPECT_NEAR(body.GetVelocity()[1], 2.4 / 0.05 * 0.01, Rounding);
}
}
