// What reaches the device while surfaces are exchanged, vanish, come late or are spoilt, with the
// safety that a hand has: each tick of a stroke in virtual time.
#include "SceneTestTools.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkHapticSurfaces.h"
#include "vtkMath.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr double Period = 0.001;

/// How far a force is beyond the one before: what a force limit bounds. One that only shrinks, in
/// its own direction, is not beyond.
double Growth(const double before[3], const double after[3])
{
  const double squared = vtkMath::Dot(before, before);
  const double share =
    squared > 0.0 ? std::clamp(vtkMath::Dot(after, before) / squared, 0.0, 1.0) : 0.0;
  double change[3];
  for (int i = 0; i < 3; ++i)
  {
    change[i] = after[i] - share * before[i];
  }
  return vtkMath::Norm(change);
}

/// A hand with the safety as it is by default, whose every tick is recorded.
struct SafeHand
{
  vtkNew<vtkSimulatedHapticDevice> Device;
  vtkNew<vtkHapticScene> Scene;

  SafeHand()
  {
    this->Scene->SetDevice(this->Device);
    this->Scene->StartRecording();
  }
  double LargestForce() { return this->Scene->GetServo()->GetEffectiveMaximumForce(); }
  /// The most that a soft start lets the force grow in a tick.
  double SoftGrowth()
  {
    return Period * this->LargestForce() / this->Scene->GetServo()->GetSafety()->GetSoftStartTime();
  }
  double SlewGrowth() { return Period * this->Scene->GetServo()->GetSafety()->GetSlewLimit(); }
  void MoveTo(double height, int ticks)
  {
    this->Device->SetPosition(0.01, 0.02, height);
    this->Scene->Step(ticks);
  }
  double Force() { return vtkMath::Norm(this->Scene->GetForce()); }
  /// From tick `first` on, of each tick or of every so many; its number is given where it happens.
  double LargestGrowth(vtkIdType first, vtkIdType every = 1)
  {
    vtkDataArray* forces = this->Scene->GetTrace()->GetPointData()->GetArray("Force");
    double largest = 0.0;
    for (vtkIdType i = std::max<vtkIdType>(first, 1); i < forces->GetNumberOfTuples(); i += every)
    {
      double before[3];
      double after[3];
      forces->GetTuple(i - 1, before);
      forces->GetTuple(i, after);
      EXPECT_LE(vtkMath::Norm(after), this->LargestForce() * (1.0 + 1e-12)) << "tick " << i;
      largest = std::max(largest, Growth(before, after));
    }
    return largest;
  }
  vtkIdType Ticks() { return this->Scene->GetTrace()->GetNumberOfPoints(); }
};

vtkSmartPointer<vtkPolyData> MakeBall(double radius, int resolution)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(resolution);
  ball->SetPhiResolution(resolution);
  ball->Update();
  return ball->GetOutput();
}

/// A fine table at a height, its points of its own.
vtkSmartPointer<vtkPolyData> MakeSheet(double height)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, height);
  plane->SetPoint1(0.1, -0.1, height);
  plane->SetPoint2(-0.1, 0.1, height);
  plane->SetResolution(20, 20);
  plane->Update();
  return plane->GetOutput();
}

struct Sheet : SafeHand
{
  vtkNew<vtkTrivialProducer> Producer;

  Sheet()
  {
    vtkHapticSafety* safety = this->Scene->GetServo()->GetSafety();
    safety->LoosenSoftStartTime(0.0); // or a step would hide behind them
    safety->LoosenSlewLimit(1e5);
    this->Producer->SetOutput(MakeSheet(0.0));
    this->Scene->AddSurface(this->Producer->GetOutputPort());
    this->MoveTo(0.005, 1);
    this->MoveTo(-0.002, 300);
    EXPECT_GT(this->Force(), 0.9);
  }
  void Show(double height, int ticks)
  {
    this->Producer->SetOutput(MakeSheet(height));
    this->Scene->Step(ticks);
  }
};
}

