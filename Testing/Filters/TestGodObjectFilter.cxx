#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkGodObjectFilter.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace testing_surfaces;

namespace
{
vtkSmartPointer<vtkGodObjectFilter> Prepare(vtkPolyData* input)
{
  auto filter = vtkSmartPointer<vtkGodObjectFilter>::New();
  filter->SetInputData(input);
  filter->Update();
  return filter;
}

std::vector<vtkIdType> Ids(vtkDataSetAttributes* data, const char* name)
{
  auto* array = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(name));
  if (!array)
  {
    return {};
  }
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
}

vtkIdType FieldValue(vtkGodObjectFilter* filter, const char* name)
{
  auto* array = filter->GetOutput()->GetFieldData()->GetArray(name);
  return array ? static_cast<vtkIdType>(array->GetTuple1(0)) : -1;
}

const Parts Square{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }, {},
  {}, {} };
}

TEST(GodObjectFilter, MakesTrianglesOfAClosedCubeOfQuads)
{
  auto filter = Prepare(MakePolyData(Cube()));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 12);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 8);
  EXPECT_DOUBLE_EQ(Volume(filter->GetOutput()), 1.0);
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_TRUE(filter->GetOriented());
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::FRONT);
  ASSERT_TRUE(filter->GetSurface());
  EXPECT_EQ(filter->GetSurface()->Triangles().size(), 12u);
}

TEST(GodObjectFilter, SplitsConcavePolygonsInside)
{
  // The cube's top cut to an L, its sides left out.
  Parts parts;
  parts.Points = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } };
  parts.Polys = { { 0, 1, 2, 3, 4, 5 } };
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 4);
  EXPECT_DOUBLE_EQ(Area(filter->GetOutput()), 3.0);
  EXPECT_EQ(filter->GetNumberOfBoundaryEdges(), 6);
}

TEST(GodObjectFilter, TakesNonPlanarQuadsAsTwoTriangles)
{
  Parts parts = Cube();
  parts.Points[7] = { 1.3, 1.2, 1.4 }; // three quads are bent now
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 12);
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_TRUE(filter->GetOriented());
}

TEST(GodObjectFilter, WindsEveryTriangleOfAStripTheSameWay)
{
  //  1---3---5
  //  | \ | \ |
  //  0---2---4
  Parts parts;
  for (int i = 0; i < 6; ++i)
  {
    parts.Points.push_back({ double(i / 2), double(i % 2), 0 });
  }
  parts.Strips = { { 0, 2, 1, 3 }, { 2, 4, 3, 5 } };
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 4);
  EXPECT_DOUBLE_EQ(Area(filter->GetOutput()), 2.0);
  EXPECT_EQ(filter->GetNumberOfFlippedEdges(), 0);
  EXPECT_EQ(Ids(filter->GetOutput()->GetCellData(), "OriginalCellId"),
    (std::vector<vtkIdType>{ 0, 0, 1, 1 }));
}

TEST(GodObjectFilter, CarriesCellDataThroughMixedCells)
{
  // Cell ids count verts, then lines, polys and strips, whatever order they were made in.
  Parts parts = Square;
  parts.Points.insert(parts.Points.end(), { { 2, 0, 0 }, { 2, 1, 0 } });
  parts.Verts = { { 0 } };
  parts.Lines = { { 0, 1 }, { 1, 2 } };
  parts.Strips = { { 1, 4, 2, 5 } };
  auto input = MakePolyData(parts);
  vtkNew<vtkDoubleArray> pressure;
  pressure->SetName("Pressure");
  for (int i = 0; i < 5; ++i)
  {
    pressure->InsertNextValue(10.0 * i);
  }
  input->GetCellData()->SetScalars(pressure);
  auto filter = Prepare(input);
  vtkCellData* cellData = filter->GetOutput()->GetCellData();
  EXPECT_EQ(Ids(cellData, "OriginalCellId"), (std::vector<vtkIdType>{ 3, 3, 4, 4 }));
  ASSERT_NE(cellData->GetScalars(), nullptr);
  EXPECT_STREQ(cellData->GetScalars()->GetName(), "Pressure");
  EXPECT_EQ(cellData->GetScalars()->GetTuple1(1), 30.0);
  EXPECT_EQ(cellData->GetScalars()->GetTuple1(3), 40.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 4) << "verts and lines stay out";
}

/// Such arrays have no memory for point ids.
TEST(GodObjectFilter, LeavesOutCellsWithoutPoints)
{
  for (const bool is64Bit : { false, true })
  {
    vtkNew<vtkCellArray> polys;
    is64Bit ? polys->Use64BitStorage() : polys->Use32BitStorage();
    polys->InsertNextCell(0);
    polys->InsertNextCell(0);
    Parts parts = Square;
    parts.Polys.clear();
    parts.Strips = { { 0, 1, 3, 2 } };
    auto input = MakePolyData(parts);
    input->SetPolys(polys);
    auto filter = Prepare(input);
    EXPECT_EQ(
      Ids(filter->GetOutput()->GetCellData(), "OriginalCellId"), (std::vector<vtkIdType>{ 2, 2 }));
  }
}

