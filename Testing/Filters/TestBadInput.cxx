#include "FilterTesting.h"
#include "haptics/Math/AccurateCross.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticProperties.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace testing_surfaces;

namespace
{
/// Touches a good surface first, then the bad one, which must leave an error with `words`, an empty
/// output and no surface, but the first surface as it was.
void ExpectRefused(vtkPolyData* bad, const std::vector<std::string>& words)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Cube()));
  filter->Update();
  const auto before = filter->GetSurface();
  ASSERT_TRUE(before);

  MessageCatcher messages(filter);
  filter->SetInputData(bad);
  filter->Update();
  for (const std::string& word : words)
  {
    EXPECT_NE(messages.Errors().find(word), std::string::npos)
      << "'" << word << "' is missing in: " << messages.Errors();
  }
  EXPECT_FALSE(filter->GetSurface());
  ASSERT_NE(filter->GetOutput(), nullptr);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetNumberOfBoundaryEdges(), 0);
  EXPECT_EQ(before->Triangles().size(), 12u);

  filter->SetInputData(MakePolyData(Cube()));
  filter->Update();
  EXPECT_TRUE(filter->GetSurface()) << "a good input after a bad one";
}

Parts CubeWith(double coordinate)
{
  Parts parts = Cube();
  parts.Points[5][1] = coordinate;
  parts.Points[6][2] = coordinate;
  return parts;
}
}

/// A contour of a value that does not occur, an empty threshold or time step: nothing is wrong.
TEST(BadInput, AnEmptyInputIsNoError)
{
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher messages(filter);
  filter->GetProperties()->SetStiffness(300.0);
  for (const vtkIdType cells : { 12, 0, 12, 0 })
  {
    vtkNew<vtkPolyData> empty;
    vtkNew<vtkDoubleArray> heat; // what a filter leaves of its input's arrays
    heat->SetName("Heat");
    empty->GetPointData()->AddArray(heat);
    filter->SetInputData(cells > 0 ? MakePolyData(Cube()).Get() : static_cast<vtkPolyData*>(empty));
    filter->Update();
    EXPECT_EQ(filter->GetSurface() != nullptr, cells > 0);
    EXPECT_EQ(filter->GetSurfaceProperties() != nullptr, cells > 0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), cells);
    EXPECT_EQ(filter->GetOutput()->GetPointData()->HasArray("Heat"), cells == 0);
    EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("OriginalPointId"));
    EXPECT_TRUE(filter->GetOutput()->GetCellData()->HasArray("OriginalCellId"));
    EXPECT_TRUE(filter->GetOutput()->GetFieldData()->HasArray("BoundaryEdges"));
  }
  EXPECT_EQ(messages.Errors() + messages.Warnings(), "");
}

/// Arrays that are chosen for something go with what vanishes.
TEST(BadInput, AnEmptyInputNeedsNoArrays)
{
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher messages(filter);
  filter->SetInputArrayToProcess(
    vtkHapticProperties::STIFFNESS, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "K");
  filter->SetInputArrayToProcess(
    vtkGodObjectFilter::SIDE_ARRAY, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "sides");
  filter->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  filter->Update();
  EXPECT_EQ(messages.Errors() + messages.Warnings(), "");
  filter->SetInputData(MakePolyData(Cube()));
  filter->Update();
  EXPECT_NE(messages.Errors().find("no array sides"), std::string::npos) << messages.Errors();
}

TEST(BadInput, LinesAndVertsOnly)
{
  Parts parts = Cube();
  parts.Polys.clear();
  parts.Lines = { { 0, 1 }, { 1, 2, 3 } };
  parts.Verts = { { 4 } };
  ExpectRefused(MakePolyData(parts), { "no polygon", "2 lines", "1 verts", "tube filter" });
}

TEST(BadInput, PointsOnly)
{
  Parts parts = Cube();
  parts.Polys.clear();
  ExpectRefused(MakePolyData(parts), { "no polygon", "8 points" });
}

