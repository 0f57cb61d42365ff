// Surfaces that come in pieces, and patches of them.
#include "../TemporaryFolder.h"
#include "FilterTesting.h"
#include "InPieces.h"
#include "TraceComparison.h"
#include "haptics/Filters/CleanPart.h"
#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "vtkGodObjectFilter.h"
#include "vtkGodObjectTrace.h"
#include "vtkHapticPatchSource.h"
#include "vtkHapticProperties.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetAlgorithm.h"
#include "vtkPointData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"
#include "vtkWeakPointer.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace testing_surfaces;
using haptics::PatchRecord;
using haptics::testing::LargestDifference;
using haptics::testing::LargestDistance;

namespace
{
/// Gives polydata in the pieces in which they are.
class PieceSource : public InPieces<vtkPolyDataAlgorithm>
{
public:
  static PieceSource* New();
  vtkTypeMacro(PieceSource, InPieces);

  std::vector<vtkSmartPointer<vtkPolyData>> Pieces;
  int Reads = 0;

protected:
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    ++this->Reads;
    vtkPolyData::GetData(out)->ShallowCopy(this->Pieces[static_cast<std::size_t>(PieceOf(out))]);
    return 1;
  }
};
vtkStandardNewMacro(PieceSource);

/// Gives of pieces that are asked for each as a partition of its own, as vtkHDFReader does with VTK
/// 9.5; `HasPlaces`: each at its place among all partitions, where none of the others are, as
/// with 9.7.
class PartitionSource : public InPieces<vtkPartitionedDataSetAlgorithm>
{
public:
  static PartitionSource* New();
  vtkTypeMacro(PartitionSource, InPieces);

  std::vector<vtkSmartPointer<vtkDataSet>> Pieces;
  bool HasPlaces = false;

protected:
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    const auto asked = static_cast<std::size_t>(PieceOf(out));
    const auto of = static_cast<std::size_t>(out->GetInformationObject(0)->Get(
      vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
    auto* const output = vtkPartitionedDataSet::GetData(out);
    unsigned int place = 0;
    for (std::size_t i = 0; i < this->Pieces.size(); ++i)
    {
      const bool isAsked = i * of / this->Pieces.size() == asked;
      if (isAsked)
      {
        output->SetPartition(place, this->Pieces[i]);
      }
      place += isAsked || this->HasPlaces ? 1 : 0;
    }
    if (this->HasPlaces)
    {
      output->SetNumberOfPartitions(place);
    }
    return 1;
  }
};
vtkStandardNewMacro(PartitionSource);

/// A bumpy closed surface of 2 * around * (across - 1) triangles, with an array of points and one
/// of cells; single precision, as scans are.
vtkSmartPointer<vtkPolyData> Bumps(int around, int across, double bump = 0.02)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(around);
  sphere->SetPhiResolution(across);
  sphere->SetRadius(0.05);
  sphere->SetCenter(0.2, 0.1, -0.3);
  sphere->SetGenerateNormals(false);
  sphere->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->ShallowCopy(sphere->GetOutput());
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double p[3];
    surface->GetPoint(i, p);
    const double d[3] = { p[0] - 0.2, p[1] - 0.1, p[2] + 0.3 };
    const double scale =
      1.0 + bump * std::sin(200.0 * d[0]) * std::sin(230.0 * d[1] + 1.0) * std::cos(170.0 * d[2]);
    points->InsertNextPoint(0.2 + scale * d[0], 0.1 + scale * d[1], -0.3 + scale * d[2]);
    height->InsertNextValue(scale);
  }
  surface->SetPoints(points);
  surface->GetPointData()->AddArray(height);
  vtkNew<vtkIdTypeArray> number;
  number->SetName("number");
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    number->InsertNextValue(7 * i);
  }
  surface->GetCellData()->AddArray(number);
  return surface;
}

using Choice = std::function<int(vtkIdType cell, const double* middle)>;

/// The cells of a surface in pieces, each with points of its own.
std::vector<vtkSmartPointer<vtkPolyData>> Cut(
  vtkPolyData* surface, int pieces, const Choice& choose)
{
  std::vector<vtkNew<vtkIdList>> cells(static_cast<std::size_t>(pieces));
  surface->BuildCells();
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, corners);
    double middle[3] = { 0.0, 0.0, 0.0 };
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      double p[3];
      surface->GetPoint(corners->GetId(k), p);
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] += p[axis] / static_cast<double>(corners->GetNumberOfIds());
      }
    }
    cells[static_cast<std::size_t>(choose(i, middle))]->InsertNextId(i);
  }
  std::vector<vtkSmartPointer<vtkPolyData>> cut;
  for (const auto& list : cells)
  {
    auto piece = vtkSmartPointer<vtkPolyData>::New();
    piece->GetPointData()->CopyAllocate(surface->GetPointData());
    piece->GetCellData()->CopyAllocate(surface->GetCellData());
    piece->AllocateEstimate(list->GetNumberOfIds(), 3);
    piece->SetPoints(vtkNew<vtkPoints>());
    piece->CopyCells(surface, list);
    cut.push_back(piece);
  }
  return cut;
}