/// Many enough for several threads: triangles, quads and pentagons, with cells of 32 bits and of
/// 64, and a strip after them.
TEST(GodObjectFilter, KeepsTheOrderOfManyCells)
{
  for (const bool is64Bit : { false, true })
  {
    constexpr int rows = 60000;
    vtkNew<vtkPoints> points;
    points->SetDataType(VTK_DOUBLE);
    vtkNew<vtkCellArray> polys;
    is64Bit ? polys->Use64BitStorage() : polys->Use32BitStorage();
    std::vector<vtkIdType> expected;
    for (int i = 0; i < rows; ++i)
    {
      const int corners = 3 + i % 3;
      polys->InsertNextCell(corners);
      for (int k = 0; k < corners; ++k)
      {
        const double angle = 2.0 * 3.14159265358979 * k / corners;
        polys->InsertCellPoint(
          points->InsertNextPoint(3.0 * i + std::cos(angle), std::sin(angle), 0.0));
      }
      expected.insert(expected.end(), static_cast<std::size_t>(corners - 2), i);
    }
    vtkNew<vtkCellArray> strips;
    strips->InsertNextCell({ 0, 1, 2, 3 });
    expected.insert(expected.end(), 2, rows);
    vtkNew<vtkPolyData> input;
    input->SetPoints(points);
    input->SetPolys(polys);
    input->SetStrips(strips);
    vtkNew<vtkGodObjectFilter> filter;
    filter->SetInputData(input);
    filter->Update();
    auto* const cells =
      vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetCellData()->GetArray("OriginalCellId"));
    ASSERT_NE(cells, nullptr);
    // The strip's first triangle is the first polygon again.
    expected.pop_back();
    ASSERT_EQ(cells->GetNumberOfValues(), static_cast<vtkIdType>(expected.size()));
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), cells->GetPointer(0)));
    EXPECT_EQ(filter->GetNumberOfDuplicateTriangles(), 1);
  }
}

TEST(GodObjectFilter, CarriesPointDataThroughMergedAndUnusedPoints)
{
  Parts parts = Square;
  parts.Points.insert(parts.Points.begin(), { 9, 9, 9 }); // unused
  parts.Points.insert(
    parts.Points.end(), { { 1, 0, 0 }, { 2, 0, 0 }, { 1, 1, 0 } }); // 5 is 2, 7 is 3
  parts.Polys = { { 1, 2, 3, 4 }, { 5, 6, 7 } };
  auto input = MakePolyData(parts);
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  vtkNew<vtkStringArray> label;
  label->SetName("Label");
  for (int i = 0; i < 8; ++i)
  {
    height->InsertNextValue(i);
    label->InsertNextValue(std::to_string(i));
  }
  input->GetPointData()->AddArray(height);
  input->GetPointData()->AddArray(label);
  auto filter = Prepare(input);
  vtkPointData* data = filter->GetOutput()->GetPointData();
  // 5 and 7 are merged for contact, but have values of their own.
  const std::vector<vtkIdType> expected{ 1, 2, 3, 4, 6, 5, 7 };
  EXPECT_EQ(Ids(data, "OriginalPointId"), expected);
  EXPECT_EQ(filter->GetSurface()->Points().size(), 5u);
  ASSERT_EQ(data->GetArray("Height")->GetNumberOfTuples(), 7);
  for (int i = 0; i < 7; ++i)
  {
    EXPECT_EQ(data->GetArray("Height")->GetTuple1(i), expected[i]);
  }
  EXPECT_EQ(vtkStringArray::SafeDownCast(data->GetAbstractArray("Label"))->GetValue(4), "6");
  EXPECT_EQ(filter->GetNumberOfMergedPoints(), 2);
  EXPECT_EQ(filter->GetNumberOfUnusedPoints(), 1);
  EXPECT_EQ(FieldValue(filter, "MergedPoints"), 2);
  EXPECT_EQ(FieldValue(filter, "UnusedPoints"), 1);
}

TEST(GodObjectFilter, CutsArraysThatAreLongerThanTheirElements)
{
  Parts parts;
  parts.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  parts.Polys = { { 0, 1, 2 } };
  auto input = MakePolyData(parts);
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(input->GetPointData()),
         static_cast<vtkDataSetAttributes*>(input->GetCellData()) })
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName("Values");
    values->SetNumberOfTuples(7);
    values->Fill(2.0);
    data->AddArray(values);
  }
  auto filter = Prepare(input);
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetPointData()->GetArray("Values")->GetNumberOfTuples(), 3);
  EXPECT_EQ(output->GetCellData()->GetArray("Values")->GetNumberOfTuples(), 1);
  EXPECT_EQ(output->GetCellData()->GetArray("Values")->GetTuple1(0), 2.0);
}

