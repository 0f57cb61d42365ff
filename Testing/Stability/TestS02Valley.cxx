// S2: a valley of any angle is as stable as a plane; forces that add up are not (Fig. 3).
#include "SuiteTools.h"

#include <gtest/gtest.h>

using namespace haptics::testing;

namespace
{
double Boundary(
  const std::function<MethodPointer()>& make, const haptics::Vec3& nudge = { 0.6, 0, -0.8 })
{
  PressedScene scene;
  scene.Make = make;
  scene.Start = { 1e-5, 0.001, 2e-4 };
  scene.Direction = { 0, 0, -1 };
  scene.Nudge = nudge;
  return MeasuredBoundary(scene);
}
}

TEST(S02Valley, IsAsStableAsAPlaneAtEveryAngle)
{
  const double plane = Boundary([] { return Certified(Square(0.5)); }, { 0, 0, -1 });
  for (const double degrees : { 10.0, 30.0, 60.0, 90.0, 120.0 })
  {
    EXPECT_NEAR(Boundary([=] { return CertifiedValley(degrees); }), plane, 0.05 * plane)
      << degrees << " degrees between the normals";
  }
}

// Two springs at an angle phi are as stiff as (1 + cos phi) down and (1 - cos phi) across.
TEST(S02Valley, TheSumOfFieldsShakesEarlierByItsStiffness)
{
  for (const double degrees : { 10.0, 60.0 })
  {
    const double stiffer = 1.0 + std::cos(degrees * M_PI / 180.0);
    EXPECT_NEAR(Boundary([=] { return SummedValley(degrees); }), 1.0 / stiffer, 0.05)
      << degrees << " degrees between the normals";
  }
}

TEST(S02Valley, TheSumOfFieldsPressesTwiceWhereThisProjectPressesOnce)
{
  for (const double degrees : { 0.0, 30.0, 90.0, 120.0 })
  {
    const haptics::Vec3 above{ 0, 0.001, 0.002 };
    const haptics::Vec3 hip{ 0, 0.001, -0.004 };
    const auto reach = [&](const MethodPointer& method)
    {
      method->Place(above);
      method->Update(above);
      return Length(method->Update(hip) - hip);
    };
    EXPECT_NEAR(reach(CertifiedValley(degrees)), 0.004, 1e-9) << degrees;
    const double ratio = 1.0 + std::cos(degrees * M_PI / 180.0);
    EXPECT_NEAR(reach(SummedValley(degrees)), ratio * 0.004, 1e-9) << degrees;
  }
}

TEST(S02Valley, TheDrawnRunsRestAndHammer)
{
  EXPECT_LT(Swing(SceneOf("S2").Ours(), 50), 3e-4);
  EXPECT_GT(Swing(SceneOf("S2").Other(), 50), 5e-4);
}
