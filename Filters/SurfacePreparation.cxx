#include "haptics/Filters/SurfacePreparation.h"

#include "haptics/Filters/DataPoints.h"
#include "haptics/Filters/PassAttributes.h"
#include "haptics/Filters/PointReader.h"
#include "haptics/Math/CoordinateRange.h"
#include "haptics/Math/ParallelFor.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <unordered_map>
#include <utility>

namespace haptics
{
namespace
{
/// The share of the time that a preparation takes for cleaning.
constexpr double CleanShare = 0.3;
/// From this share on triangles without area are reported.
constexpr double LeastShareOfCollapsed = 0.01;
/// Coordinates this many sizes of a surface away from the origin have lost digits.
constexpr double FarFromOrigin = 100.0;
/// Ids, points or triangles that a thread writes at once.
constexpr std::size_t ValuesPerPiece = 1 << 15;

vtkSmartPointer<vtkIdTypeArray> MakeIdArray(const char* name, const std::vector<vtkIdType>& ids)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  vtkIdType* const to = array->GetPointer(0);
  ParallelFor(ids.size(), ValuesPerPiece,
    [&](std::size_t first, std::size_t last)
    { std::copy(ids.begin() + first, ids.begin() + last, to + first); });
  return array;
}

template <class T>
void Write(const std::vector<Vec3>& from, vtkPoints* points)
{
  auto* const to = static_cast<T*>(points->GetVoidPointer(0));
  ParallelFor(from.size(), ValuesPerPiece,
    [&](std::size_t first, std::size_t last)
    {
      T* coordinate = to + 3 * first;
      for (std::size_t i = first; i < last; ++i)
      {
        coordinate = std::transform(
          from[i].begin(), from[i].end(), coordinate, [](double x) { return static_cast<T>(x); });
      }
    });
}

vtkSmartPointer<vtkPoints> MakePoints(const std::vector<Vec3>& from, int dataType)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(dataType == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(static_cast<vtkIdType>(from.size()));
  dataType == VTK_FLOAT ? Write<float>(from, points) : Write<double>(from, points);
  return points;
}

/// In 32 bits: half the memory. There are fewer than 2^31 corners, as the cleaning has seen.
vtkSmartPointer<vtkCellArray> MakeCells(const std::vector<Triangle>& triangles)
{
  const auto count = static_cast<vtkIdType>(triangles.size());
  vtkNew<vtkTypeInt32Array> offsets;
  vtkNew<vtkTypeInt32Array> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(3 * count);
  vtkTypeInt32* const starts = offsets->GetPointer(0);
  vtkTypeInt32* const corners = connectivity->GetPointer(0);
  ParallelFor(triangles.size(), ValuesPerPiece,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        starts[i] = static_cast<vtkTypeInt32>(3 * i);
        std::copy(triangles[i].begin(), triangles[i].end(), corners + 3 * i);
      }
    });
  starts[count] = static_cast<vtkTypeInt32>(3 * count);
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Whether two arrays hold the same values, as far as their memory shows.
bool HoldTheSame(vtkDataArray* a, vtkDataArray* b)
{
  if (a == b)
  {
    return true;
  }
  const auto isPlain = [](vtkDataArray* array)
  { return array && array->HasStandardMemoryLayout(); };
  return isPlain(a) && isPlain(b) && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfValues() == b->GetNumberOfValues() &&
    std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
      static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())) == 0;
}

bool HoldTheSame(vtkCellArray* a, vtkCellArray* b)
{
  return HoldTheSame(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
    HoldTheSame(a->GetConnectivityArray(), b->GetConnectivityArray());
}
}

std::string CheckSideArray(vtkDataArray* array, bool isOfCells, vtkPolyData* input)
{
  std::ostringstream problem;
  if (!isOfCells)
  {
    problem << "is not of cells, and a side is one for each cell (a vtkPointDataToCellData makes "
               "cell data of point data)";
  }
  else if (array->GetNumberOfComponents() != 1)
  {
    problem << "has " << array->GetNumberOfComponents() << " components, and one is needed";
  }
  else if (array->GetNumberOfTuples() != input->GetNumberOfCells())
  {
    problem << "has " << array->GetNumberOfTuples() << " values, and " << input->GetNumberOfCells()
            << " are needed";
  }
  return problem.str();
}

