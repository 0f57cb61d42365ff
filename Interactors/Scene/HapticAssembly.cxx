#include "haptics/Scene/HapticAssembly.h"

#include "haptics/Scene/SurfaceSet.h"
#include "vtkActor.h"
#include "vtkAssemblyNode.h"
#include "vtkAssemblyPath.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm>

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
  part.Follower = vtkSmartPointer<vtkActor>::New();
  part.Follower->SetUserMatrix(vtkNew<vtkMatrix4x4>());
  part.Surface = surfaces.Add(part.Follower.Get());
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
    vtkActor* actor = vtkActor::SafeDownCast(path->GetLastNode()->GetViewProp());
    if (!actor)
    {
      continue; // a volume, say
    }
    std::vector<vtkProp*> way;
    bool isShown = true;
    vtkCollectionSimpleIterator iterator;
    path->InitTraversal(iterator);
    while (vtkAssemblyNode* node = path->GetNextNode(iterator))
    {
      way.push_back(node->GetViewProp());
      isShown = isShown && way.back()->GetVisibility() && way.back()->GetPickable();
    }
    Part& part = this->FindOrAdd(way, actor, surfaces);
    part.IsThere = true;
    part.Follower->SetMapper(actor->GetMapper());
    part.Follower->SetVisibility(isShown);
    vtkMatrix4x4* world = path->GetLastNode()->GetMatrix();
    vtkMatrix4x4* followed = part.Follower->GetUserMatrix();
    if (!std::equal(world->GetData(), world->GetData() + 16, followed->GetData()))
    {
      followed->DeepCopy(world);
    }
  }
  const auto gone = std::partition(
    this->Parts.begin(), this->Parts.end(), [](const Part& part) { return part.IsThere; });
  std::for_each(
    gone, this->Parts.end(), [&surfaces](const Part& part) { surfaces.Remove(part.Surface); });
  this->Parts.erase(gone, this->Parts.end());
}

void HapticAssembly::RemoveFrom(SurfaceSet& surfaces)
{
  for (const Part& part : this->Parts)
  {
    surfaces.Remove(part.Surface);
  }
  this->Parts.clear();
}

bool HapticAssembly::IsTouchable(const SurfaceSet& surfaces) const
{
  return std::any_of(this->Parts.begin(), this->Parts.end(),
    [&surfaces](const Part& part) { return surfaces.Find(part.Surface)->Touched() != nullptr; });
}

vtkActor* HapticAssembly::FindActor(int surface) const
{
  const auto found = std::find_if(this->Parts.begin(), this->Parts.end(),
    [surface](const Part& part) { return part.Surface == surface; });
  return found != this->Parts.end() ? found->Actor.Get() : nullptr;
}
}
