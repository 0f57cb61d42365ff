#include "haptics/Scene/SurfaceSet.h"

#include "haptics/Filters/DataPoints.h"
#include "haptics/Scene/HapticProbeFiller.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <utility>

namespace haptics
{
int SurfaceSet::Add(vtkAssembly* assembly)
{
  const int known = this->FindAssembly(assembly);
  if (known >= 0)
  {
    return known;
  }
  this->Assemblies.emplace_back(this->NextId++, assembly);
  return this->Assemblies.back().Id();
}

bool SurfaceSet::Remove(int id)
{
  const auto assembly = std::find_if(this->Assemblies.begin(), this->Assemblies.end(),
    [id](const HapticAssembly& a) { return a.Id() == id; });
  if (assembly != this->Assemblies.end())
  {
    assembly->RemoveFrom(*this);
    this->Assemblies.erase(assembly);
    return true;
  }
  if (this->AssemblyOf(id) || !this->Find(id))
  {
    return false;
  }
  this->RemovePart(id);
  return true;
}

void SurfaceSet::RemovePart(int id)
{
  const auto end = std::remove_if(this->Surfaces.begin(), this->Surfaces.end(),
    [id](const std::unique_ptr<HapticSurface>& surface) { return surface->Id() == id; });
  this->Changed = this->Changed || end != this->Surfaces.end();
  this->Surfaces.erase(end, this->Surfaces.end());
}

void SurfaceSet::Clear()
{
  this->Changed = this->Changed || !this->Surfaces.empty();
  this->Surfaces.clear();
  this->Assemblies.clear();
}

HapticSurface* SurfaceSet::Find(int id) const
{
  for (const auto& surface : this->Surfaces)
  {
    if (surface->Id() == id)
    {
      return surface.get();
    }
  }
  return nullptr;
}

HapticSurface* SurfaceSet::Find(vtkActor* actor) const
{
  for (const auto& surface : this->Surfaces)
  {
    if (actor && surface->Actor() == actor)
    {
      return surface.get();
    }
  }
  return nullptr;
}

int SurfaceSet::FindAssembly(vtkAssembly* assembly) const
{
  const auto found = std::find_if(this->Assemblies.begin(), this->Assemblies.end(),
    [assembly](const HapticAssembly& a) { return a.Source() == assembly; });
  return found != this->Assemblies.end() ? found->Id() : -1;
}

vtkAssembly* SurfaceSet::AssemblyOf(int id) const
{
  const auto found = std::find_if(this->Assemblies.begin(), this->Assemblies.end(),
    [id](const HapticAssembly& a) { return a.Id() == id || a.FindActor(id); });
  return found != this->Assemblies.end() ? found->Source() : nullptr;
}

vtkActor* SurfaceSet::ActorOf(int id) const
{
  for (const HapticAssembly& assembly : this->Assemblies)
  {
    if (vtkActor* const actor = assembly.FindActor(id))
    {
      return actor;
    }
  }
  const HapticSurface* const surface = this->Find(id);
  return surface ? surface->Actor() : nullptr;
}

bool SurfaceSet::IsTouchable(int id) const
{
  for (const HapticAssembly& assembly : this->Assemblies)
  {
    if (assembly.Id() == id)
    {
      return assembly.IsTouchable(*this);
    }
  }
  const HapticSurface* const surface = this->Find(id);
  return surface && surface->TouchableSurface() && !surface->IsGripped();
}

std::string SurfaceSet::Title(int id) const
{
  const HapticSurface* const surface = this->Find(id);
  return surface ? surface->Title() : "Surface " + std::to_string(id);
}

void SurfaceSet::SetGripped(int id, bool isGripped)
{
  HapticSurface* const surface = this->Find(id);
  if (surface && surface->IsGripped() != isGripped)
  {
    surface->SetGripped(isGripped);
    this->Changed = true;
  }
}

void SurfaceSet::PullAssemblies()
{
  for (HapticAssembly& assembly : this->Assemblies)
  {
    assembly.Pull(*this);
  }
}

bool SurfaceSet::Pull(const PullSettings& settings, std::vector<std::string>& errors)
{
  bool changed = this->Changed;
  for (const auto& surface : this->Surfaces)
  {
    std::string error;
    const BackgroundTask* before = surface->Building();
    changed = surface->Pull(settings, error) || changed;
    this->BuildsStarted += surface->Building() && surface->Building() != before ? 1 : 0;
    if (!error.empty())
    {
      errors.push_back(surface->Title() + ": " + error);
    }
  }
  this->Changed = false;
  this->BuildsStarted = this->IsBuilding() ? this->BuildsStarted : 0;
  return changed;
}

bool SurfaceSet::IsFaulty() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const auto& surface) { return surface->IsFaulty(); });
}