SurfacePreparation::SurfacePreparation(vtkPolyData* input, const PreparationOptions& options)
  : Options(options)
  , InputKey(MakeKey(input, options))
  , Patch(PatchRecord::ReadFrom(input->GetFieldData()))
  , WholeCells(
      vtkIdTypeArray::SafeDownCast(input->GetCellData()->GetAbstractArray(PatchRecord::CellIds)))
  , StartPoints(input->GetPointData()->GetArray(PatchRecord::StartPoints))
{
  this->Input->CopyStructure(input);
  if (!this->WholeCells || this->WholeCells->GetNumberOfValues() != input->GetNumberOfCells())
  {
    this->Patch.reset(); // what has cut or joined it has made a surface of its own of it
  }
  if (vtkUnsignedCharArray* ghosts = input->GetCellGhostArray())
  {
    this->Input->GetCellData()->AddArray(ghosts);
  }
  this->ReadSides();
}

void SurfacePreparation::ReadSides()
{
  const vtkSmartPointer<vtkDataArray> array = std::exchange(this->Options.CellSides, nullptr);
  if (!array)
  {
    return;
  }
  const vtkIdType count = array->GetNumberOfTuples();
  const vtkIdType firstPolygon = this->Input->GetNumberOfVerts() + this->Input->GetNumberOfLines();
  vtkIdType bad = 0;
  vtkIdType firstBad = -1;
  this->CellSides.reserve(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = array->GetComponent(i, 0);
    const bool isSide = value == static_cast<double>(Side::Front) ||
      value == static_cast<double>(Side::Both) || value == static_cast<double>(Side::Automatic);
    if (!isSide && i >= firstPolygon)
    {
      firstBad = bad++ == 0 ? i : firstBad;
    }
    this->CellSides.push_back(
      isSide ? static_cast<Side>(static_cast<int>(value)) : this->Options.TouchedSide);
  }
  if (bad > 0)
  {
    std::ostringstream text;
    text << "The array " << (array->GetName() ? array->GetName() : "without a name")
         << " for the side is neither 0 (front) nor 1 (both) nor 2 (automatic) at " << bad << " of "
         << count - firstPolygon << " cells, the first is cell " << firstBad << " with "
         << array->GetComponent(firstBad, 0) << "; the side of the filter is used there.";
    this->SideErrorText = text.str();
  }
}

SurfacePreparation::~SurfacePreparation() = default;

BuildKey SurfacePreparation::MakeKey(vtkPolyData* input, const PreparationOptions& options)
{
  const auto patch = PatchRecord::ReadFrom(input->GetFieldData());
  const PatchRegion region = patch ? patch->Region : PatchRegion();
  return MakeBuildKey(input, options.CellSides,
    { patch ? static_cast<double>(patch->Whole.Version) : 0.0, region.From[0], region.From[1],
      region.From[2], region.To[0], region.To[1], region.To[2], region.Radius,
      static_cast<double>(options.TouchedSide), static_cast<double>(options.Engine),
      options.Cleaning.MergeTolerance, options.Cleaning.AbsoluteTolerance ? 1.0 : 0.0,
      options.AutomaticCrackWidth ? 1.0 : 0.0, options.CrackWidth });
}

vtkIdTypeArray* SurfacePreparation::OriginalCells() const
{
  return this->Patch ? this->WholeCellIds : this->CellIds;
}

/// Each triangle's number in the whole surface: its cell's, and which of that it is. Says what is
/// wrong; empty where nothing is.
std::string SurfacePreparation::NumberTriangles(CleanedMesh& cleaned) const
{
  constexpr std::int64_t mostInCell = std::int64_t{ 1 } << 20;
  std::unordered_map<vtkIdType, std::int64_t> counts;
  for (const vtkIdType cell : cleaned.OriginalCell)
  {
    const std::int64_t place = counts[cell]++;
    if (place == mostInCell)
    {
      return "Cell " + std::to_string(this->WholeCells->GetValue(cell)) +
        " of the surface has more than 2^20 triangles. Triangulate it before it is cropped.";
    }
    cleaned.Mesh.Ids.push_back(mostInCell * this->WholeCells->GetValue(cell) + place);
  }
  return {};
}