//   o )  ->  (o  )  ->  o )     a ball that grows by 12 mm over the hand and shrinks away from it,
//                               other triangles each time: 6 N asked for at once, by 500 N/m
// Facets turn the force as the hand goes on, by up to 12 degrees: that is the hand's doing.
TEST(SurfaceSwaps, WhatAChangeDoesToTheForceGrowsAsSlowlyAsAfterAStart)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(MakeBall(0.05, 30));
  SafeHand hand;
  hand.Scene->AddSurface(producer->GetOutputPort());
  hand.Device->SetPosition(0.0, 0.0, 0.07);
  hand.Scene->Step(1);
  int touched = 0;
  for (int step = 0; step < 40; ++step)
  {
    const bool isLarge = step % 4 < 2;
    producer->SetOutput(MakeBall(isLarge ? 0.062 : 0.050, 31 + step % 3));
    for (int tick = 0; tick < 33; ++tick)
    {
      const double a = 0.001 * (33 * step + tick); // 56 mm/s
      hand.Device->SetPosition(0.056 * std::sin(a), 0.0, 0.056 * std::cos(a));
      hand.Scene->Step(1);
      touched += hand.Scene->GetTouching() ? 1 : 0;
      if (isLarge)
      {
        // Facets lie up to 1 % inside the ball.
        ASSERT_GT(vtkMath::Norm(hand.Scene->GetGodObject()), 0.99 * 0.062) << "step " << step;
      }
    }
  }
  EXPECT_EQ(touched, 20 * 33);
  // The first tick was one above the ball; from the second on each 33rd takes a change in.
  EXPECT_LE(hand.LargestGrowth(1, 33), hand.SoftGrowth() * (1.0 + 1e-9));
  EXPECT_GT(hand.LargestGrowth(1, 33), 0.9 * hand.SoftGrowth()) << "it was at the limit";
  EXPECT_LE(hand.LargestGrowth(0), hand.SlewGrowth() * (1.0 + 1e-9));
}

TEST(SurfaceSwaps, ASurfaceThatVanishesTakesItsForceAlongAndGivesItBackSlowly)
{
  SafeHand hand;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(MakeBall(0.05, 30));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  hand.Scene->AddSurface(actor);
  hand.Device->SetPosition(0.0, 0.0, 0.06);
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.0, 0.0, 0.045);
  hand.Scene->Step(300);
  ASSERT_GT(hand.Force(), 2.0);
  actor->VisibilityOff();
  hand.Scene->Step(1);
  EXPECT_EQ(hand.Force(), 0.0) << "in the tick itself: no force is stale";
  hand.Scene->Step(50);
  const vtkIdType swap = hand.Ticks();
  actor->VisibilityOn(); // around the hand, which it does not push
  hand.Scene->Step(50);
  EXPECT_EQ(hand.Force(), 0.0);
  hand.Device->SetPosition(0.0, 0.0, 0.06);
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.0, 0.0, 0.045);
  hand.Scene->Step(300);
  EXPECT_GT(hand.Force(), 2.0);
  EXPECT_LE(hand.LargestGrowth(swap), hand.SlewGrowth() * (1.0 + 1e-9));
  EXPECT_LE(hand.LargestGrowth(0), hand.SlewGrowth() * (1.0 + 1e-9));
}

// 1 mm a time step, 30 a second: 30 mm/s. S8 allows 0.05 N a tick.
TEST(SurfaceSwaps, ATimeStepThatComesLateIsWaitedForAndMakesNoStep)
{
  Sheet hand;
  const vtkIdType start = hand.Ticks();
  double height = 0.0;
  for (const int ticks : { 33, 33, 34, 250, 33, 20, 33, 90, 33 })
  {
    height += 0.001;
    hand.Show(height, ticks);
    EXPECT_TRUE(hand.Scene->GetTouching());
  }
  hand.Scene->Step(100);
  EXPECT_NEAR(hand.Scene->GetGodObject()[2], height, 1e-6);
  EXPECT_LE(hand.LargestGrowth(start), 0.05);
}