int Stripe(const double* middle, int pieces)
{
  return std::clamp(static_cast<int>((middle[0] - 0.15) / 0.1 * pieces), 0, pieces - 1);
}

vtkSmartPointer<vtkPolyData> Joined(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces)
{
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* const piece : pieces)
  {
    append->AddInputData(piece);
  }
  append->Update();
  return append->GetOutput();
}

/// The record that the parts come to; merged pairwise from the front, or from the back, as if by
/// processes that send it to each other.
PatchRecord Count(const std::vector<vtkSmartPointer<vtkPolyData>>& parts, bool isFromBack = false,
  double tolerance = 0.0)
{
  std::string error;
  std::vector<haptics::PartBox> boxes(parts.size());
  haptics::PartBox all;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    EXPECT_TRUE(haptics::MeasureUsedPoints(parts[i], boxes[i].Low, boxes[i].High, error)) << error;
    all.Merge(boxes[i]);
  }
  const haptics::CleaningFrame frame = haptics::FrameOf(all);
  std::vector<haptics::SurfaceCensus> counts(parts.size(), haptics::SurfaceCensus(tolerance));
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    std::vector<haptics::PartBox> others = boxes;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    haptics::CleaningOptions options;
    options.Frame = &frame;
    options.AbsoluteTolerance = true;
    options.MergeTolerance = tolerance;
    haptics::CleanedMesh cleaned;
    EXPECT_EQ(
      haptics::CleanSurface(parts[i], options, {}, cleaned, error), haptics::CleaningResult::Done)
      << error;
    counts[i].Add(cleaned, frame, others);
    counts[i].AddRanges(parts[i], cleaned);
  }
  while (counts.size() > 1)
  {
    const std::size_t to = isFromBack ? counts.size() - 2 : 0;
    haptics::SurfaceCensus received(tolerance);
    EXPECT_TRUE(received.Unpack(counts[to + 1].Pack()));
    counts[to].Merge(received);
    counts.erase(counts.begin() + static_cast<std::ptrdiff_t>(to) + 1);
  }
  return counts.front().Finish(all);
}

void ExpectSame(const PatchRecord& a, const PatchRecord& b)
{
  EXPECT_EQ(a.Whole, b.Whole);
  EXPECT_EQ(a.Whole.Report.BoundaryEdges, b.Whole.Report.BoundaryEdges);
  EXPECT_EQ(a.Whole.Report.NonManifoldEdges, b.Whole.Report.NonManifoldEdges);
  EXPECT_EQ(a.Whole.Report.FlippedEdges, b.Whole.Report.FlippedEdges);
  EXPECT_EQ(a.Whole.Report.Components, b.Whole.Report.Components);
  EXPECT_EQ(a.Whole.Report.InsideOutComponents, b.Whole.Report.InsideOutComponents);
  EXPECT_EQ(a.Whole.Triangles, b.Whole.Triangles);
  EXPECT_EQ(a.Frame.Origin, b.Frame.Origin);
  EXPECT_EQ(a.PointRanges, b.PointRanges);
  EXPECT_EQ(a.CellRanges, b.CellRanges);
}

/// The record against what a vtkGodObjectFilter finds of the whole.
void ExpectAsWhole(const PatchRecord& found, vtkPolyData* surface)
{
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputData(surface);
  filter->Update();
  ASSERT_TRUE(filter->GetSurface());
  haptics::WholeSurface whole = filter->GetSurface()->Whole();
  whole.Version = found.Whole.Version;
  whole.CrackWidth = found.Whole.CrackWidth;
  EXPECT_EQ(found.Whole.Origin, whole.Origin);
  EXPECT_EQ(found.Whole.Radius, whole.Radius);
  EXPECT_EQ(found.Whole.Diagonal, whole.Diagonal);
  EXPECT_EQ(found.Whole.LongestEdge, whole.LongestEdge);
  EXPECT_EQ(found.Whole.Report.BoundaryEdges, whole.Report.BoundaryEdges);
  EXPECT_EQ(found.Whole.Report.NonManifoldEdges, whole.Report.NonManifoldEdges);
  EXPECT_EQ(found.Whole.Report.FlippedEdges, whole.Report.FlippedEdges);
  EXPECT_EQ(found.Whole.Report.Components, whole.Report.Components);
  EXPECT_EQ(found.Whole, whole);
}

