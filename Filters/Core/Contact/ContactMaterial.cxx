#include "haptics/Contact/ContactMaterial.h"

#include <algorithm>

namespace haptics
{
namespace
{
/// Over so many of the largest clearance a surface that ends, or lies lower, stops to count with
/// the one that holds.
constexpr double SharingWidth = 6.0;
}

void ContactMaterial::Blend()
{
  MaterialBlend blend;
  const Vector displacement = ToVector(this->God.Result.Displacement);
  for (int i = 0; i < this->God.Result.NumberOfConstraints; ++i)
  {
    const ActivePlane& plane = this->God.Active.Support(i);
    const double push = glm::dot(plane.Normal, displacement);
    if (push > 0.0)
    {
      this->God.Around.StandAt(this->God.Position - this->God.Around.BallRadius * plane.Normal);
      this->AddMaterials(plane, push, blend);
      this->God.Around.StandAt(this->God.Position);
    }
  }
  this->God.Result.Material = blend.Blended();
  if (this->God.Result.Material.IsShaded)
  {
    this->God.Result.Shaded = ToVec3(blend.Shade(displacement));
  }
}

/// Which surface's plane holds where several lie along each other is a matter of rounding and of
/// their order: so the push on it is shared by all that lie there, each by its nearest facet.
void ContactMaterial::AddMaterials(const ActivePlane& plane, double push, MaterialBlend& blend)
{
  const std::size_t own = static_cast<std::size_t>(plane.Facet.Surface);
  double sum = 0.0;
  if (this->God.Around.TouchableCount > 1)
  {
    const double height = glm::dot(plane.Normal, this->God.Position - plane.Anchor);
    const double near =
      std::max(height, this->God.Around.SharingUnit) + this->God.Around.SharingUnit;
    const double far = near + SharingWidth * this->God.Around.SharingUnit;
    for (std::size_t i = 0; i < this->God.Around.TouchableCount; ++i)
    {
      this->Along[i] =
        this->God.Around.Sets[i].FindAlong(plane.Normal, near, far, this->God.Around.Budget);
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
  for (std::size_t i = 0; i < this->God.Around.TouchableCount; ++i)
  {
    const FacetAlong& along = this->Along[i];
    if (along.Weight > 0.0)
    {
      this->AddMaterial({ static_cast<std::int32_t>(i), along.Triangle },
        push * (along.Weight / sum), plane.Normal, blend);
    }
  }
}

void ContactMaterial::AddMaterial(
  const FacetId& facet, double push, const Vector& normal, MaterialBlend& blend) const
{
  Material material;
  Vector shaded(0.0);
  const TouchedSurface& touched = this->God.Around.Surfaces[facet.Surface];
  if (const SurfaceProperties* properties = touched.Properties.get())
  {
    const std::int32_t triangle = facet.Triangle;
    const WorkingSet& set = this->God.Around.Sets[facet.Surface];
    const auto weights = set.CornerWeights(triangle);
    material = properties->At(touched.Surface->Triangles()[triangle], triangle, weights);
    if (properties->HasGradients())
    {
      properties->AddGradients(touched.Surface->Triangles()[triangle], triangle, weights,
        set.WeightGradients(triangle), material);
    }
    if (properties->IsShaded())
    {
      shaded = set.Frame().VectorToScene(ToVector(properties->NormalAt(triangle, weights)));
    }
  }
  blend.Add(material, push, normal, shaded);
}
}
