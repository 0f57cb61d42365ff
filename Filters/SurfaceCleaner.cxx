#include "haptics/Filters/SurfaceCleaner.h"

#include "haptics/Filters/CellReader.h"
#include "haptics/Filters/DuplicateTriangles.h"
#include "haptics/Filters/EqualPoints.h"
#include "haptics/Filters/FlatTriangles.h"
#include "haptics/Filters/GhostCells.h"
#include "haptics/Filters/PointMerger.h"
#include "haptics/Filters/PointReader.h"
#include "haptics/Filters/PolygonSplitter.h"
#include "haptics/Math/AccurateCross.h"
#include "haptics/Math/CoordinateRange.h"
#include "haptics/Math/LargePages.h"
#include "haptics/Math/ParallelFor.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>
#include <thread>
#include <utility>

namespace haptics
{
namespace
{
/// Cells or points that a thread takes at once.
constexpr std::size_t PieceSize = 1 << 14;
constexpr std::int32_t Unused = -1;

/// Of ids that CheckSize() has found to be small enough.
Triangle ToTriangle(vtkIdType a, vtkIdType b, vtkIdType c)
{
  return { static_cast<std::int32_t>(a), static_cast<std::int32_t>(b),
    static_cast<std::int32_t>(c) };
}

/// Writes a number that several threads may write at once, all the same.
void Mark(std::int32_t& number, std::int32_t value)
{
  __atomic_store_n(&number, value, __ATOMIC_RELAXED);
}

/// Makes `lowest` the lower of the two.
void Lower(std::atomic<std::size_t>& lowest, std::size_t number)
{
  std::size_t known = lowest;
  while (number < known && !lowest.compare_exchange_weak(known, number))
  {
  }
}

/// What cells that follow on each other become.
struct Triangulated
{
  std::vector<Triangle> Triangles;
  std::vector<vtkIdType> OriginalCell;   ///< as CleanedMesh
  std::vector<Triangle> OriginalCorners; ///< as CleanedMesh
  std::vector<Triangle> Flat; ///< dropped for lack of area, but with three different corners
  std::int64_t Degenerate = 0;
  std::int64_t Folded = 0;
  vtkIdType FirstFolded = -1;
};

/// Cuts cells into triangles; one thread has one. All that it is given is only read.
class Triangulator
{
public:
  Triangulator(const std::vector<std::int32_t>& merged, const std::vector<Vec3>& world,
    const std::vector<Vec3>& local, bool areMerged, PolygonSplitter::GoOnCall goOn)
    : Merged(merged)
    , World(world)
    , Local(local)
    , AreMerged(areMerged)
    , GoOn(std::move(goOn))
  {
  }

  /// False where the work is to stop.
  bool AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* points);
  void AddStrip(vtkIdType cell, vtkIdType size, const vtkIdType* points);

  Triangulated Output;

private:
  void AddTriangle(vtkIdType cell, const Triangle& points);

  const std::vector<std::int32_t>& Merged;
  const std::vector<Vec3>& World;
  const std::vector<Vec3>& Local;
  bool AreMerged;
  PolygonSplitter::GoOnCall GoOn;
  PolygonSplitter Splitter;
  std::vector<std::int32_t> Outline; // input points
  std::vector<Vec3> Corners;
};

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
  bool Measure(Vec3& low, Vec3& high);

private:
  bool CheckSize();
  bool MarkCells(const CellReader& cells, vtkIdType firstCell);
  bool FindBounds(const PointReader& points);
  bool MarkUsedPoints();
  void TakeFrame();
  bool MergePoints();
  bool MergeNear(double tolerance);
  bool MergeEqual();
  bool Triangulate(const CellReader& cells, vtkIdType firstCell, bool areStrips,
    std::vector<Triangulated>& pieces);
  void Join(const std::vector<Triangulated>& pieces);
  bool Triangulate();
  bool HasUnusedPoints() const;
  void DropUnusedPoints();
  /// Says how far the work is, from the thread that asked for it.
  bool Report(double fraction);
  /// The work from here on, up to a fraction of all.
  ProgressCall Until(double fraction)
  {
    const double from = this->Fraction;
    return [=](double share) { return this->Report(from + share * (fraction - from)); };
  }
  bool Fail(const std::string& text);

  vtkPolyData* Input;
  const CleaningOptions& Options;
  const ProgressCall& Progress;
  CleanedMesh& Cleaned;
  std::string& Error;
  vtkUnsignedCharArray* Ghosts;

