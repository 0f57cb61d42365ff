#include "haptics/Contact/GodObjectImplementation.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// A slide over a bent surface is made in so many steps at most: after each the cone stands on
/// another facet.
constexpr int LargestNumberOfSlides = 4;
/// A cast that looks from far away ends at a waypoint, short of what it has found.
constexpr int LargestNumberOfLandings = 3;
/// Over so many of the largest clearance a surface that ends, or lies lower, stops to count beside
/// the one that holds.
constexpr double SharingWidth = 6.0;
}

/// Moves as far as friction lets the HIP pull the god-object.
void GodObject::Implementation::WalkWithFriction(const Vector& hip)
{
  for (int slide = 0; slide < LargestNumberOfSlides; ++slide)
  {
    const Vector goal = this->AimWithFriction(hip);
    if (goal == hip)
    {
      break;
    }
    if (goal == this->Position)
    {
      return; // stuck, or slid as far as the friction lets it
    }
    const auto before = this->Active.SupportFacets();
    const bool arrived = this->Walk(goal);
    const bool isHeld = this->Active.SupportSize() > 0;
    // On the same facets the cone stands as it stood: there is no more to slide.
    const bool isDone = arrived && this->Active.SupportFacets() == before;
    if (this->IsOverloaded || this->IsChangeFound ||
      (isHeld && (isDone || slide + 1 == LargestNumberOfSlides)))
    {
      return;
    }
  }
  this->Walk(hip);
}

/// Where friction lets the god-object aim at: its own place while stuck, the HIP without friction.
Vector GodObject::Implementation::AimWithFriction(const Vector& hip)
{
  // What the last update found here; the god-object has not moved over its surface since.
  const Material& felt = this->Result.Material;
  if (felt.StaticFriction <= 0.0 || this->Active.IsEmpty())
  {
    return hip;
  }
  this->KeepSupports(true);
  const Vector nearest = this->Active.IsEmpty() ? hip : this->Active.Nearest(this->Position, hip);
  if (this->Active.SupportSize() == 0)
  {
    this->Cone.Reset();
    return hip;
  }
  return this->Cone.Aim(this->Position, nearest, hip, felt.StaticFriction, felt.DynamicFriction);
}

/// Tells what the surfaces that hold the god-object feel like here.
void GodObject::Implementation::UpdateMaterial()
{
  if (!this->HasProperties)
  {
    return;
  }
  MaterialBlend blend;
  const Vector displacement = ToVector(this->Result.Displacement);
  for (int i = 0; i < this->Result.NumberOfConstraints; ++i)
  {
    const ActivePlane& plane = this->Active.Support(i);
    const double push = glm::dot(plane.Normal, displacement);
    if (push > 0.0)
    {
      this->AddMaterials(plane, push, blend);
    }
  }
  this->Result.Material = blend.Blended();
  if (this->Result.Material.IsShaded)
  {
    this->Result.Shaded = ToVec3(blend.Shade(displacement));
  }
}

/// Which surface's plane holds where several lie along each other is a matter of rounding and of
/// their order: so the push on it is shared by all that lie there, each by its nearest facet.
void GodObject::Implementation::AddMaterials(
  const ActivePlane& plane, double push, MaterialBlend& blend)
{
  const std::size_t own = static_cast<std::size_t>(plane.Facet.Surface);
  double sum = 0.0;
  if (this->Felt > 1)
  {
    const double height = glm::dot(plane.Normal, this->Position - plane.Anchor);
    const double near = std::max(height, this->SharingUnit) + this->SharingUnit;
    const double far = near + SharingWidth * this->SharingUnit;
    for (std::size_t i = 0; i < this->Felt; ++i)
    {
      this->Along[i] = this->Sets[i].FindAlong(plane.Normal, near, far, this->Budget);
      sum += this->Along[i].Weight;
    }
    if (this->Along[own].Weight > 0.0)
    {
      this->Along[own].Triangle = plane.Facet.Triangle;
    }
  }
  if (!(sum > 0.0))
  {
    this->AddMaterial(plane.Facet, push, plane.Normal, blend);
    return;
  }
  for (std::size_t i = 0; i < this->Felt; ++i)
  {
    const FacetAlong& along = this->Along[i];
    if (along.Weight > 0.0)
    {
      this->AddMaterial({ static_cast<std::int32_t>(i), along.Triangle },
        push * (along.Weight / sum), plane.Normal, blend);
    }
  }
}

