#include "haptics/Filters/SurfaceCleaner.h"

#include "haptics/Filters/DuplicateTriangles.h"
#include "haptics/Filters/FlatTriangles.h"
#include "haptics/Filters/PointMerger.h"
#include "haptics/Filters/PolygonSplitter.h"
#include "haptics/Math/AccurateCross.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataSetAttributes.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace haptics
{
namespace
{
constexpr vtkIdType CellsPerProgress = 1 << 16;
constexpr std::int32_t Unused = -1;

/// Of ids that CheckSize() has found to be small enough.
Triangle ToTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
{
  return { static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
    static_cast<std::int32_t>(c) };
}

class Cleaner
{
public:
  Cleaner(vtkPolyData* input, const CleaningOptions& options, const ProgressCall& progress,
    CleanedMesh& cleaned, std::string& error)
    : Input(input)
    , Options(options)
    , Progress(progress)
    , Cleaned(cleaned)
    , Error(error)
    , Ghosts(input->GetCellGhostArray())
  {
  }

  CleaningResult Run();

private:
  template <typename Visitor>
  bool VisitCells(vtkCellArray* cells, vtkIdType firstCell, Visitor&& visit);
  bool IsGhost(vtkIdType cell) const;
  bool CheckSize();
  bool MarkCell(vtkIdType cell, vtkIdType size, const vtkIdType* points);
  bool MarkUsedPoints();
  bool MergePoints();
  bool AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* points);
  void AddStrip(vtkIdType cell, vtkIdType size, const vtkIdType* points);
  void AddTriangle(vtkIdType cell, const Triangle& points);
  bool Triangulate();
  void DropUnusedPoints();
  bool Report(double fraction);
  bool Fail(const std::string& text);

  vtkPolyData* Input;
  const CleaningOptions& Options;
  const ProgressCall& Progress;
  CleanedMesh& Cleaned;
  std::string& Error;
  vtkUnsignedCharArray* Ghosts;

  bool Stopped = false;
  double Fraction = 0.0;
  vtkIdType FirstStrip = 0;
  Vec3 Origin{};
  double Diagonal = 0.0;
  std::int64_t UsedPoints = 0;
  std::vector<std::int32_t> Merged; // for each input point its kept point, or Unused
  std::vector<Vec3> Local;          // kept points relative to Origin
  std::vector<Triangle> Flat;       // dropped for lack of area, but with three different corners
  PolygonSplitter Splitter;
  std::vector<std::int32_t> Outline; // input points
  std::vector<Vec3> Corners;
};

bool Cleaner::Fail(const std::string& text)
{
  this->Error = text;
  return false;
}

bool Cleaner::Report(double fraction)
{
  this->Fraction = fraction;
  this->Stopped = this->Stopped || (this->Progress && !this->Progress(fraction));
  return !this->Stopped;
}

bool Cleaner::IsGhost(vtkIdType cell) const
{
  constexpr unsigned char dropped = vtkDataSetAttributes::DUPLICATECELL |
    vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;
  return this->Ghosts && cell < this->Ghosts->GetNumberOfValues() &&
    (this->Ghosts->GetValue(cell) & dropped) != 0;
}

template <typename Visitor>
bool Cleaner::VisitCells(vtkCellArray* cells, vtkIdType firstCell, Visitor&& visit)
{
  auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    const vtkIdType index = iterator->GetCurrentCellId();
    if (index % CellsPerProgress == CellsPerProgress - 1 && !this->Report(this->Fraction))
    {
      return false;
    }
    if (this->IsGhost(firstCell + index))
    {
      continue;
    }
    iterator->GetCurrentCell(size, points);
    if (!visit(firstCell + index, size, points))
    {
      return false;
    }
  }
  return true;
}

bool Cleaner::CheckSize()
{
  vtkPolyData* input = this->Input;
  const vtkIdType firstPoly = input->GetNumberOfVerts() + input->GetNumberOfLines();
  this->FirstStrip = firstPoly + input->GetNumberOfPolys();
  if (input->GetNumberOfPolys() == 0 && input->GetNumberOfStrips() == 0)
  {
    std::ostringstream text;
    text << "The input has no polygon and no triangle strip to touch: it has "
         << input->GetNumberOfPoints() << " points, " << input->GetNumberOfVerts() << " verts and "
         << input->GetNumberOfLines()
         << " lines. Give it a surface, for example with a contour or an extract-surface filter "
            "before this one, or a tube filter for lines.";
    return this->Fail(text.str());
  }
  const vtkIdType corners = input->GetPolys()->GetNumberOfConnectivityIds() +
    input->GetStrips()->GetNumberOfConnectivityIds();
  if (std::max(corners, input->GetNumberOfPoints()) > std::numeric_limits<std::int32_t>::max())
  {
    return this->Fail("The input has more than 2^31 - 1 points or corners. Decimate or clip it "
                      "before this filter.");
  }
  return true;
}

