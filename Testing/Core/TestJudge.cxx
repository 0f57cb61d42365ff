// The judge is judged: hand-made ways that cross, are held by nothing or are stuck have to be
// found, and good ones have to be let go.
#include "AnalyticSurfaces.h"
#include "BallTrial.h"
#include "ExactSigns.h"
#include "Judge.h"
#include "Trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
Judge JudgeOf(const TriangleMesh& mesh, bool hasBack)
{
  return Judge(mesh.Points, mesh.Triangles, std::vector<bool>(mesh.Triangles.size(), hasBack));
}

/// A triangle in z = 0 facing +z.
TriangleMesh OneTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  TriangleMesh mesh;
  mesh.Points = { a, b, c };
  mesh.Triangles = { { 0, 1, 2 } };
  return mesh;
}

/// Where cases are put: other sizes and places, all exact in float64 for numbers of few digits.
struct Put
{
  const char* Name;
  double Scale;
  Vec3 By;
  Vec3 operator()(const Vec3& x) const { return this->By + this->Scale * x; }
  TriangleMesh operator()(TriangleMesh mesh) const
  {
    for (Vec3& p : mesh.Points)
    {
      p = (*this)(p);
    }
    return mesh;
  }
};
// 2^-20 and 2^20: about a millionth and a million.
const Put Places[] = { { "Here", 1.0, {} }, { "Tiny", 0x1p-20, {} }, { "Huge", 0x1p20, {} },
  { "FarAway", 1.0, { 5e5, 4e6, 128 } } };
}

TEST(ExactSigns, AgreeWithRationalsWhereFloat64IsLost)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int zeros = 0;
  for (int i = 0; i < 6000; ++i)
  {
    const double scale = std::array<double, 5>{ 1e-6, 1.0, 1e6, 1e69, 1e-60 }[i % 5];
    const Vec3 offset = i % 3 == 0 ? Vec3{ 5e5 * scale, 4e6 * scale, 100 * scale } : Vec3{};
    std::array<Vec3, 4> p;
    for (Vec3& x : p)
    {
      x = offset + scale * Vec3{ place(random), place(random), place(random) };
    }
    // In the plane of the others, up to rounding; often a corner or on an edge.
    const double s = i % 7 == 0 ? 0.0 : place(random);
    const double t = i % 11 == 0 ? 0.0 : place(random);
    p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
    const int sign = SignOfVolumeByRationals(p[0], p[1], p[2], p[3]);
    ASSERT_EQ(SignOfVolume(p[0], p[1], p[2], p[3]), sign) << i;
    // Any order of the corners, with the sign of the permutation.
    ASSERT_EQ(SignOfVolume(p[1], p[0], p[2], p[3]), -sign) << i;
    ASSERT_EQ(SignOfVolume(p[3], p[0], p[2], p[1]), sign) << i;
    zeros += sign == 0;
  }
  EXPECT_GT(zeros, 50);
  EXPECT_LT(zeros, 3000);
}

TEST(ExactSigns, AreRightWhereProductsUnderflow)
{
  const double tiny = 0x1p-600;
  EXPECT_EQ(SignOfVolume({ 0, 0, 0 }, { tiny, 0, 0 }, { 0, tiny, 0 }, { 0, 0, tiny }), 1);
  EXPECT_EQ(SignOfVolume({ 0, 0, 0 }, { tiny, 0, 0 }, { 0, tiny, 0 }, { 0, 0, -tiny }), -1);
  EXPECT_EQ(SignOfVolume({ 0, 0, 0 }, { tiny, 0, 0 }, { 0, tiny, 0 }, { tiny, tiny, 0 }), 0);
  const double huge = 0x1p1000;
  EXPECT_EQ(SignOfVolume({ 0, 0, 0 }, { huge, 0, 0 }, { 0, huge, 0 }, { huge, 0, huge }), 1);
}

