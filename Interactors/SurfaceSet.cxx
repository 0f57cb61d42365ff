#include "SurfaceSet.h"

#include "vtkActor.h"

#include <algorithm>

namespace haptics
{
bool SurfaceSet::Remove(int id)
{
  const auto end = std::remove_if(this->Surfaces.begin(), this->Surfaces.end(),
    [id](const std::unique_ptr<HapticSurface>& surface) { return surface->Id() == id; });
  if (end == this->Surfaces.end())
  {
    return false;
  }
  this->Surfaces.erase(end, this->Surfaces.end());
  this->Changed = true;
  return true;
}

void SurfaceSet::Clear()
{
  this->Changed = this->Changed || !this->Surfaces.empty();
  this->Surfaces.clear();
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

bool SurfaceSet::Pull(std::vector<std::string>& errors)
{
  bool changed = this->Changed;
  for (const auto& surface : this->Surfaces)
  {
    std::string error;
    changed = surface->Pull(error) || changed;
    if (!error.empty())
    {
      errors.push_back("Surface " + std::to_string(surface->Id()) + ": " + error +
        (surface->Touched() ? " What was touched before stays in force."
                            : " It cannot be touched."));
    }
  }
  this->Changed = false;
  return changed;
}

std::vector<HapticSurface::Snapshot> SurfaceSet::Touched() const
{
  std::vector<HapticSurface::Snapshot> touched;
  for (const auto& surface : this->Surfaces)
  {
    if (HapticSurface::Snapshot snapshot = surface->Touched())
    {
      touched.push_back(std::move(snapshot));
    }
  }
  return touched;
}

void SurfaceSet::Published(std::uint64_t generation)
{
  std::vector<Entry>& entries = this->Generations[generation];
  entries.clear();
  for (const auto& surface : this->Surfaces)
  {
    if (surface->Touched())
    {
      entries.push_back({ surface->Id(), surface->OriginalCellIds() });
    }
  }
}

void SurfaceSet::Forget(std::uint64_t generation)
{
  this->Generations.erase(this->Generations.begin(), this->Generations.lower_bound(generation));
}

SceneCell SurfaceSet::Locate(const TickRecord& tick) const
{
  SceneCell found;
  const auto generation = this->Generations.find(tick.Generation);
  if (tick.NumberOfConstraints > 0 && generation != this->Generations.end())
  {
    const Constraint& constraint = tick.Constraints[0];
    const Entry& entry = generation->second.at(static_cast<std::size_t>(constraint.Surface));
    found.Surface = entry.Id;
    found.Cell = entry.Cells->at(static_cast<std::size_t>(constraint.Triangle));
  }
  return found;
}
}
