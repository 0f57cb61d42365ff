// Patches of a surface that come late, or not at all, under a hand that moves. Virtual time.
#include "ServoTestTools.h"
#include "SurfaceInPatches.h"
#include "haptics/Scene/PatchPlanner.h"
#include "haptics/Servo/ServoCycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
constexpr double Period = 0.001;
constexpr int TicksPerLook = 16;      // of the GUI thread
constexpr int TicksPerStarving = 130; // see Link::MissedTicks
constexpr double PatchRadius = 0.01;
constexpr double Stiffness = 500.0;
/// In a tick one force may fall and another come, each over 0.1 s from or to the largest [N].
constexpr double SoftStep = 2.0 * 3.3 * Period / 0.1;

using Hand = std::function<Vec3(double time)>;

struct Link
{
  double Latency = 0.0; ///< [s]
  double Loss = 0.0;    ///< share of requests that are never answered
  double DeadFrom = HUGE_VAL;
  double DeadUntil = HUGE_VAL; ///< the server answers nothing meanwhile
  /// How many ticks the servo misses at the end of each 130, as on a machine that is busy.
  int MissedTicks = 0;
};

struct Outcome
{
  std::vector<Vec3> Forces;
  std::vector<Contact> Contacts;
  int Patches = 0;
  int Losses = 0;
  int Waiting = 0;
  double LargestStep = 0.0;           ///< of the force in a tick [N]
  double LargestStepAtExchange = 0.0; ///< the same in ticks in which a patch is taken
  double LargestStepUnlike = 0.0;     ///< the same while waiting and for 0.2 s after
  double LargestStepWaiting = 0.0;    ///< the same while waiting
  double HeldAtArrival = 0.0;         ///< what a spring to the rim would have: all of it goes [N]
};

class Trial
{
public:
  explicit Trial(const SurfaceInPatches& source)
    : Source(source)
  {
  }

  Outcome OnTheWhole(const Hand& hand, int ticks)
  {
    this->Begin(hand);
    this->Cycle->GetExchange().Publish(MakeGodObject(this->Source.Whole()));
    for (int i = 0; i < ticks; ++i)
    {
      this->Tick(i);
    }
    return this->Found;
  }

  Outcome InPatches(const Hand& hand, const Link& link, int ticks, unsigned seed = 1)
  {
    this->Begin(hand);
    PatchPlanner planner(PatchRadius);
    std::mt19937 random(seed);
    std::deque<PatchRequest> onTheWay;
    const PatchRegion first{ hand(0.0), hand(0.0), PatchRadius };
    this->Cycle->GetExchange().Publish(MakeGodObject(this->Source.Patch(first)));
    planner.Receive(0.0, { first, 0.0 });
    for (int i = 0; i < ticks; ++i)
    {
      if (i == 0 || i % TicksPerStarving < TicksPerStarving - link.MissedTicks)
      {
        this->Tick(i);
      }
      if (i % TicksPerLook != 0)
      {
        continue;
      }
      const double now = i * Period;
      for (; !onTheWay.empty() && onTheWay.front().Time + link.Latency <= now; onTheWay.pop_front())
      {
        const PatchRequest& answer = onTheWay.front();
        this->Cycle->GetExchange().Publish(MakeGodObject(this->Source.Patch(answer.Region)));
        planner.Receive(now, answer);
        ++this->Found.Patches;
      }
      const Contact& last = this->Found.Contacts.back();
      if (const auto request =
            planner.Plan({ now, last.Hip, last.Position, last.IsAstray, last.AwaitsData }))
      {
        const double chance = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        const bool isDead = now >= link.DeadFrom && now < link.DeadUntil;
        if (chance >= link.Loss && !isDead)
        {
          onTheWay.push_back(*request);
        }
      }
    }
    this->Found.Losses = planner.NumberOfLosses();
    return this->Found;
  }

private:
  void Begin(const Hand& hand)
  {
    this->Found = {};
    this->Cycle = std::make_unique<ServoCycle>(16);
    this->Channel = std::make_shared<ScriptedChannel>();
    this->Channel->Hand = [hand](double time, DeviceSample& sample)
    {
      sample.Position = hand(time);
      return true;
    };
    ServoSettings settings;
    settings.Force.Stiffness = Stiffness;
    settings.Force.MaximumForce = 3.3;
    this->Cycle->Configure(settings);
    this->Cycle->Begin(this->Channel, ServoState::Stepping);
    this->Generation = 0;
    this->UnlikeUntil = -1.0;
  }