TEST(ExactSigns, SegmentsMeetClosedTriangles)
{
  const Vec3 a{ 0, 0, 0 }, b{ 4, 0, 0 }, c{ 0, 4, 0 };
  const auto meets = [&](const Vec3& p, const Vec3& q) { return SegmentMeets(p, q, a, b, c); };
  EXPECT_TRUE(meets({ 1, 1, 1 }, { 1, 1, -1 }));
  EXPECT_TRUE(meets({ 2, 2, 1 }, { 2, 2, -1 })); // an edge
  EXPECT_TRUE(meets({ 0, 0, 1 }, { 0, 0, -1 })); // a corner
  EXPECT_TRUE(meets({ 1, 1, 1 }, { 1, 1, 0 }));  // ends on it
  EXPECT_FALSE(meets({ 3, 3, 1 }, { 3, 3, -1 }));
  EXPECT_FALSE(meets({ 1, 1, 2 }, { 1, 1, 1 }));
  // Within the plane.
  EXPECT_TRUE(meets({ -1, 1, 0 }, { 5, 1, 0 }));
  EXPECT_TRUE(meets({ 1, 1, 0 }, { 1.5, 1, 0 }));
  EXPECT_TRUE(meets({ -1, 0, 0 }, { 9, 0, 0 }));  // along an edge
  EXPECT_TRUE(meets({ -1, -1, 0 }, { 1, 1, 0 })); // through a corner
  EXPECT_TRUE(meets({ -1, 1, 0 }, { 1, -1, 0 })); // a corner alone
  EXPECT_TRUE(meets({ 1, 1, 0 }, { 1, 1, 0 }));   // a point
  EXPECT_FALSE(meets({ 5, 0, 0 }, { 9, 0, 0 }));  // on an edge's line
  EXPECT_FALSE(meets({ -1, 0.5, 0 }, { 1, -1, 0 }));
  EXPECT_FALSE(meets({ 4, 4, 0 }, { 4, 4, 0 }));
  EXPECT_TRUE(HasNoArea(a, b, { 2, 0, 0 }));
  EXPECT_TRUE(HasNoArea(a, a, c));
  EXPECT_FALSE(HasNoArea(a, b, { 2, 0x1p-52, 0 }));
}

TEST(Judge, FindsCrossingsOfFacesEdgesAndCorners)
{
  for (const Put& put : Places)
  {
    // Four triangles around a corner at 0, closed on each other.
    TriangleMesh mesh;
    mesh.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 } };
    mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
    for (const bool hasBack : { false, true })
    {
      const Judge judge = JudgeOf(put(mesh), hasBack);
      for (const Vec3& at :
        { Vec3{ 0.25, 0.25, 0 }, Vec3{ 0.5, 0, 0 }, Vec3{ 0, -0.25, 0 }, Vec3{} })
      {
        const Vec3 above = put(at + Vec3{ 0, 0, 0.5 });
        const Vec3 below = put(at - Vec3{ 0, 0, 0.5 });
        EXPECT_TRUE(judge.Crosses(above, below));
        EXPECT_TRUE(judge.Crosses(above, put(at))) << "to end on it is to cross it";
        EXPECT_EQ(judge.Crosses(below, above), hasBack) << "out of a solid the way is free";
        EXPECT_EQ(judge.Crosses(put(at), below), !hasBack);
        EXPECT_FALSE(judge.Crosses(put(at), above));
        EXPECT_FALSE(judge.Crosses(above, put(at + Vec3{ 0, 0, 0x1p-20 })));
      }
      // Aslant through the corner, and past all.
      EXPECT_TRUE(judge.Crosses(put({ -0.5, -0.25, 0.5 }), put({ 0.5, 0.25, -0.5 })));
      EXPECT_FALSE(judge.Crosses(put({ 2, 0, 0.5 }), put({ 1.125, 0, -0.5 })));
    }
  }
}

