#include "haptics/Filters/PatchCropper.h"

#include "haptics/Filters/GhostCells.h"
#include "haptics/Filters/PassAttributes.h"
#include "haptics/Filters/PatchRecord.h"
#include "haptics/Filters/PointReader.h"
#include "haptics/Math/NearestOnTriangle.h"
#include "haptics/Math/ParallelFor.h"
#include "haptics/Math/VectorMath.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace haptics
{
namespace
{
class Cropper
{
public:
  Cropper(vtkPolyData* part, const PatchRegion& region, const PolygonRuns* runs, vtkPoints* starts)
    : Part(part)
    , Starts(starts)
    , Region(region)
    , Runs(runs)
    , Ghosts(part->GetCellGhostArray())
  {
  }

  vtkSmartPointer<vtkPolyData> Run(const PartOffset& offset)
  {
    auto patch = vtkSmartPointer<vtkPolyData>::New();
    vtkIdType first = this->Part->GetNumberOfVerts() + this->Part->GetNumberOfLines();
    patch->SetPolys(this->CropPolygons(first));
    first += this->Part->GetNumberOfPolys();
    auto strips = vtkSmartPointer<vtkCellArray>::New();
    this->Crop(this->Part->GetStrips(), first, 0, this->Part->GetNumberOfStrips(), strips);
    patch->SetStrips(strips);
    vtkNew<vtkPoints> points;
    points->SetDataType(
      this->Part->GetPoints() ? this->Part->GetPoints()->GetDataType() : VTK_FLOAT);
    points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      points->SetPoint(static_cast<vtkIdType>(i), this->Part->GetPoint(this->Points[i]));
    }
    patch->SetPoints(points);
    Pass(this->Part->GetPointData(), this->Part->GetNumberOfPoints(), this->Points, offset.Points,
      PatchRecord::PointIds, patch->GetPointData());
    Pass(this->Part->GetCellData(), this->Part->GetNumberOfCells(), this->Cells, offset.Cells,
      PatchRecord::CellIds, patch->GetCellData());
    if (this->Starts)
    {
      patch->GetPointData()->AddArray(this->StartsOfPoints());
    }
    return patch;
  }

private:
  static void Pass(vtkDataSetAttributes* from, vtkIdType elements,
    const std::vector<vtkIdType>& kept, vtkIdType offset, const char* name,
    vtkDataSetAttributes* to)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName(name);
    ids->SetNumberOfValues(static_cast<vtkIdType>(kept.size()));
    std::copy(kept.begin(), kept.end(), ids->GetPointer(0));
    PassAttributes(from, elements, ids, to);
    std::transform(
      kept.begin(), kept.end(), ids->GetPointer(0), [offset](vtkIdType id) { return id + offset; });
  }

  vtkSmartPointer<vtkDataArray> StartsOfPoints() const
  {
    vtkDataArray* const all = this->Starts->GetData();
    auto starts = vtk::TakeSmartPointer(all->NewInstance());
    starts->SetName(PatchRecord::StartPoints);
    starts->SetNumberOfComponents(3);
    starts->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      starts->SetTuple(static_cast<vtkIdType>(i), this->Points[i], all);
    }
    return starts;
  }

  vtkSmartPointer<vtkCellArray> CropPolygons(vtkIdType first)
  {
    auto kept = vtkSmartPointer<vtkCellArray>::New();
    vtkCellArray* const polygons = this->Part->GetPolys();
    const vtkIdType count = polygons->GetNumberOfCells();
    if (!this->Runs)
    {
      this->Crop(polygons, first, 0, count, kept);
      return kept;
    }
    for (const vtkIdType start : this->Runs->Near(this->Region))
    {
      this->Crop(polygons, first, start, std::min(count, start + PolygonRuns::Length), kept);
    }
    return kept;
  }

  /// Adds to `kept` those of `cells` from `start` to `end` that are near; `first`: the part's cell
  /// that is the first of them.
  void Crop(
    vtkCellArray* cells, vtkIdType first, vtkIdType start, vtkIdType end, vtkCellArray* kept)
  {
    const vtkIdType known = this->Part->GetNumberOfPoints();
    auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    for (vtkIdType place = start; place < end; ++place)
    {
      const vtkIdType cell = first + place;
      iterator->GoToCell(place);
      iterator->GetCurrentCell(size, corners);
      const bool isGood = !IsGhostCell(this->Ghosts, cell) && size > 0 &&
        std::all_of(corners, corners + size, [known](vtkIdType p) { return p >= 0 && p < known; });
      if (isGood && this->IsNear(size, corners))
      {
        kept->InsertNextCell(static_cast<int>(size));
        for (vtkIdType k = 0; k < size; ++k)
        {
          kept->InsertCellPoint(this->PlaceOf(corners[k]));
        }
        this->Cells.push_back(cell);
      }
    }
  }

  bool IsNear(vtkIdType size, const vtkIdType* corners) const
  {
    PartBox box;
    for (vtkIdType k = 0; k < size; ++k)
    {
      Vec3 p;
      this->Part->GetPoint(corners[k], p.data());
      box.Add(p);
      if (this->Starts) // a point goes straight
      {
        this->Starts->GetPoint(corners[k], p.data());
        box.Add(p);
      }
    }
    return this->Region.MeetsBox(box.Low, box.High);
  }

  vtkIdType PlaceOf(vtkIdType point)
  {
    const auto [place, isNew] =
      this->Places.emplace(point, static_cast<vtkIdType>(this->Points.size()));
    if (isNew)
    {
      this->Points.push_back(point);
    }
    return place->second;
  }

  vtkPolyData* Part;
  vtkPoints* Starts;
  const PatchRegion& Region;
  const PolygonRuns* Runs;
  vtkUnsignedCharArray* Ghosts;
  std::unordered_map<vtkIdType, vtkIdType> Places;
  std::vector<vtkIdType> Points;
  std::vector<vtkIdType> Cells;
};

