#include "haptics/Contact/HipApproach.h"

namespace haptics
{
namespace
{
/// A slide over a bent surface is made in so many steps at most: after each the cone stands on
/// another facet.
constexpr int LargestNumberOfSlides = 4;
}

void HipApproach::Approach(const Vector& hip, bool endsAtHip)
{
  this->RenewPasses();
  if (this->God.Around.HasProperties)
  {
    this->WalkWithFriction(hip);
  }
  else if (this->God.Around.IsBall())
  {
    this->Ball.Roll(hip);
  }
  else if (this->Walk(hip) && this->God.Active.SupportSize() == 1 &&
    this->God.Active.IsKnownInside() &&
    this->God.Active.Support(0).IsCertainlyBelow(this->God.Position))
  {
    return; // it is held by the facet that is right below, with the HIP straight behind it
  }
  if (this->God.Position != hip && !this->Change.IsFound() && endsAtHip &&
    !this->God.Around.IsBall())
  {
    this->Point.LookAhead(hip);
  }
}

/// Moves as far as friction lets the HIP pull the god-object.
void HipApproach::WalkWithFriction(const Vector& hip)
{
  for (int slide = 0; slide < LargestNumberOfSlides; ++slide)
  {
    const Vector goal = this->AimWithFriction(hip);
    if (goal == hip)
    {
      break;
    }
    if (goal == this->God.Position)
    {
      return; // stuck, or slid as far as the friction lets it
    }
    const auto before = this->God.Active.SupportFacets();
    const bool arrived = this->Walk(goal);
    const bool isHeld = this->God.Active.SupportSize() > 0;
    // On the same facets the cone stands as it stood: there is no more to slide.
    const bool isDone = arrived && this->God.Active.SupportFacets() == before;
    if (this->God.IsOverloaded || this->Change.IsFound() ||
      (isHeld && (isDone || slide + 1 == LargestNumberOfSlides)))
    {
      return;
    }
  }
  this->Walk(hip);
}

/// Where friction lets the god-object aim at: its own place while stuck, the HIP without friction.
Vector HipApproach::AimWithFriction(const Vector& hip)
{
  // What the last update found here; the god-object has not moved over its surface since.
  const Material& material = this->God.Result.Material;
  if (material.StaticFriction <= 0.0 || this->God.Active.IsEmpty())
  {
    return hip;
  }
  this->God.KeepSupports(true);
  const Vector nearest =
    this->God.Active.IsEmpty() ? hip : this->God.Active.Nearest(this->God.Position, hip);
  if (this->God.Active.SupportSize() == 0)
  {
    this->God.Cone.Reset();
    return hip;
  }
  return this->God.Cone.Aim(
    this->God.Position, nearest, hip, material.StaticFriction, material.DynamicFriction);
}
}