/// Where the clean points of a patch come from; false where it cannot deform from there.
bool SurfacePreparation::FindStarts(const CleanedMesh& cleaned, std::vector<Vec3>& starts) const
{
  const vtkIdType points = this->Input->GetNumberOfPoints();
  const bool hasStarts = points == 0 ||
    (this->StartPoints && this->StartPoints->GetNumberOfComponents() == 3 &&
      this->StartPoints->GetNumberOfTuples() == points);
  if (!this->Patch || this->Patch->Whole.Before == 0 || !hasStarts ||
    cleaned.Report.FlatTriangles > 0 || this->Options.Engine == EngineKind::Exact)
  {
    return false;
  }
  starts.resize(cleaned.OriginalPoint.size());
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    this->StartPoints->GetTuple(cleaned.OriginalPoint[i], starts[i].data());
  }
  for (std::size_t i = 0; i < cleaned.KeptPoint.size(); ++i)
  {
    if (cleaned.KeptPoint[i] >= 0)
    {
      Vec3 p;
      this->StartPoints->GetTuple(static_cast<vtkIdType>(i), p.data());
      const Vec3& q = starts[static_cast<std::size_t>(cleaned.KeptPoint[i])];
      if (!(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= cleaned.MergedWithin))
      {
        return false; // what is one was none
      }
    }
  }
  return true;
}

void SurfacePreparation::CopyPoints()
{
  if (vtkPoints* shared = this->Input->GetPoints())
  {
    vtkNew<vtkPoints> own;
    own->SetDataType(shared->GetDataType());
    own->DeepCopy(shared);
    this->Input->SetPoints(own);
  }
}

void SurfacePreparation::Finish()
{
  this->Input->SetPoints(nullptr);
  this->Earlier.reset(); // or each would keep all before it
}

int SurfacePreparation::Fill(vtkPolyData* input, vtkPolyData* output) const
{
  const int dropped = this->FillPoints(input, output) +
    PassAttributes(
      input->GetCellData(), input->GetNumberOfCells(), this->CellIds, output->GetCellData());
  output->GetPointData()->RemoveArray(PatchRecord::StartPoints);
  if (this->Patch)
  {
    const auto rename = [](vtkDataSetAttributes* data, const char* whole, const char* ids)
    {
      if (vtkAbstractArray* const array = data->GetAbstractArray(whole))
      {
        auto named = vtk::TakeSmartPointer(array->NewInstance());
        named->DeepCopy(array);
        named->SetName(ids);
        data->RemoveArray(whole);
        data->RemoveArray(ids);
        data->AddArray(named);
      }
    };
    rename(output->GetPointData(), PatchRecord::PointIds, "OriginalPointId");
    rename(output->GetCellData(), PatchRecord::CellIds, "OriginalCellId");
    this->Patch->WriteRangesTo(output->GetFieldData());
  }
  return dropped;
}

int SurfacePreparation::FillPoints(vtkPolyData* input, vtkPolyData* output) const
{
  output->SetPoints(this->CleanPoints);
  output->SetPolys(this->CleanTriangles);
  vtkPointData* const data = input->GetPointData();
  DataPoints found;
  if (this->Corners)
  {
    found = FindDataPoints(this->Corners->Triangles, this->Corners->Originals,
      this->PointIds->GetPointer(0), static_cast<std::size_t>(this->PointIds->GetNumberOfValues()),
      data, input->GetNumberOfPoints());
  }
  if (found.Originals.empty())
  {
    return PassAttributes(data, input->GetNumberOfPoints(), this->PointIds, output->GetPointData());
  }
  vtkNew<vtkPoints> points;
  points->SetDataType(this->CleanPoints->GetDataType());
  points->DeepCopy(this->CleanPoints);
  vtkNew<vtkIdTypeArray> ids;
  ids->DeepCopy(this->PointIds);
  for (std::size_t i = 0; i < found.Originals.size(); ++i)
  {
    points->InsertNextPoint(this->CleanPoints->GetPoint(found.MergedWith[i]));
    ids->InsertNextValue(found.Originals[i]);
  }
  output->SetPoints(points);
  output->SetPolys(MakeCells(found.Corners));
  return PassAttributes(data, input->GetNumberOfPoints(), ids, output->GetPointData());
}

