// Points that lie at the same place with other values at each: every cell keeps its own.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticProperties.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include "haptics/Surface/TriangleSurface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace testing_surfaces;

namespace
{
/// Two squares side by side that share no point; `left` and `right` at theirs.
///
///     +-----+ +-----+
///     |  0  | | 100 |
///     +-----+ +-----+
vtkSmartPointer<vtkPolyData> TwoMaterials(double left, double right)
{
  auto surface = MakePolyData({ { { -1, -1, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { -1, 1, 0 },
                                  { 0, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }, {}, {}, {} });
  vtkNew<vtkDoubleArray> values;
  values->SetName("T");
  for (int i = 0; i < 8; ++i)
  {
    values->InsertNextValue(i < 4 ? left : right);
  }
  surface->GetPointData()->AddArray(values);
  return surface;
}

/// The least and greatest value of an array at the corners of the triangles of a cell.
std::pair<double, double> RangeOfCell(vtkPolyData* prepared, const char* name, vtkIdType cell)
{
  vtkDataArray* const values = prepared->GetPointData()->GetArray(name);
  vtkDataArray* const cells = prepared->GetCellData()->GetArray("OriginalCellId");
  std::pair<double, double> range{ HUGE_VAL, -HUGE_VAL };
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < prepared->GetNumberOfPolys(); ++t)
  {
    prepared->GetPolys()->GetCellAtId(t, ids);
    for (vtkIdType k = 0; k < 3 && cells->GetComponent(t, 0) == static_cast<double>(cell); ++k)
    {
      const double value = values->GetComponent(ids->GetId(k), 0);
      range = { std::min(range.first, value), std::max(range.second, value) };
    }
  }
  return range;
}
}

TEST(DiscontinuousData, EachCellKeepsItsOwnValuesOverOneSurface)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(TwoMaterials(0.0, 100.0));
  filter->Update();
  vtkPolyData* const output = filter->GetOutput();
  EXPECT_EQ(filter->GetNumberOfMergedPoints(), 2);
  EXPECT_EQ(filter->GetSurface()->Points().size(), 6u) << "neighbours share their points";
  EXPECT_EQ(filter->GetNumberOfBoundaryEdges(), 6);
  EXPECT_EQ(output->GetNumberOfPoints(), 8) << "and data its values";
  EXPECT_EQ(RangeOfCell(output, "T", 0), std::make_pair(0.0, 0.0));
  EXPECT_EQ(RangeOfCell(output, "T", 1), std::make_pair(100.0, 100.0));
  vtkDataArray* const originals = output->GetPointData()->GetArray("OriginalPointId");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double q[3];
    output->GetPoint(i, p);
    filter->GetPolyDataInput(0)->GetPoint(static_cast<vtkIdType>(originals->GetComponent(i, 0)), q);
    EXPECT_EQ(Point({ p[0], p[1], p[2] }), Point({ q[0], q[1], q[2] })) << i;
  }
}

TEST(DiscontinuousData, EqualValuesAddNoPoints)
{
  vtkSmartPointer<vtkPolyData> same = TwoMaterials(5.0, 5.0);
  vtkNew<vtkIdTypeArray> ids; // different at each point, and no data
  ids->SetName("ids");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName("vtkGhostType");
  for (int i = 0; i < 8; ++i)
  {
    ids->InsertNextValue(i);
    ghosts->InsertNextValue(i % 2);
  }
  same->GetPointData()->SetGlobalIds(ids);
  same->GetPointData()->AddArray(ghosts);
  vtkNew<vtkDoubleArray> holes;
  holes->SetName("holes");
  holes->SetNumberOfTuples(8);
  holes->Fill(std::nan(""));
  same->GetPointData()->AddArray(holes);
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(same);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 6);
  // Text counts as numbers do.
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  for (int i = 0; i < 8; ++i)
  {
    words->InsertNextValue(i < 4 ? "bone" : "skin");
  }
  same->GetPointData()->AddArray(words);
  same->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 8);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1) << "data is no geometry";
}

TEST(DiscontinuousData, ABoxHasTheNormalsOfItsSides)
{
  vtkNew<vtkCubeSource> cube;
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputConnection(cube->GetOutputPort());
  filter->Update();
  vtkPolyData* const output = filter->GetOutput();
  EXPECT_EQ(filter->GetSurface()->Points().size(), 8u);
  EXPECT_TRUE(filter->GetClosed());
  vtkDataArray* const normals = output->GetPointData()->GetArray("Normals");
  ASSERT_TRUE(normals);
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < output->GetNumberOfPolys(); ++t)
  {
    output->GetPolys()->GetCellAtId(t, ids);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double n = normals->GetComponent(ids->GetId(0), axis);
      EXPECT_TRUE(n == 0.0 || std::abs(n) == 1.0) << t;
      EXPECT_EQ(normals->GetComponent(ids->GetId(1), axis), n);
      EXPECT_EQ(normals->GetComponent(ids->GetId(2), axis), n);
    }
  }
}

// Polygons of many corners, strips, and corners that were merged away inside a cell.
TEST(DiscontinuousData, HoldsForEveryKindOfCell)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkCellArray> strips;
  vtkNew<vtkDoubleArray> values;
  values->SetName("cell");
  const auto corner = [&](double x, double y, double value)
  {
    values->InsertNextValue(value);
    return points->InsertNextPoint(x, y, 0.0);
  };
  // A pentagon that has one corner twice.
  const vtkIdType pentagon[6] = { corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 0),
    corner(1, 1, 0), corner(0.5, 1.5, 0), corner(0, 1, 0) };
  polys->InsertNextCell(6, pentagon);
  const vtkIdType triangle[3] = { corner(0.5, 1.5, 1), corner(1, 1, 1), corner(2, 2, 1) };
  polys->InsertNextCell(3, triangle);
  const vtkIdType strip[4] = { corner(1, 0, 2), corner(2, 0, 2), corner(1, 1, 2), corner(2, 2, 2) };
  strips->InsertNextCell(4, strip);
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(polys);
  surface->SetStrips(strips);
  surface->GetPointData()->AddArray(values);
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(surface);
  filter->Update();
  EXPECT_EQ(filter->GetSurface()->Points().size(), 7u);
  for (const vtkIdType cell : { 0, 1, 2 })
  {
    const double own = static_cast<double>(cell);
    EXPECT_EQ(RangeOfCell(filter->GetOutput(), "cell", cell), std::make_pair(own, own));
  }
}

// A material that an array drives is each cell's own up to the seam.
TEST(DiscontinuousData, ActsAsEachCellHasIt)
{
  for (const double x : { -0.9, -0.5, -0.1, -0.001, 0.001, 0.1, 0.435, 0.9 })
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(x, 0.1, 0.01);
    points->InsertNextPoint(x, 0.1, -0.002);
    vtkNew<vtkPolyData> path;
    path->SetPoints(points);
    vtkNew<vtkGodObjectTrace> trace;
    trace->SetInputData(path);
    trace->SetSurfaceData(TwoMaterials(200.0, 800.0));
    trace->SetInputArrayToProcess(
      vtkHapticProperties::STIFFNESS, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "T");
    trace->Update();
    EXPECT_NEAR(trace->GetOutput()->GetPointData()->GetArray("Stiffness")->GetComponent(1, 0),
      x < 0.0 ? 200.0 : 800.0, 1e-6)
      << x;
  }
}