TEST(BadInput, NaNCoordinateNamesTheFirstPoint)
{
  ExpectRefused(MakePolyData(CubeWith(std::nan(""))), { "Point 5 ", "nan", "not finite" });
}

TEST(BadInput, InfiniteCoordinateNamesTheFirstPoint)
{
  const double infinity = std::numeric_limits<double>::infinity();
  ExpectRefused(MakePolyData(CubeWith(-infinity)), { "Point 5 ", "inf", "not finite" });
}

TEST(BadInput, CoordinatesBeyondWhatArithmeticHolds)
{
  ExpectRefused(MakePolyData(CubeWith(1e200)), { "Point 5 ", "1e70" });
}

TEST(BadInput, CellThatNamesAMissingPoint)
{
  Parts parts = Cube();
  parts.Polys[3][1] = 8;
  ExpectRefused(MakePolyData(parts), { "Cell 3", "point 8", "8 points" });
  parts.Polys[3][1] = -1;
  ExpectRefused(MakePolyData(parts), { "Cell 3", "point -1" });
}

TEST(BadInput, SurfaceWithoutArea)
{
  Parts parts = Cube();
  parts.Points.assign(8, { 1, 2, 3 });
  ExpectRefused(MakePolyData(parts), { "None of the 6 polygons", "area" });
}

TEST(BadInput, MissingInputIsAnErrorEvenAfterAGoodOne)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Cube()));
  filter->Update();
  MessageCatcher messages(filter);
  filter->RemoveAllInputConnections(0);
  filter->Update();
  EXPECT_NE(messages.Errors().find("no input"), std::string::npos) << messages.Errors();
  EXPECT_FALSE(filter->GetSurface());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(BadInput, ExactEngineIsAnErrorWhereItIsNotBuilt)
{
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher messages(filter);
  filter->SetInputData(MakePolyData(Cube()));
  filter->SetEngineToExact();
  filter->Update();
  const bool exactIsThere = filter->GetSurface() != nullptr;
  EXPECT_EQ(messages.Errors().empty(), exactIsThere) << messages.Errors();
}

TEST(BadInput, UnusedPointsMayBeNaN)
{
  Parts parts = Cube();
  parts.Points.push_back({ std::nan(""), 0, 0 });
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(parts));
  filter->Update();
  EXPECT_TRUE(filter->GetSurface());
  EXPECT_EQ(filter->GetNumberOfUnusedPoints(), 1);
}

TEST(BadInput, AnAbortLeavesNothingHalfDone)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(Cube()));
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkGodObjectFilter*>(caller)->SetAbortExecute(1); });
  const unsigned long observer = filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_FALSE(filter->GetSurface());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->RemoveObserver(observer);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  EXPECT_TRUE(filter->GetSurface());
}

// A triangle whose third corner was worked out on the edge of the others is no line: the filter
// keeps it, and so does the surface.
TEST(GodObjectFilter, KeepsATriangleAsThinAsRounding)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int kept = 0;
  for (int i = 0; i < 400; ++i)
  {
    Parts needle;
    needle.Points.resize(3);
    needle.Polys = { { 0, 1, 2 } };
    const double share = uniform(random);
    haptics::Vector corners[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = normal(random);
      const double b = normal(random);
      const double corner[3] = { a, b, a + share * (b - a) };
      for (int k = 0; k < 3; ++k)
      {
        needle.Points[k][axis] = corner[k];
        corners[k][axis] = corner[k];
      }
    }
    const haptics::Vector cross = haptics::AccurateCross(corners[0], corners[1], corners[2]);
    vtkNew<vtkGodObjectFilter> filter;
    const MessageCatcher messages(filter);
    filter->SetInputData(MakePolyData(needle));
    filter->Update();
    const bool hasArea = haptics::SquaredLength(cross) > 0.0;
    EXPECT_EQ(filter->GetSurface() != nullptr, hasArea) << i << ": " << messages.Errors();
    kept += hasArea;
  }
  EXPECT_GT(kept, 300);
}