void SurfacePreparation::FollowOn(std::shared_ptr<const SurfacePreparation> earlier)
{
  // What was without area may have some now, and triangles in its place.
  if (earlier->Found.FlatTriangles > 0 || earlier->InputKey.Sizes != this->InputKey.Sizes ||
    earlier->InputKey.Properties != this->InputKey.Properties ||
    earlier->CellSides != this->CellSides)
  {
    return;
  }
  BuildKey now = MakeKey(earlier->Input, earlier->Options);
  now.Sizes = earlier->InputKey.Sizes; // its points are gone
  const bool wasOverwritten = !HaveSameCells(now, earlier->InputKey);
  this->CellsOfEarlier = HaveSameCells(this->InputKey, earlier->InputKey) ? Cells::Same
    : wasOverwritten                                                      ? Cells::Other
                                                                          : Cells::Unknown;
  this->Earlier = std::move(earlier);
}

bool SurfacePreparation::HasSameCells() const
{
  if (this->CellsOfEarlier != Cells::Unknown)
  {
    return this->CellsOfEarlier == Cells::Same;
  }
  return HoldTheSame(this->Input->GetPolys(), this->Earlier->Input->GetPolys()) &&
    HoldTheSame(this->Input->GetStrips(), this->Earlier->Input->GetStrips()) &&
    HoldTheSame(this->Input->GetCellGhostArray(), this->Earlier->Input->GetCellGhostArray());
}

bool SurfacePreparation::Follow(std::vector<Vec3>& points)
{
  if (!this->HasSameCells() || !this->MovePoints(points))
  {
    return false;
  }
  this->Found = this->Earlier->Found;
  this->CrackWidthInUse = this->Earlier->CrackWidthInUse;
  this->MergedWithin = this->Earlier->MergedWithin;
  this->PointMap = this->Earlier->PointMap;
  this->CleanPoints = MakePoints(points, this->Input->GetPoints()->GetDataType());
  this->CleanTriangles = this->Earlier->CleanTriangles;
  this->PointIds = this->Earlier->PointIds;
  this->CellIds = this->Earlier->CellIds;
  this->Corners = this->Earlier->Corners;
  return true;
}

bool SurfacePreparation::MovePoints(std::vector<Vec3>& points) const
{
  const std::vector<std::int32_t>& kept = *this->Earlier->PointMap;
  const vtkIdType* original = this->Earlier->PointIds->GetPointer(0);
  const PointReader reader(this->Input->GetPoints());
  points.resize(static_cast<std::size_t>(this->Earlier->PointIds->GetNumberOfValues()));
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    if (kept[i] < 0)
    {
      continue;
    }
    const auto point = static_cast<vtkIdType>(i);
    const Vec3 p = reader.At(point);
    if (!IsInRange(p))
    {
      return false;
    }
    Vec3& q = points[static_cast<std::size_t>(kept[i])];
    if (original[kept[i]] == point)
    {
      q = p;
    }
    else if (!(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= this->Earlier->MergedWithin))
    {
      return false; // what was one has parted
    }
  }
  return true;
}

/// Reports where single precision has made triangles fall together.
void SurfacePreparation::AddCollapseWarning(const CleanedMesh& cleaned)
{
  if (this->Input->GetPoints()->GetDataType() != VTK_FLOAT)
  {
    return;
  }
  const std::int64_t lost = cleaned.Report.DegenerateTriangles;
  const auto kept = static_cast<std::int64_t>(cleaned.Mesh.Triangles.size());
  double bounds[6];
  this->Input->GetPoints()->GetBounds(bounds);
  const double size =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  // A surface around the origin has triangles without area for reasons of its own.
  if (lost < LeastShareOfCollapsed * static_cast<double>(lost + kept) ||
    cleaned.LargestCoordinate < FarFromOrigin * size)
  {
    return;
  }
  std::ostringstream text;
  text
    << (this->WarningText.empty() ? "" : " ") << lost << " of " << lost + kept
    << " triangles have no area: the points are of single precision (float32), and at coordinates "
       "up to "
    << cleaned.LargestCoordinate << " such numbers are " << 0x1p-23 * cleaned.LargestCoordinate
    << " apart. Read the points as float64, or subtract an offset where they still are (the "
       "readers of PLY and of ASCII STL give float32 whatever the file has).";
  this->WarningText += text.str();
}

