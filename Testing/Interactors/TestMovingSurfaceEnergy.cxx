// The energy account where a surface moves by itself: what it does is its own work, and the
// passivity observer takes no offence. Device frame, virtual time.
#include "ForceGuard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using haptics::ForceGuard;
using haptics::ForceModel;
using haptics::GuardedContact;
using haptics::SafetySettings;
using haptics::Vec3;

namespace
{
constexpr double Period = 0.001;      // [s]
constexpr double Stiffness = 300.0;   // [N/m]
constexpr double DeviceDamping = 0.3; // [N s/m]; 2b/T is 600 N/m

/// A plane at a height that changes, and what the god-object on it gives a hand.
class MovingPlane
{
public:
  MovingPlane()
  {
    this->Settings.SoftStartTime = 0.0;
    this->Settings.PassivityControl = true;
    this->Settings.DeviceDamping = DeviceDamping;
    this->Settings.ContactDamping = 0.0;
    this->Guard.Restart(this->Settings);
  }

  /// A tick with the plane at `height` [m] and the hand at `hand` [m]; returns the force [N].
  double Tick(double height, double hand)
  {
    const bool touching = height > hand;
    GuardedContact contact;
    contact.Position = { 0.0, 0.0, hand };
    contact.Displacement = { 0.0, 0.0, touching ? height - hand : 0.0 };
    contact.Touching = touching;
    contact.Period = Period;
    // A god-object at the height of the plane or of the hand, whichever is above, is pushed by as
    // much as the plane has risen beyond it; held, it goes with the plane.
    const double carried = this->WasTouching
      ? height - this->Height
      : std::max(0.0, height - std::max(this->Height, this->Hand));
    contact.SurfaceStep = { 0.0, 0.0, carried };
    const double force = this->Guard.Force(contact, { Stiffness, 10.0 }, this->Settings)[2];
    this->Work += 0.5 * (this->Force + force) * carried;
    this->WasTouching = touching;
    this->Height = height;
    this->Hand = hand;
    this->Force = force;
    return force;
  }

  ForceGuard Guard;
  double Work = 0.0; ///< by the plane [J]

private:
  SafetySettings Settings;
  bool WasTouching = false;
  double Height = -1.0;
  double Hand = 0.0;
  double Force = 0.0;
};

double Wave(int tick)
{
  return 0.002 * std::sin(2.0 * M_PI * tick / 250.0); // 4 Hz, 2 mm
}
}

TEST(MovingSurfaceEnergy, ASurfaceThatComesBackUnderAHandAtRestLeavesNoBalance)
{
  MovingPlane plane;
  double first = 0.0;
  for (int tick = 0; tick < 20000; ++tick)
  {
    plane.Tick(Wave(tick), -0.005);
    if (tick == 250) // the force has grown as fast as the slew limit lets it
    {
      first = plane.Work;
    }
    if (tick >= 250 && tick % 250 == 0)
    {
      ASSERT_NEAR(plane.Guard.GetEnergy(), plane.Work, 1e-12);
      ASSERT_NEAR(plane.Work, first, 1e-9) << "tick " << tick;
    }
    ASSERT_FALSE(plane.Guard.GetLimits() & haptics::PassivityDamped) << "tick " << tick;
  }
}

//   hand, 100 g and 1 N of weight
//  ______
//  /\/\/   a plane that shakes: what the hand gets is the plane's work, less what is damped
TEST(MovingSurfaceEnergy, AHandThatIsShakenGetsNoMoreThanTheSurfacesWork)
{
  constexpr double mass = 0.1;
  constexpr double weight = 1.0;
  MovingPlane plane;
  double z = 0.0; // lies down on the plane: no spring is wound up that nobody paid for
  double v = 0.0;
  double fromServo = 0.0;
  double damped = 0.0;
  int offences = 0;
  for (int tick = 0; tick < 20000; ++tick)
  {
    const double force = plane.Tick(Wave(tick), z);
    offences += (plane.Guard.GetLimits() & haptics::PassivityDamped) ? 1 : 0;
    // The force is held; the device damps. Ten steps a tick, semi-implicit.
    constexpr int steps = 10;
    for (int step = 0; step < steps; ++step)
    {
      const double dt = Period / steps;
      v += dt * (force - weight - DeviceDamping * v) / mass;
      z += dt * v;
      fromServo += dt * v * force;
      damped += dt * DeviceDamping * v * v;
    }
    // What is not the plane's work can only be what the sampled spring leaks, and the device damps.
    ASSERT_LE(fromServo, plane.Work + damped + 1e-3) << "tick " << tick;
  }
  EXPECT_GT(plane.Work, 1e-3) << "the plane does work";
  EXPECT_EQ(offences, 0) << "the observer takes the plane's work for the servo's";
}
