// Surfaces that shake, and that do not: a servo on a plane with a simulated body, in virtual time.
#include "ServoTestTools.h"
#include "haptics/Tick/TickRecord.h"
#include "vtkHapticSafety.h"
#include "vtkHapticServo.h"
#include "vtkSimulatedHapticDevice.h"

#include "vtkHapticReadings.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
/// A body of viscous friction b, pressed onto a plane by 1 N.
///
///       1 N (a soft spring, pulled far)
///        v
///        o  mass
///     --------- plane: stiffness K, force held for a period T, acting after a delay
struct PressedBody
{
  double Damping; // b [N s/m]
  double Period;  // T [s]
  double Delay;   // t_d [s]

  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticServo> Servo;

  /// `share`: of friction in the motion over half a period and the delay. The formulas are for 0;
  /// they err by about a sixth of it.
  PressedBody(double damping, double period, double delay, double share)
    : Damping(damping)
    , Period(period)
    , Delay(delay)
  {
    constexpr double Far = 1.0;           // [m]
    constexpr double HandStiffness = 1.0; // [N/m]
    this->Device->BodyOn();
    this->Device->SetDamping(damping);
    this->Device->SetMass(damping * (0.5 * period + delay) / (0.5 * share));
    this->Device->SetDelay(delay);
    this->Device->SetHandStiffness(HandStiffness);
    this->Device->SetHandDamping(0.0);
    this->Device->SetMaximumStiffness(1e6);
    this->Device->SetMaximumForce(100.0);
    this->Servo->SetRate(1.0 / period);
    this->Servo->SetDevice(this->Device);
    this->Servo->PublishGodObject(MakeGodObject(MakePlane()));
    this->Device->SetPosition(0.0, 0.0, 0.0);
    EXPECT_TRUE(this->Device->Open()) << this->Device->GetErrorMessage();
    EXPECT_EQ(this->Servo->Step(1), 1);
    this->Device->SetPosition(0.0, 0.0, -Far);
  }

  /// 2b/T, or with a delay b / (T/2 + t_d).
  double Formula() const { return this->Damping / (0.5 * this->Period + this->Delay); }

  /// So many ticks make energy decay or grow by about a factor e at a tenth off the boundary.
  int TicksOfChange(double share) const
  {
    return static_cast<int>(10.0 / share * (1.0 + 2.0 * this->Delay / this->Period));
  }

  /// How far the body goes up and down within the next ticks [m].
  double Swing(int ticks)
  {
    double lowest = 1e300;
    double highest = -1e300;
    std::vector<haptics::TickRecord> records;
    for (int left = ticks; left > 0; left -= 4096)
    {
      records.clear();
      this->Servo->Step(std::min(left, 4096));
      this->Servo->DrainRecords(records);
      for (const haptics::TickRecord& record : records)
      {
        lowest = std::min(lowest, record.DevicePosition[2]);
        highest = std::max(highest, record.DevicePosition[2]);
      }
    }
    return highest - lowest;
  }
};

/// Whether a surface of that stiffness shakes ever more: settles on a softer one first.
bool Shakes(double damping, double period, double delay, double share, double stiffness)
{
  PressedBody body(damping, period, delay, share);
  vtkHapticSafety* safety = body.Servo->GetSafety();
  safety->LoosenStiffnessMargin(100.0);
  safety->LoosenSlewLimit(1e5);
  safety->LoosenSoftStartTime(0.0);
  const int ticks = body.TicksOfChange(share);
  body.Servo->SetStiffness(0.7 * body.Formula());
  body.Swing(4 * ticks);
  body.Servo->SetStiffness(stiffness);
  const double first = body.Swing(2 * ticks);
  body.Swing(2 * ticks);
  return body.Swing(2 * ticks) > first;
}

/// The largest stiffness that does not shake, as a multiple of the formula's.
double MeasuredBoundary(double damping, double period, double delay, double share)
{
  const double formula = PressedBody(damping, period, delay, share).Formula();
  double still = 0.8;
  double shaking = 1.3;
  EXPECT_FALSE(Shakes(damping, period, delay, share, still * formula));
  EXPECT_TRUE(Shakes(damping, period, delay, share, shaking * formula));
  while (shaking - still > 0.005)
  {
    const double middle = 0.5 * (still + shaking);
    (Shakes(damping, period, delay, share, middle * formula) ? shaking : still) = middle;
  }
  return still;
}