/// A path that presses over a Bumps() surface, round and round.
vtkSmartPointer<vtkPolyData> Path(int ticks, double turns, double depth)
{
  std::vector<Point> places;
  for (int i = 0; i < ticks; ++i)
  {
    const double t = static_cast<double>(i) / ticks;
    const double a = 2.0 * vtkMath::Pi() * turns * t;
    const double b = 1.2 * std::sin(3.0 * t);
    const double r = 0.05 - depth + (i < 50 ? 2e-4 * (50 - i) : 0.0);
    places.push_back({ 0.2 + r * std::cos(a) * std::cos(b), 0.1 + r * std::sin(a) * std::cos(b),
      -0.3 + r * std::sin(b) });
  }
  return MakePolyData({ places, {}, {}, {}, {} });
}

/// Of a stroke over what a producer gives.
vtkSmartPointer<vtkPolyData> TraceOver(vtkAlgorithmOutput* surface)
{
  vtkNew<vtkGodObjectTrace> filter;
  filter->SetInputData(Path(800, 1.0, 0.003));
  filter->SetSurfaceConnection(surface);
  filter->Update();
  return filter->GetOutput();
}

/// Compares two traces; how many values differ at all, and by how much points do.
void ExpectSameTrace(vtkPolyData* found, vtkPolyData* expected, vtkPolyData* surface)
{
  ASSERT_EQ(found->GetNumberOfPoints(), expected->GetNumberOfPoints());
  ASSERT_EQ(
    found->GetPointData()->GetNumberOfArrays(), expected->GetPointData()->GetNumberOfArrays());
  const double farthest = LargestDistance(found, expected);
  EXPECT_LT(farthest, 1e-12);
  std::printf("[ MEASURED ] farthest %g\n", farthest);
  for (int k = 0; k < expected->GetPointData()->GetNumberOfArrays(); ++k)
  {
    vtkDataArray* const a = expected->GetPointData()->GetArray(k);
    vtkDataArray* const b = found->GetPointData()->GetArray(a->GetName());
    ASSERT_TRUE(b) << a->GetName();
    ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues()) << a->GetName();
    if (std::string(a->GetName()) == "PointIds")
    {
      // Of the points of several pieces at one place it names one that is in the patch.
      for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
      {
        const double x = a->GetVariantValue(i).ToDouble();
        const double y = b->GetVariantValue(i).ToDouble();
        double p[3];
        double q[3];
        surface->GetPoint(static_cast<vtkIdType>(std::max(x, 0.0)), p);
        surface->GetPoint(static_cast<vtkIdType>(std::max(y, 0.0)), q);
        EXPECT_TRUE(x == y || (x >= 0.0 && y >= 0.0 && std::equal(p, p + 3, q))) << i;
      }
      continue;
    }
    if (std::string(a->GetName()) == "EnergyTank")
    {
      // It holds as much as the stiffest place may need: of a patch that is the stiffest in it.
      for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
      {
        ASSERT_LE(b->GetComponent(i, 0), a->GetComponent(i, 0) + 1e-12) << i;
      }
      continue;
    }
    EXPECT_LT(LargestDifference(a, b), 1e-9) << a->GetName();
  }
}
}

TEST(PatchSource, PartsCountAsTheWhole)
{
  const auto surface = Bumps(60, 50);
  const PatchRecord whole = Count({ surface });
  EXPECT_TRUE(whole.Whole.Report.Closed);
  ExpectAsWhole(whole, surface);
  for (const int pieces : { 2, 4, 7 })
  {
    const auto stripes =
      Cut(surface, pieces, [&](vtkIdType, const double* m) { return Stripe(m, pieces); });
    ExpectSame(Count(stripes), whole);
    ExpectSame(Count(stripes, true), whole);
    // Dealt out triangle by triangle: every edge is on a seam.
    const auto dealt = Cut(
      surface, pieces, [&](vtkIdType i, const double*) { return static_cast<int>(i % pieces); });
    ExpectSame(Count(dealt), whole);
    ExpectSame(Count(dealt, true), whole);
  }
}

/// Two processes may place the same point some units of the last place apart.
TEST(PatchSource, PartsWhoseSeamsRoundInOtherWaysCountAsTheWhole)
{
  const auto surface = Bumps(60, 50);
  const double tolerance = 4e-7;
  const PatchRecord whole = Count({ surface }, false, tolerance);
  for (const int pieces : { 2, 4 })
  {
    auto stripes =
      Cut(surface, pieces, [&](vtkIdType, const double* m) { return Stripe(m, pieces); });
    for (std::size_t i = 1; i < stripes.size(); i += 2)
    {
      for (vtkIdType k = 0; k < stripes[i]->GetNumberOfPoints(); ++k)
      {
        double p[3];
        stripes[i]->GetPoint(k, p);
        stripes[i]->GetPoints()->SetPoint(k, p[0], p[1] * (1.0 + 2.0e-7), p[2]);
      }
    }
    const PatchRecord parted = Count(stripes);
    EXPECT_FALSE(parted.Whole.Report.Closed) << "without a tolerance the seam is open";
    const PatchRecord found = Count(stripes, false, tolerance);
    EXPECT_TRUE(found.Whole.Report.Closed);
    EXPECT_TRUE(found.Whole.Report.Oriented);
    EXPECT_EQ(found.Whole.Report.Components, 1);
    EXPECT_EQ(found.Whole.Report.InsideOutComponents, 0);
    EXPECT_EQ(found.Whole.Triangles, whole.Whole.Triangles);
    EXPECT_TRUE(Count(stripes, true, tolerance).Whole.Report.Closed);
  }
}

