#include "SceneTestTools.h"
#include "haptics/Tick/TickRecord.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkContourFilter.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProbe.h"
#include "vtkHapticReadings.h"
#include "vtkHapticSurfaces.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyDataMapper.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

namespace
{
/// A fine table, flat at first.
vtkSmartPointer<vtkPolyData> MakeMembrane()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.1, -0.1, 0.0);
  plane->SetPoint1(0.1, -0.1, 0.0);
  plane->SetPoint2(-0.1, 0.1, 0.0);
  plane->SetResolution(40, 40);
  plane->Update();
  return plane->GetOutput();
}

/// The next time step as a reader gives it: points and cells are other objects, alike. `height`: of
/// a point, by its x.
template <class Height>
vtkSmartPointer<vtkPolyData> WithHeights(vtkPolyData* before, const Height& height)
{
  auto next = vtkSmartPointer<vtkPolyData>::New();
  next->DeepCopy(before);
  for (vtkIdType i = 0; i < next->GetNumberOfPoints(); ++i)
  {
    double p[3];
    next->GetPoint(i, p);
    next->GetPoints()->SetPoint(i, p[0], p[1], height(p[0]));
  }
  return next;
}

/// A wave.
vtkSmartPointer<vtkPolyData> NextStep(vtkPolyData* before, double height)
{
  return WithHeights(before, [height](double x) { return height * std::cos(15.0 * x); });
}

/// Level.
vtkSmartPointer<vtkPolyData> Lifted(vtkPolyData* before, double height)
{
  return WithHeights(before, [height](double) { return height; });
}

/// The squared distance from the origin times a sign, on a grid of 8 mm: contours face outwards
/// where it is negative, and are inside out where it is positive.
vtkSmartPointer<vtkImageData> MakeSquaredDistance(double sign)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(26, 26, 26);
  image->SetSpacing(0.008, 0.008, 0.008);
  image->SetOrigin(-0.1, -0.1, -0.1);
  image->AllocateScalars(VTK_DOUBLE, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    image->GetPointData()->GetScalars()->SetTuple1(i, sign * vtkMath::Dot(p, p));
  }
  return image;
}

struct Membrane : LedHand
{
  vtkNew<vtkTrivialProducer> Producer;
  vtkSmartPointer<vtkPolyData> Flat = MakeMembrane();
  int Id = -1;

  Membrane()
  {
    this->Producer->SetOutput(this->Flat);
    this->Id = this->Scene->AddSurface(this->Producer->GetOutputPort());
    this->MoveTo(0.01);
    this->MoveTo(-0.002);
  }
  vtkIdType Builds() { return this->Scene->GetSurfaceFilter(this->Id)->GetNumberOfBuilds(); }
  /// The largest change of the length of the force in n ticks [N].
  double LargestStep(int n)
  {
    double largest = 0.0;
    for (int i = 0; i < n; ++i)
    {
      const double before = this->Scene->GetForce()[2];
      this->Scene->GetServo()->Step(1);
      double force[3];
      this->Scene->GetServo()->GetReadings()->GetWorldForce(force);
      this->Scene->Update();
      largest = std::max(largest, std::abs(force[2] - before));
    }
    return largest;
  }
};
}

TEST(ChangingSurfaces, TheSameCellsDeformWithoutBuildingAndWithoutAStep)
{
  Membrane hand;
  hand.Scene->Step(33);
  for (int step = 1; step <= 10; ++step)
  {
    hand.Producer->SetOutput(NextStep(hand.Flat, 0.001 * step));
    EXPECT_LE(hand.LargestStep(33), 0.05) << "30 mm/s, updated 30 times a second, step " << step;
    EXPECT_TRUE(hand.Scene->GetTouching());
  }
  EXPECT_EQ(hand.Builds(), 1);
  hand.Scene->Step(100);
  const double expected = 0.010 * std::cos(15.0 * 0.01);
  EXPECT_NEAR(hand.GodObjectHeight(), expected, 1e-4) << "facets of 5 mm";
  EXPECT_NEAR(hand.Scene->GetProbe()->GetPosition()[2], hand.GodObjectHeight(), 1e-6);
}

