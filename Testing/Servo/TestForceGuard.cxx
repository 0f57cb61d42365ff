#include "haptics/Servo/ForceGuard.h"
#include "haptics/Servo/OverrunBudget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using haptics::Contact;
using haptics::ForceGuard;
using haptics::ForceModel;
using haptics::OverrunBudget;
using haptics::SafetySettings;
using haptics::StiffnessLimit;
using haptics::UpdateStatus;
using haptics::Vec3;

// Virtual time: every test here gives the same in every run.
namespace
{
constexpr double Period = 0.001; // [s]

double Length(const Vec3& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

/// What a god-object would have found, device frame.
Contact MakeContact(const Vec3& position, const Vec3& displacement, bool isTouching)
{
  Contact contact;
  contact.Hip = position;
  contact.Displacement = displacement;
  contact.Status = isTouching ? UpdateStatus::Touching : UpdateStatus::Free;
  return contact;
}

/// A guard without soft start, in front of a device of 10 N.
struct Guarded
{
  SafetySettings Settings;
  ForceModel Model{ 1000.0, 10.0 };
  ForceGuard Guard;

  Guarded()
  {
    this->Settings.SoftStartTime = 0.0;
    this->Guard.Restart(this->Settings);
  }
  Vec3 Tick(const Vec3& displacement, const Vec3& position = {}, double period = Period)
  {
    return this->Guard.Force(MakeContact(position, displacement, displacement != Vec3{}), period,
      this->Model, this->Settings);
  }
};

TEST(ForceGuard, LetsAForceGrowOnlyAsFastAsTheSlewLimit)
{
  Guarded guarded;
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.005 })[2], 1.0, 1e-12) << "1000 N/s in a millisecond";
  EXPECT_TRUE(guarded.Guard.GetLimits() & haptics::ForceSlewed);
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.005 })[2], 2.0, 1e-12);
  for (int i = 0; i < 3; ++i)
  {
    guarded.Tick({ 0.0, 0.0, 0.005 });
  }
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.005 })[2], 5.0, 1e-12);
  EXPECT_EQ(guarded.Guard.GetLimits(), 0u);
}

TEST(ForceGuard, TakesATimeThatDoesNotGoOnForNone)
{
  for (const double period : { -0.5, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    Guarded guarded;
    guarded.Settings.DeviceDamping = 1.0;
    guarded.Settings.ContactDamping = 0.2;
    guarded.Settings.PassivityControl = true;
    double z = 0.0;
    const auto tick = [&](double dt) {
      return guarded.Tick({ 0.0, 0.0, 0.005 }, { 0.0, 0.0, z -= 1e-5 }, dt)[2];
    };
    ASSERT_NEAR(tick(Period), 1.0, 1e-12);
    const double stiffness = guarded.Guard.GetLaw().GetStiffness();
    EXPECT_NEAR(tick(period), 1.0, 1e-12) << period << ": no time, so no growth";
    EXPECT_NEAR(tick(Period), 2.0, 1e-12) << period << ": and on from there";
    EXPECT_NEAR(guarded.Guard.GetLaw().GetStiffness(), stiffness, 0.01 * stiffness) << period;
  }
}

TEST(ForceGuard, LetsAForceShrinkAtOnce)
{
  Guarded guarded;
  for (int i = 0; i < 10; ++i)
  {
    guarded.Tick({ 0.0, 0.0, 0.005 });
  }
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.001 })[2], 1.0, 1e-12);
  EXPECT_EQ(guarded.Tick({}), Vec3{});
}

TEST(ForceGuard, TurnsAForceRoundThroughZeroWithinTheSlewLimit)
{
  Guarded guarded;
  for (int i = 0; i < 10; ++i)
  {
    guarded.Tick({ 0.0, 0.0, 0.005 });
  }
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, -0.005 })[2], -1.0, 1e-12);
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, -0.005 })[2], -2.0, 1e-12);
}

TEST(ForceGuard, DoesNotMakeUpForTheTimeOfALateTick)
{
  Guarded guarded;
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.005 }, {}, 0.3)[2], 2.0, 1e-12) << "as for two periods";
}

/// What falls over the soft start's time where a late tick may count for two periods: of 0.1 s.
constexpr double LateShare = 2.0 * Period / 0.1;

TEST(ForceGuard, DoesNotFadeForTheTimeOfALateTickWhileItWaitsForData)
{
  Guarded guarded;
  for (int i = 0; i < 10; ++i)
  {
    guarded.Tick({ 0.0, 0.0, 0.005 });
  }
  guarded.Settings.SoftStartTime = 0.1;
  Contact waiting = MakeContact({}, { 0.0, 0.0, 0.005 }, true);
  waiting.AwaitsData = true;
  const auto tick = [&](double period)
  { return guarded.Guard.Force(waiting, period, guarded.Model, guarded.Settings)[2]; };
  const double force = tick(0.0);
  ASSERT_NEAR(force, 5.0, 1e-12);
  EXPECT_NEAR(tick(0.09), force * (1.0 - LateShare), 1e-12) << "as for two periods";
  EXPECT_NEAR(tick(Period), force * (1.0 - 1.5 * LateShare), 1e-12);
}

