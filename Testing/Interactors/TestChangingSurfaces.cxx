#include "SceneTestTools.h"
#include "TickRecord.h"

#include "vtkCellArray.h"
#include "vtkContourFilter.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProbe.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

/// The next time step as a reader gives it: points and cells are other objects, alike.
vtkSmartPointer<vtkPolyData> NextStep(vtkPolyData* before, double height)
{
  auto next = vtkSmartPointer<vtkPolyData>::New();
  next->DeepCopy(before);
  for (vtkIdType i = 0; i < next->GetNumberOfPoints(); ++i)
  {
    double p[3];
    next->GetPoint(i, p);
    next->GetPoints()->SetPoint(i, p[0], p[1], height * std::cos(15.0 * p[0]));
  }
  return next;
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
      this->Scene->GetServo()->GetWorldForce(force);
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
    EXPECT_LE(hand.LargestStep(33), 0.05) << "30 mm/s, told 30 times a second, step " << step;
    EXPECT_TRUE(hand.Scene->GetTouching());
  }
  EXPECT_EQ(hand.Builds(), 1);
  hand.Scene->Step(100);
  const double expected = 0.010 * std::cos(15.0 * 0.01);
  EXPECT_NEAR(hand.GodObjectHeight(), expected, 1e-4) << "facets of 5 mm";
  EXPECT_NEAR(hand.Scene->GetProbe()->GetPosition()[2], hand.GodObjectHeight(), 1e-6);
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

TEST(ChangingSurfaces, ABadTimeStepIsToldOnceAndTheSeriesGoesOn)
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
  EXPECT_EQ(errors.Count, 2) << "a time step that never came";
  EXPECT_TRUE(hand.Scene->GetTouching());
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
      hand.Scene->GetServo()->GetGodObject(at);
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