CleaningResult SurfacePreparation::Run(const ProgressCall& progress)
{
  CleanedMesh cleaned;
  CleaningOptions cleaning = this->Options.Cleaning;
  cleaning.CellSides = this->CellSides.empty() ? nullptr : &this->CellSides;
  cleaning.Frame = this->Patch ? &this->Patch->Frame : nullptr;
  const CleaningResult result = CleanSurface(
    this->Input, cleaning, PartOf(progress, 0.0, CleanShare), cleaned, this->ErrorText);
  if (result != CleaningResult::Done)
  {
    return result;
  }
  if (cleaned.Report.FoldedPolygons > 0)
  {
    this->WarningText = std::to_string(cleaned.Report.FoldedPolygons) +
      " polygons cross themselves, the first is cell " +
      std::to_string(cleaned.Report.FirstFoldedCell) +
      ". They were split into fans, whose contact may not look right.";
  }
  const int dataType = this->Input->GetPoints()->GetDataType();
  if (!this->Patch)
  {
    this->AddCollapseWarning(cleaned);
  }
  else if (this->ErrorText = this->NumberTriangles(cleaned); !this->ErrorText.empty())
  {
    return CleaningResult::Failed;
  }
  this->Found = cleaned.Report;
  this->MergedWithin = cleaned.MergedWithin;
  this->PointMap = std::make_shared<const std::vector<std::int32_t>>(std::move(cleaned.KeptPoint));
  this->CleanPoints = MakePoints(cleaned.Mesh.Points, dataType);
  this->CleanTriangles = MakeCells(cleaned.Mesh.Triangles);
  if (!cleaned.OriginalCorners.empty())
  {
    this->Corners = std::make_shared<const CleanedCorners>(
      CleanedCorners{ cleaned.Mesh.Triangles, std::move(cleaned.OriginalCorners) });
  }
  this->PointIds = MakeIdArray("OriginalPointId", cleaned.OriginalPoint);
  this->CellIds = MakeIdArray("OriginalCellId", cleaned.OriginalCell);
  if (this->Patch)
  {
    std::vector<vtkIdType> cells;
    cells.reserve(cleaned.OriginalCell.size());
    for (const vtkIdType cell : cleaned.OriginalCell)
    {
      cells.push_back(this->WholeCells->GetValue(cell));
    }
    this->WholeCellIds = MakeIdArray("OriginalCellId", cells);
  }
  if (!ReportProgress(progress, CleanShare))
  {
    return CleaningResult::Aborted;
  }

  SurfaceOptions options;
  options.TouchedSide = this->Options.TouchedSide;
  options.Engine = this->Options.Engine;
  options.CrackWidth = this->Options.CrackWidth;
  if (this->Options.AutomaticCrackWidth)
  {
    options.CrackWidth = dataType == VTK_FLOAT ? 0x1p-21 * cleaned.LargestCoordinate : 0.0;
  }
  if (this->Patch)
  {
    auto whole = std::make_shared<WholeSurface>(this->Patch->Whole);
    whole->CrackWidth = options.CrackWidth;
    options.Whole = std::move(whole);
    options.Region = this->Patch->Region;
    options.Enclosure = this->Patch->Enclosure;
    if (this->DeformDuration && this->FindStarts(cleaned, cleaned.Mesh.Starts))
    {
      options.DeformDuration = this->DeformDuration;
    }
  }
  this->CrackWidthInUse = options.CrackWidth;
  std::string error;
  this->Built = TriangleSurface::Build(
    std::move(cleaned.Mesh), options, error, PartOf(progress, CleanShare, 1.0));
  if (!this->Built && error.empty())
  {
    return CleaningResult::Aborted;
  }
  if (!this->Built)
  {
    this->ErrorText = "No surface could be built from the " +
      std::to_string(cleaned.OriginalCell.size()) + " clean triangles: " + error +
      ". Check the input and this filter's properties.";
    return CleaningResult::Failed;
  }
  return CleaningResult::Done;
}
}
