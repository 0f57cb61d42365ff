// Patches of a surface, in place of the whole. Lengths are metres.
#include "AnalyticSurfaces.h"
#include "ProfileSurfaces.h"
#include "SurfaceInPatches.h"
#include "haptics/Contact/GodObject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

using namespace haptics;
using namespace haptics::testing;

namespace
{
/// A god-object on patches that follow it and the HIP: all within `radius`, and as far as it lags
/// behind, exchanged when half of that is used up.
class Follower
{
public:
  Follower(const SurfaceInPatches& source, double radius, std::vector<TouchedSurface> others = {})
    : From(source)
    , Radius(radius)
    , Others(std::move(others))
  {
  }

  const Contact& Update(const Vec3& hip)
  {
    const double lag = this->God ? Length(hip - this->God->Current().Position) : 0.0;
    if (!this->God || Length(hip - this->Centre) + lag - this->Lag > 0.5 * this->Radius)
    {
      this->Exchange(hip);
    }
    return this->God->Update(hip);
  }

  void Exchange(const Vec3& centre)
  {
    const Vec3 here = this->God ? this->God->Current().Position : centre;
    this->Lag = Length(here - centre);
    std::vector<TouchedSurface> list{ this->From.Patch(
      { here, centre, this->Radius + this->Lag }) };
    list.front().Identity = 1;
    list.insert(list.end(), this->Others.begin(), this->Others.end());
    auto next = std::make_unique<GodObject>(std::move(list));
    if (this->God)
    {
      this->AreSeamless = next->Continue(*this->God) && this->AreSeamless;
      ++this->Exchanges;
    }
    this->God = std::move(next);
    this->Centre = centre;
  }

  const TriangleSurface& Surface() const { return *this->God->Surfaces().front().Surface; }

  std::unique_ptr<GodObject> God;
  int Exchanges = 0;
  bool AreSeamless = true;

private:
  const SurfaceInPatches& From;
  double Radius;
  std::vector<TouchedSurface> Others;
  Vec3 Centre{};
  double Lag = 0.0; ///< of the god-object behind the HIP, then
};

/// Pressing strokes to and fro over the top of RoughBlock().
std::vector<Vec3> Strokes(double speed, double depth, int ticks)
{
  std::vector<Vec3> path;
  const double way = 0.09;
  for (int i = 0; i < ticks; ++i)
  {
    const double s = std::fmod(1e-3 * speed * i / way, 2.0);
    const double x = (s < 1.0 ? s : 2.0 - s) * way - 0.5 * way;
    path.push_back({ x, 0.03 * std::sin(0.0011 * i), i < 100 ? 0.01 - 1e-4 * i : -depth });
  }
  return path;
}
}

TEST(Patches, HaveFrameClearanceAndSideOfTheWhole)
{
  const SurfaceInPatches source(Moved(Icosphere(4, 0.05), { 100.0, 20.0, 3.0 }));
  const SurfacePointer patch = source.Ball({ 100.05, 20.0, 3.0 }, 0.01);
  const TriangleSurface& whole = *source.Whole();
  EXPECT_LT(patch->Triangles().size(), whole.Triangles().size() / 8);
  EXPECT_EQ(patch->Origin(), whole.Origin());
  EXPECT_EQ(patch->Radius(), whole.Radius());
  EXPECT_EQ(patch->Diagonal(), whole.Diagonal());
  EXPECT_EQ(patch->Clearance(), whole.Clearance());
  EXPECT_EQ(patch->TouchedSide(), Side::Front) << "the patch is open, the surface is closed";
  EXPECT_TRUE(patch->Report().Closed);
  EXPECT_EQ(patch->Whole(), whole.Whole());
  EXPECT_FALSE(whole.Patch());
  for (std::size_t i = 0; i < patch->Triangles().size(); ++i)
  {
    const std::int64_t id = patch->Patch()->IdOf(static_cast<std::int32_t>(i));
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(patch->Points()[patch->Triangles()[i][k]],
        whole.Points()[whole.Triangles()[static_cast<std::size_t>(id)][k]]);
    }
  }
}

TEST(Patches, OfAnOpenSurfaceAreTouchedFromBothSides)
{
  const SurfaceInPatches source(Square(0.05, 40));
  EXPECT_EQ(source.Ball({ 0.0, 0.0, 0.0 }, 0.01)->TouchedSide(), Side::Both);
}

