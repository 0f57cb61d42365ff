// The energy account where a surface moves, deforms or changes by itself: what it does is its own
// work, and the passivity observer takes no offence. Device frame, virtual time.
#include "haptics/Contact/GodObject.h"
#include "haptics/Servo/ForceGuard.h"
#include "haptics/Surface/SurfaceDeformer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using haptics::Contact;
using haptics::ForceGuard;
using haptics::ForceModel;
using haptics::SafetySettings;
using haptics::UpdateStatus;
using haptics::Vec3;

namespace
{
constexpr double Period = 0.001;      // [s]
constexpr double Stiffness = 300.0;   // [N/m]
constexpr double DeviceDamping = 0.3; // [N s/m]; 2b/T is 600 N/m

SafetySettings ObservedSettings()
{
  SafetySettings settings;
  settings.SoftStartTime = 0.0;
  settings.PassivityControl = true;
  settings.DeviceDamping = DeviceDamping;
  settings.ContactDamping = 0.0;
  return settings;
}

/// A plane at a height that changes, and what the god-object on it gives a hand.
class MovingPlane
{
public:
  MovingPlane() { this->Guard.Restart(this->Settings); }

  /// A tick with the plane at `height` [m] and the hand at `hand` [m]; returns the force [N].
  double Tick(double height, double hand)
  {
    const bool touching = height > hand;
    Contact contact;
    contact.Hip = { 0.0, 0.0, hand };
    contact.Displacement = { 0.0, 0.0, touching ? height - hand : 0.0 };
    contact.Status = touching ? UpdateStatus::Touching : UpdateStatus::Free;
    // A god-object at the height of the plane or of the hand, whichever is above, is pushed by as
    // much as the plane has risen beyond it; held, it goes with the plane.
    const double carried = this->WasTouching
      ? height - this->Height
      : std::max(0.0, height - std::max(this->Height, this->Hand));
    contact.SurfaceDisplacement = { 0.0, 0.0, carried };
    const double force = this->Guard.Force(contact, Period, { Stiffness, 10.0 }, this->Settings)[2];
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
  SafetySettings Settings = ObservedSettings();
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
      ASSERT_NEAR(plane.Guard.GetPassivityBalance(), plane.Work, 1e-12);
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

namespace
{
constexpr int TicksAStep = 17;
constexpr int StepsAPeriod = 15;
constexpr int Shaken = TicksAStep * StepsAPeriod; ///< ticks of a period

/// A wavy sheet, all of which goes up and down: new points 60 times a second, or other cells.
class WavySheet
{
public:
  explicit WavySheet(bool deforms)
    : Deforms(deforms)
  {
    this->Settings.SlewLimit = 1e5; // a force that is held back is not the spring's
    this->Guard.Restart(this->Settings);
    this->Surface = haptics::TriangleSurface::Build(Mesh(16, 0.0), Options(), this->Error);
    this->Deformer = std::make_unique<haptics::SurfaceDeformer>(this->Surface);
    this->God = std::make_unique<haptics::GodObject>(this->List());
  }

  /// The next tick, with the hand at `hand`; returns the force [N].
  Vec3 Tick(const Vec3& hand)
  {
    if (this->Ticks % TicksAStep == 0)
    {
      this->Show(this->Ticks / TicksAStep);
    }
    ++this->Ticks;
    this->God->Advance(Period);
    const haptics::Contact& contact = this->God->Update(hand);
    const Vec3 force = this->Guard.Force(contact, Period, { Stiffness, 10.0 }, this->Settings);
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Work += 0.5 * (this->Force[i] + force[i]) * contact.SurfaceDisplacement[i];
    }
    this->Force = force;
    this->Offences += (this->Guard.GetLimits() & haptics::PassivityDamped) ? 1 : 0;
    return force;
  }

  ForceGuard Guard;
  double Work = 0.0; ///< by the sheet [J]
  int Offences = 0;

private:
  static haptics::TriangleMesh Mesh(int cells, double height)
  {
    haptics::TriangleMesh mesh;
    for (int j = 0; j <= cells; ++j)
    {
      for (int i = 0; i <= cells; ++i)
      {
        const double x = 0.2 * i / cells - 0.1;
        mesh.Points.push_back(
          { x, 0.2 * j / cells - 0.1, height * (1.0 + 0.3 * std::cos(30.0 * x)) });
      }
    }
    for (int j = 0; j < cells; ++j)
    {
      for (int i = 0; i < cells; ++i)
      {
        const int a = j * (cells + 1) + i;
        const int b = a + cells + 1;
        mesh.Triangles.push_back({ a, a + 1, b + 1 });
        mesh.Triangles.push_back({ a, b + 1, b });
      }
    }
    return mesh;
  }
  static haptics::SurfaceOptions Options()
  {
    haptics::SurfaceOptions options;
    options.TouchedSide = haptics::Side::Both;
    return options;
  }
  std::vector<haptics::TouchedSurface> List() const
  {
    std::vector<haptics::TouchedSurface> list{ this->Surface };
    list.front().Identity = 1;
    return list;
  }
  void Show(int step)
  {
    // What deforms gets there with the next step, what changes is there now.
    const double height = 0.002 * std::sin(2.0 * M_PI * step / StepsAPeriod);
    this->Surface = this->Deforms
      ? this->Deformer->Deform(Mesh(16, height).Points, TicksAStep * Period, this->Error)
      : haptics::TriangleSurface::Build(
          Mesh(14 + step % StepsAPeriod % 3, height), Options(), this->Error);
    ASSERT_TRUE(this->Surface) << this->Error;
    auto next = std::make_unique<haptics::GodObject>(this->List());
    next->Continue(*this->God);
    this->God = std::move(next);
  }

  bool Deforms;
  SafetySettings Settings = ObservedSettings();
  std::shared_ptr<const haptics::TriangleSurface> Surface;
  std::unique_ptr<haptics::SurfaceDeformer> Deformer;
  std::unique_ptr<haptics::GodObject> God;
  Vec3 Force{};
  int Ticks = 0;
  std::string Error;
};

class ShakingSheet : public ::testing::TestWithParam<bool>
{
};
}

//      hand, at rest 6 mm under the sheet's mean
//  ~~~~~~~~   the sheet deforms, or is exchanged for one with other triangles, 60 times a second
TEST_P(ShakingSheet, LeavesNoBalanceWhenItComesBackUnderAHandAtRest)
{
  WavySheet sheet(GetParam());
  const Vec3 hand{ 0.013, 0.007, -0.006 };
  sheet.Tick({ hand[0], hand[1], 0.006 });
  double last = 0.0;
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (int tick = 1; tick <= 20 * Shaken; ++tick)
  {
    sheet.Tick(hand);
    least = std::min(least, sheet.Work);
    most = std::max(most, sheet.Work);
    if (tick % Shaken == 0)
    {
      // What is carried along and then slides back over a slope, tick by tick, loses a little.
      const double kept = sheet.Work - std::exchange(last, sheet.Work);
      ASSERT_GE(tick == Shaken ? 0.0 : kept, -1e-9) << "tick " << tick;
      ASSERT_LE(tick == Shaken ? 0.0 : kept, 1e-7) << "tick " << tick;
    }
  }
  EXPECT_GT(most - least, 1e-3) << "the sheet does work";
  EXPECT_EQ(sheet.Offences, 0);
}

//   hand, 100 g and 1 N of weight, damped by the device: shaken up and down
TEST_P(ShakingSheet, GivesAHandNoMoreThanItsOwnWork)
{
  constexpr double mass = 0.1;
  constexpr double weight = 1.0;
  WavySheet sheet(GetParam());
  double z = 0.003; // lies down
  double v = 0.0;
  double fromServo = 0.0;
  double damped = 0.0;
  for (int tick = 0; tick < 80 * Shaken; ++tick)
  {
    const Vec3 force = sheet.Tick({ 0.013, 0.007, z });
    constexpr int steps = 10;
    for (int step = 0; step < steps; ++step)
    {
      const double dt = Period / steps;
      v += dt * (force[2] - weight - DeviceDamping * v) / mass;
      z += dt * v;
      fromServo += dt * v * force[2];
      damped += dt * DeviceDamping * v * v;
    }
    ASSERT_LE(fromServo, sheet.Work + damped + 1e-3) << "tick " << tick;
  }
  EXPECT_GT(sheet.Work, 1e-4);
  EXPECT_EQ(sheet.Offences, 0) << "the observer takes the sheet's work for the servo's";
}

INSTANTIATE_TEST_SUITE_P(MovingSurfaceEnergy, ShakingSheet, ::testing::Bool(),
  [](const auto& info) { return info.param ? "Deforming" : "OtherCells"; });
