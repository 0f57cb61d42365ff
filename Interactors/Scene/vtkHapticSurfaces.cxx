#include "vtkHapticSurfaces.h"

#include "haptics/Scene/BackgroundWorker.h"
#include "haptics/Scene/SurfaceSet.h"
#include "vtkGodObjectFilter.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstddef>
#include <optional>

vtkStandardNewMacro(vtkHapticSurfaces);

vtkHapticSurfaces::vtkHapticSurfaces()
  : Worker(std::make_unique<haptics::BackgroundWorker>())
  , Surfaces(std::make_unique<haptics::SurfaceSet>())
{
}

vtkHapticSurfaces::~vtkHapticSurfaces() = default;

haptics::SurfaceSet& vtkHapticSurfaces::GetSet()
{
  return *this->Surfaces;
}

haptics::BackgroundWorker& vtkHapticSurfaces::GetWorker()
{
  return *this->Worker;
}

int vtkHapticSurfaces::GetNumberOfSurfaces()
{
  return static_cast<int>(this->Surfaces->All().size());
}

int vtkHapticSurfaces::GetId(int i)
{
  return i >= 0 && i < this->GetNumberOfSurfaces() ? this->Surfaces->All()[i]->Id() : -1;
}

vtkActor* vtkHapticSurfaces::GetActor(int id)
{
  return this->Surfaces->ActorOf(id);
}

vtkAssembly* vtkHapticSurfaces::GetAssembly(int id)
{
  return this->Surfaces->AssemblyOf(id);
}

vtkGodObjectFilter* vtkHapticSurfaces::GetFilter(int id)
{
  const haptics::HapticSurface* surface = this->Surfaces->Find(id);
  return surface ? surface->Filter() : nullptr;
}

vtkHapticProperties* vtkHapticSurfaces::GetProperties(int id)
{
  vtkGodObjectFilter* filter = this->GetFilter(id);
  return filter ? filter->GetProperties() : nullptr;
}

bool vtkHapticSurfaces::SetPropertyArray(int id, int property, int association, const char* name)
{
  vtkGodObjectFilter* filter = this->GetFilter(id);
  if (filter)
  {
    filter->SetInputArrayToProcess(property, 0, 0, association, name ? name : "");
  }
  return filter != nullptr;
}

bool vtkHapticSurfaces::SetName(int id, const char* name)
{
  haptics::HapticSurface* surface = this->Surfaces->Find(id);
  if (surface)
  {
    surface->Name = name ? name : "";
  }
  return surface != nullptr;
}

std::string vtkHapticSurfaces::GetName(int id)
{
  const haptics::HapticSurface* surface = this->Surfaces->Find(id);
  return surface ? surface->Name : "";
}

bool vtkHapticSurfaces::IsTouchable(int id)
{
  return this->Surfaces->IsTouchable(id);
}

bool vtkHapticSurfaces::IsOutdated(int id)
{
  const haptics::HapticSurface* surface = this->Surfaces->Find(id);
  return surface && surface->IsOutdated();
}

bool vtkHapticSurfaces::IntersectRay(
  const double from[3], const double direction[3], double hit[3], double normal[3])
{
  const std::optional<haptics::RayHit> nearest = this->Surfaces->CastRay(
    { { from[0], from[1], from[2] } }, { { direction[0], direction[1], direction[2] } });
  for (int i = 0; nearest && i < 3; ++i)
  {
    hit[i] = from[i] + nearest->Distance * direction[i];
    normal[i] = nearest->Normal[static_cast<std::size_t>(i)];
  }
  return nearest.has_value();
}

bool vtkHapticSurfaces::IsBuilding()
{
  return this->Surfaces->IsBuilding();
}

double vtkHapticSurfaces::GetBuildProgress()
{
  return this->Surfaces->BuildProgress();
}

void vtkHapticSurfaces::CancelBuild()
{
  this->Surfaces->CancelBuilds();
  this->Modified();
}

void vtkHapticSurfaces::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BackgroundBuilding: " << (this->BackgroundBuilding ? "on" : "off") << "\n";
  for (const auto& surface : this->Surfaces->All())
  {
    os << indent << surface->Id() << ": " << (surface->Moves() ? "actor" : "geometry") << ", "
       << (surface->TouchableSurface() ? "touchable" : "not touchable") << "\n";
  }
}