TEST(PatchSource, ACensusRejectsBytesThatAreNone)
{
  haptics::SurfaceCensus census;
  const std::string bytes = census.Pack();
  EXPECT_TRUE(census.Unpack(bytes));
  EXPECT_FALSE(census.Unpack(bytes + "x"));
  EXPECT_FALSE(census.Unpack(bytes.substr(0, bytes.size() - 1)));
  EXPECT_FALSE(census.Unpack(std::string(bytes.size(), '\x7f')));
  EXPECT_FALSE(census.Unpack(""));
}

TEST(PatchSource, RunsOfPolygonsFindWhatALookAtEachDoes)
{
  const auto surface = Bumps(120, 90);
  // In an order in which neighbours do not follow each other.
  const auto shuffled =
    Joined(Cut(surface, 7, [](vtkIdType i, const double*) { return static_cast<int>(i % 7); }));
  for (vtkPolyData* const part : { surface.Get(), shuffled.Get() })
  {
    const haptics::PolygonRuns runs(part);
    for (int i = 0; i < 40; ++i)
    {
      const double a = 0.37 * i;
      const haptics::Vec3 from{ 0.2 + 0.05 * std::cos(a), 0.1 + 0.05 * std::sin(a), -0.3 };
      const haptics::Vec3 to{ from[0], from[1] + 0.01 * std::sin(5.0 * a), from[2] + 0.02 };
      const haptics::PatchRegion region{ from, to, 0.001 * (1 + i % 9) };
      const auto each = haptics::CropPart(part, region, { 3, 5 });
      const auto found = haptics::CropPart(part, region, { 3, 5 }, &runs);
      ASSERT_EQ(found->GetNumberOfCells(), each->GetNumberOfCells());
      EXPECT_LT(found->GetNumberOfCells(), part->GetNumberOfCells());
      auto* const a1 =
        vtkIdTypeArray::SafeDownCast(each->GetCellData()->GetAbstractArray(PatchRecord::CellIds));
      auto* const a2 =
        vtkIdTypeArray::SafeDownCast(found->GetCellData()->GetAbstractArray(PatchRecord::CellIds));
      ASSERT_TRUE(a1 && a2);
      for (vtkIdType k = 0; k < a1->GetNumberOfValues(); ++k)
      {
        ASSERT_EQ(a1->GetValue(k), a2->GetValue(k));
      }
    }
  }
}

TEST(PatchSource, PartsOfBadSurfacesCountAsTheWhole)
{
  // A cube without a lid; two solids that share an edge; a fin; a flipped face; one within another.
  const Parts cube = Cube();
  std::vector<Parts> surfaces;
  surfaces.push_back(cube);
  surfaces.back().Polys.pop_back();
  surfaces.push_back(cube);
  for (const auto& quad : cube.Polys)
  {
    auto moved = quad;
    std::for_each(moved.begin(), moved.end(), [&](vtkIdType& p) { p += 8; });
    surfaces.back().Polys.push_back(moved);
  }
  for (const Point& p : cube.Points)
  {
    surfaces.back().Points.push_back({ p[0] + 1.0, p[1] + 1.0, p[2] });
  }
  surfaces.push_back(cube);
  std::reverse(surfaces.back().Polys[2].begin(), surfaces.back().Polys[2].end());
  surfaces.push_back(surfaces[1]);
  for (std::size_t i = 8; i < 16; ++i)
  {
    const Point& p = cube.Points[i - 8];
    surfaces.back().Points[i] = { 0.25 + 0.5 * p[0], 0.25 + 0.5 * p[1], 0.25 + 0.5 * p[2] };
  }
  for (std::size_t i = 6; i < 12; ++i)
  {
    std::reverse(surfaces.back().Polys[i].begin(), surfaces.back().Polys[i].end());
  }
  surfaces.push_back(surfaces.back());
  for (auto& quad : surfaces.back().Polys)
  {
    std::reverse(quad.begin(), quad.end());
  }
  for (std::size_t k = 0; k < surfaces.size(); ++k)
  {
    SCOPED_TRACE("surface " + std::to_string(k));
    const auto surface = MakePolyData(surfaces[k]);
    const PatchRecord whole = Count({ surface });
    ExpectAsWhole(whole, surface);
    for (const int pieces : { 2, 4 })
    {
      ExpectSame(Count(Cut(surface, pieces,
                   [&](vtkIdType i, const double*) { return static_cast<int>(i % pieces); })),
        whole);
      ExpectSame(Count(Cut(surface, pieces,
                   [&](vtkIdType i, const double*) { return i == 0 ? 0 : pieces - 1; })),
        whole);
    }
  }
}

