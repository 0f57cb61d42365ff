#include "vtkHapticPatchAlgorithm.h"

#include "haptics/Filters/CleanPart.h"
#include "haptics/Filters/PatchCropper.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/SurfaceCensus.h"
#include "haptics/Math/VectorMath.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

namespace
{
/// Of the surface's diagonal.
constexpr double DefaultShareOfDiagonal = 0.01;
/// Of a region's radius: an anchor is so far from its line at most.
constexpr double ShareForAnchors = 0.9;
/// Places that are tried for an anchor, until the way to one meets no edge.
constexpr int NumberOfAnchors = 4;
/// Of a region's radius: so far from its line's start are those that nothing may go over.
constexpr double ShareForQuietAnchors = 0.6;
/// That may come, one after another, while a patch is asked for.
constexpr int NumberOfVersions = 3;
/// Of the surface's diagonal: the radius of the region along a way that has no width.
constexpr double ThinShare = 1e-9;

std::uint64_t NewVersion()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

/// Of these places those over which no cell of a patch goes on its way from the version before.
std::vector<haptics::Vec3> QuietPlaces(
  std::vector<haptics::Vec3> places, vtkPolyData* patch, double margin)
{
  vtkDataArray* const starts = patch->GetPointData()->GetArray(haptics::PatchRecord::StartPoints);
  for (vtkCellArray* const cells : { patch->GetPolys(), patch->GetStrips() })
  {
    auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
    {
      vtkIdType size = 0;
      const vtkIdType* corners = nullptr;
      iterator->GetCurrentCell(size, corners);
      haptics::PartBox swept;
      for (vtkIdType k = 0; k < size; ++k)
      {
        haptics::Vec3 p;
        patch->GetPoint(corners[k], p.data());
        swept.Add(p);
        if (starts)
        {
          starts->GetTuple(corners[k], p.data());
          swept.Add(p);
        }
      }
      places.erase(std::remove_if(places.begin(), places.end(),
                     [&](const haptics::Vec3& place) { return swept.Contains(place, margin); }),
        places.end());
    }
  }
  return places;
}
}

class vtkHapticPatchAlgorithm::WholeInternals
{
public:
  haptics::PatchRegion Region;
  bool IsUpToSurface = false;
  std::optional<haptics::PatchRecord> Record;
  haptics::PartBox Box;
  /// Where the points are: Record is of those of the version before, too.
  double EndRadius = 0.0;
  double EndLongestEdge = 0.0;
  vtkSmartPointer<vtkPolyData> Nothing;

  struct Output
  {
    vtkSmartPointer<vtkPolyData> Patch; ///< null: there was none
    haptics::PatchRegion Region;
    haptics::PatchEnclosure Enclosure;

    /// Whether a place is well within, so that the patch has all that is crossed on the way from
    /// its anchor.
    bool Has(const haptics::Vec3& place) const
    {
      return this->Patch && this->Enclosure.IsCounted &&
        this->Region.DistanceTo(place) < ShareForAnchors * this->Region.Radius;
    }
    /// How often the surface encloses such a place; none where the way that shows it meets an edge.
    std::optional<int> CountAt(
      const haptics::Vec3& place, const haptics::CleaningFrame& frame) const
    {
      const haptics::CleanPart cells(this->Patch, frame);
      const std::optional<int> crossings = cells.CountCrossings(place, this->Enclosure.Anchor);
      return crossings ? std::optional<int>(this->Enclosure.Count + *crossings) : std::nullopt;
    }
  };
  Output Last;    ///< the last output, of this surface
  Output Earlier; ///< the last one of the version that this is another shape of
  /// The surface as it was when there was last an output.
  struct TouchedSurface
  {
    haptics::PatchRecord Record;
    double EndRadius;
    double EndLongestEdge;
    Output Last;
  };
  std::optional<TouchedSurface> Touched;
};