// A view that draws 60 times a second, as regularly as views do.
TEST(ChangingSurfaces, SixtyShapesASecondAreFollowedWithoutLeavingAnyOut)
{
  Membrane hand;
  vtkHapticServo* servo = hand.Scene->GetServo();
  hand.Scene->Step(17);
  const int ticks[] = { 17, 16, 17, 19, 14, 17, 13, 20, 17, 16 };
  std::uint64_t before = servo->GetLatestRecord().Generation;
  for (int step = 1; step <= 120; ++step)
  {
    hand.Producer->SetOutput(NextStep(hand.Flat, 0.001 * std::sin(0.1 * step)));
    hand.Scene->Update();
    servo->Step(ticks[step % 10]);
    const std::uint64_t now = servo->GetLatestRecord().Generation;
    EXPECT_EQ(now, before + 1) << "step " << step;
    before = now;
  }
  EXPECT_EQ(hand.Builds(), 1);
}

// One after another without a tick between: there is nothing to wait for.
TEST(ChangingSurfaces, OfSeveralInOneMomentTheLastIsTouched)
{
  Membrane hand;
  hand.Scene->Step(33);
  for (const double height : { 0.002, 0.003, 0.004 })
  {
    hand.Producer->SetOutput(Lifted(hand.Flat, height));
    hand.Scene->Update();
  }
  hand.Scene->Step(100);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.004, Clearance);
}

// Two, with a tick between: the second waits for the first, within one call of Step().
TEST(ChangingSurfaces, OneThatComesTooSoonWaitsAndThenTakesPart)
{
  Membrane hand;
  hand.Scene->Step(33);
  for (const double height : { 0.001, 0.002, 0.003 })
  {
    hand.Producer->SetOutput(Lifted(hand.Flat, height));
    hand.Scene->Step(1);
  }
  hand.Scene->Step(100);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.003, Clearance);
  EXPECT_EQ(hand.Builds(), 1) << "each has deformed";
}

// Built in the background: each is there long before the servo has come to the one before.
TEST(ChangingSurfaces, OneThatIsBuiltInTheBackgroundTooSoonWaitsForTheOneBefore)
{
  Membrane hand;
  hand.Scene->Step(33);
  hand.Scene->GetSurfaces()->BackgroundBuildingOn();
  double largest = 0.0;
  for (int step = 1; step <= 5; ++step)
  {
    hand.Producer->SetOutput(Lifted(hand.Flat, 0.0002 * step)); // 40 mm/s: 0.02 N a tick
    for (int i = 0; i < 5; ++i)
    {
      largest = std::max(largest, hand.LargestStep(1));
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }
  for (int i = 0; i < 200; ++i) // and what is left
  {
    const double before = hand.Scene->GetForce()[2];
    hand.Scene->Step(1);
    largest = std::max(largest, std::abs(hand.Scene->GetForce()[2] - before));
  }
  EXPECT_LE(largest, 0.05);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.001, Clearance);
  EXPECT_EQ(hand.Builds(), 1);
}

TEST(ChangingSurfaces, OtherCellsAreAnotherSnapshot)
{
  Membrane hand;
  hand.Scene->Step(33);
  vtkSmartPointer<vtkPolyData> fewer = NextStep(hand.Flat, 0.0);
  fewer->BuildCells();
  fewer->DeleteCell(0);
  fewer->RemoveDeletedCells();
  hand.Producer->SetOutput(fewer);
  hand.Scene->Step(1);
  EXPECT_EQ(hand.Builds(), 2);
  EXPECT_TRUE(hand.Scene->GetTouching());
}