  std::atomic<bool> Stopped{ false };
  double Fraction = 0.0;
  vtkIdType FirstStrip = 0;
  Vec3 Low{ HUGE_VAL, HUGE_VAL, HUGE_VAL }; // of used points
  Vec3 High{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  Vec3 Origin{};
  double Diagonal = 0.0;
  std::int64_t UsedPoints = 0;
  std::vector<std::int32_t> Merged; // for each input point its kept point, or Unused
  std::vector<Vec3> Local;          // kept points relative to Origin
  std::vector<Triangle> Flat;       // of all cells
};

bool Cleaner::Fail(const std::string& text)
{
  this->Error = text;
  return false;
}

bool Cleaner::Report(double fraction)
{
  this->Fraction = fraction;
  if (!this->Stopped && this->Progress && !this->Progress(fraction))
  {
    this->Stopped = true;
  }
  return !this->Stopped;
}

bool Cleaner::CheckSize()
{
  vtkPolyData* input = this->Input;
  const vtkIdType firstPoly = input->GetNumberOfVerts() + input->GetNumberOfLines();
  this->FirstStrip = firstPoly + input->GetNumberOfPolys();
  if (!this->Options.Frame && input->GetNumberOfPolys() == 0 && input->GetNumberOfStrips() == 0)
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

/// Marks the points that cells use, in Merged.
bool Cleaner::MarkCells(const CellReader& cells, vtkIdType firstCell)
{
  const auto known = static_cast<vtkIdType>(this->Merged.size());
  const auto isKnown = [known](vtkIdType point) { return point >= 0 && point < known; };
  std::atomic<std::size_t> bad{ cells.NumberOfCells() };
  const bool isDone = ParallelFor(
    cells.NumberOfCells(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      std::vector<vtkIdType> memory;
      vtkIdType size = 0;
      for (std::size_t cell = first; cell < last; ++cell)
      {
        if (IsGhostCell(this->Ghosts, firstCell + static_cast<vtkIdType>(cell)))
        {
          continue;
        }
        const vtkIdType* const points = cells.At(cell, size, memory);
        for (vtkIdType i = 0; i < size; ++i)
        {
          if (!isKnown(points[i]))
          {
            Lower(bad, cell);
            return;
          }
          Mark(this->Merged[static_cast<std::size_t>(points[i])], 0);
        }
      }
    },
    [this](double) { return this->Report(this->Fraction); });
  if (isDone && bad < cells.NumberOfCells())
  {
    std::vector<vtkIdType> memory;
    vtkIdType size = 0;
    const vtkIdType* const points = cells.At(bad, size, memory);
    std::ostringstream text;
    text << "Cell " << firstCell + static_cast<vtkIdType>(bad) << " names point "
         << *std::find_if_not(points, points + size, isKnown) << ", but the input has " << known
         << " points. Repair the cell array of the source.";
    return this->Fail(text.str());
  }
  return isDone;
}

/// Of the used points.
bool Cleaner::FindBounds(const PointReader& points)
{
  std::mutex mutex;
  Vec3& low = this->Low;
  Vec3& high = this->High;
  std::atomic<std::size_t> bad{ this->Merged.size() };
  const bool isDone = ParallelFor(
    this->Merged.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      Vec3 lowest{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
      Vec3 highest{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
      std::int64_t used = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        if (this->Merged[i] == Unused)
        {
          continue;
        }
        ++used;
        const Vec3 point = points.At(static_cast<vtkIdType>(i));
        if (!IsInRange(point)) // as TriangleSurface demands
        {
          Lower(bad, i);
          return;
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          lowest[axis] = std::min(lowest[axis], point[axis]);
          highest[axis] = std::max(highest[axis], point[axis]);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      this->UsedPoints += used;
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], lowest[axis]);
        high[axis] = std::max(high[axis], highest[axis]);
      }
    },
    [this](double) { return this->Report(this->Fraction); });
  if (isDone && bad < this->Merged.size())
  {
    const Vec3 point = points.At(static_cast<vtkIdType>(bad));
    std::ostringstream text;
    text << "Point " << bad << " is (" << point[0] << ", " << point[1] << ", " << point[2]
         << "): not finite, or beyond 1e70. It is the first such point. Remove the cells that "
            "use it, or mend the source that made it.";
    return this->Fail(text.str());
  }
  this->TakeFrame();
  return isDone;
}

void Cleaner::TakeFrame()
{
  if (const CleaningFrame* const frame = this->Options.Frame)
  {
    this->Origin = frame->Origin;
    this->Diagonal = frame->Diagonal;
    this->Cleaned.LargestCoordinate = frame->LargestCoordinate;
    return;
  }
  const Vec3& low = this->Low;
  const Vec3& high = this->High;
  double squared = 0.0;
  for (int axis = 0; axis < 3 && this->UsedPoints > 0; ++axis)
  {
    this->Origin[axis] = low[axis] + 0.5 * (high[axis] - low[axis]); // as TriangleSurface does
    squared += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    this->Cleaned.LargestCoordinate =
      std::max({ this->Cleaned.LargestCoordinate, std::abs(low[axis]), std::abs(high[axis]) });
  }
  this->Diagonal = std::sqrt(squared);
}

bool Cleaner::MarkUsedPoints()
{
  this->Merged.assign(static_cast<std::size_t>(this->Input->GetNumberOfPoints()), Unused);
  const vtkIdType firstPolygon = this->FirstStrip - this->Input->GetNumberOfPolys();
  return this->MarkCells(CellReader(this->Input->GetPolys()), firstPolygon) &&
    this->MarkCells(CellReader(this->Input->GetStrips()), this->FirstStrip) &&
    (this->Merged.empty() || this->FindBounds(PointReader(this->Input->GetPoints())));
}

/// Points are equal where their coordinates relative to the origin are: the surface keeps these,
/// and two that differ by less than it can hold would make triangles that lose their area there.
bool Cleaner::MergePoints()
{
  const double tolerance =
    this->Options.MergeTolerance * (this->Options.AbsoluteTolerance ? 1.0 : this->Diagonal);
  this->Cleaned.MergedWithin = tolerance;
  this->Cleaned.OriginalPoint.reserve(static_cast<std::size_t>(this->UsedPoints));
  if (!(tolerance > 0.0 ? this->MergeNear(tolerance) : this->MergeEqual()))
  {
    return false;
  }
  for (vtkIdType cell = 0; this->Ghosts && cell < this->Ghosts->GetNumberOfValues(); ++cell)
  {
    this->Cleaned.Report.GhostCells += IsGhostCell(this->Ghosts, cell) ? 1 : 0;
  }
  const auto kept = static_cast<std::int64_t>(this->Local.size());
  this->Cleaned.Report.MergedPoints = this->UsedPoints - kept;
  this->Cleaned.Report.UnusedPoints =
    static_cast<std::int64_t>(this->Merged.size()) - this->UsedPoints;
  return true;
}

bool Cleaner::MergeNear(double tolerance)
{
  PointMerger merger(static_cast<std::size_t>(this->UsedPoints), tolerance);
  const PointReader points(this->Input->GetPoints());
  std::vector<Vec3>& world = this->Cleaned.Mesh.Points;
  ReserveLargePages(world, static_cast<std::size_t>(this->UsedPoints));
  const ProgressCall progress = this->Until(0.7);
  for (std::size_t i = 0; i < this->Merged.size(); ++i)
  {
    if (i % PieceSize == 0 &&
      !progress(static_cast<double>(i) / static_cast<double>(this->Merged.size())))
    {
      return false;
    }
    if (this->Merged[i] != Unused)
    {
      const Vec3 point = points.At(static_cast<vtkIdType>(i));
      const std::int32_t kept = merger.Insert(
        { point[0] - this->Origin[0], point[1] - this->Origin[1], point[2] - this->Origin[2] });
      this->Merged[i] = kept;
      if (static_cast<std::size_t>(kept) == world.size())
      {
        world.push_back(point);
        this->Cleaned.OriginalPoint.push_back(static_cast<vtkIdType>(i));
      }
    }
  }
  this->Local = merger.Points();
  return true;
}

bool Cleaner::MergeEqual()
{
  const PointReader points(this->Input->GetPoints());
  if (!FindEqualPoints(points, this->Origin, this->Merged, this->Until(0.7)))
  {
    return false;
  }
  // From the first equal input point to the number of the kept point.
  std::vector<vtkIdType>& original = this->Cleaned.OriginalPoint;
  for (std::size_t i = 0; i < this->Merged.size(); ++i)
  {
    std::int32_t& kept = this->Merged[i];
    if (kept == static_cast<std::int32_t>(i))
    {
      kept = static_cast<std::int32_t>(original.size());
      original.push_back(static_cast<vtkIdType>(i));
    }
    else if (kept != Unused)
    {
      kept = this->Merged[kept];
    }
  }
  std::vector<Vec3>& world = this->Cleaned.Mesh.Points;
  ReserveLargePages(world, original.size());
  world.resize(original.size());
  this->Local.resize(original.size());
  return ParallelFor(original.size(), PieceSize,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const Vec3 p = points.At(original[i]);
        world[i] = p;
        this->Local[i] = { p[0] - this->Origin[0], p[1] - this->Origin[1], p[2] - this->Origin[2] };
      }
    });
}