TEST(ForceGuard, DoesNotSoftenForTheTimeOfALateTickAfterAnExchange)
{
  Guarded guarded;
  guarded.Settings.SoftStartTime = 0.1;
  Contact contact = MakeContact({}, { 0.0, 0.0, 0.005 }, true);
  contact.Material.IsPlain = false;
  contact.Material.Stiffness = contact.Material.LargestStiffness = 900.0;
  contact.Material.PlainShare = 0.0;
  const auto tick = [&](double period)
  { return guarded.Guard.Force(contact, period, guarded.Model, guarded.Settings)[2]; };
  double force = 0.0;
  for (int i = 0; i < 3000; ++i)
  {
    force = tick(Period);
  }
  ASSERT_NEAR(force, 4.5, 1e-12);
  contact.Material.Stiffness = contact.Material.LargestStiffness = 100.0;
  guarded.Guard.NoticeExchange();
  ASSERT_NEAR(tick(Period), force, 1e-12) << "it begins";
  EXPECT_NEAR(tick(0.09), force - 4.0 * LateShare, 1e-9) << "as for two periods";
}

TEST(ForceGuard, StartsSoftlyAndReachesTheLargestForceAtTheEnd)
{
  SafetySettings settings;
  ForceModel model{ 1e6, 10.0 };
  ForceGuard guard;
  guard.Restart(settings);
  double last = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 force =
      guard.Force(MakeContact({}, { 0.0, 0.0, 1.0 }, true), Period, model, settings);
    ASSERT_NEAR(force[2] - last, 0.1, 1e-9) << "10 N in 0.1 s";
    ASSERT_TRUE(guard.GetLimits() & haptics::SoftStarted);
    last = force[2];
  }
  EXPECT_NEAR(last, 10.0, 1e-9);
}

TEST(ForceGuard, ClampsToTheLargestForce)
{
  Guarded guarded;
  guarded.Settings.ContactDamping = 20.0;
  for (int i = 0; i < 100; ++i)
  {
    // Presses in at 1 m/s, so that spring and damping both push.
    const double z = -0.001 * i;
    ASSERT_LE(Length(guarded.Tick({ 0.0, 0.0, 0.02 - z }, { 0.0, 0.0, z })), 10.0 + 1e-12);
  }
  EXPECT_TRUE(guarded.Guard.GetLimits() & haptics::ForceClamped);
}

TEST(ForceGuard, AsksForNothingWhatIsNotFinite)
{
  Guarded guarded;
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(guarded.Tick({ 0.0, inf, 0.0 }), Vec3{});
  EXPECT_EQ(guarded.Tick({ 0.0, std::nan(""), 0.0 }), Vec3{});
}

TEST(ForceGuard, DampsAgainstTheMotionAndNeverPulls)
{
  Guarded guarded;
  guarded.Settings.ContactDamping = 1.0;
  double z = -0.002;
  Vec3 force{};
  for (int i = 0; i < 50; ++i) // in, at 0.1 m/s
  {
    z -= 0.0001;
    force = guarded.Tick({ 0.0, 0.0, -z }, { 0.0, 0.0, z });
  }
  EXPECT_NEAR(force[2], -1000.0 * z + 1.0 * 0.1, 1e-4);
  while (z < -0.0001) // out, at 0.1 m/s
  {
    z += 0.0001;
    force = guarded.Tick({ 0.0, 0.0, -z }, { 0.0, 0.0, z });
    ASSERT_GE(force[2], 0.0);
  }
  EXPECT_NEAR(force[2], 0.0, 1e-5) << "the spring's 0.1 N less 0.1 N of damping";
}

TEST(ForceGuard, GivesNoForceWhilePausedAndGrowsSoftlyAfterwards)
{
  Guarded guarded;
  for (int i = 0; i < 10; ++i)
  {
    guarded.Tick({ 0.0, 0.0, 0.005 });
  }
  guarded.Settings.Paused = true;
  EXPECT_EQ(guarded.Tick({ 0.0, 0.0, 0.005 }), Vec3{});
  EXPECT_TRUE(guarded.Guard.GetLimits() & haptics::PausedForce);
  guarded.Settings.Paused = false;
  guarded.Settings.SoftStartTime = 0.1;
  EXPECT_NEAR(guarded.Tick({ 0.0, 0.0, 0.005 })[2], 0.1, 1e-12) << "10 N in 0.1 s";
}

TEST(StiffnessLimit, IsTwiceTheDampingOverThePeriodWhereAllPeriodsAreEqual)
{
  SafetySettings settings;
  settings.DeviceDamping = 0.35;
  settings.StiffnessMargin = 0.5;
  StiffnessLimit limit;
  limit.Restart(Period);
  EXPECT_NEAR(limit.Update(Period, 5000.0, settings), 0.5 * 700.0, 1e-9);
  settings.DeviceLatency = 0.001;
  EXPECT_NEAR(limit.Allowed(settings), 0.5 * 0.35 / 0.0015, 1e-9);
  settings.DeviceLatency = 0.0;
  settings.ContactDamping = 0.1;
  EXPECT_NEAR(limit.Allowed(settings), 0.5 * 500.0, 1e-9) << "damping by the servo takes its share";
  settings.DeviceDamping = 0.0;
  EXPECT_TRUE(std::isinf(limit.Allowed(settings))) << "unknown";
}

