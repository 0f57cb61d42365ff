#include "ForceModel.h"

#include "VectorMath.h"

#include <cmath>

namespace haptics
{
Vec3 ForceModel::Force(const Vec3& displacement) const noexcept
{
  const Vector force = this->Stiffness * ToVector(displacement);
  const double magnitude = glm::length(force);
  if (!std::isfinite(magnitude))
  {
    return {};
  }
  return ToVec3(magnitude > this->MaximumForce ? force * (this->MaximumForce / magnitude) : force);
}
}