/// Whether a triangle has an area that rounding relative to the origin may have lost: the surface
/// keeps it.
bool HasAccurateArea(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return SquaredLength(AccurateCross(ToVector(a), ToVector(b), ToVector(c))) > 0.0;
}

/// Adds the triangle of three input points.
void Triangulator::AddTriangle(vtkIdType cell, const Triangle& points)
{
  const Triangle triangle{ this->Merged[points[0]], this->Merged[points[1]],
    this->Merged[points[2]] };
  if (!HasArea(this->Local[triangle[0]], this->Local[triangle[1]], this->Local[triangle[2]]) &&
    !HasAccurateArea(this->World[triangle[0]], this->World[triangle[1]], this->World[triangle[2]]))
  {
    ++this->Output.Degenerate;
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
    {
      this->Output.Flat.push_back(triangle);
    }
    return;
  }
  this->Output.Triangles.push_back(triangle);
  this->Output.OriginalCell.push_back(cell);
  if (this->AreMerged)
  {
    this->Output.OriginalCorners.push_back(points);
  }
}

bool Triangulator::AddPolygon(vtkIdType cell, vtkIdType size, const vtkIdType* points)
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
    ++this->Output.Degenerate;
    return true;
  }
  this->Corners.clear();
  for (const std::int32_t point : this->Outline)
  {
    this->Corners.push_back(this->Local[this->Merged[point]]);
  }
  const PolygonSplitter::Result result = this->Splitter.Split(this->Corners, this->GoOn);
  if (result == PolygonSplitter::Result::Stopped)
  {
    return false;
  }
  const std::size_t before = this->Output.OriginalCell.size();
  for (const PolygonSplitter::LocalTriangle& t : this->Splitter.Triangles())
  {
    this->AddTriangle(cell, { this->Outline[t[0]], this->Outline[t[1]], this->Outline[t[2]] });
  }
  if (result == PolygonSplitter::Result::Folded && this->Output.OriginalCell.size() > before)
  {
    this->Output.FirstFolded = this->Output.Folded == 0 ? cell : this->Output.FirstFolded;
    ++this->Output.Folded;
  }
  return true;
}