TEST(Patches, AreRefusedWithoutIdsOrSize)
{
  SurfaceOptions options;
  options.Whole = std::make_shared<const WholeSurface>(MakeSurface(Square(0.05))->Whole());
  std::string error;
  options.Region.Radius = 0.01;
  EXPECT_FALSE(TriangleSurface::Build(Square(0.05), options, error));
  EXPECT_EQ(error, "0 ids were given for 2 triangles of a patch");
  options.Region.Radius = 0.0;
  EXPECT_FALSE(TriangleSurface::Build({}, options, error));
  EXPECT_EQ(error, "a patch needs the radius of its surface, and one of its own, above 0");
}

TEST(Patches, AStrokeIsAsOnTheWholeSurface)
{
  const SurfaceInPatches source(RoughBlock(90));
  for (const double speed : { 0.05, 0.3, 1.0 })
  {
    GodObject whole({ source.Whole() });
    Follower follower(source, 0.02);
    double farthest = 0.0;
    int otherBits = 0;
    int touching = 0;
    for (const Vec3& hip : Strokes(speed, 0.004, 2000))
    {
      const Contact& expected = whole.Update(hip);
      const Contact& found = follower.Update(hip);
      ASSERT_FALSE(found.AwaitsData);
      farthest = std::max(farthest, Length(found.Position - expected.Position));
      otherBits += found.Position == expected.Position ? 0 : 1;
      ASSERT_EQ(found.NumberOfConstraints, expected.NumberOfConstraints);
      touching += found.NumberOfConstraints > 0 ? 1 : 0;
      for (int i = 0; i < found.NumberOfConstraints; ++i)
      {
        EXPECT_EQ(follower.Surface().Patch()->IdOf(found.Constraints[i].Triangle),
          expected.Constraints[i].Triangle);
      }
    }
    EXPECT_GT(touching, 1500);
    EXPECT_GT(follower.Exchanges, 8);
    EXPECT_TRUE(follower.AreSeamless);
    // What the engine proposes beyond what is asked decides when a ball is gathered anew, and so
    // the last bits.
    EXPECT_LT(farthest, 1e-12) << "at " << speed << " m/s";
    std::printf("[ MEASURED ] %g m/s: %d exchanges, other bits in %d ticks, by %g m\n", speed,
      follower.Exchanges, otherBits, farthest);
  }
}

TEST(Patches, AnExchangeChangesNoBit)
{
  const SurfaceInPatches source(RoughBlock(80));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 8; ++trial)
  {
    const Vec3 start{ 0.03 * any(random), 0.03 * any(random), 0.0 };
    Follower still(source, 0.02);
    Follower exchanged(source, 0.02);
    still.Exchange(start);
    exchanged.Exchange(start);
    Vec3 hip = start + Vec3{ 0.0, 0.0, 0.01 };
    for (int i = 0; i < 200; ++i)
    {
      hip = hip + 2e-5 * Vec3{ any(random), any(random), i < 120 ? -5.0 : 0.3 * any(random) };
      if (i > 20 && i % 7 == 0)
      {
        exchanged.Exchange(hip + 0.003 * Vec3{ any(random), any(random), any(random) });
      }
      const Contact& expected = still.God->Update(hip);
      const Contact& found = exchanged.God->Update(hip);
      ASSERT_FALSE(expected.AwaitsData);
      ASSERT_EQ(found.Position, expected.Position) << "trial " << trial << ", tick " << i;
      ASSERT_EQ(found.Displacement, expected.Displacement);
      ASSERT_EQ(found.SurfaceDisplacement, Vec3{});
    }
    EXPECT_TRUE(exchanged.AreSeamless);
  }
}

TEST(Patches, NothingIsEnteredBeyondTheRim)
{
  const SurfaceInPatches source(RoughBlock(100));
  GodObject whole({ source.Whole() });
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int waiting = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    const Vec3 centre{ 0.04 * any(random), 0.04 * any(random), 0.002 };
    Follower follower(source, 0.012);
    follower.Exchange(centre);
    const SurfacePatch& patch = *follower.Surface().Patch();
    Vec3 hip = centre + Vec3{ 0.0, 0.0, 0.008 };
    follower.God->Update(hip);
    whole.Place(hip);
    for (int i = 0; i < 60; ++i)
    {
      // Anywhere, in leaps that also leave the patch and the surface.
      hip = centre + 0.03 * Vec3{ any(random), any(random), any(random) };
      const Contact& contact = follower.God->Update(hip);
      EXPECT_EQ(contact.Hip, hip);
      waiting += contact.AwaitsData ? 1 : 0;
      const Vec3 local = contact.Position - source.Whole()->Origin();
      ASSERT_LE(patch.Region().DistanceTo(local), 0.012);
      // The way that it has gone is free on the whole surface too.
      const Contact& there = whole.Update(contact.Position);
      ASSERT_LT(Length(there.Position - contact.Position), 1e-9) << "trial " << trial << ", " << i;
    }
  }
  EXPECT_GT(waiting, 1000);
}

