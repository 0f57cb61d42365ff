#include "haptics/Scene/HapticAssembly.h"

#include "haptics/Scene/SurfaceSet.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkMatrix4x4.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace haptics
{
HapticAssembly::HapticAssembly(int id, vtkAssembly* assembly)
  : Identifier(id)
  , Assembly(assembly)
{
}

HapticAssembly::Part& HapticAssembly::FindOrAdd(
  const std::vector<vtkProp*>& way, vtkActor* actor, SurfaceSet& surfaces)
{
  const auto known = std::find_if(
    this->Parts.begin(), this->Parts.end(), [&way](const Part& part) { return part.Way == way; });
  if (known != this->Parts.end())
  {
    return *known;
  }
  Part part;
  part.Way = way;
  part.Actor = actor;
  auto source = std::make_unique<PartSource>();
  part.Source = source.get();
  part.Surface = surfaces.Add(std::move(source));
  this->Parts.push_back(part);
  return this->Parts.back();
}

void HapticAssembly::Pull(SurfaceSet& surfaces)
{
  for (Part& part : this->Parts)
  {
    part.IsThere = false;
  }
  this->Assembly->InitPathTraversal(); // makes the paths anew where anything below has changed
  while (vtkAssemblyPath* path = this->Assembly->GetNextPath())
  {
    std::vector<vtkProp*> way;
    bool isShown = true;
    vtkMatrix4x4* world = nullptr;
    vtkCollectionSimpleIterator iterator;
    path->InitTraversal(iterator);
    while (vtkAssemblyNode* node = path->GetNextNode(iterator))
    {
      way.push_back(node->GetViewProp());
      isShown = isShown && way.back()->GetVisibility() && way.back()->GetPickable();
      world = node->GetMatrix();
    }
    vtkActor* actor = way.empty() ? nullptr : vtkActor::SafeDownCast(way.back());
    if (!actor)
    {
      continue; // a volume, say
    }
    Part& part = this->FindOrAdd(way, actor, surfaces);
    part.IsThere = true;
    part.Source->Mapper = actor->GetMapper();
    part.Source->Shown = isShown;
    std::copy_n(world->GetData(), 16, part.Source->World.begin());
  }
  const auto gone = std::partition(
    this->Parts.begin(), this->Parts.end(), [](const Part& part) { return part.IsThere; });
  std::for_each(
    gone, this->Parts.end(), [&surfaces](const Part& part) { surfaces.RemovePart(part.Surface); });
  this->Parts.erase(gone, this->Parts.end());
}

void HapticAssembly::RemoveFrom(SurfaceSet& surfaces)
{
  for (const Part& part : this->Parts)
  {
    surfaces.RemovePart(part.Surface);
  }
  this->Parts.clear();
}

bool HapticAssembly::IsTouchable(const SurfaceSet& surfaces) const
{
  return std::any_of(this->Parts.begin(), this->Parts.end(),
    [&surfaces](const Part& part)
    { return surfaces.Find(part.Surface)->TouchableSurface() != nullptr; });
}

vtkActor* HapticAssembly::FindActor(int surface) const
{
  const auto found = std::find_if(this->Parts.begin(), this->Parts.end(),
    [surface](const Part& part) { return part.Surface == surface; });
  return found != this->Parts.end() ? found->Actor.Get() : nullptr;
}
}