bool SurfaceSet::HaveMoved() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const std::unique_ptr<HapticSurface>& surface) { return surface->HasMoved(); });
}

bool SurfaceSet::IsWaiting() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const std::unique_ptr<HapticSurface>& surface) { return surface->IsWaitingForServo(); });
}

bool SurfaceSet::IsInPatches() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const std::unique_ptr<HapticSurface>& surface) { return surface->IsInPatches(); });
}

bool SurfaceSet::IsBuilding() const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [](const std::unique_ptr<HapticSurface>& surface) { return surface->Building(); });
}

double SurfaceSet::BuildProgress() const
{
  double missing = 0.0;
  for (const auto& surface : this->Surfaces)
  {
    missing += surface->Building() ? 1.0 - surface->Building()->Progress() : 0.0;
  }
  return this->BuildsStarted > 0 ? 1.0 - missing / this->BuildsStarted : 1.0;
}

void SurfaceSet::CancelBuilds()
{
  for (const auto& surface : this->Surfaces)
  {
    surface->CancelBuild();
  }
  this->BuildsStarted = 0;
}

std::vector<const HapticSurface*> SurfaceSet::Listed() const
{
  std::vector<const HapticSurface*> listed;
  for (const bool isGripped : { false, true })
  {
    for (const auto& surface : this->Surfaces)
    {
      if (surface->TouchableSurface() && surface->IsGripped() == isGripped)
      {
        listed.push_back(surface.get());
      }
    }
  }
  return listed;
}

std::vector<TouchedSurface> SurfaceSet::TouchableSurfaces() const
{
  std::vector<TouchedSurface> touched;
  for (const HapticSurface* surface : this->Listed())
  {
    touched.emplace_back(
      surface->TouchableSurface(), surface->Motion(), surface->TouchedProperties());
    touched.back().Identity = surface->Identity();
    touched.back().IsGripped = surface->IsGripped();
  }
  return touched;
}

std::optional<RayHit> SurfaceSet::CastRay(const Vec3& from, const Vec3& direction) const
{
  std::optional<RayHit> nearest;
  for (const auto& surface : this->Surfaces)
  {
    const std::optional<RayHit> hit =
      surface->IsGripped() ? std::nullopt : surface->CastRay(from, direction);
    if (hit && (!nearest || hit->Distance < nearest->Distance))
    {
      nearest = hit;
    }
  }
  return nearest;
}

void SurfaceSet::OnPublished(std::uint64_t generation)
{
  std::vector<Entry>& entries = this->Generations[generation];
  entries.clear();
  for (const HapticSurface* surface : this->Listed())
  {
    vtkPolyData* const prepared = surface->Prepared();
    const bool isExchanged = prepared &&
      prepared->GetNumberOfPolys() ==
        static_cast<vtkIdType>(surface->TouchableSurface()->Triangles().size()) &&
      HasExchangedCorners(prepared, *surface->TouchableSurface());
    entries.push_back({ surface->Id(), surface->OriginalCellIds(), surface->TouchableSurface(),
      prepared, isExchanged });
  }
}

void SurfaceSet::Forget(std::uint64_t generation)
{
  this->Generations.erase(this->Generations.begin(), this->Generations.lower_bound(generation));
}

void SurfaceSet::ForgetAllBut(std::uint64_t generation)
{
  this->Forget(generation);
  this->Generations.erase(this->Generations.upper_bound(generation), this->Generations.end());
}

const SurfaceSet::Entry* SurfaceSet::Find(const TickRecord& tick, int constraint) const
{
  const auto generation = this->Generations.find(tick.Generation);
  if (constraint >= tick.NumberOfConstraints || generation == this->Generations.end())
  {
    return nullptr;
  }
  return &generation->second.at(static_cast<std::size_t>(tick.Constraints[constraint].Surface));
}