constexpr double Dampings[] = { 0.05, 0.1, 0.35, 1.0 };    // [N s/m]
constexpr double Periods[] = { 0.0005, 0.001, 0.002 };     // [s]
constexpr double Delays[] = { 0.001, 0.002, 0.005, 0.01 }; // [s]

TEST(Stability, APlaneShakesFromTwiceTheDampingOverThePeriodOn)
{
  for (const double damping : Dampings)
  {
    for (const double period : Periods)
    {
      EXPECT_NEAR(MeasuredBoundary(damping, period, 0.0, 0.05), 1.0, 0.05)
        << "b = " << damping << " N s/m, T = " << period << " s";
    }
  }
}

TEST(Stability, DelayLowersTheBoundaryAsTheFormulaSays)
{
  for (const double delay : Delays)
  {
    EXPECT_NEAR(MeasuredBoundary(0.35, 0.001, delay, 0.1), 1.0, 0.10) << "delay " << delay << " s";
  }
}

TEST(Stability, TheStiffnessLimitKeepsAPlaneStillWhateverIsAskedFor)
{
  const auto expectStill = [](double damping, double period, double delay)
  {
    PressedBody body(damping, period, delay, 0.1);
    body.Servo->SetStiffness(1e5);
    EXPECT_NEAR(body.Servo->GetEffectiveStiffness(), 0.9 * body.Formula(), 1e-6 * body.Formula());
    const int ticks = body.TicksOfChange(0.1);
    const double first = body.Swing(2 * ticks);
    body.Swing(8 * ticks);
    EXPECT_LT(body.Swing(2 * ticks), 0.1 * first)
      << "b = " << damping << " N s/m, T = " << period << " s, delay " << delay << " s";
    EXPECT_NE(
      body.Servo->GetReadings()->DescribeForceLimits().find("stiffness limit"), std::string::npos);
  };
  for (const double damping : Dampings)
  {
    for (const double period : Periods)
    {
      expectStill(damping, period, 0.0);
    }
  }
  for (const double delay : Delays)
  {
    expectStill(0.35, 0.001, delay);
  }
}

TEST(Stability, WithoutTheStiffnessLimitTheSamePlaneShakes)
{
  PressedBody body(0.35, 0.001, 0.0, 0.1);
  body.Servo->GetSafety()->LoosenStiffnessMargin(100.0);
  body.Servo->SetStiffness(1.5 * body.Formula());
  const int ticks = body.TicksOfChange(0.1);
  body.Swing(10 * ticks);
  EXPECT_GT(body.Swing(2 * ticks), 1e-3) << "a hammer of more than a millimetre";
}

TEST(Stability, EveryPresetHoldsAPlaneStillInAHand)
{
  for (int preset = vtkSimulatedHapticDevice::Touch; preset <= vtkSimulatedHapticDevice::Falcon;
       ++preset)
  {
    vtkNew<vtkSimulatedHapticDevice> device;
    vtkNew<vtkHapticServo> servo;
    device->SetPreset(preset);
    servo->SetDevice(device);
    servo->SetStiffness(1e5);
    servo->PublishGodObject(MakeGodObject(MakePlane()));
    device->SetPosition(0.0, 0.0, 0.005);
    ASSERT_TRUE(device->Open()) << device->GetErrorMessage();
    ASSERT_EQ(servo->Step(100), 100);
    device->SetPosition(0.0, 0.0, -0.02); // 25 mm in a tick, for the hand: a blow
    ASSERT_EQ(servo->Step(3000), 3000);
    std::vector<haptics::TickRecord> records;
    servo->DrainRecords(records);
    const double rest = records.back().DevicePosition[2];
    EXPECT_EQ(servo->GetReadings()->GetNumberOfConstraints(), 1);
    for (std::size_t i = records.size() - 500; i < records.size(); ++i)
    {
      ASSERT_NEAR(records[i].DevicePosition[2], rest, 3.0 * 63.5e-6) << "preset " << preset;
    }
  }
}
}