TEST(GodObjectFilter, ClosesACubeOfSixSeparateFaces)
{
  const Parts cube = Cube();
  Parts parts;
  for (const auto& face : cube.Polys)
  {
    parts.Polys.emplace_back();
    for (const vtkIdType corner : face)
    {
      parts.Polys.back().push_back(static_cast<vtkIdType>(parts.Points.size()));
      parts.Points.push_back(cube.Points[corner]);
    }
  }
  auto filter = Prepare(MakePolyData(parts, VTK_FLOAT));
  EXPECT_EQ(filter->GetNumberOfMergedPoints(), 16);
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_EQ(filter->GetNumberOfComponents(), 1);
}

TEST(GodObjectFilter, MergesPointsWithinATolerance)
{
  Parts parts = Cube();
  parts.Points.push_back({ 1 + 1e-6, 1, 1 }); // face 5 gets a corner of its own
  parts.Polys[5][2] = 8;
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(MakePolyData(parts));
  filter->Update();
  EXPECT_FALSE(filter->GetClosed());
  filter->SetMergeTolerance(1e-5); // of a diagonal of 1.7
  filter->Update();
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_EQ(filter->GetNumberOfMergedPoints(), 1);
  filter->SetMergeTolerance(0.8e-6); // less than the gap if absolute, more if relative
  filter->Update();
  EXPECT_TRUE(filter->GetClosed());
  filter->MergeToleranceIsAbsoluteOn();
  filter->Update();
  EXPECT_FALSE(filter->GetClosed());
}

TEST(GodObjectFilter, DropsTrianglesWithoutArea)
{
  Parts parts = Square;
  parts.Points.push_back({ 0.5, 0, 0 });
  parts.Polys.insert(parts.Polys.end(),
    {
      { 0, 0, 1 },    // repeated corner
      { 0, 4, 1 },    // on one line
      { 2, 2, 2, 2 }, // all corners one
      { 0, 1 },       // too few
      { 0, 0, 1, 1 }  // a quad of two points
    });
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 2);
  EXPECT_EQ(filter->GetNumberOfDegenerateTriangles(), 5);
  EXPECT_EQ(FieldValue(filter, "DegenerateTriangles"), 5);
  EXPECT_EQ(filter->GetNumberOfUnusedPoints(), 1) << "only dropped triangles used point 4";
  EXPECT_EQ(filter->GetNumberOfFoldedPolygons(), 0);
}

TEST(GodObjectFilter, StaysClosedWhereTrianglesWithoutAreaJoinedIt)
{
  // The front of the cube has three corners more on its upper edge, 4-5; the top has none. Flat
  // triangles join them, one of them along another: only together can they go.
  Parts parts = Cube();
  parts.Points.insert(parts.Points.end(), { { 0.25, 0, 1 }, { 0.5, 0, 1 }, { 0.75, 0, 1 } });
  parts.Polys[2] = { 0, 1, 5, 10, 9, 8, 4 };
  parts.Polys.insert(parts.Polys.end(), { { 8, 9, 4 }, { 4, 9, 5 }, { 9, 10, 5 } });
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetNumberOfDegenerateTriangles(), 3);
  EXPECT_TRUE(filter->GetClosed());
  EXPECT_TRUE(filter->GetOriented());
  EXPECT_DOUBLE_EQ(Volume(filter->GetOutput()), 1.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 11);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 2 * 11 - 4) << "Euler's formula";
}

TEST(GodObjectFilter, KeepsTinyTriangles)
{
  // Absolute cut-offs make small or finely divided surfaces vanish.
  for (const double scale : { 1e-9, 1e-30, 1e9 })
  {
    Parts parts = Cube();
    for (Point& point : parts.Points)
    {
      point = { scale * point[0], scale * point[1], scale * point[2] };
    }
    auto filter = Prepare(MakePolyData(parts));
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 12) << scale;
    EXPECT_TRUE(filter->GetClosed()) << scale;
  }
}

TEST(GodObjectFilter, DropsDuplicatesButKeepsTheOtherSide)
{
  Parts parts = Square;
  parts.Polys = { { 0, 1, 2 }, { 1, 2, 0 }, { 0, 2, 1 }, { 0, 2, 3 } };
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetNumberOfDuplicateTriangles(), 1);
  EXPECT_EQ(
    Ids(filter->GetOutput()->GetCellData(), "OriginalCellId"), (std::vector<vtkIdType>{ 0, 2, 3 }));
}