vtkHapticPatchAlgorithm::vtkHapticPatchAlgorithm()
  : Whole(new WholeInternals)
{
  this->SetNumberOfInputPorts(0);
}

vtkHapticPatchAlgorithm::~vtkHapticPatchAlgorithm() = default;

void vtkHapticPatchAlgorithm::SetPatchRadius(double radius)
{
  if (!(radius >= 0.0) || !std::isfinite(radius))
  {
    vtkErrorMacro("The radius of a patch must be finite and not below 0, but is "
      << radius << "; it stays " << this->PatchRadius << ".");
    return;
  }
  if (this->PatchRadius != radius)
  {
    this->PatchRadius = radius;
    this->Modified();
  }
}

double vtkHapticPatchAlgorithm::GetPatchRadiusInUse()
{
  const double diagonal = this->HasWhole() ? this->Whole->Record->Whole.Diagonal : 0.0;
  return this->PatchRadius > 0.0 ? this->PatchRadius : DefaultShareOfDiagonal * diagonal;
}

void vtkHapticPatchAlgorithm::SetRegion(const double from[3], const double to[3], double radius)
{
  this->SetRegion({ { from[0], from[1], from[2] }, { to[0], to[1], to[2] }, radius }, false);
}

void vtkHapticPatchAlgorithm::SetRegionUpToSurface(
  const double from[3], const double to[3], double radius)
{
  this->SetRegion({ { from[0], from[1], from[2] }, { to[0], to[1], to[2] }, radius }, true);
}

void vtkHapticPatchAlgorithm::SetRegion(const haptics::PatchRegion& region, bool isUpToSurface)
{
  const auto isFinite = [](const haptics::Vec3& p)
  { return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); }); };
  if (!isFinite(region.From) || !isFinite(region.To) || !(region.Radius > 0.0) ||
    !std::isfinite(region.Radius))
  {
    vtkErrorMacro("A region needs finite points and a finite radius above 0, but the radius is "
      << region.Radius << "; the last region stays.");
    return;
  }
  const haptics::PatchRegion& last = this->Whole->Region;
  if (region.From != last.From || region.To != last.To || region.Radius != last.Radius ||
    isUpToSurface != this->Whole->IsUpToSurface)
  {
    this->Whole->Region = region;
    this->Whole->IsUpToSurface = isUpToSurface;
    this->Modified();
  }
}

vtkIdType vtkHapticPatchAlgorithm::GetNumberOfTriangles()
{
  return this->HasWhole() ? this->Whole->Record->Whole.Triangles : 0;
}

void vtkHapticPatchAlgorithm::GetSurfaceBounds(double bounds[6])
{
  const haptics::PartBox& all = this->Whole->Box;
  vtkMath::UninitializeBounds(bounds);
  for (int axis = 0; axis < 3 && !all.IsEmpty(); ++axis)
  {
    bounds[2 * axis] = all.Low[axis];
    bounds[2 * axis + 1] = all.High[axis];
  }
}

bool vtkHapticPatchAlgorithm::GetClosed()
{
  return this->HasWhole() && this->Whole->Record->Whole.Report.Closed;
}

vtkTypeUInt64 vtkHapticPatchAlgorithm::GetVersion()
{
  return this->HasWhole() ? this->Whole->Record->Whole.Version : 0;
}

void vtkHapticPatchAlgorithm::SetWhole(
  const haptics::PatchRecord& record, const haptics::PartBox& box, vtkPolyData* sample)
{
  this->ForgetWhole();
  this->Whole->Box = box;
  this->Whole->Record = record;
  this->Whole->EndRadius = record.Whole.Radius;
  this->Whole->EndLongestEdge = record.Whole.LongestEdge;
  this->DeformFromTouched();
  this->Whole->Record->Whole.Version = NewVersion();
  double bounds[6];
  sample->GetBounds(bounds);
  const double length = sample->GetLength() + std::abs(bounds[1]) + 1.0;
  const haptics::Vec3 place{ bounds[1] + 2.0 * length, bounds[2], bounds[4] };
  this->Whole->Nothing = haptics::CropPart(sample, { place, place, length }, {});
}