/// The nearest cell of those that were looked at.
class NearestCell
{
public:
  NearestCell(vtkPolyData* part, const Vec3& place, double within)
    : Part(part)
    , Points(part->GetPoints())
    , Place(ToVector(place))
    , Best(within)
  {
  }

  double Distance() const { return this->Best; }

  void Look(vtkCellArray* cells, bool areStrips, vtkIdType first, vtkIdType start, vtkIdType end)
  {
    const vtkIdType known = this->Part->GetNumberOfPoints();
    vtkUnsignedCharArray* const ghosts = this->Part->GetCellGhostArray();
    auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    for (vtkIdType cell = start; cell < end; ++cell)
    {
      iterator->GoToCell(cell);
      iterator->GetCurrentCell(size, corners);
      const bool isGood = !IsGhostCell(ghosts, first + cell) &&
        std::all_of(corners, corners + size, [known](vtkIdType p) { return p >= 0 && p < known; });
      for (vtkIdType k = 2; isGood && k < size; ++k)
      {
        const Vector way = NearestToOrigin(this->From(corners[areStrips ? k - 2 : 0]),
          this->From(corners[k - 1]), this->From(corners[k]));
        if (glm::length(way) < this->Best)
        {
          this->Best = glm::length(way);
          this->Corners.assign(corners, corners + size);
          this->IsStrip = areStrips;
        }
      }
    }
  }

  vtkSmartPointer<vtkPolyData> Get() const
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(
      this->Part->GetPoints() ? this->Part->GetPoints()->GetDataType() : VTK_FLOAT);
    vtkNew<vtkCellArray> cells;
    if (!this->Corners.empty())
    {
      cells->InsertNextCell(static_cast<int>(this->Corners.size()));
    }
    for (const vtkIdType corner : this->Corners)
    {
      cells->InsertCellPoint(points->InsertNextPoint(this->Part->GetPoint(corner)));
    }
    auto nearest = vtkSmartPointer<vtkPolyData>::New();
    nearest->SetPoints(points);
    if (this->IsStrip)
    {
      nearest->SetStrips(cells);
    }
    else
    {
      nearest->SetPolys(cells);
    }
    return nearest;
  }

