// What a vtkHapticScene touches.
#include "vtkHapticScene.h"

#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkAssembly.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticGrip.h"
#include "vtkHapticServo.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <utility>

int vtkHapticScene::AddSurface(vtkActor* actor)
{
  if (!actor)
  {
    this->Fail("There is no actor to add as a surface. Give one.");
    return -1;
  }
  if (const haptics::HapticSurface* known = this->Internal->Surfaces.Find(actor))
  {
    return known->Id();
  }
  this->Modified();
  return this->Internal->Surfaces.Add(std::make_unique<haptics::ActorSource>(actor));
}

int vtkHapticScene::AddSurface(vtkAssembly* assembly)
{
  if (!assembly)
  {
    this->Fail("There is no assembly to add as surfaces. Give one.");
    return -1;
  }
  auto& assemblies = this->Internal->Assemblies;
  const auto known = std::find_if(assemblies.begin(), assemblies.end(),
    [assembly](const haptics::HapticAssembly& a) { return a.Source() == assembly; });
  if (known != assemblies.end())
  {
    return known->Id();
  }
  this->Modified();
  assemblies.emplace_back(this->Internal->Surfaces.TakeId(), assembly);
  return assemblies.back().Id();
}

int vtkHapticScene::AddSurface(vtkAlgorithmOutput* geometry)
{
  if (!geometry)
  {
    this->Fail("There is no output port to add as a surface. Give one.");
    return -1;
  }
  this->Modified();
  return this->Internal->Surfaces.Add(std::make_unique<haptics::PortSource>(geometry));
}

int vtkHapticScene::AddSurface(vtkPolyData* geometry)
{
  if (!geometry)
  {
    this->Fail("There is no geometry to add as a surface. Give a vtkPolyData.");
    return -1;
  }
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(geometry);
  return this->AddSurface(producer->GetOutputPort());
}

bool vtkHapticScene::RemoveSurface(int id)
{
  auto& assemblies = this->Internal->Assemblies;
  const auto assembly = std::find_if(assemblies.begin(), assemblies.end(),
    [id](const haptics::HapticAssembly& a) { return a.Id() == id; });
  const bool isAssembly = assembly != assemblies.end();
  if (isAssembly)
  {
    assembly->RemoveFrom(this->Internal->Surfaces);
    assemblies.erase(assembly);
  }
  const bool isPart = this->GetSurfaceAssembly(id) != nullptr; // it would come back
  const bool removed = isAssembly || (!isPart && this->Internal->Surfaces.Remove(id));
  if (removed)
  {
    this->Modified();
  }
  return removed;
}

bool vtkHapticScene::RemoveSurface(vtkActor* actor)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(actor);
  return surface && this->RemoveSurface(surface->Id());
}

bool vtkHapticScene::RemoveSurface(vtkAssembly* assembly)
{
  for (const haptics::HapticAssembly& known : this->Internal->Assemblies)
  {
    if (assembly && known.Source() == assembly)
    {
      return this->RemoveSurface(known.Id());
    }
  }
  return false;
}

void vtkHapticScene::RemoveAllSurfaces()
{
  this->Internal->Assemblies.clear();
  this->Internal->Surfaces.Clear();
  this->Modified();
}

int vtkHapticScene::GetNumberOfSurfaces()
{
  return static_cast<int>(this->Internal->Surfaces.All().size());
}

int vtkHapticScene::GetSurfaceId(int i)
{
  return i >= 0 && i < this->GetNumberOfSurfaces() ? this->Internal->Surfaces.All()[i]->Id() : -1;
}

vtkAssembly* vtkHapticScene::GetSurfaceAssembly(int id)
{
  for (const haptics::HapticAssembly& assembly : this->Internal->Assemblies)
  {
    if (assembly.Id() == id || assembly.FindActor(id))
    {
      return assembly.Source();
    }
  }
  return nullptr;
}

vtkActor* vtkHapticScene::GetSurfaceActor(int id)
{
  for (const haptics::HapticAssembly& assembly : this->Internal->Assemblies)
  {
    if (vtkActor* actor = assembly.FindActor(id))
    {
      return actor;
    }
  }
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Actor() : nullptr;
}

vtkGodObjectFilter* vtkHapticScene::GetSurfaceFilter(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Filter() : nullptr;
}

vtkHapticProperties* vtkHapticScene::GetSurfaceProperties(int id)
{
  vtkGodObjectFilter* filter = this->GetSurfaceFilter(id);
  return filter ? filter->GetProperties() : nullptr;
}

bool vtkHapticScene::SetSurfacePropertyArray(
  int id, int property, int association, const char* name)
{
  vtkGodObjectFilter* filter = this->GetSurfaceFilter(id);
  if (filter)
  {
    filter->SetInputArrayToProcess(property, 0, 0, association, name ? name : "");
  }
  return filter != nullptr;
}

bool vtkHapticScene::SetSurfaceName(int id, const char* name)
{
  haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  if (surface)
  {
    surface->Name = name ? name : "";
  }
  return surface != nullptr;
}

