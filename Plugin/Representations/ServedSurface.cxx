#include "ServedSurface.h"

#include "SeamWidth.h"
#include "haptics/Filters/PointReader.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Filters/SurfaceCleaner.h"
#include "vtkCellArray.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkMultiProcessController.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace haptics
{
namespace
{
constexpr int LengthTag = 26341;
constexpr int BytesTag = 26342;

/// What the processes tell each other of their parts, before they count.
struct PartNumbers
{
  PartBox Box;
  double Cells = 0.0;
  double Points = 0.0;
  double HasFloats = 0.0;
  double IsReshaped = 0.0; ///< 1: another shape of what the client touches
  double LongestWay = 0.0; ///< of a point from there
};
constexpr int Doubles = sizeof(PartNumbers) / sizeof(double);

void Send(const std::string& bytes, int to, vtkMultiProcessController* processes)
{
  const auto length = static_cast<vtkIdType>(bytes.size());
  processes->Send(&length, 1, to, LengthTag);
  processes->Send(bytes.data(), length, to, BytesTag);
}

std::string Receive(int from, vtkMultiProcessController* processes)
{
  vtkIdType length = 0;
  processes->Receive(&length, 1, from, LengthTag);
  std::string bytes(static_cast<std::size_t>(length), '\0');
  processes->Receive(bytes.data(), length, from, BytesTag);
  return bytes;
}

/// Merges what all processes have counted, pairwise, into that of the first. `error`: why one could
/// not count.
void Reduce(
  SurfaceCensus& census, std::string& error, double tolerance, vtkMultiProcessController* processes)
{
  const int own = processes->GetLocalProcessId();
  const int count = processes->GetNumberOfProcesses();
  for (int step = 1; step < count; step *= 2)
  {
    if (own % (2 * step) != 0)
    {
      Send(error, own - step, processes);
      Send(census.Pack(), own - step, processes);
      return;
    }
    if (own + step < count)
    {
      const std::string other = Receive(own + step, processes);
      SurfaceCensus counted(tolerance);
      const bool isGood = counted.Unpack(Receive(own + step, processes));
      error = !error.empty() ? error
        : !other.empty()     ? other
        : isGood             ? ""
                             : "The server's processes are of different builds.";
      census.Merge(counted);
    }
  }
}
}

namespace
{
bool HoldTheSame(vtkDataArray* a, vtkDataArray* b)
{
  return a == b ||
    (a->GetDataType() == b->GetDataType() && a->GetNumberOfValues() == b->GetNumberOfValues() &&
      std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
        static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())) == 0);
}

/// Whether two parts have the same triangles with the same numbers.
bool HaveSameCells(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetNumberOfPoints() == b->GetNumberOfPoints() &&
    a->GetNumberOfCells() == b->GetNumberOfCells() &&
    HoldTheSame(a->GetPolys()->GetOffsetsArray(), b->GetPolys()->GetOffsetsArray()) &&
    HoldTheSame(a->GetPolys()->GetConnectivityArray(), b->GetPolys()->GetConnectivityArray());
}

/// A part without its arrays.
vtkSmartPointer<vtkPolyData> ShapeOf(vtkPolyData* part)
{
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(part->GetPoints());
  shape->SetPolys(part->GetPolys());
  return shape;
}

/// The longest way of a point from one part to another that has as many.
double LongestWay(vtkPolyData* from, vtkPolyData* to)
{
  const PointReader starts(from->GetPoints());
  const PointReader ends(to->GetPoints());
  double longest = 0.0;
  for (vtkIdType i = 0; i < to->GetNumberOfPoints(); ++i)
  {
    const Vec3 p = starts.At(i);
    const Vec3 q = ends.At(i);
    longest = std::max(longest, std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]));
  }
  return longest;
}
}

vtkIdType ServedSurface::Count(vtkIdType own, vtkMultiProcessController* processes)
{
  vtkIdType all = own;
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    processes->AllReduce(&own, &all, 1, vtkCommunicator::SUM_OP);
  }
  return all;
}

