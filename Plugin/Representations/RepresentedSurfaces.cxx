#include "RepresentedSurfaces.h"

#include "SeamWidth.h"
#include "haptics/Filters/PlacedBounds.h"
#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCompositeRepresentation.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkHapticPatchAlgorithm.h"
#include "vtkHapticScene.h"
#include "vtkHapticSurfaceRepresentation.h"
#include "vtkHapticSurfaces.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace haptics
{
namespace
{
/// What gives a surface in patches; null where it comes whole.
vtkHapticPatchAlgorithm* PatchesOf(vtkActor* actor)
{
  return vtkHapticPatchAlgorithm::SafeDownCast(actor->GetMapper()->GetInputAlgorithm());
}

/// The width of the seams of a surface, or the last one where that will still do: with another one
/// a surface whose points move would be built anew instead of deformed.
double SteadySeamWidth(vtkActor* actor, double last)
{
  auto* const surface = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
  if (!surface || !surface->GetPoints())
  {
    return last;
  }
  double bounds[6];
  surface->GetBounds(bounds);
  if (vtkHapticPatchAlgorithm* const patches = PatchesOf(actor))
  {
    patches->GetSurfaceBounds(bounds);
  }
  const double largest = *std::max_element(
    bounds, bounds + 6, [](double a, double b) { return std::abs(a) < std::abs(b); });
  const double width =
    SeamWidth(std::abs(largest), surface->GetPoints()->GetDataType() == VTK_FLOAT);
  return last >= 0.5 * width && last <= 2.0 * width ? last : width;
}

struct MarkUsedPoints
{
  template <class Points>
  void operator()(Points* points, std::vector<unsigned char>& isUsed) const
  {
    for (const auto point : vtk::DataArrayValueRange<1>(points))
    {
      isUsed[static_cast<std::size_t>(point)] = 1;
    }
  }
};

struct AddUsedPoints
{
  template <class Coordinates>
  void operator()(
    Coordinates* coordinates, const std::vector<unsigned char>& isUsed, double bounds[6]) const
  {
    std::size_t index = 0;
    for (const auto point : vtk::DataArrayTupleRange<3>(coordinates))
    {
      if (isUsed[index++])
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const auto coordinate = static_cast<double>(point[axis]);
          bounds[2 * axis] = std::min(bounds[2 * axis], coordinate);
          bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], coordinate);
        }
      }
    }
  }
};

/// Of the box around the points that polygons use, where a matrix takes it: as
/// vtkPolyData::GetCellsBounds(), in a fiftieth of the time: a user waits for it.
vtkBoundingBox BoundsOf(vtkPolyData* surface, vtkMatrix4x4* place)
{
  std::vector<unsigned char> isUsed(surface->GetNumberOfPoints(), 0);
  vtkDataArray* const corners = surface->GetPolys()->GetConnectivityArray();
  const MarkUsedPoints mark;
  if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Integrals>::Execute(
        corners, mark, isUsed))
  {
    mark(corners, isUsed);
  }
  const vtkBoundingBox nothing;
  double bounds[6];
  nothing.GetBounds(bounds); // each least is above each most
  vtkDataArray* const coordinates = surface->GetPoints()->GetData();
  const AddUsedPoints add;
  if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>::Execute(
        coordinates, add, isUsed, bounds))
  {
    add(coordinates, isUsed, bounds);
  }
  return PlacedBounds(bounds, place->GetData());
}
}

bool RepresentedSurfaces::Add(vtkObject* representation)
{
  if (!vtkCompositeRepresentation::SafeDownCast(representation) &&
    !vtkHapticSurfaceRepresentation::SafeDownCast(representation))
  {
    return false;
  }
  Surface surface;
  surface.Representation = representation;
  this->Surfaces.push_back(surface);
  return true;
}

void RepresentedSurfaces::SetSource(
  vtkObject* representation, const std::string& name, vtkHapticSurfaceRepresentation* source)
{
  for (Surface& surface : this->Surfaces)
  {
    if (surface.Representation == representation)
    {
      surface.Name = name;
      surface.Source = source;
      this->Scene->GetSurfaces()->SetName(surface.Id, name.c_str());
    }
  }
}

void RepresentedSurfaces::SetSide(int side)
{
  this->Side = std::clamp(
    side, static_cast<int>(vtkGodObjectFilter::FRONT), +vtkGodObjectFilter::AUTOMATIC_SIDE);
}

/// What brings the triangles of a surface; null where it cannot be touched just now.
vtkHapticSurfaceRepresentation* RepresentedSurfaces::SourceOf(const Surface& surface)
{
  vtkObject* drawn = surface.Representation;
  if (auto* composite = vtkCompositeRepresentation::SafeDownCast(drawn))
  {
    drawn = composite->GetActiveRepresentation();
  }
  auto* haptic = vtkHapticSurfaceRepresentation::SafeDownCast(drawn);
  return haptic                                        ? haptic
    : surface.Source && surface.Source->GetTouchable() ? +surface.Source
                                                       : nullptr;
}

