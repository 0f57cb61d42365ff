#include "haptics/Material/MaterialBlend.h"

#include "haptics/Material/ForceProfile.h"

#include <algorithm>

namespace haptics
{
void MaterialBlend::Add(
  const Material& feel, double push, const Vector& normal, const Vector& shaded)
{
  if (this->Push == 0.0)
  {
    this->Sum.PlainShare = 0.0;
    this->Sum.LargestPlainShare = 0.0;
  }
  this->Push += push;
  this->Sum.Stiffness += push * feel.Stiffness;
  this->Sum.PlainShare += push * feel.PlainShare;
  this->Sum.Damping += push * feel.Damping;
  this->Sum.StaticFriction += push * feel.StaticFriction;
  this->Sum.DynamicFriction += push * feel.DynamicFriction;
  this->Sum.Texture += push * feel.Texture;
  const auto add = [push](Vec3& sum, const Vec3& gradient)
  { sum = ToVec3(ToVector(sum) + push * ToVector(gradient)); };
  add(this->Sum.StiffnessGradient, feel.StiffnessGradient);
  add(this->Sum.PlainShareGradient, feel.PlainShareGradient);
  add(this->Sum.TextureGradient, feel.TextureGradient);
  this->Sum.LargestStiffness = std::max(this->Sum.LargestStiffness, feel.LargestStiffness);
  this->Sum.LargestPlainShare = std::max(this->Sum.LargestPlainShare, feel.LargestPlainShare);
  this->Sum.LargestTexture = std::max(this->Sum.LargestTexture, feel.LargestTexture);
  // Of those pushed as much the steepest profile, so that their order does not count.
  const auto slope = [](const ForceProfile* profile)
  { return profile ? profile->SteepestSlope() : -1.0; };
  if (push > this->StrongestPush ||
    (push == this->StrongestPush && slope(feel.Profile) > slope(this->Sum.Profile)))
  {
    this->StrongestPush = push;
    this->Sum.Profile = feel.Profile;
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
  Material feel = this->Sum;
  feel.IsPlain = false;
  if (this->Push > 0.0)
  {
    const double share = 1.0 / this->Push;
    feel.Stiffness *= share;
    feel.PlainShare *= share;
    feel.Damping *= share;
    feel.StaticFriction *= share;
    feel.DynamicFriction *= share;
    feel.Texture *= share;
    for (Vec3* const gradient :
      { &feel.StiffnessGradient, &feel.PlainShareGradient, &feel.TextureGradient })
    {
      *gradient = ToVec3(share * ToVector(*gradient));
    }
    feel.IsShaded = this->IsShaded;
  }
  return feel;
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
    return displacement; // a normal that far off tells nothing of the surface
  }
  // Rodrigues' turn that takes a to b.
  const Vector axis = glm::cross(a, b);
  const Vector turned = glm::cross(axis, displacement);
  return displacement + turned + glm::cross(axis, turned) / (1.0 + cosine);
}
}