private:
  Vector From(vtkIdType point) const { return ToVector(this->Points.At(point)) - this->Place; }

  vtkPolyData* Part;
  PointReader Points;
  Vector Place;
  double Best;
  std::vector<vtkIdType> Corners;
  bool IsStrip = false;
};
}

PolygonRuns::PolygonRuns(vtkPolyData* part, vtkPoints* starts)
{
  vtkCellArray* const polygons = part->GetPolys();
  const vtkIdType count = polygons->GetNumberOfCells();
  this->Boxes.resize(static_cast<std::size_t>((count + Length - 1) / Length));
  if (!part->GetPoints())
  {
    return; // no polygon is good then
  }
  const PointReader points(part->GetPoints());
  const PointReader before(starts ? starts : part->GetPoints());
  const vtkIdType known = part->GetNumberOfPoints();
  constexpr std::size_t runsAtOnce = 64;
  ParallelFor(this->Boxes.size(), runsAtOnce,
    [&](std::size_t from, std::size_t to)
    {
      auto iterator = vtk::TakeSmartPointer(polygons->NewIterator());
      vtkIdType size = 0;
      const vtkIdType* corners = nullptr;
      const vtkIdType end = std::min(count, static_cast<vtkIdType>(to) * Length);
      for (vtkIdType i = static_cast<vtkIdType>(from) * Length; i < end; ++i)
      {
        iterator->GoToCell(i);
        iterator->GetCurrentCell(size, corners);
        PartBox& box = this->Boxes[static_cast<std::size_t>(i / Length)];
        for (vtkIdType k = 0; k < size; ++k)
        {
          if (corners[k] >= 0 && corners[k] < known)
          {
            box.Add(points.At(corners[k]));
            box.Add(before.At(corners[k]));
          }
        }
      }
    });
}

std::vector<vtkIdType> PolygonRuns::Near(const PatchRegion& region) const
{
  std::vector<vtkIdType> near;
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    if (!this->Boxes[i].IsEmpty() && region.MeetsBox(this->Boxes[i].Low, this->Boxes[i].High))
    {
      near.push_back(static_cast<vtkIdType>(i) * Length);
    }
  }
  return near;
}

std::vector<std::pair<double, vtkIdType>> PolygonRuns::ByDistance(const Vec3& place) const
{
  std::vector<std::pair<double, vtkIdType>> runs;
  runs.reserve(this->Boxes.size());
  for (std::size_t i = 0; i < this->Boxes.size(); ++i)
  {
    if (!this->Boxes[i].IsEmpty())
    {
      runs.emplace_back(this->Boxes[i].DistanceTo(place), static_cast<vtkIdType>(i) * Length);
    }
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

vtkSmartPointer<vtkPolyData> CropNearest(
  vtkPolyData* part, const Vec3& place, double& distance, const PolygonRuns* runs)
{
  NearestCell nearest(part, place, distance);
  const vtkIdType first = part->GetNumberOfVerts() + part->GetNumberOfLines();
  vtkCellArray* const polygons = part->GetPolys();
  const vtkIdType count = polygons->GetNumberOfCells();
  if (!runs)
  {
    nearest.Look(polygons, false, first, 0, count);
  }
  else
  {
    for (const auto& [least, start] : runs->ByDistance(place))
    {
      if (least >= nearest.Distance())
      {
        break;
      }
      nearest.Look(polygons, false, first, start, std::min(count, start + PolygonRuns::Length));
    }
  }
  nearest.Look(part->GetStrips(), true, first + count, 0, part->GetNumberOfStrips());
  distance = nearest.Distance();
  return nearest.Get();
}

vtkSmartPointer<vtkPolyData> CropPart(vtkPolyData* part, const PatchRegion& region,
  const PartOffset& offset, const PolygonRuns* runs, vtkPoints* starts)
{
  return Cropper(part, region, runs, starts).Run(offset);
}
}