void RepresentedSurfaces::Sync()
{
  this->Surfaces.erase(std::remove_if(this->Surfaces.begin(), this->Surfaces.end(),
                         [](const Surface& s) { return !s.Representation; }),
    this->Surfaces.end());
  std::set<vtkActor*> wanted;
  for (Surface& surface : this->Surfaces)
  {
    vtkHapticSurfaceRepresentation* source = SourceOf(surface);
    surface.Actor = source ? source->GetTouchedActor() : nullptr;
    surface.Id = -1;
    if (surface.Actor)
    {
      wanted.insert(surface.Actor);
      surface.Id = this->Scene->AddSurface(surface.Actor);
      this->Scene->GetSurfaces()->SetName(surface.Id, surface.Name.c_str());
      vtkGodObjectFilter* filter = this->Scene->GetSurfaceFilter(surface.Id);
      filter->SetSide(this->Side);
      source->Configure(filter);
      filter->SetMergeToleranceIsAbsolute(true);
      filter->SetMergeTolerance(
        this->InPieces ? SteadySeamWidth(surface.Actor, filter->GetMergeTolerance()) : 0.0);
    }
  }
  for (int i = this->Scene->GetNumberOfSurfaces() - 1; i >= 0; --i)
  {
    const int id = this->Scene->GetSurfaces()->GetId(i);
    if (wanted.count(this->Scene->GetSurfaceActor(id)) == 0)
    {
      this->Scene->RemoveSurface(id);
    }
  }
}

int RepresentedSurfaces::NumberOfTouchable() const
{
  return static_cast<int>(std::count_if(this->Surfaces.begin(), this->Surfaces.end(),
    [this](const Surface& surface)
    { return this->Scene->GetSurfaces()->IsTouchable(surface.Id); }));
}

bool RepresentedSurfaces::HasBad() const
{
  vtkHapticSurfaces* surfaces = this->Scene->GetSurfaces();
  return surfaces->IsBuilding() ||
    std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
      [surfaces](const Surface& surface)
      {
        return surface.Actor && surface.Actor->GetVisibility() &&
          (!surfaces->IsTouchable(surface.Id) || surfaces->IsOutdated(surface.Id));
      });
}

bool RepresentedSurfaces::IsAnyShown() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const Surface& surface) { return surface.Actor && surface.Actor->GetVisibility(); });
}

bool RepresentedSurfaces::AreInPatches() const
{
  return std::all_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const Surface& surface) { return surface.Actor && PatchesOf(surface.Actor); });
}

vtkBoundingBox RepresentedSurfaces::Bounds() const
{
  vtkBoundingBox box;
  for (const Surface& surface : this->Surfaces)
  {
    auto* shown = surface.Actor && surface.Actor->GetVisibility()
      ? vtkPolyData::SafeDownCast(surface.Actor->GetMapper()->GetInput())
      : nullptr;
    vtkHapticPatchAlgorithm* const patches = shown ? PatchesOf(surface.Actor) : nullptr;
    if (patches && patches->Survey())
    {
      double bounds[6];
      patches->GetSurfaceBounds(bounds);
      box.AddBox(PlacedBounds(bounds, surface.Actor->GetMatrix()->GetData()));
    }
    else if (shown && shown->GetNumberOfPolys() > 0)
    {
      box.AddBox(BoundsOf(shown, surface.Actor->GetMatrix()));
    }
  }
  return box;
}

std::set<std::string> RepresentedSurfaces::NamesOfArrays() const
{
  std::set<std::string> names;
  for (const Surface& surface : this->Surfaces)
  {
    if (surface.Actor && PatchesOf(surface.Actor))
    {
      PatchesOf(surface.Actor)->Update(); // also a patch of no cell has the arrays
    }
    vtkDataSet* data = surface.Actor ? surface.Actor->GetMapper()->GetInput() : nullptr;
    for (const int kind : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkFieldData* arrays = data ? data->GetAttributesAsFieldData(kind) : nullptr;
      for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
      {
        const char* name = arrays->GetArray(i) ? arrays->GetArray(i)->GetName() : nullptr;
        if (name && std::string(name).rfind("vtk", 0) != 0)
        {
          names.insert(name);
        }
      }
    }
  }
  return names;
}

int RepresentedSurfaces::IndexOf(int id) const
{
  const auto found = std::find_if(this->Surfaces.begin(), this->Surfaces.end(),
    [id](const Surface& surface) { return id >= 0 && surface.Id == id; });
  return found == this->Surfaces.end() ? -1 : static_cast<int>(found - this->Surfaces.begin());
}
}