SceneCell SurfaceSet::Locate(const TickRecord& tick) const
{
  SceneCell found;
  if (const Entry* entry = this->Find(tick, 0))
  {
    found.Surface = entry->Id;
    found.Cell = entry->Cells->at(static_cast<std::size_t>(tick.Constraints[0].Triangle));
  }
  return found;
}

/// The arrays are those of now, or where the geometry has changed since those of then.
vtkPolyData* SurfaceSet::PreparedOf(const Entry& entry) const
{
  const HapticSurface* const surface = this->Find(entry.Id);
  vtkPolyData* const prepared = surface && surface->TouchableSurface() == entry.Surface
    ? surface->Prepared()
    : entry.Prepared.Get();
  const auto triangles = static_cast<vtkIdType>(entry.Surface->Triangles().size());
  return prepared && prepared->GetNumberOfPolys() == triangles ? prepared : nullptr;
}

TouchedPlace SurfaceSet::Trace(const TickRecord& tick) const
{
  TouchedPlace place;
  const Entry* const entry = this->Find(tick, 0);
  if (!entry)
  {
    return place;
  }
  const SceneCell cell = this->Locate(tick);
  const HapticSurface* const surface = this->Find(entry->Id);
  place.Triangle = tick.Constraints[0].Triangle;
  place.Prepared = this->PreparedOf(*entry);
  place.Name = surface ? &surface->Name : nullptr;
  place.Traced = { cell.Surface, cell.Cell, { -1, -1, -1 }, tick.Weights };
  if (entry->HasExchangedCorners)
  {
    std::swap(place.Traced.Weights[1], place.Traced.Weights[2]);
  }
  vtkDataArray* const originals =
    place.Prepared ? place.Prepared->GetPointData()->GetArray("OriginalPointId") : nullptr;
  if (originals)
  {
    vtkNew<vtkIdList> corners;
    place.Prepared->GetPolys()->GetCellAtId(place.Triangle, corners);
    for (vtkIdType k = 0; k < 3; ++k)
    {
      place.Traced.Points[static_cast<std::size_t>(k)] =
        static_cast<std::int32_t>(originals->GetComponent(corners->GetId(k), 0));
    }
  }
  return place;
}

Vec3 SurfaceSet::PointOf(const TickRecord& tick, const HapticSurface& surface) const
{
  const Entry* entry = this->Find(tick, 0);
  if (!entry || entry->Id != surface.Id())
  {
    return surface.Pose().PointToSurface(tick.Position);
  }
  const Vec3& origin = entry->Surface->Origin();
  return { tick.Local[0] + origin[0], tick.Local[1] + origin[1], tick.Local[2] + origin[2] };
}

void SurfaceSet::Probe(const TickRecord& tick, vtkHapticProbe* probe) const
{
  vtkHapticProbeFiller::SetTick(probe, tick);
  if (const Entry* entry = this->Find(tick, 0))
  {
    const HapticSurface* surface = this->Find(entry->Id);
    vtkHapticProbeFiller::SetContact(probe, tick,
      { entry->Id, surface ? surface->Name : "", this->Locate(tick).Cell, entry->Surface,
        surface ? surface->Pose() : RigidPose() },
      this->PreparedOf(*entry));
  }
}

std::vector<Vec3> SurfaceSet::ActiveCorners(const TickRecord& tick) const
{
  std::vector<Vec3> corners;
  for (int i = 0; i < tick.NumberOfConstraints; ++i)
  {
    const Entry* entry = this->Find(tick, i);
    const HapticSurface* shown = entry ? this->Find(entry->Id) : nullptr;
    if (shown)
    {
      const TriangleSurface& surface = *entry->Surface;
      for (const std::int32_t corner :
        surface.Triangles()[static_cast<std::size_t>(tick.Constraints[i].Triangle)])
      {
        const Vec3& p = surface.Points()[static_cast<std::size_t>(corner)];
        const Vec3& o = surface.Origin();
        corners.push_back(shown->Pose().PointToWorld({ p[0] + o[0], p[1] + o[1], p[2] + o[2] }));
      }
    }
  }
  return corners;
}
}