void GodObject::Implementation::AddMaterial(
  const FacetId& facet, double push, const Vector& normal, MaterialBlend& blend) const
{
  Material feel;
  Vector shaded(0.0);
  const TouchedSurface& touched = this->Surfaces[facet.Surface];
  if (const SurfaceProperties* properties = touched.Properties.get())
  {
    const std::int32_t triangle = facet.Triangle;
    const WorkingSet& set = this->Sets[facet.Surface];
    const auto weights = set.CornerWeights(triangle);
    feel = properties->At(touched.Surface->Triangles()[triangle], triangle, weights);
    if (properties->HasGradients())
    {
      properties->AddGradients(touched.Surface->Triangles()[triangle], triangle, weights,
        set.WeightGradients(triangle), feel);
    }
    if (properties->IsShaded())
    {
      shaded = set.Frame().VectorToScene(ToVector(properties->NormalAt(triangle, weights)));
    }
  }
  blend.Add(feel, push, normal, shaded);
}

/// Whether no surface feels other than it did: a hand would notice that at once. (One that has
/// deformed has its properties anew, and they go on.)
bool GodObject::Implementation::FeelsAs(const Implementation& previous) const
{
  return std::equal(this->Surfaces.begin(), this->Surfaces.end(), previous.Surfaces.begin(),
    previous.Surfaces.end(),
    [](const TouchedSurface& a, const TouchedSurface& b)
    { return a.Surface != b.Surface || a.Properties == b.Properties; });
}

/// Keeps what held another god-object, at the same place, where the surface that did is still the
/// same or goes on deforming: so that one held by friction stays, whatever else comes and goes.
void GodObject::Implementation::StayInContact(const Implementation& previous)
{
  this->Result.Material = haptics::Material();
  const Vector shift = previous.Origin - this->Origin;
  if (this->Position != previous.Position + shift)
  {
    return;
  }
  ActivePlanes kept;
  for (int i = 0; i < previous.Active.SupportSize(); ++i)
  {
    ActivePlane plane = previous.Active.Support(i);
    const TouchedSurface& then = previous.Surfaces[plane.Facet.Surface];
    const auto now = std::find_if(this->Surfaces.begin(), this->Surfaces.end(),
      [&then](const TouchedSurface& touched)
      {
        return (touched.Surface == then.Surface || touched.Surface->Follows(*then.Surface)) &&
          touched.Motion == then.Motion && touched.IsGripped == then.IsGripped;
      });
    if (now != this->Surfaces.end())
    {
      plane.Facet.Surface = static_cast<std::int32_t>(now - this->Surfaces.begin());
      this->Sets[plane.Facet.Surface].Renew(plane);
      kept.Add(plane);
    }
  }
  if (kept.IsEmpty())
  {
    return;
  }
  kept.Nearest(this->Position, ToVector(this->Result.Hip) - this->Origin);
  this->Active = kept;
  this->Cone = previous.Cone;
  this->Result.NumberOfConstraints = kept.SupportSize();
  this->UpdateMaterial();
}

/// Where what held another god-object by friction has been made anew: stands on what is there now,
/// straight below, so that friction goes on as it was.
void GodObject::Implementation::Land(const Implementation& previous)
{
  const int supports = previous.Active.SupportSize();
  if (previous.Result.Material.StaticFriction <= 0.0 || supports == 0 || this->IsSplit ||
    this->Result.NumberOfConstraints == 0)
  {
    return;
  }
  const Vector hip = ToVector(this->Result.Hip) - this->Origin;
  ActivePlanes planes = this->Active; // those that have pushed it, if any did
  this->WaySize = 1;
  for (int i = 0; i < supports && this->Active.IsEmpty(); ++i)
  {
    const Vector& normal = previous.Active.Support(i).Normal;
    for (int cast = 0; cast < LargestNumberOfLandings; ++cast)
    {
      const double depth = glm::dot(normal, this->Position - hip);
      const Vector goal = this->Position - std::max(depth, 0.0) * normal;
      FacetHit hit;
      if (!this->FindFirstHit(goal, planes, hit) || !hit)
      {
        break;
      }
      this->MoveTowards(this->Position + hit.Fraction * (goal - this->Position));
      if (!hit.IsWaypoint)
      {
        planes.Add(hit.Plane);
        break;
      }
    }
  }
  if (planes.IsEmpty())
  {
    return;
  }
  planes.Nearest(this->Position, hip);
  this->Active = planes;
  this->Cone = previous.Cone;
  this->Result.NumberOfConstraints = planes.SupportSize();
  this->UpdateMaterial();
}
}