bool Cleaner::MarkCell(vtkIdType cell, vtkIdType size, const vtkIdType* points)
{
  const auto known = static_cast<vtkIdType>(this->Merged.size());
  for (vtkIdType i = 0; i < size; ++i)
  {
    if (points[i] < 0 || points[i] >= known)
    {
      std::ostringstream text;
      text << "Cell " << cell << " names point " << points[i] << ", but the input has " << known
           << " points. Repair the cell array of the source.";
      return this->Fail(text.str());
    }
    this->Merged[points[i]] = 0;
  }
  return true;
}

bool Cleaner::MarkUsedPoints()
{
  this->Merged.assign(this->Input->GetNumberOfPoints(), Unused);
  const auto mark = [this](vtkIdType cell, vtkIdType size, const vtkIdType* points)
  { return this->MarkCell(cell, size, points); };
  if (!this->VisitCells(
        this->Input->GetPolys(), this->FirstStrip - this->Input->GetNumberOfPolys(), mark) ||
    !this->VisitCells(this->Input->GetStrips(), this->FirstStrip, mark))
  {
    return false;
  }
  Vec3 low{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vec3 high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  for (std::size_t i = 0; i < this->Merged.size(); ++i)
  {
    if (this->Merged[i] == Unused)
    {
      continue;
    }
    ++this->UsedPoints;
    Vec3 point;
    this->Input->GetPoint(static_cast<vtkIdType>(i), point.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(std::abs(point[axis]) < LargestCoordinate)) // as TriangleSurface demands
      {
        std::ostringstream text;
        text << "Point " << i << " is (" << point[0] << ", " << point[1] << ", " << point[2]
             << "): not finite, or beyond 1e70. It is the first such point. Remove the cells that "
                "use it, or mend the source that made it.";
        return this->Fail(text.str());
      }
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  double squared = 0.0;
  for (int axis = 0; axis < 3 && this->UsedPoints > 0; ++axis)
  {
    this->Origin[axis] = low[axis] + 0.5 * (high[axis] - low[axis]); // as TriangleSurface does
    squared += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    this->Cleaned.LargestCoordinate =
      std::max({ this->Cleaned.LargestCoordinate, std::abs(low[axis]), std::abs(high[axis]) });
  }
  this->Diagonal = std::sqrt(squared);
  return true;
}

/// Points are equal where their coordinates relative to the origin are: the surface keeps these,
/// and two that differ by less than it can hold would make triangles that lose their area there.
bool Cleaner::MergePoints()
{
  const double tolerance =
    this->Options.MergeTolerance * (this->Options.AbsoluteTolerance ? 1.0 : this->Diagonal);
  this->Cleaned.MergedWithin = tolerance;
  PointMerger merger(static_cast<std::size_t>(this->UsedPoints), tolerance);
  std::vector<Vec3>& world = this->Cleaned.Mesh.Points;
  std::vector<vtkIdType>& original = this->Cleaned.OriginalPoint;
  world.reserve(static_cast<std::size_t>(this->UsedPoints));
  original.reserve(static_cast<std::size_t>(this->UsedPoints));
  for (std::size_t i = 0; i < this->Merged.size(); ++i)
  {
    if (i % CellsPerProgress == 0 && !this->Report(this->Fraction))
    {
      return false;
    }
    if (this->Merged[i] != Unused)
    {
      Vec3 point;
      this->Input->GetPoint(static_cast<vtkIdType>(i), point.data());
      const std::int32_t kept = merger.Insert(
        { point[0] - this->Origin[0], point[1] - this->Origin[1], point[2] - this->Origin[2] });
      this->Merged[i] = kept;
      if (static_cast<std::size_t>(kept) == world.size())
      {
        world.push_back(point);
        original.push_back(static_cast<vtkIdType>(i));
      }
    }
  }
  this->Local = merger.Points();
  for (vtkIdType cell = 0; this->Ghosts && cell < this->Ghosts->GetNumberOfValues(); ++cell)
  {
    this->Cleaned.Report.GhostCells += this->IsGhost(cell) ? 1 : 0;
  }
  this->Cleaned.Report.MergedPoints = this->UsedPoints - static_cast<std::int64_t>(world.size());
  this->Cleaned.Report.UnusedPoints =
    static_cast<std::int64_t>(this->Merged.size()) - this->UsedPoints;
  return true;
}

/// Whether a triangle has an area that rounding relative to the origin may have lost: the surface
/// keeps it.
bool HasAccurateArea(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return SquaredLength(AccurateCross(ToVector(a), ToVector(b), ToVector(c))) > 0.0;
}

/// Adds the triangle of three input points.
void Cleaner::AddTriangle(vtkIdType cell, const Triangle& points)
{
  const Triangle triangle{ this->Merged[points[0]], this->Merged[points[1]],
    this->Merged[points[2]] };
  const std::vector<Vec3>& world = this->Cleaned.Mesh.Points;
  if (!HasArea(this->Local[triangle[0]], this->Local[triangle[1]], this->Local[triangle[2]]) &&
    !HasAccurateArea(world[triangle[0]], world[triangle[1]], world[triangle[2]]))
  {
    ++this->Cleaned.Report.DegenerateTriangles;
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
    {
      this->Flat.push_back(triangle);
    }
    return;
  }
  this->Cleaned.Mesh.Triangles.push_back(triangle);
  this->Cleaned.OriginalCell.push_back(cell);
  if (this->Cleaned.Report.MergedPoints > 0)
  {
    this->Cleaned.OriginalCorners.push_back(points);
  }
}

/// False where the work is to stop.
bool Cleaner::AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* points)
{
  if (size == 3)
  {
    this->AddTriangle(cell, ToTriangle(points[0], points[1], points[2]));
    return true;
  }
  const auto isSame = [this](std::int32_t a, std::int32_t b)
  { return this->Merged[a] == this->Merged[b]; };
  this->Outline.clear();
  for (vtkIdType i = 0; i < size; ++i)
  {
    const auto point = static_cast<std::int32_t>(points[i]);
    if (this->Outline.empty() || !isSame(this->Outline.back(), point))
    {
      this->Outline.push_back(point);
    }
  }
  while (this->Outline.size() > 1 && isSame(this->Outline.back(), this->Outline.front()))
  {
    this->Outline.pop_back();
  }
  if (this->Outline.size() < 3)
  {
    ++this->Cleaned.Report.DegenerateTriangles;
    return true;
  }
  this->Corners.clear();
  for (const std::int32_t point : this->Outline)
  {
    this->Corners.push_back(this->Local[this->Merged[point]]);
  }
  const PolygonSplitter::Result result =
    this->Splitter.Split(this->Corners, [this] { return this->Report(this->Fraction); });
  if (result == PolygonSplitter::Result::Stopped)
  {
    return false;
  }
  const std::size_t before = this->Cleaned.OriginalCell.size();
  for (const PolygonSplitter::LocalTriangle& t : this->Splitter.Triangles())
  {
    this->AddTriangle(cell, { this->Outline[t[0]], this->Outline[t[1]], this->Outline[t[2]] });
  }
  if (result == PolygonSplitter::Result::Folded && this->Cleaned.OriginalCell.size() > before)
  {
    CleaningReport& report = this->Cleaned.Report;
    report.FirstFoldedCell = report.FoldedPolygons == 0 ? cell : report.FirstFoldedCell;
    ++report.FoldedPolygons;
  }
  return true;
}

void Cleaner::AddStrip(vtkIdType cell, vtkIdType size, const vtkIdType* points)
{
  if (size < 3)
  {
    ++this->Cleaned.Report.DegenerateTriangles;
    return;
  }
  for (vtkIdType i = 0; i + 2 < size; ++i)
  {
    // Every other triangle of a strip is wound the other way.
    const vtkIdType second = i % 2 == 0 ? i + 1 : i + 2;
    const vtkIdType third = i % 2 == 0 ? i + 2 : i + 1;
    this->AddTriangle(cell, ToTriangle(points[i], points[second], points[third]));
  }
}

bool Cleaner::Triangulate()
{
  vtkCellArray* polys = this->Input->GetPolys();
  vtkCellArray* strips = this->Input->GetStrips();
  const auto expected = static_cast<std::size_t>(std::max<vtkIdType>(0,
    polys->GetNumberOfConnectivityIds() + strips->GetNumberOfConnectivityIds() -
      2 * (polys->GetNumberOfCells() + strips->GetNumberOfCells())));
  this->Cleaned.Mesh.Triangles.reserve(expected);
  this->Cleaned.OriginalCorners.reserve(this->Cleaned.Report.MergedPoints > 0 ? expected : 0);
  this->Cleaned.OriginalCell.reserve(expected);
  return this->VisitCells(polys, this->FirstStrip - polys->GetNumberOfCells(),
           [this](vtkIdType cell, vtkIdType size, const vtkIdType* points)
           { return this->AddPolygon(cell, size, points); }) &&
    this->VisitCells(strips, this->FirstStrip,
      [this](vtkIdType cell, vtkIdType size, const vtkIdType* points)
      {
        this->AddStrip(cell, size, points);
        return true;
      });
}

void Cleaner::DropUnusedPoints()
{
  std::vector<Vec3>& points = this->Cleaned.Mesh.Points;
  std::vector<vtkIdType>& original = this->Cleaned.OriginalPoint;
  std::vector<std::int32_t> moved(points.size(), Unused);
  for (const Triangle& t : this->Cleaned.Mesh.Triangles)
  {
    for (const std::int32_t corner : t)
    {
      moved[corner] = 0;
    }
  }
  std::int32_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (moved[i] != Unused)
    {
      points[kept] = points[i];
      original[kept] = original[i];
      moved[i] = kept++;
    }
  }
  this->Cleaned.Report.UnusedPoints += static_cast<std::int64_t>(points.size()) - kept;
  points.resize(kept);
  original.resize(kept);
  for (Triangle& t : this->Cleaned.Mesh.Triangles)
  {
    t = { moved[t[0]], moved[t[1]], moved[t[2]] };
  }
  this->Cleaned.KeptPoint = std::move(this->Merged);
  for (std::int32_t& point : this->Cleaned.KeptPoint)
  {
    point = point == Unused ? Unused : moved[point];
  }
}