/// Has the surface keep the frame and the sides of that of which it is another shape.
void vtkHapticPatchAlgorithm::DeformFromTouched()
{
  WholeInternals& in = *this->Whole;
  haptics::WholeSurface& whole = in.Record->Whole;
  if (!in.Touched || in.Touched->Record.Whole.Version != whole.Before)
  {
    whole.Before = 0;
    whole.LongestWay = 0.0;
    return;
  }
  const haptics::WholeSurface& before = in.Touched->Record.Whole;
  whole.Report = before.Report;
  whole.Origin = before.Origin;
  whole.Negligible =
    before.Negligible > 0.0 ? before.Negligible : haptics::NegligibleShare * before.Radius;
  in.EndRadius = haptics::RadiusAbout(
    haptics::ToVector(whole.Origin), haptics::ToVector(in.Box.Low), haptics::ToVector(in.Box.High));
  whole.Radius = std::max(in.EndRadius, in.Touched->EndRadius);
  whole.LongestEdge = std::max(in.EndLongestEdge, in.Touched->EndLongestEdge);
  in.Record->Frame = in.Touched->Record.Frame;
  in.Earlier = in.Touched->Last;
}

void vtkHapticPatchAlgorithm::ForgetWhole()
{
  this->Whole->Record.reset();
  this->Whole->Box = haptics::PartBox();
  this->Whole->Nothing = nullptr;
  this->Whole->Last = {};
  this->Whole->Earlier = {};
}

bool vtkHapticPatchAlgorithm::HasWhole() const
{
  return this->Whole->Record.has_value();
}

bool vtkHapticPatchAlgorithm::MakePatch(const haptics::PatchRegion& region, vtkPolyData* output)
{
  if (!this->Survey() || !this->Gather(region, Use::Look, output))
  {
    return false;
  }
  this->WriteRecord(region, {}, output);
  return true;
}

bool vtkHapticPatchAlgorithm::Fetch(const haptics::PatchRegion&)
{
  return true;
}

/// The cells of a region. After Survey().
bool vtkHapticPatchAlgorithm::Gather(
  const haptics::PatchRegion& region, Use use, vtkPolyData* output)
{
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  if (!this->Crop(region, use, parts))
  {
    return false;
  }
  vtkNew<vtkAppendPolyData> append;
  vtkSmartPointer<vtkPolyData> patch = this->Whole->Nothing;
  for (const vtkSmartPointer<vtkPolyData>& part : parts)
  {
    if (part->GetNumberOfCells() > 0)
    {
      patch = part;
      append->AddInputData(part);
    }
  }
  if (append->GetNumberOfInputConnections(0) > 1)
  {
    append->Update();
    patch = append->GetOutput();
  }
  output->ShallowCopy(patch);
  return true;
}

void vtkHapticPatchAlgorithm::WriteRecord(const haptics::PatchRegion& region,
  const haptics::PatchEnclosure& enclosure, vtkPolyData* output) const
{
  haptics::PatchRecord record = *this->Whole->Record;
  record.Region = region;
  record.Enclosure = enclosure;
  if (enclosure.HollowRadius > 0.0)
  {
    record.Whole.Before = 0; // there is no hollow on the way
  }
  record.WriteTo(output->GetFieldData());
}

/// The patch of the region, and of a closed surface what it encloses there: all of one version,
/// which may go on while it is asked for.
bool vtkHapticPatchAlgorithm::MakeEnclosedPatch(vtkPolyData* output)
{
  for (int versions = 0; versions < NumberOfVersions; ++versions)
  {
    const vtkTypeUInt64 version = this->Survey() ? this->GetVersion() : 0;
    const bool isMade = version != 0 && this->MakePatchOfVersion(output);
    if (this->GetVersion() == version)
    {
      return isMade;
    }
  }
  return false;
}