TEST(StiffnessLimit, FollowsTheSecondMomentOfUnevenPeriods)
{
  SafetySettings settings;
  settings.DeviceDamping = 0.35;
  settings.StiffnessMargin = 0.9;
  StiffnessLimit limit;
  limit.Restart(Period);
  for (int i = 0; i < 10000; ++i)
  {
    limit.Update(i % 2 == 0 ? 0.0005 : 0.0015, 5000.0, settings);
  }
  // E[T] = 1 ms, E[T^2] = 1.25 ms^2. The running mean wavers by half a thousandth.
  EXPECT_NEAR(limit.Allowed(settings), 0.9 * 700.0 / 1.25, 1.0);
}

TEST(StiffnessLimit, FallsAtOnceAfterAStallAndComesBackInSeconds)
{
  SafetySettings settings;
  settings.DeviceDamping = 0.35;
  StiffnessLimit limit;
  limit.Restart(Period);
  EXPECT_EQ(limit.Update(Period, 500.0, settings), 500.0);
  EXPECT_LT(limit.Update(0.05, 500.0, settings), 200.0) << "50 ms of 1 s: E[T^2] is 3.5 times";
  int ticks = 0;
  while (limit.Update(Period, 500.0, settings) < 500.0 && ticks < 10000)
  {
    ++ticks;
  }
  EXPECT_GT(ticks, 1000);
  EXPECT_LT(ticks, 5000);
}

TEST(OverrunBudget, BearsWhatItIsMadeForAndNoMore)
{
  OverrunBudget every(0.5, 1000000);
  for (int i = 0; i < 100000; ++i)
  {
    ASSERT_TRUE(every.Add(2, 1)) << "every other deadline missed, for ever";
  }
  OverrunBudget burst(0.5, 1000000);
  EXPECT_TRUE(burst.Add(999, 998));
  EXPECT_FALSE(burst.Add(999, 998));
}

TEST(OverrunBudget, EndsAfterAboutASecondOfTooManyMissedDeadlines)
{
  OverrunBudget budget(0.5, 1000000);
  int deadlines = 0;
  while (budget.Add(10, 9) && deadlines < 100000)
  {
    deadlines += 10;
  }
  EXPECT_NEAR(deadlines, 1250, 10) << "0.9 - 0.5 of each fill 500";
}

/// A hand that moves to and fro fifty times in a surface that is stiffer on the way out: what the
/// last ten loops gave it [J].
double EnergyGiven(bool control, std::uint32_t& limits)
{
  Guarded guarded;
  guarded.Settings.PassivityControl = control;
  double given = 0.0;
  double lastZ = 0.0;
  Vec3 force{};
  limits = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double phase = 2.0 * 3.14159265358979 * i / 400.0;
    const double z = -0.004 + 0.002 * std::cos(phase);
    given += force[2] * (z - lastZ) * (i >= 16000);
    lastZ = z;
    guarded.Model.Stiffness = std::sin(phase) < 0.0 ? 510.0 : 500.0; // out, in
    force = guarded.Tick({ 0.0, 0.0, -z }, { 0.0, 0.0, z });
    limits |= guarded.Guard.GetLimits();
  }
  return given;
}

TEST(PassivityController, TakesBackWhatASurfaceThatHardensUnderTheHandWouldGive)
{
  std::uint32_t limits = 0;
  const double uncontrolled = EnergyGiven(false, limits);
  EXPECT_FALSE(limits & haptics::PassivityDamped);
  // dK z dz a loop, and what the hold leaks: K T / 2 of negative damping at 31 mm/s.
  EXPECT_NEAR(uncontrolled, 10 * 10.0 * 0.004 * 0.004 + 4.0 * 0.25 * 0.0314 * 0.0314 / 2, 5e-5);
  const double controlled = EnergyGiven(true, limits);
  EXPECT_TRUE(limits & haptics::PassivityDamped);
  EXPECT_LT(controlled, 0.2 * uncontrolled);
}

TEST(PassivityController, LeavesAPassiveSpringAlone)
{
  Guarded guarded;
  guarded.Settings.PassivityControl = true;
  guarded.Settings.DeviceDamping = 1.0; // b = 1 bears 1000 N/m at 1 ms twice over
  for (int i = 0; i < 4000; ++i)
  {
    const double z = -0.002 * (1.0 - std::cos(2.0 * 3.14159265358979 * i / 400.0));
    guarded.Tick({ 0.0, 0.0, std::max(0.0, -z) }, { 0.0, 0.0, z });
    ASSERT_FALSE(guarded.Guard.GetLimits() & haptics::PassivityDamped) << "tick " << i;
    ASSERT_GE(guarded.Guard.GetPassivityBalance(), 0.0);
  }
}
}
