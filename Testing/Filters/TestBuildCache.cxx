#include "FilterTesting.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

using namespace testing_surfaces;

namespace
{
vtkSmartPointer<vtkDoubleArray> Colours(double value)
{
  auto colours = vtkSmartPointer<vtkDoubleArray>::New();
  colours->SetName("Colour");
  colours->SetNumberOfValues(8);
  colours->FillValue(value);
  return colours;
}
}

class BuildCache : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Input = MakePolyData(Cube());
    this->Input->GetPointData()->SetScalars(Colours(1.0));
    this->Filter->SetInputData(this->Input);
    this->Filter->Update();
    this->First = this->Filter->GetSurface();
    ASSERT_TRUE(this->First);
    ASSERT_EQ(this->Filter->GetNumberOfBuilds(), 1);
  }

  void ExpectKept()
  {
    this->Filter->Update();
    EXPECT_EQ(this->Filter->GetNumberOfBuilds(), 1);
    EXPECT_EQ(this->Filter->GetSurface(), this->First);
  }

  void ExpectRebuilt()
  {
    this->Filter->Update();
    EXPECT_EQ(this->Filter->GetNumberOfBuilds(), 2);
    EXPECT_NE(this->Filter->GetSurface(), this->First);
  }

  vtkSmartPointer<vtkPolyData> Input;
  vtkNew<vtkGodObjectFilter> Filter;
  std::shared_ptr<const haptics::TriangleSurface> First;
};

TEST_F(BuildCache, ASecondUpdateRebuildsNothing)
{
  this->ExpectKept();
}

TEST_F(BuildCache, AModifiedFilterOrInputWithTheSameGeometryRebuildsNothing)
{
  // What a render after a moved camera comes to at most.
  this->Filter->Modified();
  this->ExpectKept();
  this->Input->Modified();
  this->ExpectKept();
}

TEST_F(BuildCache, AChangedColourArrayPassesThroughAndRebuildsNothing)
{
  vtkPoints* points = this->Filter->GetOutput()->GetPoints();
  const vtkMTimeType time = points->GetMTime();
  this->Input->GetPointData()->SetScalars(Colours(2.0));
  this->ExpectKept();
  EXPECT_EQ(this->Filter->GetOutput()->GetPointData()->GetScalars()->GetTuple1(0), 2.0);
  EXPECT_EQ(this->Filter->GetOutput()->GetPoints(), points);
  EXPECT_EQ(points->GetMTime(), time) << "or every mapper downstream would upload it again";
}

TEST_F(BuildCache, AnotherPolyDataWithTheSameGeometryRebuildsNothing)
{
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(this->Input);
  this->Filter->SetInputData(copy);
  this->ExpectKept();
}

TEST_F(BuildCache, AMovedPointRebuilds)
{
  this->Input->GetPoints()->SetPoint(7, 2.0, 2.0, 2.0);
  this->Input->GetPoints()->Modified();
  this->ExpectRebuilt();
  EXPECT_GT(Volume(this->Filter->GetOutput()), 1.0);
}

TEST_F(BuildCache, AChangedCellRebuilds)
{
  Parts open = Cube();
  open.Polys.pop_back();
  this->Input->SetPolys(MakePolyData(open)->GetPolys());
  this->ExpectRebuilt();
  EXPECT_FALSE(this->Filter->GetClosed());
}

TEST_F(BuildCache, AnAddedStripRebuilds)
{
  Parts strip;
  strip.Strips = { { 0, 1, 7 } };
  this->Input->SetStrips(MakePolyData(strip)->GetStrips());
  this->ExpectRebuilt();
}

TEST_F(BuildCache, LinesBeforeThePolygonsRenumberTheOriginalCells)
{
  Parts line;
  line.Lines = { { 0, 1 } };
  this->Input->SetLines(MakePolyData(line)->GetLines());
  this->ExpectRebuilt();
  EXPECT_EQ(
    this->Filter->GetOutput()->GetCellData()->GetArray("OriginalCellId")->GetTuple1(0), 1.0);
}

TEST_F(BuildCache, AChangedPropertyRebuilds)
{
  this->Filter->SetSideToBoth();
  this->ExpectRebuilt();
}

TEST_F(BuildCache, APropertySetToWhatItWasRebuildsNothing)
{
  this->Filter->SetSideToBoth();
  this->Filter->SetSideToAutomatic();
  this->ExpectKept();
}

TEST_F(BuildCache, TheEarlierSurfaceStaysForWhoHoldsIt)
{
  this->Input->GetPoints()->SetPoint(7, 2.0, 2.0, 2.0);
  this->Input->GetPoints()->Modified();
  this->ExpectRebuilt();
  EXPECT_EQ(this->First->Triangles().size(), 12u);
  EXPECT_EQ(this->First->Points()[7][0] + this->First->Origin()[0], 1.0);
}

TEST(BuildCacheWithASource, ARunOfTheSourceRebuilds)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputConnection(sphere->GetOutputPort());
  filter->Update();
  sphere->SetRadius(2.0);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
}