TEST(SurfaceSwaps, ATimeStepThatIsNoGoodMakesNoStepAndTheSeriesGoesOnFromTheLastGoodOne)
{
  Sheet hand;
  EventCounter errors(hand.Scene, vtkHapticScene::SurfaceErrorEvent);
  EventCounter quiet(hand.Scene, vtkCommand::ErrorEvent);
  const vtkIdType start = hand.Ticks();
  for (int step = 1; step <= 12; ++step)
  {
    vtkSmartPointer<vtkPolyData> next = MakeSheet(0.001 * step);
    if (step == 5)
    {
      next->GetPoints()->SetPoint(200, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN());
    }
    if (step == 9)
    {
      next->SetLines(next->GetPolys());
      next->SetPolys(nullptr);
    }
    hand.Producer->SetOutput(next);
    hand.Scene->Step(33);
    EXPECT_TRUE(hand.Scene->GetTouching()) << "step " << step;
  }
  EXPECT_EQ(errors.Count, 2);
  hand.Scene->Step(100);
  EXPECT_NEAR(hand.Scene->GetGodObject()[2], 0.012, 1e-6);
  // After a gap the surface makes up for two time steps in one: twice S8's 0.015 N.
  EXPECT_LE(hand.LargestGrowth(start), 0.05);
}

// A contour of a value that nothing has any more, a threshold, a time step before the first part.
TEST(SurfaceSwaps, WhatHasVanishedDoesNotHoldAndIsNoError)
{
  for (const bool inBackground : { false, true })
  {
    Sheet hand;
    hand.Scene->GetSurfaces()->SetBackgroundBuilding(inBackground);
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    vtkNew<vtkPolyData> empty;
    if (inBackground)
    {
      hand.Producer->SetOutput(MakeSheet(0.0005)); // which is not there any more when it is built
      hand.Scene->Update();
    }
    hand.Producer->SetOutput(empty);
    hand.Scene->Step(1);
    EXPECT_EQ(hand.Force(), 0.0) << "in the tick itself";
    EXPECT_FALSE(hand.Scene->GetTouching());
    EXPECT_FALSE(hand.Scene->GetSurfaces()->IsTouchable(0));
    hand.Scene->Step(100);
    EXPECT_EQ(hand.Force(), 0.0);
    hand.Show(0.0, 100); // it is there again, above the hand, and pushes nothing
    EXPECT_TRUE(hand.Scene->GetSurfaces()->IsTouchable(0));
    EXPECT_EQ(hand.Force(), 0.0);
    hand.MoveTo(0.002, 100);
    EXPECT_GT(hand.Force(), 0.9) << "from below";
    EXPECT_FALSE(hand.Scene->GetSurfaces()->IsOutdated(0));
    EXPECT_EQ(errors.Count, 0) << hand.Scene->GetErrorMessage();
  }
}

TEST(SurfaceSwaps, OnlyWhatIsBadKeepsTheLastAndSaysSoUntilItIsGood)
{
  Sheet hand;
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  vtkSmartPointer<vtkPolyData> bad = MakeSheet(0.0);
  bad->GetPoints()->SetPoint(200, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN());
  hand.Producer->SetOutput(bad);
  hand.Scene->Step(10);
  EXPECT_GT(hand.Force(), 0.9);
  EXPECT_TRUE(hand.Scene->GetSurfaces()->IsOutdated(0));
  EXPECT_EQ(errors.Count, 1);
  hand.Show(0.0, 10);
  EXPECT_GT(hand.Force(), 0.9);
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsOutdated(0));
  hand.Producer->SetOutput(bad);
  hand.Scene->Step(10);
  vtkNew<vtkPolyData> empty;
  hand.Producer->SetOutput(empty);
  hand.Scene->Step(100); // what deforms arrives first
  EXPECT_EQ(hand.Force(), 0.0) << "empty is good";
  EXPECT_FALSE(hand.Scene->GetSurfaces()->IsOutdated(0));
}
