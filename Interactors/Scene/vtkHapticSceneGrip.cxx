// What the hand of a vtkHapticScene carries.
#include "vtkHapticScene.h"

#include "haptics/Scene/HapticSceneInternals.h"
#include "vtkActor.h"
#include "vtkHapticServo.h"

#include <string>
#include <utility>

namespace
{
constexpr const char* NoActor =
  " was added as geometry: there is no actor that a hand could carry. Add it as a vtkActor.";
}

int vtkHapticScene::GetGrippedSurface()
{
  return this->Internal->Grip.Surface();
}

bool vtkHapticScene::Grip()
{
  this->ForgetMessage();
  if (!this->Touching)
  {
    this->Fail("A grip needs a contact, and nothing is touched. Touch a surface first.");
    return false;
  }
  return this->GripSurface(this->TouchedSurface);
}

bool vtkHapticScene::GripSurface(int id)
{
  this->ForgetMessage();
  this->PullSurfaces(); // it may have been hidden meanwhile
  haptics::HapticGrip& grip = this->Internal->Grip;
  const haptics::HapticSurface* surface = this->Internal->Surfaces.Find(id);
  const std::string name = this->Internal->Surfaces.Title(id);
  if (surface && grip.Surface() == id)
  {
    return true;
  }
  if (!surface)
  {
    this->Fail(this->GetSurfaceAssembly(id)
        ? name + " is a whole assembly. Grip one of its parts, which have ids of their own."
        : "There is no surface " + std::to_string(id) + " to grip.");
    return false;
  }
  if (!this->GetSurfaceActor(id))
  {
    this->Fail(name + NoActor);
    return false;
  }
  if (!surface->Touched())
  {
    this->Fail(name + " cannot be touched, and so cannot be gripped. Show it first.");
    return false;
  }
  if (!this->IsHandThere())
  {
    this->Fail("There is no hand to grip with. Engage() or Step() first, with the clutch off.");
    return false;
  }
  this->LetGo();
  grip.Take(id, *this->Internal->Latest, this->Internal->Surfaces);
  this->Internal->Events.Add(vtkHapticScene::GripEvent, id);
  this->PullSurfaces();
  this->Modified();
  return grip.Surface() == id;
}

bool vtkHapticScene::IsHandThere()
{
  const int state = this->Servo->GetState();
  return (state == vtkHapticServo::Running || state == vtkHapticServo::Stepping) &&
    this->Internal->Latest && !this->Internal->Clutched;
}

void vtkHapticScene::LetGo()
{
  haptics::HapticGrip& grip = this->Internal->Grip;
  if (grip.Surface() == haptics::HapticGrip::Nothing)
  {
    return;
  }
  this->CarryGripped();
  this->Internal->Events.Add(vtkHapticScene::LetGoEvent, grip.Surface());
  grip.LetGo(this->Internal->Surfaces);
  this->PullSurfaces(); // what moves the actor from now on is not the hand
  this->Modified();
}

bool vtkHapticScene::CarryGripped()
{
  haptics::HapticGrip& grip = this->Internal->Grip;
  haptics::SurfaceSet& surfaces = this->Internal->Surfaces;
  if (grip.Surface() == haptics::HapticGrip::Nothing || !this->Internal->Latest)
  {
    return false;
  }
  for (haptics::HapticAssembly& assembly : this->Internal->Assemblies)
  {
    assembly.Pull(surfaces); // the surface of a part only stands for its actor
  }
  vtkActor* actor = this->GetSurfaceActor(grip.Surface());
  return actor && grip.Carry(*this->Internal->Latest, actor, surfaces);
}

void vtkHapticScene::ObeyGripButton()
{
  haptics::HapticGrip& grip = this->Internal->Grip;
  const bool isThere = this->IsHandThere();
  const bool isHeld = isThere && this->GripButton >= 0 &&
    (this->Internal->Latest->Buttons >> this->GripButton & 1U) != 0;
  const bool wasHeld = std::exchange(grip.IsButtonHeld, isHeld);
  if (!isThere || (wasHeld && !isHeld))
  {
    this->LetGo();
  }
  if (!isHeld || wasHeld || !this->Touching)
  {
    return;
  }
  if (this->GetSurfaceActor(this->TouchedSurface))
  {
    this->GripSurface(this->TouchedSurface);
  }
  // Told once: the button may be for more than this.
  else if (grip.Refused.insert(this->TouchedSurface).second)
  {
    vtkWarningMacro(<< this->Internal->Surfaces.Title(this->TouchedSurface) << NoActor);
  }
}
