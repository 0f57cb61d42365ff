// The side of each cell from a data array: that it reaches the right triangles, and what is done
// about bad data.
#include "FilterTesting.h"

#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace testing_surfaces;

namespace
{
constexpr int Sides = vtkGodObjectFilter::SIDE_ARRAY;
constexpr int AtPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int AtCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// The unit cube, and a sheet of one polygon of six corners through its middle and beyond, then the
/// same sheet again as a strip, higher up. Before them a vert and a line, which count as cells.
Parts CubeAndSheets()
{
  Parts parts = Cube();
  parts.Verts = { { 0 } };
  parts.Lines = { { 0, 1 } };
  const auto first = static_cast<vtkIdType>(parts.Points.size());
  for (const Point& p : { Point{ -1, -1, 0.5 }, { 0.5, -1, 0.5 }, { 2, -1, 0.5 }, { 2, 2, 0.5 },
         { 0.5, 2, 0.5 }, { -1, 2, 0.5 }, { -1, -1, 3 }, { 2, -1, 3 }, { -1, 2, 3 }, { 2, 2, 3 } })
  {
    parts.Points.push_back(p);
  }
  parts.Polys.push_back({ first, first + 1, first + 2, first + 3, first + 4, first + 5 });
  parts.Strips = { { first + 6, first + 7, first + 8, first + 9 } };
  return parts;
}
constexpr vtkIdType FirstFace = 2;
constexpr vtkIdType Sheet = 8;
constexpr vtkIdType Strip = 9;
constexpr vtkIdType NumberOfCells = 10;

using SideOfCell = std::function<double(vtkIdType)>;

vtkSmartPointer<vtkPolyData> WithSides(const Parts& parts, const SideOfCell& side)
{
  auto data = MakePolyData(parts);
  vtkNew<vtkDoubleArray> sides;
  sides->SetName("sides");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    sides->InsertNextValue(side(i));
  }
  data->GetCellData()->AddArray(sides);
  return data;
}

/// The cube from its front, the sheets from both sides; the vert and the line have no side.
double AsMeant(vtkIdType cell)
{
  return cell < FirstFace ? std::nan("") : cell < Sheet ? 0.0 : 1.0;
}

vtkSmartPointer<vtkGodObjectFilter> FilterOf(vtkPolyData* data)
{
  auto filter = vtkSmartPointer<vtkGodObjectFilter>::New();
  filter->SetInputData(data);
  filter->SetInputArrayToProcess(Sides, 0, 0, AtCells, "sides");
  return filter;
}

/// Whether each triangle is touched from its back as `isBoth` says of the cell that it came from.
void ExpectBacks(vtkGodObjectFilter* filter, const std::function<bool(vtkIdType)>& isBoth)
{
  filter->Update();
  const auto surface = filter->GetSurface();
  ASSERT_NE(surface, nullptr);
  auto* ids = vtkIdTypeArray::SafeDownCast(
    filter->GetOutput()->GetCellData()->GetAbstractArray("OriginalCellId"));
  for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(surface->TouchesBack(static_cast<std::int32_t>(i)), isBoth(ids->GetValue(i)))
      << "triangle " << i << " of cell " << ids->GetValue(i);
  }
}

/// How many planes hold a hand that has moved from one point to another.
double Held(vtkGodObjectTrace* trace, const Point& from, const Point& to)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->InsertNextPoint(from.data());
  points->InsertNextPoint(to.data());
  vtkNew<vtkPolyData> path;
  path->SetPoints(points);
  trace->SetInputData(path);
  trace->Update();
  return trace->GetOutput()->GetPointData()->GetArray("ActiveConstraints")->GetComponent(1, 0);
}
}