  void Tick(int i)
  {
    ASSERT_TRUE(this->Cycle->Tick(i * Period));
    this->Cycle->UpdateLatest();
    std::vector<TickRecord> records;
    this->Cycle->Drain(records);
    const TickRecord& record = records.back();
    const Vec3& force = record.Force;
    Outcome& found = this->Found;
    const double step = found.Forces.empty() ? 0.0 : Length(force - found.Forces.back());
    const bool wasWaiting = !found.Contacts.empty() && found.Contacts.back().AwaitsData;
    found.LargestStep = std::max(found.LargestStep, step);
    if (record.Generation != this->Generation)
    {
      found.LargestStepAtExchange = std::max(found.LargestStepAtExchange, step);
      this->Generation = record.Generation;
    }
    if (record.AwaitsData)
    {
      ++found.Waiting;
      found.LargestStepWaiting = std::max(found.LargestStepWaiting, step);
      this->UnlikeUntil = record.Time + 0.2;
      EXPECT_TRUE(record.Limits & DataAwaited);
    }
    else if (wasWaiting)
    {
      const Contact& last = found.Contacts.back();
      found.HeldAtArrival =
        std::max(found.HeldAtArrival, std::min(3.3, Stiffness * Length(last.Position - last.Hip)));
    }
    if (record.Time <= this->UnlikeUntil)
    {
      found.LargestStepUnlike = std::max(found.LargestStepUnlike, step);
    }
    found.Forces.push_back(force);
    found.Contacts.push_back(record);
  }

  const SurfaceInPatches& Source;
  std::unique_ptr<ServoCycle> Cycle;
  std::shared_ptr<ScriptedChannel> Channel;
  Outcome Found;
  std::uint64_t Generation = 0;
  double UnlikeUntil = -1.0;
};

constexpr double HalfWay = 0.04;

/// Comes down and strokes over the block to and fro, `depth` below its mean height, by a cosine
/// with this speed in the middle.
Hand Stroke(double speed, double depth)
{
  return [=](double time)
  {
    const double x = -HalfWay * std::cos(speed / HalfWay * std::max(0.0, time - 0.5));
    const double down = std::clamp(time / 0.5, 0.0, 1.0);
    return Vec3{ x, 0.01 * std::sin(0.7 * time),
      0.008 - (0.008 + depth) * down * down * (3.0 - 2.0 * down) };
  };
}

/// Ground over which a force changes little in a tick.
TriangleMesh SmoothBlock(int cells)
{
  return HeightBlock([](double x, double y)
    { return 0.0015 * std::sin(90.0 * x) * std::cos(70.0 * y); },
    0.06, cells);
}

/// How far a hand may be from where it was thought to be when data come: see PatchPlanner.
double LargestError(double speed, double latency)
{
  const double acceleration = speed * speed / HalfWay;
  const double interval = TicksPerLook * Period;
  // Data are taken at a look.
  const double lead = interval * (std::ceil(latency / interval) + 1.0);
  return acceleration * (0.5 * lead * lead + lead * interval);
}

/// Whether the god-object has crossed nothing: a god-object on the whole surface can follow it.
void ExpectNoLeak(const SurfaceInPatches& source, const Outcome& found)
{
  GodObject whole({ source.Whole() });
  for (std::size_t i = 0; i < found.Contacts.size(); ++i)
  {
    const Vec3& place = found.Contacts[i].Position;
    ASSERT_LT(Length(whole.Update(place).Position - place), 1e-7) << "tick " << i;
  }
}
}

TEST(PatchLatency, ForcesAreThoseOfTheWholeWhereDataAreThereInTime)
{
  const SurfaceInPatches source(SmoothBlock(90));
  Trial trial(source);
  for (const double speed : { 0.1, 0.3, 1.0 })
  {
    for (const double latency : { 0.0, 0.02, 0.07, 0.2 })
    {
      SCOPED_TRACE(std::to_string(speed) + " m/s, " + std::to_string(latency) + " s");
      const Hand hand = Stroke(speed, 0.002);
      const int ticks = 2000;
      const Outcome whole = trial.OnTheWhole(hand, ticks);
      const Outcome found = trial.InPatches(hand, { latency }, ticks);
      std::printf("[ MEASURED ] %.1f m/s, %3.0f ms: %2d patches, waiting %4d ticks, step %.3f N "
                  "(whole %.3f), at exchanges %.3f, waiting and after %.3f; a held spring would "
                  "let go of %.2f\n",
        speed, 1e3 * latency, found.Patches, found.Waiting, found.LargestStep, whole.LargestStep,
        found.LargestStepAtExchange, found.LargestStepUnlike, found.HeldAtArrival);
      ExpectNoLeak(source, found);
      if (found.Waiting == 0)
      {
        EXPECT_EQ(found.Forces, whole.Forces) << "to the last bit";
      }
      if (LargestError(speed, latency) < 0.5 * PatchRadius)
      {
        EXPECT_EQ(found.Waiting, 0);
      }
      EXPECT_LE(found.LargestStep, whole.LargestStep + SoftStep) << "no pop";
    }
  }
}

