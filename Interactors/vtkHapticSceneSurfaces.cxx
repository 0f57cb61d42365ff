// What a vtkHapticScene touches, and how the device's workspace lies over it.
#include "vtkHapticScene.h"

#include "HapticSceneInternals.h"
#include "SurfaceRay.h"
#include "WorkspaceFit.h"
#include "WorkspaceTransform.h"
#include "vtkActor.h"
#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkGodObjectFilter.h"
#include "vtkHapticDevice.h"
#include "vtkHapticServo.h"
#include "vtkMatrix4x4.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

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
  return this->Internal->Surfaces.Add(actor);
}

int vtkHapticScene::AddSurface(vtkAlgorithmOutput* geometry)
{
  if (!geometry)
  {
    this->Fail("There is no output port to add as a surface. Give one.");
    return -1;
  }
  this->Modified();
  return this->Internal->Surfaces.Add(geometry);
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
  const bool removed = this->Internal->Surfaces.Remove(id);
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

void vtkHapticScene::RemoveAllSurfaces()
{
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

vtkActor* vtkHapticScene::GetSurfaceActor(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Actor() : nullptr;
}

vtkGodObjectFilter* vtkHapticScene::GetSurfaceFilter(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface ? surface->Filter() : nullptr;
}

bool vtkHapticScene::IsSurfaceTouchable(int id)
{
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  return surface && surface->Touched();
}

bool vtkHapticScene::SetWorkspaceTransform(vtkMatrix4x4* deviceToWorld)
{
  if (!deviceToWorld)
  {
    this->Fail("There is no matrix to take as the workspace transform. Give one.");
    return false;
  }
  std::string error;
  if (!haptics::WorkspaceTransform().SetMatrix(deviceToWorld->GetData(), error))
  {
    this->Fail(error + " The last one stays.");
    return false;
  }
  this->Servo->SetWorkspaceTransform(deviceToWorld);
  this->Workspace->DeepCopy(deviceToWorld);
  this->Modified();
  return true;
}

vtkMatrix4x4* vtkHapticScene::GetWorkspaceTransform()
{
  return this->Workspace;
}

bool vtkHapticScene::FitWorkspace(vtkCamera* camera)
{
  this->PullSurfaces();
  vtkBoundingBox box;
  for (const auto& surface : this->Internal->Surfaces.All())
  {
    surface->AddBounds(box);
  }
  if (!box.IsValid())
  {
    this->Fail(
      "The workspace fits nothing: the scene has no surface that can be touched. Add one.");
    return false;
  }
  double bounds[6];
  box.GetBounds(bounds);
  return this->FitWorkspace(bounds, camera);
}

bool vtkHapticScene::FitWorkspace(const double bounds[6], vtkCamera* camera)
{
  vtkHapticDevice* device = this->GetDevice();
  if (!device)
  {
    this->Fail("The workspace cannot be fitted without a device. Call SetDevice() first.");
    return false;
  }
  vtkNew<vtkMatrix4x4> fitted;
  std::string error;
  if (!haptics::FitWorkspace(device->GetWorkspaceBounds(), bounds, camera, fitted, error))
  {
    this->Fail("The workspace cannot be fitted: " + error + ".");
    return false;
  }
  return this->SetWorkspaceTransform(fitted);
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
  std::vector<std::string> errors;
  haptics::SurfaceSet& surfaces = this->Internal->Surfaces;
  const bool clutchMoved = std::exchange(this->Internal->ClutchMoved, false);
  const bool changed = surfaces.Pull(settings, errors) || clutchMoved;
  if (changed)
  {
    std::vector<haptics::TouchedSurface> touched;
    if (!this->Internal->Clutched)
    {
      touched = surfaces.Touched();
    }
    const std::uint64_t generation =
      this->Servo->PublishGodObject(std::make_unique<haptics::GodObject>(std::move(touched)));
    if (!this->Servo->IsRunning())
    {
      surfaces.Forget(generation); // all records are drained, no tick can tell of older ones
    }
    surfaces.Published(generation);
  }
  for (const std::string& error : errors)
  {
    this->Fail(error);
    this->InvokeEvent(vtkHapticScene::SurfaceErrorEvent);
  }
  this->TellOfBuilds();
  return changed;
}

bool vtkHapticScene::IntersectRay(const double from[3], const double direction[3], double hit[3])
{
  std::optional<double> nearest;
  for (const haptics::TouchedSurface& touched : this->Internal->Surfaces.Touched())
  {
    const std::optional<double> t = haptics::CastRay(*touched.Surface,
      { { from[0], from[1], from[2] } }, { { direction[0], direction[1], direction[2] } });
    if (t && (!nearest || *t < *nearest))
    {
      nearest = t;
    }
  }
  for (int i = 0; nearest && i < 3; ++i)
  {
    hit[i] = from[i] + *nearest * direction[i];
  }
  return nearest.has_value();
}