TEST(Judge, FindsCrossingsOfNeedlesAsThinAsRounding)
{
  for (const Put& put : Places)
  {
    if (put.By != Vec3{})
    {
      continue; // rounding is as wide as 2^-31 there
    }
    // Of height 2^-52 at the middle: an outline of one rounding.
    const Judge needle =
      JudgeOf(put(OneTriangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0x1p-52, 0 })), true);
    const auto crosses = [&](double y) {
      return needle.Crosses(put({ 0.5, y, 0.25 }), put({ 0.5, y, -0.25 }));
    };
    EXPECT_TRUE(crosses(0.0));
    EXPECT_TRUE(crosses(0x1p-53));
    EXPECT_TRUE(crosses(0x1p-52));
    EXPECT_FALSE(crosses(0x1p-51));
    EXPECT_FALSE(crosses(-0x1p-70));
  }
  // Of three points on a line, rounded: aimed at with exact arithmetic, in any place.
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int needles = 0;
  for (int i = 0; i < 500; ++i)
  {
    const auto point = [&] { return Vec3{ normal(random), normal(random), normal(random) }; };
    const Vec3 offset = i % 2 ? Vec3{ 5e5, 4e6, 100 } : Vec3{};
    const Vec3 a = offset + point();
    const Vec3 b = offset + point();
    const Vec3 c = a + share(random) * (b - a);
    if (HasNoArea(a, b, c))
    {
      continue;
    }
    ++needles;
    // Through a corner, hence through the triangle, whatever the direction: exact where the way is
    // the same on both sides of it.
    const Vec3 d{ std::ldexp(std::round(normal(random) * 64), -16),
      std::ldexp(std::round(normal(random) * 64), -16),
      std::ldexp(1.0 + std::round(share(random) * 64), -16) };
    const Vec3 from = c + d;
    const Vec3 to = c - d;
    const bool isExact = from - c == d && c - to == d;
    const bool hasSides = SignOfVolumeByRationals(a, b, c, from) != 0;
    if (isExact && hasSides)
    {
      EXPECT_TRUE(JudgeOf(OneTriangle(a, b, c), true).Crosses(from, to)) << i;
    }
  }
  EXPECT_GT(needles, 300);
}

TEST(Judge, DistinguishesAWayWithinATrianglesPlaneFromACrossing)
{
  for (const Put& put : Places)
  {
    const Judge both = JudgeOf(put(OneTriangle({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 })), true);
    const auto graze = [&](const Vec3& p, const Vec3& q)
    { return both.FindGrazed(put(p), put(q)) != Judge::Nothing; };
    EXPECT_TRUE(graze({ -1, 1, 0 }, { 1, 1, 0 }));
    EXPECT_TRUE(graze({ -1, 1, 0 }, { 8, 1, 0 }));
    EXPECT_FALSE(graze({ -1, 1, 0 }, { -1, 4, 0 }));
    EXPECT_FALSE(graze({ -1, 1, 0 }, { 1, 1, 0x1p-20 }));
    EXPECT_FALSE(both.Crosses(put({ -1, 1, 0 }), put({ 1, 1, 0 })));
    // Onto a facet of one side and then behind it is a crossing of the second piece.
    const Judge front = JudgeOf(put(OneTriangle({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 })), false);
    EXPECT_EQ(front.FindGrazed(put({ -1, 1, 0 }), put({ 1, 1, 0 })), Judge::Nothing);
    EXPECT_TRUE(front.Crosses(put({ 1, 1, 0 }), put({ 1, 1, -1 })));
  }
}

TEST(Judge, LooksAtEveryTriangleOfASoup)
{
  const TriangleMesh soup = Soup(600, 0.3, 5);
  const Judge judge = JudgeOf(soup, true);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-1.3, 1.3);
  int crossings = 0;
  int views = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const Vec3 from{ place(random), place(random), place(random) };
    const double reach = i % 2 ? 1.0 : 0.05;
    const Vec3 to = from + reach * Vec3{ place(random), place(random), place(random) };
    const bool isMet = std::any_of(soup.Triangles.begin(), soup.Triangles.end(),
      [&](const Triangle& t)
      { return SegmentMeets(from, to, soup.Points[t[0]], soup.Points[t[1]], soup.Points[t[2]]); });
    ASSERT_EQ(judge.Crosses(from, to), isMet) << i;
    const bool isPlain = judge.IsInPlainView(to, from);
    ASSERT_FALSE(isPlain && isMet) << i;
    crossings += isMet;
    views += isPlain;
  }
  EXPECT_GT(crossings, 500);
  EXPECT_GT(views, 500);
}