TEST(SideArray, ReachesTheTrianglesOfItsCells)
{
  const auto filter = FilterOf(WithSides(CubeAndSheets(), AsMeant));
  MessageCatcher messages(filter);
  ExpectBacks(filter, [](vtkIdType cell) { return cell >= Sheet; });
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::MIXED_SIDES);
  EXPECT_STREQ(filter->GetTouchedSideAsString(), "Mixed");
  EXPECT_EQ(messages.Errors(), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 12 + 4 + 2);

  vtkNew<vtkGodObjectTrace> trace;
  trace->SetSurfaceConnection(filter->GetOutputPort());
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 1.5 }, { 0.3, 0.4, 0.9 }), 1) << "the cube from outside";
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 0.9 }, { 0.3, 0.4, 1.5 }), 0) << "and from inside";
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 0.9 }, { 0.3, 0.4, 0.2 }), 1) << "the sheet in it, from above";
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 0.2 }, { 0.3, 0.4, 0.9 }), 1) << "and from below";
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 3.2 }, { 0.3, 0.4, 2.8 }), 1) << "the strip";
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 2.8 }, { 0.3, 0.4, 3.2 }), 1) << "the strip's back";
}

TEST(SideArray, OfATracesOwnSurfaceIsThatOfPortOne)
{
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetSurfaceData(WithSides(CubeAndSheets(), AsMeant));
  trace->SetSide(vtkGodObjectFilter::FRONT);
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 0.2 }, { 0.3, 0.4, 0.9 }), 0);
  trace->SetInputArrayToProcess(Sides, 1, 0, AtCells, "sides");
  EXPECT_EQ(Held(trace, { 0.3, 0.4, 0.2 }, { 0.3, 0.4, 0.9 }), 1);
}

TEST(SideArray, AutomaticIsThatOfTheWholeSurface)
{
  const auto half = [](vtkIdType cell) { return cell % 2 ? 2.0 : 0.0; };
  const auto open = FilterOf(WithSides(CubeAndSheets(), half));
  ExpectBacks(open, [](vtkIdType cell) { return cell % 2 == 1; });
  const auto closed = FilterOf(WithSides(Cube(), half));
  closed->SetSideToBoth();
  ExpectBacks(closed, [](vtkIdType) { return false; });
  EXPECT_EQ(closed->GetTouchedSide(), vtkGodObjectFilter::FRONT);
}

TEST(SideArray, WithoutAChoiceIsNotLookedAt)
{
  const auto filter = FilterOf(WithSides(CubeAndSheets(), AsMeant));
  filter->SetInputArrayToProcess(Sides, 0, 0, AtCells, "");
  filter->SetSideToFront();
  filter->Update();
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::FRONT);
  filter->SetInputArrayToProcess(Sides, 0, 0, AtCells, "None"); // ParaView's choice of none
  MessageCatcher messages(filter);
  filter->Update();
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::FRONT);
  EXPECT_EQ(messages.Errors(), "");
}

TEST(SideArray, BadValuesHaveTheFiltersSideAndAreReportedOnce)
{
  const auto side = [](vtkIdType cell)
  {
    const double values[] = { 0.0, 1.0, std::nan(""), -1.0, 0.5, 3.0, 0.0, 1.0, HUGE_VAL, 1.0 };
    return values[cell];
  };
  const auto data = WithSides(CubeAndSheets(), side);
  const auto filter = FilterOf(data);
  MessageCatcher messages(filter);
  filter->SetSideToFront();
  ExpectBacks(filter, [](vtkIdType cell) { return cell == 7 || cell == Strip; });
  EXPECT_NE(messages.Errors().find("sides for the side"), std::string::npos) << messages.Errors();
  EXPECT_NE(messages.Errors().find("5 of 8 cells, the first is cell 2 with nan"), std::string::npos)
    << messages.Errors();
  filter->Modified();
  filter->Update();
  data->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  EXPECT_EQ(messages.Errors().find("5 of 8"), messages.Errors().rfind("5 of 8")) << "said once";
  filter->SetSideToBoth();
  ExpectBacks(filter, [](vtkIdType cell) { return cell != 6; });
}