TEST(Patches, WaitAtTheRimAndGoOnWhereTheNextOneComes)
{
  const SurfaceInPatches source(RoughBlock(100));
  Follower follower(source, 0.012);
  follower.Exchange({ 0.0, 0.0, 0.0 });
  GodObject whole({ source.Whole() });
  Vec3 hip{ 0.0, 0.0, 0.006 };
  for (int i = 0; i < 100; ++i)
  {
    hip[2] -= 8e-5;
    follower.God->Update(hip);
    whole.Update(hip);
  }
  Contact last{};
  int waits = 0;
  for (int i = 0; i < 200; ++i)
  {
    hip[0] += 1e-4;
    last = follower.God->Update(hip);
    const Contact& expected = whole.Update(hip);
    waits += last.AwaitsData ? 1 : 0;
    if (!last.AwaitsData)
    {
      EXPECT_LT(Length(last.Position - expected.Position), 1e-12);
    }
    EXPECT_LE(last.Penetration, 0.006) << "it is not pulled back";
  }
  EXPECT_GT(waits, 80);
  EXPECT_LT(waits, 170) << "most of the patch can be touched";
  // A patch that has god-object and hand: some ticks later it is where the whole has it.
  PatchRegion region{ last.Position, hip, 0.012 };
  auto next = std::make_unique<GodObject>(std::vector<TouchedSurface>{ source.Patch(region) });
  EXPECT_TRUE(next->Continue(*follower.God));
  for (int i = 0; i < 20; ++i)
  {
    last = next->Update(hip);
  }
  EXPECT_FALSE(last.AwaitsData);
  EXPECT_LT(Length(last.Position - whole.Update(hip).Position), 1e-4)
    << "over rough ground the way decides where it comes to rest";
}

TEST(Patches, OfNothingAreFreeSpace)
{
  const SurfaceInPatches source(RoughBlock(40));
  Follower follower(source, 0.01);
  const Vec3 above{ 0.0, 0.0, 0.05 };
  follower.Exchange(above);
  EXPECT_TRUE(follower.Surface().Triangles().empty());
  EXPECT_EQ(follower.God->Update(above).Status, UpdateStatus::Free);
  const Contact& gone = follower.God->Update({ 0.0, 0.0, -0.05 });
  EXPECT_TRUE(gone.AwaitsData);
  EXPECT_EQ(gone.Penetration, 0.0) << "and no force";
  EXPECT_LE(Length(gone.Position - above), 0.01);
}

TEST(Patches, OfAnotherVersionAreAnotherSurface)
{
  const SurfaceInPatches first(RoughBlock(60));
  const SurfaceInPatches second(RoughBlock(60));
  Follower follower(first, 0.01);
  follower.Exchange({ 0.0, 0.0, 0.0 });
  follower.God->Update({ 0.0, 0.0, 0.005 });
  follower.God->Update({ 0.0, 0.0, 0.0 });
  std::vector<TouchedSurface> list{ second.Ball({ 0.0, 0.0, 0.0 }, 0.01) };
  list.front().Identity = 1;
  GodObject next(std::move(list));
  EXPECT_FALSE(next.Continue(*follower.God)) << "the material may be another one";
}

TEST(Patches, ATipIsAsOnTheWholeSurface)
{
  const SurfaceInPatches source(RoughBlock(120));
  GodObject whole({ source.Whole() }, Tip::Ball);
  whole.SetTipRadius(0.001);
  std::unique_ptr<GodObject> god;
  Vec3 centre{};
  double farthest = 0.0;
  for (const Vec3& hip : Strokes(0.2, 0.003, 2000))
  {
    if (!god || Length(hip - centre) > 0.008)
    {
      centre = hip;
      auto next = std::make_unique<GodObject>(
        std::vector<TouchedSurface>{ source.Ball(hip, 0.02) }, Tip::Ball);
      next->SetTipRadius(0.001);
      EXPECT_TRUE(!god || next->Continue(*god));
      god = std::move(next);
    }
    const Vec3 expected = whole.Update(hip).Position;
    const Contact& found = god->Update(hip);
    ASSERT_FALSE(found.AwaitsData);
    farthest = std::max(farthest, Length(found.Position - expected));
  }
  EXPECT_LT(farthest, 1e-9);
}