TEST(Judge, SeesPlainlyWhereTheConeIsEmpty)
{
  for (const Put& put : Places)
  {
    const Vec3 eye = put({ 0, 0, 1 });
    const Vec3 goal = put({ 0, 0, -1 });
    const auto sees = [&](const TriangleMesh& mesh, bool hasBack)
    { return JudgeOf(put(mesh), hasBack).IsInPlainView(goal, eye); };
    // A plate whose edge is at x next to the axis, at half way: the cone's radius is 1e-3 there.
    const auto plate = [](double x) { return OneTriangle({ x, -9, 0 }, { 9, 0, 0 }, { x, 9, 0 }); };
    EXPECT_FALSE(sees(plate(-1.0), true));
    EXPECT_FALSE(sees(plate(0.0), true));
    EXPECT_FALSE(sees(plate(0.0009765625), true));    // 2^-10, within
    EXPECT_TRUE(sees(plate(0.00103759765625), true)); // 17 * 2^-14, 4 % outside
    EXPECT_FALSE(sees(plate(-1.0), false)) << "faces the eye";
    EXPECT_TRUE(sees(InsideOut(plate(-1.0)), false)) << "seen from behind";
    EXPECT_FALSE(sees(InsideOut(plate(-1.0)), true));
    // Only a corner, or all of a triangle, within the cone.
    EXPECT_FALSE(sees(OneTriangle({ 0x1p-11, 0, 0 }, { 9, -1, 0 }, { 9, 1, 0 }), true));
    EXPECT_FALSE(
      sees(OneTriangle({ 0x1p-11, 0, 0 }, { 0x1.8p-11, 0, 0 }, { 0x1p-11, 0x1p-12, 0 }), true));
    // Beyond the goal, and behind the eye.
    EXPECT_TRUE(sees(Moved(plate(-1.0), { 0, 0, -1.25 }), true));
    EXPECT_TRUE(sees(Moved(plate(-1.0), { 0, 0, 1.25 }), true));
    // Between two walls nearer than the cone is wide, and farther.
    const auto slot = [](double half)
    {
      return Joined(OneTriangle({ half, -9, -9 }, { half, 9, 0 }, { half, -9, 9 }),
        OneTriangle({ -half, -9, -9 }, { -half, -9, 9 }, { -half, 9, 0 }));
    };
    // A tube of roundings about the way to a near goal, next to a wall.
    const Judge wall = JudgeOf(put(plate(0x1p-11)), true);
    const double scale = put.Scale;
    const Vec3 near = put({ 0, 0, 0.0625 });
    const Vec3 under = put({ 0, 0, -0.0625 });
    EXPECT_TRUE(wall.IsInView(under, near, 0.0, 0x1p-12 * scale));
    EXPECT_TRUE(wall.IsInView(under, near, 0.0, 0.0));
    EXPECT_FALSE(wall.IsInView(under, near, 0.0, 0x1p-10 * scale));
    EXPECT_TRUE(wall.IsInPlainView(under, near));
    EXPECT_FALSE(wall.IsInPlainView(under, near, 0x1p-10 * scale));
    EXPECT_FALSE(sees(slot(0x1p-10), true));
    EXPECT_TRUE(sees(slot(0x1p-8), true));
  }
}

namespace
{
/// Followers made by hand.
class HandMade : public Follower
{
public:
  using Rule = std::function<std::vector<Vec3>(const Vec3& now, const Vec3& hip)>;
  explicit HandMade(Rule rule)
    : Next(std::move(rule))
  {
  }
  Vec3 Place(const Vec3& position) override { return this->Now = position; }
  const std::vector<Vec3>& Follow(const Vec3& hip, Vec3& goal) override
  {
    goal = hip;
    this->Corners = this->Next(this->Now, hip);
    this->Now = this->Corners.back();
    return this->Corners;
  }

private:
  Rule Next;
  Vec3 Now{};
  std::vector<Vec3> Corners;
};

const auto GoesStraight = [](const Vec3& now, const Vec3& hip) {
  return std::vector<Vec3>{ now, hip };
};
const auto Stays = [](const Vec3& now, const Vec3&) { return std::vector<Vec3>{ now }; };

/// What a trial of a follower over a plate at z = 0 finds.
class TrialOverAPlate : public ::testing::TestWithParam<Put>
{
protected:
  Trial Make(Follower& follower, Follower& probe, int pressEvery = 0)
  {
    const Put put = GetParam();
    Trial::Settings settings;
    settings.Clearance = 1e-6 * put.Scale;
    settings.PressEvery = pressEvery;
    const auto judge = std::make_shared<Judge>(JudgeOf(put(Square(1.0, 2)), true));
    return Trial({ { judge, {}, 0.0 } }, follower, probe, settings);
  }
  Vec3 At(double x, double y, double z) const { return GetParam()({ x, y, z }); }
};
}