/// False also where another version has come meanwhile: what has been written is of no use then.
bool vtkHapticPatchAlgorithm::MakePatchOfVersion(vtkPolyData* output)
{
  WholeInternals& in = *this->Whole;
  const vtkTypeUInt64 version = this->GetVersion();
  haptics::PatchRegion region = in.Region;
  haptics::PatchEnclosure enclosure;
  const haptics::SurfaceReport report = in.Record->Whole.Report;
  const bool encloses = report.Closed && report.Oriented;
  if ((encloses && in.IsUpToSurface && !this->ReachSurface(region, enclosure)) ||
    !this->Gather(region, Use::Touch, output) ||
    (encloses && !this->CountEnclosing(region, output, enclosure)) || this->GetVersion() != version)
  {
    return false;
  }
  this->WriteRecord(region, enclosure, output);
  in.Last = { output, region, enclosure };
  in.Touched = { *in.Record, in.EndRadius, in.EndLongestEdge, in.Last };
  return true;
}

/// Widens a region, so that it reaches the surface's place that is nearest to its line's start.
bool vtkHapticPatchAlgorithm::ReachSurface(
  haptics::PatchRegion& region, haptics::PatchEnclosure& enclosure)
{
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  if (!this->CropNearest(region.From, parts))
  {
    return false;
  }
  const haptics::Vec3 start = region.From;
  enclosure.Middle = start;
  for (const vtkSmartPointer<vtkPolyData>& part : parts)
  {
    const haptics::CleanPart cells(part, this->Whole->Record->Frame);
    const std::optional<haptics::Vec3> place = cells.NearestTo(start);
    const double distance =
      place ? glm::length(haptics::ToVector(*place) - haptics::ToVector(start)) : HUGE_VAL;
    if (place && (enclosure.HollowRadius == 0.0 || distance < enclosure.HollowRadius))
    {
      enclosure.HollowRadius = distance;
      region.From = *place;
    }
  }
  region.Radius += region.DistanceTo(start);
  return true;
}

/// Finds a place of the region of which it is known how often the surface encloses it: that of the
/// patch before, or one on a way within that, or in the end by a way out of the surface.
bool vtkHapticPatchAlgorithm::CountEnclosing(
  const haptics::PatchRegion& region, vtkPolyData* patch, haptics::PatchEnclosure& enclosure)
{
  const WholeInternals::Output& lastOutput = this->Whole->Last;
  const haptics::PatchEnclosure& last = lastOutput.Enclosure;
  if (lastOutput.Patch && last.IsCounted &&
    region.DistanceTo(last.Anchor) < ShareForAnchors * region.Radius)
  {
    enclosure.IsCounted = true;
    enclosure.Anchor = last.Anchor;
    enclosure.Count = last.Count;
    enclosure.IsSwept = last.IsSwept;
    return true;
  }
  const bool deforms = this->Whole->Record->Whole.Before != 0 && enclosure.HollowRadius == 0.0;
  if (deforms && this->CountAtQuietPlace(region, patch, enclosure))
  {
    return true;
  }
  for (int i = 0; i < NumberOfAnchors && !enclosure.IsCounted; ++i)
  {
    // In no direction that a mesh is likely to have.
    haptics::Vec3 place = enclosure.HollowRadius > 0.0 ? enclosure.Middle : region.From;
    const double off = 0.3 * region.Radius * i / NumberOfAnchors;
    place = { place[0] + 0.57 * off, place[1] - 0.43 * off, place[2] + 0.69 * off };
    bool isDone = true;
    if (const std::optional<int> count = this->CountAt(place, 0.017 * (i + 1), isDone))
    {
      enclosure.IsCounted = true;
      enclosure.Anchor = place;
      enclosure.Count = *count;
      enclosure.IsSwept = deforms;
    }
    if (!isDone)
    {
      return false;
    }
  }
  return true;
}