ServedSurface::ServedSurface(vtkPolyData* part, vtkTypeUInt64 version, const ServedShape& before,
  vtkMultiProcessController* processes)
  : Part(part)
  , Version(version)
{
  std::string error;
  PartNumbers own;
  const std::string where =
    "Process " + std::to_string(processes->GetLocalProcessId()) + " of the server: ";
  if (!MeasureUsedPoints(part, own.Box.Low, own.Box.High, error))
  {
    error = where + error;
    own.Box = PartBox();
  }
  own.Cells = static_cast<double>(part->GetNumberOfCells());
  own.Points = static_cast<double>(part->GetNumberOfPoints());
  own.HasFloats = part->GetPoints() && part->GetPoints()->GetDataType() == VTK_FLOAT ? 1.0 : 0.0;
  own.IsReshaped = before.Part && HaveSameCells(before.Part, part) ? 1.0 : 0.0;
  own.LongestWay = own.IsReshaped > 0.0 ? LongestWay(before.Part, part) : 0.0;
  const int count = processes->GetNumberOfProcesses();
  std::vector<PartNumbers> parts(static_cast<std::size_t>(count), own);
  if (count > 1)
  {
    processes->AllGather(
      reinterpret_cast<const double*>(&own), reinterpret_cast<double*>(parts.data()), Doubles);
  }
  bool areFloats = false;
  bool isReshaped = true;
  double longestWay = 0.0;
  std::vector<PartBox> others;
  for (int i = 0; i < count; ++i)
  {
    const PartNumbers& numbers = parts[static_cast<std::size_t>(i)];
    this->All.Merge(numbers.Box);
    areFloats = areFloats || numbers.HasFloats > 0.0;
    isReshaped = isReshaped && numbers.IsReshaped > 0.0;
    longestWay = std::max(longestWay, numbers.LongestWay);
    const int place = processes->GetLocalProcessId();
    if (i < place)
    {
      this->Offset.Cells += static_cast<vtkIdType>(numbers.Cells);
      this->Offset.Points += static_cast<vtkIdType>(numbers.Points);
    }
    if (i != place && !numbers.Box.IsEmpty())
    {
      others.push_back(numbers.Box);
    }
  }
  isReshaped = isReshaped && std::isfinite(longestWay);
  if (isReshaped)
  {
    this->Before = { before.Version, ShapeOf(before.Part) };
    this->Before.Part->SetPolys(part->GetPolys()); // the same: those before are let go
  }
  this->Runs = std::make_unique<PolygonRuns>(part, this->StartPoints());
  const CleaningFrame frame = FrameOf(this->All);
  const double tolerance = count > 1 ? SeamWidth(frame.LargestCoordinate, areFloats) : 0.0;
  SurfaceCensus census(tolerance);
  if (error.empty() && !own.Box.IsEmpty())
  {
    CleaningOptions options;
    options.Frame = &frame;
    options.MergeTolerance = tolerance;
    options.AbsoluteTolerance = true;
    CleanedMesh cleaned;
    if (CleanSurface(part, options, {}, cleaned, error) == CleaningResult::Done)
    {
      census.Add(cleaned, frame, others);
      census.AddRanges(part, cleaned);
    }
    else
    {
      error = where + error;
    }
  }
  Reduce(census, error, tolerance, processes);
  if (processes->GetLocalProcessId() == 0)
  {
    auto record = std::make_unique<PatchRecord>(census.Finish(this->All));
    record->Whole.Before = this->Before.Version;
    record->Whole.LongestWay = isReshaped ? longestWay : 0.0;
    if (error.empty() && record->Whole.Triangles == 0)
    {
      error = "None of the triangles has an area to touch.";
    }
    this->ErrorText = error;
    this->Record = error.empty() ? std::move(record) : nullptr;
  }
}

vtkSmartPointer<vtkPolyData> ServedSurface::Crop(const PatchRegion& region) const
{
  return CropPart(this->Part, region, this->Offset, this->Runs.get(), this->StartPoints());
}

vtkPoints* ServedSurface::StartPoints() const
{
  return this->Before.Part ? this->Before.Part->GetPoints() : nullptr;
}

ServedShape ServedSurface::Touched() const
{
  return this->IsTouched ? ServedShape{ this->Version, ShapeOf(this->Part) } : this->Before;
}

vtkSmartPointer<vtkPolyData> ServedSurface::Nearest(const Vec3& place) const
{
  double distance = HUGE_VAL;
  return CropNearest(this->Part, place, distance, this->Runs.get());
}

vtkSmartPointer<vtkPolyData> ServedSurface::Sample() const
{
  PatchRegion region;
  if (this->Part->GetNumberOfPolys() > 0)
  {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    this->Part->GetPolys()->GetCellAtId(0, size, corners);
    this->Part->GetPoint(corners[0], region.From.data());
    region.To = region.From;
  }
  return this->Crop(region);
}
}
