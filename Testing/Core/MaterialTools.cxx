#include "MaterialTools.h"

#include "AnalyticSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace haptics::testing
{
namespace
{
constexpr double Period = 0.001; // [s]
}

PropertyValues Everywhere(
  double stiffness, double damping, double staticFriction, double dynamicFriction, double texture)
{
  PropertyValues values;
  if (stiffness >= 0.0)
  {
    values[Property::Stiffness].Constant = stiffness;
  }
  values[Property::Damping].Constant = damping;
  values[Property::StaticFriction].Constant = staticFriction;
  values[Property::DynamicFriction].Constant = dynamicFriction;
  values[Property::Texture].Constant = texture;
  return values;
}

PropertyValues Rough(double staticFriction, double dynamicFriction)
{
  return Everywhere(-1.0, 0.0, staticFriction, dynamicFriction, 0.0);
}

std::shared_ptr<const SurfaceProperties> MakeProperties(
  PropertyValues values, const TriangleSurface& surface)
{
  std::string error;
  auto properties = SurfaceProperties::Build(std::move(values), surface, error);
  EXPECT_NE(properties, nullptr) << error;
  return properties;
}

TouchedSurface Touchable(
  const std::shared_ptr<const TriangleSurface>& surface, PropertyValues values)
{
  return { surface, nullptr, MakeProperties(std::move(values), *surface) };
}

MaterialHand::MaterialHand(
  TouchedSurface surface, const Vec3& start, double plainStiffness, double tip)
  : God({ std::move(surface) }, tip > 0.0 ? Tip::Ball : Tip::Point)
  , PlainStiffness(plainStiffness)
{
  this->God.SetTipRadius(tip);
  this->Move(start);
}

Vec3 MaterialHand::Move(const Vec3& hip)
{
  const Contact& contact = this->God.Update(hip);
  const Vec3 force = this->Force.Update(contact, Period, this->PlainStiffness, this->Limits);
  if (!this->IsFirst)
  {
    const Vec3 step = hip - this->Hip;
    this->EnergyOut += 0.5 * Dot(force + this->Last, step);
    this->HeldEnergyOut += Dot(this->Last, step);
    this->DeviceLoss += Dot(step, step) / Period;
  }
  this->IsFirst = false;
  this->Hip = hip;
  this->Last = force;
  return force;
}

Vec3 MaterialHand::MoveStraight(const Vec3& to, int ticks)
{
  const Vec3 from = this->Hip;
  for (int i = 1; i <= ticks; ++i)
  {
    this->Move(from + (static_cast<double>(i) / ticks) * (to - from));
  }
  return this->Last;
}
}
