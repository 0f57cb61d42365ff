#include "haptics/Scene/CarriedSurface.h"

#include "haptics/Scene/Rounding.h"
#include "haptics/Scene/SurfaceSet.h"
#include "vtkActor.h"
#include "vtkLinearTransform.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>

namespace haptics
{
void CarriedSurface::Take(int surface, const TickRecord& latest, SurfaceSet& surfaces)
{
  this->Id = surface;
  this->Since = 0;
  this->IsHeld = false;
  this->Remember(latest, surfaces);
  surfaces.SetGripped(surface, true);
}

void CarriedSurface::LetGo(SurfaceSet& surfaces)
{
  surfaces.SetGripped(this->Id, false);
  this->Id = Nothing;
}

bool CarriedSurface::IsLost(const SurfaceSet& surfaces) const
{
  const HapticSurface* const surface = surfaces.Find(this->Id);
  return this->Id != Nothing && !(surface && surface->TouchableSurface());
}

void CarriedSurface::OnPublished(std::uint64_t generation)
{
  if (this->Since == 0)
  {
    this->Since = generation;
  }
}

void CarriedSurface::Remember(const TickRecord& tick, const SurfaceSet& surfaces)
{
  if (const HapticSurface* const surface = surfaces.Find(this->Id))
  {
    const bool isTouched = surfaces.Locate(tick).Surface == this->Id;
    this->Point = surface->PointInActor(surfaces.PointOf(tick, *surface));
    this->NormalThere = isTouched ? tick.Constraints[0].Normal : Vec3{};
    this->LastTick = tick.Tick;
  }
}

void CarriedSurface::OnTick(const TickRecord& tick, const SurfaceSet& surfaces)
{
  if (this->Id == Nothing || this->IsHeld)
  {
    return;
  }
  this->IsHeld = this->Since != 0 && tick.Generation >= this->Since;
  // Where ticks are missing the hand may be anywhere by now: it holds the surface from there.
  if (!this->IsHeld || tick.Tick != this->LastTick + 1)
  {
    this->Remember(tick, surfaces);
  }
}

bool CarriedSurface::Carry(const TickRecord& tick, vtkActor* actor, SurfaceSet& surfaces)
{
  HapticSurface* const surface = surfaces.Find(this->Id);
  if (!surface || !this->IsHeld)
  {
    return false;
  }
  surface->Carry();
  const Matrix4 world = surface->Matrix();
  const Vec3 there = Transformed(world, this->Point);
  const Vec3& hand = tick.Position;
  const Vec3 by{ hand[0] - there[0], hand[1] - there[1], hand[2] - there[2] };
  const double size = std::max({ LargestComponent(hand), LargestComponent(there),
    LargestComponent({ world[3], world[7], world[11] }) });
  return LargestComponent(by) > CoordinateRounding * size && ShiftActor(actor, world, by);
}

bool ShiftActor(vtkActor* actor, const Matrix4& world, const Vec3& by)
{
  const double determinant = Determinant(world);
  if (!std::isfinite(determinant + by[0] + by[1] + by[2]) || determinant == 0.0)
  {
    return false;
  }
  vtkNew<vtkMatrix4x4> above; // what turns a shift of its position into one in the world
  if (vtkLinearTransform* const user = actor->GetUserTransform())
  {
    above->DeepCopy(user->GetMatrix());
  }
  Matrix4 own;
  actor->GetMatrix(own.data());
  if (!AreSame(own, world)) // world = parents * own
  {
    Matrix4 inverse;
    Matrix4 parents;
    Matrix4 user;
    vtkMatrix4x4::Invert(own.data(), inverse.data());
    vtkMatrix4x4::Multiply4x4(world.data(), inverse.data(), parents.data());
    vtkMatrix4x4::DeepCopy(user.data(), above);
    vtkMatrix4x4::Multiply4x4(parents.data(), user.data(), above->GetData());
  }
  above->Invert();
  Vec3 shift{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      shift[i] += above->GetElement(i, j) * by[j];
    }
  }
  const double* position = actor->GetPosition();
  actor->SetPosition(position[0] + shift[0], position[1] + shift[1], position[2] + shift[2]);
  return true;
}
}