TEST(PatchSource, PartsThatAreCutInSpaceKeepFewEdges)
{
  const auto surface = Bumps(200, 150);
  const auto stripes = Cut(surface, 4, [](vtkIdType, const double* m) { return Stripe(m, 4); });
  std::string error;
  std::vector<haptics::PartBox> boxes(4);
  haptics::PartBox all;
  for (int i = 0; i < 4; ++i)
  {
    ASSERT_TRUE(haptics::MeasureUsedPoints(stripes[i], boxes[i].Low, boxes[i].High, error));
    all.Merge(boxes[i]);
  }
  haptics::SurfaceCensus census;
  const haptics::CleaningFrame frame = haptics::FrameOf(all);
  haptics::CleaningOptions options;
  options.Frame = &frame;
  haptics::CleanedMesh cleaned;
  ASSERT_EQ(
    haptics::CleanSurface(stripes[1], options, {}, cleaned, error), haptics::CleaningResult::Done);
  census.Add(cleaned, frame, { boxes[0], boxes[2], boxes[3] });
  EXPECT_GT(census.NumberOfSharedEdges(), 100u);
  EXPECT_LT(census.NumberOfSharedEdges(), cleaned.Mesh.Triangles.size() / 10);
}

TEST(PatchSource, ATraceIsThatOverTheWholeSurface)
{
  const auto pieces =
    Cut(Bumps(240, 200), 6, [](vtkIdType, const double* m) { return Stripe(m, 6); });
  vtkNew<PieceSource> producer;
  producer->Pieces = pieces;
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(producer->GetOutputPort());
  source->SetNumberOfPieces(6);
  source->SetPatchRadius(0.004);
  const auto path = Path(3000, 3.0, 0.003);
  const auto trace = [&](bool isWhole, double tip, bool hasFriction)
  {
    auto filter = vtkSmartPointer<vtkGodObjectTrace>::New();
    filter->SetInputData(path);
    if (isWhole)
    {
      filter->SetSurfaceData(Joined(pieces));
    }
    else
    {
      filter->SetSurfaceConnection(source->GetOutputPort());
    }
    filter->SetTipRadius(tip);
    if (hasFriction)
    {
      filter->GetProperties()->SetConstant(vtkHapticProperties::STATIC_FRICTION, 0.5);
      filter->GetProperties()->SetConstant(vtkHapticProperties::DYNAMIC_FRICTION, 0.3);
      filter->GetProperties()->SetRange(vtkHapticProperties::STIFFNESS, 200.0, 800.0);
      filter->SetInputArrayToProcess(
        vtkHapticProperties::STIFFNESS, 1, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "height");
    }
    filter->Update();
    return vtkSmartPointer<vtkPolyData>(filter->GetOutput());
  };
  for (const bool hasFriction : { false, true })
  {
    SCOPED_TRACE(hasFriction ? "with material" : "plain");
    const auto expected = trace(true, 0.0, hasFriction);
    const auto found = trace(false, 0.0, hasFriction);
    ASSERT_GT(found->GetNumberOfPoints(), 0);
    ExpectSameTrace(found, expected, Joined(pieces));
  }
  EXPECT_GT(producer->Reads, 2 * 6) << "both passes, and pieces for patches";
  EXPECT_TRUE(source->GetClosed());
  EXPECT_EQ(source->GetNumberOfTriangles(), Joined(pieces)->GetNumberOfPolys());
}

TEST(PatchSource, AFileInPiecesIsTouchedAsTheWhole)
{
  const auto pieces =
    Cut(Bumps(120, 100), 5, [](vtkIdType, const double* m) { return Stripe(m, 5); });
  const TemporaryFolder folder;
  const std::string file = folder.File("scan.pvtp");
  std::ofstream list(file);
  list << "<VTKFile type=\"PPolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
          "<PPolyData GhostLevel=\"0\">\n<PPoints><PDataArray type=\"Float32\" Name=\"Points\" "
          "NumberOfComponents=\"3\"/></PPoints>\n<PPointData><PDataArray type=\"Float64\" "
          "Name=\"height\"/></PPointData>\n";
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const std::string name = "piece" + std::to_string(i) + ".vtp";
    vtkNew<vtkPolyData> piece;
    piece->ShallowCopy(pieces[i]);
    piece->GetCellData()->Initialize();
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(piece);
    writer->SetDataModeToBinary(); // not every VTK reads appended data: see surfaces.py
    writer->SetFileName(folder.File(name).c_str());
    ASSERT_EQ(writer->Write(), 1);
    list << "<Piece Source=\"" << name << "\"/>\n";
  }
  list << "</PPolyData></VTKFile>\n";
  list.close();
  vtkNew<vtkXMLPPolyDataReader> whole;
  whole->SetFileName(file.c_str());
  const auto expected = TraceOver(whole->GetOutputPort());
  vtkNew<vtkXMLPPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(reader->GetOutputPort());
  source->SetNumberOfPieces(5);
  source->SetPiecesInMemory(2);
  ExpectSameTrace(TraceOver(source->GetOutputPort()), expected, Joined(pieces));
}