TEST_P(TrialOverAPlate, FindsCrossings)
{
  HandMade ghost(GoesStraight);
  Trial trial = this->Make(ghost, ghost);
  std::vector<Finding> findings;
  trial.OnFault = [&](const Finding& finding) { findings.push_back(finding); };
  trial.Place(this->At(0.125, 0.25, 1));
  for (const double z : { 0.5, 0.25, -0.25, -0.5, 0.5 }) // through, and back
  {
    trial.Tick(this->At(0.125, 0.25, z));
  }
  EXPECT_EQ(trial.Count()[Fault::Crossing], 2);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0].From, this->At(0.125, 0.25, 0.25));
  EXPECT_EQ(findings[0].To, this->At(0.125, 0.25, -0.25));
  // Through an edge that two share, and the corner of all.
  trial.Place(this->At(0.5, 0, 1));
  trial.Tick(this->At(0.5, 0, -1));
  trial.Place(this->At(0, 0, 1));
  trial.Tick(this->At(0, 0, -1));
  EXPECT_EQ(trial.Count()[Fault::Crossing], 4);
  EXPECT_EQ(trial.Count()[Fault::Phantom], 0);
}

TEST_P(TrialOverAPlate, FindsWaysThatDoNotJoinOrGoAway)
{
  HandMade jumper([](const Vec3&, const Vec3& hip) { return std::vector<Vec3>{ hip, hip }; });
  Trial jumps = this->Make(jumper, jumper);
  jumps.Place(this->At(0, 0, 1));
  jumps.Tick(this->At(0, 0, 0.5));
  EXPECT_EQ(jumps.Count()[Fault::Gap], 0) << "the first way starts anywhere";
  jumps.Tick(this->At(0, 0, 0.25));
  EXPECT_EQ(jumps.Count()[Fault::Gap], 1);

  const Vec3 far = this->At(0, 0, 2);
  HandMade away([&](const Vec3& now, const Vec3&) { return std::vector<Vec3>{ now, far }; });
  Trial leads = this->Make(away, away);
  leads.Place(this->At(0, 0, 1));
  leads.Tick(this->At(0, 0, 0.5));
  EXPECT_EQ(leads.Count()[Fault::Away], 1);
}

TEST_P(TrialOverAPlate, FindsPhantomsAndLetsGoWhatIsLate)
{
  HandMade glued(Stays);
  Trial trial = this->Make(glued, glued);
  trial.Place(this->At(0, 0, 0.5));
  trial.Tick(this->At(0, 0, -0.5)); // held by the plate: no phantom
  EXPECT_EQ(trial.Count()[Fault::Phantom], 0);
  trial.Tick(this->At(0.5, 0, 0.75)); // held by nothing
  EXPECT_EQ(trial.Count()[Fault::Phantom], 1);
  EXPECT_EQ(trial.Count().Views, 2);

  int ticks = 0;
  HandMade late([&](const Vec3& now, const Vec3& hip)
    { return ++ticks % 4 == 0 ? GoesStraight(now, hip) : Stays(now, hip); });
  Trial patient = this->Make(late, late);
  patient.Place(this->At(0, 0, 0.5));
  patient.Tick(this->At(0.5, 0, 0.75));
  EXPECT_EQ(patient.Count()[Fault::Phantom], 0);
  EXPECT_EQ(patient.Count().Ticks, 4);

  // Next to an edge of the plate, where only growth could hold it; and within the cone of it.
  trial.Place(this->At(1.25, 0, 0.5));
  trial.Tick(this->At(1.25, 0, -0.5));
  EXPECT_EQ(trial.Count()[Fault::Phantom], 2);
  trial.Place(this->At(1.0 + 0x1p-12, 0, 0.5));
  trial.Tick(this->At(1.0 + 0x1p-12, 0, -0.5));
  EXPECT_EQ(trial.Count()[Fault::Phantom], 2);
  // As near as clearances go.
  HandMade near(
    [&](const Vec3& now, const Vec3& hip) {
      return std::vector<Vec3>{ now, hip + Vec3{ 0, 0, 15e-6 * GetParam().Scale } };
    });
  Trial close = this->Make(near, near);
  close.Place(this->At(0, 0, 0.5));
  close.Tick(this->At(0, 0, 0.25));
  EXPECT_EQ(close.Count()[Fault::Phantom], 0);
}