/// Of a surface that deforms: finds a place that it does not go over, so that it encloses it as
/// often as it did before. False where the patch of then shows none.
bool vtkHapticPatchAlgorithm::CountAtQuietPlace(
  const haptics::PatchRegion& region, vtkPolyData* patch, haptics::PatchEnclosure& enclosure) const
{
  const WholeInternals::Output& earlier = this->Whole->Earlier;
  std::vector<haptics::Vec3> places;
  const auto add = [&](const haptics::Vec3& place)
  {
    if (earlier.Has(place) && region.DistanceTo(place) < ShareForAnchors * region.Radius)
    {
      places.push_back(place);
    }
  };
  add(earlier.Enclosure.Anchor);
  const double way = ShareForQuietAnchors * region.Radius;
  for (int i = 0; i < 27; ++i)
  {
    // To all sides, along no direction that a mesh is likely to have.
    const int row = i / 3;
    const int layer = i / 9;
    const haptics::Vector side(i % 3 - 0.97, row % 3 - 1.01, layer - 0.98);
    add(haptics::ToVec3(haptics::ToVector(region.From) + way * glm::normalize(side)));
  }
  for (const haptics::Vec3& place : QuietPlaces(places, patch, ThinShare * region.Radius))
  {
    if (const std::optional<int> count = earlier.CountAt(place, this->Whole->Record->Frame))
    {
      enclosure.IsCounted = true;
      enclosure.Anchor = place;
      enclosure.Count = *count;
      return true;
    }
  }
  return false;
}

/// How often the surface encloses a place; none where the way that shows it meets an edge. `tilt`:
/// of a way out against an axis. `isDone`: false where what is there cannot be had.
std::optional<int> vtkHapticPatchAlgorithm::CountAt(
  const haptics::Vec3& place, double tilt, bool& isDone)
{
  WholeInternals& in = *this->Whole;
  if (in.Last.Has(place))
  {
    return in.Last.CountAt(place, in.Record->Frame);
  }
  if (!in.Box.Contains(place, 0.0))
  {
    return 0;
  }
  // Out by the nearest of the box's sides.
  const double diagonal = in.Record->Whole.Diagonal;
  int side = 0;
  double least = HUGE_VAL;
  bool isUp = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool up : { false, true })
    {
      const double way = up ? in.Box.High[axis] - place[axis] : place[axis] - in.Box.Low[axis];
      if (way < least)
      {
        least = way;
        side = axis;
        isUp = up;
      }
    }
  }
  const double length = least + 0.01 * diagonal;
  haptics::Vec3 outside = place;
  outside[side] += isUp ? length : -length;
  outside[(side + 1) % 3] += tilt * length;
  outside[(side + 2) % 3] -= 0.73 * tilt * length;
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  isDone = this->Crop({ place, outside, ThinShare * diagonal }, Use::Look, parts);
  int count = 0;
  bool isClean = isDone;
  for (const vtkSmartPointer<vtkPolyData>& part : parts)
  {
    const haptics::CleanPart cells(part, in.Record->Frame);
    const std::optional<int> crossings = cells.CountCrossings(place, outside);
    isClean = isClean && crossings;
    count += crossings.value_or(0);
  }
  return isClean ? std::optional<int>(count) : std::nullopt;
}

int vtkHapticPatchAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (this->Whole->Region.Radius == 0.0)
  {
    if (this->Survey())
    {
      vtkPolyData::GetData(outputVector)->ShallowCopy(this->Whole->Nothing);
    }
    return 1;
  }
  vtkNew<vtkPolyData> patch;
  this->MakeEnclosedPatch(patch);
  // Where that failed the last one stays, of whatever version.
  if (this->Whole->Touched)
  {
    vtkPolyData::GetData(outputVector)->ShallowCopy(this->Whole->Touched->Last.Patch);
  }
  return 1;
}

void vtkHapticPatchAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PatchRadius: " << this->PatchRadius << "\n";
  os << indent << "Triangles: " << this->GetNumberOfTriangles() << "\n";
}