TEST(PatchLatency, LateDataLossesAndADeadServerLeakNothingAndPopNothing)
{
  const SurfaceInPatches source(SmoothBlock(90));
  Trial trial(source);
  const Hand hand = Stroke(0.3, 0.002);
  const int ticks = 4000;
  const std::vector<Link> links = { { 1.0 }, { 0.07, 0.3 }, { 0.2, 0.5 }, { 0.02, 0.0, 1.0, 2.5 },
    { 0.02, 0.0, 1.0, HUGE_VAL } };
  const Outcome whole = trial.OnTheWhole(hand, ticks);
  for (std::size_t k = 0; k < links.size(); ++k)
  {
    SCOPED_TRACE("link " + std::to_string(k));
    const Outcome found = trial.InPatches(hand, links[k], ticks, 5);
    std::printf(
      "[ MEASURED ] link %zu: %2d patches, %d lost, waiting %4d ticks, step %.3f N (whole "
      "%.3f), at exchanges %.3f, waiting and after %.3f; a held spring would let go of "
      "%.2f\n",
      k, found.Patches, found.Losses, found.Waiting, found.LargestStep, whole.LargestStep,
      found.LargestStepAtExchange, found.LargestStepUnlike, found.HeldAtArrival);
    EXPECT_GT(found.Waiting, 100);
    ExpectNoLeak(source, found);
    EXPECT_LE(found.LargestStep, whole.LargestStep + SoftStep);
    for (const Contact& contact : found.Contacts)
    {
      ASSERT_TRUE(std::isfinite(contact.Penetration));
    }
    if (links[k].DeadUntil == HUGE_VAL && links[k].DeadFrom < 2.0)
    {
      EXPECT_TRUE(found.Contacts.back().AwaitsData);
      EXPECT_EQ(found.Forces.back(), NoForce) << "a server that has died leaves no force";
    }
    else if (links[k].DeadFrom < 2.0)
    {
      EXPECT_GT(Length(found.Forces.back()), 0.1) << "it goes on when the server is back";
    }
  }
}

/// After a late tick a force that fades has not made up for all of the time that has passed, as
/// none that grows has: see ForceGuard.
TEST(PatchLatency, AServoThatMissesTicksPopsNothingWhileItWaits)
{
  const SurfaceInPatches source(SmoothBlock(90));
  Trial trial(source);
  constexpr double twoPeriods = 2.0 * 3.3 * Period / 0.1;
  for (const int missed : { 0, 20, 60, 90 })
  {
    SCOPED_TRACE(std::to_string(missed) + " ticks are missed");
    for (const double speed : { 0.3, 0.6 })
    {
      Link link{ 0.2 };
      link.MissedTicks = missed;
      const Outcome found = trial.InPatches(Stroke(speed, 0.003), link, 4000);
      std::printf("[ MEASURED ] %.1f m/s, %d of %d ticks missed: waiting %d ticks, largest step "
                  "while waiting %.3f N\n",
        speed, missed, TicksPerStarving, found.Waiting, found.LargestStepWaiting);
      EXPECT_GT(found.Waiting, 100);
      EXPECT_GT(found.LargestStepWaiting, 0.0) << "a force has faded";
      EXPECT_LE(found.LargestStepWaiting, twoPeriods + 1e-12);
      ExpectNoLeak(source, found);
    }
  }
}

TEST(PatchLatency, OnRoughGroundNothingLeaksEither)
{
  const SurfaceInPatches source(RoughBlock(90));
  Trial trial(source);
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    const Outcome found = trial.InPatches(Stroke(0.5, 0.003), { 0.05, 0.3 }, 3000, seed);
    EXPECT_GT(found.Waiting, 100);
    EXPECT_GT(found.Patches, 2);
    ExpectNoLeak(source, found);
  }
}

TEST(PatchLatency, NothingIsAskedForWhileTheHandStaysInTheMiddle)
{
  PatchPlanner planner(0.01);
  planner.Receive(0.0, { { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, 0.01 }, 0.0 });
  for (int i = 0; i < 1000; ++i)
  {
    const double time = 0.016 * i;
    const Vec3 hip{ 0.002 * std::sin(3.0 * time), 0.002 * std::cos(2.0 * time), 0.0 };
    ASSERT_FALSE(planner.Plan({ time, hip, hip })) << time;
  }
}