TEST_P(TrialOverAPlate, FindsStuckTicks)
{
  const auto comes = [&](double share)
  {
    return [share](const Vec3& now, const Vec3& hip) {
      return std::vector<Vec3>{ now, now + share * (hip - now) };
    };
  };
  const auto count = [&](HandMade::Rule rule)
  {
    HandMade stuck(Stays);
    HandMade probe(std::move(rule));
    Trial trial = this->Make(stuck, probe, 1);
    trial.Place(this->At(0.25, 0.125, 0.5));
    trial.Tick(this->At(0.25, 0.125, -0.5));
    EXPECT_EQ(trial.Count().Presses, 1);
    EXPECT_EQ(trial.Count()[Fault::Phantom], 0);
    EXPECT_EQ(trial.Count()[Fault::Crossing], 0);
    return trial.Count()[Fault::Stuck];
  };
  EXPECT_EQ(count(Stays), 0) << "comes no nearer: held for good";
  EXPECT_EQ(count(comes(0.1)), 1);
  EXPECT_EQ(count(comes(0.004)), 0) << "1.6 % in four ticks is not more than 2 %";
  EXPECT_EQ(count(comes(0.006)), 1);
  // Nearer in five of six ways, and in four.
  for (const int missed : { 1, 2 })
  {
    int ticks = 0;
    EXPECT_EQ(count([&](const Vec3& now, const Vec3& hip)
                { return ticks++ / 4 < missed ? Stays(now, hip) : comes(0.1)(now, hip); }),
      missed == 1 ? 1 : 0);
  }
}

TEST_P(TrialOverAPlate, DistinguishesStuckFromBalancing)
{
  const auto faults = [&](const Vec3& from, const Vec3& hip, const Vec3& pressed)
  {
    HandMade stuck(Stays);
    HandMade probe([&](const Vec3& now, const Vec3&) { return std::vector<Vec3>{ now, pressed }; });
    Trial trial = this->Make(stuck, probe, 1);
    trial.Place(from);
    trial.Tick(hip);
    EXPECT_EQ(trial.Count().Presses, 1);
    return std::array<long, 2>{ trial.Count()[Fault::Stuck], trial.Count()[Fault::Balance] };
  };
  // The HIP in the plate's very plane, the point before its rim: nearer is only around the rim.
  const double e = 0x1p-20;
  EXPECT_EQ(faults(this->At(1.0 + e, 0.25, 0), this->At(0.5, 0.25, 0), this->At(0.75, 0.25, e)),
    (std::array<long, 2>{ 0, 1 }));
  // Over the plate, the HIP straight below; a way along the plate leads away.
  EXPECT_EQ(
    faults(this->At(0.5, 0.25, e), this->At(0.5, 0.25, -0.5), this->At(0.5, 0.25, -0.25))[0], 0);
  // The HIP below and aside.
  EXPECT_EQ(faults(this->At(0.5, 0.25, e), this->At(0.75, 0.25, -0.5), this->At(0.75, 0.25, e)),
    (std::array<long, 2>{ 1, 0 }));
  // Over a rim: off the plate it goes down.
  EXPECT_EQ(faults(this->At(1.0, 0.25, e), this->At(1.25, 0.25, -0.5), this->At(1.25, 0.25, -0.5)),
    (std::array<long, 2>{ 1, 0 }));
}

TEST_P(TrialOverAPlate, StartsOnNoTriangle)
{
  HandMade glued(Stays);
  Trial trial = this->Make(glued, glued);
  EXPECT_FALSE(trial.Place(this->At(0.125, 0.25, 0)));
  EXPECT_FALSE(trial.Place(this->At(1, 0.25, 0))) << "its edge is of it";
  EXPECT_FALSE(trial.Place(this->At(1, 1, 0)));
  EXPECT_TRUE(trial.Place(this->At(1.25, 1, 0)));
  EXPECT_TRUE(trial.Place(this->At(0.125, 0.25, 0x1p-20)));
}

TEST_P(TrialOverAPlate, TakesACrossingProbeForACrossing)
{
  HandMade stuck(Stays);
  HandMade ghost(GoesStraight);
  Trial trial = this->Make(stuck, ghost, 1);
  trial.Place(this->At(0.25, 0.125, 0.5));
  trial.Tick(this->At(0.25, 0.125, -0.5));
  EXPECT_GT(trial.Count()[Fault::Crossing], 0);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, TrialOverAPlate, ::testing::ValuesIn(Places),
  [](const auto& info) { return std::string(info.param.Name); });