/// A closed surface that is another one all at once, as in an animation that is scrubbed, has the
/// god-object where the whole one has it, however far it has gone past that, once a patch shows the
/// place. Until then it rests, and nothing is let in.
TEST(Patches, ASurfaceThatHasGonePastHasItsGodObjectWhereTheWholeHas)
{
  const Vec3 here{ 0.0522, 0.003, 0.001 }; // outside of the first ball
  const double radius = 0.005;
  const auto touch = [](const SurfacePointer& surface)
  {
    std::vector<TouchedSurface> list{ surface };
    list.front().Identity = 1;
    return std::make_unique<GodObject>(std::move(list));
  };
  const SurfaceInPatches first(Star(4, 0.05, 0.004, 3));
  int astray = 0;
  for (const double way : { 0.0, 0.004, 0.007, 0.02, 0.035, 0.05, 0.07, 0.12 })
  {
    SCOPED_TRACE(way);
    const SurfaceInPatches second(Moved(Star(4, 0.05, 0.004, 3), { way, 0.0002, 0.0 }));
    const auto expected = touch(second.Whole());
    {
      const auto before = touch(first.Whole());
      before->Update(here);
      expected->Continue(*before);
    }
    const auto before = touch(first.EnclosedPatch({ here, here, radius }, false));
    before->Update(here);
    auto god = touch(second.EnclosedPatch({ here, here, radius }, false));
    god->Continue(*before);
    if (god->Update(here).IsAstray)
    {
      ++astray;
      EXPECT_TRUE(god->Current().AwaitsData);
      EXPECT_EQ(god->Current().Penetration, 0.0);
      EXPECT_EQ(god->Update({ 0.02, 0.02, 0.0 }).Position, here)
        << "it rests, wherever the hand is";
      // One that does not show it either, also where the god-object is beyond it.
      for (const Vec3& place : { here, Vec3{ 0.0, 0.02, 0.0 } })
      {
        auto next = touch(second.EnclosedPatch({ place, place, radius }, false));
        EXPECT_FALSE(next->Continue(*god));
        EXPECT_TRUE(next->Update(here).IsAstray);
        god = std::move(next);
      }
      auto next = touch(second.EnclosedPatch({ here, here, radius }, true));
      EXPECT_FALSE(next->Continue(*god));
      god = std::move(next);
    }
    const Contact& found = god->Update(here);
    EXPECT_LT(Length(found.Position - expected->Update(here).Position), 1e-15);
    EXPECT_FALSE(found.IsAstray);
  }
  EXPECT_EQ(astray, 4);
}

/// What is touched from both sides keeps what is inside there, too.
TEST(Patches, WhatIsInsideOfBothSidesStaysThere)
{
  const Vec3 inside{ 0.045, 0.003, 0.001 };
  const auto touch = [](const SurfacePointer& surface)
  {
    std::vector<TouchedSurface> list{ surface };
    list.front().Identity = 1;
    return std::make_unique<GodObject>(std::move(list));
  };
  const SurfaceInPatches first(InsideOut(Icosphere(4, 0.05)));
  for (const double way : { 0.003, -0.01, -0.03, -0.12 })
  {
    SCOPED_TRACE(way);
    const SurfaceInPatches second(Moved(InsideOut(Icosphere(4, 0.05)), { way, 0.0002, 0.0 }));
    const auto expected = touch(second.Whole());
    const auto whole = touch(first.Whole());
    whole->Update(inside);
    expected->Continue(*whole);
    const auto before = touch(first.EnclosedPatch({ inside, inside, 0.02 }, false));
    before->Update(inside);
    const auto god = touch(second.EnclosedPatch({ inside, inside, 0.02 }, true));
    god->Continue(*before);
    const Contact& found = god->Update(inside);
    EXPECT_LT(Length(found.Position - expected->Update(inside).Position), 1e-15);
    EXPECT_FALSE(found.IsAstray);
  }
}