TEST(ChangingSurfaces, PointsThatWereOneAndPartAreAnotherSnapshot)
{
  Membrane hand;
  auto doubled = [&hand](double apart)
  {
    vtkSmartPointer<vtkPolyData> next = NextStep(hand.Flat, 0.0);
    next->GetPointData()->Initialize();
    double p[3];
    next->GetPoint(0, p);
    const vtkIdType twin = next->GetPoints()->InsertNextPoint(p[0], p[1], p[2] + apart);
    const vtkIdType triangle[3] = { twin, 1, 41 };
    next->GetPolys()->InsertNextCell(3, triangle);
    return next;
  };
  hand.Producer->SetOutput(doubled(0.0));
  hand.Scene->Step(33);
  EXPECT_EQ(hand.Builds(), 2);
  hand.Producer->SetOutput(doubled(0.001));
  hand.Scene->Step(33);
  EXPECT_EQ(hand.Builds(), 3);
}

TEST(ChangingSurfaces, ABadTimeStepIsReportedOnceAndTheSeriesGoesOn)
{
  Membrane hand;
  hand.Scene->Step(33);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  vtkSmartPointer<vtkPolyData> bad = NextStep(hand.Flat, 0.001);
  bad->GetPoints()->SetPoint(7, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  hand.Producer->SetOutput(bad);
  hand.Scene->Step(33);
  hand.Scene->Step(33);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NE(std::string(hand.Scene->GetErrorMessage()).find("Point 7"), std::string::npos);
  EXPECT_TRUE(hand.Scene->GetTouching()) << "the last good one stays";
  EXPECT_NEAR(hand.GodObjectHeight(), 0.0, 1e-5);
  hand.Producer->SetOutput(NextStep(hand.Flat, 0.002));
  hand.Scene->Step(200);
  EXPECT_EQ(errors.Count, 1);
  EXPECT_NEAR(hand.GodObjectHeight(), 0.002 * std::cos(0.15), 1e-4);

  vtkNew<vtkPolyData> missing;
  hand.Producer->SetOutput(missing);
  hand.Scene->Step(33);
  EXPECT_EQ(errors.Count, 1) << "a time step without a part is no error";
  EXPECT_FALSE(hand.Scene->GetTouching());
}

// 0.2 m at 5 m/s take 40 ms, or 50 with the haste in reserve, and not the 33 ms from update to
// update. 0.5 m is the most.
TEST(ChangingSurfaces, PointsAreNoFasterThanAHandCanFollow)
{
  for (const double height : { 0.2, 0.49 })
  {
    Membrane hand;
    hand.Scene->Step(33);
    EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
    hand.Producer->SetOutput(Lifted(hand.Flat, height));
    hand.Scene->Step(1);
    double before = hand.GodObjectHeight();
    double fastest = 0.0;
    for (int tick = 0; tick < 130; ++tick)
    {
      hand.Scene->GetServo()->Step(1);
      double at[3];
      hand.Scene->GetServo()->GetReadings()->GetGodObject(at);
      fastest = std::max(fastest, at[2] - before);
      before = at[2];
    }
    EXPECT_LE(fastest, 0.005) << "m a tick";
    EXPECT_GT(fastest, 0.0035);
    EXPECT_NEAR(before, height, Clearance) << "it has pushed the hand all the way";
    EXPECT_EQ(errors.Count, 0);
  }
}

TEST(ChangingSurfaces, DeformOnWhereTheSceneLooksMoreOftenThanTheServoTicks)
{
  Membrane hand;
  ASSERT_TRUE(hand.Scene->Engage()) << hand.Scene->GetErrorMessage();
  for (int frame = 0; frame < 30; ++frame)
  {
    for (const double more : { 0.0, 1e-5 })
    {
      hand.Producer->SetOutput(NextStep(hand.Flat, 1e-4 * frame + more));
      hand.Scene->Update();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(hand.Builds(), 1) << "only points have moved";
}

TEST(ChangingSurfaces, PointsThatWouldBeFasterAreThereAtOnceWithAMessageAndNoForce)
{
  Membrane hand;
  hand.Scene->Step(33);
  EventCounter errors(hand.Scene, vtkCommand::ErrorEvent);
  double height = 0.0;
  for (int step = 0; step < 3; ++step)
  {
    height += 2.0;
    hand.Producer->SetOutput(Lifted(hand.Flat, height));
    hand.Scene->Step(33);
    EXPECT_FALSE(hand.Scene->GetTouching());
    EXPECT_EQ(vtkMath::Norm(hand.Scene->GetForce()), 0.0);
  }
  EXPECT_EQ(errors.Count, 1) << "once, while it goes on";
  const std::string message = hand.Scene->GetErrorMessage();
  EXPECT_EQ(message.rfind("Surface 0: A point of it was moved by 2 m in the hand", 0), 0U)
    << message;
  EXPECT_EQ(hand.Builds(), 1) << "engines are refitted";
  hand.Device->SetPosition(0.3, 0.0, 0.0); // around it
  hand.Scene->Step(1);
  hand.Device->SetPosition(0.3, 0.0, height + 0.05);
  hand.Scene->Step(1);
  hand.MoveTo(height + 0.05);
  hand.MoveTo(height - 0.05);
  EXPECT_TRUE(hand.Scene->GetTouching()) << "it is where it was put";
  EXPECT_NEAR(hand.GodObjectHeight(), height, Clearance);
  hand.Producer->SetOutput(Lifted(hand.Flat, height + 0.001));
  hand.Scene->Step(100);
  EXPECT_TRUE(hand.Scene->GetTouching()) << "and deforms on from there";
}

TEST(ChangingSurfaces, OneThatDeformsWhileItIsHiddenPushesNothingWhenItComesBack)
{
  LedHand hand;
  vtkSmartPointer<vtkPolyData> flat = MakeMembrane();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(flat);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  hand.Scene->AddSurface(actor);
  hand.MoveTo(0.01);
  actor->VisibilityOff();
  hand.Scene->Step(33);
  mapper->SetInputData(NextStep(flat, 0.02)); // past the hand
  hand.Scene->Step(33);
  actor->VisibilityOn();
  hand.Scene->Step(100);
  EXPECT_FALSE(hand.Scene->GetTouching());
  EXPECT_NEAR(hand.GodObjectHeight(), 0.01, 1e-12);
}

class ContourSeries : public ::testing::TestWithParam<double>
{
};

// A ball that breathes, extracted anew at each time step: other triangles each time.
TEST_P(ContourSeries, IsStrokedWithoutALeakOrAPop)
{
  const double sign = GetParam();
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(MakeSquaredDistance(sign));
  contour->ComputeNormalsOff();
  const auto show = [&](double radius) { contour->SetValue(0, sign * radius * radius); };
  show(0.06);

  LedHand hand;
  hand.Scene->GetServo()->GetSafety()->SetPassivityControl(false);
  hand.Scene->AddSurface(contour->GetOutputPort());
  hand.Device->SetPosition(0.0, 0.0, 0.09);
  hand.Scene->Step(1);
  hand.Scene->StartRecording();
  double radius = 0.06;
  int touched = 0; // the ball shrinks away from the hand for some steps, and comes back over it
  for (int step = 0; step < 40; ++step)
  {
    radius = 0.06 + 0.006 * std::sin(0.4 * step);
    show(radius);
    const double angle = 0.04 * step; // a stroke from the pole, 4 mm deep in the mean ball
    for (int i = 0; i < 33; ++i)
    {
      const double a = angle + 0.04 * i / 33.0;
      hand.Device->SetPosition(0.056 * std::sin(a), 0.01, 0.056 * std::cos(a));
      i == 0 ? hand.Scene->Step(1) : hand.Scene->GetServo()->Step(1);
      double at[3];
      hand.Scene->GetServo()->GetReadings()->GetGodObject(at);
      // A facet of the grid's 8 mm lies up to 0.2 mm inside the ball; between two steps the ball
      // may be at either radius.
      EXPECT_GT(std::hypot(at[0], at[1], at[2]), radius - 0.0035) << "step " << step;
    }
    hand.Scene->Update();
    touched += hand.Scene->GetTouching() ? 1 : 0;
  }
  EXPECT_GT(touched, 25);
  EXPECT_LT(touched, 40);
}

INSTANTIATE_TEST_SUITE_P(ChangingSurfaces, ContourSeries, ::testing::Values(-1.0, 1.0),
  [](const auto& info) { return info.param < 0.0 ? "FacingOutwards" : "InsideOut"; });