TEST(GodObjectFilter, ReportsPolygonsThatCrossThemselves)
{
  Parts parts = Square;
  parts.Polys = { { 0, 1, 2, 3 }, { 0, 2, 1, 3 } };
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher messages(filter);
  filter->SetInputData(MakePolyData(parts));
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfFoldedPolygons(), 1);
  EXPECT_NE(messages.Warnings().find("cell 1"), std::string::npos) << messages.Warnings();
  EXPECT_TRUE(filter->GetSurface());
}

TEST(GodObjectFilter, LeavesOutGhostAndBlankedCells)
{
  auto input = MakePolyData(Cube());
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(6);
  ghosts->FillValue(0);
  ghosts->SetValue(1, vtkDataSetAttributes::DUPLICATECELL);
  ghosts->SetValue(4, vtkDataSetAttributes::HIDDENCELL);
  input->GetCellData()->AddArray(ghosts);
  auto filter = Prepare(input);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 8);
  EXPECT_EQ(filter->GetNumberOfGhostCells(), 2);
}

TEST(GodObjectFilter, ReportsTopologyAsFieldDataToo)
{
  Parts parts = Cube();
  std::swap(parts.Polys[0][1], parts.Polys[0][3]); // the bottom turned over
  parts.Polys.push_back({ 0, 1, 7, 6 });           // a sheet from edge 0-1 to edge 6-7
  auto filter = Prepare(MakePolyData(parts));
  EXPECT_EQ(filter->GetNumberOfNonManifoldEdges(), 2);
  EXPECT_EQ(filter->GetNumberOfBoundaryEdges(), 2);
  EXPECT_EQ(filter->GetNumberOfFlippedEdges(), 3);
  EXPECT_EQ(FieldValue(filter, "NonManifoldEdges"), 2);
  EXPECT_EQ(FieldValue(filter, "BoundaryEdges"), 2);
  EXPECT_EQ(FieldValue(filter, "FlippedEdges"), 3);
  EXPECT_EQ(FieldValue(filter, "Closed"), 0);
  EXPECT_EQ(FieldValue(filter, "Oriented"), 0);
  auto* side = vtkStringArray::SafeDownCast(
    filter->GetOutput()->GetFieldData()->GetAbstractArray("TouchedSide"));
  ASSERT_NE(side, nullptr);
  EXPECT_EQ(side->GetValue(0), "Both");
}

TEST(GodObjectFilter, LeavesOutArraysThatAreTooShort)
{
  auto input = MakePolyData(Cube());
  vtkNew<vtkDoubleArray> tooShort;
  tooShort->SetName("TooShort");
  tooShort->InsertNextValue(1.0);
  input->GetPointData()->AddArray(tooShort);
  vtkNew<vtkGodObjectFilter> filter;
  MessageCatcher messages(filter);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("TooShort"), nullptr);
  EXPECT_NE(messages.Warnings(), "");
  EXPECT_TRUE(filter->GetSurface());
}

// A terrain of 2 m at UTM coordinates, in the single precision of a reader.
TEST(GodObjectFilter, ReportsTrianglesThatSinglePrecisionHasCollapsed)
{
  const int n = 20;
  for (const bool isSingle : { true, false })
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(isSingle ? VTK_FLOAT : VTK_DOUBLE);
    vtkNew<vtkCellArray> cells;
    for (vtkIdType i = 0; i < n * n; ++i)
    {
      points->InsertNextPoint(540169.0 + 0.1 * static_cast<double>(i % n),
        5094171.2 + 0.1 * static_cast<double>(i / n), 2316.6);
    }
    for (vtkIdType i = 0; i + n + 1 < n * n; ++i)
    {
      if (i % n + 1 < n)
      {
        cells->InsertNextCell({ i, i + 1, i + n + 1, i + n });
      }
    }
    vtkNew<vtkPolyData> terrain;
    terrain->SetPoints(points);
    terrain->SetPolys(cells);
    vtkNew<vtkGodObjectFilter> filter;
    MessageCatcher messages(filter);
    filter->SetInputData(terrain);
    filter->Update();
    EXPECT_EQ(messages.Errors(), "");
    const std::string lost = std::to_string(filter->GetNumberOfDegenerateTriangles()) + " of ";
    EXPECT_EQ(messages.Warnings().find(lost) != std::string::npos, isSingle) << messages.Warnings();
    EXPECT_EQ(messages.Warnings().find("float64") != std::string::npos, isSingle);
    // The way out that is given: an offset, subtracted where the points still are float64.
    for (vtkIdType i = 0; isSingle && i < n * n; ++i)
    {
      points->SetPoint(
        i, 0.1 * static_cast<double>(i % n), 0.1 * static_cast<double>(i / n), 2316.6);
    }
    points->Modified();
    MessageCatcher after(filter);
    filter->Update();
    EXPECT_EQ(after.Warnings(), "");
    EXPECT_EQ(filter->GetNumberOfDegenerateTriangles(), 0);
  }
}