CleaningResult Cleaner::Run()
{
  const bool done = this->CheckSize() && this->Report(0.0) && this->MarkUsedPoints() &&
    this->Report(0.1) && this->MergePoints() && this->Report(0.3) && this->Triangulate() &&
    this->Report(0.4);
  if (!done)
  {
    return this->Stopped ? CleaningResult::Aborted : CleaningResult::Failed;
  }
  this->Cleaned.Report.FlatTriangles = static_cast<std::int64_t>(this->Flat.size());
  if (!this->Flat.empty())
  {
    CloseFlatTriangles(this->Local, std::move(this->Flat), this->Cleaned);
  }
  for (std::size_t i = 0; this->Options.CellSides && i < this->Cleaned.OriginalCell.size(); ++i)
  {
    const auto cell = static_cast<std::size_t>(this->Cleaned.OriginalCell[i]);
    this->Cleaned.Mesh.Sides.push_back((*this->Options.CellSides)[cell]);
  }
  this->Cleaned.Report.DuplicateTriangles = DropDuplicateTriangles(
    this->Cleaned.Mesh, this->Cleaned.OriginalCell, this->Cleaned.OriginalCorners);
  this->DropUnusedPoints();
  const CleaningReport& report = this->Cleaned.Report;
  if (this->Cleaned.Mesh.Triangles.empty())
  {
    std::ostringstream text;
    text << "None of the " << this->Input->GetNumberOfPolys() << " polygons and "
         << this->Input->GetNumberOfStrips()
         << " strips has an area: " << report.DegenerateTriangles << " pieces have none, "
         << report.GhostCells
         << " cells are ghosts or blanked. Check the coordinates of the source, and the merge "
            "tolerance ("
         << this->Options.MergeTolerance
         << (this->Options.AbsoluteTolerance ? " world units)." : " of the bounds' diagonal).");
    this->Error = text.str();
    return CleaningResult::Failed;
  }
  return CleaningResult::Done;
}
}

CleaningResult CleanSurface(vtkPolyData* input, const CleaningOptions& options,
  const ProgressCall& progress, CleanedMesh& cleaned, std::string& error)
{
  return Cleaner(input, options, progress, cleaned, error).Run();
}
}