void Triangulator::AddStrip(vtkIdType cell, vtkIdType size, const vtkIdType* points)
{
  if (size < 3)
  {
    ++this->Output.Degenerate;
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

bool Cleaner::Triangulate(
  const CellReader& cells, vtkIdType firstCell, bool areStrips, std::vector<Triangulated>& pieces)
{
  const std::size_t firstPiece = pieces.size();
  pieces.resize(firstPiece + (cells.NumberOfCells() + PieceSize - 1) / PieceSize);
  const std::thread::id caller = std::this_thread::get_id();
  // A single polygon may take long: whoever asked for the work is asked meanwhile, on its thread.
  const auto goOn = [this, caller]
  {
    return std::this_thread::get_id() == caller ? this->Report(this->Fraction)
                                                : !this->Stopped.load();
  };
  return ParallelFor(
           cells.NumberOfCells(), PieceSize,
           [&](std::size_t first, std::size_t last)
           {
             Triangulator triangulator(this->Merged, this->Cleaned.Mesh.Points, this->Local,
               this->Cleaned.Report.MergedPoints > 0, goOn);
             triangulator.Output.Triangles.reserve(last - first);
             triangulator.Output.OriginalCell.reserve(last - first);
             std::vector<vtkIdType> memory;
             vtkIdType size = 0;
             for (std::size_t i = first; i < last; ++i)
             {
               const vtkIdType cell = firstCell + static_cast<vtkIdType>(i);
               if (IsGhostCell(this->Ghosts, cell))
               {
                 continue;
               }
               const vtkIdType* const points = cells.At(i, size, memory);
               if (areStrips)
               {
                 triangulator.AddStrip(cell, size, points);
               }
               else if (!triangulator.AddPolygon(cell, size, points))
               {
                 return;
               }
             }
             pieces[firstPiece + first / PieceSize] = std::move(triangulator.Output);
           },
           [this](double) { return this->Report(this->Fraction); }) &&
    !this->Stopped;
}

/// Puts together what the pieces have become, in the order of their cells.
void Cleaner::Join(const std::vector<Triangulated>& pieces)
{
  std::vector<std::size_t> starts;
  std::size_t count = 0;
  CleaningReport& report = this->Cleaned.Report;
  for (const Triangulated& piece : pieces)
  {
    starts.push_back(count);
    count += piece.Triangles.size();
    report.DegenerateTriangles += piece.Degenerate;
    report.FirstFoldedCell =
      report.FoldedPolygons == 0 ? piece.FirstFolded : report.FirstFoldedCell;
    report.FoldedPolygons += piece.Folded;
    this->Flat.insert(this->Flat.end(), piece.Flat.begin(), piece.Flat.end());
  }
  ReserveLargePages(this->Cleaned.Mesh.Triangles, count);
  this->Cleaned.Mesh.Triangles.resize(count);
  this->Cleaned.OriginalCell.resize(count);
  this->Cleaned.OriginalCorners.resize(report.MergedPoints > 0 ? count : 0);
  ParallelFor(pieces.size(), 1,
    [&](std::size_t i, std::size_t)
    {
      const auto copy = [start = starts[i]](const auto& from, auto& to)
      {
        if (!from.empty()) // else `to` may be empty too, as where no points are merged
        {
          std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(start));
        }
      };
      copy(pieces[i].Triangles, this->Cleaned.Mesh.Triangles);
      copy(pieces[i].OriginalCell, this->Cleaned.OriginalCell);
      copy(pieces[i].OriginalCorners, this->Cleaned.OriginalCorners);
    });
}

bool Cleaner::Triangulate()
{
  const vtkIdType firstPolygon = this->FirstStrip - this->Input->GetNumberOfPolys();
  std::vector<Triangulated> pieces;
  if (!this->Triangulate(CellReader(this->Input->GetPolys()), firstPolygon, false, pieces) ||
    !this->Triangulate(CellReader(this->Input->GetStrips()), this->FirstStrip, true, pieces))
  {
    return false;
  }
  this->Join(pieces);
  return true;
}

/// False where each corner of each cell is one of a triangle.
bool Cleaner::HasUnusedPoints() const
{
  vtkCellArray* const polys = this->Input->GetPolys();
  const CleaningReport& report = this->Cleaned.Report;
  return report.DegenerateTriangles + report.DuplicateTriangles + report.GhostCells > 0 ||
    this->Input->GetNumberOfStrips() > 0 ||
    static_cast<vtkIdType>(this->Cleaned.Mesh.Triangles.size()) !=
    polys->GetNumberOfConnectivityIds() - 2 * polys->GetNumberOfCells();
}

void Cleaner::DropUnusedPoints()
{
  if (!this->HasUnusedPoints())
  {
    this->Cleaned.KeptPoint = std::move(this->Merged);
    return;
  }
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

bool Cleaner::Measure(Vec3& low, Vec3& high)
{
  const bool isDone = this->CheckSize() && this->MarkUsedPoints();
  low = this->Low;
  high = this->High;
  return isDone;
}

CleaningResult Cleaner::Run()
{
  const bool done = this->CheckSize() && this->Report(0.0) && this->MarkUsedPoints() &&
    this->Report(0.2) && this->MergePoints() && this->Report(0.7) && this->Triangulate() &&
    this->Report(1.0);
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
  if (!this->Options.Frame && this->Cleaned.Mesh.Triangles.empty())
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

bool MeasureUsedPoints(vtkPolyData* input, Vec3& low, Vec3& high, std::string& error)
{
  CleaningOptions options;
  const CleaningFrame none; // a part may be empty
  options.Frame = &none;
  const ProgressCall progress;
  CleanedMesh cleaned;
  return Cleaner(input, options, progress, cleaned, error).Measure(low, high);
}

CleaningResult CleanSurface(vtkPolyData* input, const CleaningOptions& options,
  const ProgressCall& progress, CleanedMesh& cleaned, std::string& error)
{
  return Cleaner(input, options, progress, cleaned, error).Run();
}
}