TEST(PatchLatency, APatchHasTheGodObjectAndIsAheadOfTheHand)
{
  PatchPlanner planner(0.01);
  std::optional<PatchRequest> region;
  std::optional<PatchRequest> asked;
  double time = 0.0;
  double askedAt = 0.0;
  while (!region || time < 0.6)
  {
    time += 0.016;
    if (asked && time >= askedAt + 0.1 - 1e-9)
    {
      planner.Receive(time, *asked);
      asked.reset();
    }
    region = planner.Plan({ time, { 0.2 * time, 0.0, -0.003 }, { 0.2 * time, 0.0, 0.0 } });
    if (region)
    {
      asked = region;
      askedAt = time;
    }
    ASSERT_LT(time, 2.0);
  }
  EXPECT_NEAR(region->Region.From[2], 0.0, 1e-12) << "from the god-object";
  EXPECT_GT(region->Region.To[0], region->Region.From[0] + 0.2 * 0.1) << "by the latency";
  EXPECT_NEAR(region->Region.Radius, 0.013, 1e-12) << "and by as much as it lags behind";
  EXPECT_NEAR(planner.Latency(), 0.1, 0.015);
  // Lost: asked for again.
  EXPECT_FALSE(planner.Plan({ time + 0.1, {}, {} }));
  EXPECT_TRUE(planner.Plan({ time + 1.0, {}, {} }));
  EXPECT_EQ(planner.NumberOfLosses(), 1);
}

/// A thread that waits for each answer has half of its time for others.
TEST(PatchLatency, NothingIsAskedForSoonAfterASlowAnswer)
{
  for (const double pause : { 0.0, 1.0 })
  {
    PatchPlanner planner(PatchRadius, pause);
    const auto plan = [&](double time)
    {
      const Vec3 hip{ 0.5 * time, 0.0, 0.0 }; // too fast for any patch
      return planner.Plan({ time, hip, hip });
    };
    const auto first = plan(0.0);
    ASSERT_TRUE(first);
    planner.Receive(0.05, *first);
    const auto slow = plan(0.5);
    ASSERT_TRUE(slow);
    planner.Receive(0.7, *slow); // took 0.2 s
    EXPECT_EQ(plan(0.72).has_value(), pause == 0.0);
    if (pause > 0.0)
    {
      EXPECT_FALSE(plan(0.89));
      const auto next = plan(0.91);
      ASSERT_TRUE(next);
      EXPECT_GT(next->Region.To[0] - next->Region.From[0], 0.5 * 2.0 * 0.2 * 0.99)
        << "it reaches as much farther ahead";
    }
  }
}

/// What a surface has gone over needs a patch that reaches up to that, once.
TEST(PatchLatency, AGodObjectThatIsAstrayIsLedToTheSurface)
{
  PatchPlanner planner(PatchRadius);
  HandState hand{ 1.0, { 0.001, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
  const auto first = planner.Plan(hand);
  ASSERT_TRUE(first);
  EXPECT_FALSE(first->IsUpToSurface);
  planner.Receive(1.0, *first);
  hand.Time = 1.1;
  EXPECT_FALSE(planner.Plan(hand)) << "it is in the middle";
  hand.IsAstray = true;
  const auto next = planner.Plan(hand);
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->IsUpToSurface);
  EXPECT_EQ(next->Region.From, hand.Position);
  planner.Receive(1.1, *next);
  hand.Time = 1.2;
  hand.Hip = { 1.0, 0.0, 0.0 };
  EXPECT_FALSE(planner.Plan(hand)) << "also where the hand goes away";
  hand.Position = { 0.001, 0.0, 0.0 };
  EXPECT_TRUE(planner.Plan(hand)) << "but where it is astray elsewhere";
}

/// One that waits is led along its line, by no wider a patch than it needs to go on.
TEST(PatchLatency, AHandThatWaitsGetsNarrowPatchesFirst)
{
  PatchPlanner planner(0.01);
  HandState hand{ 1.0, { 0.2, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
  hand.IsWaiting = true;
  for (const double expected : { 0.03, 0.05, 0.09, 0.17, 0.21 })
  {
    const auto next = planner.Plan(hand);
    ASSERT_TRUE(next);
    EXPECT_NEAR(next->Region.Radius, expected, 1e-12);
    EXPECT_NEAR(next->Region.To[0], 0.2, 1e-12) << "the whole way";
    planner.Receive(hand.Time, *next);
    hand.Time += 0.1;
  }
  EXPECT_FALSE(planner.Plan(hand)) << "all of it is known";
  hand.IsWaiting = false;
  hand.Position = { 0.18, 0.0, 0.0 };
  hand.Hip = { 0.2, 0.5, 0.0 };
  const auto last = planner.Plan(hand);
  ASSERT_TRUE(last);
  EXPECT_GT(last->Region.Radius, 0.3) << "one that presses gets what it presses on";
}
