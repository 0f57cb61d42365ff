// Friction of surfaces whose cells are made anew, or whose points move, sixty times a second.
#include "SceneTestTools.h"

#include "vtkHapticProperties.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
enum class Change
{
  Nothing,
  Cells,          ///< other ones in the same place
  CellsElsewhere, ///< other ones, at another height
  Points          ///< the same cells at another height
};

/// A table with static friction 0.8 and dynamic friction 0.3, pressed 3 mm deep: 1.5 N.
///
///      o-->  pulled sideways
///  ____|____
///      v
struct RoughTable : LedHand
{
  vtkNew<vtkTrivialProducer> Producer;
  Change What;
  int Tick = 0;
  double Pull = 0.0; ///< of the hand, sideways [m]

  explicit RoughTable(Change what)
    : What(what)
  {
    this->Show();
    const int id = this->Scene->AddSurface(this->Producer->GetOutputPort());
    this->Scene->GetSurfaceProperties(id)->SetStaticFriction(0.8);
    this->Scene->GetSurfaceProperties(id)->SetDynamicFriction(0.3);
    for (int i = 0; i <= 130; ++i)
    {
      this->Go(0.01 - 1e-4 * i);
    }
  }

  void Show()
  {
    const int step = this->Tick / 16;
    const bool isOther = this->What == Change::Cells || this->What == Change::CellsElsewhere;
    const bool isElsewhere = this->What == Change::Points || this->What == Change::CellsElsewhere;
    const double height = isElsewhere ? 1e-4 * std::sin(0.8 * step) : 0.0;
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-0.1, -0.1, height);
    plane->SetPoint1(0.1, -0.1, height);
    plane->SetPoint2(-0.1, 0.1, height);
    plane->SetResolution(20 + (isOther ? step % 2 : 0), 20);
    plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    plane->Update();
    this->Producer->SetOutput(plane->GetOutput());
  }

  void Go(double height)
  {
    if (this->Tick++ % 16 == 0)
    {
      this->Show();
    }
    this->Device->SetPosition(0.0013 + this->Pull, 0.0007, height);
    this->Scene->Step(1);
  }
  /// Of the force: what holds back over what presses.
  double Ratio() { return -this->Scene->GetForce()[0] / this->Scene->GetForce()[2]; }
};

constexpr Change Changes[] = { Change::Nothing, Change::Cells, Change::CellsElsewhere,
  Change::Points };
/// A height that changes by 0.1 mm of 3 mm changes the ratio as much.
double Tolerance(Change change)
{
  return change == Change::CellsElsewhere || change == Change::Points ? 0.05 : 1e-3;
}
}

TEST(FrictionThroughChange, HoldsAsBefore)
{
  for (const Change change : Changes)
  {
    RoughTable hand(change);
    for (int i = 0; i < 105; ++i)
    {
      hand.Pull += 2e-5; // to 2.1 mm: 0.7 of the depth
      hand.Go(-0.003);
    }
    const double before = hand.Scene->GetGodObject()[0];
    for (int i = 0; i < 2000; ++i)
    {
      hand.Go(-0.003);
      ASSERT_NEAR(hand.Ratio(), 0.7, Tolerance(change)) << static_cast<int>(change) << ", " << i;
    }
    EXPECT_LT(std::abs(hand.Scene->GetGodObject()[0] - before), 2e-6)
      << "creeps less than a micrometre a second; change " << static_cast<int>(change);
  }
}

TEST(FrictionThroughChange, SlidesAsBefore)
{
  for (const Change change : Changes)
  {
    RoughTable hand(change);
    for (int i = 0; i < 1000; ++i)
    {
      hand.Pull += 2e-5;
      hand.Go(-0.003);
      if (i > 200)
      {
        ASSERT_NEAR(hand.Ratio(), 0.3, Tolerance(change)) << static_cast<int>(change) << ", " << i;
      }
    }
  }
}