/// A script may make the reader in a function that returns the source alone.
TEST(PatchSource, WhatGivesThePiecesStays)
{
  const auto surface = Bumps(40, 40);
  vtkNew<vtkHapticPatchSource> source;
  vtkWeakPointer<vtkAlgorithm> producer;
  {
    vtkNew<PieceSource> pieces;
    pieces->Pieces = { surface };
    source->SetSurfaceConnection(pieces->GetOutputPort());
    producer = pieces.Get();
  }
  ASSERT_NE(producer, nullptr);
  EXPECT_TRUE(source->Survey());
  EXPECT_EQ(source->GetNumberOfTriangles(), surface->GetNumberOfPolys());
  source->SetSurfaceConnection(nullptr);
  EXPECT_EQ(producer, nullptr) << "and is let go";
}

/// One .vtp with several pieces in it, as vtkXMLPolyDataWriter writes them.
TEST(PatchSource, AFileOfSeveralPiecesIsTouchedAsTheWhole)
{
  const auto surface = Bumps(120, 100);
  surface->GetCellData()->Initialize();
  const TemporaryFolder folder;
  const std::string file = folder.File("pieces.vtp");
  const auto cut = Cut(surface, 4, [](vtkIdType, const double* m) { return Stripe(m, 4); });
  vtkNew<PieceSource> pieces;
  pieces->Pieces = cut;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(pieces->GetOutputPort());
  writer->SetNumberOfPieces(4);
  writer->SetDataModeToBinary(); // not every VTK reads appended data: see surfaces.py
  writer->SetFileName(file.c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> whole;
  whole->SetFileName(file.c_str());
  const auto expected = TraceOver(whole->GetOutputPort());
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(reader->GetOutputPort());
  source->SetNumberOfPieces(4);
  source->SetPiecesInMemory(2);
  ExpectSameTrace(TraceOver(source->GetOutputPort()), expected, Joined(cut));
  EXPECT_LT(source->GetOutput()->GetNumberOfPolys(), surface->GetNumberOfPolys());
}

/// What gives partitions is touched as what gives polydata, whether a piece is one or several.
TEST(PatchSource, PartitionsAreTouchedAsTheWhole)
{
  const auto surface = Bumps(120, 100);
  const auto cut = Cut(surface, 6, [](vtkIdType, const double* m) { return Stripe(m, 6); });
  const auto whole = Joined(cut);
  vtkNew<vtkTrivialProducer> wholeProducer;
  wholeProducer->SetOutput(whole);
  const auto expected = TraceOver(wholeProducer->GetOutputPort());
  for (const bool hasPlaces : { false, true })
  {
    const int pieces = hasPlaces ? 6 : 3; // of one partition each, and of two
    SCOPED_TRACE(pieces);
    vtkNew<PartitionSource> producer;
    producer->Pieces.assign(cut.begin(), cut.end());
    producer->HasPlaces = hasPlaces;
    vtkNew<vtkHapticPatchSource> source;
    source->SetSurfaceConnection(producer->GetOutputPort());
    source->SetNumberOfPieces(pieces);
    source->SetPiecesInMemory(2);
    ExpectSameTrace(TraceOver(source->GetOutputPort()), expected, whole);
    EXPECT_EQ(source->GetNumberOfTriangles(), whole->GetNumberOfPolys());
    EXPECT_GT(cut[0]->GetNumberOfCells(), 0) << "the producer keeps what is its own";
  }
}

TEST(PatchSource, ErrorsSpeak)
{
  vtkNew<vtkHapticPatchSource> source;
  {
    const MessageCatcher messages(source);
    EXPECT_FALSE(source->Survey());
    EXPECT_NE(messages.Errors().find("There is no surface"), std::string::npos);
  }
  vtkNew<PieceSource> producer;
  producer->Pieces = { vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkPolyData>::New() };
  source->SetSurfaceConnection(producer->GetOutputPort());
  source->SetNumberOfPieces(2);
  {
    const MessageCatcher messages(source);
    EXPECT_FALSE(source->Survey());
    EXPECT_NE(messages.Errors().find("None of the 2 pieces"), std::string::npos)
      << messages.Errors();
  }
  const auto bad = MakePolyData(Cube());
  bad->GetPoints()->SetPoint(3, std::nan(""), 0.0, 0.0);
  producer->Pieces = { MakePolyData(Cube()), bad };
  producer->Modified();
  {
    const MessageCatcher messages(source);
    EXPECT_FALSE(source->Survey());
    EXPECT_NE(messages.Errors().find("Piece 1 of 2: Point 3 is (nan"), std::string::npos)
      << messages.Errors();
  }
  producer->Pieces = { MakePolyData(Cube()), vtkSmartPointer<vtkPolyData>::New() };
  producer->Modified();
  EXPECT_TRUE(source->Survey()) << "an empty piece is no error";
  {
    const MessageCatcher messages(source);
    source->SetPatchRadius(-1.0);
    const double here[3] = { 0.0, 0.0, 0.0 };
    source->SetRegion(here, here, 0.0);
    EXPECT_NE(messages.Errors().find("it stays 0"), std::string::npos);
    EXPECT_NE(messages.Errors().find("the last region stays"), std::string::npos);
  }
  vtkNew<PartitionSource> partitions;
  partitions->Pieces = { MakePolyData(Cube()), vtkSmartPointer<vtkUnstructuredGrid>::New() };
  source->SetSurfaceConnection(partitions->GetOutputPort());
  {
    const MessageCatcher messages(source);
    EXPECT_FALSE(source->Survey());
    EXPECT_NE(messages.Errors().find("gives vtkUnstructuredGrid. Connect what gives polydata"),
      std::string::npos)
      << messages.Errors();
  }
}

TEST(PatchSource, ARegionIsReadFromThePiecesThatItMeets)
{
  const auto surface = Bumps(60, 50);
  vtkNew<PieceSource> producer;
  producer->Pieces = Cut(surface, 8, [](vtkIdType, const double* m) { return Stripe(m, 8); });
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(producer->GetOutputPort());
  source->SetNumberOfPieces(8);
  source->SetPiecesInMemory(1);
  ASSERT_TRUE(source->Survey());
  const int before = producer->Reads;
  const double here[3] = { 0.151, 0.1, -0.3 };
  source->SetRegion(here, here, 0.004);
  source->Update();
  EXPECT_LE(producer->Reads - before, 2);
  vtkPolyData* const patch = source->GetOutput();
  EXPECT_GT(patch->GetNumberOfPolys(), 5);
  EXPECT_LT(patch->GetNumberOfPolys(), surface->GetNumberOfPolys() / 10);
  // Each with its array and number.
  const auto whole = Joined(producer->Pieces);
  vtkDataArray* const ids = patch->GetCellData()->GetArray(PatchRecord::CellIds);
  vtkDataArray* const numbers = patch->GetCellData()->GetArray("number");
  ASSERT_TRUE(ids && numbers);
  for (vtkIdType i = 0; i < patch->GetNumberOfCells(); ++i)
  {
    const auto cell = static_cast<vtkIdType>(ids->GetComponent(i, 0));
    EXPECT_EQ(
      numbers->GetComponent(i, 0), whole->GetCellData()->GetArray("number")->GetComponent(cell, 0));
  }
  vtkNew<vtkGodObjectFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->Update();
  ASSERT_TRUE(filter->GetSurface());
  EXPECT_TRUE(filter->GetClosed()) << "of the whole";
  EXPECT_EQ(filter->GetTouchedSide(), vtkGodObjectFilter::FRONT);
  EXPECT_FALSE(filter->GetOutput()->GetCellData()->GetArray(PatchRecord::CellIds));
  const double far[3] = { 1.0, 1.0, 1.0 };
  source->SetRegion(far, far, 0.1);
  filter->Update();
  ASSERT_TRUE(filter->GetSurface()) << "nothing is there, for certain";
  EXPECT_TRUE(filter->GetSurface()->Triangles().empty());
}

namespace
{
/// `call` makes `reporter` say `words`; after `remedy` it says nothing.
void ExpectRemedy(vtkObject* reporter, const std::string& words, const std::function<void()>& call,
  const std::function<void()>& remedy)
{
  {
    const MessageCatcher messages(reporter);
    call();
    EXPECT_NE(messages.Errors().find(words), std::string::npos) << words << "\n"
                                                                << messages.Errors();
  }
  remedy();
  const MessageCatcher messages(reporter);
  call();
  EXPECT_EQ(messages.Errors(), "") << words;
}
}

TEST(PatchSource, ARegionReachesUpToTheSurfaceAndKnowsWhatEnclosesIt)
{
  const auto pieces =
    Cut(Bumps(120, 100), 6, [](vtkIdType, const double* m) { return Stripe(m, 6); });
  const auto all = Joined(pieces);
  vtkNew<PieceSource> producer;
  producer->Pieces = pieces;
  vtkNew<vtkHapticPatchSource> source;
  source->SetSurfaceConnection(producer->GetOutputPort());
  source->SetNumberOfPieces(6);
  ASSERT_TRUE(source->Survey());
  const haptics::PolygonRuns runs(all);
  std::shared_ptr<const PatchRecord> record;
  int counted = 0;
  // In it and outside, some of them by a way within the patch before.
  for (const haptics::Vec3& off :
    { haptics::Vec3{ 0.03, 0.011, 0.007 }, haptics::Vec3{ 0.031, 0.011, 0.007 },
      haptics::Vec3{ 0.07, 0.02, 0.01 }, haptics::Vec3{ 0.01, -0.005, 0.002 },
      haptics::Vec3{ 0.0, -0.0495, 0.0 }, haptics::Vec3{ 0.003, -0.0505, 0.0 } })
  {
    SCOPED_TRACE(::testing::PrintToString(off));
    const haptics::Vec3 place{ 0.2 + off[0], 0.1 + off[1], -0.3 + off[2] };
    const auto distanceTo = [&place](const haptics::Vec3& p)
    { return std::hypot(p[0] - place[0], p[1] - place[1], p[2] - place[2]); };
    source->SetRegionUpToSurface(place.data(), place.data(), 0.002);
    source->Update();
    record = PatchRecord::ReadFrom(source->GetOutput()->GetFieldData());
    ASSERT_TRUE(record);
    const haptics::CleanPart whole(all, record->Frame);
    const haptics::CleanPart patch(source->GetOutput(), record->Frame);
    const double expected = distanceTo(whole.NearestTo(place).value());
    EXPECT_NEAR(record->Enclosure.HollowRadius, expected, 1e-12);
    EXPECT_NEAR(distanceTo(patch.NearestTo(place).value()), expected, 1e-12) << "it is there";
    for (const haptics::PolygonRuns* const given : { &runs, static_cast<decltype(&runs)>(nullptr) })
    {
      double distance = HUGE_VAL;
      const auto cell = haptics::CropNearest(all, place, distance, given);
      EXPECT_EQ(cell->GetNumberOfCells(), 1);
      EXPECT_NEAR(distance, expected, 1e-12);
      EXPECT_EQ(haptics::CropNearest(all, place, distance, given)->GetNumberOfCells(), 0)
        << "none is nearer";
    }
    ASSERT_TRUE(record->Enclosure.IsCounted);
    EXPECT_LT(record->Region.DistanceTo(record->Enclosure.Anchor), record->Region.Radius);
    const std::optional<int> count =
      whole.CountCrossings(record->Enclosure.Anchor, { 0.9, 0.83, 0.71 });
    ASSERT_TRUE(count);
    EXPECT_EQ(record->Enclosure.Count, *count);
    counted += *count;
  }
  EXPECT_GT(counted, 2);
  EXPECT_LT(counted, 6);
}

TEST(PatchSource, WhatMessagesAdviseEndsTheFault)
{
  const auto surface = Bumps(60, 50);
  vtkNew<vtkHapticPatchSource> source;
  vtkNew<PieceSource> producer;
  producer->Pieces = Cut(surface, 2, [](vtkIdType, const double* m) { return Stripe(m, 2); });
  source->SetNumberOfPieces(2);
  const auto survey = [&] { source->Survey(); };
  ExpectRemedy(source, "There is no surface. Connect what gives its pieces", survey,
    [&] { source->SetSurfaceConnection(producer->GetOutputPort()); });
  vtkNew<vtkXMLPPolyDataReader> missing;
  missing->SetFileName("no such file.pvtp");
  source->SetSurfaceConnection(missing->GetOutputPort());
  const MessageCatcher readers(missing);
  ExpectRemedy(source, ". Connect what gives polydata in pieces", survey,
    [&] { source->SetSurfaceConnection(producer->GetOutputPort()); });

  vtkPolyData* const second = producer->Pieces.back();
  vtkSmartPointer<vtkAbstractArray> numbers = second->GetCellData()->GetAbstractArray("number");
  second->GetCellData()->RemoveArray("number");
  producer->Modified();
  vtkNew<vtkGodObjectTrace> trace;
  trace->SetInputData(Path(400, 1.0, 0.003));
  trace->SetSurfaceConnection(source->GetOutputPort());
  const auto follow = [&]
  {
    trace->Modified();
    trace->Update();
  };
  ExpectRemedy(trace, "other data arrays in one piece than in another. Give all pieces", follow,
    [&] { trace->PassSurfaceArraysOff(); });
  trace->PassSurfaceArraysOn();
  ExpectRemedy(trace, "or call PassSurfaceArraysOff()", follow,
    [&]
    {
      second->GetCellData()->AddArray(numbers);
      producer->Modified();
    });
}