std::string vtkHapticScene::GetSurfaceName(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Name : "";
}

bool vtkHapticScene::IsSurfaceTouchable(int id)
{
  for (const haptics::HapticAssembly& assembly : this->Internal->Assemblies)
  {
    if (assembly.Id() == id)
    {
      return assembly.IsTouchable(this->Internal->Surfaces);
    }
  }
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface && surface->Touched() && !surface->IsGripped();
}

bool vtkHapticScene::IsSurfaceOutdated(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface && surface->IsOutdated();
}

void vtkHapticScene::SetBackgroundBuilding(bool background)
{
  if (background != this->Internal->BackgroundBuilding)
  {
    this->Internal->BackgroundBuilding = background;
    this->Modified();
  }
}

bool vtkHapticScene::GetBackgroundBuilding()
{
  return this->Internal->BackgroundBuilding;
}

bool vtkHapticScene::IsBuilding()
{
  return this->Internal->Surfaces.IsBuilding();
}

double vtkHapticScene::GetBuildProgress()
{
  return this->Internal->Surfaces.BuildProgress();
}

void vtkHapticScene::CancelBuild()
{
  this->Internal->Surfaces.CancelBuilds();
  this->TellOfBuilds();
}

void vtkHapticScene::FinishBuilds()
{
  while (this->IsBuilding()) // what has changed during one is built by the next
  {
    this->Internal->Worker.Wait();
    this->PullSurfaces();
  }
}

void vtkHapticScene::TellOfBuilds()
{
  const bool isBuilding = this->IsBuilding();
  const double progress = this->GetBuildProgress();
  if (isBuilding != this->Internal->WasBuilding || progress != this->Internal->BuildProgress)
  {
    this->Internal->WasBuilding = isBuilding;
    this->Internal->BuildProgress = progress;
    this->InvokeEvent(vtkHapticScene::BuildEvent);
  }
}

bool vtkHapticScene::PullSurfaces()
{
  if (!this->Internal->BackgroundBuilding && this->IsBuilding())
  {
    this->Internal->Worker.Wait(); // what was begun before it was turned off
  }
  this->Internal->Worker.Collect();
  haptics::PullSettings settings;
  settings.Worker = this->Internal->BackgroundBuilding ? &this->Internal->Worker : nullptr;
  const int state = this->Servo->GetState();
  settings.IsLive = state == vtkHapticServo::Running || state == vtkHapticServo::Stepping;
  settings.IsRunning = state == vtkHapticServo::Running;
  settings.IsTaken = this->Servo->GetLatestRecord().Generation == this->Internal->Published;
  settings.Now = this->Servo->GetTime();
  settings.Interval = settings.Now - std::exchange(this->Internal->LastPull, settings.Now);
  settings.Scale = this->Workspace->GetScale();
  std::vector<std::string> errors;
  haptics::SurfaceSet& surfaces = this->Internal->Surfaces;
  for (haptics::HapticAssembly& assembly : this->Internal->Assemblies)
  {
    assembly.Pull(surfaces);
  }
  const bool changed = surfaces.Pull(settings, errors);
  const int lost = this->Grip->LetGoOfLost();
  if (changed)
  {
    const std::uint64_t generation =
      this->Servo->PublishGodObject(std::make_unique<haptics::GodObject>(surfaces.Touched()));
    this->Internal->Published = generation;
    this->Grip->Published(generation);
    if (!this->Servo->IsRunning())
    {
      // All records are drained: no tick can tell of older ones than the last.
      const auto& latest = this->Internal->Latest;
      surfaces.Forget(latest ? std::min(latest->Generation, generation) : generation);
    }
    surfaces.Published(generation);
  }
  for (const std::string& error : errors)
  {
    this->Fail(error);
    this->IsMessageOfSurface = true;
    this->InvokeEvent(vtkHapticScene::SurfaceErrorEvent);
  }
  if (lost >= 0)
  {
    this->Internal->Events.Add(vtkHapticScene::LetGoEvent, lost);
    this->Internal->Events.Dispatch(this); // after a grip that waits to be told
  }
  this->TellOfBuilds();
  return changed || surfaces.HaveMoved();
}

bool vtkHapticScene::IntersectRay(const double from[3], const double direction[3], double hit[3])
{
  double normal[3];
  return this->IntersectRay(from, direction, hit, normal);
}

bool vtkHapticScene::IntersectRay(
  const double from[3], const double direction[3], double hit[3], double normal[3])
{
  const std::optional<haptics::RayHit> nearest = this->Internal->Surfaces.CastRay(
    { { from[0], from[1], from[2] } }, { { direction[0], direction[1], direction[2] } });
  for (int i = 0; nearest && i < 3; ++i)
  {
    hit[i] = from[i] + nearest->Distance * direction[i];
    normal[i] = nearest->Normal[static_cast<std::size_t>(i)];
  }
  return nearest.has_value();
}