TEST(Trial, FindsNoFaultWithAGodObjectOnAPlaneABallAndInACorner)
{
  for (const TriangleMesh& mesh : { Square(0.03, 4), Icosphere(3, 0.03), InsideCorner(0.03),
         Moved(Icosphere(3, 0.03), { 5e5, 4e6, 1e2 }) })
  {
    const std::vector<TouchedSurface> surfaces{ MakeSurface(mesh, Side::Front) };
    GodObjectFollower god(surfaces);
    GodObjectFollower probe(surfaces);
    Trial::Settings settings = Trial::SettingsOf(surfaces);
    settings.PressEvery = 1;
    Trial trial(Trial::PartsOf(surfaces), god, probe, settings);
    trial.Place({ 0.001, 0.002, 0.035 });
    for (int i = 0; i < 300; ++i)
    {
      const double t = 0.02 * i;
      trial.Tick(
        { 0.001 + 0.01 * std::sin(t), 0.002 + 0.01 * std::sin(1.7 * t), -0.03 * std::sin(3 * t) });
    }
    EXPECT_GT(trial.Count().Contacts, 50);
    EXPECT_GT(trial.Count().Presses, 20);
    for (int fault = 0; fault < static_cast<int>(Fault::NumberOfFaults); ++fault)
    {
      EXPECT_EQ(trial.Count()[static_cast<Fault>(fault)], 0) << NameOf(static_cast<Fault>(fault));
    }
  }
}

// A box of 2 m, whose faces lie at 1 m, and ways of the centre of a ball of 0.25 m along its top.
struct BallWay
{
  const char* Name;
  std::vector<Vec3> Corners;
  long Overlaps;
  long Crossings;
};

class JudgeOfBalls : public ::testing::TestWithParam<BallWay>
{
};

TEST_P(JudgeOfBalls, FindsWhatOverlapsAndWhatCrosses)
{
  std::string error;
  const auto box = TriangleSurface::Build(Box(1.0, 1.0, 1.0, 4), SurfaceOptions(), error);
  ASSERT_TRUE(box) << error;
  BallTrial trial({ box }, 0.25, 0);
  const std::vector<Vec3>& way = GetParam().Corners;
  trial.JudgeWay(way.data(), static_cast<int>(way.size()), 0.25, way.back());
  EXPECT_EQ(trial.Count().Pieces, static_cast<long>(way.size()) - 1);
  EXPECT_EQ(trial.Count().Overlaps, GetParam().Overlaps);
  EXPECT_EQ(trial.Count().Crossings, GetParam().Crossings);
}

INSTANTIATE_TEST_SUITE_P(Ways, JudgeOfBalls,
  ::testing::Values(BallWay{ "AlongAFace", { { -0.5, 0.1, 1.25 }, { 0.5, 0.1, 1.25 } }, 0, 0 },
    BallWay{ "DipsTowardsAFace",
      { { -0.5, 0.1, 1.25 }, { 0.0, 0.1, 1.25 - 1e-6 }, { 0.5, 0.1, 1.25 } }, 1, 0 },
    // At 45 degrees over an edge, 0.25 m away from that is 0.1767767 m outwards of both its faces.
    BallWay{
      "PastAnEdge", { { 1.1767767, -2.0, 1.1767767 }, { 1.1767767, 2.0, 1.1767767 } }, 0, 0 },
    BallWay{ "TooNearToAnEdge", { { 1.17677, -2.0, 1.17677 }, { 1.17677, 2.0, 1.17677 } }, 1, 0 },
    BallWay{ "CutsAnEdgeBetweenItsEnds", { { 0.5, 0.1, 1.25 }, { 1.25, 0.1, 0.5 } }, 1, 1 },
    // A corner is 0.25 m from (1, 1, 1) + 0.1443376 (1, 1, 1).
    BallWay{ "TouchesACorner", { { 1.1443376, 1.1443376, 1.1443376 }, { 1.5, 1.5, 1.5 } }, 0, 0 },
    BallWay{ "TooNearToACorner", { { 1.14433, 1.14433, 1.14433 }, { 1.5, 1.5, 1.5 } }, 1, 0 },
    BallWay{ "ThroughAFace", { { 0.1, 0.2, 1.25 }, { 0.1, 0.2, 0.5 } }, 1, 1 },
    BallWay{ "OutThroughABack", { { 0.1, 0.2, 0.5 }, { 0.1, 0.2, 1.5 } }, 0, 0 }),
  [](const ::testing::TestParamInfo<BallWay>& info) { return std::string(info.param.Name); });
