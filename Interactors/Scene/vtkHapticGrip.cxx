#include "vtkHapticGrip.h"

#include "haptics/Scene/CarriedSurface.h"
#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkActor.h"
#include "vtkHapticScene.h"
#include "vtkObjectFactory.h"

#include <utility>

vtkStandardNewMacro(vtkHapticGrip);

namespace
{
constexpr const char* NoActor =
  " was added as geometry: there is no actor that a hand could carry. Add it as a vtkActor.";
}

vtkHapticGrip::vtkHapticGrip()
  : Carried(std::make_unique<haptics::CarriedSurface>())
{
}

vtkHapticGrip::~vtkHapticGrip() = default;

bool vtkHapticGrip::Fail(const std::string& message)
{
  this->ErrorMessage = message;
  vtkErrorMacro(<< message);
  return false;
}

void vtkHapticGrip::SetScene(vtkHapticScene* scene)
{
  this->Scene = scene;
  if (!scene)
  {
    this->Carried = std::make_unique<haptics::CarriedSurface>();
  }
}

int vtkHapticGrip::GetSurface()
{
  return this->Carried->Surface();
}

bool vtkHapticGrip::Take()
{
  if (!this->Scene || !this->Scene->GetTouching())
  {
    return this->Fail("A grip needs a contact, and nothing is touched. Touch a surface first.");
  }
  return this->TakeSurface(this->Scene->GetTouchedSurface());
}

bool vtkHapticGrip::TakeSurface(int id)
{
  this->ErrorMessage.clear();
  if (!this->Scene)
  {
    return this->Fail("There is no surface " + std::to_string(id) +
      " to grip: this grip belongs to no scene. Use what vtkHapticScene::GetGrip() returns.");
  }
  this->Scene->PullSurfaces(); // it may have been hidden meanwhile
  vtkHapticScene::Internals& scene = *this->Scene->Internal;
  const haptics::HapticSurface* surface = scene.Surfaces.Find(id);
  const std::string name = scene.Surfaces.Title(id);
  if (surface && this->Carried->Surface() == id)
  {
    return true;
  }
  if (!surface)
  {
    return this->Fail(this->Scene->GetSurfaceAssembly(id)
        ? name + " is a whole assembly. Grip one of its parts, which have ids of their own."
        : "There is no surface " + std::to_string(id) + " to grip.");
  }
  if (!this->Scene->GetSurfaceActor(id))
  {
    return this->Fail(name + NoActor);
  }
  if (!surface->Touched())
  {
    return this->Fail(name + " cannot be touched, and so cannot be gripped. Show it first.");
  }
  if (!this->Scene->IsHandThere())
  {
    return this->Fail(
      "There is no hand to grip with. Engage() or Step() first, with the clutch off.");
  }
  this->LetGo();
  this->Carried->Take(id, *scene.Latest, scene.Surfaces);
  scene.Events.Add(vtkHapticScene::GripEvent, id);
  this->Scene->PullSurfaces();
  this->Modified();
  return this->Carried->Surface() == id;
}

void vtkHapticGrip::LetGo()
{
  if (this->Carried->IsNothing())
  {
    return;
  }
  this->Carry();
  vtkHapticScene::Internals& scene = *this->Scene->Internal;
  scene.Events.Add(vtkHapticScene::LetGoEvent, this->Carried->Surface());
  this->Carried->LetGo(scene.Surfaces);
  this->Scene->PullSurfaces(); // what moves the actor from now on is not the hand
  this->Modified();
}

int vtkHapticGrip::LetGoOfLost()
{
  haptics::SurfaceSet& surfaces = this->Scene->Internal->Surfaces;
  if (!this->Carried->IsLost(surfaces))
  {
    return haptics::CarriedSurface::Nothing;
  }
  const int lost = this->Carried->Surface();
  this->Carried->LetGo(surfaces);
  return lost;
}

void vtkHapticGrip::Published(std::uint64_t generation)
{
  this->Carried->Published(generation);
}

void vtkHapticGrip::Look(const haptics::TickRecord& tick)
{
  this->Carried->Look(tick, this->Scene->Internal->Surfaces);
}

bool vtkHapticGrip::Carry()
{
  vtkHapticScene::Internals& scene = *this->Scene->Internal;
  if (this->Carried->IsNothing() || !scene.Latest)
  {
    return false;
  }
  scene.Surfaces.PullAssemblies(); // the surface of a part only stands for its actor
  vtkActor* actor = scene.Surfaces.ActorOf(this->Carried->Surface());
  return actor && this->Carried->Carry(*scene.Latest, actor, scene.Surfaces);
}

void vtkHapticGrip::ObeyButtons(unsigned int buttons)
{
  const bool isThere = this->Scene->IsHandThere();
  const bool isHeld = isThere && this->Button >= 0 && (buttons >> this->Button & 1U) != 0;
  const bool wasHeld = std::exchange(this->IsButtonHeld, isHeld);
  if (!isThere || (wasHeld && !isHeld))
  {
    this->LetGo();
  }
  if (!isHeld || wasHeld || !this->Scene->GetTouching())
  {
    return;
  }
  const int id = this->Scene->GetTouchedSurface();
  if (this->Scene->GetSurfaceActor(id))
  {
    this->TakeSurface(id);
  }
  // Once: the button may be for more than this.
  else if (this->Refused.insert(id).second)
  {
    vtkWarningMacro(<< this->Scene->Internal->Surfaces.Title(id) << NoActor);
  }
}

void vtkHapticGrip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Surface: " << this->GetSurface() << "\n";
  os << indent << "Button: " << this->Button << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
