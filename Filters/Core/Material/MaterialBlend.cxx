#include "haptics/Material/MaterialBlend.h"

#include "haptics/Material/ForceProfile.h"

#include <algorithm>

namespace haptics
{
void MaterialBlend::Add(
  const Material& material, double push, const Vector& normal, const Vector& shaded)
{
  if (this->Push == 0.0)
  {
    this->Sum.PlainShare = 0.0;
    this->Sum.LargestPlainShare = 0.0;
  }
  this->Push += push;
  this->Sum.Stiffness += push * material.Stiffness;
  this->Sum.PlainShare += push * material.PlainShare;
  this->Sum.Damping += push * material.Damping;
  this->Sum.StaticFriction += push * material.StaticFriction;
  this->Sum.DynamicFriction += push * material.DynamicFriction;
  this->Sum.Texture += push * material.Texture;
  const auto add = [push](Vec3& sum, const Vec3& gradient)
  { sum = ToVec3(ToVector(sum) + push * ToVector(gradient)); };
  add(this->Sum.StiffnessGradient, material.StiffnessGradient);
  add(this->Sum.PlainShareGradient, material.PlainShareGradient);
  add(this->Sum.TextureGradient, material.TextureGradient);
  this->Sum.LargestStiffness = std::max(this->Sum.LargestStiffness, material.LargestStiffness);
  this->Sum.LargestPlainShare = std::max(this->Sum.LargestPlainShare, material.LargestPlainShare);
  this->Sum.LargestTexture = std::max(this->Sum.LargestTexture, material.LargestTexture);
  // Of those pushed as much the steepest profile, so that their order does not count.
  const auto slope = [](const ForceProfile* profile)
  { return profile ? profile->SteepestSlope() : -1.0; };
  if (push > this->StrongestPush ||
    (push == this->StrongestPush && slope(material.Profile) > slope(this->Sum.Profile)))
  {
    this->StrongestPush = push;
    this->Sum.Profile = material.Profile;
  }
  this->Normal += push * normal;
  const double length = glm::length(shaded);
  // Where both sides are touched the normal may be that of the other one.
  const double share = length > 0.0 ? push / length : 0.0;
  this->ShadedNormal +=
    length > 0.0 ? (glm::dot(shaded, normal) < 0.0 ? -share : share) * shaded : push * normal;
  this->IsShaded = this->IsShaded || length > 0.0;
}

Material MaterialBlend::Blended() const
{
  Material material = this->Sum;
  material.IsPlain = false;
  if (this->Push > 0.0)
  {
    const double share = 1.0 / this->Push;
    material.Stiffness *= share;
    material.PlainShare *= share;
    material.Damping *= share;
    material.StaticFriction *= share;
    material.DynamicFriction *= share;
    material.Texture *= share;
    for (Vec3* const gradient :
      { &material.StiffnessGradient, &material.PlainShareGradient, &material.TextureGradient })
    {
      *gradient = ToVec3(share * ToVector(*gradient));
    }
    material.IsShaded = this->IsShaded;
  }
  return material;
}

Vector MaterialBlend::Shade(const Vector& displacement) const
{
  const double from = glm::length(this->Normal);
  const double to = glm::length(this->ShadedNormal);
  if (!this->IsShaded || from == 0.0 || to == 0.0)
  {
    return displacement;
  }
  const Vector a = this->Normal / from;
  const Vector b = this->ShadedNormal / to;
  const double cosine = glm::dot(a, b);
  if (cosine <= 0.0)
  {
    return displacement; // a normal that far off says nothing of the surface
  }
  // Rodrigues' turn that takes a to b.
  const Vector axis = glm::cross(a, b);
  const Vector turned = glm::cross(axis, displacement);
  return displacement + turned + glm::cross(axis, turned) / (1.0 + cosine);
}
}