TEST(SideArray, ThatVanishesLeavesTheFiltersSideAndAnError)
{
  const auto data = WithSides(CubeAndSheets(), AsMeant);
  const auto filter = FilterOf(data);
  filter->SetSideToBoth();
  ExpectBacks(filter, [](vtkIdType cell) { return cell >= Sheet; });
  MessageCatcher messages(filter);
  data->GetCellData()->RemoveArray("sides");
  data->Modified();
  ExpectBacks(filter, [](vtkIdType) { return true; });
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::BOTH);
  EXPECT_NE(messages.Errors().find("no array sides for the side; the side of the filter is used"),
    std::string::npos)
    << messages.Errors();
  data->Modified();
  filter->Update();
  EXPECT_EQ(messages.Errors().find("no array"), messages.Errors().rfind("no array")) << "said once";
}

TEST(SideArray, ThatIsNotOneValueACellLeavesTheFiltersSideAndAnError)
{
  const auto data = MakePolyData(CubeAndSheets());
  const auto add = [](vtkFieldData* to, const char* name, int components, vtkIdType tuples)
  {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(tuples);
    array->Fill(0.0);
    to->AddArray(array);
  };
  add(data->GetPointData(), "atPoints", 1, data->GetNumberOfPoints());
  add(data->GetCellData(), "vectors", 3, NumberOfCells);
  add(data->GetCellData(), "few", 1, 7);
  add(data->GetCellData(), "many", 1, 77);
  const auto filter = FilterOf(data);
  filter->SetSideToBoth();
  const auto expect = [&](int association, const char* name, const char* problem)
  {
    MessageCatcher messages(filter);
    filter->SetInputArrayToProcess(Sides, 0, 0, association, name);
    ExpectBacks(filter, [](vtkIdType) { return true; });
    EXPECT_NE(messages.Errors().find(std::string("array ") + name), std::string::npos)
      << messages.Errors();
    EXPECT_NE(messages.Errors().find(problem), std::string::npos) << messages.Errors();
  };
  expect(AtPoints, "atPoints", "is not of cells");
  expect(AtCells, "vectors", "has 3 components");
  expect(AtCells, "few", "has 7 values, and 10 are needed");
  expect(AtCells, "many", "has 77 values, and 10 are needed");
  expect(AtCells, "other", "There is no array");
}

// Of equal triangles one is kept; a front and a two-sided one in one place are two-sided.
TEST(SideArray, OfDuplicatesAreJoined)
{
  Parts parts;
  parts.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 },
    { 9, 0, 0 }, { 10, 0, 0 }, { 9, 1, 0 } };
  parts.Polys = { { 0, 1, 2 }, { 1, 2, 0 }, { 3, 4, 5 }, { 6, 7, 8 }, { 6, 7, 8 }, { 7, 8, 6 } };
  const double values[] = { 0.0, 1.0, 0.0, 0.0, 2.0, 0.0 };
  const auto filter = FilterOf(WithSides(parts, [&](vtkIdType cell) { return values[cell]; }));
  // Automatic is both for an open surface.
  ExpectBacks(filter, [](vtkIdType cell) { return cell != 2; });
  EXPECT_EQ(filter->GetNumberOfDuplicateTriangles(), 3);
}

TEST(SideArray, IsPartOfWhatASurfaceDependsOn)
{
  const auto data = WithSides(CubeAndSheets(), AsMeant);
  const auto filter = FilterOf(data);
  filter->Update();
  const auto first = filter->GetSurface();
  vtkNew<vtkDoubleArray> colours;
  colours->SetName("colours");
  colours->SetNumberOfValues(NumberOfCells);
  colours->Fill(1.0);
  data->GetCellData()->AddArray(colours);
  filter->Update();
  EXPECT_EQ(filter->GetSurface(), first) << "another array is none of its business";
  auto* sides = vtkDoubleArray::SafeDownCast(data->GetCellData()->GetArray("sides"));
  sides->SetValue(FirstFace, 1.0);
  sides->Modified();
  data->Modified();
  ExpectBacks(filter, [](vtkIdType cell) { return cell == FirstFace || cell >= Sheet; });
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
}
